"""The real SDK against a local server: what goes out, and what becomes of everything that can come back."""

from __future__ import annotations

import asyncio
import logging
import pickle
import traceback
from itertools import pairwise

import pytest
from llm_server import (
    CONNECTIONS,
    GOOD,
    KEY,
    REQUEST,
    answer,
    cut,
    lamp,
    message,
    raw,
    serving,
    slow,
    status,
)

from iconjax.errors import ConfigError, IconjaxError
from iconjax.language.llm.client import AnthropicClient
from iconjax.language.llm.faults import LlmError
from iconjax.language.llm.prompt import translation_exchange
from iconjax.language.llm.retry import LONGEST_WAIT, pause, retry_after
from iconjax.language.llm.settings import LlmSettings


@pytest.fixture(autouse=True)
def planted(monkeypatch):
    """One credential, and no other."""
    for name in ("ANTHROPIC_AUTH_TOKEN", "ANTHROPIC_PROFILE", "ANTHROPIC_BASE_URL"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("NO_PROXY", "127.0.0.1")
    monkeypatch.setenv("ANTHROPIC_API_KEY", KEY)


def exchange(**more):
    return translation_exchange(REQUEST, lamp(), CONNECTIONS, **more)


def client(server, waits=None, **settings):
    """A client whose waiting is only noted down."""
    waits = [] if waits is None else waits

    async def wait_async(seconds):
        waits.append(seconds)

    given = {"timeout": 5.0, "retries": 2} | settings
    return AnthropicClient(LlmSettings(base_url=server.url, **given), wait=waits.append, wait_async=wait_async)


def failure(*script, waits=None, **settings) -> str:
    """The message with which an exchange ends."""
    with serving(*script) as server, pytest.raises(LlmError) as caught:
        client(server, waits, **settings).send(exchange())
    return one_clear_line(caught.value)


def one_clear_line(error: IconjaxError) -> str:
    text = str(error)
    assert text.isprintable() and 10 < len(text) < 420
    return text


def test_a_message_goes_out_and_a_reply_comes_back():
    with serving(message(answer(GOOD))) as server:
        reply = client(server, effort="high", model="some-model").send(exchange())
    assert reply.text == answer(GOOD) and reply.model == "model-of-the-test"
    usage = reply.usage
    assert (usage.input_tokens, usage.output_tokens, usage.cache_read_tokens, usage.cache_write_tokens) == (11, 7, 5, 3)
    asked = server.requests[0]
    assert asked.path == "/v1/messages" and KEY in str(asked.headers)
    assert asked.body["model"] == "some-model" and asked.body["output_config"]["effort"] == "high"
    assert asked.body["messages"][0]["content"][0]["text"] == exchange().turns[0].text


def test_the_constant_part_is_marked_for_the_cache_and_holds_nothing_of_the_request():
    with serving(message(answer(GOOD))) as server:
        client(server).send(exchange())
    system = server.requests[0].body["system"]
    assert system[-1]["cache_control"] == {"type": "ephemeral"}
    assert "Lamp:Shade" not in system[-1]["text"] and REQUEST not in system[-1]["text"]
    assert "cache_control" not in str(server.requests[0].body["messages"])


def test_the_schema_is_one_that_structured_output_allows():
    with serving(message(answer(GOOD))) as server:
        client(server).send(exchange(hints=True))
    form = server.requests[0].body["output_config"]["format"]
    assert form["type"] == "json_schema"
    objects = list(_objects(form["schema"]))
    assert len(objects) == 3  # the reply, a reading, a hint
    for one in objects:
        assert one["additionalProperties"] is False and set(one["required"]) == set(one["properties"])
    assert not {"maxItems", "maxLength", "minimum", "maximum"} & set(_keys(form["schema"]))


def _objects(schema):
    if isinstance(schema, dict):
        if schema.get("type") == "object":
            yield schema
        for value in schema.values():
            yield from _objects(value)


def _keys(schema):
    if isinstance(schema, dict):
        yield from schema
        for value in schema.values():
            yield from _keys(value)


def test_the_picture_goes_before_the_words():
    with serving(message(answer(GOOD))) as server:
        client(server).send(exchange(image=True))
    picture, text = server.requests[0].body["messages"][0]["content"]
    assert picture["source"]["media_type"] == "image/png" and text["type"] == "text"


def test_many_at_a_time():
    with serving(message(answer(GOOD))) as server:
        asking = client(server)

        async def both():
            return await asyncio.gather(asking.send_async(exchange()), asking.send_async(exchange()))

        replies = asyncio.run(both())
    assert [r.text for r in replies] == [answer(GOOD)] * 2


class TestBusy:
    def test_retry_after_is_honoured(self):
        waits = []
        with serving(status(429, retry_after="7"), status(429, retry_after="0.25"), message(answer(GOOD))) as server:
            client(server, waits).send(exchange())
        assert waits == [7.0, 0.25]

    def test_the_same_in_a_batch(self):
        waits = []
        with serving(status(429, retry_after="7"), message(answer(GOOD))) as server:
            asyncio.run(client(server, waits).send_async(exchange()))
        assert waits == [7.0]

    def test_a_wait_beyond_bounds_is_told_and_not_waited(self):
        waits = []
        text = failure(status(429, retry_after="86400"), waits=waits)
        assert "86400 s" in text and waits == []

    def test_overload_backs_off_and_gives_up(self):
        waits = []
        text = failure(status(529, "overloaded_error"), waits=waits, retries=4)
        assert "overloaded" in text and "5 attempts" in text
        assert len(waits) == 4 and all(late > early for early, late in pairwise(waits))

    def test_a_server_that_stumbles_once(self):
        with serving(status(500), message(answer(GOOD))) as server:
            assert client(server).send(exchange()).text == answer(GOOD)
        assert len(server.requests) == 2

    def test_slow(self):
        text = failure(slow, timeout=0.15, retries=1)
        assert "within 0.15 s" in text and "ICONJAX_TIMEOUT" in text

    def test_cut_connections_are_tried_again(self):
        with serving(cut, message(answer(GOOD))) as server:
            assert client(server).send(exchange()).text == answer(GOOD)
        assert "cut" in failure(cut)

    def test_nobody_listens(self):
        with serving(status(500)) as server:
            pass
        with pytest.raises(LlmError, match="no connection to http"):
            client(server).send(exchange())


class TestNoUse:
    """What trying again cannot mend is tried once."""

    @pytest.mark.parametrize(
        ("step", "says"),
        [
            (status(401, "authentication_error"), "does not accept the credentials"),
            (status(402, "billing_error", "pay"), "no credit or quota left: pay"),
            (status(400, "invalid_request_error", "Your credit balance is too low"), "no credit or quota left"),
            (status(429, "rate_limit_error", "monthly spend limit reached"), "no credit or quota left"),
            (status(403, "permission_error", "not for you"), "do not allow this request: not for you"),
            (status(404, "not_found_error"), "knows no model"),
            (status(413, "request_too_large"), "too large"),
            (status(400, "invalid_request_error", "bad schema"), "status 400: bad schema"),
            (status(307, location="http://127.0.0.1:9/v1/messages"), "status 307"),
            (raw(b"<html>welcome</html>", "text/html"), "no message of the Messages API"),
            (raw(b'{"half": '), "cannot be read"),
            (raw(b'{"id": 3}'), "no message of the Messages API"),
            (raw(b"[1, 2]"), ""),
            (
                message("", "refusal", stop_details={"type": "refusal", "category": "cyber"}),
                "declined to answer (cyber)",
            ),
            (message(answer(GOOD)[:30], "max_tokens"), "ICONJAX_MAX_TOKENS"),
            (message("  "), "empty"),
            (message(answer(GOOD), content=[{"type": "text"}, 3, None]), "empty"),
        ],
    )
    def test_says_what_to_do(self, step, says):
        waits = []
        assert says in failure(step, waits=waits)
        assert waits == []

    def test_control_characters_of_a_server_do_not_reach_the_terminal(self):
        assert "\x1b" not in failure(status(400, text="\x1b[2J\nboo"))


class TestCredentials:
    def test_none(self, monkeypatch, tmp_path):
        monkeypatch.delenv("ANTHROPIC_API_KEY")
        monkeypatch.setenv("HOME", str(tmp_path))
        with pytest.raises(LlmError, match="set ANTHROPIC_API_KEY"):
            AnthropicClient(LlmSettings(retries=0)).send(exchange())

    def test_a_server_of_ones_own_needs_none(self, monkeypatch):
        monkeypatch.delenv("ANTHROPIC_API_KEY")
        with serving(message(answer(GOOD))) as server:
            assert client(server).send(exchange()).text == answer(GOOD)

    def test_a_token_will_do(self, monkeypatch):
        monkeypatch.delenv("ANTHROPIC_API_KEY")
        monkeypatch.setenv("ANTHROPIC_AUTH_TOKEN", KEY)
        with serving(message(answer(GOOD))) as server:
            client(server).send(exchange())
        assert f"Bearer {KEY}" in str(server.requests[0].headers)

    @pytest.mark.parametrize(
        "step",
        [
            status(401, "authentication_error", f"invalid key {KEY}"),
            status(400, "invalid_request_error", f"what is {KEY}?"),
            status(403, "permission_error", KEY),
            status(500, text=KEY),
            raw(f"<html>{KEY}</html>".encode(), "text/html"),
            message(KEY, "refusal"),
            slow,
            cut,
        ],
    )
    def test_never_show_in_what_goes_wrong(self, step, caplog, capsys):
        caplog.set_level(logging.DEBUG)
        with serving(step) as server:
            asking = client(server, timeout=0.2, retries=0)
            with pytest.raises(LlmError) as caught:
                asking.send(exchange())
        error = caught.value
        shown = "".join(traceback.format_exception(error, chain=True)) + repr(error) + repr(pickle.dumps(error))
        assert error.__cause__ is None and error.__context__ is None  # the SDK's exceptions hold the request
        assert KEY not in shown + repr(asking) + repr(vars(asking)) + repr(asking.settings)
        assert KEY not in caplog.text + "".join(capsys.readouterr())

    def test_never_show_in_a_reply(self):
        with serving(message(f"you said {KEY}")) as server:
            assert KEY not in client(server).send(exchange()).text


class TestWaiting:
    def test_doubles_within_bounds(self):
        waits = [pause(k, None) for k in range(12)]
        assert all(w is not None and 0.3 < w <= 8.0 for w in waits)
        assert pause(0, LONGEST_WAIT) == LONGEST_WAIT and pause(0, LONGEST_WAIT + 1) is None

    @pytest.mark.parametrize(
        ("header", "seconds"),
        [
            ("3", 3.0),
            ("0.5", 0.5),
            ("Thu, 01 Jan 1970 00:01:40 GMT", 40.0),
            ("soon", None),
            ("-4", None),
            ("nan", None),
        ],
    )
    def test_reads_headers(self, header, seconds):
        assert retry_after(header, now=60.0) == seconds
        assert retry_after(None) is None


def test_without_the_sdk(monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "anthropic", None)
    with pytest.raises(ConfigError, match=r"iconjax\[llm\]"):
        AnthropicClient(LlmSettings())
