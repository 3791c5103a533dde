"""From the pieces of one clause to the slots they fill: what, how much, which way, relative to what."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

from iconjax.errors import TranslationError
from iconjax.language.chunks import Chunk
from iconjax.language.clauses import Amount, Quantity
from iconjax.language.lexicon import Entry, lexicon
from iconjax.language.names import Phrase


@dataclass
class Change:
    """A change of one extent as written: "20 % wider", "as tall as the tree", "in height"."""

    dim: str
    sign: int = 0
    amount: Amount | None = None
    same: bool = False
    absolute: bool = False
    reference: tuple[Phrase, ...] = ()
    ambiguous: str = ""


@dataclass
class Shift:
    """A direction as written, with its distance: "40 px to the left"."""

    direction: str
    amount: Amount | None = None
    place: bool = False


@dataclass
class Relation:
    """A relation as written, waiting for or holding what it is to.

    `compared`: it was read after "as wide as the monitor", and so tells of the monitor.
    """

    kind: str
    reference: tuple[Phrase, ...] = ()
    compared: tuple[Phrase, ...] = ()


@dataclass
class Slots:
    """Everything one clause says, before names are resolved."""

    connector: str = ""
    follows: str = ""
    text: str = ""
    negated: bool = False
    theme: tuple[Phrase, ...] = ()
    verbs: list[Entry] = field(default_factory=list)
    changes: list[Change] = field(default_factory=list)
    shifts: list[Shift] = field(default_factory=list)
    relations: list[Relation] = field(default_factory=list)
    amount: Amount | None = None
    gap: bool = False
    values: list[Quantity] = field(default_factory=list)
    marks: dict[str, str] = field(default_factory=dict)
    complaint: bool = False

    def kinds(self) -> set[str]:
        """Families of the verbs."""
        return {v.value for v in self.verbs}


class SlotFiller:
    """Reads the pieces of one clause from left to right; every piece must find its slot."""

    def __init__(self, chunks: Sequence[Chunk | tuple[Phrase, ...]]) -> None:
        self.chunks = list(chunks)
        self.slots = Slots()
        self.mode = ""
        self.waiting: Relation | Change | str | None = None
        self.last: Change | Shift | None = None
        self.recent: Amount | None = None
        self.after_as = False
        self.same = False

    def fill(self) -> Slots:
        """The slots of the clause.

        Raises:
            TranslationError: a piece has no place in any reading.
        """
        for item in self.chunks:
            if isinstance(item, tuple):
                self._phrases(item)
            else:
                getattr(self, f"_on_{item.kind}", self._mark)(item)
        slots = self.slots
        self._particles()
        self._cut_off()
        if isinstance(self.waiting, Relation) and not self.waiting.reference:
            self._dangling(self.waiting)
        if slots.amount is not None and self.last is not None and self.last.amount is None:
            self.last.amount, slots.amount = slots.amount, None
        self._measured_spots()
        return slots

    def _measured_spots(self) -> None:
        """A spot that the picture does not tell apart has no size to compare with."""
        amounts = [self.slots.amount, *(c.amount for c in self.slots.changes)]
        owners = [p for a in amounts if a is not None and a.of is not None for p in a.of.owners]
        for phrase in (*owners, *(p for c in self.slots.changes for p in c.reference)):
            if phrase.loose:
                raise TranslationError(f'"{phrase.loose}" is not one of the things in the picture')

    def _particles(self) -> None:
        """ "Stand the ladder | up": a verb whose second word comes behind what it is about."""
        slots = self.slots
        for shift in [s for s in slots.shifts if s.amount is None and s.direction in ("up", "down")]:
            for at, verb in enumerate(slots.verbs):
                got = lexicon().match([str(verb.info["base"]), shift.direction], 0, "verb")
                if got is not None and got[1] == 2 and got[0].value not in (verb.value, "move"):
                    slots.verbs[at] = got[0]
                    slots.shifts.remove(shift)
                    self.last = None if self.last is shift else self.last
                    return

    def _cut_off(self) -> None:
        """ "Cut a third off the pole": what is cut is the theme."""
        slots = self.slots
        shrinks = any(v.value == "scale" and int(v.info.get("sign", 0)) < 0 for v in slots.verbs)
        offs = [r for r in slots.relations if r.kind == "outside"]
        if shrinks and len(offs) == 1 and not slots.theme and slots.amount is not None:
            slots.relations.remove(offs[0])
            slots.theme = offs[0].reference
            slots.marks["off"] = "off"
        elif any(v.value == "scale" and str(v.info["base"]).endswith(" off") for v in slots.verbs):
            slots.marks["off"] = "off"

    def _dangling(self, relation: Relation) -> None:
        directions = {"above": "up", "below": "down"}
        if relation.kind in directions:
            self.slots.relations.remove(relation)
            self._direction(directions[relation.kind])
        elif relation.kind not in ("parallel", "perpendicular", "flush", "touch", "overlap", "outside"):
            raise TranslationError(f'"{relation.kind}" what? the request does not say')

    # ---- things ----

    def _on_phrase(self, item: Chunk) -> None:
        self._phrases((item.data,))

    def _phrases(self, phrases: tuple[Phrase, ...]) -> None:
        if isinstance(self.waiting, Relation):
            self.waiting.reference = phrases
        elif isinstance(self.waiting, Change):
            self._compare(self.waiting, phrases)
        elif self.slots.theme and self.slots.kinds() & {"swap", "align", "join", "part"}:
            self.slots.theme = (*self.slots.theme, *phrases)
        elif self.mode == "to" and self.slots.theme and any(p.side or p.special == "canvas" for p in phrases):
            self.slots.relations.append(Relation("flush", phrases))
        elif self.mode == "to" and self.slots.theme and self.slots.kinds() & {"move"} and self.mode_is_plain:
            self.slots.relations.append(Relation("to", phrases))
        elif not self.slots.theme and self.mode != "to":
            self.slots.theme = phrases
        elif self._gives(phrases):
            # "give the table a top that is twice as long"
            self.slots.theme = (replace(phrases[0], owner=self.slots.theme[0]),)
        elif self.mode == "to" and self.slots.theme == () and self.slots.verbs:
            self.slots.relations.append(Relation("to", phrases))
        else:
            raise TranslationError(f'the part of "{phrases[0].text}" in the request is unclear')
        self.waiting, self.mode = None, ""

    mode_is_plain = True

    def _gives(self, phrases: tuple[Phrase, ...]) -> bool:
        giving = any(v.info["base"] in ("give", "have", "has", "get") for v in self.slots.verbs)
        first = not (self.slots.changes or self.slots.shifts or self.slots.relations or self.slots.amount)
        single = len(phrases) == len(self.slots.theme) == 1
        return giving and first and single and not phrases[0].owner and bool(phrases[0].nouns)

    def _compare(self, change: Change, phrases: tuple[Phrase, ...]) -> None:
        if phrases[0].pronoun and not phrases[0].owner:
            return  # "three times as large as they are now"
        change.reference = phrases

    def _on_measure(self, item: Chunk) -> None:
        measure: Quantity = item.data
        self.slots.values.append(measure)
        own = not measure.owners or all(p.pronoun and not p.owner and not p.side for p in measure.owners)
        if isinstance(self.waiting, Relation) and self.waiting.kind == "outside" and measure.owners:
            # "take 10 % off the height of the chair"
            self.waiting.reference, self.waiting, amount = measure.owners, None, self.slots.amount
            self._cut_off()
            self._change(Change(measure.dim))
            if amount is None or not self.slots.theme:
                raise TranslationError(f'the part of "{item.text}" in the request is unclear')
        elif isinstance(self.waiting, Relation):
            # "at the same height as the roof's height"
            raise TranslationError(f'the part of "{item.text}" in the request is unclear')
        if self.waiting is not None and isinstance(self.waiting, Change) and measure.owners:
            self.waiting.reference, self.waiting, self.mode = measure.owners, None, ""
        elif measure.dim == "gap" and not self.slots.theme:
            self.slots.theme, self.slots.gap = measure.owners, True
        elif self.mode == "to" and not own:
            amount = Amount(1.0, "times", "to", measure)
            self._amount(amount)
        elif not self.slots.theme and measure.owners and not own:
            self.slots.theme = measure.owners
            self._change(Change(measure.dim))
        elif own:
            self._change(Change(measure.dim, same=self.same))
        elif not self.slots.changes:
            # "give the book the width of the table"
            self._amount(Amount(1.0, "times", "to", measure))
        else:
            raise TranslationError(f'the part of "{item.text}" in the request is unclear')
        self.mode, self.same = "", False

    # ---- changes of size ----

    def _change(self, change: Change) -> None:
        last = self.last
        finer = isinstance(last, Change) and last.sign and last.dim == change.dim and not last.reference
        if finer and change.sign == 0 and not change.same and self.slots.amount is None:
            self.last.ambiguous = ""  # type: ignore[union-attr]
            return  # "20 % lower in height"
        if self.slots.amount is not None:
            change.amount, self.slots.amount = self.slots.amount, None
        elif (
            isinstance(self.last, Change)
            and self.last.amount is None
            and self.recent is None
            and change.sign == 0
            and not self.last.same
        ):
            pass
        elif self.recent is not None and self.recent.mode == "":
            change.amount = self.recent
        if (
            isinstance(self.last, Change)
            and self.last.dim == "size"
            and change.sign == 0
            and self.last.sign
            and self.last.amount
            and not change.amount
        ):
            self.last.dim = change.dim  # "20% smaller in height"
            return
        self.slots.changes.append(change)
        self.last = change

    def _on_adjective(self, item: Chunk) -> None:
        sign, degree = int(item.data.info["sign"]), item.data.info["degree"]
        if self.slots.complaint and degree == "plain":
            self._change(Change(item.value, -sign))
            return
        sign = -sign if degree == "less" else sign
        same = self.after_as or degree == "plain"
        if not same and self.slots.amount is not None and self.slots.amount.mode == "to":
            self.slots.amount = replace(self.slots.amount, mode="")  # "has to be 15 % wider"
        change = Change(item.value, sign, same=same, ambiguous=item.text if item.text in ("higher", "lower") else "")
        if (
            isinstance(self.last, Change)
            and self.last.sign == 0
            and not self.last.same
            and self.last.amount is None
            and self.slots.amount is None
        ):
            raise TranslationError(f'the part of "{item.text}" in the request is unclear')
        self._change(change)
        self.after_as = False

    def _on_dim(self, item: Chunk) -> None:
        if self.same:
            self._change(Change(item.value, same=True))
            self.same = False
            return
        last = self.last
        loose = isinstance(last, Change) and last.sign and last.dim in ("size", "short", "length")
        if isinstance(last, Change) and loose and item.value in ("vert", "hori", "length"):
            last.dim = item.value  # "30% shorter in height", "smaller in width"
            return
        self._change(Change(item.value))

    _on_dim_idiom = _on_dim

    def _on_as(self, item: Chunk) -> None:
        if isinstance(self.last, Change) and (self.last.same):
            self.waiting = self.last
        else:
            self.after_as = True

    def _on_than(self, item: Chunk) -> None:
        if isinstance(self.last, Change):
            self.waiting = self.last

    def _on_same(self, item: Chunk) -> None:
        self.same = True

    def _on_fixed(self, item: Chunk) -> None:
        if item.text in ("the same", "same"):
            self.same = True
        self.slots.marks.setdefault("fixed", item.text)

    def _on_too(self, item: Chunk) -> None:
        self.slots.complaint = True

    # ---- amounts ----

    def _on_mode(self, item: Chunk) -> None:
        self.mode = item.value
        if item.data.value == "to" and "down" in item.text.split():
            self.slots.marks["down to"] = item.text
        plain = ("to", "over to", "up to", "down to", "back to")
        self.mode_is_plain = item.text in plain or item.text.startswith(("right ", "all the way "))
        if self.mode == "to" and isinstance(self.waiting, Relation):
            raise TranslationError(f'"{self.waiting.kind}" what? the request does not say')

    def _on_amount(self, item: Chunk) -> None:
        self._amount(replace(item.data, mode=self.mode))
        self.mode = ""

    def _amount(self, amount: Amount) -> None:
        self.recent = amount
        if isinstance(self.last, Change) and self.last.amount is None:
            # "wider and taller by 20%" means both
            for change in self.slots.changes:
                change.amount = change.amount or amount
        elif isinstance(self.last, Shift) and self.last.amount is None:
            self.last.amount = amount
        elif self.slots.amount is None:
            self.slots.amount = amount
        else:
            raise TranslationError("two amounts in one clause, and only one thing to measure")

    # ---- places ----

    def _direction(self, direction: str) -> None:
        shift = Shift(direction, self.slots.amount)
        self.slots.amount = None
        self.slots.shifts.append(shift)
        self.last = shift

    def _on_direction(self, item: Chunk) -> None:
        for one in {
            "upleft": ("up", "left"),
            "upright": ("up", "right"),
            "downleft": ("down", "left"),
            "downright": ("down", "right"),
        }.get(item.value, (item.value,)):
            self._direction(one)
        beside = any(r.kind in ("beside", "touch", "to") and r.reference for r in self.slots.relations)
        alone = not (self.slots.verbs or self.slots.theme or self.slots.relations)
        sided = item.text.startswith(("on ", "to its", "at ")) and item.value in ("left", "right")
        if sided and (beside or alone):
            self.slots.shifts[-1].place = True  # "next to the oven, on the left"

    def _on_relation(self, item: Chunk) -> None:
        if isinstance(self.waiting, Relation) and self.waiting.kind not in ("parallel", "touch"):
            raise TranslationError(f'the part of "{item.text}" in the request is unclear')
        if item.value == "toward" and not item.text.startswith(("to", "in")):
            self.slots.marks["closer"] = item.text
        compared = next((c.reference for c in self.slots.changes if c.reference), ())
        if not compared and self.slots.amount is not None and self.slots.amount.of is not None:
            compared = tuple(p for p in self.slots.amount.of.owners if not p.pronoun)
        self.waiting = Relation(item.value, compared=compared)
        self.slots.relations.append(self.waiting)
        self.mode = ""

    def _on_side(self, item: Chunk) -> None:
        raise TranslationError(f'the part of "{item.text}" in the request is unclear')

    # ---- the rest ----

    def _on_verb(self, item: Chunk) -> None:
        self.slots.verbs.append(item.data)
        self.mode = ""
        if item.value == "match" and self.slots.theme == () and not self.slots.values:
            return
        if item.value == "match":
            self.mode = "to"

    def _on_without(self, item: Chunk) -> None:
        self.slots.negated = True

    def _on_separator(self, item: Chunk) -> None:
        pass

    def _on_unknown(self, item: Chunk) -> None:
        raise TranslationError(f'"{item.text}" is not understood')

    def _mark(self, item: Chunk) -> None:
        self.slots.marks[item.kind] = item.value if item.kind in ("sense", "orient", "apart") else item.text
