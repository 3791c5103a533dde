"""The best parse trees of a parse forest, best first.

A tree is as good as the sum of the preferences of its rules, as written in the grammar. Sums are the same
wherever a part stands in a tree, so the best trees of a node come from the best trees of its children, and a
forest of millions of trees is ranked without ever listing it.
"""

from __future__ import annotations

from collections.abc import Iterable
from heapq import heappop, heappush
from typing import TypeAlias

from lark import Token, Tree
from lark.parsers.earley_forest import PackedNode, SymbolNode, TokenNode

Piece: TypeAlias = Token | Tree[Token]
Ranked: TypeAlias = tuple[int, tuple[Piece, ...]]
"""Preference, and the pieces of a (perhaps partial) tree from left to right."""


def best_trees(root: SymbolNode, most: int, window: int) -> list[tuple[int, Tree[Token]]]:
    """Up to `most` trees, best first, none worse than the best by more than `window`."""
    ranked = [(rank, tree) for rank, (tree,) in _Ranking(most, window).of(root) if isinstance(tree, Tree)]
    return [(rank, tree) for rank, tree in ranked if rank >= ranked[0][0] - window]


class _Ranking:
    """The best trees of every node, each worked out once."""

    def __init__(self, most: int, window: int) -> None:
        self.most, self.window = most, window
        self.known: dict[int, list[Ranked]] = {}

    def of(self, node: SymbolNode | TokenNode | None) -> list[Ranked]:
        if node is None:
            return [(0, ())]
        if isinstance(node, TokenNode):
            return [(0, (node.token,))]
        if id(node) not in self.known:
            self.known[id(node)] = []  # a cycle leads to no tree
            every = [one for packed in node.children for one in self._packed(node, packed)]
            self.known[id(node)] = self._cut(every)
        return self.known[id(node)]

    def _packed(self, node: SymbolNode, packed: PackedNode) -> Iterable[Ranked]:
        for rank, pieces in self._pairs(self.of(packed.left), self.of(packed.right)):
            if node.is_intermediate:
                yield rank, pieces
                continue
            rule = packed.rule
            name = rule.alias or rule.origin.name
            inlined = name.startswith("_")
            yield rank + (rule.options.priority or 0), pieces if inlined else (Tree(name, list(pieces)),)

    def _pairs(self, left: list[Ranked], right: list[Ranked]) -> Iterable[Ranked]:
        """The best pairs of two ranked lists, by walking their product from its best corner."""
        if not left or not right:
            return
        queue, seen, given = [(-left[0][0] - right[0][0], 0, 0)], {(0, 0)}, 0
        while queue and given < self.most:
            cost, i, j = heappop(queue)
            yield -cost, left[i][1] + right[j][1]
            given += 1
            for at in ((i + 1, j), (i, j + 1)):
                if at[0] < len(left) and at[1] < len(right) and at not in seen:
                    seen.add(at)
                    heappush(queue, (-left[at[0]][0] - right[at[1]][0], *at))

    def _cut(self, every: list[Ranked]) -> list[Ranked]:
        every.sort(key=lambda one: -one[0])
        least = every[0][0] - self.window if every else 0
        return [one for one in every[: self.most] if one[0] >= least]
