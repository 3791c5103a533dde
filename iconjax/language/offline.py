"""The built-in translator: a grammar over a lexicon, which refuses what it does not understand."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass

from lark import Token, Tree

from iconjax.errors import TranslationError
from iconjax.language.alternatives import variants
from iconjax.language.asides import without_asides
from iconjax.language.base import Reading, Translation
from iconjax.language.canonical import canonical
from iconjax.language.chunks import Chunk, chunk
from iconjax.language.clauses import Clause
from iconjax.language.consistency import check_values
from iconjax.language.context import Context
from iconjax.language.emit import emit
from iconjax.language.explain import describe, refusal
from iconjax.language.grammar import Misfit, parses
from iconjax.language.lexicon import Lexicon, lexicon
from iconjax.language.names import Names
from iconjax.language.readings import Reader
from iconjax.language.sentence import clauses_of
from iconjax.language.skipping import speaks_of_space
from iconjax.language.tidy import tidy
from iconjax.language.words import mend, split_hyphens, tokenise
from iconjax.scene.types import Scene

IDLE = frozenset({"keep", "stay", "topic", "together", "hinge", "go", "turn", "resize"})
"""Actions that alone ask for no change, or for none of a known size."""


class OfflineTranslator:
    """Reads requests about place, pose and size (English) without any model.

    Every word of a request must play a part in its reading; otherwise it is refused, naming the words.

    Args:
        readings: most different readings to give, best first.
    """

    name = "offline"

    def __init__(self, readings: int = 1) -> None:
        self.readings = max(1, readings)

    def with_readings(self, count: int) -> OfflineTranslator:
        """A translator that gives up to `count` different readings of a request."""
        return OfflineTranslator(count)

    def translate(self, request: str, scene: Scene) -> Translation:
        """Read `request` against `scene`.

        Raises:
            TranslationError: not understood; says what was, which words were not, and which names exist.
        """
        search = self._search(request, scene, {})
        found: list[_Found] = []
        try:
            self._collect(search, found)
        except TranslationError as error:
            if self.readings > 1:
                self._choose(request, scene, search.names, found)
            if not found:
                reason = str(error)
                if "iconjax" not in reason and not speaks_of_space(search.words, lexicon(), search.names):
                    reason += "; iconjax moves, turns and scales what is in the picture"
                refused = refusal(reason, search.understood, search.unknown, scene.names, scene.objects)
                raise TranslationError(refused) from None
        first, *_ = found
        several = tuple(Reading(r.gloss, r.program) for r in found) if len(found) > 1 else ()
        return Translation(first.program, self.name, (*first.lines, *first.notes), readings=several)

    def _search(self, request: str, scene: Scene, choices: Mapping[str, str]) -> _Search:
        names = Names(scene, lexicon(), choices)
        return _Search(_words(request, lexicon(), names), names, several=self.readings > 1)

    def _collect(self, search: _Search, found: list[_Found]) -> None:
        """Add the different readings of a search, as many as are wanted."""
        known = {frozenset(map(canonical, reading.program)) for reading in found}
        for reading in search.readings():
            meaning = frozenset(map(canonical, reading.program))
            if meaning not in known:
                known.add(meaning)
                found.append(reading)
            if len(found) >= self.readings:
                return

    def _choose(self, request: str, scene: Scene, names: Names, found: list[_Found]) -> None:
        """One reading for each of the things that the last doubtful phrase could be."""
        text, could_be = next(reversed(names.doubts.items()), ("", ()))
        for name in could_be[: self.readings]:
            with suppress(TranslationError):
                search = self._search(request, scene, {text: name})
                found.append(next(search.readings()))


@dataclass(frozen=True)
class _Found:
    """A reading: its program, a line for each clause, and what had to be assumed."""

    program: tuple[str, ...]
    lines: tuple[str, ...]
    notes: tuple[str, ...]

    @property
    def gloss(self) -> str:
        return "; ".join(self.lines)


class _Search:
    """The readings of a request, and what was understood of it where there are none.

    Attributes:
        understood: what the attempt that came furthest says, clause by clause.
        unknown: words without a meaning or a place in it.
    """

    def __init__(self, words: Sequence[str], names: Names, several: bool = False) -> None:
        self.words, self.names, self.several = words, names, several
        self.understood: list[str] = []
        self.unknown: list[str] = []
        self.failure: TranslationError | None = None

    def readings(self) -> Iterator[_Found]:
        """Readings, best first, equal ones among them; at least one.

        Raises:
            TranslationError: none; why the attempt that came furthest has no reading.
        """
        some = False
        cut: list[list[str]] = []
        for things_first in (False, True):
            try:
                pieces = self._pieces(things_first)
                if [c.kind for c in pieces] in cut:
                    continue
                cut.append([c.kind for c in pieces])
                notes = tuple(self.names.notes)
                for tree in parses(pieces):
                    self.names.notes[:] = notes
                    for found in self._read(tree):
                        some = True
                        yield found
            except TranslationError as error:
                self._fail(error, [])
            if some:
                return
        raise self.failure or TranslationError("it is empty")

    def _pieces(self, things_first: bool) -> list[Chunk]:
        pieces = chunk(self.words, self.names.lexicon, self.names, things_first)
        unknown = [c.text for c in pieces if c.kind == "unknown"]
        if unknown:
            if self.failure is None:
                self.unknown, self.understood = unknown, [c.text for c in pieces if c.kind == "phrase"]
            raise TranslationError(f"no meaning for {', '.join(map(self._told, unknown))}")
        return pieces

    def _told(self, word: str) -> str:
        """An unknown word, with the names that it may mean."""
        perhaps = self.names.hearing.perhaps.get(word, ())
        return repr(word) + (f" (it may be {' or '.join(map(repr, perhaps))})" if perhaps else "")

    def _read(self, tree: Tree[Token]) -> Iterator[_Found]:
        """What a parse says and, where several readings are wanted, what else it may say."""
        done: list[Clause] = []
        try:
            reader = Reader(Context(self.names))
            for slots in clauses_of(tree, self.words):
                done.extend(reader.read(slots))
            clauses = tidy(done)
            every = variants(clauses) if self.several else [clauses]
            for one in every:
                program = _program(one, self.names)
                lines = tuple(describe(c) for c in one)
                yield _Found(program, lines, tuple(dict.fromkeys(self.names.notes)))
        except TranslationError as error:
            self._fail(error, [describe(c) for c in done])

    def _fail(self, error: TranslationError, understood: list[str]) -> None:
        """Remember the failure of the attempt that came furthest."""
        if self.failure is None or len(understood) > len(self.understood):
            self.failure = error
            self.understood = understood or self.understood
            self.unknown = [error.words] if isinstance(error, Misfit) and error.words else self.unknown


def _program(clauses: Sequence[Clause], names: Names) -> tuple[str, ...]:
    if not clauses:
        raise TranslationError("nothing in it says what should change")
    _check_guesses(clauses)
    program = emit(clauses, names.shapes)
    check_values(program)
    if all(c.action in IDLE for c in clauses):
        raise TranslationError(
            "it says what should stay or which way to change, and not what should change by how much"
        )
    return program


def _check_guesses(clauses: Sequence[Clause]) -> None:
    """An amount is not guessed where another clause may give it: "raise A and lower B by 10 px"."""
    unsaid = [c for c in clauses if c.amount is not None and c.amount.mode == "unsaid"]
    told = {c.action for c in clauses if c.amount is not None and not c.amount.vague}
    for clause in unsaid:
        if clause.action in told:
            raise TranslationError(f"how much {' and '.join(clause.theme)} should change is not said")


def _words(request: str, words_of: Lexicon, names: Names) -> list[str]:
    """The words of a request, typing errors mended and asides left out."""
    out = []
    words = split_hyphens(tokenise(request), words_of.words | names.vocabulary)
    names.hearing.listen(words)
    for word in words:
        if word.isalpha() and word not in words_of.words and names.hear(word) is None:
            known = word in words_of.synonyms or words_of.singular(word) in words_of.synonyms or word.endswith("ing")
            known = known or word in names.hearing.nominal
            better = None if known else mend(word, (w for w in words_of.words if len(w) > 4))
            if better is not None:
                names.notes.append(f'"{word}" read as "{better}"')
                word = better
        out.append(word)
    return without_asides(out, words_of, names)
