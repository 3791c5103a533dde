"""Amounts and changes of size in the parse of a clause."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import cast

from lark import Token, Tree
from lark.visitors import Interpreter

from iconjax.errors import TranslationError
from iconjax.language.chunks import Chunk
from iconjax.language.clauses import Amount
from iconjax.language.frames import Change, Shift, Slots
from iconjax.language.grammar import Misfit
from iconjax.language.lexicon import Entry, lexicon
from iconjax.language.names import Phrase

Node = Tree[Token]
EVERY = ("each", "both", "all")
AS_SAID = "as said"
"""Unit of "that much": the amount said before."""


def pieces(node: Node) -> Iterator[Chunk]:
    """The pieces under a node, from left to right."""
    return (token.value for token in node.scan_values(lambda v: isinstance(v, Token)))


def phrases(node: Node) -> tuple[Phrase, ...]:
    """The things named under a node; "all of them" beside their names is of no news."""
    out: list[Phrase] = []
    for piece in pieces(node):
        if piece.kind == "phrase":
            out.append(piece.data)
        elif piece.kind == "measure":
            out.extend(piece.data.owners)
    named = [p for p in out if not (p.pronoun == "them" and p.text.split()[0] in EVERY)]
    return tuple(named or out)


def known_verb(base: str) -> Entry:
    """The lexicon's entry of a verb that a clause leaves unsaid."""
    found = lexicon().match([base], 0, "verb")
    assert found is not None
    return found[0]


def unclear(piece: Chunk) -> Misfit:
    """The error of a parse in which a piece has no place."""
    return Misfit(f'the part of "{piece.text}" in the request is unclear', piece.text)


