"""The relation graph: segments as nodes, relations as edges (paper, "Optimization")."""

from __future__ import annotations

from collections.abc import Collection, Iterable

import networkx as nx

from iconjax.relations.types import Relation


def relation_graph(relations: Iterable[Relation], nodes: Collection[int]) -> nx.Graph:
    """The graph of relations among some segments; each edge carries its relation."""
    graph = nx.Graph()
    graph.add_nodes_from(nodes)
    for r in relations:
        if r.a in graph and r.b in graph:
            graph.add_edge(r.a, r.b, relation=r)
    return graph


def neighbours(relations: Iterable[Relation], group: Collection[int]) -> set[int]:
    """Segments outside `group` that are related to one in it."""
    near: set[int] = set()
    for r in relations:
        near |= {r.b} if r.a in group else set()
        near |= {r.a} if r.b in group else set()
    return near - set(group)
