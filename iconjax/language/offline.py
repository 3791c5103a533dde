"""The built-in translator: a small grammar over a lexicon, which refuses what it does not understand."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import product

from iconjax.errors import TranslationError
from iconjax.language.asides import without_asides
from iconjax.language.base import Translation
from iconjax.language.chunks import Chunk, chunk
from iconjax.language.clauses import Clause
from iconjax.language.context import Context
from iconjax.language.emit import emit
from iconjax.language.explain import describe, refusal
from iconjax.language.frames import SlotFiller, Slots
from iconjax.language.lexicon import Lexicon, lexicon
from iconjax.language.names import Names, Phrase
from iconjax.language.reading import FOLLOWING
from iconjax.language.readings import Reader
from iconjax.language.tidy import tidy
from iconjax.language.words import mend, split_hyphens, tokenise
from iconjax.scene.types import Scene

MOST_JOINTS = 6
Item = Chunk | tuple[Phrase, ...]


class OfflineTranslator:
    """Reads requests about place, pose and size (English) without any model.

    Every word of a request must play a part in its reading; otherwise it is refused, naming the words.
    """

    name = "offline"

    def translate(self, request: str, scene: Scene) -> Translation:
        """Read `request` against `scene`.

        Raises:
            TranslationError: not understood; says what was, which words were not, and which names exist.
        """
        words_of, names = lexicon(), Names(scene, lexicon())
        words = self._words(request, words_of, names)
        understood: list[str] = []
        unknown: list[str] = []
        try:
            chunks = chunk(words, words_of, names)
            unknown = [c.text for c in chunks if c.kind == "unknown"]
            if unknown:
                raise TranslationError(
                    f"no meaning for {', '.join(repr(u) for u in unknown)}" if chunks else "it is empty"
                )
            clauses = tidy(self._read(chunks, words, names, understood))
            _check_guesses(clauses)
            program = emit(clauses, names.shapes)
            if not any(
                c.action not in ("keep", "stay", "topic", "together", "hinge", "go", "turn", "resize") for c in clauses
            ):
                raise TranslationError(
                    "it says what should stay or which way to change, and not what should change by how much"
                )
        except TranslationError as error:
            known = [c.text for c in chunks if c.kind == "phrase"] if not understood and unknown else understood
            raise TranslationError(refusal(str(error), known, unknown, scene.names, scene.objects)) from None
        notes = tuple(dict.fromkeys(names.notes))
        return Translation(program, self.name, (*(describe(c) for c in clauses), *notes))

    def _words(self, request: str, words_of: Lexicon, names: Names) -> list[str]:
        words = split_hyphens(tokenise(request), words_of.words | names.vocabulary)
        out = []
        for word in words:
            if word.isalpha() and word not in words_of.words and names.hear(word) is None:
                known = word in words_of.synonyms or words_of.singular(word) in words_of.synonyms
                better = None if known else mend(word, (w for w in words_of.words if len(w) > 4))
                if better is not None:
                    names.notes.append(f'"{word}" read as "{better}"')
                    word = better
            out.append(word)
        return without_asides(out, words_of, names)

    def _read(self, chunks: Sequence[Chunk], words: Sequence[str], names: Names, understood: list[str]) -> list[Clause]:
        """The first way of joining things with "and" that gives every piece a place."""
        failure: TranslationError | None = None
        for items in _groupings(chunks):
            done: list[Clause] = []
            try:
                reader = Reader(Context(names))
                for slots in _clauses(items, words):
                    done.extend(reader.read(slots))
                if not done:
                    raise TranslationError("nothing in it says what should change")
                return done
            except TranslationError as error:
                if failure is None or len(done) > len(understood):
                    failure, understood[:] = error, [describe(c) for c in done]
        raise failure or TranslationError("it is empty")


def _check_guesses(clauses: Sequence[Clause]) -> None:
    """An amount is not guessed where another clause may give it: "raise A and lower B by 10 px"."""
    unsaid = [c for c in clauses if c.amount is not None and c.amount.mode == "unsaid"]
    told = {c.action for c in clauses if c.amount is not None and not c.amount.vague}
    for clause in unsaid:
        if clause.action in told:
            raise TranslationError(f"how much {' and '.join(clause.theme)} should change is not said")


def _groupings(chunks: Sequence[Chunk]) -> Iterator[list[Item]]:
    """All ways to take "A and B": as one list of things, or as the seam between two clauses."""
    joints = [
        i
        for i in range(1, len(chunks) - 1)
        if chunks[i].kind == "separator"
        and chunks[i].value == "soft"
        and chunks[i - 1].kind == chunks[i + 1].kind == "phrase"
    ][:MOST_JOINTS]
    preferred = [_seam(chunks, i) for i in joints]
    for choice in sorted(
        product((False, True), repeat=len(joints)),
        key=lambda c: sum(a != b for a, b in zip(c, preferred, strict=True)),
    ):
        seams = {j for j, seam in zip(joints, choice, strict=True) if seam}
        yield _join(chunks, set(joints) - seams)


def _seam(chunks: Sequence[Chunk], i: int) -> bool:
    """Whether the "and" at `i` looks like a seam: a relation before it and something to say after it."""
    before = []
    for c in reversed(chunks[:i]):
        if c.kind == "separator":
            break
        before.append(c)
    between = any(c.kind == "relation" and c.value == "between" for c in before)
    related = any(c.kind in ("relation", "as", "than", "direction", "amount", "adjective") for c in before)
    after = chunks[i + 2] if i + 2 < len(chunks) else None
    return related and not between and after is not None and after.kind != "separator"


def _join(chunks: Sequence[Chunk], joints: set[int]) -> list[Item]:
    out: list[Item] = []
    i = 0
    while i < len(chunks):
        c = chunks[i]
        if c.kind == "phrase" and i + 1 in joints:
            phrases = [c.data]
            while i + 1 in joints:
                phrases.append(chunks[i + 2].data)
                i += 2
            out.append(tuple(phrases))
        else:
            out.append(c)
        i += 1
    return out


def _clauses(items: Sequence[Item], words: Sequence[str]) -> Iterator[Slots]:
    """The slots of one clause after another, each with the words that led to it and to the next."""
    groups: list[tuple[str, list[Item]]] = [("", [])]
    for at, item in enumerate(items):
        if isinstance(item, Chunk) and _splits(items, at):
            text = item.text if item.kind == "separator" else "and" if item.kind == "verb" else "without"
            if item.kind == "mode":
                text = "by" if item.text == "by" else "until"
            if groups[-1][1]:
                groups.append((text, []))
            elif groups[-1][0] in ("", ",", "and"):
                groups[-1] = (text, [])
            if item.kind in ("without", "verb"):
                groups[-1][1].append(item)
            continue
        groups[-1][1].append(item)
    groups = [g for g in groups if any(not (isinstance(c, Chunk) and c.kind == "instead") for c in g[1])]
    for at in range(1, len(groups) - 1):
        # "shrink it, without distorting it, until ...": what follows belongs to what was before
        if groups[at][0] == "without" and groups[at + 1][0] in FOLLOWING:
            groups[at], groups[at + 1] = groups[at + 1], groups[at]
    for index, (connector, group) in enumerate(groups):
        try:
            slots = SlotFiller(group).fill()
        finally:
            pass
        slots.connector = connector
        slots.follows = groups[index + 1][0] if index + 1 < len(groups) else ""
        first = next((c.start for c in group if isinstance(c, Chunk)), 0)
        last = max((c.start for c in group if isinstance(c, Chunk)), default=first)
        slots.text = " ".join(words[first : last + 3])
        yield slots


def _splits(items: Sequence[Item], at: int) -> bool:
    """Whether the piece begins a new clause."""
    item = items[at]
    assert isinstance(item, Chunk)
    if item.kind == "without":
        # "while the pot does not change": the thing is that of the denial
        return not (_kind(items, at - 1) == "phrase" and (at == 1 or _is_separator(items[at - 2])))
    if item.kind == "mode":
        following = items[at + 1] if at + 1 < len(items) else None
        doing = isinstance(following, Chunk) and following.kind == "verb" and bool(following.data.info["participle"])
        return item.text.startswith("until") or (item.text == "by" and doing)
    if item.kind == "verb":
        # "..., keeping its base in place" also without a comma
        subject = at > 1 and _kind(items, at - 1) == "phrase" and _is_separator(items[at - 2])
        return (
            item.value == "keep"
            and bool(item.data.info["participle"])
            and at > 0
            and not _is_separator(items[at - 1])
            and not subject
        )
    if item.kind != "separator":
        return False
    if item.value == "hard":
        return True
    before, after = _kind(items, at - 1), _kind(items, at + 1)
    if item.text == "-":
        return False
    same = before == after and before in ("verb", "direction", "dim", "adjective", "sense")
    if before == after == "dim" or (before == after == "verb"):
        return False
    return not (same and before == "adjective" and not _amount_before(items, at)) or (
        same and before == "direction" and False
    )


def _amount_before(items: Sequence[Item], at: int) -> bool:
    return _kind(items, at - 2) == "amount"


def _is_separator(item: Item) -> bool:
    return isinstance(item, Chunk) and item.kind in ("separator", "without")


def _kind(items: Sequence[Item], at: int) -> str:
    if not 0 <= at < len(items):
        return ""
    item = items[at]
    return item.kind if isinstance(item, Chunk) else "phrase"
