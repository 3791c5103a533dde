"""The slots of a clause: what, how much, which way, relative to what, before names are resolved."""

from __future__ import annotations

from dataclasses import dataclass, field

from iconjax.language.clauses import Amount, Quantity
from iconjax.language.lexicon import Entry
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
    """Everything one clause says, before names are resolved.

    `complaint`: it says how a thing is, too large or the like; `trailing`: it ends in an amount;
    `declares`: it speaks of a thing before any verb, and so is no command.
    """

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
    trailing: bool = False
    declares: bool = False

    def kinds(self) -> set[str]:
        """Families of the verbs."""
        return {v.value for v in self.verbs}
