"""Where the default search begins: what was asked moves, what hangs on it follows, the rest stays."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import product

import networkx as nx

from iconjax.relations.graph import neighbours, relation_graph
from iconjax.search.candidate import Setting
from iconjax.search.facts import Facts
from iconjax.search.intent import Thing
from iconjax.search.state import Mode, State, scale_kind

ELONGATED = 3.0
"""From this ratio of its extents on, a segment told to change size without more ado does so along its long axis."""
MOST = 64
"""Most states that a search begins with."""


def asked_mode(facts: Facts, things: Sequence[Thing], leader: int, alone: bool) -> Mode:
    """The freedoms that the things a segment belongs to ask for."""
    kinds = {k for t in things for k in t.kinds}
    mode = "TR" if "rotate" in kinds else "T"
    if "scale" not in kinds:
        return mode
    extents = {e for t in things if "scale" in t.kinds for e in t.extents}
    slim = alone and facts.elongated[leader] >= ELONGATED
    oblique = min(abs(facts.long_dir[leader])) > 0.1
    if "uniform" in extents:
        return mode + "Su"
    if extents & {"long", "own x", "own y"} or (slim and (oblique and len(extents & {"x", "y"}) == 1)):
        return mode + "Sl"
    if "short" in extents:
        return mode + "Ss"
    if {"x", "y"} <= extents:
        return mode + "Sxy"
    if extents & {"x", "y"}:
        return mode + ("Sx" if "x" in extents else "Sy")
    return mode + ("Sl" if slim else "Su")


def asked_state(setting: Setting) -> State:
    """Only what the request names is free, in the ways it asks; details go with their hosts."""
    facts, intent = setting.facts, setting.intent
    n = len(facts.area)
    modes = ["N"] * n
    asked = {i for t in intent.things for i in t.members}
    for i, host in enumerate(facts.host):
        if (
            host is not None
            and i not in intent.fixed
            and i not in {m for t in intent.things if len(t.members) == 1 for m in t.members}
        ):
            modes[i] = f"W:{host}" if i not in asked or host in asked else "N"
    for thing in sorted(intent.things, key=lambda t: -len(t.members)):
        rest = [i for i in thing.members if intent.things_of(i)[0] == thing and not modes[i].startswith("W:")]
        if len(rest) == len([i for i in thing.members if not modes[i].startswith("W:")]):
            groups = [set(rest)] if rest else []
        else:
            groups = [set(g) for g in nx.connected_components(relation_graph(setting.relations, rest))]
        for group in groups:
            leader = max(group, key=lambda i: facts.area[i])
            modes[leader] = asked_mode(facts, intent.things_of(leader), leader, len(group) == 1)
            for i in group - {leader}:
                modes[i] = f"W:{leader}"
    for i, host in enumerate(facts.host):
        kind = scale_kind(modes[_root(modes, i)]) if modes[i] == f"W:{host}" else ""
        if kind not in ("", "Su") and facts.round[i] and i not in asked:
            modes[i] = "T"  # a disc on something that changes its proportions stays a disc
    for together in intent.together:
        free = [i for i in together if i not in intent.fixed]
        leaders = [i for i in free if modes[i] != "N" and not modes[i].startswith("W:")] or free[:1]
        modes = [f"W:{leaders[0]}" if i in free and i != leaders[0] else m for i, m in enumerate(modes)]
    return State(tuple(modes), {}, "only what was asked")


def _root(modes: Sequence[Mode], i: int) -> int:
    return State(tuple(modes)).root(i)


def hanging(setting: Setting, base: State) -> list[set[int]]:
    """Connected sets of unasked segments that hang on something asked, the largest first."""
    intent = setting.intent
    asked = {i for t in intent.things for i in t.members}
    idle = {i for i, m in enumerate(base.modes) if m == "N" and i not in intent.fixed and i not in asked}
    moving = {i for i in range(len(base.modes)) if base.mode(i) != "N"}
    sets = []
    for group in nx.connected_components(relation_graph(setting.relations, idle)):
        if neighbours(setting.relations, group) & moving or group & intent.mentioned:
            sets.append(set(group))
    return sorted(sets, key=lambda g: -sum(setting.facts.area[i] for i in g))


def group_modes(group: set[int], leader: int, mode: Mode) -> dict[int, Mode]:
    """Changes that make a set of segments move as one."""
    return {i: (mode if i == leader else "N" if mode == "N" else f"W:{leader}") for i in group}


def options(setting: Setting, base: State, group: set[int]) -> list[dict[int, Mode]]:
    """Ways in which a hanging set may follow: going along, by itself, stretching, or not at all; likeliest first."""
    leader = max(group, key=lambda i: setting.facts.area[i])
    touched = sorted(i for i in neighbours(setting.relations, group) if base.mode(i) != "N")
    roots = sorted({base.root(i) for i in touched})
    rigid = [r for r in roots if not scale_kind(base.modes[r])]
    out = [dict.fromkeys(group, f"W:{r}") for r in rigid]
    out.append(group_modes(group, leader, "T"))
    if any("R" in base.mode(i) for i in touched):
        out.append(group_modes(group, leader, "TR"))
    out.append(group_modes(group, leader, "N"))
    if len(group) > 1:
        out += loose_modes(setting, base, group)
    if len(group) == 1:
        out += [{leader: f"W:{r}"} for r in roots if r not in rigid]
        out += [group_modes(group, leader, m) for m in ("TSx", "TSy")]
    return out


def loose_modes(setting: Setting, base: State, group: set[int]) -> list[dict[int, Mode]]:
    """A hanging set taken apart: each of its segments follows by itself, those next to something that changes size
    change theirs in the same way."""
    apart = dict.fromkeys(group, "T")
    out = [apart]
    scaled = {}
    for i in group:
        kinds = {scale_kind(base.mode(j)) for j in neighbours(setting.relations, {i})} - {
            "",
            "Su",
            "Sl",
            "Ss",
        }
        for kind in sorted(kinds):
            scaled[i] = "T" + (setting.intent.only_extent(kind) or kind)
    if scaled:
        out.append({**apart, **scaled})
    return out


def initial_states(setting: Setting) -> list[State]:
    """The states to begin with: all combinations of how hanging sets follow where they are few, else variations of the
    likeliest combination and of nothing following."""
    base = asked_state(setting)
    sets = hanging(setting, base)
    ways = [options(setting, base, g) for g in sets]
    states = [base, *_torn(setting, base, sets)]
    count = 1
    for w in ways:
        count *= len(w)
    if count <= MOST:
        for combination in product(*ways):
            states.append(_merge(base, combination, "combination of ways to follow"))
        return _unique(states)
    likely = [w[0] for w in ways]
    states.append(_merge(base, likely, "everything follows"))
    for k, w in enumerate(ways):
        for way in w[1:]:
            states.append(_merge(base, [*likely[:k], way, *likely[k + 1 :]], "everything follows but one"))
        states.append(_merge(base, [w[0]], "one set follows"))
    return _unique(states)[:MOST]


def _torn(setting: Setting, base: State, sets: Sequence[set[int]]) -> Iterator[State]:
    """What follows something asked to move and lets go of what stays: held by both, it would not move at all."""
    moving = {i for i in range(len(base.modes)) if base.mode(i) != "N"}
    alone = [{i} for g in sets if len(g) > 1 for i in sorted(g) if neighbours(setting.relations, {i}) & moving]
    for group in (*sets, *alone):
        pairs = [(e, {r.a, r.b} - group) for e, r in enumerate(setting.relations) if {r.a, r.b} & group]
        loose = {e: "N" for e, others in pairs if others and not others & moving}
        if loose and any(others & moving for _, others in pairs):
            leader = max(group, key=lambda i: setting.facts.area[i])
            follows = base.with_modes(group_modes(group, leader, "T"), "follows and lets go of what stays")
            yield follows.with_relations(loose, follows.origin)


def _merge(base: State, changes: Sequence[dict[int, Mode]], origin: str) -> State:
    merged: dict[int, Mode] = {}
    for c in changes:
        merged.update(c)
    return base.with_modes(merged, origin)


def _unique(states: Sequence[State]) -> list[State]:
    return list({s.key: s for s in reversed(states)}.values())[::-1]
