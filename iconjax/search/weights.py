"""The two tables of weights of the default search: forces inside a solve, costs between candidates.

Chosen by experiment, see `docs/search.md`; the script is `eval/tune.py`. Lengths are in pixels at 512 x 512.
"""

from __future__ import annotations

from collections.abc import Mapping, Set
from dataclasses import dataclass, field

import numpy as np
from jaxtyping import Float

from iconjax.relations.types import Relation


def closeness(r: Relation, size: float) -> float:
    """How much parts that only lie near each other belong together: 1 across a small gap, 0 across a wide one, or where
    both are connected to something else."""
    if r.scope != "intra-crucial":
        return 0.0
    return float(np.clip((0.12 - r.contact.gap / size) / 0.04, 0.0, 1.0))


@dataclass(frozen=True)
class Forces:
    """Pulls inside one solve (weight of an absolute residual, per pixel).

    Attributes:
        crucial, intra, inter, inside, near: holding the meeting point of a relation, by type.
        middle, end: shares of these that hold the middle and each end of a contact: a follower turns or stretches along
            where it may, and slides as a whole where it may not.
        align: keeping an alignment, by its reason.
        asked_ground: share of the ground's force that acts on what is asked to move.
        canvas: staying in the picture.
        idle: unasked motion of a part: translation, rotation, scaling.
        inertia: weight of half the squared parameter of what was asked to move.
        shift: shifting what is asked to turn or to change size, but not to move.
        stray: the same absolutely, so that things move straight along an axis where that serves.
        spin: shifting a disc that is asked to turn, and nothing else.
    """

    crucial: float = 20.0
    intra: float = 8.0
    inter: float = 8.0
    inside: float = 12.0
    near: float = 2.0
    middle: float = 0.34
    end: float = 0.33
    align: Mapping[str, float] = field(
        default_factory=lambda: {
            "touching": 20.0,
            "siblings": 2.0,
            "ground": 4.0,
            "support": 6.0,
            "overhang": 20.0,
            "floor": 4.0,
        }
    )
    asked_ground: float = 0.2
    canvas: float = 30.0
    idle: tuple[float, float, float] = (0.2, 0.4, 0.8)
    inertia: float = 3e-4
    stray: float = 0.03
    spin: float = 60.0
    shift: float = 0.25

    def hold(self, r: Relation, size: float) -> float:
        """Force that holds the meeting point of a relation; `size` is that of the picture."""
        return self.middle * self.strength(r, size)

    def strength(self, r: Relation, size: float) -> float:
        """Force that holds a relation."""
        if r.kind == "near":
            return self.near + (self.intra - self.near) * closeness(r, size)
        if r.kind == "inside":
            return self.inside
        return {"intra-crucial": self.crucial, "intra": self.intra, "inter": self.inter}[r.scope]

    def ends(self, r: Relation, size: float) -> float:
        """Force that holds each end of a contact."""
        return self.end * self.strength(r, size) * (0.2 if r.kind == "near" else 1.0)

    def body(self, asked: Set[str], area: float, spins: bool) -> tuple[Float[np.ndarray, "5"], Float[np.ndarray, "5"]]:
        """Inertia and sparsity of a body, given the kinds of motion asked of it and its share of the area.

        A disc that `spins` (is asked to turn and nothing else) does so about its centre.
        """
        move, turn, scale = (w * (1 + 4 * area) for w in self.idle)
        sparsity = np.array([move, move, turn, scale, scale])
        if asked:  # whatever turns or changes size may have to shift for it
            sparsity[:2] = self.spin if spins else self.stray if "translate" in asked else self.shift
        if "rotate" in asked:
            sparsity[2] = 0.0
        if "scale" in asked:
            sparsity[3:] = 0.0
        return np.full(5, self.inertia), sparsity


