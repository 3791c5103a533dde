"""Record and replay, and the prompts that go out and come back as files."""

from __future__ import annotations

import asyncio
import hashlib
import importlib.util
import json
from dataclasses import replace
from pathlib import Path

import pytest
from edit_support import REQUEST as CASE_REQUEST
from edit_support import write_case
from llm_server import CONNECTIONS, GOOD, KEY, REQUEST, Scripted, answer, lamp, message, serving

from iconjax.errors import ConfigError, InputError
from iconjax.language.base import Usage
from iconjax.language.llm.client import AnthropicClient
from iconjax.language.llm.exchange import Reply
from iconjax.language.llm.faults import LlmError
from iconjax.language.llm.prompt import translation_exchange
from iconjax.language.llm.record import MissingRecordingError, Recorder, Replayer, read_recording, write_recording
from iconjax.language.llm.settings import LlmSettings
from iconjax.language.llm.translator import AnthropicTranslator

BAD = ['translate("Lamp:Shad")']


def exchange(request=REQUEST, **more):
    return translation_exchange(request, lamp(), CONNECTIONS, **more)


def reader(client, **settings):
    return AnthropicTranslator(client, LlmSettings(**settings), lambda scene: CONNECTIONS)


def test_record_then_replay_without_network(tmp_path, monkeypatch):
    monkeypatch.setenv("ANTHROPIC_API_KEY", KEY)
    with serving(message(answer(BAD)), message(answer(GOOD))) as server:
        client = AnthropicClient(LlmSettings(base_url=server.url), wait=lambda s: None)
        live = reader(Recorder(client, tmp_path / "new" / "folder")).translate(REQUEST, lamp())
    monkeypatch.delenv("ANTHROPIC_API_KEY")
    monkeypatch.setattr("socket.socket.connect", None)
    played = reader(Replayer(tmp_path / "new" / "folder")).translate(REQUEST, lamp())
    assert (played.program, played.rounds, played.usage) == (live.program, 1, live.usage)
    for path in tmp_path.rglob("*"):
        assert not path.is_file() or KEY not in path.read_text()


def test_a_recording_is_readable_and_whole(tmp_path):
    path = write_recording(tmp_path, exchange(), Reply(answer(GOOD), "some-model", Usage(1, 2, 3, 4)))
    record = json.loads(path.read_text())
    assert record["request"] == REQUEST and record["model"] == "some-model" and record["reply"] == answer(GOOD)
    assert record["key"] == exchange().key and path.name == f"translate-{exchange().key[:20]}.json"
    assert record["messages"][0]["text"] == exchange().turns[0].text
    assert (tmp_path / record["system"]).read_text() == exchange().system
    assert sorted(p.name for p in tmp_path.iterdir()) == sorted([path.name, record["system"]])  # nothing half-written


def test_the_same_in_a_batch(tmp_path):
    items = [(REQUEST, lamp()), ("stretch it", lamp())]
    reader(Recorder(Scripted([answer(GOOD)] * 2), tmp_path)).translate_many(items)
    assert [t.program for t in reader(Replayer(tmp_path)).translate_many(items)] == [tuple(GOOD)] * 2


class TestKey:
    def test_is_that_of_the_prompt_alone(self):
        one = exchange()
        assert one.key == exchange().key == replace(one, purpose="other", summary="other").key
        assert len({one.key, exchange("turn it").key, exchange(hints=True).key, exchange(readings=2).key}) == 4

    def test_knows_pictures_by_what_they_show(self):
        one, again = exchange(image=True), exchange(image=True)
        picture = one.turns[0].picture
        other_bytes = replace(picture, png=picture.png + b"x")
        assert one.key == again.key != exchange().key
        assert replace(one, turns=(replace(one.turns[0], picture=other_bytes),)).key == one.key

    def test_does_not_depend_on_the_process(self):
        """Recordings live in a repository: a key computed elsewhere has to be the same."""
        small = replace(exchange(), system="s", schema={"b": 1, "a": 2})
        small = replace(small, turns=(replace(small.turns[0], text="ä"),))
        canonical = '{"messages":[{"role":"user","text":"ä"}],"schema":{"a":2,"b":1},"system":"s"}'
        assert small.key == hashlib.sha256(canonical.encode()).hexdigest()


class TestMissing:
    def test_names_the_request_and_the_key(self, tmp_path):
        with pytest.raises(MissingRecordingError, match=REQUEST) as caught:
            reader(Replayer(tmp_path)).translate(REQUEST, lamp())
        assert exchange().key[:20] in str(caught.value) and caught.value.exchange.key == exchange().key
        with pytest.raises(MissingRecordingError):
            asyncio.run(Replayer(tmp_path).send_async(exchange()))

    def test_no_folder(self, tmp_path):
        with pytest.raises(ConfigError, match="no folder"):
            Replayer(tmp_path / "none")

    @pytest.mark.parametrize(
        "text",
        ["", "{", "[]", "3", '{"key": "other"}', '{"reply": "x"}', "[" * 100_000, '{"key": KEY, "reply": 3}',
         '{"key": KEY, "reply": "x", "usage": {"password": 1}}', '{"key": KEY, "reply": "x", "usage": 3}'],
    )  # fmt: skip
    def test_damaged(self, tmp_path, text):
        path = write_recording(tmp_path, exchange(), Reply("x"))
        path.write_text(text.replace("KEY", json.dumps(exchange().key)))
        with pytest.raises(LlmError, match="cannot be used"):
            read_recording(tmp_path, exchange())

    def test_nowhere_to_write(self, tmp_path):
        (tmp_path / "file").write_text("")
        with pytest.raises(InputError, match="cannot write"):
            write_recording(tmp_path / "file", exchange(), Reply("x"))


@pytest.fixture(scope="module")
def script():
    """`eval/llm_prompts.py` as a module."""
    path = Path(__file__).parents[1] / "eval" / "llm_prompts.py"
    spec = importlib.util.spec_from_file_location("llm_prompts", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_prompts_out_and_replies_in(script, tmp_path):
    """Round by round, until a case needs no further prompt; then the replayed translation is that of the replies."""
    case, out, record = write_case(tmp_path / "cases" / "lamp"), tmp_path / "out", tmp_path / "record"
    settings = LlmSettings(image=True)

    def prompts():
        return script.write_prompts([case.parent], out, settings, record, False)

    for reply in (answer(BAD), answer(GOOD)):
        assert prompts() == 1
        assert prompts() == 1  # writing again changes nothing
        assert CASE_REQUEST in (out / "lamp.prompt.md").read_text()
        (out / "lamp.reply.json").write_text(reply + "\n")
        assert prompts() == 1 and (out / "lamp.reply.json").exists()  # a reply waits to be collected
        assert script.collect(out, record, "some-model") == 1
    assert "Lamp:Shad" in (out / "lamp.prompt.md").read_text()  # the second prompt shows the first reply
    assert prompts() == 0
    assert (out / "lamp.png").read_bytes().startswith(b"\x89PNG") and (out / "system.md").exists()


def test_a_prompt_that_was_changed_is_not_collected(script, tmp_path):
    script.write_prompt(tmp_path, "lamp", exchange())
    path = tmp_path / "lamp.exchange.json"
    path.write_text(path.read_text().replace(REQUEST, "something else"))
    (tmp_path / "lamp.reply.json").write_text(answer(GOOD))
    with pytest.raises(ValueError, match="was changed"):
        script.collect(tmp_path, tmp_path / "record", "")
