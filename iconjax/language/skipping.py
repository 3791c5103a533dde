"""Clauses that tell a story around an instruction: "The sink has to fit a smaller kitchen: take 30 % off its width".

A clause is left aside only where it says nothing about place, pose or size (or says it of what the picture does not
show), holds a word that means nothing here, and another clause is left to ask for something. What it was about is
kept as a topic, so that "its" finds it.
"""

from __future__ import annotations

from collections.abc import Sequence

from iconjax.language.lexicon import Lexicon
from iconjax.language.looks import LINKING, exclaims, only_looks
from iconjax.language.names import THINGS, Names

STRONG = frozenset({".", ";", ":", "!", "?"})
ADJUNCTS = frozenset(
    {"so", "because", "since", "as", "like", "for", "otherwise", "when", "where", "which", "who", "if"}
)
WEIGHTY = frozenset(
    {"number", "fraction", "multiple", "unit", "dim", "sense", "orient", "fixed", "without", "apart", "distance"}
    | {"upside_down", "vague", "direction", "squarely", "mutual", "places", "instead"}
)
"""Categories that say something about place, pose or size."""
PREPOSITIONS = frozenset(
    {"in", "on", "at", "from", "with", "about", "around", "into", "over", "under", "off", "out", "up"}
)
DETERMINERS = frozenset({"the", "a", "an", "this", "that", "these", "those", "its", "his", "her", "their", "such"})
SHORT = 6
"""Words of the longest heading ("nose up:") that may be skipped for one strange word."""
SMALL = frozenset({"a", "an", "one", "no", "only", "just", "all", "too", "like", "way", "much", "far"})


def without_stories(words: Sequence[str], lexicon: Lexicon, names: Names) -> list[str]:
    """The words without clauses that only tell a story; what was left aside is noted."""
    view = _View(lexicon, names)
    words = view.without_looks(view.without_adjunct(words))
    parts = _parts(words)
    kinds = []
    for at, (mark, part) in enumerate(parts):
        heading = at == 0 and len(parts) > 1 and (parts[1][0][:1] != [","] or parts[1][0][1:] == ["so"])
        colon = at + 1 < len(parts) and parts[at + 1][0] == [":"]
        kinds.append(view.kind(part, heading, bool(set(mark) & {"so", "like"}), colon))
    if "story" not in kinds or "instruction" not in kinds:
        return list(words)
    out: list[str] = []
    for at, ((mark, part), kind) in enumerate(zip(parts, kinds, strict=True)):
        if kind != "story":
            out.extend([*mark, *part] if out else part)
            continue
        topic = view.topic(part)
        later = [w for _, p in parts[at + 1 :] for w in p]
        back = (not mark or mark[0] in STRONG) and view.refers_back(later)
        if back and not topic:
            return list(words)  # "it" would be what is not shown
        names.notes.append(f'left aside: "{" ".join(part)}"')
        if back:
            out.extend([*mark, *topic] if out else topic)
            if at + 1 < len(parts) and parts[at + 1][0][:1] == [","]:
                parts[at + 1] = ([":"], parts[at + 1][1])  # "the vane looks stunted, so stretch it"
    return out


def speaks_of_space(words: Sequence[str], lexicon: Lexicon, names: Names) -> bool:
    """Whether anything in a request is about place, pose or size."""
    view = _View(lexicon, names)
    return any(view.spatial(part, i, heading=False) for _, part in _parts(words) for i in range(len(part)))


def _parts(words: Sequence[str]) -> list[tuple[list[str], list[str]]]:
    """Clauses and adjuncts with the words that lead to them."""
    out: list[tuple[list[str], list[str]]] = [([], [])]
    for i, word in enumerate(words):
        after_comma = i > 0 and words[i - 1] == ","
        if word in STRONG or (word == "," and words[i + 1 : i + 2] and words[i + 1] in ADJUNCTS):
            out.append(([word], []))
        elif word in ADJUNCTS and not out[-1][1] and after_comma:
            out[-1][0].append(word)
        elif word in ("so", "because", "since", "otherwise", "like") and out[-1][1]:
            out.append(([word], []))
        else:
            out[-1][1].append(word)
    return [p for p in out if p[1] or p[0]]


