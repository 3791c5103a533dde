"""Segment names: reading, checking and numbering `Object:Part` labels."""

from __future__ import annotations

import csv
import json
import os
import unicodedata
from collections import Counter
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from iconjax.errors import InputError

MAX_FILE_BYTES = 4_000_000
COLUMN_SHARE = 0.02
"""Repeated segments whose centres differ less than this share of the picture's width stand in one column."""


def read_labels(source: Any) -> dict[int, str]:
    """Labels from a JSON file (a bare mapping, or an object with "labels") or a CSV file of `id,label` rows.

    Raises:
        InputError: the file is missing, broken, or its labels are.
    """
    if not isinstance(source, str | os.PathLike):
        raise InputError(
            f'labels must be a mapping like {{1: "Lamp:Shade"}} or the path of a JSON or CSV file, '
            f"not {type(source).__name__}"
        )
    path = Path(os.fspath(source))
    try:
        return _checked(_csv_rows(path) if path.suffix.lower() in (".csv", ".tsv") else _json_rows(path))
    except InputError as error:
        raise error if str(path) in str(error) else InputError(f"labels in {path}: {error}") from None


def check_labels(labels: Mapping[Any, Any]) -> dict[int, str]:
    """`labels` with int keys, ascending, and tidied names.

    Raises:
        InputError: an id that is no positive integer or occurs twice, or a name that is not `Object:Part` or
            `Object`.
    """
    return _checked(labels.items())


def split_name(name: str) -> tuple[str, str | None]:
    """Object and part of a name; a bare object has part None."""
    head, colon, tail = name.partition(":")
    return (head, tail) if colon else (head, None)


def number_names(labels: Mapping[int, str], centres: Mapping[int, tuple[float, float]], width: float) -> dict[int, str]:
    """Unique names: labels that occur twice get ` #1`, ` #2`, ... from left to right, then top to bottom.

    A number that would repeat another segment's own label is skipped.

    Args:
        labels: segment id -> label.
        centres: segment id -> centre of its box (x, y).
        width: of the picture, for what counts as one column.
    """
    times = Counter(labels.values())
    names = {i: label for i, label in labels.items() if times[label] == 1}
    taken = set(labels.values())
    for label in dict.fromkeys(labels.values()):
        if times[label] == 1:
            continue
        number = 0
        for i in _reading_order([i for i in labels if labels[i] == label], centres, COLUMN_SHARE * width):
            number += 1
            while f"{label} #{number}" in taken:
                number += 1
            names[i] = f"{label} #{number}"
            taken.add(names[i])
    return {i: names[i] for i in labels}


def _reading_order(ids: list[int], centres: Mapping[int, tuple[float, float]], slack: float) -> list[int]:
    """Columns from left to right, each from top to bottom; a column spans `slack` px from its first."""
    ordered: list[int] = []
    column: list[int] = []
    for i in sorted(ids, key=lambda i: (centres[i][0], centres[i][1])):
        if column and centres[i][0] - centres[column[0]][0] > slack:
            ordered += sorted(column, key=lambda k: centres[k][1])
            column = []
        column.append(i)
    return ordered + sorted(column, key=lambda k: centres[k][1])


def read_json(path: Path) -> Any:
    """The content of a JSON file; repeated keys are refused.

    Raises:
        InputError: missing, too large, not UTF-8 or not JSON.
    """
    text = _read(path)
    try:
        return json.loads(text, object_pairs_hook=_unique)
    except json.JSONDecodeError as error:
        where = f"line {error.lineno}, column {error.colno}"
        raise InputError(f"{path} is not valid JSON: {error.msg} at {where}") from None
    except RecursionError:
        raise InputError(f"{path} is not usable JSON: it is nested too deeply") from None
    except ValueError as error:
        raise InputError(f"{path} is not usable JSON: {' '.join(str(error).split())[:120]}") from None


