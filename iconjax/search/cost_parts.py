"""Costs of what parts do: unasked motion, unasked kinds of motion, and what was asked but did not happen."""

from __future__ import annotations

from itertools import combinations

import numpy as np

from iconjax.search.evidence import Evidence, Terms
from iconjax.search.motion import STILL_PX, corner_distance, same_motion
from iconjax.search.state import scale_kind

ALONG = 0.35
"""What is left behind by less than this share of its own way goes along."""


def unasked_costs(e: Evidence) -> Terms:
    """Cost of every distinct motion that nobody asked for, once for all segments that share it."""
    case, costs = e.case, e.case.costs
    for members in _groups(e):
        matrix = e.matrices[members[0]]
        along = any(same_motion(matrix, e.matrices[i]) for i in case.asked_segments)
        if along or _borne(e, members):
            yield "along", costs.along
        elif not _echoes(e, members):
            yield "moved", costs.moved
        for i in members:
            if case.facts.host[i] not in members:
                yield from _carried_off(e, i, along)
            yield from _distorted(e, i)


def odd_segments(e: Evidence) -> tuple[int, ...]:
    """Segments that changed unasked, those with the greatest change of a kind first: distorted, turned, moved."""
    moved = [i for i in range(len(e.matrices)) if e.moved(i) and not e.case.asked[i]]
    return tuple(sorted(moved, key=lambda i: (-round(e.motion.stretch(i), 2), -round(abs(float(e.motion.turn[i]))))))


def _groups(e: Evidence) -> list[list[int]]:
    """Unasked segments that moved, by their motion."""
    groups: list[list[int]] = []
    for i in range(len(e.matrices)):
        if not e.moved(i) or e.case.asked[i]:
            continue
        same = next((g for g in groups if same_motion(e.matrices[g[0]], e.matrices[i])), None)
        if same is None:
            groups.append([i])
        else:
            same.append(i)
    return groups


def _dragged(e: Evidence) -> float:
    """How much a part drags the whole picture along, 0 to 1: what goes more or less along is larger than what was asked
    to move, and little stays behind.

    Who asks for a part to move means: against the rest. What takes the rest along has not moved at all.
    """
    area, asked = e.case.facts.area, e.case.asked_segments
    leading = [i for i in asked if e.case.asked[i] <= {"translate", "rotate"} and e.moved(i)]
    rest = 1.0 - float(area[asked].sum())
    if not leading or rest < 1e-6:
        return 0.0
    first = e.matrices[max(leading, key=lambda i: area[i])]
    along = [
        i
        for i in range(len(area))
        if e.moved(i)
        and not e.case.asked[i]
        and corner_distance(e.matrices[i], first, e.case.facts.features[i]) < ALONG * e.motion.shift[i]
    ]
    dragged = float(area[along].sum())
    larger = np.clip(dragged / float(area[leading].sum()) - 1, 0, 1)
    return float(larger * np.clip((dragged / rest - 0.5) / 0.3, 0, 1))


def _borne(e: Evidence, members: list[int]) -> bool:
    """Whether the members follow, without turning or changing size, the very place of an asked part of their own object
    that they are fixed to."""
    case = e.case
    if any(e.motion.stretch(i) > 0.005 or abs(e.motion.turn[i]) > 0.3 for i in members):
        return False
    for r in case.setting.relations:
        ends = {r.a, r.b}
        fixed = r.scope == "intra-crucial" and ends & set(members) and any(case.asked[i] for i in ends - set(members))
        if fixed and max(case.shapes.slip(r, e.matrices, e.motion.turn, 0.0)) < 1.5 * case.unit:
            return True
    return False


def _echoes(e: Evidence, members: list[int]) -> bool:
    """Whether the motion is the mirror image of another's: a pair that stays symmetric moves by one decision."""
    for m in e.case.facts.mirrors:
        if m.b in members and e.moved(m.a) and not e.case.asked[m.a]:
            off = m.off(e.features) - m.off(e.case.facts.features)
            if off < 2 * e.case.unit and abs(e.motion.stretch(m.a) - e.motion.stretch(m.b)) < 0.01:
                return True
    return False


