"""An edited SVG: the same bytes, with a `transform` on what moved."""

from __future__ import annotations

import gzip
import os
import re
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from jaxtyping import Float

from iconjax.files import write_bytes
from iconjax.render.raster import checked
from iconjax.scene.svg.document import SvgScene
from iconjax.scene.svg.guard import STORES
from iconjax.scene.svg.items import Item, piece_text
from iconjax.scene.svg.numbers import Matrix, compose, inverse, write_matrix
from iconjax.scene.svg.tags import prepend_value, splice
from iconjax.scene.svg.tree import Node, tag_end

SUFFIXES = (".svg", ".svgz")
Edit = tuple[int, int, bytes]


def write_svg(vector: SvgScene, matrices: Float[np.ndarray, "n 2 3"]) -> bytes:
    """The SVG with every segment moved by its transform.

    A `transform` attribute is set, or put before the one that is there, on each element that moves; a group
    that moves as a whole gets it in place of its elements. A path of which only some outlines move, or not all
    alike, is written as several, and an element that `use` refers to is moved by a group around it. Every
    other byte stays as it is; without a motion the input comes back.

    Args:
        vector: the opened SVG.
        matrices: (n, 2, 3) transforms in raster pixels, in the order of the scene's segments.

    Raises:
        InputError: the transforms are not finite or not as many as the segments.
    """
    matrices = checked(vector.scene, matrices)
    moves = [(item, matrices[k]) for k, items in enumerate(vector.members) for item in items]
    moves += [(item, np.eye(2, 3)) for item in vector.still]
    source = vector.document.source
    edits = _group_edits(source.text, moves)
    by_node: dict[int, list[tuple[Item, Matrix]]] = {}
    for item, matrix in moves:
        if not any(group.order in edits for group in item.groups):
            by_node.setdefault(item.node.order, []).append((item, matrix))
    changes: list[Edit] = list(edits.values())
    for parts in by_node.values():
        changes += _element_edits(vector, parts)
    return source.data if not changes else source.encode(splice(source.text, changes))


def save_svg(vector: SvgScene, matrices: Float[np.ndarray, "n 2 3"], path: str | os.PathLike[str]) -> None:
    """Write `write_svg` to a file, compressed if its name ends in .svgz.

    Raises:
        InputError: as `write_svg`, or the file cannot be written.
    """
    data = write_svg(vector, matrices)
    write_bytes(path, gzip.compress(data, mtime=0) if Path(path).suffix.lower() == ".svgz" else data)


def _group_edits(text: bytes, moves: Sequence[tuple[Item, Matrix]]) -> dict[int, Edit]:
    """Edits of the outermost groups in which everything moves alike, by order of the group."""
    held: dict[int, list[Matrix]] = {}
    places: dict[int, tuple[Node, Matrix]] = {}
    for item, matrix in moves:
        for group, outer in zip(item.groups, item.group_outers, strict=True):
            held.setdefault(group.order, []).append(matrix)
            places[group.order] = (group, outer)
    edits: dict[int, Edit] = {}
    for item, matrix in moves:
        for group in item.groups:
            if sum(node.tag not in STORES | {"g", "a"} for node in group.walk()) < 2:
                continue  # the one thing in it can carry the transform itself
            first = held[group.order][0]
            if all((other == first).all() for other in held[group.order]):
                if not _is_still(matrix) and group.order not in edits:
                    node, outer = places[group.order]
                    if (edit := _tag_edit(text, node, outer, matrix)) is not None:
                        edits[group.order] = edit
                break
    return edits


def _element_edits(vector: SvgScene, parts: Sequence[tuple[Item, Matrix]]) -> list[Edit]:
    """Edits of one element, given as all its items."""
    item, matrix = parts[0]
    text, node = vector.document.source.text, item.node
    if all((other == matrix).all() for _, other in parts):
        if _is_still(matrix):
            return []
        if item.wrapped:
            return _wrap(text, node, item.outer, matrix)
        edit = _tag_edit(text, node, item.outer, matrix)
        return [] if edit is None else [edit]
    return [(node.start, node.end, _apart(vector, sorted(parts, key=lambda part: part[0].outlines or ())))]


def _apart(vector: SvgScene, parts: Sequence[tuple[Item, Matrix]]) -> bytes:
    """A path as several, one for each run of outlines that move alike."""
    runs: list[tuple[list[int], Item, Matrix]] = []
    for item, matrix in parts:
        if runs and (runs[-1][2] == matrix).all():
            runs[-1][0].extend(item.outlines or ())
        else:
            runs.append((list(item.outlines or ()), item, matrix))
    out = []
    for k, (outlines, item, matrix) in enumerate(runs):
        text = piece_text(vector.document.source, item.node, tuple(sorted(outlines)), first=k == 0)
        value = _value(item.outer, matrix)
        if value and not _is_still(matrix):
            end = tag_end(text, 0)
            text = prepend_value(text[:end], "transform", value) + text[end:]
        out.append(text)
    return b"".join(out)


def _tag_edit(text: bytes, node: Node, outer: Matrix, matrix: Matrix) -> Edit | None:
    value = _value(outer, matrix)
    if not value:
        return None
    return node.start, node.inner, prepend_value(text[node.start : node.inner], "transform", value)


def _wrap(text: bytes, node: Node, outer: Matrix, matrix: Matrix) -> list[Edit]:
    """A moved group around an element, in the element's own namespace prefix."""
    found = re.match(rb"<([^\s/>:]+:)?", text[node.start : node.inner])
    name = (found[1] if found and found[1] else b"") + b"g"
    head = b"<" + name + f' transform="{_value(outer, matrix)}">'.encode()
    return [(node.start, node.start, head), (node.end, node.end, b"</" + name + b">")]


def _value(outer: Matrix, matrix: Matrix) -> str:
    """The motion of the raster as the parent's user units see it; "" where these have no extent."""
    back = inverse(outer)
    return "" if back is None else write_matrix(compose(back, compose(matrix, outer)))


def _is_still(matrix: Matrix) -> bool:
    return bool((matrix == np.eye(2, 3)).all())
