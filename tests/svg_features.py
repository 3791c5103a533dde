"""Small drawings, each with one thing that SVG can do, and helpers to edit and to draw them."""

from __future__ import annotations

import io

import numpy as np
from PIL import Image

from iconjax.scene.svg import SvgScene

NS = 'xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'
BOX = '<rect id="crate" x="4" y="12" width="8" height="9" fill="#268"/>'
BALL = '<circle id="ball" cx="16" cy="8" r="4" fill="#d42"/>'


def svg(body: str, attributes: str = 'viewBox="0 0 24 24"') -> bytes:
    return f"<svg {NS} {attributes}>\n{body}\n</svg>\n".encode()


FEATURES: dict[str, bytes] = {
    "plain": svg(BOX + BALL),
    "nested transforms": svg(
        f'<g transform="translate(3 1) rotate(20 12 12)"><g transform="scale(.8,1.1)">{BOX}'
        f'<g transform="skewX(10)">{BALL}</g></g></g>'),
    "its own transform, in single quotes": svg(BOX + BALL.replace(" r=", " transform='matrix(1 .2 0 1 -1,-2)' r=")),
    "view box with an origin": svg(BOX + BALL, 'viewBox="-4 -6 34 30" width="200" height="120"'),
    "stretched view box": svg(BOX + BALL, 'viewBox="0 0 24 24" width="300" height="150" preserveAspectRatio="none"'),
    "sliced view box": svg(
        BOX + BALL, 'viewBox="0 0 24 24" width="300" height="200" preserveAspectRatio="xMaxYMin slice"'),
    "millimetres": svg('<rect id="a" x="2mm" y=".3cm" width=".4in" height="15pt"/>'
                       '<circle id="b" cx="70" cy="30" r="3mm"/>', 'width="25.4mm" height="12.7mm"'),
    "percentages": svg('<rect id="sky" width="50%" height="30%" fill="#48a"/>' + BALL),
    "use": svg(f'<defs>{BALL}</defs><use href="#ball" id="one" x="-4" y="3"/>'
               '<use xlink:href="#ball" id="two" transform="rotate(30)" x="2" y="2"/>'),
    "use of what is drawn": svg(f'{BALL}<use href="#ball" id="copy" x="-10" y="9"/>{BOX}'),
    "use of a group that is drawn": svg(f'<g id="pair">{BOX}{BALL}</g><use href="#pair" id="copy" x="-3" y="-7"/>'),
    "symbol": svg('<symbol id="s" viewBox="0 0 10 10"><path d="M0 0h10L5 10z"/><circle cx="5" cy="4" r="2" fill="red"/>'
                  '</symbol><use href="#s" id="sign" x="2" y="2" width="9" height="12"/>' + BALL),
    "clip on an element": svg(
        f'<clipPath id="c"><circle cx="16" cy="6" r="4"/></clipPath>{BOX}'
        + BALL.replace(" r=", " clip-path='url(#c)' r=")),
    "clip on a group": svg(
        f'<clipPath id="c"><circle cx="11" cy="12" r="8"/></clipPath><g clip-path="url(#c)">{BOX}{BALL}</g>'
        '<path id="bar" d="M1 1h4v4z"/>'),
    "clip of the whole picture": svg(
        f'<clipPath id="c"><path d="M0 0h24v24H0z"/></clipPath><g clip-path="url(#c)">{BOX}{BALL}</g>'),
    "mask": svg('<mask id="m"><rect x="4" y="12" width="8" height="5" fill="#fff"/></mask>'
                f'<g mask="url(#m)">{BOX}</g>{BALL}'),
    "transparent group": svg(f'<g opacity=".5">{BOX}<circle cx="12" cy="14" r="3"/></g>{BALL}'),
    "gradient of the box": svg(
        '<linearGradient id="g"><stop stop-color="red"/><stop offset="1" stop-color="blue" stop-opacity=".3"/>'
        '</linearGradient>' + BOX.replace("#268", "url(#g)") + BALL),
    "gradient of the user space": svg(
        '<linearGradient id="h" gradientUnits="userSpaceOnUse" x1="12" y1="4" x2="20" y2="12">'
        '<stop stop-color="red"/><stop offset="1" stop-color="gold"/></linearGradient>'
        '<radialGradient id="g" href="#h" cx="15" cy="7" r="5"/>' + BOX + BALL.replace("#d42", "url(#g)")),
    "gradient on a group": svg(
        '<linearGradient id="g" x2="0" y2="1"><stop stop-color="red"/><stop offset="1"/></linearGradient>'
        f'<g fill="url(#g)">{BOX.replace("#268", "inherit")}<circle cx="16" cy="8" r="4"/></g>'),
    "strokes": svg('<path id="wave" d="M2 6q4-8 8 0t8 0" fill="none" stroke="#222" stroke-width="1.5" '
                   'stroke-linecap="round" stroke-dasharray="3 2"/>' + BOX.replace("/>", ' stroke="red"/>')),
    "classes": svg('<style>.a,g > .b{fill:#393;stroke:#111} #ball{fill:purple!important} rect{opacity:.8}</style>'
                   "<g>" + BOX.replace("<rect", "<rect class='b'") + f"</g>{BALL}"
                   '<path id="flag" class="a" d="M1 1h6v4z"/>'),
    "current colour": svg(f'<g color="#a3c" style="fill: currentColor">{BOX.replace("#268", "currentColor")}'
                          '<path id="roof" d="M2 12l6-7 6 7z"/></g>'),
    "holes": svg('<path d="M2 2h9v9H2zm2 2v5h5V4zM14 2h8v8h-8zm2 2h4v4h-4z" fill-rule="evenodd" fill="#246"/>'
                 '<path d="m2 14 9 0v8h-9z m2 2v4h5v-4z M14 14a4 4 0 108 0 4 4 0 00-8 0z"/>'),
    "islands": svg('<path fill-rule="evenodd" d="M2 2h20v20H2zM5 5v14h14V5zM9 9h6v6H9z"/>'),
    "pattern": svg('<pattern id="p" width="3" height="3" patternUnits="userSpaceOnUse"><circle cx="1" cy="1" r="1"/>'
                   "</pattern>" + BOX.replace("#268", "url(#p)") + BALL),
    "marker": svg('<marker id="m" markerWidth="3" markerHeight="3" refX="1" refY="1">'
                  '<circle cx="1" cy="1" r="1"/></marker>'
                  '<path id="line" d="M3 3l9 5 8-4" fill="none" stroke="#333" marker-end="url(#m)"/>' + BOX),
    "nested svg": svg(f'<svg x="2" y="2" width="12" height="12" viewBox="0 0 24 24">{BOX}{BALL}</svg>'
                      '<path id="bar" d="M15 15h6v6z"/>'),
    "link": svg(f'<a href="https://example.org/">{BOX}</a>{BALL}'),
    "shadow": svg('<filter id="f"><feDropShadow dx="1" dy="1" stdDeviation=".6"/></filter>'
                  f'<g filter="url(#f)">{BOX}</g>{BALL}'),
    "background": svg(f'<rect width="24" height="24" fill="#fe8"/>{BOX}{BALL}'),
    "beyond the picture": svg('<circle id="sun" cx="2" cy="2" r="8" fill="orange"/>' + BOX),
    "prefix": f'<s:svg xmlns:s="http://www.w3.org/2000/svg" viewBox="0 0 24 24"><s:g>'
              f'{BOX.replace("<rect", "<s:rect")}<s:circle id="ball" cx="16" cy="8" r="4"/></s:g>'
              f'<s:use href="#ball" x="2" y="9" xmlns="http://www.w3.org/2000/svg"/></s:svg>'.encode(),
    "comments and entities": svg(
        f"<!-- <rect/> -->{BOX}<!-- > -->" + BALL.replace("ball", "b&#97;ll &gt; &quot;big&quot;")),
}  # fmt: skip


