"""Names for what an SVG draws: those in the file where they mean something, else colour and shape."""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping, Sequence

import numpy as np
from jaxtyping import Float

from iconjax.scene.colours import colour_word
from iconjax.scene.svg.tree import Node

_MADE_UP = re.compile(
    r"""^(
    (path|rect|rectangle|circle|ellipse|oval|line|polyline|polygon|poly|group|grp|use|svg|layer|artboard|page|clip
     |clip[ ]?path|mask|shape|vector|union|subtract|subtraction|intersect|exclude|frame|icon|icons|symbol|image|img
     |text|tspan|fill|stroke|bitmap|combined[ ]shape|compound[ ]path|path[ ]copy|cls|st|fil|str|xmlid|svgid|id|node
     |object|element|item|isolation[ ]mode|capa|calque|ebene|livello|warstwa|glyph|root|main|container|wrapper
     |background|bg|canvas|grid|bounding[ ]box|transparent[ ]rectangle|color|colour|colors|lines|outline|outlines
     |color[ ]foreground|line[ ]supplement|skin[ ]shadow|stroke[ ]?\d*|export|default|filled|outlined|solid|regular
     |primary|secondary|accent|opacity|lucide|tabler|feather|bi|fa|mdi|material|ionicon|emoji|g|a|b|c|d|e|f|i|s)
    [ \d]*(copy)?[ \d]*
    |([a-z]\d*|\d[\d. ]*)                                 # one letter, numbers
    |[a-z]{1,4}\d{2,}[a-z\d]*                             # "SVGO" and exporters' counters
    |[0-9a-f]{6,}([ ][0-9a-f]{3,})*                       # hashes, uuids
    |(.*[ ])?(?=[a-z\d]{8})(?=(?:[a-z]*\d){3})[a-z\d]+([ ].*)?   # words with many digits
    |svg[a-z]{6,}                                         # random letters
    |(icon|icons|svg|clip|mask|paint|filter|linear|radial|gradient|pattern)[ ].*
    )$""",
    re.VERBOSE | re.IGNORECASE,
)
_ESCAPE = re.compile(r"_x([0-9A-Fa-f]{2,4})_")
_COUNTED = re.compile(r"(.+)[-_. ]([A-Za-z]{1,2})$")
FEW = 3
"""So many ids of one beginning and a single letter were counted by a program, if they are most of the file's."""
LONGEST = 60
READ = 200
"""Characters of a name that are looked at."""


def item_name(node: Node, by_id: Mapping[str, Sequence[Node]], counted: Collection[str] = ()) -> str:
    """The name of an element that is moved as a whole: its own, that of what it uses, or the only one in it.

    Args:
        by_id: the file's elements.
        counted: ids that are no names; see `counted_ids`.
    """
    if name := given_name(node, counted):
        return name
    if node.tag == "use" and node.href.startswith("#"):
        return next((name for target in by_id.get(node.href[1:], ()) if (name := given_name(target, counted))), "")
    inside = {name for child in list(node.walk())[1:] if (name := given_name(child, counted))}
    return inside.pop() if len(inside) == 1 else ""


def counted_ids(ids: Collection[str]) -> frozenset[str]:
    """Of a file's ids, those in which a program counts by letters behind the file's name: "nut-a", "nut-b", "nut-c"."""
    groups: dict[str, dict[str, str]] = {}
    for name in ids:
        if match := _COUNTED.match(name):
            groups.setdefault(match[1].casefold(), {})[name] = match[2]
    programs = (
        group
        for group in groups.values()
        if 2 * len(group) > len(ids) and sum(len(letters) == 1 for letters in group.values()) >= FEW
    )
    return frozenset(name for group in programs for name in group)


def given_name(node: Node, counted: Collection[str] = ()) -> str:
    """What the file calls an element, "" where it says nothing that a person would say; `counted` as in `item_name`."""
    title = next((child.text for child in node.children if child.tag == "title"), "")
    words = node.get("class").split()
    own = "" if node.get("id") in counted else node.get("id")
    for text in (node.get("inkscape:label"), node.get("data-name"), own, title, *words):
        if name := tidy(text):
            return name
    return ""


def tidy(text: str) -> str:
    """A name as a person would write it, "" for those that programs make up."""
    text = text[:READ]
    text = _ESCAPE.sub(lambda m: chr(int(m[1], 16)), text)
    text = "".join(c if c.isprintable() and c not in "\"'\\\\`" else " " for c in text)
    text = re.sub(r"(?<=[a-z])(?=[A-Z][a-z])", " ", text)
    head, colon, tail = (re.sub(r"[\s_\-./#]+", " ", part).strip() for part in text.partition(":"))
    tail = tail.replace(":", " ").strip()
    parts = [part for part in (head, tail) if part and not _MADE_UP.match(part) and re.search(r"[^\W\d_]{2}", part)]
    parts = [part[:1].upper() + part[1:LONGEST] for part in parts]
    return (":" if colon else "").join(parts)


def made_up_name(node: Node, colour: Float[np.ndarray, " 3"], round_: bool = False) -> str:
    """A name from colour and kind, such as "Red circle"."""
    kind = {"circle": "circle", "ellipse": "ellipse", "line": "line", "rect": "rectangle"}.get(node.tag, "piece")
    if node.tag == "rect" and node.get("width") and node.get("width") == node.get("height"):
        kind = "square"
    return f"{colour_word(colour)} {'circle' if round_ and kind == 'piece' else kind}"
