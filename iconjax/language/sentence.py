"""A parsed request as clauses in the order in which they are to be read, each with what leads to it."""

from __future__ import annotations

from collections.abc import Sequence

from lark import Token, Tree

from iconjax.errors import TranslationError
from iconjax.language.ellipsis import complete
from iconjax.language.filling import Filling
from iconjax.language.frames import Slots
from iconjax.language.measures import pieces
from iconjax.language.reading import FOLLOWING

Connected = tuple[str, Tree[Token]]
WEAK = ("", ",", "and")
"""Connectors that another one beside them overrules."""
LEADS = {"deny": "without", "BY": "by", "keeping": "and", "WITH": "and"}
"""Connectors that a clause brings along itself, by what it opens with."""
FRONTED = FOLLOWING - {"so", "where", "to keep"}
"""Connectors of clauses that may come before the one whose aim they say."""


def clauses_of(tree: Tree[Token], words: Sequence[str]) -> list[Slots]:
    """The slots of a request's clauses in the order in which they are to be read.

    Raises:
        TranslationError: a piece has no place in this parse.
    """
    found = _in_order([(c, n) for c, n in _connected(tree) if not _is_void(n)])
    out = []
    for at, (connector, node) in enumerate(found):
        slots = Filling().fill(node)
        slots.connector = connector
        slots.follows = found[at + 1][0] if at + 1 < len(found) else ""
        slots.text = " ".join(words[p] for piece in pieces(node) for p in range(piece.start, piece.end))
        kinds = [piece.kind for piece in pieces(node)]
        slots.trailing = kinds[-1] == "amount"
        slots.declares = "phrase" in kinds and "verb" not in kinds[: kinds.index("phrase")]
        if _describes(node) and not slots.follows:
            raise TranslationError("it says how things are, and not what should change")
        out.append(slots)
    return complete(out)


def _in_order(found: list[Connected]) -> list[Connected]:
    """Clauses with the aims behind what they are the aims of."""
    if len(found) > 1 and found[0][0] in FRONTED and found[1][0] in WEAK:
        # "until it touches the base, move the shade"
        found[0], found[1] = ("", found[1][1]), (found[0][0], found[0][1])
    for at in range(1, len(found) - 1):
        # "shrink it, without distorting it, until ...": what follows belongs to what was before
        if found[at][0] == "without" and found[at + 1][0] in FOLLOWING:
            found[at], found[at + 1] = found[at + 1], found[at]
    return found


def _connected(tree: Tree[Token]) -> list[Connected]:
    """Clauses with the words that lead to them."""
    out, connector = [], ""
    for node in tree.children:
        assert isinstance(node, Tree)
        if node.data == "seam":
            for token in node.scan_values(lambda _: True):
                text = "until" if token.type == "UNTIL" else token.value.text
                connector = text if connector in WEAK else connector
            continue
        first = node.children[0]
        lead = LEADS.get(first.type if isinstance(first, Token) else first.data, "")
        joined = node.data == "aside"
        if connector in WEAK and (lead not in ("", "and") or joined):
            connector = lead or "and"
        out.append((connector, node))
        connector = ""
    return out


def _is_void(node: Tree[Token]) -> bool:
    """Whether a clause says only what it replaces: "instead of left"."""
    return all(piece.kind == "instead" for piece in pieces(node))


def _describes(node: Tree[Token]) -> bool:
    first = node.children[0]
    said = first.data == "description" if isinstance(first, Tree) else False
    return said and all(piece.kind != "too" for piece in pieces(node))