@dataclass(frozen=True)
class Costs:
    """Costs between candidates; the cheapest one that meets every primary constraint wins.

    Attributes:
        unmet: a primary constraint that fails, plus `unmet_px` for each pixel it is off.
        broken: a relation that no longer holds, by type.
        slid: a relation that still holds but whose sides slid along each other by `slide_scale` or more, by type (in
            proportion below that).
        stretched_slide: share of the sliding that counts where one side changes size and the other does not.
        pulled: the same for sides that came apart or into each other by `pull_scale` or more, across the contact.
        broad: how much dearer that gets for each share of both outlines, beyond a fifth, that lies at the contact.
        carrier: how much dearer it gets where the larger of two things moves and leaves the smaller behind.
        anyway: share of the costs of a "near" relation that counts where both parts are held by something else.
        afloat: how much dearer it is to break a relation without which a thing hangs in the air.
        beside: share of the cost of breaking a relation between two things that both stand on something else.
        bearing: share of it that counts between what turns on request and a stand that stays.
        moved: another set of parts that moves in a way of its own though nobody asked; plus `moved_area` for its area.
        rooted: factor on that area for what stands on the ground.
        freedom: for each degree of freedom and each relation let go: of equal results the simplest explanation wins.
        along: the same where it goes along with something that was asked to move.
        dragged: a part that was asked to move or turn takes nearly everything along.
        turned, stretched: added where it turns or changes size; `squashed` where a disc loses its shape.
        hung: added where something turns that hangs from what moves.
        uprooted: something that stood on the ground leaves it; `asked_uprooted` where it was only asked to change size.
        drift: what is asked to change size, and nothing else, goes sideways by 20 pixels or more.
        tipped: what stands on the ground is turned by 10 degrees or more though nobody asked.
        extra: an unasked kind of motion of an asked part.
        idle_specifier: a kind of motion that was asked and did not happen.
        amount: for each pixel that asked parts move on average: of equal solutions the smaller change wins.
        pivot: how much dearer sliding is for what is asked to turn and nothing else.
        uneven: two things that are asked to turn do so by different angles.
        misaligned: an alignment lost, by its reason; all of them at most `misaligned_most`.
        asymmetric: a symmetry of a pair about a third segment lost; all of them at most `asymmetric_most`.
        off_canvas: per share of a segment's box outside the picture.
        collision: a new overlap of things that were apart, per share of the smaller.
    """

    unmet: float = 1000.0
    unmet_px: float = 10.0
    broken: Mapping[str, float] = field(
        default_factory=lambda: {"crucial": 12.0, "intra": 4.0, "inter": 4.0, "inside": 8.0, "near": 0.5}
    )
    slid: Mapping[str, float] = field(
        default_factory=lambda: {"crucial": 6.0, "intra": 1.5, "inter": 1.0, "inside": 3.0, "near": 0.5}
    )
    pulled: Mapping[str, float] = field(
        default_factory=lambda: {"crucial": 4.0, "intra": 1.5, "inter": 2.0, "inside": 2.0, "near": 0.5}
    )
    broad: float = 4.0
    carrier: float = 2.0
    anyway: float = 0.3
    afloat: float = 2.0
    beside: float = 0.4
    bearing: float = 0.3
    slide_scale: float = 50.0
    stretched_slide: float = 0.4
    pull_scale: float = 30.0
    moved: float = 0.7
    moved_area: float = 5.0
    rooted: float = 1.5
    freedom: float = 0.002
    along: float = 0.3
    dragged: float = 12.0
    turned: float = 1.5
    stretched: float = 3.0
    squashed: float = 2.0
    hung: float = 1.5
    uprooted: float = 1.5
    asked_uprooted: float = 4.0
    drift: float = 0.4
    tipped: float = 4.0
    extra: float = 3.0
    idle_specifier: float = 8.0
    amount: float = 0.003
    pivot: float = 2.5
    uneven: float = 2.0
    misaligned: Mapping[str, float] = field(
        default_factory=lambda: {
            "touching": 1.0,
            "siblings": 0.3,
            "ground": 0.5,
            "support": 3.0,
            "overhang": 1.5,
            "floor": 1.0,
        }
    )
    misaligned_most: float = 3.0
    asymmetric: float = 1.5
    asymmetric_most: float = 3.0
    off_canvas: float = 20.0
    collision: float = 2.0
