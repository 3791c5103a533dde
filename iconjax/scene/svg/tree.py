"""The element tree of an SVG with the exact place of every tag; declarations of entities are refused."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import NoReturn
from xml.parsers import expat

from iconjax.errors import InputError
from iconjax.scene.svg.limits import MAX_DEPTH, MAX_ELEMENTS
from iconjax.scene.svg.source import Source

SVG = "http://www.w3.org/2000/svg"
XLINK = "http://www.w3.org/1999/xlink"
INKSCAPE = "http://www.inkscape.org/namespaces/inkscape"
_PREFIX = {SVG: "", XLINK: "xlink:", INKSCAPE: "inkscape:", "http://www.w3.org/XML/1998/namespace": "xml:"}


@dataclass(eq=False)
class Node:
    """One element.

    Attributes:
        tag: local name in the SVG namespace; otherwise "{namespace}name".
        attributes: by name; `xlink:href` and `inkscape:label` keep these prefixes whatever the file calls them.
        start: offset of "<" in the UTF-8 text.
        inner: offset behind the start tag.
        end: offset behind the whole element.
        line: line of the start tag, from 1.
        order: position in the document.
        parent: None for the root.
        text: character data directly inside.
    """

    tag: str
    attributes: dict[str, str]
    start: int
    line: int
    order: int
    parent: Node | None
    inner: int = 0
    end: int = 0
    close: int = 0
    text: str = ""
    children: list[Node] = field(default_factory=list)

    def get(self, name: str, default: str = "") -> str:
        """An attribute's value."""
        return self.attributes.get(name, default)

    @property
    def href(self) -> str:
        """What the element refers to, "" for nothing."""
        return (self.get("href") or self.get("xlink:href")).strip()

    def walk(self) -> Iterator[Node]:
        """The element and all in it, in document order."""
        stack = [self]
        while stack:
            node = stack.pop()
            yield node
            stack += reversed(node.children)

    def lineage(self) -> list[Node]:
        """The element and what it lies in, innermost first."""
        out, node = [], self
        while True:
            out.append(node)
            if node.parent is None:
                return out
            node = node.parent


def parse_tree(source: Source) -> Node:
    """The root element.

    Raises:
        InputError: not well-formed, no SVG, entities, nested too deeply or too many elements.
    """
    builder = _Builder(source)
    return builder.run()


class _Builder:
    def __init__(self, source: Source) -> None:
        self.source = source
        self.root: Node | None = None
        self.stack: list[Node] = []
        self.count = 0
        parser = expat.ParserCreate("utf-8", " ")
        parser.buffer_text = True
        parser.specified_attributes = True
        parser.SetParamEntityParsing(expat.XML_PARAM_ENTITY_PARSING_NEVER)
        parser.StartElementHandler = self.open
        parser.EndElementHandler = self.shut
        parser.CharacterDataHandler = self.characters
        parser.EntityDeclHandler = self.entity
        parser.ExternalEntityRefHandler = self.external
        parser.SkippedEntityHandler = self.skipped
        self.parser = parser

    def run(self) -> Node:
        what = self.source.what
        try:
            self.parser.Parse(self.source.text, True)
        except expat.ExpatError as error:
            reason = expat.ErrorString(error.code)
            raise InputError(
                f"{what} is not well-formed XML: {reason} at line {error.lineno}, column {error.offset + 1}"
            ) from None
        if self.root is None or self.root.tag != "svg":
            raise InputError(f'{what} is no SVG: its root has to be <svg xmlns="{SVG}">')
        return self.root

    def open(self, name: str, attributes: dict[str, str]) -> None:
        self.count += 1
        if self.count > MAX_ELEMENTS:
            self.fail(f"has more than {MAX_ELEMENTS} elements: simplify it")
        if len(self.stack) >= MAX_DEPTH:
            self.fail(f"is nested more than {MAX_DEPTH} elements deep: ungroup it")
        at = self.parser.CurrentByteIndex
        parent = self.stack[-1] if self.stack else None
        table = {_local(key): value for key, value in attributes.items()}
        node = Node(
            _local(name) if " " in name else "{}" + name,
            table,
            at,
            self.parser.CurrentLineNumber,
            self.count - 1,
            parent,
        )
        node.inner = tag_end(self.source.text, at)
        node.close = node.inner
        if parent is None:
            self.root = node
        else:
            parent.children.append(node)
        self.stack.append(node)

    def shut(self, name: str) -> None:
        node = self.stack.pop()
        text = self.source.text
        if text[node.inner - 2 : node.inner] == b"/>":
            node.end = node.inner
        else:
            node.close = self.parser.CurrentByteIndex
            node.end = text.index(b">", node.close) + 1

    def characters(self, data: str) -> None:
        if self.stack and self.stack[-1].tag in ("style", "title", "desc"):
            self.stack[-1].text += data

    def entity(self, name: str, *rest: object) -> None:
        self.fail(f"declares the entity {name[:40]!r}, which is not allowed: save it as plain SVG")

    def external(self, *rest: object) -> int:
        self.fail("refers to an external entity, which is not allowed: save it as plain SVG")

    def skipped(self, name: str, *rest: object) -> None:
        self.fail(f"uses the entity {name[:40]!r}, which it does not define: save it as plain SVG")

    def fail(self, why: str) -> NoReturn:
        raise InputError(f"{self.source.what} {why}")


_TAG = re.compile(rb"""<(?:[^"'>]|"[^"]*"|'[^']*')*>""")


def tag_end(text: bytes, start: int) -> int:
    """Offset behind the tag that begins at `start`."""
    found = _TAG.match(text, start)
    assert found is not None, "expat saw a whole tag here"
    return found.end()


def _local(name: str) -> str:
    space, gap, local = name.rpartition(" ")
    if not gap:
        return name
    prefix = _PREFIX.get(space)
    return f"{{{space}}}{local}" if prefix is None else prefix + local
