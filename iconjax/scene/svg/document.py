"""An SVG opened for editing: its bytes, its scene, and which elements make each segment."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import UInt8

from iconjax.errors import InputError
from iconjax.scene.labels import check_labels, read_json, read_labels
from iconjax.scene.load import MAX_SEGMENTS
from iconjax.scene.segment.names import numbered_name
from iconjax.scene.svg import details
from iconjax.scene.svg.draw import Painter
from iconjax.scene.svg.grouping import Draft, draft_segments
from iconjax.scene.svg.guard import References
from iconjax.scene.svg.items import Item, Walk
from iconjax.scene.svg.limits import MAX_DRAWN
from iconjax.scene.svg.numbers import Matrix, Viewport, inverse
from iconjax.scene.svg.scene import assemble
from iconjax.scene.svg.sight import is_faithful, look
from iconjax.scene.svg.source import Source, read_source
from iconjax.scene.svg.styles import Styles
from iconjax.scene.svg.tree import SVG, Node, parse_tree
from iconjax.scene.types import Scene


@dataclass(frozen=True, eq=False)
class Document:
    """A parsed SVG.

    Attributes:
        source: its text.
        root: its elements.
        matrix: user units of the root to raster pixels.
    """

    source: Source = field(repr=False)
    root: Node = field(repr=False)
    matrix: Matrix = field(repr=False)

    @property
    def data(self) -> bytes:
        """The bytes of the file, unpacked where it was compressed."""
        return self.source.data


@dataclass(frozen=True, eq=False)
class SvgScene:
    """An SVG as a scene that can be written back.

    Attributes:
        scene: the drawing on white with its segments, numbered from 1 in paint order.
        document: where it comes from.
        labels: label by segment number, before repeated ones are numbered.
        named: numbers of the segments whose label comes from the file or from the caller; the others are made
            up from colour and shape.
        members: for each segment the elements it is made of, in paint order.
        still: the elements that belong to no segment and stay: background, and what cannot be moved.
        notes: one line each: what the drawing holds that is not handled.
    """

    scene: Scene
    document: Document
    labels: Mapping[int, str]
    named: frozenset[int]
    members: tuple[tuple[Item, ...], ...] = field(repr=False)
    still: tuple[Item, ...] = field(repr=False)
    notes: tuple[str, ...]


def open_svg(
    source: str | os.PathLike[str] | bytes,
    labels: Any = None,
    *,
    size: int = 512,
    split_paths: bool = True,
    open_groups: bool = False,
    join_details: bool = True,
) -> SvgScene:
    """Read an SVG as segments.

    Nothing but the file is read: what it refers to outside itself is neither opened nor fetched.

    Args:
        source: a path (.svg or .svgz), or the bytes of an SVG.
        labels: names by segment number, as a mapping or a JSON or CSV file; numbers that are left out, and
            those with an empty name, keep the drawing's own.
        size: pixels of the raster's larger side.
        split_paths: whether separate outlines of an unlabelled path are segments of their own.
        open_groups: whether labelled groups are opened; otherwise each is one segment, unless something in it
            is labelled too.
        join_details: whether unlabelled highlights, shading and outlines belong to what they lie on.

    Raises:
        InputError: the file cannot be read, is no SVG, is hostile or too complex, or shows nothing.
    """
    text = read_source(source)
    root = parse_tree(text)
    view = Viewport(root, size, text.what)
    styles = Styles(root)
    references = References(root, styles, text.what)
    references.check()
    painter = Painter(text, root, view, references)
    walk = Walk(text, root, styles, references, partial(_covers, painter), split_paths)
    items = walk.run(view.matrix)
    if len(items) > MAX_DRAWN:
        raise InputError(f"{text.what} draws {len(items)} elements: at most {MAX_DRAWN} are taken apart, group some")
    image = _on_white(painter)
    sights = look(painter, items)
    if not is_faithful(image, (sight.patch for sight in sights)):
        walk.note("blending of elements with what is under them (they are moved as if there were none)")
    shape = (image.shape[0], image.shape[1])
    rough = draft_segments(sights, shape, references.by_id, open_groups)
    drafts = (details.join_details if join_details else details.drop_hidden)(rough, sights, shape)
    if not 1 <= len(drafts) <= MAX_SEGMENTS:
        why = f"has {len(drafts)} segments: at most {MAX_SEGMENTS} are allowed, group some"
        why = why if drafts else "shows nothing that can be moved: it needs shapes that are visible"
        raise InputError(f"{text.what} {why}")
    table, given = _labels(drafts, labels)
    named = frozenset(k for k, draft in enumerate(drafts, 1) if draft.named) | given
    scene = assemble(image, sights, drafts, table)
    members = tuple(tuple(sights[i].item for i in draft.members) for draft in drafts)
    moving = {i for draft in drafts for i in draft.members}
    still = tuple(sight.item for i, sight in enumerate(sights) if i not in moving)
    notes = _notes(text.what, [*walk.notes, *dict.fromkeys(painter.left_out), *dict.fromkeys(styles.unread)])
    return SvgScene(scene, Document(text, root, view.matrix), table, named, members, still, notes)


def _covers(painter: Painter, node: Node, matrix: Matrix) -> bool:
    """Whether the clip of a group leaves the whole picture free: tried on a sheet that covers the picture.

    Args:
        matrix: user units of the group's children to raster pixels.
    """
    width, height = painter.view.raster
    text, back = painter.source.text, inverse(matrix)
    if node.inner >= node.end or back is None:
        return False
    corners = np.array([[-1, -1], [width + 1, -1], [width + 1, height + 1], [-1, height + 1]], float)
    path = "M" + "L".join(f"{x:.9g} {y:.9g}" for x, y in corners @ back[:, :2].T + back[:, 2]) + "Z"
    style = "fill:#000;fill-opacity:1;stroke:none;opacity:1;display:inline;visibility:visible"
    body = f'<path xmlns="{SVG}" style="{style}" d="{path}"/>'.encode()
    instead = {node.order: text[node.start : node.inner] + body + text[node.close : node.end]}
    drawn = painter.draw((0, 0, width, height), [node], scale=0.25, instead=instead)
    return bool((drawn[..., 3] == 255).all())


def _on_white(painter: Painter) -> UInt8[np.ndarray, "H W 3"]:
    width, height = painter.view.raster
    drawn = painter.draw((0, 0, width, height)).astype(np.uint16)
    return np.asarray(np.minimum(drawn[..., :3] + (255 - drawn[..., 3:]), 255).astype(np.uint8))


def _labels(drafts: list[Draft], labels: Any) -> tuple[dict[int, str], frozenset[int]]:
    table = {k: d.label if d.named else numbered_name(d.label, k) for k, d in enumerate(drafts, 1)}
    if labels is None:
        return table, frozenset()
    if isinstance(labels, str | os.PathLike) and Path(labels).suffix.lower() == ".json":
        content = read_json(Path(labels))
        labels = content.get("labels", content) if isinstance(content, dict) else labels
    if isinstance(labels, Mapping):
        filled = {key: value for key, value in labels.items() if not _is_blank(value)}
        given = check_labels(filled) if filled else {}
    else:
        given = read_labels(labels)
    beyond = [k for k in given if k not in table]
    if beyond:
        raise InputError(f"there is a label for segment {beyond[0]}, but the SVG has segments 1 to {len(table)} only")
    return table | given, frozenset(given)


def _is_blank(value: object) -> bool:
    return value is None or (isinstance(value, str) and not value.strip())


def _notes(what: str, found: list[str]) -> tuple[str, ...]:
    return (f"not handled in {what}: {', '.join(found)}",) if found else ()
