"""The prompts of the paper's baselines out, replies in, as `llm_prompts.py` does for the translator.

    python eval/baseline_prompts.py FOLDER... --method dm --out DIR [--image] [--record REC]

writes `system.md`, and for every case `<case>.prompt.md`, `<case>.png` (with --image) and `<case>.exchange.json`; with
`--record REC` only those that have no recorded reply yet. Show a model the system prompt and the prompt, save what it
answers, verbatim, as `<case>.reply.json`, and store the replies by

    python eval/llm_prompts.py --collect DIR --record REC [--model NAME]

`iconjax eval ... --method dm --replay REC` answers from them. Use a folder DIR of its own for each method.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from llm_prompts import write_prompt

from iconjax.edit.inputs import open_inputs
from iconjax.errors import IconjaxError
from iconjax.evaluation.asking import baseline_exchange
from iconjax.evaluation.cases import list_cases
from iconjax.evaluation.methods import DIRECT
from iconjax.language.llm.record import MissingRecordingError, read_recording


def write_prompts(folders: list[Path], method: str, image: bool, out: Path, record: Path | None) -> int:
    """Write the prompt of every case that has no recorded reply; gives back how many there are."""
    out.mkdir(parents=True, exist_ok=True)
    written = 0
    for folder in [case for f in folders for case in list_cases(f)]:
        inputs = open_inputs(folder)
        exchange = baseline_exchange(method, inputs.request, inputs.scene, image)
        try:
            if record is None:
                raise MissingRecordingError("nothing is recorded", exchange)
            read_recording(record, exchange)
        except MissingRecordingError:
            write_prompt(out, folder.name, exchange)
            written += 1
    return written


def main() -> None:
    """Read the command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="+", type=Path, help="case folders, or folders of them")
    parser.add_argument("--method", choices=list(DIRECT), required=True)
    parser.add_argument("--image", action="store_true", help="with the coloured segmentation")
    parser.add_argument("--out", type=Path, required=True, help="folder for the prompts")
    parser.add_argument("--record", type=Path, help="folder of recordings")
    a = parser.parse_args()
    count = write_prompts(a.folders, a.method, a.image, a.out, a.record)
    print(f"{count} prompts written to {a.out}")


if __name__ == "__main__":
    try:
        main()
    except IconjaxError as error:
        sys.exit(str(error))
