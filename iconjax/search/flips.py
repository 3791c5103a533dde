"""Flips of the default search: the states one step away from a candidate, where it is under strain."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from iconjax.relations.graph import neighbours
from iconjax.search.candidate import Setting, members_of
from iconjax.search.cost import Judgement
from iconjax.search.state import Mode, State, scale_kind

FREEDOMS = ("N", "T", "TR", "TSx", "TSy", "TSu", "TSl")


def flips(setting: Setting, state: State, judgement: Judgement) -> Iterator[State]:
    """States one flip away, at the segments and relations that cost something, most strained first."""
    hot = _hot(setting, state, judgement)
    lost = {e: judgement.outcomes[e] for e in judgement.strained if judgement.outcomes[e] in ("N", "WK")}
    if any(state.relations.get(e, "ST") != s for e, s in lost.items()):
        yield state.with_relations(lost, "relations as they turned out")
        gone = {e: s for e, s in lost.items() if s == "N"}
        if gone and gone != lost:
            yield state.with_relations(gone, "lost relations given up")
    for e in judgement.strained:
        status = state.relations.get(e, "ST")
        for other in ("WK", "N"):
            if other != status:
                yield state.with_relations({e: other}, f"relation {e} to {other}")
    details = [i for i in hot if state.modes[i] == f"W:{setting.facts.host[i]}" and not setting.intent.things_of(i)]
    if len(details) > 1:
        yield state.with_modes(dict.fromkeys(details, "T"), "all details keep their shape")
    for i in details:
        yield state.with_modes({i: "T"}, f"detail {i} keeps its shape")
    for i in hot:
        if state.modes[i] == f"W:{setting.facts.host[i]}" and not setting.intent.things_of(i):
            continue
        for changes, origin in _segment_flips(setting, state, i, judgement.unmet):
            yield state.with_modes(changes, origin)
    yield from _sibling_flips(setting, state, hot)


def _hot(setting: Setting, state: State, judgement: Judgement) -> list[int]:
    relations = setting.relations
    hot = [i for i in judgement.odd if "stretched" in judgement.terms]
    hot += [i for e in judgement.strained for i in (relations[e].a, relations[e].b)]
    hot = list(dict.fromkeys(hot))
    moving = [i for i in range(len(state.modes)) if state.mode(i) != "N"]
    if judgement.unmet:
        hot += [i for i in sorted(setting.intent.mentioned) if i not in hot]
    if {"moved", "turned", "stretched", "squashed", "uprooted"} & judgement.terms.keys():
        hot += [i for i in moving if i not in hot]
    return [i for i in hot if i not in setting.intent.fixed]


def _segment_flips(setting: Setting, state: State, i: int, unmet: bool) -> Iterator[tuple[dict[int, Mode], str]]:
    asked = setting.intent.things_of(i)
    if asked:
        if unmet:
            for mode in _more_freedom(state.mode(i), {k for t in asked for k in t.kinds}):
                yield {state.root(i): mode}, f"segment {state.root(i)} may also {mode}"
        return
    carried = [j for j in members_of(state, i) if j != i and setting.facts.host[j] is None]
    near = sorted(neighbours(setting.relations, {i}))
    ways: list[Mode] = [m for m in FREEDOMS if m != state.modes[i]]
    ways += [f"W:{j}" for j in near if state.root(j) != i and f"W:{j}" != state.modes[i]]
    for way in ways:
        yield {i: way}, f"segment {i} to {way}"
        if carried and not way.startswith("W:"):
            new = carried[0]
            changes: dict[int, Mode] = {i: way, new: state.modes[i]}
            changes |= {j: f"W:{new}" for j in carried[1:] if state.modes[j] == f"W:{i}"}
            yield changes, f"segment {i} alone to {way}"


def _more_freedom(mode: Mode, kinds: set[str]) -> Iterator[Mode]:
    """More freedom for an asked part that cannot do as asked. What was only asked to move neither turns nor changes
    size: better say that a constraint is missed."""
    turn = "R" if mode.startswith("TR") else ""
    kind = scale_kind(mode)
    if not turn and kinds != {"translate"} and "scale" not in kinds:
        yield "TR" + kind
    for other in ("Sx", "Sy", "Sxy", "Su") if "scale" in kinds else ():
        if other != kind and kind in ("", "Su", "Sx", "Sy"):
            yield "T" + turn + other


def _sibling_flips(setting: Setting, state: State, hot: Sequence[int]) -> Iterator[State]:
    """The same flip for all strained segments that move in the same way."""
    idle = [i for i in hot if not setting.intent.things_of(i) and not state.modes[i].startswith("W:")]
    for mode in dict.fromkeys(state.modes[i] for i in idle):
        alike = [i for i in idle if state.modes[i] == mode]
        if len(alike) < 2:
            continue
        for other in FREEDOMS:
            if other != mode:
                yield state.with_modes(dict.fromkeys(alike, other), f"all of {mode} to {other}")
