"""Broken and hostile SVGs, made on the spot, each with the error it must lead to (None: it has to open)."""

from __future__ import annotations

import gzip

NS = 'xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'
DOT = '<circle cx="6" cy="6" r="3" fill="red"/>'
CANARY = "iconjax-canary"
"""Part of the name of every file and host that the hostile ones ask for."""
HREF = f"file:///srv/{CANARY}.png"
HTTP = f"http://{CANARY}.invalid/a"


def svg(body: str, attributes: str = 'viewBox="0 0 24 24"', before: str = "") -> bytes:
    return f"{before}<svg {NS} {attributes}>{body}</svg>".encode()


def doctype(inside: str, body: str = DOT) -> bytes:
    return svg(body, before=f"<!DOCTYPE svg [{inside}]>")


def laughs(levels: int, kind: str = "g") -> bytes:
    parts = [f'<{kind} id="a0">{DOT}</{kind}>']
    for k in range(1, levels):
        parts.append(f'<{kind} id="a{k}">' + f'<use href="#a{k - 1}"/>' * 10 + f"</{kind}>")
    return svg(f'<defs>{"".join(parts)}</defs><use href="#a{levels - 1}"/>')


def nested(depth: int) -> bytes:
    return svg("<g>" * depth + DOT + "</g>" * depth)


def chain(count: int, tag: str, link: str, body: str = "") -> str:
    """`count` elements of which each refers to the next, and the last to the first."""
    return "".join(f'<{tag} id="c{k}" {link.format((k + 1) % count)}>{body}</{tag}>' for k in range(count))


