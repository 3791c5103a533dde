"""The pieces of a request as the terminals of the grammar, and its parses, best first."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cache
from importlib.resources import files
from typing import Any

from lark import Lark, Token, Tree
from lark.exceptions import UnexpectedEOF, UnexpectedToken
from lark.lexer import Lexer

from iconjax.errors import TranslationError
from iconjax.language.chunks import Chunk
from iconjax.language.ranking import best_trees
from iconjax.language.reading import FOLLOWING

MOST_PARSES = 24
"""Most parses of a request that are tried."""
WINDOW = 5
"""How much worse than the best a parse may be."""
MARKS = ("upside_down", "squarely", "together", "mutual", "rest", "places", "instead")
TERMINALS: Mapping[str, str] = {
    "amount": "AMOUNT",
    "that_much": "THAT_MUCH",
    "as": "AS",
    "than": "THAN",
    "like": "LIKE",
    "same": "SAME",
    "too": "TOO",
    "without": "WITHOUT",
    "relation": "REL",
    "with": "WITH",
    "direction": "DIRECTION",
    "dim": "DIM",
    "dim_idiom": "DIM",
    "fixed": "FIXED",
    "sense": "SENSE",
    "orient": "ORIENT",
    "apart": "APART",
    **dict.fromkeys(MARKS, "MARK"),
}
"""Kinds of pieces that are one terminal each."""


class Misfit(TranslationError):
    """The pieces of a request fit together in no way.

    Attributes:
        words: the first that has no place.
    """

    def __init__(self, message: str, words: str = "") -> None:
        super().__init__(message)
        self.words = words


def terminal(piece: Chunk) -> str:
    """The name of the terminal that a piece is."""
    if piece.kind in TOLD:
        return TOLD[piece.kind](piece)
    if piece.kind == "fixed" and piece.text in ("same", "the same"):
        return "SAME"
    return TERMINALS[piece.kind]


def _phrase(piece: Chunk) -> str:
    if piece.data.pronoun == "them" and piece.text.split()[0] in ("each", "both", "all"):
        return "EACH"
    return "SELF" if piece.text.endswith(("self", "selves")) else "PHRASE"


def _separator(piece: Chunk) -> str:
    if piece.value == "soft":
        return "COMMA" if piece.text == "," else "AND"
    if piece.text == ":":
        return "COLON"
    return "SUB" if piece.text in FOLLOWING else "STOP"


def _measure(piece: Chunk) -> str:
    if piece.data.dim == "gap":
        return "GAP"
    own = all(p.pronoun and not p.owner and not p.side for p in piece.data.owners)
    return "MEASURE" if own else "MEASURE_OF"


def _adjective(piece: Chunk) -> str:
    return "PLAIN" if piece.data.info["degree"] == "plain" else "MORE"


def _verb(piece: Chunk) -> str:
    if piece.value == "match":
        return "MATCH"
    if piece.data.info["participle"]:
        return "KEEPING" if piece.value == "keep" else "DOING"
    if piece.text in ("is", "are", "was", "were"):
        return "IS"
    return "VERB"


def _mode(piece: Chunk) -> str:
    if piece.text.startswith("until"):
        return "UNTIL"
    return "BY" if piece.value == "by" else "TO"


TOLD: Mapping[str, Callable[[Chunk], str]] = {
    "phrase": _phrase,
    "separator": _separator,
    "measure": _measure,
    "adjective": _adjective,
    "verb": _verb,
    "mode": _mode,
}
"""Kinds of pieces that are one of several terminals."""


class _Pieces(Lexer):
    """Hands the pieces on as the terminals that they are."""

    def __init__(self, conf: Any) -> None:
        del conf

    def lex(self, pieces: Sequence[Chunk]) -> Iterator[Token]:  # type: ignore[override]
        for number, piece in enumerate(pieces):
            token = Token(terminal(piece), str(number))  # the number keeps equal words apart in the forest
            token.value = piece
            yield token


@cache
def parser() -> Lark:
    """The parser of the built-in grammar, made once."""
    text = files("iconjax.language").joinpath("grammar.lark").read_text(encoding="utf-8")
    made = Lark(text, parser="earley", lexer=_Pieces, ambiguity="forest")
    _predict_directly(made.parser.parser)
    return made


def _predict_directly(earley: Any) -> None:
    """Halve the time of a parse: have the parser predict the rules of a symbol only.

    As it comes, it predicts for each item all rules that the symbol may begin with, and then again for each of
    those; that each predicted item predicts in its turn is enough.
    """
    direct: dict[Any, dict[Any, None]] = {}
    for rules in earley.predictions.values():
        for rule in rules:
            direct.setdefault(rule.origin, {})[rule] = None
    earley.predictions = {symbol: list(direct[symbol]) for symbol in earley.predictions}


def parses(pieces: Sequence[Chunk]) -> list[Tree[Token]]:
    """The parses of a request, best first.

    Raises:
        Misfit: the pieces fit together in no way; names the first that does not fit.
    """
    try:
        forest: Any = parser().parse(pieces)
    except UnexpectedToken as error:
        text = error.token.value.text
        raise Misfit(f'the part of "{text}" in the request is unclear', text) from None
    except UnexpectedEOF:
        raise Misfit("it breaks off" if pieces else "it is empty") from None
    return [tree for _, tree in best_trees(forest, MOST_PARSES, WINDOW)]
