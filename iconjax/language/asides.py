"""Words of a request that only explain or describe: purposes, comparisons, relative clauses without news.

What is left out may hold no amount, no pose and nothing that should stay: such words are never left out, so
that a request which needs them is read with them or refused.
"""

from __future__ import annotations

from collections.abc import Sequence

from iconjax.language.inclusions import with_included
from iconjax.language.lexicon import Lexicon
from iconjax.language.manners import plain
from iconjax.language.names import Names
from iconjax.language.skipping import without_stories

WEIGHTY = frozenset(
    {"number", "fraction", "multiple", "unit", "orient", "upside_down", "without", "instead", "squarely"}
)
"""Categories that say what to do, wherever they stand."""
ENDS = frozenset({".", ";", ":", "!", "?", "then", "but", "while", "without"})
MOST_SUBJECT = 4
LOOKS = frozenset({"look", "feel", "effect", "appearance", "style", "impression", "mood", "air", "touch", "silhouette"})


def without_asides(words: Sequence[str], lexicon: Lexicon, names: Names) -> list[str]:
    """The request without its asides; what was left out is noted in `names.notes`."""
    words = with_included(plain(words, lexicon, names), lexicon, names)
    out: list[str] = []
    i = _heading(words, lexicon, names)
    while i < len(words):
        end = _aside(words, i, lexicon) if i else None
        end = end or _for_looks(words, i, lexicon, names)
        end = end or (_relative(words, i, lexicon, names) if i else None)
        if end is not None and not _weighty(words[i:end], lexicon, names):
            names.notes.append(f'"{" ".join(words[i:end])}" only explains or describes')
            while out and out[-1] == ",":
                out.pop()
            i = end
            continue
        out.append(words[i])
        i += 1
    return without_stories(out, lexicon, names)


def _heading(words: Sequence[str], lexicon: Lexicon, names: Names) -> int:
    """The end of a heading of one unknown word: "Pour: tip the jug ..."."""
    if words[1:2] != [":"] or len(words) < 4 or words[0] in lexicon.words or names.hear(words[0]) is not None:
        return 0
    names.notes.append(f'"{words[0]}" taken for a heading')
    return 2


def _aside(words: Sequence[str], i: int, lexicon: Lexicon) -> int | None:
    """The end of a comparison or purpose that begins at `i`: "as if ...", "so that it looks ..."."""
    opening = lexicon.match(words, i, "aside")
    if opening is not None:
        return _clause_end(words, opening[1], lexicon)
    purpose = lexicon.match(words, i, "purpose")
    if purpose is None:
        return None
    for at in range(purpose[1], min(purpose[1] + MOST_SUBJECT, len(words))):
        if lexicon.match(words, at, "appear") is not None:
            return _clause_end(words, at + 1, lexicon)
    return None


def _for_looks(words: Sequence[str], i: int, lexicon: Lexicon, names: Names) -> int | None:
    """The end of "for a quirky look" at `i`, with the comma behind it where the request begins so."""
    if words[i] != "for":
        return None
    for at in range(i + 2, min(i + 6, len(words))):
        if names.hear(words[at]) is not None or words[at] in ENDS or words[at] == ",":
            return None
        if words[at] in LOOKS and words[i + 1] in ("a", "an", "some", "that", "more"):
            return at + 1 + (i == 0 and list(words[at + 1 : at + 2]) == [","])
    return None


def _clause_end(words: Sequence[str], i: int, lexicon: Lexicon) -> int:
    last = next((j for j in range(i, len(words)) if words[j] in ENDS), len(words))
    for at in range(i, last):
        # "..., as if it fell, and the lamp should stand on the left": what follows may ask for more
        if words[at] in (",", "and") and any(lexicon.match(words, j, "verb") is not None for j in range(at + 1, last)):
            return at
    return last


def _relative(words: Sequence[str], i: int, lexicon: Lexicon, names: Names) -> int | None:
    """The end of "(the ground) he walks on", "(the bench) that it is leaning against"."""
    before = words[i - 1]
    named = names.hear(before) is not None or lexicon.knows(before, {"ground"})
    if not named or lexicon.knows(before, {"separator", "pronoun"}):
        return None
    at = i + 1 if words[i] in ("that", "which", "where") else i
    pronoun = lexicon.match(words, at, "pronoun")
    if pronoun is None or pronoun[1] != at + 1:
        return None
    at = pronoun[1]
    at += 1 if at < len(words) and words[at] in ("is", "are", "was", "were") else 0
    posture = lexicon.match(words, at, "posture")
    if posture is None:
        return None
    end = posture[1]
    last = end >= len(words) or words[end] in ENDS or words[end] in (",", "and")
    return end if last else None


def _weighty(words: Sequence[str], lexicon: Lexicon, names: Names) -> bool:
    """Whether words say an amount, a pose or what should stay."""
    comparison = list(words[:2]) in (["as", "if"], ["as", "though"])
    for i, word in enumerate(words):
        if i and words[i - 1] in ("the", "its", "their") and names.hear(word) is not None:
            continue
        if word.isdigit() or word in ("not", "never", "no"):
            return True
        if word not in ("a", "an", "one") and lexicon.knows(word, WEIGHTY):
            return True
        if not comparison and any(e.category == "verb" and e.value == "keep" for e in lexicon.phrases.get((word,), ())):
            return True
    return False
