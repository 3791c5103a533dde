"""A local server that speaks the Messages API, as badly as a test wants, and what tests of the LLM path share."""

from __future__ import annotations

import json
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

from edit_support import LABELS, small_picture

from iconjax.language.llm.exchange import Reply
from iconjax.scene.build import build_scene

KEY = "sk-planted-0123456789-do-not-show"
GOOD = ['translate("Lamp:Shade")', 'equal(center_x("Lamp:Shade"), plus(center_x(old("Lamp:Shade")), 8))']
CONNECTIONS = [("Lamp:Shade", "touches", "Lamp:Foot"), ("Lamp:Foot", "touches", "Table")]
REQUEST = "move the shade 8 pixels to the right"

Step = Callable[["Handler"], None]


def answer(*programs: list[str], refusal: str | None = None, understood: list[str] | None = None, **more: Any) -> str:
    """A reply in the form that the prompt asks for."""
    readings = [{"gloss": f"reading {k}", "program": program} | more for k, program in enumerate(programs, 1)]
    return json.dumps({"understood": understood or ["it moves"], "readings": readings, "refusal": refusal})


def message(text: str, stop_reason: str = "end_turn", **more: Any) -> Step:
    """Answer with a message."""
    body = {
        "id": "msg_1",
        "type": "message",
        "role": "assistant",
        "model": "model-of-the-test",
        "content": [{"type": "text", "text": text}],
        "stop_reason": stop_reason,
        "stop_sequence": None,
        "usage": {
            "input_tokens": 11,
            "output_tokens": 7,
            "cache_read_input_tokens": 5,
            "cache_creation_input_tokens": 3,
        },
    }
    return lambda handler: handler.respond(200, json.dumps(body | more).encode())


def status(code: int, kind: str = "api_error", text: str = "no", **headers: str) -> Step:
    """Answer with an error; `retry_after="1"` becomes the header retry-after."""
    body = json.dumps({"type": "error", "error": {"type": kind, "message": text}}).encode()
    return lambda handler: handler.respond(code, body, {k.replace("_", "-"): v for k, v in headers.items()})


def raw(body: bytes, kind: str = "application/json") -> Step:
    """Answer with these bytes."""
    return lambda handler: handler.respond(200, body, {"content-type": kind})


def slow(handler: Handler) -> None:
    """Answer only when the test is over."""
    handler.server.over.wait(20)  # type: ignore[attr-defined]


def cut(handler: Handler) -> None:
    """Promise more than is sent."""
    handler.send_response(200)
    handler.send_header("content-type", "application/json")
    handler.send_header("content-length", "5000")
    handler.end_headers()
    handler.wfile.write(b'{"id": "msg_1", "type": "mess')
    handler.close_connection = True


class Handler(BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"

    def do_POST(self) -> None:
        server: Any = self.server
        body = self.rfile.read(int(self.headers["content-length"]))
        server.requests.append(Asked(self.path, dict(self.headers), json.loads(body)))
        step = server.script.pop(0) if len(server.script) > 1 else server.script[0]
        step(self)

    def respond(self, code: int, body: bytes, headers: dict[str, str] | None = None) -> None:
        self.send_response(code)
        for name, value in ({"content-type": "application/json"} | (headers or {})).items():
            self.send_header(name, value)
        self.send_header("content-length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)

    def log_message(self, *_: Any) -> None:
        pass


@dataclass
class Asked:
    """One request as it came in."""

    path: str
    headers: dict[str, str]
    body: dict[str, Any]


@dataclass
class Server:
    url: str
    requests: list[Asked]


@contextmanager
def serving(*script: Step) -> Iterator[Server]:
    """A server that plays `script`, one step a request, and repeats the last."""
    server: Any = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    server.daemon_threads = True
    server.script, server.requests, server.over = list(script), [], threading.Event()
    thread = threading.Thread(target=server.serve_forever, kwargs={"poll_interval": 0.02}, daemon=True)
    thread.start()
    try:
        yield Server(f"http://127.0.0.1:{server.server_address[1]}", server.requests)
    finally:
        server.over.set()
        server.shutdown()
        server.server_close()


@dataclass
class Scripted:
    """A client without any server: replies one after the other, and the exchanges that asked for them."""

    replies: list[str]
    asked: list[Any] = field(default_factory=list)

    def send(self, exchange: Any) -> Reply:
        self.asked.append(exchange)
        return Reply(self.replies.pop(0), "scripted")

    async def send_async(self, exchange: Any) -> Reply:
        return self.send(exchange)


def lamp() -> Any:
    """The scene of the small picture: a lamp on a table."""
    image, mask = small_picture()
    return build_scene(image, mask, LABELS)
