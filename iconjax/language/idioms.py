"""Ways to say an extent or a number of things, written out: "just as wide", "take 20 px off the rope", "all three"."""

from __future__ import annotations

from collections.abc import Sequence

from iconjax.language.lexicon import Lexicon
from iconjax.language.names import Names
from iconjax.language.wordings import PERCENT, amount_end, scan

EXTENTS = {
    "vert": "height",
    "hori": "width",
    "length": "length",
    "short": "length",
    "thick": "thickness",
    "size": "size",
}
EQUAL = frozenset({"just", "exactly", "equally", "still", "but", "though", "yet"})
"""Words before "as wide", where that means as wide as before."""
TAKING = frozenset({"take", "cut", "trim", "chop", "shave", "saw", "knock", "lop", "snip", "slice", "pare"})
BREAKS = frozenset({".", ";", ":", "!", "?", ","})
NOW = frozenset({"now", "before", "ever", "it", "they", "currently", "today", "originally", "already", "previously"})
ARTICLES = frozenset({"a", "an", "one", "of", "with"})
MOST_FRONTED = 8
EVERY = frozenset({"all", "each", "both", "every"})


def as_before(words: list[str], lexicon: Lexicon, names: Names) -> list[str]:
    """ "10 px wider, just as tall" keeps the height."""

    def step(i: int) -> tuple[list[str], int] | None:
        start = i
        while words[i : i + 1] and words[i] in EQUAL:
            i += 1
        graded = lexicon.match(words, i + 1, "adjective") if words[i : i + 1] == ["as"] and i > 0 else None
        if graded is None or graded[0].info["degree"] != "plain" or graded[0].value not in EXTENTS:
            return None
        end = graded[1]
        compared = words[end : end + 1] == ["as"]
        if compared and not (words[end + 1 : end + 2] and words[end + 1] in NOW):
            return None
        if not compared and not (start < i and (end == len(words) or words[end] in BREAKS)):
            return None
        if start == 0 or lexicon.knows(words[start - 1], {"number", "fraction", "multiple", "unit"}):
            return None  # "half as tall as before" is a change
        if compared:
            end = next((k for k in range(end, len(words)) if words[k] in BREAKS), len(words))
        if words[start - 1] not in (*BREAKS, "and"):
            return None
        return [*([] if words[start] != "but" else ["and"]), "same", EXTENTS[graded[0].value]], end

    return scan(words, step)


def taken_off(words: list[str], lexicon: Lexicon, names: Names) -> list[str]:
    """ "Take 20 px off the rope" shortens it by as much."""

    def step(i: int) -> tuple[list[str], int] | None:
        if words[i] not in TAKING:
            return None
        end = amount_end(words, i + 1, lexicon)
        if end is None or end == i + 2 or not (words[end : end + 1] and words[end] in ("off", "from", "of")):
            return None
        at = end + 1 + (words[end + 1 : end + 2] == ["of"])
        last = at + (words[at : at + 1] in (["the"], ["its"], ["that"], ["this"], ["both"], ["each"]))
        while last < len(words) and (
            names.hear(words[last]) is not None or lexicon.knows(words[last], {"modifier", "ordinal", "descriptor"})
        ):
            last += 1
        named = last > at and names.hear(words[last - 1]) is not None
        sided = any(
            lexicon.match(words, k, "side") is not None and names.hear(words[k]) is None for k in range(at, last)
        )
        goes_on = words[last : last + 1] and words[last] in ("of", "'s")
        if not named or sided or goes_on or lexicon.match(words, last, "dim") is not None:
            return None
        if last < len(words) and words[last] not in (*BREAKS, "and", "please", "so", "but"):
            return None
        verb = "trim" if words[end - 1] in PERCENT else "shorten"
        return [verb, *words[at:last], "by", *words[i + 1 : end]], last

    return scan(words, step)


def itself(words: list[str], lexicon: Lexicon, names: Names) -> list[str]:
    """ "The rod itself" is the rod."""

    def step(i: int) -> tuple[list[str], int] | None:
        after = words[i] in ("itself", "themselves") and i > 0 and names.hear(words[i - 1]) is not None
        verb = i > 0 and lexicon.knows(words[i - 1], {"verb", "relation"})
        return ([], i + 1) if after and not verb and i + 1 < len(words) and words[i + 1] not in BREAKS else None

    return scan(words, step)


