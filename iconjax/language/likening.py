"""Unknown nouns likened to the names that a picture has, by the thesaurus: "the clamp" where there is a bracket."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence

from iconjax.language.lexicon import Entry, Lexicon
from iconjax.language.thesaurus import CLEAR, likeness, speech, verb_like

Words = frozenset[str]
TELLING = frozenset({"modifier", "ordinal", "number", "descriptor", "direction", "orient", "pronoun"})
"""Categories of label words that tell like things apart and are no names."""
LEADING = frozenset(
    {
        "the",
        "a",
        "an",
        "its",
        "their",
        "his",
        "her",
        "this",
        "that",
        "these",
        "those",
        "'s",
        "both",
        "all",
        "each",
        "every",
    }
)
ALIKE, LAST, AGREEING = 0.66, 0.5, 0.2
"""Least likeness that counts; where a single name is left that the request does not use; where only the things of
one name have the modifier that the noun has, or are as many as it says."""
SHORTEST = 3
CHANGING = frozenset({"scale", "move", "rotate"})
"""Families of verbs that an unknown verb may belong to."""
SPATIAL = frozenset(
    {
        "identical", "equal", "similar", "different", "double", "triple", "opposite", "adjacent", "inverse", "reverse",
        "hardly", "barely", "scarcely", "nearly", "almost", "neither", "nor", "nowhere", "halfway", "midway", "apart",
        "aside", "away", "aslant", "askew", "awry", "symmetrical", "proportional", "diagonal", "overhead", "abreast",
        "atop", "invisible", "transparent", "opaque", "translucent", "hidden", "visible", "crossed", "parallel",
        "aloft", "astern", "inside", "outside", "beyond", "underneath", "alike", "unlike", "together", "separate",
    }
)  # fmt: skip
"""Adjectives and adverbs that say something about place, pose, size or appearance, and are never passed over."""
SPATIAL_ENDINGS = ("ward", "wards", "wise", "ways", "fold", "most", "er", "est", "less")


def heads(labels: Iterable[str], lexicon: Lexicon) -> dict[str, Words]:
    """The nouns that the labels of a picture end in, and their names of several words -> the words of a label."""
    out: dict[str, Words] = {}
    for label in labels:
        words = [lexicon.singular(w) for w in re.findall(r"[a-zà-öø-ÿ]+", label.lower())]
        named = [w for w in words if not lexicon.knows(w, TELLING) or len(words) == 1]
        if named and "noun" in speech(named[-1]):
            out[named[-1]] = frozenset(named[-1:])
            if len(named) > 1:
                out[" ".join(named)] = frozenset(named)
    return out


def nominal(words: Sequence[str], lexicon: Lexicon, heard: Iterable[bool]) -> Words:
    """The unknown words of a request that stand where a noun is due.

    Args:
        heard: for each word whether it names something in the picture already.
    """
    known = [*heard, False]
    out = set()
    for i, word in enumerate(words):
        if not word.isalpha() or len(word) < SHORTEST or known[i] or known[i + 1]:
            continue  # before a name it is no name: "wing | mirrors"
        kinds = speech(word)
        if "noun" not in kinds:
            continue
        before = words[i - 1] if i else ""
        led = before in LEADING or lexicon.knows(before, {"modifier", "ordinal", "descriptor", "number", "quantifier"})
        led = led or (i > 0 and not known[i - 1] and speech(before) == {"adj"})
        only = kinds == {"noun"} and not lexicon.knows(word, {"unit", "dim", "side"})
        after = words[i + 1] if i + 1 < len(words) else ""
        opens = (
            not before or before in (",", "and", ".", ";", ":", "!", "?") or lexicon.knows(before, {"verb", "relation"})
        )
        if led or only or (opens and lexicon.singular(word) != word and after and kinds != {"verb"}):
            out.add(word)
    return frozenset(out)


def closest(noun: str, names: Mapping[str, Words], used: Words, agreeing: Words) -> tuple[str, ...]:
    """The name that a noun means, or several that it may mean.

    Args:
        used: words of names that the request uses as they are; another word hardly means the same things.
        agreeing: names of things that have the noun's modifier in theirs ("upper"), or are as many as it says.
    """
    free = {name: words for name, words in names.items() if not words <= used}
    least = LAST if len({min(w) for w in free.values()}) == 1 else ALIKE
    told = [name for name in agreeing & free.keys() if likeness(noun, name) >= AGREEING]
    if len({min(free[name]) for name in agreeing & free.keys()}) == 1 and told:
        return tuple(told[:1])
    every = sorted(((likeness(noun, name), name) for name in free), reverse=True)
    found = [(score, name) for score, name in every if score >= least]
    if len(found) < 2 or found[0][0] - found[1][0] >= CLEAR:
        return tuple(name for _, name in found[:1])
    return tuple(name for score, name in found if found[0][0] - score < CLEAR)


def says_nothing(word: str, attributive: bool) -> bool:
    """Whether an unknown word is an adverb, or an adjective before a name, without anything of place, pose or size."""
    kinds = speech(word)
    plain = bool(kinds) and (kinds <= {"adv"} or (attributive and kinds <= {"adj", "adv"}))
    return plain and word not in SPATIAL and not word.endswith(SPATIAL_ENDINGS)


def known_verb_like(word: str, lexicon: Lexicon) -> Entry | None:
    """The verb of change that shares a sense with an unknown one; None where it may ask for what cannot be done."""
    if (
        "verb" not in speech(word)
        or word.endswith(("er", "est"))
        or verb_like(word, _single(lexicon, "unsupported")) is not None
    ):
        return None
    base = verb_like(word, _single(lexicon, "verb"))
    entry = next((e for e in lexicon.entries(base, "verb") if e.info["base"] == base), None) if base else None
    if entry is None or entry.value not in CHANGING or entry.info.get("cuts") or entry.info.get("place"):
        return None
    if entry.value == "scale" and not entry.info.get("sign"):
        return None
    return Entry(entry.category, entry.value, {**entry.info, "participle": word.endswith("ing")})


def _single(lexicon: Lexicon, category: str) -> Words:
    return frozenset(w[0] for w, entries in lexicon.phrases.items() if len(w) == 1 and _has(entries, category))


def _has(entries: Iterable[Entry], category: str) -> bool:
    return any(e.category == category for e in entries)
