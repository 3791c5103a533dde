"""Which items of an SVG make one segment, and what it is called."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from iconjax.scene.svg.items import Item
from iconjax.scene.svg.naming import counted_ids, given_name, item_name, made_up_name
from iconjax.scene.svg.sight import Sight, overlap, solid
from iconjax.scene.svg.tree import Node

COVERS = 0.99
"""What covers this share of the picture, under everything else, is background."""


@dataclass(eq=False)
class Draft:
    """A segment in the making.

    Attributes:
        members: positions of its items among all.
        label: `Object:Part` or `Object`.
        named: whether the label comes from the file.
    """

    members: list[int]
    label: str
    named: bool


def draft_segments(
    sights: Sequence[Sight], shape: tuple[int, int], by_id: Mapping[str, Sequence[Node]], open_groups: bool
) -> list[Draft]:
    """Segments in paint order, before details are joined; items in none of them are background.

    A labelled group is one segment unless something in it is labelled too, or `open_groups` is set.
    """
    free = [i for i, sight in enumerate(sights) if not sight.item.fixed]
    for i in list(free)[:-1]:
        if not _is_backdrop(sights[i], shape):
            break
        free.remove(i)
    names = _Names([sights[i].item for i in free], by_id, open_groups)
    drafts: dict[object, Draft] = {}
    for i in free:
        key, label, named = names.of(sights[i])
        if key in drafts:
            drafts[key].members.append(i)
        else:
            drafts[key] = Draft([i], label, named)
    return list(drafts.values())


def _is_backdrop(sight: Sight, shape: tuple[int, int]) -> bool:
    here, there = overlap(sight.patch, shape)
    full = (there[0].stop - there[0].start, there[1].stop - there[1].start) == shape
    return full and bool((sight.patch.data[here][..., 3] >= 250).mean() >= COVERS)


class _Names:
    def __init__(self, items: Sequence[Item], by_id: Mapping[str, Sequence[Node]], open_groups: bool) -> None:
        self.open_groups = open_groups
        self.given: dict[int, str] = {}
        counted = counted_ids(by_id)
        holders: dict[int, set[int]] = {}
        for k, item in enumerate(items):
            self.given.setdefault(item.node.order, item_name(item.node, by_id, counted))
            for group in item.groups:
                self.given.setdefault(group.order, given_name(group, counted))
                holders.setdefault(group.order, set()).add(k)
        self.wrappers = {order for order, held in holders.items() if len(held) == len(items) and len(items) > 1}
        self.split = {  # labelled groups in which something else is labelled
            outer.order
            for item in items
            for k, outer in enumerate(item.groups)
            if any(self.given[node.order] for node in (*item.groups[k + 1 :], item.node))
        }

    def of(self, sight: Sight) -> tuple[object, str, bool]:
        """Key of the segment an item belongs to, its label, and whether the file gives it."""
        item = sight.item
        labelled = [g for g in item.groups if self.given[g.order]]
        inner = [g for g in labelled if g.order not in self.wrappers]
        whole = next((g for g in inner if g.order not in self.split), None)
        own = self.given[item.node.order]
        if whole is not None and not self.open_groups:
            chain = [*inner[: inner.index(whole)], whole]
            return whole.order, self._label(chain, labelled, ""), True
        if own:
            return item.node.order, self._label([*inner, item.node], labelled, ""), True
        made_up = made_up_name(item.node, sight.colour, _is_round(sight))
        return item, self._label(inner, labelled, made_up), False

    def _label(self, chain: Sequence[Node], labelled: Sequence[Node], made_up: str) -> str:
        words = [self.given[node.order] for node in chain] + ([made_up] if made_up else [])
        if ":" in words[-1]:
            return words[-1]
        wrappers = [self.given[g.order] for g in labelled if g.order in self.wrappers]
        if len(words) == 1 and wrappers:
            words.insert(0, wrappers[-1])
        thing, part = words[0].partition(":")[0], words[-1]
        return f"{thing}:{part}" if len(words) > 1 and thing.casefold() != part.casefold() else part


def _is_round(sight: Sight) -> bool:
    """Whether an item looks like a full circle."""
    h, w = sight.patch.data.shape[:2]
    if min(h, w) < 8 or abs(h - w) > 0.06 * max(h, w):
        return False
    area = solid(sight.patch, (h + max(0, sight.patch.top), w + max(0, sight.patch.left)), sight.peak).sum()
    y, x = np.mgrid[:h, :w]
    radius = (h + w) / 4
    disk = np.hypot(y + 0.5 - h / 2, x + 0.5 - w / 2) <= radius
    inside = (sight.patch.data[..., 3] >= 127 * sight.peak) & disk
    return bool(abs(area - disk.sum()) < 0.05 * disk.sum() and inside.sum() > 0.96 * disk.sum())
