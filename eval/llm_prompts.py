"""Prompts out, replies in: how recordings come from a model that this program cannot reach.

    python eval/llm_prompts.py FOLDER... --out DIR [--image] [--hints] [--readings N] [--record REC [--solve]]

writes for every case the exact prompt that iconjax builds: `system.md` (the constant part, once), `<case>.prompt.md`
(the conversation so far), `<case>.png` (with --image), and `<case>.exchange.json`, which remembers what the reply
belongs to. Show a model the system prompt and the prompt, and save what it answers, verbatim, as `<case>.reply.json`.
Then

    python eval/llm_prompts.py --collect DIR --record REC [--model NAME]

stores the replies as recordings, which `--translator llm-replay --replay REC` answers from. With `--record REC`, the
first form plays what is recorded and writes only prompts that are still missing: run both forms in turn until none is
written, and all repair rounds are done.
"""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path

from iconjax.edit.choose import scene_connections
from iconjax.edit.inputs import open_inputs
from iconjax.edit.pipeline import run_edit
from iconjax.errors import IconjaxError
from iconjax.files import write_bytes, write_text
from iconjax.language.llm.exchange import Exchange, Picture, Reply, Turn
from iconjax.language.llm.record import MissingRecordingError, read_recording, write_recording
from iconjax.language.llm.settings import LlmSettings
from iconjax.language.llm.translator import AnthropicTranslator


class Folder:
    """Answers from recordings, if there is a folder of them."""

    def __init__(self, folder: Path | None) -> None:
        self.folder = folder

    def send(self, exchange: Exchange) -> Reply:
        if self.folder is None:
            raise MissingRecordingError("nothing is recorded", exchange)
        return read_recording(self.folder, exchange)

    async def send_async(self, exchange: Exchange) -> Reply:
        return self.send(exchange)


def write_prompts(folders: list[Path], out: Path, settings: LlmSettings, record: Path | None, solve: bool) -> int:
    """Write the next missing prompt of every case; gives back how many there are.

    With `solve`, the edit is made too, and the prompt after a search that missed a constraint counts as well.
    """
    out.mkdir(parents=True, exist_ok=True)
    translator = AnthropicTranslator(Folder(record), settings, scene_connections)
    written = 0
    for folder in sorted({p.parent for f in folders for p in [*f.glob("*/case.json"), *f.glob("case.json")]}):
        try:
            inputs = open_inputs(folder)
            if solve:
                result = run_edit(folder, translator=translator)
                print(f"{folder.name}: {len(result.missed())} constraints missed, {result.rounds} repair rounds")
            else:
                done = translator.translate(inputs.request, inputs.scene)
                print(f"{folder.name}: {len(done.program)} calls, {done.rounds} repair rounds")
        except MissingRecordingError as missing:
            write_prompt(out, folder.name, missing.exchange)
            written += 1
        except IconjaxError as error:
            print(f"{folder.name}: {error}")
    return written


def write_prompt(out: Path, name: str, exchange: Exchange) -> None:
    """The files of one prompt; a reply to an earlier one is put aside under the key that it belongs to."""
    earlier, reply = out / f"{name}.exchange.json", out / f"{name}.reply.json"
    if reply.exists() and earlier.exists() and (key := read_exchange(earlier).key) != exchange.key:
        reply.rename(out / f"{name}.answered-{key[:12]}.json")
    turns = (
        [f"## {t.role}\n\n{t.text}\n" for t in exchange.turns] if len(exchange.turns) > 1 else [exchange.turns[0].text]
    )
    write_text(out / "system.md", exchange.system)
    write_text(out / "schema.json", json.dumps(exchange.schema, indent=1) + "\n")
    write_text(out / f"{name}.prompt.md", "\n".join(turns) + "\n")
    for turn in exchange.turns:
        if turn.picture is not None:
            write_bytes(out / f"{name}.png", turn.picture.png)
    pictures = [t.picture.key if t.picture is not None else None for t in exchange.turns]
    data = {
        "key": exchange.key,
        "purpose": exchange.purpose,
        "summary": exchange.summary,
        "turns": [[t.role, t.text] for t in exchange.turns],
        "pictures": pictures,
        "schema": exchange.schema,
        "system": exchange.system,
    }
    write_text(out / f"{name}.exchange.json", json.dumps(data, ensure_ascii=False, indent=1) + "\n")


def collect(folder: Path, record: Path, model: str) -> int:
    """Store the replies in `folder` as recordings; gives back how many."""
    count = 0
    for path in sorted(folder.glob("*.reply.json")):
        exchange = read_exchange(folder / path.name.replace(".reply.json", ".exchange.json"))
        write_recording(record, exchange, Reply(path.read_text(encoding="utf-8").strip(), model))
        count += 1
    return count


def read_exchange(path: Path) -> Exchange:
    """An exchange as `write_prompt` wrote it, without the bytes of its pictures."""
    data = json.loads(path.read_text(encoding="utf-8"))
    turns = tuple(
        Turn(role, text, Picture(b"", key) if key else None)
        for (role, text), key in zip(data["turns"], data["pictures"], strict=True)
    )
    exchange = Exchange(data["purpose"], data["summary"], data["system"], turns, data["schema"])
    if exchange.key != data["key"]:
        raise IconjaxError(f"{path} was changed: its key does not fit its prompt")
    return exchange


def main() -> None:
    """Read the command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="*", type=Path, help="case folders, or folders of them")
    parser.add_argument("--out", type=Path, help="folder for the prompts")
    parser.add_argument("--image", action="store_true", help="with the coloured segmentation")
    parser.add_argument("--hints", action="store_true", help="ask for motion hints, and show outlines")
    parser.add_argument("--solve", action="store_true", help="also search, and ask again where constraints are missed")
    parser.add_argument("--readings", type=int, default=1)
    parser.add_argument("--record", type=Path, help="folder of recordings")
    parser.add_argument("--collect", type=Path, help="folder with replies to store as recordings")
    parser.add_argument("--model", default="", help="name of the model that wrote the replies")
    a = parser.parse_args()
    if a.collect and a.record:
        print(f"{collect(a.collect, a.record, a.model)} replies stored in {a.record}")
    elif a.folders and a.out:
        settings = LlmSettings(image=a.image, hints=a.hints, readings=a.readings)
        print(f"{write_prompts(a.folders, a.out, settings, a.record, a.solve)} prompts written to {a.out}")
    else:
        parser.error("give case folders and --out, or --collect and --record")


if __name__ == "__main__":
    try:
        main()
    except IconjaxError as error:
        sys.exit(str(error))
