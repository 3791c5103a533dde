"""The few style properties that decide how elements may be moved, by the cascade.

Drawing is left to the rasteriser, which has a cascade of its own; this one only answers questions such as
whether a group is transparent as a whole.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from iconjax.scene.svg.tree import Node

PRESENTATION = frozenset({
    "fill", "stroke", "stroke-width", "stroke-dasharray", "fill-rule", "opacity", "clip-path", "mask", "filter",
    "mix-blend-mode", "isolation", "transform", "transform-origin", "marker-start", "marker-mid", "marker-end",
    "display", "visibility", "vector-effect",
})  # fmt: skip
_INHERITED = frozenset({
    "fill", "stroke", "stroke-width", "stroke-dasharray", "fill-rule", "marker-start", "marker-mid", "marker-end",
    "visibility",
})  # fmt: skip
MOST_RULES = 2_000
MOST_PARTS = 3
"""Longer selectors are not understood; matching them could take for ever."""
_COMPOUND = re.compile(r"(\*|[A-Za-z_][\w-]*)?((?:[.#][\w-]+)*)$")


@dataclass(frozen=True)
class _Rule:
    parts: tuple[tuple[str, str], ...]  # (combinator before it, compound selector), outermost first
    weight: tuple[int, int, int, int]
    values: dict[str, str]


class Styles:
    """Answers `value(node, property)`; `unread` lists what of the style sheets is not understood."""

    def __init__(self, root: Node) -> None:
        self.unread: list[str] = []
        self.rules: list[_Rule] = []
        for node in root.walk():
            if node.tag == "style" and node.text.strip():
                self._read_sheet(node.text)
        self.rules.sort(key=lambda rule: rule.weight)
        self._index: dict[str, list[_Rule]] = {}
        for rule in self.rules:
            self._index.setdefault(_key(rule.parts[-1][1]), []).append(rule)
        self._own: dict[int, dict[str, str]] = {}

    def value(self, node: Node, name: str) -> str:
        """The value of a property, inherited where it inherits; "" where it is not set."""
        at: Node | None = node
        while at is not None:
            found = self.own(at).get(name, "")
            if found and found != "inherit":
                return found
            at = at.parent if name in _INHERITED or found == "inherit" else None
        return ""

    def own(self, node: Node) -> dict[str, str]:
        """What is set on the element itself: attributes, then rules by weight, then its style attribute."""
        known = self._own.get(node.order)
        if known is None:
            known = {k: v.strip() for k, v in node.attributes.items() if k in PRESENTATION}
            strong: dict[str, str] = {}
            for rule in self._candidates(node):
                if _matches(rule.parts, node):
                    _put(known, strong, rule.values)
            if "style" in node.attributes:
                _put(known, strong, self._declarations(node.get("style")))
            known.update(strong)
            self._own[node.order] = known
        return known

    def named(self, word: str) -> bool:
        """Whether a rule selects by this id or class, given as "#id" or ".class"."""
        pattern = re.compile(re.escape(word) + r"(?![\w-])")
        return any(pattern.search(compound) for rule in self.rules for _, compound in rule.parts)

    def _candidates(self, node: Node) -> list[_Rule]:
        keys = ["*", node.tag, "#" + node.get("id"), *("." + word for word in node.get("class").split())]
        found = [rule for key in dict.fromkeys(keys) for rule in self._index.get(key, ())]
        return sorted(found, key=lambda rule: rule.weight)

    def _read_sheet(self, text: str) -> None:
        import tinycss2

        for item in tinycss2.parse_stylesheet(text, skip_comments=True, skip_whitespace=True):
            if item.type != "qualified-rule":
                what = f"@{item.at_keyword}" if item.type == "at-rule" else "an error in a style sheet"
                self.unread.append(f"css {what}" if what.startswith("@") else what)
                continue
            values = self._declarations(item.content)
            for selector in tinycss2.serialize(item.prelude).split(","):
                self._read_rule(selector.strip(), values)

    def _read_rule(self, selector: str, values: dict[str, str]) -> None:
        tokens = re.sub(r"\s*>\s*", " > ", selector).split()
        parts: list[tuple[str, str]] = []
        combinator = " "
        for token in tokens:
            if token == ">":
                combinator = ">"
                continue
            if not _COMPOUND.match(token):
                self.unread.append(f"css selector {selector[:40]!r}")
                return
            parts.append((combinator, token))
            combinator = " "
        if not parts or len(parts) > MOST_PARTS or len(self.rules) >= MOST_RULES:
            self.unread.append(f"css selector {selector[:40]!r}")
            return
        text = "".join(p for _, p in parts)
        names = sum(1 for _, p in parts if re.match(r"[A-Za-z_]", p))
        weight = (text.count("#"), text.count("."), names, len(self.rules))
        self.rules.append(_Rule(tuple(parts), weight, values))

    def _declarations(self, content: object) -> dict[str, str]:
        import tinycss2

        values: dict[str, str] = {}
        for item in tinycss2.parse_blocks_contents(content, skip_comments=True, skip_whitespace=True):
            if item.type == "declaration" and item.lower_name in PRESENTATION:
                mark = "!" if item.important else ""
                values[item.lower_name] = mark + tinycss2.serialize(item.value).strip()
        return values


def _key(compound: str) -> str:
    """The mark by which a rule is looked up: what an element must have for the last part to match."""
    found = re.search(r"#[\w-]+", compound) or re.search(r"\.[\w-]+", compound)
    return found[0] if found else compound


def _put(known: dict[str, str], strong: dict[str, str], values: dict[str, str]) -> None:
    for name, value in values.items():
        if value.startswith("!"):
            strong[name] = value[1:]
        else:
            known[name] = value


def _matches(parts: tuple[tuple[str, str], ...], node: Node) -> bool:
    if not parts or not _fits(parts[-1][1], node):
        return False
    combinator, rest = parts[-1][0], parts[:-1]
    if not rest:
        return True
    at = node.parent
    while at is not None:
        if _matches(rest, at):
            return True
        at = at.parent if combinator == " " else None
    return False


def _fits(compound: str, node: Node) -> bool:
    found = _COMPOUND.match(compound)
    if found is None or (found[1] not in (None, "*", node.tag)):
        return False
    classes = node.get("class").split()
    marks = re.findall(r"([.#])([\w-]+)", found[2])
    return all(word in classes if kind == "." else word == node.get("id") for kind, word in marks)
