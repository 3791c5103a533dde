"""Words of a request brought into plain order before it is cut into pieces: what is said for manners' sake goes,
names of two words become one, signed numbers and set phrases are written out.
"""

from __future__ import annotations

from collections.abc import Sequence

from iconjax.language.gaps import gap_of, gap_verbs, gaps_named, without_facing
from iconjax.language.idioms import as_before, brought_to, counted, fronted, itself, taken_off
from iconjax.language.lexicon import Lexicon
from iconjax.language.names import Names
from iconjax.language.sides_said import given_end, outward, reaching, same_end
from iconjax.language.wordings import again, as_they_are, gapped, more_extent, multiplied, scan, signed, spaced

LONGEST_NAME = 3
MOST_COUNT = 12


def plain(words: Sequence[str], lexicon: Lexicon, names: Names) -> list[str]:
    """The words without fillers, with names, numbers and set phrases in their plain form."""
    out = list(words)
    for step in (
        _portions,
        _joined,
        _less,
        fronted,
        itself,
        again,
        given_end,
        same_end,
        outward,
        gaps_named,
        gap_of,
        without_facing,
        gap_verbs,
        reaching,
        more_extent,
        _rewritten,
        spaced,
        gapped,
        signed,
        multiplied,
        as_they_are,
        as_before,
        taken_off,
        brought_to,
        _backward,
        _particles,
        _counts,
        counted,
        _without_fillers,
        _each,
    ):
        out = step(out, lexicon, names)
    return out


def _portions(words: list[str], lexicon: Lexicon, names: Names) -> list[str]:
    """ "Two bits of bread" are two breads."""

    def step(i: int) -> tuple[list[str], int] | None:
        portion = lexicon.knows(lexicon.singular(words[i]), {"portion"})
        noun = words[i + 2] if words[i + 1 : i + 2] == ["of"] and i + 2 < len(words) else ""
        if lexicon.singular(words[i]) in names.vocabulary:
            return None
        if not portion or not noun or names.hear(noun) is None:
            return None
        plural = lexicon.singular(words[i]) != words[i] and lexicon.singular(noun) == noun
        return [noun + "s" if plural else noun], i + 3

    return scan(words, step)


def _joined(words: list[str], lexicon: Lexicon, names: Names) -> list[str]:
    """ "Rabbit ears" and "head light" as one word each, where the picture knows such a thing."""

    def step(i: int) -> tuple[list[str], int] | None:
        for count in range(min(LONGEST_NAME, len(words) - i), 1, -1):
            spoken = words[i : i + count]
            if not all(w.isalpha() for w in spoken) or _whole_name(spoken, names):
                continue
            for name in ("".join(spoken), "-".join(spoken)):
                if _names(name, lexicon, names):
                    return [name], i + count
        return None

    return scan(words, step)


def _names(name: str, lexicon: Lexicon, names: Names) -> bool:
    single = lexicon.singular(name)
    known = single in names.vocabulary or single.replace("-", " ") in lexicon.synonyms
    return known and names.hear(name) is not None


def _whole_name(words: Sequence[str], names: Names) -> bool:
    """Whether the words as they are name one thing."""
    single = {names.lexicon.singular(w) for w in words}
    return any(single <= e.words for e in (*names.objects, *names.parts))


def _less(words: list[str], lexicon: Lexicon, names: Names) -> list[str]:
    """ "Less icing" is icing made smaller."""

    def step(i: int) -> tuple[list[str], int] | None:
        opens = i == 0 or words[i - 1] in (
            ".",
            ",",
            ";",
            ":",
            "!",
            "with",
            "want",
            "like",
            "need",
            "have",
            "and",
            "but",
            "please",
        )
        if (
            words[i] not in ("less", "more")
            or not opens
            or names.hear(words[i + 1] if i + 1 < len(words) else "") is None
        ):
            return None
        if lexicon.knows(words[i + 1], {"adjective"}):
            return None
        end = i + 2
        while end < len(words) and names.hear(words[end]) is not None and not lexicon.knows(words[end], {"verb"}):
            end += 1
        return ["the", *words[i + 1 : end], "smaller" if words[i] == "less" else "bigger"], end

    return scan(words, step)


