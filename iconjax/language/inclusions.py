"""What goes with a thing by being listed beside it: "shift the palm, coconuts included", "the skate, laces and all".

Listed parts of the thing say nothing new and go; other things join it, as in "the palm and the coconuts together".
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from iconjax.errors import TranslationError
from iconjax.language.lexicon import Lexicon
from iconjax.language.names import Names, Phrase
from iconjax.language.phrases import PhraseReader
from iconjax.language.wholes import WHOLES, held_by, spelt, with_wholes

ENDINGS = (
    ("included",), ("inclusive",), ("and", "all"), ("and", "everything"), ("too",), ("as", "well"), ("alike",),
    ("also",), ("together",), ("both",), ("as", "one", "piece"), ("as", "one"),
)  # fmt: skip
"""Words after a list that say it belongs to what was named before."""
OPENINGS = (
    ("including",),
    ("with", "all", "its"),
    ("with", "all", "of", "its"),
    ("with", "all", "the"),
    ("with",),
    ("along", "with"),
    ("together", "with"),
    ("that", "is"),
    ("incl",),
    ("i.e", "."),
)
"""Words before such a list; after "with", an ending is needed too."""
NOTHING_NEW = (
    ("whole", "thing"),
    ("the", "whole", "thing"),
    ("all", "of", "it"),
    ("and", "everything"),
    ("and", "all"),
)
CLOSING = frozenset({"please", "pls", "thanks", "thank", "you", "now", ",", ".", "!"})
"""Words of courtesy at the end of a request."""
JOINTS = frozenset({",", "and", "plus", "&"})


@dataclass(frozen=True)
class _List:
    """Things listed at a place of a request: their phrases, where the list begins and ends, its words for things."""

    phrases: tuple[Phrase, ...]
    spans: tuple[tuple[int, int], ...]
    start: int
    end: int


def with_included(words: Sequence[str], lexicon: Lexicon, names: Names) -> list[str]:
    """The words with what is included joined to the thing that includes it."""
    out = with_wholes(list(words), lexicon, names)
    at = 1
    while at < len(out):
        changed = _included(out, at, lexicon, names) if out[at] in (",", "with", "including", "that") else out
        at = at + 1 if changed is out else 1
        out = changed
    return out


def _included(words: list[str], at: int, lexicon: Lexicon, names: Names) -> list[str]:
    start = at + 1 if words[at] == "," else at
    for nothing in NOTHING_NEW:
        end = start + len(nothing)
        if words[at] == "," and tuple(words[start:end]) == nothing and _ends(words, end):
            return [*words[:at], *words[end:]]
    contents = _contents(words, start)
    if contents:
        return _with_contents(words, at, contents, lexicon, names)
    opening = next((o for o in OPENINGS if tuple(words[start : start + len(o)]) == o), ())
    if words[at] != "," and not opening:
        return words
    listed = _read(words, start + len(opening), lexicon, names)
    host = _before(words, at, lexicon, names)
    if listed is None or host is None:
        return words
    ending = next((e for e in ENDINGS if tuple(words[listed.end : listed.end + len(e)]) == e), ())
    end = listed.end + len(ending)
    inside, others = _sorted(listed, host[0], names)
    said = bool(ending) or (bool(opening) and (opening != ("with",) or not others))
    apposed = words[at] == "," and not opening and at in (host[2], host[2] + 1)
    if not _ends(words, end) or not (said or apposed) or not (inside or others):
        return words
    if others and not (ending or opening):
        return words  # an apposition says nothing of other things
    end += words[end : end + 1] == [","] and words[end + 1 : end + 2] != ["and"]
    at -= words[at] != "," and words[at - 1] == ","
    joined = [
        w for a, b in others for w in ("and", *([] if words[a] in ("the", "its", "their") else ["the"]), *words[a:b])
    ]
    every = spelt(names) if others and WHOLES & set(words[host[1] : host[2]]) else None
    named = {lexicon.singular(w) for w in words[host[2] - 1].split("-")} & names.vocabulary
    if every is not None and not named:
        # "the whole tulip, leaves and all": more than the flower
        names.notes.append(f'"{" ".join(words[host[1] : end])}" taken for {" and ".join(names.scene.objects)}')
        return [*words[: host[1]], *every, *words[host[2] : at], *words[end:]]
    names.notes.append(f'"{" ".join(words[start:end])}" belongs to it')
    return [*words[: host[2]], *joined, *(["together"] if joined else []), *words[host[2] : at], *words[end:]]


def _contents(words: Sequence[str], start: int) -> int:
    """The end of "with everything (that is) in it" at `start`, or 0."""
    i = start + (words[start : start + 1] == ["and"]) + (words[start : start + 1] == ["with"])
    if i == start or words[i : i + 1] not in (["everything"], ["all"], ["anything"], ["whatever"]):
        return 0
    i += 1
    while words[i : i + 1] and words[i] in ("that", "which", "is", "'s", "there", "inside"):
        i += 1
    return (
        i + 2
        if words[i : i + 1]
        and words[i] in ("in", "on", "inside", "within")
        and words[i + 1 :][:1] in (["it"], ["them"])
        else 0
    )


def _with_contents(words: list[str], at: int, end: int, lexicon: Lexicon, names: Names) -> list[str]:
    host = _before(words, at, lexicon, names)
    if host is None or len(host[0]) != 1:
        return words
    held = held_by(host[0][0], names)
    if not held or not all(o.replace(" ", "").isalpha() for o in held):
        return words
    names.notes.append(f'"{" ".join(words[at:end])}" taken for {" and ".join(held)}')
    joined = [w for o in held for w in ("and", "the", *o.lower().split())]
    at -= words[at] != "," and words[at - 1] == ","
    end += words[end : end + 1] == [","]
    return [*words[: host[2]], *joined, "together", *words[host[2] : at], *words[end:]]


def _ends(words: Sequence[str], end: int) -> bool:
    if all(w in CLOSING for w in words[end:]):
        return True
    return words[end] in {",", ".", ";", ":", "!", "?", "to", "by", "up", "down", "left", "right"}


def _read(words: Sequence[str], i: int, lexicon: Lexicon, names: Names) -> _List | None:
    """The things listed at `i`."""
    reader, start = PhraseReader(words, lexicon, names), i
    phrases: list[Phrase] = []
    spans: list[tuple[int, int]] = []
    while i < len(words):
        got = reader.read(i) or _bare(words, i, lexicon, names)
        if got is None or not got[0].nouns:
            break
        phrases.append(got[0])
        spans.append((i, got[1]))
        i = got[1]
        if i >= len(words) or words[i] not in JOINTS:
            break
        after = reader.read(i + 1) or _bare(words, i + 1, lexicon, names)
        if after is None or not after[0].nouns:
            break
        i += 1
    return _List(tuple(phrases), tuple(spans), start, i) if phrases else None


def _bare(words: Sequence[str], i: int, lexicon: Lexicon, names: Names) -> tuple[Phrase, int] | None:
    """A thing named by a single plural that might be a verb: "leaves and all"."""
    word = words[i] if i < len(words) else ""
    nouns = names.hear(word) if word and lexicon.singular(word) != word else None
    return (Phrase(word, nouns=nouns, plural=True), i + 1) if nouns else None


def _before(words: Sequence[str], at: int, lexicon: Lexicon, names: Names) -> tuple[tuple[str, ...], int, int] | None:
    """What the first thing named before `at` means, and where it stands."""
    reader = PhraseReader(words[:at], lexicon, names)
    start = max((i + 1 for i in range(at) if words[i] in (".", ";", "!", "?")), default=0)
    verbs = [i + 1 for i in range(start, at) if any(e.value != "make" for e in lexicon.entries(words[i], "verb"))]
    for i in (*(j for v in verbs[-1:] for j in range(v, at)), *range(start, at)):
        got = reader.read(i)
        if got is None or not got[0].nouns or (i and words[i - 1] == "of"):
            continue
        listed = _read(words[:at], i, lexicon, names)
        try:
            every = [n for p in (listed.phrases if listed else (got[0],)) for n in names.resolve(p)]
        except TranslationError:
            return None
        end = listed.end if listed else got[1]
        return tuple(every), i, end + (words[end : end + 1] == ["together"])
    return None


def _sorted(listed: _List, host: Sequence[str], names: Names) -> tuple[bool, list[tuple[int, int]]]:
    """Whether the host has the listed things, and those that are others' ; nothing where one cannot be found."""
    shapes, others, inside = names.shapes, [], False
    for phrase, span in zip(listed.phrases, listed.spans, strict=True):
        every = replace(phrase, plural=True)
        try:
            found = names.resolve(every, host)
            own = all(any(shapes.part_of(n, h) for h in host) for n in found)
        except TranslationError:
            try:
                found, own = names.resolve(every), False
            except TranslationError:
                return False, []
        if own:
            inside = True
        elif not set(found) & set(host):
            others.append(span)
    return inside, others