class Measures(Interpreter[Token, None]):
    """Fills the slots of amounts and sizes; a method for each node of the grammar, called from left to right.

    Attributes:
        slots: as filled so far.
        last: the latest change or shift, which an amount further on may belong to.
        recent: the latest amount.
        shared: the amount before the first of several changes, which holds for all: "20 % wider and taller".
    """

    def __init__(self) -> None:
        self.slots = Slots()
        self.last: Change | Shift | None = None
        self.recent: Amount | None = None
        self.shared: Amount | None = None

    def down_to(self, node: Node) -> None:
        for piece in pieces(node):
            if piece.kind == "mode" and piece.value == "to" and "down" in piece.text.split():
                self.slots.marks["down to"] = piece.text

    # ---- amounts ----

    def loose(self, node: Node) -> None:
        """An amount that stands alone measures what came before, or what is still to come."""
        self.recent = amount = self._amount(node)
        if isinstance(self.last, Change) and self.last.same and self.last.reference:
            raise unclear(next(pieces(node)))  # "as tall as the lamp 20 %"
        if isinstance(self.last, Change) and self.last.amount is None:
            for change in self.slots.changes:
                change.amount = change.amount or amount
        elif isinstance(self.last, Shift) and self.last.amount is None:
            self.last.amount = amount
        elif self.slots.amount is None:
            self.slots.amount = amount
        else:
            raise TranslationError("two amounts in one clause, and only one thing to measure")

    def _amount(self, node: Node) -> Amount:
        self.down_to(node)
        *before, last = pieces(node)
        modes = [p for p in before if p.kind in ("mode", "verb")]
        self.slots.verbs.extend(p.data for p in modes if p.kind == "verb")
        if last.kind == "measure":
            self.slots.values.append(last.data)
            by = bool(modes) and modes[-1].value == "by"
            return Amount(1.0, "times", "by" if by else "to", last.data)
        if last.kind == "that_much":
            return Amount(0.0, AS_SAID)
        mode = "" if not modes else "to" if modes[-1].kind == "verb" else modes[-1].value
        return replace(cast(Amount, last.data), mode=mode)

    def before(self, node: Node) -> None:
        if self.slots.amount is not None:
            raise TranslationError("two amounts in one clause, and only one thing to measure")
        self.recent = self.shared = self.slots.amount = self._amount(node)

    after = amount = measured = loose

    def appended(self, node: Node) -> None:
        """An amount said afterwards: "smaller, 70 %", "a bit larger, by 10 %"."""
        last = self.last
        if last is None:
            self.loose(node)
            return
        amount = self._amount(node)
        if last.amount is not None and not last.amount.vague:
            raise TranslationError("two amounts in one clause, and only one thing to measure")
        if isinstance(last, Change) and amount.unit == "ratio" and not amount.mode:
            left = amount.value >= (0.5 if last.sign < 0 else 1.0)  # "smaller, 70 %" is what is left
            amount = replace(amount, mode="to" if left else "by")
        self.recent = last.amount = amount

    # ---- changes of size ----

    def size(self, node: Node) -> None:
        self.shared = None
        self.visit_children(node)
        if isinstance(node.children[0], Token) and self.last is not None and self.last.amount is not None:
            self.last.amount = replace(self.last.amount, mode="to")  # "to a height of 40 px"

    def degree(self, node: Node) -> None:
        every = list(pieces(node))
        last, kinds = every[-1], {p.kind for p in every}
        self.slots.complaint |= "too" in kinds
        for piece in every:
            if piece.kind == "fixed":
                self.slots.marks.setdefault("fixed", piece.text)
        same = bool(kinds & {"same", "fixed"})
        if last.kind == "measure":
            self.slots.values.append(last.data)
            self.change(Change(last.data.dim, same=same))
        elif last.kind != "adjective":
            self.change(Change(last.value, same=same))
        else:
            self._adjective(last, "as" in kinds)

    grade = extent = same = degree

    def _adjective(self, piece: Chunk, compared: bool) -> None:
        sign, degree, amount = int(piece.data.info["sign"]), piece.data.info["degree"], self.slots.amount
        if self.slots.complaint and degree == "plain":
            self.change(Change(piece.value, -sign))
            return
        sign = -sign if degree == "less" else sign
        same = compared or degree == "plain"
        if not same and amount is not None and amount.mode == "to":
            self.slots.amount = replace(amount, mode="")  # "has to be 15 % wider"
        ambiguous = piece.text if piece.text in ("higher", "lower") else ""
        self.change(Change(piece.value, sign, same=same, ambiguous=ambiguous))

    def change(self, change: Change) -> None:
        slots, last = self.slots, self.last
        bare = not change.sign and not change.same and slots.amount is None
        if bare and isinstance(last, Change) and last.sign and self._says_more(last, change):
            return
        waiting = isinstance(last, Change) and last.amount is None and self.recent is None and not last.same
        if slots.amount is not None:
            change.amount, slots.amount = slots.amount, None
        elif (change.sign or not waiting) and self.shared is not None and self.shared.mode == "":
            change.amount = self.shared
        slots.changes.append(change)
        self.last = change

    def _says_more(self, last: Change, change: Change) -> bool:
        """Whether an extent only says more about the change before: "20 % smaller | in height"."""
        if last.dim == change.dim and not last.reference:
            last.ambiguous = ""
            return True
        if last.dim == "size" and last.amount:
            last.dim = change.dim
            return True
        return False

    def dimension(self, node: Node) -> None:
        (piece,) = pieces(node)
        last = self.last
        if piece.kind == "measure":
            self.slots.values.append(piece.data)
            self.change(Change(piece.data.dim))
            return
        loose = isinstance(last, Change) and last.sign and last.dim in ("size", "short", "length")
        if isinstance(last, Change) and loose and piece.value in ("vert", "hori", "length"):
            last.dim = piece.value  # "30% shorter in height", "smaller in width"
            return
        self.change(Change(piece.value))

    def than(self, node: Node) -> None:
        """What a change is compared with."""
        lead, first, *_ = pieces(node)
        if not isinstance(self.last, Change) or (lead.kind in ("as", "like") and not self.last.same):
            raise unclear(first)
        if first.kind == "measure":
            self.slots.values.append(first.data)
        things = phrases(node)
        if first.kind == "measure" or not things[0].pronoun or things[0].owner:
            self.last.reference = things  # not "three times as large as they are now"
