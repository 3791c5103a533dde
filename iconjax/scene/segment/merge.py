"""Rules that unite regions: what belongs together though its colours or outlines are apart."""

from __future__ import annotations

from collections import defaultdict

import numpy as np
from jaxtyping import Bool, Float

from iconjax.scene.segment.regions import Labels, Regions, depths, join, measure

SMOOTH = 6.0
"""Regions whose colours differ less than this along their common border are one: the slices of a gradient."""
SAME = 9.0
"""Regions whose colours differ less than this on the whole have the same colour."""
HOLE = 2.0
"""What shows through a hole differs less than this from the background."""
SMALL = 0.0004
"""A region with a smaller share of the picture is no segment of its own."""
SLIVER = 1.6
"""Nor is one whose largest disc has a smaller radius, in pixels at 512 x 512, where something else touches it."""
HOST = 0.6
"""A region lies in another that takes more than this share of its border."""
HIGHLIGHT = 0.12
"""Largest share of its host that a highlight or shade has."""
HUE, LIGHT = 14.0, 20.0
"""A highlight's colour differs from its host's less than this in hue and chroma, and in lightness."""
MANY, DETAIL = 3, 0.04
"""So many details of one colour in one host, each with less than this share of it, are one segment."""

Clean = Float[np.ndarray, "H W 3"]


def join_smooth(labels: Labels, clean: Clean) -> Labels:
    """Unite regions without a step of colour between them."""
    regions = measure(labels, clean)
    pairs = np.argwhere(np.triu((regions.length > 0) & (regions.contrast < SMOOTH), 1))
    return join(labels, [(int(a), int(b)) for a, b in pairs])


def background_of(regions: Regions, colour: Float[np.ndarray, " 3"]) -> Bool[np.ndarray, " n"]:
    """Regions that are background: on the rim what has about its colour, elsewhere (holes) what has just its colour."""
    away = np.linalg.norm(regions.colour - colour, axis=1)
    same = away < np.where(regions.rim > 0, SAME, HOLE)
    same[0] = False
    return np.asarray(same)


def join_small(labels: Labels, clean: Clean, colour: Float[np.ndarray, " 3"]) -> Labels:
    """Unite what is too small or too thin to be a segment with the neighbour that it meets most and resembles."""
    unit = max(labels.shape) / 512
    for _ in range(8):
        regions = measure(labels, clean)
        ground = background_of(regions, colour)
        small = (regions.area < SMALL * labels.size) | (depths(labels) < SLIVER * unit)
        small[0] = False
        pull = regions.length / (20.0 + regions.contrast)
        pull[:, ground] *= 0.25  # a detail at the rim of a thing is of the thing
        alone = (regions.length[:, ~ground] > 0).sum(1) == 0
        small &= ~(alone & ~ground & (regions.area >= 0.25 * SMALL * labels.size))
        order = sorted(np.flatnonzero(small), key=lambda k: regions.area[k])
        pairs: list[tuple[int, int]] = []
        busy: set[int] = set()
        for k in order:
            host = int(pull[k].argmax())
            if pull[k, host] > 0 and k not in busy and host not in busy:
                pairs.append((int(k), host))
                busy.add(int(k))
                if small[host]:
                    busy.add(host)
        if not pairs:
            break
        labels = join(labels, pairs)
    return labels


def hosts(regions: Regions, ground: Bool[np.ndarray, " n"]) -> dict[int, int]:
    """For each region that lies in another one, which is no background, that other."""
    out: dict[int, int] = {}
    for k in regions.ids:
        around = regions.length[k]
        host = int(around.argmax())
        inside = around[host] > HOST * (around.sum() + regions.rim[k])
        if inside and not ground[host] and regions.area[host] > regions.area[k]:
            out[k] = host
    return out


def join_highlights(labels: Labels, clean: Clean, colour: Float[np.ndarray, " 3"]) -> Labels:
    """Unite a highlight or shade, of its host's hue, with the host in which it lies."""
    regions = measure(labels, clean)
    ground = background_of(regions, colour)
    pairs = []
    for k, host in hosts(regions, ground).items():
        light, *hue = regions.colour[k] - regions.colour[host]
        alike = np.hypot(*hue) < HUE and abs(light) < LIGHT
        if alike and not ground[k] and regions.area[k] < HIGHLIGHT * regions.area[host]:
            pairs.append((k, host))
    return join(labels, pairs)


def join_patterns(labels: Labels, clean: Clean, colour: Float[np.ndarray, " 3"]) -> Labels:
    """Unite the many small details of one colour that lie in one host: keys, rivets, windows of a tower."""
    regions = measure(labels, clean)
    ground = background_of(regions, colour)
    groups: dict[int, list[list[int]]] = defaultdict(list)
    for k, host in hosts(regions, ground).items():
        if ground[k] or regions.area[k] >= DETAIL * regions.area[host]:
            continue
        for group in groups[host]:
            if np.linalg.norm(regions.colour[group[0]] - regions.colour[k]) < SAME:
                group.append(k)
                break
        else:
            groups[host].append([k])
    many = [group for found in groups.values() for group in found if len(group) >= MANY]
    return join(labels, [(group[0], k) for group in many for k in group[1:]])


def join_cheapest(labels: Labels, clean: Clean, colour: Float[np.ndarray, " 3"], most: int) -> Labels:
    """Unite neighbours until at most `most` segments are left, each time the two whose union changes least (Ward)."""
    regions = measure(labels, clean)
    ground = background_of(regions, colour)
    area, mean, near = regions.area.astype(float), regions.colour.copy(), regions.length > 0
    near[ground], near[:, ground] = False, False
    count = int((~ground[1:]).sum())
    pairs = []
    while count > most and near.any():
        away = ((mean[:, None] - mean[None]) ** 2).sum(2) + 1.0
        cost = np.where(near, away * area[:, None] * area[None] / np.maximum(area[:, None] + area[None], 1.0), np.inf)
        a, b = (int(k) for k in np.unravel_index(int(cost.argmin()), cost.shape))
        pairs.append((a, b))
        mean[a] = (area[a] * mean[a] + area[b] * mean[b]) / (area[a] + area[b])
        area[a] += area[b]
        near[a] |= near[b]
        near[:, a] |= near[:, b]
        near[b], near[:, b], near[a, a] = False, False, False
        count -= 1
    return join(labels, pairs)
