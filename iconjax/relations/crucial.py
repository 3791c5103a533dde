"""Which relations within an object hold it together, by a stated rule (the offline stand-in for the vision LLM)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import combinations

import networkx as nx

from iconjax.relations.contact import Border, find_contact
from iconjax.relations.types import Relation, Scope
from iconjax.scene.types import Scene

BRIDGE_REACH = 0.08
"""Widest gap, as a share of the picture's larger side, over which a lone object belongs to the nearest one."""


def assign_scopes(
    scene: Scene, relations: Sequence[Relation], crucial: frozenset[frozenset[str]] | None = None
) -> list[Relation]:
    """Type each relation as between objects, crucial within one, or not crucial within one.

    Where `crucial` names the pairs of segments that hold their objects together, it decides. Else a rule does: within
    an object a relation is crucial when the object's parts would fall apart without it, that is when it belongs to the
    spanning tree of tightest contacts (least gap first, then longest contact), or when the two parts touch without any
    gap along at least a twelfth of the smaller one's outline.
    """
    if crucial is not None:
        return [replace(r, scope=_told_scope(scene, r, crucial)) for r in relations]
    tree = nx.Graph()
    for k, r in enumerate(relations):
        if scene.segments[r.a].object == scene.segments[r.b].object:
            tree.add_edge(r.a, r.b, weight=r.contact.gap - 1e-3 * r.contact.length, index=k)
    needed = {d["index"] for _, _, d in nx.minimum_spanning_edges(tree, data=True)}
    out = []
    for k, r in enumerate(relations):
        if scene.segments[r.a].object != scene.segments[r.b].object:
            out.append(replace(r, scope="inter"))
        else:
            firm = r.contact.gap < 1.5 and max(r.contact.share, r.contact.share_b) >= 1 / 12
            out.append(replace(r, scope="intra-crucial" if k in needed or firm else "intra"))
    return out


def _told_scope(scene: Scene, r: Relation, crucial: frozenset[frozenset[str]]) -> Scope:
    a, b = scene.segments[r.a], scene.segments[r.b]
    if a.object != b.object:
        return "inter"
    return "intra-crucial" if frozenset((a.name, b.name)) in crucial else "intra"


def bridge_objects(scene: Scene, relations: Sequence[Relation], borders: Sequence[Border]) -> list[Relation]:
    """ "near" relations that tie each object without any relation to another one to the nearest, if that is close."""
    bridges: list[Relation] = []
    for name in scene.objects:
        members = set(scene.members(name))
        if any(r.scope == "inter" and ({r.a, r.b} & members) for r in [*relations, *bridges]):
            continue
        near = [
            (c.gap, a, b, c)
            for a in members
            for b in set(range(len(scene.segments))) - members
            if (c := find_contact(borders[a], borders[b], BRIDGE_REACH * scene.size, 0.008 * scene.size)) is not None
        ]
        if near:
            _, a, b, contact = min(near, key=lambda item: item[0])
            bridges.append(Relation(a, b, "near", "inter", contact))
    return bridges


def bridge_components(scene: Scene, relations: Sequence[Relation], borders: Sequence[Border]) -> list[Relation]:
    """ "near" relations that tie the unconnected parts of each object together over the shortest gaps.

    They are crucial where a part is connected to nothing else.
    """
    bridges: list[Relation] = []
    firm = {i for r in relations for i in (r.a, r.b)}
    for name in scene.objects:
        members = scene.members(name)
        graph = nx.Graph()
        graph.add_nodes_from(members)
        graph.add_edges_from((r.a, r.b) for r in relations if r.a in graph and r.b in graph)
        groups = list(nx.connected_components(graph))
        if len(groups) < 2:
            continue
        gaps = nx.Graph()
        for (p, first), (q, second) in combinations(enumerate(groups), 2):
            near = [
                (c.gap, a, b, c)
                for a in first
                for b in second
                if (c := find_contact(borders[a], borders[b], scene.size, 0.008 * scene.size)) is not None
            ]
            if near:
                gap, a, b, contact = min(near, key=lambda item: item[0])
                alone = not (first & firm) or not (second & firm)
                scope: Scope = "intra-crucial" if alone else "intra"
                gaps.add_edge(p, q, weight=gap, relation=Relation(a, b, "near", scope, contact))
        bridges += [d["relation"] for _, _, d in nx.minimum_spanning_edges(gaps, data=True)]
    return bridges
