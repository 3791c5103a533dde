"""Noun phrases: "the left leg of the table", "both windows", "its bottom"."""

from __future__ import annotations

from collections.abc import Sequence

from iconjax.errors import TranslationError
from iconjax.language.names import Phrase
from iconjax.language.nouns import NounReader, with_

TELLING = {
    **{kind: kind for kind in ("on", "inside", "above", "below", "left_of", "right_of", "touch")},
    "around": "touch",
    "beside": "touch",
}
"""Relations that may tell which of several like things is meant, and how they are checked."""
DETERMINERS = frozenset({"the", "a", "an", "this", "that", "these", "those"})
POSSESSIVES = frozenset({"its", "their", "his", "her"})


class PhraseReader(NounReader):
    """Reads noun phrases, with their owners and sides, at given places of a request."""

    def read(self, i: int) -> tuple[Phrase, int] | None:
        """The longest noun phrase that begins at `i`, and where it ends."""
        start = i
        got = self._core(i)
        if got is None:
            return None
        phrase, i = got
        while self.word(i) == "'s" or (phrase.pronoun is None and phrase.side is None and self.word(i) == "of"):
            if self.word(i) == "'s":
                after = self._possessed(i + 1, phrase)
                if after is None and phrase.nouns and self.word(i + 1) in ("", ".", ",", ";", "and", "!"):
                    after = Phrase("", owner=phrase), i + 1  # "as wide as the queen's"
                if after is None:
                    break
                phrase, i = after
            else:
                owner = self.read(i + 1)
                strange = self._stranger(i + 2) if self.word(i + 1) == "the" else ()
                if owner is None and strange and phrase.nouns and not phrase.owner:
                    phrase, i = with_(phrase, ignored=strange, foreign=True), i + 2 + len(strange)
                    break
                if owner is None or owner[0].pronoun not in (None, "it", "them"):
                    break
                phrase, i = with_(phrase, owner=owner[0]), owner[1]
        phrase, i = self._told_apart(phrase, i)
        return with_(phrase, text=" ".join(self.words[start:i]).replace(" 's", "'s")), i

    def _told_apart(self, phrase: Phrase, i: int) -> tuple[Phrase, int]:
        """ "The band | on the cup": of several bands the one that is there, where it is one."""
        if phrase.owner or phrase.side or not phrase.nouns or phrase.modifiers or phrase.ordinal:
            return phrase, i
        relation = self.lexicon.match(self.words, i, "relation")
        if relation is None or relation[0].value not in TELLING or len(self.names.like(phrase)) < 2:
            return phrase, i
        whole = self.read(relation[1])
        if whole is None or not whole[0].nouns or whole[0].side:
            return phrase, i
        for owner in self._owners_there(phrase, TELLING[relation[0].value], whole[0]):
            return with_(phrase, owner=owner), whole[1]
        return phrase, i

    def _owners_there(self, phrase: Phrase, kind: str, whole: Phrase) -> list[Phrase]:
        """The owner of the only one of several like things that is in a relation to another thing."""
        try:
            others = self.names.resolve(whole)
        except TranslationError:
            return []
        shapes, like = self.names.shapes, self.names.like(phrase)
        if len(others) != 1:
            return []
        own = [n for n in like if kind in ("on", "inside", "touch") and shapes.part_of(n, others[0])]
        if phrase.plural:
            return [whole] if own and len(own) < len(like) else []  # "the boxes in the upper row"
        there = own or [n for n in like if shapes.lies(n, kind, others[0]) and not shapes.part_of(n, others[0])]
        if len(there) != 1 or ":" not in there[0]:
            return []
        owner = Phrase("", nouns=tuple(shapes.segments(there[0])[0].object.lower().split()))
        try:
            told = self.names.resolve(with_(phrase, owner=owner), self.names.resolve(owner))
        except TranslationError:
            return []
        return [owner] if told == (there[0],) else []

    def _stranger(self, i: int) -> tuple[str, ...]:
        """Up to two words at `i` that name nothing here, where the name of a thing is due: "the scales"."""
        out: tuple[str, ...] = ()
        while len(out) < 2:
            word = self.word(i + len(out))
            kinds = {e.category for e in self.lexicon.phrases.get((word,), ())}
            doing = bool(kinds) and kinds <= {"verb", "kind"}
            doing = doing and (not out or "verb" not in kinds)
            if self.strange(i + len(out)) or (doing and self.names.hear(word) is None):
                out = (*out, word)
            else:
                break
        return out

    def _loose(self, i: int) -> tuple[Phrase, int] | None:
        """A spot on a thing that the picture does not tell apart: "rim of the bowl", "hole in the post"."""
        spot = self.word(i)
        if not self.lexicon.knows(spot, {"loose"}) or self.names.hear(spot) is not None:
            return None
        if self.word(i + 1) not in ("of", "in", "on", "at"):
            return None
        whole = self.read(i + 2)
        if whole is None or whole[0].pronoun or whole[0].special or whole[0].side:
            return None
        return with_(whole[0], loose=spot), whole[1]

    def _of_stranger(self, i: int) -> tuple[Phrase, int] | None:
        """ "(the) barrier's arm" where nothing is called a barrier."""
        foreign = self._stranger(i)
        if not foreign or self.word(i + len(foreign)) != "'s":
            return None
        found = self.body(i + len(foreign) + 1, True)
        if found is None or found[0].ignored:
            return None
        return with_(found[0], ignored=foreign, foreign=True), found[1]

    def _core(self, i: int) -> tuple[Phrase, int] | None:
        start, plural, announced, quantified = i, False, False, False
        owner: Phrase | None = None
        count: int | None = None
        quant = self.lexicon.match(self.words, i, "quantifier")
        if quant is not None:
            plural, announced, quantified, i = True, True, True, quant[1]
        if self.word(i) in POSSESSIVES:
            owner = Phrase(self.word(i), pronoun="it" if self.word(i) != "their" else "them")
            announced, i = True, i + 1
        elif self.word(i) in DETERMINERS:
            announced, i = True, i + 1
        if self.lexicon.knows(self.word(i), {"number"}) and self.word(i) not in ("one", "a", "an"):
            number = self.lexicon.match([self.word(i)], 0, "number")
            if number is not None and self.noun_follows(i + 1):
                plural, count, i = True, int(number[0].value), i + 1
        indefinite = None
        if self.word(i) in ("one", "another") and not announced and self.noun_follows(i + 1):
            indefinite, announced, i = "one", True, i + 1
        if self.word(start) in DETERMINERS and (odd := self._loose(i) or self._of_stranger(i)) is not None:
            return odd
        side = self._side(i, announced, owner)
        if side is not None:
            return side
        found = self.body(i, announced)
        if found is not None:
            phrase, i = found
            phrase = with_(phrase, indefinite=phrase.indefinite or indefinite)
            return with_(phrase, owner=owner, plural=phrase.plural or plural, count=count), i
        extreme = self._extreme(i) if announced and owner is None and not quantified else None
        return extreme or self._every(start, i, quant is not None) or self._pronoun_at(start)

    def _extreme(self, i: int) -> tuple[Phrase, int] | None:
        """ "(As long as) the rightmost"."""
        got = self.lexicon.match([self.word(i)], 0, "modifier") if self.word(i).endswith("most") else None
        return None if got is None else (Phrase("", modifiers=(got[0].value,)), i + 1)

    def _every(self, start: int, i: int, quantified: bool) -> tuple[Phrase, int] | None:
        """ "All of them", "both"."""
        if quantified and self.word(i) in ("them", "it"):
            return Phrase("them", pronoun="them", plural=True), i + 1
        if quantified and self.word(start) in ("both", "each", "all") and self.word(i - 1) != "the":
            return Phrase(self.word(start), pronoun="them", plural=True), i
        return None

    def _pronoun_at(self, start: int) -> tuple[Phrase, int] | None:
        word = self.word(start)
        if word in ("that", "those") and self.word(start + 1) == "of":
            return Phrase(word), start + 1  # "that of the king": the same part, of another
        pronoun = self.lexicon.match(self.words, start, "pronoun")
        if pronoun is None or pronoun[0].value not in ("it", "them"):
            return None
        return Phrase(word, pronoun=pronoun[0].value, plural=pronoun[0].value == "them"), pronoun[1]

    def _side(self, i: int, announced: bool, owner: Phrase | None) -> tuple[Phrase, int] | None:
        """A side of something: "the left end of the belt", "its bottom", "the top right corner"."""
        got = self.lexicon.match(self.words, i, "side")
        if got is None:
            return None
        side, end = got[0].value, got[1]
        known = all(self.names.hear(w) for w in self.words[i:end])
        if self.noun_at(end, False) or (known and self.word(end) not in ("of", "'s") and owner is None):
            return None
        if self.word(end) == "of":
            whole = self.read(end + 1)
            if whole is not None and not (known and self._names_part(whole[0], self.words[i:end])):
                return Phrase("", side=side, owner=whole[0]), whole[1]
            return None
        if owner is not None and known:
            return None
        if announced or end - i > 1 or owner is not None:
            return Phrase("", side=side, owner=owner), end
        return None

    def _possessed(self, i: int, owner: Phrase) -> tuple[Phrase, int] | None:
        spot = self.word(i)
        if self.lexicon.knows(spot, {"loose"}) and self.names.hear(spot) is None and owner.nouns:
            return with_(owner, loose=spot), i + 1
        side = self.lexicon.match(self.words, i, "side")
        alone = side is not None and not self.noun_at(side[1], False)
        if side is not None and alone and not self._has_part(owner, self.words[i : side[1]]):
            return Phrase("", side=side[0].value, owner=owner), side[1]
        number = self.lexicon.match([spot], 0, "number")
        count = int(number[0].value) if number is not None and self.noun_follows(i + 1) else None
        body = self.body(i if count is None else i + 1, True)
        if body is None:
            return None
        plural = body[0].plural or count is not None
        return with_(body[0], owner=owner, count=count, plural=plural), body[1]  # "the bed's two legs"

    def _names_part(self, owner: Phrase, words: Sequence[str]) -> bool:
        """Whether words for a side are, of this owner, the name of a part: "both feet of the tub"."""
        if self._has_part(owner, words):
            return True
        heard = tuple(h for w in words for h in self.names.hear(w) or ())
        if not heard or owner.pronoun or owner.special or not owner.nouns:
            return False
        wholes = {n.split(":")[0] for n in self.names.like(owner)}
        return any(":" in n and n.split(":")[0] in wholes for n in self.names.like(Phrase("", nouns=heard)))

    def _has_part(self, owner: Phrase, words: Sequence[str]) -> bool:
        if owner.pronoun or owner.special:
            return False
        heard = [h for w in words for h in self.names.hear(w) or ("",)]
        objects = {w for e in self.names.objects for w in e.words} & set(owner.nouns)
        return any(set(heard) <= e.part_words and (not objects or objects & e.object_words) for e in self.names.parts)