def _unique(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    twice = [key for key, n in Counter(k for k, _ in pairs).items() if n > 1]
    if twice:
        raise ValueError(f"the key {twice[0]!r} occurs twice")
    return dict(pairs)


def _read(path: Path) -> str:
    if os.path.isfile(path) and os.path.getsize(path) > MAX_FILE_BYTES:
        raise InputError(f"{path} is too large: such a file has at most {MAX_FILE_BYTES // 10**6} MB")
    try:
        return path.read_text("utf-8-sig")
    except FileNotFoundError:
        raise InputError(f"{path} does not exist: check the path") from None
    except IsADirectoryError:
        raise InputError(f"{path} is a folder: give the JSON or CSV file in it") from None
    except PermissionError:
        raise InputError(f"{path} cannot be opened: permission denied") from None
    except UnicodeDecodeError:
        raise InputError(f"{path} is not UTF-8 text: save it as UTF-8 JSON or CSV") from None
    except ValueError:
        raise InputError(f"{path} is not a file name: give the path of a JSON or CSV file") from None
    except OSError as error:
        raise InputError(f"{path} cannot be read: {error.strerror or error}") from None


def _json_rows(path: Path) -> Iterable[tuple[Any, Any]]:
    data = read_json(path)
    if isinstance(data, dict) and isinstance(data.get("labels"), dict):
        data = data["labels"]
    if not isinstance(data, dict):
        raise InputError(f'{path} must be an object like {{"1": "Lamp:Shade"}}, not {type(data).__name__}')
    return data.items()


def _csv_rows(path: Path) -> Iterable[tuple[Any, Any]]:
    text = _read(path)
    delimiter = max(",;\t", key=lambda d: text.count(d))
    try:
        rows = [[cell.strip() for cell in row] for row in csv.reader(text.splitlines(), delimiter=delimiter)]
    except csv.Error as error:
        raise InputError(f"{path} is not valid CSV: {error}") from None
    rows = [row for row in rows if any(row)]
    if rows and not rows[0][0].lstrip("+-").isdigit():
        rows = rows[1:]  # a header
    bad = next((row for row in rows if len(row) != 2), None)
    if bad is not None:
        raise InputError(f"{path} must have two columns, id and label; found {delimiter.join(bad)[:60]!r}")
    return [(row[0], row[1]) for row in rows]


def _checked(rows: Iterable[tuple[Any, Any]]) -> dict[int, str]:
    table: dict[int, str] = {}
    for key, label in rows:
        number = _segment_id(key)
        if number in table:
            raise InputError(f"segment {number} has two labels ({table[number]!r} and {label!r}): keep one")
        table[number] = _tidy(number, label)
    if not table:
        raise InputError('there are no labels: give one per segment, like {1: "Lamp:Shade"}')
    return dict(sorted(table.items()))


def _segment_id(key: Any) -> int:
    try:
        if isinstance(key, bool | float):
            raise TypeError
        if isinstance(key, str) and not key.strip().isdecimal():
            raise ValueError
        number = int(key) if isinstance(key, str) else key.__index__()
    except (TypeError, ValueError, AttributeError):
        raise InputError(f"label key {str(key)[:40]!r} is no segment id: use whole numbers 1, 2, ...") from None
    if number < 1:
        raise InputError(f"label key {number} is no segment id: 0 is background, segments are 1, 2, ...")
    return int(number)


def _tidy(number: int, label: Any) -> str:
    if not isinstance(label, str):
        kind = type(label).__name__
        raise InputError(f'the label of segment {number} is {kind}, not text: write it like "Lamp:Shade"')
    if any(unicodedata.category(c) in ("Cc", "Cs", "Zl", "Zp") for c in label.strip()):
        raise InputError(f"the label of segment {number} has control characters: {label[:40]!r}, remove them")
    if not label.strip():
        raise InputError(f'the label of segment {number} is blank: write it like "Lamp:Shade"')
    parts = [part.strip() for part in label.split(":")]
    if len(parts) > 2:
        raise InputError(
            f"the label {label!r} of segment {number} has {len(parts) - 1} colons: only Object:Part is known"
        )
    if not all(parts):
        raise InputError(f"the label {label!r} of segment {number} lacks a name beside its colon: write Object:Part")
    return ":".join(parts)
