"""Segments that a picture comes with, with or without names: SVGs, case folders, images with a label map."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from iconjax.checks import check_folder, is_vector
from iconjax.errors import InputError
from iconjax.scene.build import build_scene
from iconjax.scene.labels import number_names, read_labels
from iconjax.scene.load import MAX_SEGMENTS, check_sizes, load_case, load_image
from iconjax.scene.pixels import mask_of_pil, open_image
from iconjax.scene.segment.folder import parts_files
from iconjax.scene.segment.names import provisional_names
from iconjax.scene.types import Scene, Segmentation


@dataclass(frozen=True)
class Given:
    """What there is to name.

    Attributes:
        scene: the picture with its segments.
        segmentation: its label map, and its labels before repeated ones are numbered.
        named: ids of the segments whose label somebody gave; those of the others are provisional.
        notes: what the picture holds that is not handled, one line each.
    """

    scene: Scene
    segmentation: Segmentation
    named: frozenset[int]
    notes: tuple[str, ...] = ()

    def renamed(self, labels: Mapping[int, str]) -> Scene:
        """The scene under other names."""
        boxes = {s.id: s.box for s in self.scene.segments}
        centres = {k: ((x0 + x1) / 2, (y0 + y1) / 2) for k, (x0, y0, x1, y1) in boxes.items()}
        names = number_names({k: labels[k] for k in boxes}, centres, self.scene.width)
        return replace(self.scene, segments=tuple(replace(s, name=names[s.id]) for s in self.scene.segments))


def open_segments(picture: str, seg: str | None = None, labels: str | None = None) -> Given:
    """Read a picture with its segments; those without a name get a provisional one.

    Args:
        picture: path of an SVG, a case folder, a folder made by `iconjax segment`, or an image.
        seg: path of the image's label map.
        labels: path of names, JSON or CSV; it may leave segments out.

    Raises:
        InputError: something is missing or cannot be used; the message says what to do.
    """
    path = Path(picture)
    if not path.exists():
        raise InputError(f"there is no file or folder {picture}")
    if is_vector(picture):
        return _vector(picture, seg, labels)
    picture, seg, labels = parts_files(picture, seg, labels)
    if Path(picture).is_dir():
        if seg is not None:
            raise InputError(f"{picture} is a case folder, which has its own segmentation: leave out --seg")
        check_folder(path)
        case = load_case(picture)
        found = case.segmentation
        names = {**found.labels, **_known(labels, found.labels)}
        found = Segmentation(found.mask, names)
        return Given(build_scene(case.image, found), found, frozenset(names))
    if seg is None:
        raise InputError(
            f"{picture} is an image without segments: give --seg (a label map), or run iconjax segment {picture}"
        )
    image = load_image(picture)
    mask = mask_of_pil(open_image(seg, "segmentation"), f"the segmentation {seg}")
    ids = [int(k) for k in np.unique(mask) if k > 0]
    if not 0 < len(ids) <= MAX_SEGMENTS:
        raise InputError(f"the segmentation {seg} has {len(ids)} segments: 1 to {MAX_SEGMENTS} are allowed")
    check_sizes(image, Segmentation(mask, {}))
    own = provisional_names(mask, image)
    known = _known(labels, own)
    found = Segmentation(mask, {**own, **known})
    # A labels file that `iconjax segment` wrote holds provisional names until somebody changes them.
    plain = provisional_names(mask, image, colours=False)
    named = frozenset(k for k, name in known.items() if name not in (own[k], plain[k]))
    return Given(build_scene(image, found), found, named)


def _known(labels: str | None, own: Mapping[int, str]) -> dict[int, str]:
    """The names in a labels file, which may leave some out but names no segment that there is not."""
    names = {} if labels is None else read_labels(labels)
    unknown = next((k for k in names if k not in own), None)
    if unknown is not None:
        raise InputError(f"{labels} names segment {unknown}, which the segmentation does not have: remove it")
    return names


def _vector(picture: str, seg: str | None, labels: str | None) -> Given:
    from iconjax.scene.svg import open_svg  # only an SVG needs it

    if seg is not None:
        raise InputError(f"{picture} is an SVG, which has its segments in itself: leave out --seg")
    opened = open_svg(picture, labels)
    ids = np.array([0, *(segment.id for segment in opened.scene.segments)], dtype=np.int32)
    mask = ids[opened.scene.position_map() + 1]
    return Given(opened.scene, Segmentation(mask, opened.labels), frozenset(opened.named), opened.notes)