class _View:
    def __init__(self, lexicon: Lexicon, names: Names) -> None:
        self.lexicon, self.names = lexicon, names

    def kind(self, part: Sequence[str], heading: bool, follows: bool = False, colon: bool = False) -> str:
        """What a clause is: a "story", an "instruction", or "" where that is open.

        Args:
            heading: it leads to all the others; then its relations to strangers ("fit into a kitchen") ask for nothing
                that the rest does not say.
            follows: it is what comes of the rest ("so the toe comes up").
            colon: it ends in a colon.
        """
        strange = [w for i, w in enumerate(part) if self.strange(w) and not self._in_phrase(part, i)]
        strange = [w for w in strange if not self._names_next(part, part.index(w))]  # "the electric | guitar"
        spatial = any(self.spatial(part, i, heading) for i in range(len(part)))
        looks = heading and any(self.lexicon.knows(w, {"appear"}) for w in part) and not self._measured(part)
        if heading and only_looks(part, self.lexicon, self.names):
            return "story"  # "the tyres look flat"
        short = looks or (heading and colon and len(part) <= SHORT and not self._measured(part))
        doing = any(self.lexicon.knows(w, {"verb"}) or _touches(self.lexicon, w) for w in part)
        if heading and strange and not doing and part[0] in DETERMINERS and self._of_strangers(part):
            return ""  # "the gizmo of the lamp: ..." is what the rest is about
        if heading and len(part) == 1 and self.names.hear(part[0]) is None:
            return "story"  # "storm!"
        if strange and (short or not spatial or ((heading or follows) and self._of_strangers(part))):
            return "story"
        links = any(e.value == LINKING for w in part for e in self.lexicon.entries(w, "verb"))
        if not spatial and links and self.lexicon.knows(part[-1], {"descriptor"}):
            return "story"  # "big eyes are cute"
        if heading and exclaims(part, self.lexicon, self.names) and not self._measured(part):
            return "story"  # "such a big blossom on such a small plant!"
        return "instruction" if spatial and all(self._things_only(w) for w in strange) else ""

    def _measured(self, part: Sequence[str]) -> bool:
        """Whether a clause gives an amount."""
        amounts = {"number", "fraction", "multiple", "unit", "vague"}
        return any(w.isdigit() or (w not in SMALL and self.lexicon.knows(w, amounts)) for w in part)

    def _in_phrase(self, part: Sequence[str], i: int) -> bool:
        """Whether the word at `i` belongs to a phrase of several words that the lexicon knows: "top end"."""
        longest = self.lexicon.longest
        spans = (
            (a, b) for a in range(max(0, i - longest + 1), i + 1) for b in range(max(i, a + 1) + 1, a + longest + 1)
        )
        return any(tuple(part[a:b]) in self.lexicon.phrases for a, b in spans if b <= len(part))

    def strange(self, word: str) -> bool:
        """Whether a word means nothing here."""
        if not word[:1].isalpha() or self.names.hear(word) is not None:
            return False
        return word not in self.lexicon.words or self._things_only(word)

    def _things_only(self, word: str) -> bool:
        kinds = {e.category for e in self.lexicon.phrases.get((word,), ())}
        return bool(kinds) and kinds <= THINGS

    def spatial(self, part: Sequence[str], i: int, heading: bool) -> bool:
        """Whether the word at `i` says something about place, pose or size of what the picture shows."""
        word = part[i]
        if word.isdigit() or word in ("not", "never", "without", "no"):
            return word != "no" or not self._leads_to_stranger(part, i)
        if word in SMALL or self._is_name(part, i):
            return False
        for entry in self.lexicon.phrases.get((word,), ()):
            if entry.category in WEIGHTY:
                return True
            if entry.category in ("adjective", "verb", "relation"):
                idle = entry.category == "verb" and entry.value == LINKING
                idle = idle or (word in PREPOSITIONS and not self._leads_to_name(part, i))
                if entry.category == "adjective" and entry.info.get("degree") == "plain" and self._names_next(part, i):
                    continue
                excused = heading or entry.category == "adjective"
                if not idle and not (excused and self._leads_to_stranger(part, i)):
                    return True
        return False

    def _is_name(self, part: Sequence[str], i: int) -> bool:
        return self.names.hear(part[i]) is not None and i > 0 and part[i - 1] in DETERMINERS

    def _after(self, part: Sequence[str], i: int) -> str:
        """The first word after `i` that is no determiner, preposition or description."""
        loose = {"modifier", "descriptor", "adjective", "relation"}
        for word in part[i + 1 :]:
            known = self.names.hear(word) is not None
            if known or not (word in DETERMINERS or self.lexicon.knows(word, loose)):
                return word
        return ""

    def _names_next(self, part: Sequence[str], i: int) -> bool:
        """Whether a description stands before a name: "big eyes"."""
        return i + 1 < len(part) and self.names.hear(part[i + 1]) is not None

    def _leads_to_stranger(self, part: Sequence[str], i: int) -> bool:
        after = self._after(part, i)
        return bool(after) and self.strange(after)

    def _leads_to_name(self, part: Sequence[str], i: int) -> bool:
        return self.names.hear(self._after(part, i)) is not None

    def _of_strangers(self, part: Sequence[str]) -> bool:
        """Whether a clause is about something that the picture does not show: "a gust hits the boat"."""
        first = next((i for i, w in enumerate(part) if w not in DETERMINERS), 0)
        heavy = any(self.lexicon.knows(w, WEIGHTY - {"direction"}) and w not in SMALL for w in part)
        told = first > 0 and self.strange(part[first]) and len(part) > first + 1
        return told and not heavy and not any(w.isdigit() or w in ("not", "never", "without") for w in part)

    def without_adjunct(self, words: Sequence[str]) -> Sequence[str]:
        """The words without "in the wind" or "for the party" at the end of what says its own amount."""
        last = len(words) - (words[-1:] in (["."], ["!"], ["?"]))
        for i in range(max(1, last - 3), last - 1):
            strange = self.strange(words[last - 1]) and not self._things_only(words[last - 1])
            between = all(w in DETERMINERS for w in words[i + 1 : last - 1])
            if words[i] in ("in", "for", "during") and strange and between and self._measured(words[:i]):
                self.names.notes.append(f'left aside: "{" ".join(words[i:last])}"')
                return [*words[:i], *words[last:]]
        return words

    def without_looks(self, words: Sequence[str]) -> Sequence[str]:
        """ "The tyres look flat, make them ..." is about the tyres."""
        comma = list(words).index(",") if "," in words else 0
        topic = self.topic(words[:comma]) if comma and only_looks(words[:comma], self.lexicon, self.names) else []
        if not topic:
            return words
        self.names.notes.append(f'left aside: "{" ".join(words[:comma])}"')
        return [*topic, ":", *words[comma + 1 :]] if self.refers_back(words[comma + 1 :]) else words[comma + 1 :]

    def topic(self, part: Sequence[str]) -> list[str]:
        """The first thing of the picture that a clause names, with its modifiers."""
        for i, word in enumerate(part):
            grammar = {"verb", "relation", "direction", "adjective"}
            if self.names.hear(word) is None or (self.lexicon.knows(word, grammar) and not self._is_name(part, i)):
                continue
            start = i
            while start > 0 and self.lexicon.knows(part[start - 1], {"modifier", "ordinal"}):
                start -= 1
            start -= start > 0 and self.strange(part[start - 1])  # "the filing cabinet"
            end = i + 1
            while end < len(part) and self.names.hear(part[end]) is not None:
                end += 1
            return ["the", *part[start:end]]
        return []

    def refers_back(self, words: Sequence[str]) -> bool:
        """Whether a pronoun, or nothing, comes before any thing is named."""
        for word in words:
            if self.lexicon.knows(word, {"pronoun"}) and word not in ("this", "that", "these", "those", "one", "rest"):
                return True
            if self.names.hear(word) is not None and not self.lexicon.knows(word, {"verb", "adjective", "direction"}):
                return False
        return True


def _touches(lexicon: Lexicon, word: str) -> bool:
    """Whether a relation is said by a verb: "hits", "reaches"."""
    return any(e.value in ("touch", "reach") for e in lexicon.entries(word, "relation"))
