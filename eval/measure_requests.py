"""Measure a translator on requests with known meanings.

    python eval/measure_requests.py --data eval/requests/tune.json --solve --show wrong

The data is a list of {"scene": case id, "request": text, "program": one right program, "goal": checks} or
{"scene", "request", "refuse": true}, each perhaps with its "author". A reading is the same as the reference when the
two programs mean the same; what differs is solved and judged by the goal checks (with --solve), as is the reference.
"""

from __future__ import annotations

import hashlib
import json
import pickle
import sys
import tempfile
import time
from collections.abc import Iterable, Sequence
from contextlib import suppress
from dataclasses import asdict, dataclass
from functools import cache
from pathlib import Path
from typing import Any

import click

from iconjax.errors import IconjaxError, TranslationError
from iconjax.language.base import Translation
from iconjax.language.canonical import same_meaning
from iconjax.language.offline import OfflineTranslator
from iconjax.scene.types import Scene

HERE = Path(__file__).parent
SCRATCH = Path(tempfile.gettempdir()) / "iconjax-requests"
COLUMNS = ("right", "refused", "wrong", "undecided", "differs")


@dataclass(frozen=True)
class Outcome:
    """How one request came out.

    Attributes:
        verdict: right, refused, wrong (the goal is missed, the reference meets it), undecided (both miss it, or the
            checks cannot be run) or differs (not solved).
        how: what the verdict rests on: "same" program, "goal", "refuse" or "".
        program: what the translator wrote; empty where it refused.
        note: its message, or the failed checks.
        ms: time of the translation.
    """

    scene: str
    request: str
    author: str
    verdict: str
    how: str
    program: tuple[str, ...]
    note: str
    ms: float


@cache
def scene_of(benchmark: Path, name: str) -> Scene:
    """The scene of a case, kept on disk by the content of its files and of the code that reads them."""
    from iconjax.scene import build
    from iconjax.scene.load import load_case

    folder = benchmark / name
    parts = [folder / "case.json", folder / "segmentation.png", *sorted(Path(build.__file__).parent.glob("*.py"))]
    key = hashlib.sha256(b"".join(p.read_bytes() for p in parts)).hexdigest()[:24]
    kept = SCRATCH / f"scene-{key}.pickle"
    if not kept.exists():
        case = load_case(folder)
        _write(kept, pickle.dumps(build.build_scene(case.image, case.segmentation)))
    scene: Scene = pickle.loads(kept.read_bytes())
    return scene


def _write(path: Path, data: bytes) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    part = path.with_suffix(f".{time.time_ns()}")
    part.write_bytes(data)
    part.replace(path)


def failed_checks(benchmark: Path, name: str, program: Sequence[str], goal: Sequence[Any]) -> tuple[str, ...] | None:
    """The goal checks that the engine's result misses; None where it has none or the checks cannot be run."""
    from iconjax.evaluation.cases import load_eval_case
    from iconjax.evaluation.checks import run_checks
    from iconjax.evaluation.stage import Stage

    case = load_eval_case(benchmark / name)
    try:
        transforms = _solved(benchmark / name, program)
        stage = Stage(case.size, case.outlines, case.labels, transforms)
        return tuple(str(c) for c in run_checks(stage, goal) if not c.passed)
    except IconjaxError as error:
        click.echo(f"{name}: {error}", err=True)
        return None


def _solved(folder: Path, program: Sequence[str]) -> dict[int, list[list[float]]]:
    key = hashlib.sha256("\n".join((folder.name, *program)).encode()).hexdigest()[:24]
    kept = SCRATCH / f"solved-{key}.json"
    if not kept.exists():
        from iconjax import edit

        result = edit(folder, program=list(program))
        rows = {str(k): [[float(x) for x in r] for r in m] for k, m in result.transforms.items()}
        _write(kept, json.dumps(rows).encode())
    return {int(k): m for k, m in json.loads(kept.read_text(encoding="utf-8")).items()}


