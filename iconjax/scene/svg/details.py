"""Small things that join the segment they sit on: highlights, shading, outlines, what is hidden."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float
from scipy import ndimage

from iconjax.scene.colours import lab
from iconjax.scene.outline import fill
from iconjax.scene.svg.draw import Patch
from iconjax.scene.svg.grouping import Draft
from iconjax.scene.svg.limits import MAX_DETAILS
from iconjax.scene.svg.sight import Sight, Slices, overlap, solid

ON = 0.95
"""A detail lies on its host with this share of its area."""
TINY = 0.008
"""Of the picture: an unlabelled thing smaller than this joins what it lies on."""
SMALL = 0.08
"""Of its host, and a quarter of it of the picture: so does this."""
SHADE = 26.0
"""Distance of colours (CIE Lab) up to which a thing on another is its shading."""
TRANSLUCENT = 0.6
"""What covers less than this everywhere is shading, too."""
SAME = 0.85
"""Two things whose filled shapes share this part of their union are one thing and its outline."""
THIN = 0.02
"""A line is at most twice this share of the picture's larger side wide."""
ALONG = 0.85
"""A line that keeps to a host's border for this share of its area is the host's outline."""
UNSEEN = 6.0
"""Pixels: what shows less is hidden."""


@dataclass(frozen=True, eq=False)
class _Extent:
    """Where a draft is: the window it lies in, what it covers there, the same without holes, areas in pixels.

    `radius` is that of the largest circle in it.
    """

    window: Slices
    area: Bool[np.ndarray, "h w"]
    filled: Bool[np.ndarray, "h w"]
    size: float
    whole: float
    colour: Float[np.ndarray, " 3"]
    peak: float
    radius: float
    hidden: bool


def join_details(drafts: Sequence[Draft], sights: Sequence[Sight], shape: tuple[int, int]) -> list[Draft]:
    """The drafts with details joined to their hosts; what nothing hosts and nothing shows is left out.

    Labelled segments are details of nothing, and where everything would become one, small things stay apart.
    """
    if len(drafts) > MAX_DETAILS:
        return drop_hidden(drafts, sights, shape)
    extents = [_extent(draft, sights, shape) for draft in drafts]
    outlines = _outlines(drafts, extents, shape)
    firm, loose = [], []
    for k in range(len(drafts)):
        host, weak = _host(k, drafts, extents, outlines, shape)
        loose.append(host)
        firm.append(None if weak else host)
    tops = [k for k in range(len(drafts)) if loose[k] is None and not extents[k].hidden]
    return _merge(drafts, loose if len(tops) > 1 else firm, extents)


def drop_hidden(drafts: Sequence[Draft], sights: Sequence[Sight], shape: tuple[int, int]) -> list[Draft]:
    """The drafts that show something."""
    return [draft for draft in drafts if _shown(draft, sights, shape) >= UNSEEN]


def _host(
    k: int,
    drafts: Sequence[Draft],
    extents: Sequence[_Extent],
    outlines: Mapping[int, int],
    shape: tuple[int, int],
) -> tuple[int | None, bool]:
    """What draft k belongs to, and whether only because it is small."""
    draft, own = drafts[k], extents[k]
    if draft.named or not own.size:
        return None, False
    others = [h for h in range(len(drafts)) if h != k and not extents[h].hidden and extents[h].size]
    shares = {h: share for h in others if (share := _common(own, extents[h]) / own.size) > 0}
    if own.hidden:
        return max(shares, key=lambda h: (shares[h], -h), default=None), False
    for h in shares:
        if (h < k or drafts[h].named) and _same_shape(own, extents[h]):
            return h, False
    if k in outlines:
        return outlines[k], False
    below = [h for h, share in shares.items() if share >= ON and h < k and extents[h].size > own.size]
    if not below:
        return None, False
    host = min(below, key=lambda h: extents[h].size)
    under = extents[host]
    if own.peak < TRANSLUCENT or np.linalg.norm(lab(own.colour) - lab(under.colour)) < SHADE:
        return host, False
    canvas = float(shape[0] * shape[1])
    small = own.size < TINY * canvas or (own.size < SMALL * under.size and own.size < SMALL / 4 * canvas)
    return (host, True) if small else (None, False)


