"""Drawing chosen elements of an SVG alone, with resvg, from a cleaned copy of the text.

The copy holds only elements that are known to be harmless: no images, no text, no scripts, nothing that names
a file. The rasteriser never sees the file itself.
"""

from __future__ import annotations

import io
import re
from bisect import bisect_left
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from time import monotonic

import numpy as np
from jaxtyping import UInt8

from iconjax.errors import InputError
from iconjax.scene.svg.guard import CONTAINERS, SHAPES, STORES, References
from iconjax.scene.svg.limits import MAX_FILTERS, MAX_PATTERN_SIDE, MAX_SECONDS, MAX_WORK
from iconjax.scene.svg.numbers import Viewport, length, transform
from iconjax.scene.svg.rasteriser import RasteriserError, rasterise
from iconjax.scene.svg.source import Source
from iconjax.scene.svg.tags import drop_attribute, set_attribute, splice
from iconjax.scene.svg.tree import SVG, Node

_OUTWARD = re.compile(rb"""url\(\s*+(?:"|'|&quot;|&apos;)?+\s*+(?!#)[^)]*+\)""", re.IGNORECASE)
_IMPORT = re.compile(rb"@import[^;<]*;?", re.IGNORECASE)
Window = tuple[int, int, int, int]
"""(left, top, width, height) in raster pixels; may reach beyond the picture."""
_CHEAP_FILTERS = frozenset({
    "feBlend", "feColorMatrix", "feComponentTransfer", "feFuncR", "feFuncG", "feFuncB", "feFuncA", "feComposite",
    "feDropShadow", "feFlood", "feGaussianBlur", "feMerge", "feMergeNode", "feOffset",
})  # fmt: skip
_ALLOWED = SHAPES | CONTAINERS | (STORES - {"script", "title", "desc", "metadata"}) | {"use", "stop"} | _CHEAP_FILTERS


@dataclass(frozen=True)
class Patch:
    """A piece of picture: premultiplied 8-bit RGBA and the raster pixel of its first row and column."""

    data: UInt8[np.ndarray, "h w 4"]
    top: int
    left: int


