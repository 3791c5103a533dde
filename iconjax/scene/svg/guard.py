"""What an SVG refers to: cycles and explosions are refused before anything is drawn."""

from __future__ import annotations

import re
from collections.abc import Iterator

from iconjax.errors import InputError
from iconjax.scene.svg.limits import MAX_DEPTH, MAX_EXPANDED, MAX_NUMBER, MAX_PATH
from iconjax.scene.svg.styles import Styles
from iconjax.scene.svg.tree import Node

SHAPES = frozenset({
    "path", "rect", "circle", "ellipse", "line", "polyline", "polygon",
})  # fmt: skip
CONTAINERS = frozenset({
    "svg", "g", "a", "switch",
})  # fmt: skip
STORES = frozenset({
    "defs", "symbol", "clipPath", "mask", "pattern", "marker", "linearGradient", "radialGradient", "filter",
    "style", "title", "desc", "metadata", "script",
})  # fmt: skip
"""Elements whose content is not drawn where it stands."""
_URL = re.compile(r"""url\(\s*+["']?+\s*+#([^"')\s]++)""")
_PAINTS = ("fill", "stroke", "marker-start", "marker-mid", "marker-end")
_EFFECTS = ("clip-path", "mask", "filter")
_LARGE = re.compile(r"\d{10,}|\d+\.?\d*[eE]\+?\d+")
_GEOMETRY = ("d", "points", "x", "y", "width", "height", "r", "rx", "ry", "cx", "cy", "x1", "y1", "x2", "y2")
LAYER_COST = 15
"""A group that needs a picture of its own costs as much as so many elements."""


def _is_huge(text: str) -> bool:
    """Whether a text holds a number so large that rasterisers go astray; only what looks like one is read."""
    return any(abs(float(number)) > MAX_NUMBER for number in _LARGE.findall(text))


class References:
    """Who refers to whom.

    Attributes:
        by_id: the elements of each id.
        used: orders of the elements that something refers to by `href`.
    """

    def __init__(self, root: Node, styles: Styles, what: str) -> None:
        self.root, self.styles, self.what = root, styles, what
        self.by_id: dict[str, list[Node]] = {}
        for node in root.walk():
            if node.get("id"):
                self.by_id.setdefault(node.get("id"), []).append(node)
        self.used = {
            target.order for node in root.walk() if node.href.startswith("#") for target in self._named(node.href[1:])
        }
        self._cost: dict[int, tuple[int, int]] = {}

    def check(self) -> None:
        """Follow every reference once.

        Raises:
            InputError: an element contains itself, or too much would be drawn.
        """
        for node in self.root.walk():
            if len(node.get("d")) > MAX_PATH or len(node.get("points")) > MAX_PATH:
                raise InputError(f"{self.what} has a path of more than {MAX_PATH} characters at line {node.line}")
            if node.tag in SHAPES and any(_is_huge(node.get(name)) for name in _GEOMETRY):
                raise InputError(f"{self.what} has a number beyond {MAX_NUMBER:g} at line {node.line}: that is no icon")
        for node in self.root.walk():
            self._measure(node, set(), 0)

    def targets(self, node: Node) -> Iterator[tuple[Node, int]]:
        """What drawing `node` draws besides its children, and how often."""
        if node.href.startswith("#") and node.tag != "a":
            yield from ((target, 1) for target in self._named(node.href[1:]))
        own = self.styles.own(node)
        names = [name for name in _EFFECTS if name in own]
        if node.tag in SHAPES:
            names += _PAINTS
        for name in names:
            times = 1
            if name.startswith("marker"):
                times = 1 + (len(node.get("d")) + len(node.get("points"))) // 4
            for word in _URL.findall(self.styles.value(node, name)):
                yield from ((target, times) for target in self._named(word))

    def _named(self, word: str) -> list[Node]:
        return self.by_id.get(word, [])

    def _measure(self, node: Node, open_nodes: set[int], depth: int) -> tuple[int, int]:
        """(elements drawn, depth) of a subtree with all it refers to."""
        known = self._cost.get(node.order)
        if known is None:
            if depth > MAX_DEPTH:
                raise InputError(f"{self.what} refers from element to element more than {MAX_DEPTH} deep")
            if node.order in open_nodes:
                name = f" (id {node.get('id')[:40]!r})" if node.get("id") else ""
                raise InputError(f"{self.what} has a <{node.tag}> at line {node.line}{name} that contains itself")
            open_nodes.add(node.order)
            known = self._sum(node, open_nodes, depth)
            open_nodes.discard(node.order)
            self._cost[node.order] = known
        if known[0] > MAX_EXPANDED:
            raise InputError(
                f"{self.what} draws more than {MAX_EXPANDED} elements once its references are followed: simplify it"
            )
        if depth + known[1] > MAX_DEPTH:
            raise InputError(f"{self.what} refers from element to element more than {MAX_DEPTH} deep")
        return known

    def _sum(self, node: Node, open_nodes: set[int], depth: int) -> tuple[int, int]:
        own = self.styles.own(node)
        total = 1 + (LAYER_COST if any(name in own for name in (*_EFFECTS, "opacity", "mix-blend-mode")) else 0)
        deep = 0
        parts = [(child, 1) for child in node.children if child.tag not in STORES or node.tag in STORES]
        for part, times in (*parts, *self.targets(node)):
            count, below = self._measure(part, open_nodes, depth + 1)
            total += count * times
            deep = max(deep, below)
        return total, deep + 1
