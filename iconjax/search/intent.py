"""What a program asks of which segments."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from iconjax.dsl.nodes import Call, Node, Number, Program, SegmentRef
from iconjax.scene.types import Scene

KINDS = ("translate", "rotate", "scale")
EXTENTS: Mapping[str, frozenset[str]] = {
    "hori_len": frozenset("x"),
    "vert_len": frozenset("y"),
    "long_len": frozenset({"long"}),
    "short_len": frozenset({"short"}),
    "scale_x": frozenset({"own x"}),
    "scale_y": frozenset({"own y"}),
    "uniform": frozenset({"uniform"}),
}
"""Which extents of a segment an operator speaks of."""
TURNING = frozenset(
    {
        "rotation",
        "angle",
        "long_dir_x",
        "long_dir_y",
        "short_dir_x",
        "short_dir_y",
        "parallel",
        "perpendicular",
    }
)
"""Operators that speak of a direction."""


@dataclass(frozen=True)
class Thing:
    """Something that a motion specifier speaks of as one thing.

    Attributes:
        members: its segments.
        kinds: kinds of motion asked of it.
        extents: extents of it that the program speaks of.
        turns: whether the program says where it should point.
    """

    members: tuple[int, ...]
    kinds: frozenset[str]
    extents: frozenset[str]
    turns: bool


@dataclass(frozen=True)
class Intent:
    """What a program asks.

    Attributes:
        things: what should move; the first thing of a segment is the one that names the least.
        fixed: segments told to stay.
        together: sets of segments that move as one.
        mentioned: segments that a constraint mentions in their edited pose.
        placed: pairs of segment sets where the first is put on top of the second and touches it.
        hinged: pairs of segment sets that turn about each other.
        changed: extents, "x" or "y", that a constraint changes rather than keeps.
    """

    things: tuple[Thing, ...]
    fixed: frozenset[int]
    together: tuple[frozenset[int], ...]
    mentioned: frozenset[int]
    placed: tuple[tuple[frozenset[int], frozenset[int]], ...]
    changed: frozenset[str]
    hinged: tuple[tuple[frozenset[int], frozenset[int]], ...]

    def only_extent(self, kind: str) -> str:
        """The one-axis scale kind behind `kind` where the program changes one extent and keeps the other, else ""."""
        if kind != "Sxy":
            return kind
        return {frozenset("x"): "Sx", frozenset("y"): "Sy"}.get(self.changed, "")

    def things_of(self, segment: int) -> tuple[Thing, ...]:
        """Things that `segment` belongs to, the smallest first."""
        return tuple(sorted((t for t in self.things if segment in t.members), key=lambda t: len(t.members)))


def read_intent(program: Program, scene: Scene) -> Intent:
    """Collect what `program` asks.

    A program without any motion specifier for a constraint is read as asking the first segment of that constraint to
    move in the way the constraint speaks of.
    """
    asked: dict[tuple[int, ...], set[str]] = {}
    fixed: set[int] = set()
    together: list[frozenset[int]] = []
    for call in program.calls:
        if call.name in KINDS or call.name == "stay":
            members = scene.members(_name(call.args[0]))
            if call.name == "stay":
                fixed |= set(members)
            else:
                asked.setdefault(members, set()).add(call.name)
        elif call.name == "together":
            together.append(frozenset(i for a in call.args for i in _members(a, scene)))
    constraints = [c for c in program.calls if c.name not in KINDS and c.name != "stay"]
    _imply(constraints, scene, asked, fixed)
    spoken = _spoken(constraints, scene)
    things = []
    for members, kinds in asked.items():
        movable = tuple(i for i in members if i not in fixed)
        if movable:
            extents = _extents(constraints, scene, members)
            turns = any(t for m, _, t in spoken if set(m) & set(movable))
            things.append(Thing(movable, frozenset(kinds), extents, turns))
    mentioned = frozenset(i for m, _, _ in spoken for i in m)
    changed = frozenset(
        e for c in constraints if not _keeps(c) for _, extents, _ in _spoken([c], scene) for e in extents
    )
    return Intent(
        tuple(things), frozenset(fixed), tuple(together), mentioned, _placed(constraints, scene), changed & {"x", "y"},
        tuple(_pairs(constraints, scene, "hinge", "coincide_on_point")),
    )  # fmt: skip


def _extents(constraints: list[Call], scene: Scene, members: tuple[int, ...]) -> frozenset[str]:
    """Extents of a thing that the program sets, and those that it only keeps.

    Two opposite sides set the extent between them. One that is kept says that the other one changes.
    """
    fits = [
        (c, s) for c in constraints for s in _spoken([c], scene) if set(s[0]) & set(members) and _fits(s[0], members)
    ]
    spoken = frozenset().union(*(s[1] for _, s in fits))
    changed = frozenset().union(*(s[1] for c, s in fits if not _keeps(c)))
    sides = {name for c in constraints for name in _sides(c, scene, members)}
    spoken |= {axis for axis in "xy" if {f"min_{axis}", f"max_{axis}"} <= sides}
    if spoken and spoken <= {"x", "y"} and not changed:
        spoken |= {"x", "y"}
    return spoken


def _sides(node: Node, scene: Scene, members: tuple[int, ...]) -> set[str]:
    """Sides of the boxes of `members` that an expression speaks of, in their edited pose."""
    if not isinstance(node, Call) or node.name == "old":
        return set()
    own = {node.name} if any(_region(a, scene) == members for a in node.args) else set()
    return own.union(*(_sides(a, scene, members) for a in node.args))


def _fits(spoken: tuple[int, ...], members: tuple[int, ...]) -> bool:
    """Whether words about `spoken` are words about the thing: about itself, or about a whole that it is part of."""
    return set(members) <= set(spoken) or set(spoken) <= set(members)


def _name(node: Node) -> str:
    return node.name if isinstance(node, SegmentRef) else ""


def _members(node: Node, scene: Scene) -> tuple[int, ...]:
    """Segments that an expression moves with; none for what is taken as it was."""
    if isinstance(node, SegmentRef):
        return scene.members(node.name)
    if isinstance(node, Call) and node.name != "old":
        return tuple(dict.fromkeys(i for a in node.args for i in _members(a, scene)))
    return ()


def _spoken(constraints: list[Call], scene: Scene) -> list[tuple[tuple[int, ...], frozenset[str], bool]]:
    found: list[tuple[tuple[int, ...], frozenset[str], bool]] = []

    def visit(node: Node) -> None:
        if not isinstance(node, Call) or node.name == "old":
            return
        members = [m for a in node.args if isinstance(a, SegmentRef | Call) and (m := _region(a, scene))]
        for m in members:
            found.append((m, EXTENTS.get(node.name, frozenset()), node.name in TURNING))
        for a in node.args:
            visit(a)

    for call in constraints:
        visit(call)
    return found


def _region(node: Node, scene: Scene) -> tuple[int, ...]:
    """Segments of an argument that is a region in its edited pose, directly or through a region operator."""
    if isinstance(node, SegmentRef):
        return scene.members(node.name)
    if isinstance(node, Call) and node.name in {"top", "bot", "left", "right", "union", "inter"}:
        return tuple(dict.fromkeys(i for a in node.args for i in _region(a, scene)))
    return ()


def _imply(constraints: list[Call], scene: Scene, asked: dict[tuple[int, ...], set[str]], fixed: set[int]) -> None:
    movable = {i for members in asked for i in members}
    for call in constraints:
        spoken = [s for s in _spoken([call], scene) if not set(s[0]) <= fixed]
        if not spoken or any(set(m) & movable for m, _, _ in spoken):
            continue
        members, extents, turns = spoken[0]
        kind = "rotate" if turns else "scale" if extents else "translate"
        if not _keeps(call):
            asked.setdefault(members, set()).add(kind)


def _keeps(call: Call) -> bool:
    """Whether a constraint only says that something keeps its old value: that asks for no motion."""
    if call.name != "equal" or len(call.args) != 2:
        return False
    still = Number(0.0) in call.args and any(isinstance(a, Call) and a.name in {"rotation", "angle"} for a in call.args)
    return still or _strip(call.args[0]) == _strip(call.args[1])


def _strip(node: Node) -> Node:
    if isinstance(node, Call):
        if node.name == "old":
            return node.args[0]
        return Call(node.name, tuple(_strip(a) for a in node.args))
    return node


def _placed(constraints: list[Call], scene: Scene) -> tuple[tuple[frozenset[int], frozenset[int]], ...]:
    touching = _pairs(constraints, scene, "touch", "overlap")
    touching |= {(b, a) for a, b in touching}
    return tuple(p for p in sorted(_pairs(constraints, scene, "on_top"), key=str) if p in touching)


def _pairs(constraints: list[Call], scene: Scene, *names: str) -> set[tuple[frozenset[int], frozenset[int]]]:
    """Segment sets that calls of some operators relate."""
    found = set()
    for c in constraints:
        regions = [frozenset(m) for a in c.args if (m := _members(a, scene))]
        if c.name in names and len(regions) == 2:
            found.add((regions[0], regions[1]))
    return found