class Painter:
    """Draws elements of one document.

    Attributes:
        left_out: what was taken out of the copy, in words.
    """

    def __init__(self, source: Source, root: Node, view: Viewport, references: References) -> None:
        self.source, self.root, self.view, self.references = source, root, view, references
        self.left_out: list[str] = []
        self._cuts: list[tuple[int, int, bytes]] = []
        self._filters = 0
        for child in root.children:
            self._clean(child)
        self._cuts.sort()
        self._starts = [cut[0] for cut in self._cuts]
        tag = set_attribute(source.text[root.start : root.inner], "viewBox", " ".join(f"{v:.9g}" for v in view.box))
        for name, value in (("width", view.size[0]), ("height", view.size[1]), ("x", 0.0), ("y", 0.0)):
            tag = set_attribute(tag, name, f"{value:.9g}")
        style = "; ".join(part for part in (root.get("style").strip().rstrip(";"), "overflow:visible") if part)
        self._open = set_attribute(tag, "style", style).removesuffix(b"/>")
        self._open += b"" if self._open.endswith(b">") else b">"
        self._shut = b"</" + re.match(rb"<([^\s/>]+)", tag)[1] + b">"  # type: ignore[index]
        self._needed = _needed(references)
        self._work, self._began = 0, monotonic()
        self._texts: dict[int, bytes] = {}

    def draw(
        self,
        window: Window,
        keep: Collection[Node] | None = None,
        *,
        scale: float = 1.0,
        instead: Mapping[int, bytes] | None = None,
    ) -> UInt8[np.ndarray, "h w 4"]:
        """Premultiplied RGBA of a window.

        Args:
            window: in raster pixels.
            keep: only these elements with all in them; None draws everything.
            scale: picture pixels per raster pixel.
            instead: text by element order to draw in place of an element.

        Raises:
            InputError: the rasteriser refuses, or the drawing is too much work.
        """
        left, top, width, height = window
        size = max(1, round(width * scale)), max(1, round(height * scale))
        body = self._body(None if keep is None else {node.order: node for node in keep}, instead or {})
        head = f'<svg xmlns="{SVG}" width="{size[0]}" height="{size[1]}" viewBox="{left} {top} {width} {height}">'
        body = _IMPORT.sub(b"", _OUTWARD.sub(b"invalid", body))
        fit = f'<g transform="scale({self.view.scale:.9g})">'
        return self._rasterise((head + fit).encode() + body + b"</g></svg>", size)

    def text_of(self, node: Node) -> bytes:
        """The cleaned text of an element with all in it."""
        if node.order not in self._texts:
            self._texts[node.order] = self._clean_text(node.start, node.end)
        return self._texts[node.order]

    def _clean_text(self, start: int, end: int) -> bytes:
        first, last = bisect_left(self._starts, start), bisect_left(self._starts, end)
        return splice(self.source.text, self._cuts[first:last], start, end)

    def _body(self, keep: dict[int, Node] | None, instead: Mapping[int, bytes]) -> bytes:
        if keep is None:
            return self._open + b"".join(self.text_of(child) for child in self.root.children) + self._shut
        above = {node.order for leaf in keep.values() for node in leaf.lineage()[1:]}
        out = [self._open]
        self._emit(self.root, keep, above, instead, out)
        out.append(self._shut)
        return b"".join(out)

    def _emit(
        self, node: Node, keep: dict[int, Node], above: set[int], instead: Mapping[int, bytes], out: list[bytes]
    ) -> None:
        for child in node.children:
            if child.order in keep:
                out.append(instead.get(child.order) or self.text_of(child))
            elif child.order in above:
                out.append(self._clean_text(child.start, child.inner))
                self._emit(child, keep, above, instead, out)
                out.append(self.source.text[child.close : child.end])
            elif child.tag in STORES:
                out.append(self.text_of(child))
            elif child.order in self._needed:
                out.append(f'<defs xmlns="{SVG}">'.encode() + self.text_of(child) + b"</defs>")

    def _clean(self, node: Node) -> None:
        """Cut what may not be drawn; what is in an element that is cut needs no cutting."""
        outward = bool(node.href) and not node.href.startswith("#")
        if node.tag not in _ALLOWED or (outward and node.tag == "use"):
            self._cuts.append((node.start, node.end, b""))
            return
        if outward:
            tag = drop_attribute(drop_attribute(self.source.text[node.start : node.inner], "href"), "xlink:href")
            self._cuts.append((node.start, node.inner, tag))
        if node.tag == "filter" and not self._is_cheap(node):
            self.left_out.append("some filters")
            harmless = f'<feOffset xmlns="{SVG}"/>'.encode()
            if node.inner < node.end:
                self._cuts.append((node.inner, node.close, harmless))
            return
        if node.tag == "pattern" and not self._is_small(node):
            self.left_out.append("large patterns")
            self._cuts.append((node.start, node.end, b""))
            return
        for child in node.children:
            self._clean(child)

    def _is_cheap(self, node: Node) -> bool:
        primitives = list(node.walk())[1:]
        self._filters += len(primitives)
        return self._filters <= MAX_FILTERS and all(p.tag in _CHEAP_FILTERS for p in primitives)

    def _is_small(self, node: Node) -> bool:
        """Whether a tile of a pattern fits in memory whatever element it fills."""
        matrix = transform(node.get("patternTransform"))
        if matrix is None:
            return False
        scale = float(np.abs(matrix[:, :2]).sum())
        if node.get("patternUnits") == "userSpaceOnUse":
            scale *= float(np.abs(self.view.matrix[:, :2]).max())
        else:
            scale *= max(self.view.raster)
        sides = [length(node.get(name)) if node.get(name) else 1.0 for name in ("width", "height")]
        return all(side is None or side * scale <= MAX_PATTERN_SIDE for side in sides)

    def _rasterise(self, text: bytes, size: tuple[int, int]) -> UInt8[np.ndarray, "h w 4"]:
        from PIL import Image

        self._work += len(text)
        if self._work > MAX_WORK or monotonic() - self._began > MAX_SECONDS:
            raise InputError(f"{self.source.what} is too complex to take apart: simplify it or group its elements")
        try:
            png = rasterise(text)
        except RasteriserError as error:
            raise InputError(f"{self.source.what} cannot be drawn: {error}") from None
        with Image.open(io.BytesIO(png)) as image:
            rgba = np.asarray(image.convert("RGBA"))
        if rgba.shape[:2] != (size[1], size[0]):
            raise InputError(f"{self.source.what} cannot be drawn: the rasteriser gave a picture of another size")
        return premultiplied(rgba)


def _needed(references: References) -> set[int]:
    """Orders of the elements that something elsewhere may refer to, or that hold such an element."""
    named = (node for nodes in references.by_id.values() for node in nodes)
    marked = (node for node in named if node.order in references.used or node.tag in STORES)
    return {holder.order for node in marked for holder in node.lineage()}


def premultiplied(rgba: UInt8[np.ndarray, "h w 4"]) -> UInt8[np.ndarray, "h w 4"]:
    """Colours times coverage, in 8 bits: what the rasteriser had before it wrote a PNG."""
    out = rgba.copy()
    part = (rgba[..., 3] > 0) & (rgba[..., 3] < 255)
    alpha = rgba[part][:, 3:].astype(np.uint32)
    out[part, :3] = (rgba[part][:, :3] * alpha + 127) // 255
    out[rgba[..., 3] == 0] = 0
    return out
