"""Contact sheets: what a method made of each case beside the case's own pictures, and what the checks say."""

from __future__ import annotations

import colorsys
import io
import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from jaxtyping import Integer, UInt8
from PIL import Image, ImageDraw, ImageFont

from iconjax.errors import InputError
from iconjax.evaluation.cases import EvalCase, load_eval_case, read_image
from iconjax.evaluation.record import CaseRecord, read_record
from iconjax.files import write_bytes

TILE, GAP, NOTE = 200, 10, 430
"""Sides of a picture and of the space between, and width of the text at the right, in pixels."""

HEAD, LINE = 34, 15
"""Heights of the heading over a row and of a line of text, in pixels."""

TITLES = ("before", "segments", "after", "one solution")
INK, GOOD, BAD, FAINT = "#222222", "#11772d", "#b3201f", "#777777"


@dataclass(frozen=True)
class Entry:
    """One row of a sheet.

    Attributes:
        case: the case.
        record: how the method did.
        after: the edited picture; None where there is none.
    """

    case: EvalCase
    record: CaseRecord
    after: UInt8[np.ndarray, "H W 3"] | None


def contact_sheets(
    run: str | Path,
    target: str | Path,
    *,
    method: str | None = None,
    benchmark: str | Path | None = None,
    rows: int = 8,
    only: str | None = None,
) -> tuple[Path, ...]:
    """Draw the results of a run, some cases a page.

    Args:
        run: folder that `run_benchmark` wrote.
        target: image file; with several pages `NAME-1.png`, `NAME-2.png`, ...
        method: which method's results; by default the first of the run.
        benchmark: folder with the cases, where it is not where the run saw it.
        rows: cases a page.
        only: "wrong" or "right" to leave the other cases out.

    Returns:
        The files written.

    Raises:
        InputError: no such run, method or case, or nothing to draw.
    """
    entries = [e for e in read_entries(Path(run), method, benchmark) if _wanted(e.record, only)]
    if not entries:
        raise InputError("no case to draw")
    pages = [entries[i : i + rows] for i in range(0, len(entries), rows)]
    target = Path(target)
    names = [target.with_stem(f"{target.stem}-{n}") for n in range(1, len(pages) + 1)]
    paths = tuple(names if len(pages) > 1 else [target])
    for path, page in zip(paths, pages, strict=True):
        stream = io.BytesIO()
        draw_page(page).save(stream, "PNG", optimize=True)
        write_bytes(path, stream.getvalue())
    return paths


def read_entries(run: Path, method: str | None = None, benchmark: str | Path | None = None) -> list[Entry]:
    """The results of one method of a run, with their cases.

    Raises:
        InputError: no such run or method, or a case that cannot be read.
    """
    try:
        config = json.loads((run / "run.json").read_text(encoding="utf-8"))
        folders = {entry["name"]: entry["folder"] for entry in config["methods"]}
        cases = Path(benchmark) if benchmark is not None else run / config["benchmark"]
    except (OSError, ValueError, KeyError) as error:
        raise InputError(f"{run} holds no finished run: run.json is missing or broken") from error
    if method is not None and method not in folders:
        raise InputError(f"the run has no method {method!r}; it has {', '.join(folders)}")
    folder = run / (folders[method] if method is not None else next(iter(folders.values())))
    entries = []
    for name in config["cases"]:
        record = read_record(folder / f"{name}.json")
        if record is not None and record.cd is not None:
            picture = folder / f"{name}.png"
            after = read_image(picture) if picture.exists() and record.error is None else None
            entries.append(Entry(load_eval_case(cases / name), record, after))
    return entries


def draw_page(entries: Sequence[Entry]) -> Image.Image:
    """Draw rows below each other."""
    width = len(TITLES) * (TILE + GAP) + NOTE + 2 * GAP
    height = len(entries) * (HEAD + TILE + GAP) + GAP
    page = Image.new("RGB", (width, height), "white")
    for number, entry in enumerate(entries):
        _draw_row(page, ImageDraw.Draw(page), GAP + number * (HEAD + TILE + GAP), entry)
    return page


def label_colours(mask: Integer[np.ndarray, "H W"]) -> UInt8[np.ndarray, "H W 3"]:
    """A label map in colours that differ well between neighbouring ids; background white."""
    golden = 0.618034
    colours = [(1.0, 1.0, 1.0)] + [
        colorsys.hsv_to_rgb(key * golden % 1.0, 0.55 + 0.3 * (key % 2), 0.95 - 0.2 * (key % 3 == 0))
        for key in range(1, int(mask.max()) + 1)
    ]
    return np.asarray((np.array(colours) * 255).astype(np.uint8)[mask])


def notes(record: CaseRecord) -> list[tuple[str, str]]:
    """What to write beside a row: lines of text with their colours."""
    numbers = [f"CD {record.cd:.3f}" if record.cd is not None else "", f"{record.seconds:.1f} s"]
    if record.mse is not None:
        numbers.insert(1, f"MSE {record.mse:.0f}")
    if record.satisfied is not None:
        numbers.append("program holds" if record.satisfied else "program missed")
    lines = [
        ("RIGHT", GOOD) if record.right else ("NOT RIGHT", BAD),
        (", ".join(filter(None, numbers)), FAINT),
    ]
    if record.error is not None:
        return [*lines, (f"failed: {record.error}", BAD)]
    for title, checks in (("goal", record.goal), ("coherence", record.coherence)):
        failed = [check for check in checks if not check.passed]
        passed = f"{title}: {len(checks) - len(failed)} of {len(checks)}"
        lines.append((passed, BAD if failed else GOOD))
        lines += [(f"- {check.text}: {check.detail}", INK) for check in failed]
    return lines


def _draw_row(page: Image.Image, draw: ImageDraw.ImageDraw, top: int, entry: Entry) -> None:
    case = entry.case
    draw.text((GAP, top), f"{case.id}:  {case.request}", INK, _font(13))
    pictures = (case.image, label_colours(case.mask), entry.after, case.truth_image)
    for column, (title, picture) in enumerate(zip(TITLES, pictures, strict=True)):
        left = GAP + column * (TILE + GAP)
        draw.text((left, top + 17), title, FAINT, _font(11))
        box = (left, top + HEAD, left + TILE, top + HEAD + TILE)
        if picture is not None:
            small = Image.fromarray(picture)
            small.thumbnail((TILE, TILE), Image.Resampling.LANCZOS)
            page.paste(small, box[:2])
        draw.rectangle(box, outline="#cccccc")
    left, y = GAP + len(TITLES) * (TILE + GAP), top + HEAD
    for text, colour in notes(entry.record):
        for line in _wrapped(draw, text, NOTE):
            if y + LINE > top + HEAD + TILE:
                draw.text((left, y - 4), "...", FAINT, _font(11))
                return
            draw.text((left, y), line, colour, _font(11))
            y += LINE


def _wrapped(draw: ImageDraw.ImageDraw, text: str, width: int) -> list[str]:
    lines = [""]
    for word in text.split():
        longer = f"{lines[-1]} {word}".strip()
        if draw.textlength(longer, _font(11)) <= width or not lines[-1]:
            lines[-1] = longer
        else:
            lines.append(f"   {word}")
    return lines


def _font(size: int) -> ImageFont.FreeTypeFont | ImageFont.ImageFont:
    return ImageFont.load_default(size)


def _wanted(record: CaseRecord, only: str | None) -> bool:
    if only not in (None, "right", "wrong"):
        raise InputError(f"only is {only!r}; it can be right or wrong")
    return only is None or record.right == (only == "right")
