"""Costs of relations: loosened, slid, pulled apart, broken."""

from __future__ import annotations

import numpy as np

from iconjax.relations.types import Relation
from iconjax.search.evidence import Evidence
from iconjax.search.motion import same_motion
from iconjax.search.weights import closeness


def relation_costs(e: Evidence) -> list[tuple[str, float, str]]:
    """Outcome ("ST", "WK", "N" or "F"), cost and term of every relation.

    Two things that meet in several places are still connected while one of these holds: only the cheapest of their
    relations counts in full, the others hardly.
    """
    relations = e.case.setting.relations
    costs = e.case.costs
    weight = {"sole": costs.afloat, "beside": costs.beside, "": 1.0}
    found = [_relation(e, r, weight[e.case.setting.support(k)]) for k, r in enumerate(relations)]
    pairs = [e.case.setting.pair(r) for r in relations]
    best: dict[tuple[int, int], float] = {}
    for pair, (_, cost, _) in zip(pairs, found, strict=True):
        if pair:
            best[pair] = min(best.get(pair, np.inf), cost)
    out = []
    for pair, (outcome, cost, term) in zip(pairs, found, strict=True):
        if pair and cost > best[pair]:
            cost = 0.1 * cost
        elif pair:
            best[pair] = -1.0  # the cheapest one counts once
        out.append((outcome, cost, term))
    return out


def _kind(r: Relation) -> str:
    return r.kind if r.kind in ("near", "inside") else r.scope.replace("intra-crucial", "crucial")


def _relation(e: Evidence, r: Relation, weight: float) -> tuple[str, float, str]:
    case, costs = e.case, e.case.costs
    if same_motion(e.matrices[r.a], e.matrices[r.b], 1e-5):
        return "F" if e.moved(r.a) else "ST", 0.0, ""
    if r.kind == "near" and case.asked[r.a] and case.asked[r.b]:
        return "N", 0.0, ""
    ends = 0.5 * (costs.bearing if r.scope == "inter" and _bears(e, r) else 1.0)
    along, across = (x / case.unit for x in case.shapes.slip(r, e.matrices, e.motion.turn, ends))
    slip = max(along, across)
    if slip < 1.0:
        return "ST", 0.0, ""
    loss = case.shapes.loss(r, e.matrices)
    near = 1.0
    if r.kind == "near":
        near = costs.anyway if r.scope == "intra" else 1.0
        near += (costs.broken["intra"] / costs.broken["near"] - 1) * closeness(r, case.setting.size)
    broken = near * weight * costs.broken[_kind(r)]
    slide = min(near * _slide(e, r, along, across), broken)
    cost = slide + (broken - slide) * loss
    return "N" if loss > 0.5 else "WK" if slip > 4.0 else "ST", cost, "broken" if loss > 0.5 else "slid"


def _slide(e: Evidence, r: Relation, along: float, across: float) -> float:
    """Cost of sliding `along` and coming apart `across` a contact, in pixels at 512 x 512."""
    costs, kind = e.case.costs, _kind(r)
    scales = e.motion.scales
    if np.abs(np.log(scales[r.a] / np.maximum(scales[r.b], 1e-6))).max() > 0.02:
        along *= costs.stretched_slide  # a part that changes size cannot but slide along one that does not
    slide = costs.slid[kind] * min(1.0, along / costs.slide_scale)
    slide += costs.pulled[kind] * min(1.0, across / costs.pull_scale)
    if r.scope == "inter":
        slide *= 1 + costs.carrier * _carried(e, r)
    if {"rotate"} in (e.case.asked[r.a], e.case.asked[r.b]):
        slide *= costs.pivot  # what is to turn and nothing else does not wander off
    if e.case.setting.hinged(r):
        slide *= costs.bearing
    # A broad contact, along much of both outlines, binds the two more than a touch in passing.
    return slide * (1 + costs.broad * max(0.0, min(r.contact.share, r.contact.share_b) - 0.2))


def _carried(e: Evidence, r: Relation) -> float:
    """How much larger the side that moves is than the one that stays behind, 0..1: the larger carries the smaller
    along, while a small thing may well slide along a large one."""
    case, shift = e.case, e.motion.shift
    moving, behind = (r.a, r.b) if shift[r.a] >= shift[r.b] else (r.b, r.a)
    if case.facts.hung[behind]:
        return 1.0
    if case.facts.grounded[behind]:
        return 0.0  # what stands on the ground carries, and is not carried
    large, small = (case.piece_area[case.setting.pieces[i]] for i in (moving, behind))
    return max(0.0, 2 * large / (large + small) - 1)


def _bears(e: Evidence, r: Relation) -> bool:
    """Whether one side turns and the other, which stands on the ground, stays: a stand bears what spins on it."""
    case = e.case
    for turning, standing in ((r.a, r.b), (r.b, r.a)):
        spins = "rotate" in case.asked[turning] and abs(e.motion.turn[turning]) > 1.0
        piece = [i for i, p in enumerate(case.setting.pieces) if p == case.setting.pieces[standing]]
        if spins and case.facts.grounded[piece].any() and not e.moved(standing):
            return True
    return False