def drawn(data: bytes, size: tuple[int, int]) -> np.ndarray:
    """An SVG on white, by resvg alone; the size has to have the drawing's own proportions."""
    import resvg_py

    png = resvg_py.svg_to_bytes(
        svg_string=data.decode("utf-8-sig"),
        background="#ffffff",
        skip_system_fonts=True,
        dpi=96,
        width=size[0],
        height=size[1],
    )
    return np.asarray(Image.open(io.BytesIO(png)).convert("RGB"))


def random_motions(vector: SvgScene, seed: int, share: float = 0.6) -> np.ndarray:
    """A turn, two factors and a shift for some of the segments, at least one."""
    rng = np.random.default_rng(seed)
    scene = vector.scene
    matrices = np.tile(np.eye(2, 3), (len(scene.segments), 1, 1))
    for k in rng.permutation(len(matrices))[: max(1, round(share * len(matrices)))]:
        box = scene.segments[k].box
        centre = np.array([(box[0] + box[2]) / 2, (box[1] + box[3]) / 2])
        angle = rng.uniform(-1.2, 1.2)
        linear = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]) * rng.uniform(0.7, 1.4, 2)
        matrices[k] = np.column_stack([linear, centre - linear @ centre + rng.uniform(-0.15, 0.15, 2) * scene.size])
    return matrices
