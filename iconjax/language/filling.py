"""From the parse of a clause to its slots: what, how much, which way, relative to what."""

from __future__ import annotations

from dataclasses import replace

from lark import Token, Tree

from iconjax.language.chunks import Chunk
from iconjax.language.finishing import finish
from iconjax.language.frames import Change, Relation, Shift, Slots
from iconjax.language.measures import Measures, Node, known_verb, phrases, pieces, unclear
from iconjax.language.names import Phrase

PAIRING = frozenset({"swap", "align", "join", "part"})
"""Families of verbs that speak of two things."""
GIVING = frozenset({"give", "have", "has", "get"})
"""Verbs that may name the owner of what changes first."""
DIAGONALS = {
    "upleft": ("up", "left"),
    "upright": ("up", "right"),
    "downleft": ("down", "left"),
    "downright": ("down", "right"),
}


class Filling(Measures):
    """Fills the slots of one clause; a method for each node of the grammar, called from left to right."""

    def fill(self, clause: Node) -> Slots:
        """The slots of a clause.

        Raises:
            TranslationError: a piece has no place in this parse.
        """
        self.visit_children(clause)
        slots = self.slots
        if slots.negated and all(isinstance(c, Tree) and c.data in ("deny", "theme") for c in clause.children):
            self._keeps()  # "not the lamp"
        first = clause.children[0]
        if isinstance(first, Token) and first.type == "WITH" and self.recent is None and not slots.changes:
            self._alongside()
        if slots.negated and slots.changes and all(c.sign and c.reference and not c.same for c in slots.changes):
            slots.negated = False  # "not wider than the door" is at most as wide
            for change in slots.changes:
                change.sign = -change.sign
        finish(slots, self.last)
        return slots

    # ---- words that stand alone ----

    def deny(self, node: Node) -> None:
        self.slots.negated = True

    def verb(self, node: Node) -> None:
        self.slots.verbs.extend(p.data for p in pieces(node) if p.kind == "verb")

    keeping = doing = verb

    def mark(self, node: Node) -> None:
        piece = next(pieces(node))
        if piece.kind == "too":
            self.slots.complaint = True
        elif piece.kind == "fixed":
            self.slots.marks.setdefault("fixed", piece.text)
        elif piece.kind != "same":
            said = piece.value if piece.kind in ("sense", "orient", "apart") else piece.text
            self.slots.marks[piece.kind] = said

    def floating(self, node: Node) -> None:
        """ "Each", "itself": of no news."""

    def filler(self, node: Node) -> None:
        self.down_to(node)

    # ---- things ----

    def theme(self, node: Node) -> None:
        measure = next((p.data for p in pieces(node) if p.kind == "measure"), None)
        self.slots.theme = phrases(node)
        self.slots.gap = measure is not None and measure.dim == "gap"
        if measure is not None:
            self.slots.values.append(measure)
        if measure is not None and not self.slots.gap:
            self.change(Change(measure.dim))

    def topic(self, node: Node) -> None:
        self.visit_children(node)

    fronted = topic

    def unchanged(self, node: Node) -> None:
        """ "Same proportions", "widths unchanged": what is said to stay."""
        self.visit_children(node)
        self._keeps()
        for piece in (c.value for c in node.children if isinstance(c, Token)):
            if piece.kind == "measure":
                self.slots.changes.append(Change(piece.data.dim))
            elif piece.kind not in ("same", "fixed"):
                self.slots.changes.append(Change(piece.value))

    def _alongside(self) -> None:
        """ "..., with the shade coming down": it goes along; "..., with its lid still on it": that stays so."""
        slots = self.slots
        if slots.kinds() == {"move"}:
            slots.verbs, slots.shifts, self.last = [known_verb("follow")], [], None
        elif not slots.verbs and not slots.shifts and slots.relations:
            slots.verbs = [known_verb("keep")]

    def _keeps(self) -> None:
        self.slots.negated = False
        self.slots.verbs.append(known_verb("keep"))

    def description(self, node: Node) -> None:
        """ "The shade is a bit large": leads up to what should change."""
        self.visit_children(node)
        amount, self.slots.amount = self.slots.amount, None
        if amount is not None and not amount.vague:
            raise unclear(next(pieces(node)))
        *_, adjective = pieces(node)
        self.slots.complaint = True
        self.slots.changes.append(Change(adjective.value, -int(adjective.data.info["sign"])))

    def further(self, node: Node) -> None:
        """A second thing: the other one of a pair, or what the first one is given."""
        slots, things = self.slots, phrases(node)
        if slots.kinds() & PAIRING:
            slots.theme = (*slots.theme, *things)
            return
        gives = any(v.info["base"] in GIVING for v in slots.verbs)
        said = slots.changes or slots.shifts or slots.relations or slots.amount
        single = len(things) == len(slots.theme) == 1
        if not gives or said or not single or things[0].owner or not things[0].nouns:
            raise unclear(next(pieces(node)))
        slots.theme = (replace(things[0], owner=slots.theme[0]),)

    # ---- places ----

    def shift(self, node: Node) -> None:
        for part in node.children:
            if isinstance(part, Tree):
                self.visit(part)
            else:
                self._direction(part.value)

    def _direction(self, piece: Chunk) -> None:
        slots = self.slots
        for direction in DIAGONALS.get(piece.value, (piece.value,)):
            self.last, slots.amount = Shift(direction, slots.amount), None
            slots.shifts.append(self.last)
        beside = any(r.kind in ("beside", "touch", "to") and r.reference for r in slots.relations)
        alone = not (slots.verbs or slots.theme or slots.relations)
        sided = piece.text.startswith(("on ", "to its", "at ")) and piece.value in ("left", "right")
        if sided and (beside or alone):
            slots.shifts[-1].place = True  # "next to the oven, on the left"

    def place(self, node: Node) -> None:
        piece, slots, things = next(pieces(node)), self.slots, phrases(node)
        if piece.value == "toward" and not piece.text.startswith(("to", "in")):
            slots.marks["closer"] = piece.text
        compared = next((c.reference for c in slots.changes if c.reference), ())
        if not compared and slots.amount is not None and slots.amount.of is not None:
            compared = tuple(p for p in slots.amount.of.owners if not p.pronoun)
        slots.relations.append(Relation(piece.value, tuple(self._that_of(p) for p in things), compared))

    dangling = place

    def companion(self, node: Node) -> None:
        if "align" in self.slots.kinds():
            self.slots.relations.append(Relation("flush", phrases(node)))  # A moves, and B does not
        elif self.slots.kinds() & PAIRING:
            self.slots.theme = (*self.slots.theme, *phrases(node))
        else:
            self.slots.relations.append(Relation("with", phrases(node)))

    def _that_of(self, phrase: Phrase) -> Phrase:
        """ "Its right edge flush with that of the monitor": the same side, of another."""
        mine = self.slots.theme[0].side if self.slots.theme else None
        same = mine is not None and phrase.owner is not None and phrase.text.startswith(("that of", "those of"))
        return replace(phrase, side=mine) if same else phrase

    def along(self, node: Node) -> None:
        """ "Slide down the post"."""
        way, _ = pieces(node)
        if way.value not in ("up", "down"):
            raise unclear(way)
        self._direction(way)
        self.slots.relations.append(Relation("along", phrases(node)))

    def goal(self, node: Node) -> None:
        self.down_to(node)
        piece, things = next(pieces(node)), phrases(node)
        if piece.kind == "verb":
            self.slots.verbs.append(piece.data)
        side = any(p.side or p.special == "canvas" for p in things)
        self.slots.relations.append(Relation("flush" if side else "to", things))

    def off(self, node: Node) -> None:
        """ "Take 10 % off the height of the chair"."""
        relation, measure = pieces(node)
        owners = () if all(p.pronoun and not p.owner for p in measure.data.owners) else measure.data.owners
        if relation.value != "outside" or self.slots.amount is None or (owners and self.slots.theme):
            raise unclear(measure)
        self.slots.values.append(measure.data)
        self.slots.marks["off"] = "off"
        self.slots.theme = owners or self.slots.theme
        self.change(Change(measure.data.dim, -1))
