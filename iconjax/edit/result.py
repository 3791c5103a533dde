"""What an edit gives back."""

from __future__ import annotations

import base64
import json
import math
import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from html import escape
from typing import TYPE_CHECKING, Any

import numpy as np
from jaxtyping import Float, UInt8

from iconjax.checks import is_vector
from iconjax.edit.explain import explain
from iconjax.errors import InputError
from iconjax.files import encode_image, image_format, write_bytes, write_text
from iconjax.scene.types import Scene
from iconjax.search.types import ConstraintReport, RelationReport, TraceEntry

if TYPE_CHECKING:
    from iconjax.scene.svg import SvgScene


@dataclass(frozen=True, eq=False)
class EditResult:
    """An edited picture, how it came about, and how well it does what was asked.

    Attributes:
        image: (H, W, 3) the edited picture.
        transforms: segment id -> (2, 3) affine map, original to edited pixels; the identity for what stayed.
        program: the primary constraints, one call each.
        relations: the secondary constraints with their final states.
        satisfied: whether every primary constraint holds within tolerance.
        constraints: every primary constraint with its violation.
        score: the cost of the chosen candidate; infinite when a primary constraint could not be met.
        motion_states: segment id -> "N", "T", "TR", "TS" or "TRS".
        depth_order: segment ids from back to front.
        timings: seconds by stage: "translate", "compile", "search", "render".
        translator: which translator read the request, or "program" when the program was given.
        request: the sentence.
        understood: the translator's reading in plain words.
        notes: what you should know about this result.
        trace: every candidate that the search solved.
        version: version of iconjax.
        scene: the picture before the edit, with its segments.
        rounds: how often the translator was asked to think again.
        gloss: the reading that was followed, in one line.
        vector: the SVG that was edited; None for a raster picture.
        interpretations: where several readings were asked for, the result of each different one, this one first.
    """

    image: UInt8[np.ndarray, "H W 3"] = field(repr=False)
    transforms: Mapping[int, Float[np.ndarray, "2 3"]] = field(repr=False)
    program: tuple[str, ...]
    relations: tuple[RelationReport, ...] = field(repr=False)
    satisfied: bool
    constraints: tuple[ConstraintReport, ...]
    score: float
    motion_states: Mapping[int, str]
    depth_order: tuple[int, ...]
    timings: Mapping[str, float]
    translator: str
    request: str
    understood: tuple[str, ...]
    notes: tuple[str, ...]
    trace: tuple[TraceEntry, ...] = field(repr=False)
    version: str
    scene: Scene = field(repr=False)
    rounds: int = 0
    gloss: str = ""
    vector: SvgScene | None = field(default=None, repr=False)
    interpretations: tuple[EditResult, ...] = field(default=(), repr=False)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the edited picture; its name decides the format. The file appears whole or not at all.

        An edited SVG can be written as .svg or .svgz: the same file with a `transform` on what moved.

        Raises:
            InputError: unknown ending, .svg for what was no SVG, missing folder, no permission, full disk.
        """
        if is_vector(path):
            if self.vector is None:
                raise InputError(f"cannot write {path}: only an edited SVG can be saved as SVG, name it .png")
            from iconjax.render.svg import save_svg

            moves = np.array([self.transforms[s.id] for s in self.scene.segments])
            return save_svg(self.vector, moves, path)
        write_bytes(path, encode_image(self.image, image_format(path)))

    def to_dict(self) -> dict[str, Any]:
        """The result as plain data, with the keys of the result format; also "rounds" where the translator had to think
        again, and "interpretations" where several were asked for."""
        further: dict[str, Any] = {"rounds": self.rounds} if self.rounds else {}
        if self.interpretations:
            further["interpretations"] = [{"gloss": r.gloss, **r.to_dict()} for r in self.interpretations]
        return {
            "request": self.request,
            "program": list(self.program),
            "translator": self.translator,
            "satisfied": self.satisfied,
            "score": finite(self.score),
            "transforms": {str(k): [[float(v) for v in row] for row in m] for k, m in self.transforms.items()},
            "motion_states": {str(k): v for k, v in self.motion_states.items()},
            "relations": [
                {"a": r.a, "b": r.b, "kind": r.kind, "scope": r.scope, "state": r.state} for r in self.relations
            ],
            "constraints": [
                {
                    "text": c.text,
                    "role": c.role,
                    "violation": finite(c.violation),
                    "satisfied": bool(c.satisfied),
                }
                for c in self.constraints
            ],
            "depth_order": list(self.depth_order),
            "timings": {k: finite(v) for k, v in self.timings.items()},
            "version": self.version,
            **further,
        }

    def to_json(self, path: str | os.PathLike[str] | None = None) -> str:
        """The result as JSON text; also written to `path` if given. An infinite number becomes null.

        Raises:
            InputError: `path` cannot be written.
        """
        text = json.dumps(self.to_dict(), indent=1, ensure_ascii=False, allow_nan=False)
        if path is not None:
            write_text(path, text + "\n")
        return text

    def to_html(self, path: str | os.PathLike[str] | None = None) -> str:
        """One self-contained HTML page that shows the edit and what the search tried; also written to `path`.

        Raises:
            InputError: `path` cannot be written.
        """
        from iconjax.edit.page import page  # only this needs it

        text = page(self)
        if path is not None:
            write_text(path, text)
        return text

    def explain(self) -> str:
        """What was asked, what was done and what does not hold, in plain words."""
        return explain(self)

    def missed(self) -> tuple[ConstraintReport, ...]:
        """The primary constraints that do not hold."""
        return tuple(c for c in self.constraints if not c.satisfied)

    def _repr_png_(self) -> bytes:
        return encode_image(self.image)

    def _repr_html_(self) -> str:
        style = "max-width:45%;max-height:360px;margin-right:12px;border:1px solid #ddd;background:#fff"
        pictures = "".join(
            f'<img alt="{name}" title="{name}" style="{style}" src="{data_uri(image)}">'
            for name, image in (("before", self.scene.image), ("after", self.image))
        )
        return f"<div>{pictures}<pre>{escape(self.explain())}</pre></div>"


def data_uri(image: UInt8[np.ndarray, "H W 3"]) -> str:
    """`image` as a PNG that an HTML page can carry inside itself."""
    return "data:image/png;base64," + base64.b64encode(encode_image(image)).decode("ascii")


def finite(value: float) -> float | None:
    """`value`, or None where JSON has no number for it."""
    return float(value) if math.isfinite(value) else None