def zigzag(count: int) -> str:
    return "M0 0" + "L9 9L1 5" * (count // 2)


def pattern(size: str) -> bytes:
    return svg(f'<pattern id="p" width="{size}" height="{size}" patternUnits="userSpaceOnUse">{DOT}</pattern>'
               '<path d="M0 0h20v20z" fill="url(#p)"/>' + DOT)  # fmt: skip


def marker(vertices: int, parts: int) -> bytes:
    return svg(f'<marker id="m">{DOT * parts}</marker><path d="{zigzag(vertices)}" marker-mid="url(#m)"/>')


def filtered(inside: str) -> bytes:
    return svg(f'<filter id="f">{inside}</filter><g filter="url(#f)">{DOT}</g>{DOT}')


def css(text: str) -> bytes:
    return svg(f"<style>{text}</style>{DOT}")


HOSTILE: dict[str, tuple[bytes, str | None]] = {
    "external entity, file": (doctype(f'<!ENTITY x SYSTEM "{HREF}">', "<text>&x;</text>" + DOT), "entity"),
    "external entity, http": (doctype(f'<!ENTITY x SYSTEM "{HTTP}">', "<text>&x;</text>" + DOT), "entity"),
    "parameter entity": (doctype(f'<!ENTITY % x SYSTEM "{HTTP}"> %x;'), "entity"),
    "internal entity": (doctype('<!ENTITY x "y">'), "entity"),
    "billion laughs by entities": (
        doctype('<!ENTITY a "aaaa"><!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;">', "<text>&b;</text>"), "entity"),
    "undefined entity": (svg("<text>&nope;</text>" + DOT), "undefined entity"),
    "doctype with an external subset": (
        svg(DOT, before=f'<!DOCTYPE svg PUBLIC "-//W3C//DTD SVG 1.1//EN" "{HTTP}.dtd">'), None),
    "billion laughs by use": (laughs(10), "draws more than"),
    "billion laughs by symbols": (laughs(10, "symbol"), "draws more than"),
    "use of itself": (svg('<use id="u" href="#u"/>' + DOT), "contains itself"),
    "use of the group around it": (svg(f'<g id="u">{DOT}<use href="#u"/></g>'), "contains itself"),
    "ring of uses": (svg('<defs>' + chain(5, "use", "href='#c{}'") + '</defs><use href="#c0"/>'), "contains itself"),
    "use of a file": (svg(f'<use href="{HREF}#a"/>' + DOT), None),
    "use over http": (svg(f'<use xlink:href="{HTTP}.svg#a"/>' + DOT), None),
    "image of a file": (svg(f'<image href="{HREF}" width="9" height="9"/>' + DOT), None),
    "image of a relative file": (svg(f'<image href="{CANARY}.png" width="9" height="9"/>' + DOT), None),
    "image over http": (svg(f'<image xlink:href="{HTTP}" width="9" height="9"/>' + DOT), None),
    "image as data": (svg('<image href="data:image/png;base64,AAAA" width="9" height="9"/>' + DOT), None),
    "svg in data in an image": (svg('<image href="data:image/svg+xml,%3Csvg/%3E" width="9" height="9"/>' + DOT), None),
    "filter image of a file": (filtered(f'<feImage href="{HREF}"/>'), None),
    "script": (svg(f'<script href="{HTTP}">while(1){{}}</script>' + DOT), None),
    "event handler": (svg(DOT, 'viewBox="0 0 24 24" onload="while(1){}"'), None),
    "foreign object": (svg(f'<foreignObject width="9" height="9"><iframe src="{HTTP}"/></foreignObject>' + DOT), None),
    "css import": (css(f'@import url("{HTTP}.css");'), None),
    "css font from a file": (css(f'@font-face{{font-family:x;src:url("{HREF}")}}'), None),
    "css with a url": (css(f'circle{{fill:url("{HTTP}")}}'), None),
    "css that never ends": (css("circle{fill:red" + "{" * 5000), None),
    "css with long selectors": (css(" ".join(["g"] * 3000) + "{fill:red}"), None),
    "style sheet instruction": (svg(DOT, before=f'<?xml-stylesheet href="{HTTP}.css"?>'), None),
    "nested 90 deep": (nested(90), None),
    "nested 5,000 deep": (nested(5_000), "nested more than"),
    "nested 200,000 deep": (nested(200_000), "nested more than"),
    "ring of gradients": (
        svg(chain(3, "linearGradient", "href='#c{}'") + '<path d="M1 1h9v9z" fill="url(#c0)"/>'), "contains itself"),
    "chain of 5,000 gradients": (
        svg("".join(f'<linearGradient id="g{k}" href="#g{k + 1}"/>' for k in range(5000))
            + '<path d="M1 1h9v9z" fill="url(#g0)"/>'), "deep"),
    "clip path clipped by itself": (
        svg(f'<clipPath id="c" clip-path="url(#c)">{DOT}</clipPath><g clip-path="url(#c)">{DOT}</g>'),
        "contains itself"),
    "mask masked by itself": (
        svg(f'<mask id="m"><g mask="url(#m)">{DOT}</g></mask><g mask="url(#m)">{DOT}</g>'), "contains itself"),
    "pattern filled with itself": (
        svg('<pattern id="p" width="4" height="4"><path d="M0 0h3v3z" fill="url(#p)"/></pattern>'
            '<path d="M0 0h20v20z" fill="url(#p)"/>'), "contains itself"),
    "pattern with a huge tile": (pattern("1e7"), None),
    "pattern with a tiny tile": (pattern("1e-7"), None),
    "pattern of a million by patterns": (
        svg("".join(f'<pattern id="p{k}" width="4" height="4">' + f'<path d="M0 0h3v3z" fill="url(#p{k + 1})"/>' * 10
                    + "</pattern>" for k in range(7)) + '<path d="M0 0h20v20z" fill="url(#p0)"/>'), "draws more than"),
    "marker on 40,000 vertices": (marker(40_000, 50), "draws more than"),
    "filter with a huge blur": (filtered('<feGaussianBlur stdDeviation="1e9"/>'), None),
    "filter with 10,000 steps": (filtered('<feOffset dx="1"/>' * 10_000), None),
    "filter with endless turbulence": (filtered('<feTurbulence baseFrequency="9" numOctaves="999999999"/>'), None),
    "huge size": (svg(DOT, 'width="1e30" height="1e30"'), "width"),
    "huge view box": (svg(DOT, 'viewBox="0 0 1e12 1e12"'), "view box"),
    "size without a view box": (svg(DOT, 'width="24" height="24"'), None),
    "zero size": (svg(DOT, 'width="0" height="0" viewBox="0 0 24 24"'), "width"),
    "negative view box": (svg(DOT, 'viewBox="0 0 -24 24"'), "view box"),
    "view box of NaN": (svg(DOT, 'viewBox="0 0 NaN 24"'), "view box"),
    "view box of a long number": (svg(DOT, f'viewBox="0 0 24 {"1" * 5000}x"'), "view box"),
    "width of a long number": (svg(DOT, f'width="{"1" * 100_000}x" viewBox="0 0 24 24"'), "width"),
    "transform of a long number": (svg(f'<g transform="rotate({"1" * 100_000}x)">{DOT}</g>{DOT}'), None),
    "id of a million digits": (svg(f'<g id="path{"1 " * 500_000}x">{DOT}</g>'), None),
    "url with a million spaces": (svg(f'<g fill="url({" " * 1_000_000}">{DOT}</g>'), None),
    "view box of three numbers": (svg(DOT, 'viewBox="0 0 24"'), "view box"),
    "neither size nor view box": (svg(DOT, ""), "viewBox"),
    "narrow as a hair": (svg(DOT, 'width="1" height="100000"'), "narrow"),
    "numbers that are not": (svg(f'<path d="M0 0LNaN inf"/><rect width="1e-400" height="x"/>{DOT}'), None),
    "numbers without bounds": (svg('<rect width="1e400" height="9"/>' + DOT), "a number beyond"),
    "arc of a huge radius": (svg('<path d="M6 6A9 1e38 0 0 0 9 9z"/>' + DOT), "a number beyond"),
    "arcs that a path library refuses": (svg('<path d="M6 6A9 1 0 2 0 9 9zM1 1L2 2"/>' + DOT), None),
    "transform without end": (svg(f'<g transform="{"rotate(360)" * 20_000}">{DOT}</g>'), None),
    "transform that is none": (svg(f'<g transform="rotate(oops)">{DOT}</g>{DOT}'), None),
    "flattened to nothing": (svg(f'<g transform="scale(0)">{DOT}</g>{DOT}'), None),
    "magnified 1e9 times": (svg('<g transform="scale(1e9)"><path d="M0 0h1e-8v1e-8z"/></g>' + DOT), None),
    "path of a million points": (svg(f'<path d="{zigzag(1_000_000)}"/>'), "path of more than"),
    "path of 200,000 points": (svg(f'<path d="{zigzag(200_000)}"/>'), None),
    "30,000 elements": (svg(DOT * 30_000), "elements"),
    "5,000 shapes": (svg(DOT * 5_000), "more than|at most"),
    "900 full pictures": (svg('<rect x="-30" y="-30" width="90" height="90" fill="red"/>' * 900), "too complex"),
    "dashes without end": (svg('<path d="M0 0H1e7" stroke="red" stroke-dasharray="1e-6"/>' + DOT), None),
    "cut short": (svg(DOT)[:-9], "not well-formed"),
    "tags that cross": (svg("<g><a></g></a>"), "mismatched"),
    "no namespace": (b'<svg viewBox="0 0 24 24"><circle r="5"/></svg>', "root has to be"),
    "html": (b"<!DOCTYPE html><html><body>hello</body></html>", "root has to be"),
    "undeclared prefix": (svg('<sodipodi:thing/>' + DOT), "unbound prefix"),
    "empty file": (b"", "is empty"),
    "not xml": (b"hello, this is no picture", "not well-formed"),
    "a PNG": (b"\x89PNG\r\n\x1a\n\x00\x00\x00\rIHDR", "not utf-8"),
    "nothing to see": (svg("<g/>"), "shows nothing"),
    "invisible": (svg('<circle r="9" fill="none"/>'), "shows nothing"),
    "declares UTF-16 but is UTF-8": (svg(DOT, before='<?xml version="1.0" encoding="UTF-16"?>'), "UTF-16"),
    "declares an unknown encoding": (svg(DOT, before='<?xml version="1.0" encoding="klingon"?>'), "klingon"),
    "declares UTF-7": (svg(DOT, before='<?xml version="1.0" encoding="UTF-7"?>'), "not read"),
    "latin-1 bytes without saying so": (svg('<title>é</title>' + DOT).decode().encode("latin-1"), "not utf-8"),
    "NUL characters": (svg("<title>\0</title>" + DOT), "NUL"),
    "gzip bomb": (gzip.compress(b" " * 100_000_000, 9), "unpacks to more"),
    "gzip cut short": (gzip.compress(svg(DOT))[:-12], "cut short"),
    "gzip damaged": (gzip.compress(svg(DOT))[:12] + b"\xff" * 40, "damaged"),
    "ids that occur twice": (svg(f'<g id="a">{DOT}</g><g id="a">{DOT}</g><use href="#a"/>'), None),
    "reference to nothing": (svg('<use href="#none"/><path d="M1 1h9v9z" fill="url(#none)"/>' + DOT), None),
    "animation": (svg('<g><animateTransform attributeName="transform" type="rotate" dur="1s"/>' + DOT + "</g>"), None),
}  # fmt: skip