def measure(entry: dict[str, Any], benchmark: Path, solve: bool) -> Outcome:
    """Translate one request and judge the reading."""
    scene = scene_of(benchmark, entry["scene"])
    begin = time.perf_counter()
    got: Translation | None = None
    note = ""
    try:
        got = OfflineTranslator().translate(entry["request"], scene)
    except TranslationError as error:
        note = str(error)
    ms = 1000 * (time.perf_counter() - begin)
    program = got.program if got is not None else ()

    def out(verdict: str, how: str = "", note: str = note) -> Outcome:
        return Outcome(entry["scene"], entry["request"], entry.get("author", ""), verdict, how, program, note, ms)

    if entry.get("refuse"):
        return out("right" if got is None else "wrong", "refuse")
    if got is None:
        return out("refused")
    names = {n: frozenset(scene.members(n)) for n in (*scene.names, *scene.objects)}
    if same_meaning(program, entry["program"], names):
        return out("right", "same")
    if not solve:
        return out("differs")
    failed = failed_checks(benchmark, entry["scene"], program, entry["goal"])
    if failed == ():
        return out("right", "goal")
    reference = failed_checks(benchmark, entry["scene"], entry["program"], entry["goal"])
    told = "; ".join(failed) if failed else "the checks cannot be run"
    return out("wrong" if failed and reference == () else "undecided", "goal", told)


def table(outcomes: Sequence[Outcome]) -> str:
    """Counts by author and in all."""
    lines = [
        f"{'author':8}{'all':>5}" + "".join(f"{c:>11}" for c in COLUMNS) + f"{'right %':>9}{'wrong %':>9}{'ms':>7}"
    ]
    groups: list[tuple[str, Iterable[Outcome]]] = [
        *((a, [o for o in outcomes if o.author == a]) for a in sorted({o.author for o in outcomes})),
        ("all", outcomes),
    ]
    for name, group in groups:
        rows = list(group)
        counts = [sum(o.verdict == c for o in rows) for c in COLUMNS]
        shares = f"{100 * counts[0] / len(rows):>9.1f}{100 * counts[2] / len(rows):>9.1f}"
        ms = sum(o.ms for o in rows) / len(rows)
        lines.append(f"{name:8}{len(rows):>5}" + "".join(f"{c:>11}" for c in counts) + f"{shares}{ms:>7.1f}")
    return "\n".join(lines)


def shown(outcome: Outcome, entry: dict[str, Any]) -> str:
    """An outcome with both programs."""
    head = f"[{outcome.verdict}{' ' + outcome.how if outcome.how else ''}] {outcome.scene}: {outcome.request}"
    lines = [head, *(f"    got  {line}" for line in outcome.program)]
    lines += [f"    want {line}" for line in entry.get("program", ())] if outcome.how != "same" else []
    return "\n".join([*lines, *([f"    -- {outcome.note}"] if outcome.note else [])])


@click.command(help=__doc__)
@click.option("--data", required=True, type=click.Path(exists=True, path_type=Path))
@click.option("--benchmark", default=HERE / "benchmark", type=click.Path(exists=True, path_type=Path))
@click.option("--solve", is_flag=True, help="Solve what differs and judge it by the goal checks.")
@click.option("--show", type=click.Choice([*COLUMNS, "missed", "all"]), multiple=True, help="Requests to list.")
@click.option("--match", default="", help="Only requests with this text.")
@click.option("--json", "json_file", type=click.Path(path_type=Path), help="Write every outcome here.")
def main(data: Path, benchmark: Path, solve: bool, show: tuple[str, ...], match: str, json_file: Path | None) -> None:
    entries = [e for e in json.loads(data.read_text(encoding="utf-8")) if match.lower() in e["request"].lower()]
    if not entries:
        click.echo("error: no request to measure", err=True)
        sys.exit(2)
    with suppress(TranslationError):  # so that the first one measured does not pay for the lexicon and the grammar
        OfflineTranslator().translate("move it 20 px up", scene_of(benchmark, entries[0]["scene"]))
    outcomes = []
    for entry in entries:
        outcomes.append(measure(entry, benchmark, solve))
        wanted = {outcomes[-1].verdict, "all", *(["missed"] if outcomes[-1].verdict != "right" else [])}
        if wanted & set(show):
            click.echo(shown(outcomes[-1], entry))
    click.echo(table(outcomes))
    if json_file is not None:
        _write(json_file, json.dumps([asdict(o) for o in outcomes], indent=1).encode())


if __name__ == "__main__":
    main()
