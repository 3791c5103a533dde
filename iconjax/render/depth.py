"""Which segment lies in front: the paper's rule of the longer inner path."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Int32, Integer
from scipy import ndimage
from scipy.sparse import coo_matrix, csr_matrix
from scipy.sparse.csgraph import dijkstra

from iconjax.scene.types import Scene, Segment

TOUCH = 3.0  # segments at most so many pixels of 512 apart touch
CELLS = 40  # inner paths are measured on a grid that gives the contact region about so many cells
CLEAR = 0.15  # a path must be longer by this share, and by more than a few pixels, to decide
_SQUARE = np.ones((3, 3), bool)

Window = tuple[slice, slice]


@dataclass(frozen=True)
class DepthOrder:
    """Painting order of a scene.

    Attributes:
        order: positions of the segments, back to front.
        undetermined: touching pairs (back, front) that the rule leaves open, as the default placed them.
        cycles: contradicting decisions, each as the positions of a ring in which every one was found to lie
            behind the next; it was broken at its weakest link, between its last and its first.
    """

    order: tuple[int, ...]
    undetermined: tuple[tuple[int, int], ...] = ()
    cycles: tuple[tuple[int, ...], ...] = ()


@dataclass(frozen=True)
class _Grid:
    """A segment on the coarse grid: each cell's node (-1 outside), its piece (0 outside), the graph."""

    node: Int32[np.ndarray, "h w"]
    piece: Int32[np.ndarray, "h w"]
    graph: csr_matrix


def depth_order(scene: Scene) -> DepthOrder:
    """Order the segments of the unedited scene back to front.

    Of two touching segments the one whose inner paths between points of the contact region are longer lies
    behind. Where neither is clearly longer, one that lies within the other's box is in front, else the one
    with the larger id; segments that do not touch keep the order of their ids. A scene with layers has its
    order already: that of each segment's largest layer.
    """
    if scene.layers:
        return DepthOrder(_painted(scene))
    reach = max(1, round(TOUCH * scene.size / 512))
    label = scene.position_map()
    decided: dict[tuple[int, int], float] = {}
    open_pairs: list[tuple[int, int]] = []
    for i, j, window in _touching(label, len(scene.segments), reach):
        a, b, places = _path_lengths(label, i, j, window, reach)
        # The wider segment's contact reaches around the narrower one's corners, by `reach` on either side.
        if abs(a - b) <= max((2 * reach + 2) * max(places, 1), CLEAR * max(a, b)):
            open_pairs.append(_default(scene.segments[i], scene.segments[j], (i, j)))
        elif a > b:
            decided[i, j] = np.log((a + 1) / (b + 1))
        else:
            decided[j, i] = np.log((b + 1) / (a + 1))
    return _arrange(len(scene.segments), decided, open_pairs)


def _painted(scene: Scene) -> tuple[int, ...]:
    """Positions of the segments by the place of their largest layer, back to front."""
    place = dict.fromkeys(range(len(scene.segments)), (0, -1))  # of each segment: size, rank
    for rank, layer in enumerate(scene.layers):
        size = int(np.count_nonzero(layer.data[..., 3]))
        if layer.segment is not None and size >= place[layer.segment][0]:
            place[layer.segment] = (size, rank)
    return tuple(sorted(place, key=lambda i: place[i][1]))


def _default(first: Segment, second: Segment, pair: tuple[int, int]) -> tuple[int, int]:
    """(back, front) of two segments whose paths are about equal."""
    a, b = first.box, second.box
    holds_second = a[0] < b[0] and a[1] < b[1] and a[2] > b[2] and a[3] > b[3]
    held_by_second = a[0] > b[0] and a[1] > b[1] and a[2] < b[2] and a[3] < b[3]
    return pair[::-1] if held_by_second and not holds_second else pair


def _touching(label: Int32[np.ndarray, "H W"], count: int, reach: int) -> Iterator[tuple[int, int, Window]]:
    """Pairs of positions whose segments touch, with the window of the first one's surroundings."""
    boxes = ndimage.find_objects(label + 1, max_label=count)
    for i, box in enumerate(boxes):
        if box is None:
            continue
        window = _widen(box, reach)
        around = label[window]
        for j in np.unique(around[_within(around == i, reach)]):
            if j > i:
                yield i, int(j), window


def _widen(box: Window, pad: int) -> Window:
    rows, cols = (slice(max(s.start - pad, 0), s.stop + pad) for s in box)
    return rows, cols


def _within(mask: Bool[np.ndarray, "h w"], reach: int) -> Bool[np.ndarray, "h w"]:
    return np.asarray(ndimage.maximum_filter(mask.view(np.uint8), 2 * reach + 1).view(bool))