def _carried_off(e: Evidence, i: int, along: bool) -> Terms:
    case, costs, turn = e.case, e.case.costs, abs(e.motion.turn[i])
    area = float(case.facts.area[i])
    far = min(1.0, float(e.motion.shift[i]) / (20 * case.unit))
    heavy = costs.rooted if case.facts.grounded[i] else 0.5 if along else 1.0
    yield "moved", costs.moved_area * area * far * heavy
    if turn > 0.3:
        weight = costs.turned * (2 * area if along else 1.0) + (costs.hung if case.facts.hung[i] else 0.0)
        yield "turned", weight * min(1.0, turn / 10)
    if case.facts.grounded[i] and turn > 3:
        yield "tipped", costs.tipped * min(1.0, turn / 10)
    if case.facts.grounded[i]:
        weight = costs.uprooted * (0.5 if along else 1.0) * (1 + min(1.0, turn / 10))
        yield "uprooted", weight * min(1.0, e.lifted(i) / 20)


def _distorted(e: Evidence, i: int) -> Terms:
    costs, facts, stretch = e.case.costs, e.case.facts, e.motion.stretch(i)
    if stretch < 0.005:
        return
    detail = facts.host[i] is not None
    yield "stretched", costs.stretched * (0.15 if detail else 1.0) * (0.3 + min(1.0, stretch))
    if facts.round[i]:
        long, short = e.motion.scales[i]
        yield "squashed", costs.squashed * min(1.0, 3 * float(np.log(long / max(short, 1e-3))))


def idle_costs(e: Evidence) -> Terms:
    """Kinds of motion that were asked and did not happen: a specifier is meant."""
    case, costs, intent = e.case, e.case.costs, e.case.setting.intent
    for thing in intent.things:
        members = list(thing.members)
        if "rotate" in thing.kinds:
            yield "idle", costs.idle_specifier * float((np.abs(e.motion.turn[members]) < 1.0).mean())
        if "scale" in thing.kinds and max(e.motion.stretch(i) for i in members) < 0.01:
            yield "idle", costs.idle_specifier
        if "translate" in thing.kinds:
            idle = float((e.motion.shift[members] < STILL_PX * case.unit).mean())
            yield "idle", costs.idle_specifier * (idle if 0 < idle < 1 else idle / 4)
    for first, second in intent.hinged:
        if abs(e.motion.turn[min(first)] - e.motion.turn[min(second)]) < 0.5:
            yield "idle", costs.idle_specifier


def asked_costs(e: Evidence) -> Terms:
    """Unasked kinds of change of asked parts, how much they change, and whether things asked alike move alike."""
    case, costs, turn = e.case, e.case.costs, np.abs(e.motion.turn)
    asked = case.asked_segments
    free = [m for m in e.state.modes if m != "N" and not m.startswith("W:")]
    yield "freedom", costs.freedom * (sum(len(m) for m in free) + len(e.state.relations))
    if asked:
        yield "amount", costs.amount * float(e.motion.shift[asked].mean()) / case.unit
    turning = [t.members[0] for t in case.setting.intent.things if t.kinds == {"rotate"}]
    for i, j in combinations(turning, 2):
        apart = float(abs(turn[i] - turn[j]))
        yield "uneven", costs.uneven * min(1.0, apart / 10) if apart > 0.5 else 0.0
    yield "dragged", costs.dragged * _dragged(e)
    drifts = [_drift(e, i) for i in asked if case.asked[i] == {"scale"}]
    yield "drift", costs.drift * min(1.0, max(drifts, default=0.0) / 20)
    for i in asked:
        kinds, stretch = case.asked[i], e.motion.stretch(i)
        if case.facts.grounded[i] and not kinds & {"translate", "rotate"} and e.lifted(i) > 1.5:
            yield "uprooted", costs.asked_uprooted * min(1.0, e.lifted(i) / 20)
        if "rotate" not in kinds and turn[i] > 0.3:
            yield "extra", costs.extra * min(1.0, 0.3 + float(turn[i]) / 10)
        if "scale" not in kinds and stretch > 0.005:
            yield "extra", costs.extra * min(1.0, 0.3 + stretch)
        elif scale_kind(e.state.mode(i)) and stretch > 1.2:
            yield "extra", 0.5 * (stretch - 1.2)


def _drift(e: Evidence, i: int) -> float:
    """How far sideways the middle of segment `i` went, px at 512 x 512: what changes its size does so where it is.

    Up and down, it stands or hangs on something.
    """
    return float(abs(e.features[i, 1] - e.case.facts.features[i, 1])) / e.case.unit
