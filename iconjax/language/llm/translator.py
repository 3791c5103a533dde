"""The LLM translator: asks, checks, sends errors back (paper, "Large Language Model for Primary Constraints")."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Generator, Sequence
from dataclasses import dataclass, replace

from iconjax.dsl.parse import parse
from iconjax.dsl.problems import InvalidProgramError
from iconjax.errors import ProgramError, TranslationError
from iconjax.language.base import Reading, SolveReport, Translation, Usage
from iconjax.language.llm.crucial import crucial_by_llm
from iconjax.language.llm.exchange import Client, Exchange, Reply, Turn
from iconjax.language.llm.faults import LlmError
from iconjax.language.llm.jsontext import NotJsonError
from iconjax.language.llm.prompt import repair_text, translation_exchange, unsolved_text
from iconjax.language.llm.reply import Answer, read_reply
from iconjax.language.llm.scene_text import Connections
from iconjax.language.llm.settings import LlmSettings
from iconjax.scene.types import Scene

MOST_ERRORS = 20
Talk = Generator[Exchange, Reply, Translation]
"""A conversation that asks exchanges, is told replies, and ends in a translation: the same for both kinds of client."""


@dataclass(frozen=True)
class Memory:
    """What a translation was made of, to go on from there.

    Attributes:
        scene: the picture.
        exchange: the last question.
        reply: its answer, verbatim.
        solved: whether the model was told the result of a search already.
    """

    scene: Scene
    exchange: Exchange
    reply: str
    solved: bool = False


class AnthropicTranslator:
    """Reads requests with a language model.

    A reply whose program does not parse or type-check goes back with all its errors, at most `settings.repairs` times.
    """

    def __init__(
        self,
        client: Client,
        settings: LlmSettings | None = None,
        connect: Callable[[Scene], Connections] = lambda scene: (),
        name: str = "anthropic",
    ) -> None:
        """`connect` tells which segments of a scene are connected (found by a later stage than this one)."""
        self.name = name
        self.settings = settings or LlmSettings()
        self._client, self._connect = client, connect

    def translate(self, request: str, scene: Scene) -> Translation:
        """Read `request` against `scene`.

        Raises:
            TranslationError: nothing in the request can be done, or (LlmError) the model gave no usable answer.
        """
        return self._drive(self._translate(request, scene))

    async def translate_async(self, request: str, scene: Scene) -> Translation:
        """As `translate`, for many at a time."""
        return await self._drive_async(self._translate(request, scene))

    def translate_many(
        self, items: Sequence[tuple[str, Scene]], at_a_time: int = 4
    ) -> list[Translation | TranslationError]:
        """Read many requests at a time; one that fails gives its error in place of a translation."""

        async def one(gate: asyncio.Semaphore, request: str, scene: Scene) -> Translation | TranslationError:
            async with gate:
                try:
                    return await self.translate_async(request, scene)
                except TranslationError as error:
                    return error

        async def every() -> list[Translation | TranslationError]:
            gate = asyncio.Semaphore(at_a_time)
            return list(await asyncio.gather(*(one(gate, *item) for item in items)))

        return asyncio.run(every())

    def with_readings(self, count: int) -> AnthropicTranslator:
        """This translator, asking for up to `count` different readings of a request."""
        return AnthropicTranslator(self._client, replace(self.settings, readings=count), self._connect, self.name)

    def repair(self, translation: Translation, report: SolveReport) -> Translation:
        """Another program for the same request, after a search that could not fulfil all constraints.

        Happens once: a translation that was repaired like this before comes back as it is, and so does one that is not
        from here or that a search found nothing wrong with.

        Raises:
            TranslationError: as `translate`.
        """
        memory = translation.memory
        if not isinstance(memory, Memory) or memory.solved or not report.missed:
            return translation
        told = (Turn("assistant", memory.reply), Turn("user", unsolved_text(report, memory.scene)))
        exchange = replace(memory.exchange, turns=(*memory.exchange.turns, *told))
        again = self._drive(self._ask(exchange, memory.scene, translation.rounds + 1, translation.usage))
        return replace(again, memory=replace(again.memory, solved=True))

    def crucial(self, scene: Scene, pairs: Sequence[tuple[str, str]]) -> frozenset[frozenset[str]] | None:
        """The connections within objects that hold them together, as the model sees it; None where it is not asked.

        Raises:
            LlmError: no usable answer.
        """
        return crucial_by_llm(scene, pairs, self._client) if self.settings.crucial else None

    def _translate(self, request: str, scene: Scene) -> Talk:
        exchange = translation_exchange(
            request,
            scene,
            self._connect(scene),
            readings=self.settings.readings,
            image=self.settings.image,
            hints=self.settings.hints,
        )
        return self._ask(exchange, scene, 0, Usage())

    def _ask(self, exchange: Exchange, scene: Scene, rounds: int, usage: Usage) -> Talk:
        problems: tuple[str, ...] = ()
        for attempt in range(self.settings.repairs + 1):
            reply = yield exchange
            usage += reply.usage
            answer, problems = judge(reply.text, scene, self.settings.readings)
            if answer is not None:
                done = _translation(answer, scene, self.name)
                memory = Memory(scene, exchange, reply.text)
                return replace(done, rounds=rounds + attempt, usage=usage, memory=memory)
            told = (Turn("assistant", reply.text), Turn("user", repair_text(problems)))
            exchange = replace(exchange, turns=(*exchange.turns, *told))
        more = f" (and {len(problems) - 1} more)" if len(problems) > 1 else ""
        raise LlmError(f"the model gave no valid constraints in {self.settings.repairs + 1} tries: {problems[0]}{more}")

    def _drive(self, talk: Talk) -> Translation:
        try:
            exchange = next(talk)
            while True:
                exchange = talk.send(self._client.send(exchange))
        except StopIteration as end:
            done: Translation = end.value
            return done

    async def _drive_async(self, talk: Talk) -> Translation:
        try:
            exchange = next(talk)
            while True:
                exchange = talk.send(await self._client.send_async(exchange))
        except StopIteration as end:
            done: Translation = end.value
            return done


def judge(text: str, scene: Scene, readings: int = 1) -> tuple[Answer | None, tuple[str, ...]]:
    """The answer in a reply, or all that is wrong with it, in words for the model.

    A reading that is not valid does not spoil one that is, but for the first.

    Raises:
        LlmError: the reply is beyond all limits.
    """
    try:
        answer = read_reply(text, scene.names, readings)
    except NotJsonError as error:
        return None, (str(error),)
    if answer.refusal:
        return answer, ()
    found = [_errors(r, scene) for r in answer.readings]
    if found[0]:
        several = len(found) > 1
        problems = [f"reading {k + 1}, {e}" if several else e for k, errors in enumerate(found) for e in errors]
        return None, tuple(problems[:MOST_ERRORS])
    valid = tuple(r for r, errors in zip(answer.readings, found, strict=True) if not errors)
    return replace(answer, readings=valid), ()


def _errors(reading: Reading, scene: Scene) -> tuple[str, ...]:
    try:
        parse(reading.program, scene.names, scene.objects)
    except InvalidProgramError as error:
        return tuple(map(str, error.problems))
    except ProgramError as error:
        return (str(error),)
    return ()


def _translation(answer: Answer, scene: Scene, name: str) -> Translation:
    if answer.refusal:
        names = ", ".join(scene.names[:30])
        raise TranslationError(f"nothing to do: {answer.refusal} (in the picture: {names})")
    first = answer.readings[0]
    understood = answer.understood or ((first.gloss,) if first.gloss else ())
    return Translation(first.program, name, understood, readings=answer.readings, hints=first.hints)