def _coarse(mask: Bool[np.ndarray, "H W"], cell: int) -> Bool[np.ndarray, "h w"]:
    if cell == 1:
        return mask
    h, w = -(-mask.shape[0] // cell), -(-mask.shape[1] // cell)
    padded = np.pad(mask, ((0, h * cell - mask.shape[0]), (0, w * cell - mask.shape[1])))
    return np.asarray(padded.reshape(h, cell, w, cell).any(axis=(1, 3)))


def _grid(cells: Bool[np.ndarray, "h w"]) -> _Grid:
    node: np.ndarray = np.full(cells.shape, -1, np.int32)
    node[cells] = np.arange(cells.sum())
    rows, cols, weights = [], [], []
    for dy, dx in ((0, 1), (1, 0), (1, 1), (1, -1)):
        a: np.ndarray = node[: node.shape[0] - dy, max(0, -dx) : node.shape[1] - max(0, dx)]
        b: np.ndarray = node[dy:, max(0, dx) : node.shape[1] + min(0, dx)]
        both = (a >= 0) & (b >= 0)
        rows.append(a[both])
        cols.append(b[both])
        weights.append(np.full(both.sum(), np.hypot(dy, dx)))
    count = int(cells.sum())
    entries = (np.concatenate(weights), (np.concatenate(rows), np.concatenate(cols)))
    return _Grid(node, ndimage.label(cells, _SQUARE)[0], coo_matrix(entries, shape=(count, count)).tocsr())


def _path_lengths(
    label: Int32[np.ndarray, "H W"], i: int, j: int, window: Window, reach: int
) -> tuple[float, float, int]:
    """Longest inner paths of segments i and j, in pixels, summed over where they meet; and the count."""
    around = label[window]
    contact = _within(around == i, reach) & (around == j)
    places, _ = ndimage.label(_within(contact, reach), _SQUARE)
    total = np.zeros(3)
    for rows, cols in ndimage.find_objects(places):
        place = (
            slice(rows.start + window[0].start, rows.stop + window[0].start),
            slice(cols.start + window[1].start, cols.stop + window[1].start),
        )
        total += _lengths_at(label, i, j, place, reach)
    return float(total[0]), float(total[1]), int(total[2])


def _lengths_at(label: Int32[np.ndarray, "H W"], i: int, j: int, place: Window, reach: int) -> tuple[float, float, int]:
    """`_path_lengths` at one place, summed over the pieces of the segments that meet there.

    Only points that both can join are compared: a bar that another one cuts in two says nothing
    across the cut.
    """
    extent = max(s.stop - s.start for s in place)
    around = label[_widen(place, extent // 2)]
    cell = max(1, round(extent / CELLS))
    first, second = _grid(_coarse(around == i, cell)), _grid(_coarse(around == j, cell))
    near_i = _coarse(_within(around == j, reach) & (around == i), cell)
    near_j = _coarse(_within(around == i, reach) & (around == j), cell)
    span = -(-reach // cell) + 1
    total, count = np.zeros(2), 0
    for p in np.unique(first.piece[near_i]):
        one = near_i & (first.piece == p)
        beside = near_j & _within(one, span)
        for q in np.unique(second.piece[beside]):
            two = beside & (second.piece == q)
            total += _longest_path(first, one & _within(two, span)), _longest_path(second, two)
            count += 1
    return float(total[0]) * cell, float(total[1]) * cell, count


def _longest_path(grid: _Grid, contact: Bool[np.ndarray, "h w"]) -> float:
    """Length, in cells, of the longest of the shortest inner paths between contact cells.

    From a few spread cells to the farthest ones and again from there: the ends of the longest path are found
    without going through all pairs. Cells that no inner path joins do not count.
    """
    places: Integer[np.ndarray, " k"] = grid.node[contact]
    places = places[places >= 0]
    if len(places) < 2:
        return 0.0
    starts = places[np.linspace(0, len(places) - 1, min(3, len(places))).astype(int)]
    best = 0.0
    for _ in range(2):
        reach = dijkstra(grid.graph, directed=False, indices=starts)[:, places]
        reach[~np.isfinite(reach)] = -1.0
        best = max(best, float(reach.max()))
        starts = np.unique(places[reach.argmax(axis=1)])
    return best


def _arrange(count: int, decided: dict[tuple[int, int], float], open_pairs: Iterable[tuple[int, int]]) -> DepthOrder:
    """A stable order in which decisions hold (the weakest yields in a ring), and defaults where they can."""
    links: set[tuple[int, int]] = set()
    cycles = []
    for back, front in sorted(decided, key=lambda e: (-decided[e], e)):
        ring = _path(links, front, back)
        if ring is None:
            links.add((back, front))
        else:
            cycles.append(tuple(ring))
    undetermined = []
    for back, front in sorted(open_pairs):
        if _path(links, front, back) is None:
            links.add((back, front))
            undetermined.append((back, front))
        else:
            undetermined.append((front, back))
    order: list[int] = []
    left = set(range(count))
    while left:
        free = (i for i in sorted(left) if not any(f == i and b in left for b, f in links))
        order.append(next(free))
        left.remove(order[-1])
    return DepthOrder(tuple(order), tuple(undetermined), tuple(cycles))


def _path(links: set[tuple[int, int]], start: int, goal: int) -> list[int] | None:
    """A way from `start` to `goal` along links, or None."""
    come: dict[int, int] = {start: start}
    queue = [start]
    for at in queue:
        if at == goal:
            way = [at]
            while way[-1] != start:
                way.append(come[way[-1]])
            return way[::-1]
        for back, front in sorted(links):
            if back == at and front not in come:
                come[front] = at
                queue.append(front)
    return None