def _rewritten(words: list[str], lexicon: Lexicon, names: Names) -> list[str]:
    """Set phrases in the words that the grammar knows."""

    def step(i: int) -> tuple[list[str], int] | None:
        got = lexicon.match(words, i, "rewrite")
        if got is None or _whole_name(words[i : got[1]], names):
            return None
        return got[0].value.split(), got[1]

    return scan(words, step)


def _backward(words: list[str], lexicon: Lexicon, names: Names) -> list[str]:
    """ "Tip the boot back" is backwards; "put it back on the shelf" is not."""
    leans = any(e.info.get("lean") for w in words for e in lexicon.entries(w, "verb"))

    def step(i: int) -> tuple[list[str], int] | None:
        before, after = words[i - 1] if i else "", words[i + 1] if i + 1 < len(words) else ""
        named = before in ("the", "its", "a") or names.hear("back") is not None or names.hear(after) is not None
        returns = after in ("to", "in", "into", "on", "onto", "up", "upright", "down", "again", "together")
        return (["backward"], i + 1) if words[i] == "back" and leans and not named and not returns else None

    return scan(words, step)


def _particles(words: list[str], lexicon: Lexicon, names: Names) -> list[str]:
    """ "Pull the plunger out by 20 px to the left" without "out", as the direction is said."""
    directed = {"left", "right", "up", "down", "leftwards", "rightwards", "upwards", "downwards"} & set(words)

    def step(i: int) -> tuple[list[str], int] | None:
        after = words[i + 1] if i + 1 < len(words) else "."
        ends = after in ("by", "to", ",", ".", ";") or after[0].isdigit()
        moves = any(e.value == "move" for w in words[:i] for e in lexicon.entries(w, "verb"))
        return ([], i + 1) if words[i] in ("out", "in") and i and directed and ends and moves else None

    return scan(words, step)


def _counts(words: list[str], lexicon: Lexicon, names: Names) -> list[str]:
    """ "The 2 handles" are two; "2 px" stay what they are."""

    def step(i: int) -> tuple[list[str], int] | None:
        if not words[i].isdigit() or not 1 < int(words[i]) <= MOST_COUNT or i + 1 >= len(words):
            return None
        after = words[i + 1]
        leads = names.hear(after) is not None or lexicon.knows(after, {"modifier", "descriptor"})
        things = [after, *(words[i + 2 : i + 3] if leads else [])]
        if not any(lexicon.singular(w) != w and names.hear(w) is not None for w in things):
            return None
        spelt = [e for e, entries in lexicon.phrases.items() for x in entries if _is_number(x, words[i])]
        return ([spelt[0][0]], i + 1) if spelt else None

    return scan(words, step)


def _is_number(entry: object, digits: str) -> bool:
    return getattr(entry, "category", "") == "number" and getattr(entry, "value", "") == digits


def _without_fillers(words: list[str], lexicon: Lexicon, names: Names) -> list[str]:
    """Without "kind of", "I mean", "clearly" and the like."""

    def step(i: int) -> tuple[list[str], int] | None:
        got = lexicon.match(words, i, "filler")
        if got is not None and names.hear(words[i]) is None:
            return [], got[1]
        word = words[i]
        manner = word.endswith("ly") and len(word) > 4 and word not in lexicon.words and names.hear(word) is None
        return ([], i + 1) if manner else None

    return scan(words, step)


def _each(words: list[str], lexicon: Lexicon, names: Names) -> list[str]:
    """Without the "each" of "by a quarter each", which several things have anyhow."""

    def step(i: int) -> tuple[list[str], int] | None:
        if words[i] not in ("each", "apiece") or i == 0:
            return None
        after = words[i + 1] if i + 1 < len(words) else ""
        measured = lexicon.knows(words[i - 1], {"unit", "fraction", "multiple", "adjective", "sense", "direction"})
        adverb = measured and names.hear(after) is None and after not in ("of", "other", "one")
        return ([], i + 1) if adverb else None

    return scan(words, step)
