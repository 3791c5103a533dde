"""The elements of an SVG that are moved as wholes, in paint order, and what stands in the way of finer ones."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace

from iconjax.scene.svg.guard import CONTAINERS, SHAPES, STORES, References
from iconjax.scene.svg.limits import MAX_PAIRS
from iconjax.scene.svg.numbers import IDENTITY, Matrix, compose, inverse, length, transform
from iconjax.scene.svg.pathdata import pieces, subpaths
from iconjax.scene.svg.source import Source
from iconjax.scene.svg.styles import Styles
from iconjax.scene.svg.tags import drop_attribute, set_attribute
from iconjax.scene.svg.tree import Node

UNDRAWN = {
    "text": "text", "image": "embedded images", "foreignObject": "foreign objects", "script": "scripts",
    "video": "videos", "audio": "sounds", "iframe": "frames", "canvas": "canvases",
    "animate": "animations", "animateTransform": "animations", "animateMotion": "animations",
    "animateColor": "animations", "set": "animations", "flowRoot": "text",
}  # fmt: skip
"""What is not drawn, and how a note calls it."""


def _moves_in_time(node: Node) -> bool:
    """Whether a browser puts an animated transform in the place of the written one."""
    if node.tag == "style":
        return "@keyframes" in node.text and "transform" in node.text
    return node.tag == "animateTransform" and node.get("additive") != "sum"


@dataclass(frozen=True, eq=False)
class Item:
    """Something that is moved as a whole.

    Attributes:
        node: the element.
        outer: user units of the element's parent to raster pixels.
        groups: the groups around it that were opened, outermost first.
        group_outers: for each of them, the user units of its parent to raster pixels.
        outlines: positions of the outlines of the path that it stands for; None for the whole element.
        text: what to draw in place of the element where it stands for some outlines of it.
        wrapped: whether something refers to the element, so that it is moved by a group put around it.
        fixed: whether it cannot be moved.
    """

    node: Node
    outer: Matrix = field(repr=False)
    groups: tuple[Node, ...] = field(default=(), repr=False)
    group_outers: tuple[Matrix, ...] = field(default=(), repr=False)
    outlines: tuple[int, ...] | None = None
    text: bytes | None = field(default=None, repr=False)
    wrapped: bool = False
    fixed: bool = False


@dataclass(frozen=True)
class _Around:
    groups: tuple[Node, ...] = ()
    outers: tuple[Matrix, ...] = ()


class Walk:
    """Finds the items of a document.

    Attributes:
        items: in paint order.
        notes: what is not handled, in words.
    """

    def __init__(
        self,
        source: Source,
        root: Node,
        styles: Styles,
        references: References,
        covers: Callable[[Node, Matrix], bool],
        split_paths: bool,
    ) -> None:
        self.source, self.styles, self.references = source, styles, references
        self.covers, self.split_paths = covers, split_paths
        self.items: list[Item] = []
        self.notes: list[str] = []
        self._root, self._pairs = root, 0
        for node in root.walk():
            if node.tag in UNDRAWN:
                self.note(f"{UNDRAWN[node.tag]} (not drawn)")
            if _moves_in_time(node):
                self.note("animations of transform (in a browser they override the edit of what they move)")
            if styles.own(node).get("vector-effect", "none") != "none":
                self.note("vector effects (strokes are scaled with the rest)")

    def run(self, matrix: Matrix) -> list[Item]:
        """Items of the document, `matrix` being the map from the root's user units to raster pixels."""
        if why := self._whole(self._root):
            self.note(f"{why} on the root element")
        own = transform(self._root.get("transform")) if self._root.get("transform") else IDENTITY
        outer = compose(matrix, own) if own is not None else matrix
        for child in self._root.children:
            self._visit(child, outer, _Around(), False)
        return self.items

    def note(self, what: str) -> None:
        if what not in self.notes:
            self.notes.append(what)

    def _visit(self, node: Node, outer: Matrix, around: _Around, fixed: bool) -> None:
        if node.tag in STORES or node.tag.startswith("{") or node.tag in UNDRAWN:
            return
        if self.styles.value(node, "display") == "none":
            return
        matrix = self._matrix(node)
        fixed = fixed or matrix is None or inverse(outer) is None
        wrapped = node.order in self.references.used
        if self._whole(node) == "filter":
            self.note("filters (moved as pictures)")
        if node.tag in ("g", "a") and not wrapped:
            why = self._whole(node)
            inner = outer if matrix is None else compose(outer, matrix)
            if not why or (why == "clip-path" and node.tag == "g" and self.covers(node, inner)):
                within = _Around((*around.groups, node), (*around.outers, outer))
                for child in node.children:
                    self._visit(child, inner, within, fixed)
                return
            if sum(n.tag in SHAPES for n in node.walk()) > 1:
                self.note(f"a group with {why} (kept as one)")
        elif node.tag not in SHAPES | CONTAINERS | {"use"}:
            return
        found = [Item(node, outer, around.groups, around.outers, wrapped=wrapped, fixed=fixed)]
        if node.tag == "path" and not (wrapped or fixed) and self.split_paths:
            found = self._split(found[0]) or found
        self.items += found

    def _matrix(self, node: Node) -> Matrix | None:
        """The element's own transform; None, with a note, where it is not understood."""
        own = self.styles.own(node)
        text = node.get("transform").strip()
        if own.get("transform", "").strip() != text:
            self.note("css transforms (kept in place)")
            return None
        if "transform-origin" in own and text:
            self.note("transform-origin (kept in place)")
            return None
        if not text or text == "none":
            return IDENTITY
        matrix = transform(text)
        if matrix is None:
            self.note(f"the transform {text[:40]!r} (kept in place)")
        return matrix

    def _whole(self, node: Node) -> str:
        """Why the children of a group cannot move apart, "" where they can."""
        own = self.styles.own(node)
        for name in ("mask", "filter", "clip-path"):
            if own.get(name, "none") != "none":
                return name
        if own.get("opacity", "1") not in ("1", "1.0", "100%"):
            return "opacity"
        if own.get("mix-blend-mode", "normal") != "normal" or own.get("isolation", "auto") != "auto":
            return "blending"
        return ""

    def _split(self, item: Item) -> list[Item]:
        """One item per separate outline of a path; none where the path has to stay whole."""
        node, value = item.node, self.styles.value
        paints = [value(item.node, name) or default for name, default in (("fill", "black"), ("stroke", "none"))]
        effects = ["clip-path", "mask", "filter", "marker-start", "marker-mid", "marker-end"]
        if any("url(" in text for text in (*paints, *(value(node, name) for name in effects))):
            return []
        if any(child.tag not in ("title", "desc") for child in node.children) or node.get("pathLength"):
            return []
        if node.get("id") and self.styles.named("#" + node.get("id")):
            return []
        width = 0.0 if paints[1] == "none" else length(value(node, "stroke-width") or "1") or 1.0
        rule = value(node, "fill-rule") or "nonzero"
        self._pairs += len(subpaths(node.get("d"))) ** 2
        if self._pairs > MAX_PAIRS:
            return []
        found = pieces(node.get("d"), rule, filled=paints[0] != "none", stroke=width)
        if len(found) < 2:
            return []
        return [
            replace(item, outlines=outlines, text=piece_text(self.source, node, outlines, first=k == 0))
            for k, outlines in enumerate(found)
        ]


def piece_text(source: Source, node: Node, outlines: tuple[int, ...], *, first: bool) -> bytes:
    """A path element with only some of its outlines; only the first piece keeps the id and what is inside."""
    parts = subpaths(node.get("d"))
    tag = set_attribute(source.text[node.start : node.inner], "d", "".join(parts[k].text for k in outlines))
    if first:
        return tag + source.text[node.inner : node.end]
    tag = drop_attribute(tag, "id")
    return tag if tag.endswith(b"/>") else tag[:-1] + b"/>"