def _outlines(drafts: Sequence[Draft], extents: Sequence[_Extent], shape: tuple[int, int]) -> dict[int, int]:
    """The thing along whose border each thin line runs."""
    widest = THIN * max(shape)
    thin = [k for k, e in enumerate(extents) if e.size and e.radius <= widest and not drafts[k].named]
    best: dict[int, tuple[float, int]] = {}
    for h, host in enumerate(extents):
        lines = [
            k for k in thin
            if host.radius >= 2.5 * extents[k].radius and 2 * host.size >= extents[k].size
            and not host.hidden and _common(extents[k], host) > 0
        ]  # fmt: skip
        if not lines:
            continue
        pad = int(2 * widest) + 4
        filled = np.pad(host.filled, pad)
        distance = ndimage.distance_transform_edt(filled) + ndimage.distance_transform_edt(~filled)
        for k in lines:
            share = _along(extents[k], distance <= 2 * extents[k].radius + 2, host, pad)
            if share >= ALONG and share > best.get(k, (0.0, 0))[0] + 0.01:
                best[k] = (share, h)
    return {k: h for k, (_, h) in best.items()}


def _along(line: _Extent, border: Bool[np.ndarray, "h w"], host: _Extent, pad: int) -> float:
    """Share of a line that lies in the band along a host's border."""
    place = Patch(
        np.zeros((*line.area.shape, 4), np.uint8),
        line.window[0].start - host.window[0].start + pad,
        line.window[1].start - host.window[1].start + pad,
    )
    here, there = overlap(place, (border.shape[0], border.shape[1]))
    return float(np.count_nonzero(line.area[here] & border[there])) / line.size


def _common(a: _Extent, b: _Extent, *, filled: bool = False) -> float:
    """Pixels that two drafts both cover."""
    rows = slice(max(a.window[0].start, b.window[0].start), min(a.window[0].stop, b.window[0].stop))
    cols = slice(max(a.window[1].start, b.window[1].start), min(a.window[1].stop, b.window[1].stop))
    if rows.start >= rows.stop or cols.start >= cols.stop:
        return 0.0
    parts = [
        (e.filled if filled else e.area)[
            rows.start - e.window[0].start : rows.stop - e.window[0].start,
            cols.start - e.window[1].start : cols.stop - e.window[1].start,
        ]
        for e in (a, b)
    ]
    return float(np.count_nonzero(parts[0] & parts[1]))


def _same_shape(a: _Extent, b: _Extent) -> bool:
    """Whether one is the outline of the other, or both have one shape."""
    if not SAME <= a.whole / max(b.whole, 1.0) <= 1 / SAME:
        return False
    common = _common(a, b, filled=True)
    return common >= SAME * (a.whole + b.whole - common)


def _merge(drafts: Sequence[Draft], hosts: Sequence[int | None], extents: Sequence[_Extent]) -> list[Draft]:
    kept: dict[int, list[int]] = {}
    for k in range(len(drafts)):
        kept.setdefault(_top(k, hosts), []).append(k)
    out = []
    for top, group in kept.items():
        if not all(extents[k].hidden for k in group):
            members = sorted(i for k in group for i in drafts[k].members)
            out.append(Draft(members, drafts[top].label, drafts[top].named))
    return sorted(out, key=lambda draft: draft.members[0])


def _top(k: int, hosts: Sequence[int | None]) -> int:
    seen = {k}
    while (up := hosts[k]) is not None and up not in seen:
        seen.add(up)
        k = up
    return k


def _extent(draft: Draft, sights: Sequence[Sight], shape: tuple[int, int]) -> _Extent:
    area = np.zeros(shape, bool)
    for i in draft.members:
        area |= solid(sights[i].patch, shape, sights[i].peak)
    window = (ndimage.find_objects(area.view(np.uint8)) or [None])[0] or (slice(0, 1), slice(0, 1))
    inner = area[window]
    filled = fill(inner)
    weights = np.array([sights[i].patch.data[..., 3].sum(dtype=float) for i in draft.members])
    return _Extent(
        window=window,
        area=inner,
        filled=filled,
        size=float(np.count_nonzero(inner)),
        whole=float(np.count_nonzero(filled)),
        colour=np.average([sights[i].colour for i in draft.members], axis=0, weights=weights),
        peak=max(sights[i].peak for i in draft.members),
        radius=float(ndimage.distance_transform_edt(np.pad(inner, 1)).max()),
        hidden=_shown(draft, sights, shape) < UNSEEN,
    )


def _shown(draft: Draft, sights: Sequence[Sight], shape: tuple[int, int]) -> float:
    total = 0.0
    for i in draft.members:
        here, _ = overlap(sights[i].patch, shape)
        total += float(sights[i].seen[here].sum()) / max(sights[i].peak, 1e-6)
    return total