def brought_to(words: list[str], lexicon: Lexicon, names: Names) -> list[str]:
    """ "Bring the crown down to 75 %" scales it to that."""
    out = list(words)
    for i in range(1, len(out) - 1):
        end = amount_end(out, i + 1, lexicon)
        if out[i] != "to" or out[i - 1] not in ("down", "up") or end is None or out[end - 1] not in PERCENT:
            continue
        if out[end : end + 1] == ["of"]:
            continue
        start = next((k for k in range(i - 1, -1, -1) if out[k] in BREAKS), -1) + 1
        verbs = [k for k in range(start, i - 1) if any(e.value == "move" for e in lexicon.entries(out[k], "verb"))]
        if verbs and not any(e.value == "scale" for w in out[start:i] for e in lexicon.entries(w, "verb")):
            out[verbs[-1]] = "scale"
            out[i - 1] = ""
    return [w for w in out if w]


def counted(words: list[str], lexicon: Lexicon, names: Names) -> list[str]:
    """ "All three" and "the four of them", where no thing is named, are all of them; "15 % on each" is 15 % each."""

    def step(i: int) -> tuple[list[str], int] | None:
        before = words[i - 1] if i else ""
        if words[i] == "on" and _units(lexicon, before) and words[i + 1 : i + 2] and words[i + 1] in EVERY:
            return [], i + 1
        if lexicon.knows(words[i], {"modifier"}) and _number(words, i + 1, lexicon) and _several(words, i + 2, lexicon):
            return [words[i + 1], words[i]], i + 2  # "the outer two lamps"
        every = words[i] in ("all", "the", "these", "those") and _number(words, i + 1, lexicon)
        after = words[i + 2] if i + 2 < len(words) else "."
        if not every:
            return None
        if words[i + 2 : i + 4] in (["of", "them"], ["of", "these"], ["of", "those"]):
            return ["all", "of", "them"], i + 4
        if words[i] == "all" and not (_unit(after, lexicon) or _names(after, lexicon, names)):
            return ["all", "of", "them"], i + 2
        return None

    return scan(words, step)


def _number(words: Sequence[str], i: int, lexicon: Lexicon) -> bool:
    return i < len(words) and words[i] not in ("a", "an", "one") and lexicon.knows(words[i], {"number"})


def fronted(words: list[str], lexicon: Lexicon, names: Names) -> list[str]:
    """ "Up 15 px - the balloon, basket too": what is asked, then of what."""
    mark = next((i for i, w in enumerate(words) if w in BREAKS), 0)
    first, rest = words[:mark], words[mark + 1 :]
    asks = {"direction", "adjective", "sense"}
    if not 2 <= mark <= MOST_FRONTED or not rest or words[mark] == ":" or any(names.hear(w) is not None for w in first):
        return words
    if not any(lexicon.knows(w, {"unit"}) for w in first) or not any(lexicon.knows(w, asks) for w in first):
        return words
    if any(lexicon.knows(w, {"pronoun", "verb", "separator"}) and w not in (",", "and") for w in (*first, *rest[:-1])):
        return words
    says = asks | {"number", "unit", "relation", "without"}
    named = any(names.hear(w) is not None for w in rest) or bool({"whole", "everything"} & set(rest))
    telling = any(
        lexicon.knows(w, says) and not lexicon.knows(w, {"modifier"}) and names.hear(w) is None and w not in ARTICLES
        for w in rest
    )
    strange = any(w.isalpha() and w not in lexicon.words and names.hear(w) is None for w in rest)
    return [*first, ":", *rest] if named and not telling and not strange else words


def _several(words: Sequence[str], i: int, lexicon: Lexicon) -> bool:
    """Whether a plural stands at `i`."""
    return i < len(words) and lexicon.singular(words[i]) != words[i] and not _unit(words[i], lexicon)


def _units(lexicon: Lexicon, word: str) -> bool:
    return lexicon.knows(word, {"unit", "fraction"})


def _unit(word: str, lexicon: Lexicon) -> bool:
    return lexicon.knows(word, {"unit", "number", "fraction"})


def _names(word: str, lexicon: Lexicon, names: Names) -> bool:
    telling = {"modifier", "descriptor", "ordinal", "side", "adjective"}
    unheard = word.isalpha() and word not in lexicon.words
    return unheard or names.hear(word) is not None or lexicon.knows(word, telling)
