"""Amounts in everyday wordings brought into the plain order of the grammar: "+20 px in x", "half as wide again"."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence

from iconjax.language.lexicon import Lexicon
from iconjax.language.names import Names

EXTRA = frozenset({"another", "extra", "additional", "further"})
ADJECTIVES = {"vert": "tall", "hori": "wide", "length": "long", "thick": "thick", "size": "big"}
MIDDLE = r"(?:the )?(?:cent(?:re|er)s? of )?"
STEPS = (
    (
        re.compile(
            rf"(?<=px|ls) (?:apart |away )?from {MIDDLE}(?:one|each)(?: \w+)? to {MIDDLE}(?:the )?(?:next|other)"
        ),
        "",
    ),
    (re.compile(r"(?<=px|ls) (?:between|apart)(?: (?:them|each|neighbou?rs|cent(?:re|er)s|one another))?"), ""),
    (re.compile(r" [:,] (?:with |at |so )?(?=\d+ (?:px|pixels))"), " by "),
    (re.compile(r" (?:with|at) (?:gaps|steps|distances|intervals) of (?=\d)"), " by "),
)
"""How the step from one thing to the next is said -> in plain words."""
SPACING = frozenset(
    {"space", "distribute", "spread", "arrange", "position", "place", "set", "put", "spaced", "equidistant"}
)
EVENLY = frozenset({"evenly", "equally", "uniformly", "regularly", "equidistantly"})
OPENING_GAPS = frozenset(
    {
        "leave",
        "put",
        "make",
        "have",
        "keep",
        "insert",
        "with",
        "need",
        "want",
        "is",
        "are",
        "just",
        "be",
        "should",
        "must",
        "there",
        "i",
        "we",
        "exactly",
        "only",
        "add",
    }
)
SIGNS = {"+": "increase", "plus": "increase", "minus": "reduce"}
PERCENT = frozenset({"%", "percent", "cent", "pct"})
BEING = frozenset({"is", "are", "was", "were", "has", "have", "had", "measures", "measure"})
PLACES = frozenset({"in", "along", "on"})
NUMBER = re.compile(r"\d+(\.\d+)?$")
AXES = {"x": ("right", "left"), "y": ("down", "up")}
"""Axis of the picture -> where its numbers grow and fall (y is down, as in the picture's pixels)."""


def scan(words: list[str], step: Callable[[int], tuple[list[str], int] | None]) -> list[str]:
    """Replace pieces of a list: `step` gives the new words and the end of the old ones, or None to leave a word."""
    out: list[str] = []
    i = 0
    while i < len(words):
        got = step(i)
        new, end = got if got is not None else ([words[i]], i + 1)
        out.extend(new)
        i = end
    return out


def again(words: list[str], lexicon: Lexicon, names: Names) -> list[str]:
    """ "Half as wide again" is one and a half times as wide."""

    def step(i: int) -> tuple[list[str], int] | None:
        known = words[i] == "half" and words[i + 1 : i + 2] == ["as"] and words[i + 3 : i + 4] == ["again"]
        return (["1.5", "times", "as", words[i + 2]], i + 4) if known else None

    return scan(words, step)


def more_extent(words: list[str], lexicon: Lexicon, names: Names) -> list[str]:
    """ "Another 30 % of width" and "30 % more width" are 30 % wider."""

    def step(i: int) -> tuple[list[str], int] | None:
        before = words[i] in EXTRA
        end = amount_end(words, i + before, lexicon)
        if end is None or end == i + before + 1:
            return None
        amount, sign = words[i + before : end], "less" if words[end : end + 1] == ["less"] else "more"
        after = words[end : end + 1] and words[end] in ("more", "less", *EXTRA)
        end += bool(after)
        end += words[end : end + 1] in (["of"], ["in"])
        extent = lexicon.match(words, end, "dim") if before or after else None
        if extent is None or extent[0].value not in ADJECTIVES:
            return (amount, end) if before and not after and words[end - 1] not in ("of", "in") else None
        return [*amount, sign, ADJECTIVES[extent[0].value]], extent[1]

    return scan(words, step)


def spaced(words: list[str], lexicon: Lexicon, names: Names) -> list[str]:
    """ "Space the noodles out evenly: 50 px from one to the next" is to distribute them by 50 px."""
    verb = next((i for i, w in enumerate(words) if w in SPACING and names.hear(w) is None), None)
    if verb is None:
        return words
    end = next((i for i in range(verb, len(words)) if words[i] in (".", ";", "!")), len(words))
    evenly = [i for i in range(verb, end) if words[i] in EVENLY]
    if not evenly and words[verb] not in ("distribute", "equidistant"):
        return words
    dropped = {*evenly, *(i for i in range(verb + 1, end) if words[i] in ("out", "apart") and i - verb < 6)}
    out = [w for i, w in enumerate(words) if i not in dropped]
    out[verb] = "distribute"
    text = " ".join(out)
    for pattern, plain in STEPS:
        text = pattern.sub(plain, text)
    return text.split()


def gapped(words: list[str], lexicon: Lexicon, names: Names) -> list[str]:
    """ "Leave a 25 px gap between A and B" is a gap between A and B that should be 25 px."""
    for i in range(len(words) - 2):
        end = amount_end(words, i, lexicon)
        if end is None or end == i + 1:
            continue
        amount = words[i:end]
        while words[end : end + 1] and words[end] in ("of", "free", "clear", "empty", "air"):
            end += 1
        noun = end + 1 if words[end : end + 1] and lexicon.knows(words[end], {"distance"}) else end
        if words[noun : noun + 1] != ["between"] or i == 0 or lexicon.knows(words[i - 1], {"direction", "mode"}):
            continue
        start = i - 1 if words[i - 1] in ("a", "the", "an") else i
        while start > 0 and words[start - 1] in OPENING_GAPS:
            start -= 1
        last = next((k for k in range(noun, len(words)) if words[k] in (".", ";", "!", ",", ":")), len(words))
        return [*words[:start], "the", "gap", *words[noun:last], "should", "be", *amount, *words[last:]]
    return words


def signed(words: list[str], lexicon: Lexicon, names: Names) -> list[str]:
    """ "+20 px in x" is 20 px to the right, "width -10 %" a width reduced by 10 %."""

    def step(i: int) -> tuple[list[str], int] | None:
        sign = words[i] if words[i] in SIGNS else ""
        start = i + 1 if sign else i
        end = amount_end(words, start, lexicon)
        if end is None:
            return _signed_extent(words, i, lexicon)
        if words[end : end + 1] and words[end] in PLACES and words[end + 1 : end + 2] and words[end + 1] in AXES:
            return [*words[start:end], AXES[words[end + 1]][sign == "minus"]], end + 2
        extent = lexicon.match(words, end, "dim") if sign else None
        if extent is not None:
            return [SIGNS[sign], *words[end : extent[1]], "by", *words[start:end]], extent[1]
        if sign and lexicon.knows(words[end - 1], {"unit"}) and words[end - 1] in PERCENT:
            return [SIGNS[sign], "by", *words[start:end]], end
        return (words[start:end], end) if sign == "+" else None

    return scan(words, step)


def _signed_extent(words: list[str], i: int, lexicon: Lexicon) -> tuple[list[str], int] | None:
    """ "Width -10 %"."""
    extent = lexicon.match(words, i, "dim")
    sign = words[extent[1]] if extent is not None and extent[1] < len(words) else ""
    end = amount_end(words, extent[1] + 1, lexicon) if extent is not None and sign in SIGNS else None
    if extent is None or end is None or (sign == "plus" and end == extent[1] + 2):
        return None
    return [SIGNS[sign], *words[i : extent[1]], "by", *words[extent[1] + 1 : end]], end


def amount_end(words: Sequence[str], i: int, lexicon: Lexicon) -> int | None:
    """The end of a number and its unit at `i`; a number in words needs a unit."""
    digits = i < len(words) and NUMBER.match(words[i])
    if i >= len(words) or not (digits or (lexicon.knows(words[i], {"number"}) and words[i] not in ("a", "an", "one"))):
        return None
    unit = lexicon.match(words, i + 1, "unit")
    return unit[1] if unit is not None else i + 1 if digits else None


def multiplied(words: list[str], lexicon: Lexicon, names: Names) -> list[str]:
    """ "Height times two" is to two times the height; "at 130 %" is to 130 %."""

    def step(i: int) -> tuple[list[str], int] | None:
        before, after = words[i - 1] if i else "", words[i + 1] if i + 1 < len(words) else ""
        number = NUMBER.match(after) or (lexicon.knows(after, {"number"}) and after not in ("a", "an", "one"))
        counted = NUMBER.match(before) or lexicon.knows(before, {"number", "fraction"})
        if (
            words[i] in ("times", "x")
            and number
            and not counted
            and not lexicon.knows(words[i + 2] if i + 2 < len(words) else "", {"unit"})
        ):
            return ["to", after, "times"], i + 2
        end = amount_end(words, i + 1, lexicon) if words[i] in ("at", "@") else None
        return (["to", *words[i + 1 : end]], end) if end is not None and words[end - 1] in PERCENT else None

    return scan(words, step)


def as_they_are(words: list[str], lexicon: Lexicon, names: Names) -> list[str]:
    """ "(Half) the height they are" without its relative clause."""

    def step(i: int) -> tuple[list[str], int] | None:
        if not lexicon.knows(words[i], {"dim"}) or words[i + 1 : i + 2] not in (["it"], ["they"]):
            return None
        if not words[i + 2 : i + 3] or words[i + 2] not in BEING:
            return None
        end = i + 3
        while end < len(words) and words[end] in ("now", "at", "present", "today", "currently", "already"):
            end += 1
        return [words[i]], end

    return scan(words, step)
