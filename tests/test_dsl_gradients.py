"""Gradients: they agree with finite differences, stay finite at degenerate input, and pull at a distance."""

from __future__ import annotations

import functools
import operator

import dsl_helpers as shapes
import jax
import jax.numpy as jnp
import numpy as np
import pytest
from dsl_helpers import affine, disc, rectangle, region

from iconjax.dsl.registry import default_registry

REGISTRY = default_registry()
FUNCTIONS = [o.name for o in REGISTRY.operators.values() if o.has_function and o.group not in ("arithmetic", "value")]
ANCHORS = np.array([110.0, 105.0, 180.0, 140.0])

# Tips that point at each other and a far-off base: every minimum and maximum is attained at one point only.
KITE = region(shapes.polygon([(100, 80), (175, 113), (90, 150), (40, 100)]), long_dir=(0.96, 0.28), frame=(0.8, 0.6))
TENT = region(shapes.polygon([(190, 120), (320, 90), (290, 230)]), long_dir=(-0.6, 0.8), frame=(0.6, -0.8))
BAR = region(rectangle(100, 100, 180, 120))


def on_matrices(name, role, s, t):
    """An operator as a function of the two transforms stacked, (2, 2, 3) -> scalar (a vector is summed)."""
    declared = REGISTRY.operators[name]
    function = (REGISTRY.function if role == "value" else REGISTRY.residual)(name)
    count = sum(p.type == "Segment" for p in declared.params)

    def call(matrices):
        regions = [shapes.moved(s, matrices[0]), shapes.moved(t, matrices[1])]
        if name == "together":
            regions = [shapes_joined(*regions)]
        result = function(*regions[:count], *([ANCHORS] if declared.extra else []))
        if name == "inter":
            return jnp.sum(result.weight[:, None] * result.points)
        return jnp.sum(result)

    return call


def shapes_joined(*regions):
    """`joined`, for traced regions."""
    stack = {f: jnp.concatenate([getattr(r, f) for r in regions]) for f in regions[0]._fields[:7]}
    mean = jnp.mean(jnp.stack([r.matrix for r in regions]), axis=0)
    return regions[0]._replace(**stack, matrix=mean)


BATCH = 28


@functools.cache
def compiled(name, role):
    """Value and gradient in the transforms for a batch of (S, T, matrices), compiled once for all tests."""
    function = jax.vmap(lambda s, t, m: jax.value_and_grad(on_matrices(name, role, s, t))(m))
    return jax.jit(function, compiler_options=shapes.QUICK)


def evaluate(name, cases, role="value"):
    """Values (n,) and gradients (n, 2, 2, 3) of cases (S, T, matrices), in double precision."""
    cases = [*cases, *[cases[-1]] * (-len(cases) % BATCH)]
    with jax.enable_x64(True):
        batch = jax.tree.map(lambda *leaves: np.stack(leaves), *cases)
        results = [
            compiled(name, role)(*jax.tree.map(operator.itemgetter(slice(i, i + BATCH)), batch))
            for i in range(0, len(cases), BATCH)
        ]
        return tuple(np.concatenate([np.asarray(r[k]) for r in results]) for k in (0, 1))


POSES = {
    "as drawn": (affine(2, (1.01, 1)), affine(-1, (1, 0.98))),
    "moved": (affine(20, (1.2, 0.8), (-14, 6), (100, 110)), affine(-15, (0.9, 1.3), (9, 4), (250, 130))),
    "crossing": (affine(5, (1.1, 0.9), (48, 11), (100, 110)), affine(3, (1.0, 1.1), (-7, 2), (250, 130))),
    "mirrored": (affine(10, (-1.1, 0.9), (2, 3), (100, 110)), affine(-25, (1.0, 1.2), (-30, 5), (250, 130))),
}  # fmt: skip


@pytest.mark.parametrize("name", FUNCTIONS)
def test_gradients_agree_with_finite_differences(name):
    if name == "inter":
        pytest.skip("the share of each vertex jumps where it enters the other outline")
    centres = np.array([np.stack(p) for p in POSES.values()])
    steps = 1e-5 * np.concatenate([np.eye(12), -np.eye(12)]).reshape(24, 2, 2, 3)
    batch = np.concatenate([centres, (centres[:, None] + steps).reshape(-1, 2, 2, 3)])
    values, gradients = evaluate(name, [(KITE, TENT, m) for m in batch])
    n = len(centres)
    there = values[n : 25 * n].reshape(n, 2, 12)
    expected = (there[:, 0] - there[:, 1]) / 2e-5
    # Points within a quarter of a pixel of the nearest share its gradient, hence the tolerance.
    off = np.abs(gradients[:n].reshape(n, 12) - expected).max(axis=1)
    for label, value, error, largest in zip(POSES, values, off, np.abs(expected).max(axis=1), strict=False):
        constant = name == "min_dist" and value == 0  # outlines that cross; the gradient takes them apart
        assert constant or error <= 5e-2 * largest + 1e-4, label


POINT = region(np.full((shapes.VERTICES, 2), 150.0))
ZERO = np.zeros((2, 3))
DEGENERATE = {
    "identity": (affine(), affine()),
    "everything on one point": (ZERO, ZERO),
    "one without size": (affine(), affine(scale=(0, 0), shift=(120, 110))),
    "flattened": (affine(scale=(1, 0)), affine(scale=(0, 1))),
    "far away": (affine(shift=(1e4, -1e4)), affine(shift=(-1e4, 0))),
    "half a turn": (affine(180), affine()),
    "mirrored exactly": (affine(scale=(-1, 1)), affine(scale=(1, -1))),
}


ROLES = [(name, "value") for name in FUNCTIONS] + [
    (o.name, "residual")
    for o in REGISTRY.operators.values()
    if o.name in FUNCTIONS and o.is_specifier and REGISTRY.residual(o.name) is not REGISTRY.function(o.name)
]


@pytest.mark.parametrize(("name", "role"), ROLES)
def test_finite_at_degenerate_input(name, role):
    shapes_of = [(KITE, TENT), (KITE, KITE), (BAR, POINT), (POINT, POINT)]
    cases = [(s, t, np.stack(m)) for s, t in shapes_of for m in DEGENERATE.values()]
    values, gradients = evaluate(name, cases, role)
    labels = [label for _ in shapes_of for label in DEGENERATE]
    for label, result, gradient in zip(labels, values, gradients, strict=True):
        assert np.all(np.isfinite(result)), label
        assert np.all(np.isfinite(gradient)), label
        assert np.abs(result) < 1e6, label


@pytest.mark.parametrize("name", ["plus", "minus", "mul", "div", "min", "max", "equal", "smaller", "larger"])
def test_values_are_finite_at_zero(name):
    for role in ("value", "residual") if name in ("equal", "smaller", "larger") else ("value",):
        function = (REGISTRY.function if role == "value" else REGISTRY.residual)(name)
        for a, b in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (-5.0, 1e-9), (500.0, -1e-9)]:
            assert np.all(np.isfinite([function(a, b), *jax.grad(function, argnums=(0, 1))(a, b)]))


def gradient(name, matrices, role="value", s=KITE, t=TENT):
    return evaluate(name, [(s, t, np.stack(matrices))], role)[1][0]


def test_angle_to_the_old_pose_can_leave_zero():
    """At zero the unsigned angle has a kink; its gradient turns the segment clockwise all the same."""
    slope = gradient("angle", (affine(), affine()), s=BAR, t=BAR)[0]
    assert slope[1, 0] > 0.5


@pytest.mark.parametrize("name", ["touch", "overlap", "inside", "contain", "min_dist", "avg_dist", "max_dist"])
def test_there_is_pull_from_far_away(name):
    far = gradient(name, (affine(shift=(-2000, 0)), affine()))
    assert far[0, 0, 2] < -0.5
    assert far[1, 0, 2] > 0.5


def test_touch_has_a_slope_at_contact():
    """Two boxes that exactly meet: the residual is 0 and moving apart still changes it by the distance."""
    left, right = region(rectangle(100, 100, 150, 150)), region(rectangle(150, 100, 200, 150))
    slope = gradient("touch", (affine(), affine()), "residual", left, right)
    assert slope[0, 0, 2] == pytest.approx(-1, abs=0.2)
    assert slope[1, 0, 2] == pytest.approx(1, abs=0.2)
    assert slope[0, 1, 2] == pytest.approx(0, abs=0.2)


def test_a_flat_side_is_not_turned_by_its_corner():
    """A box above a table of the same width: all its lower side is nearest, and the pull has no moment."""
    box, table = region(rectangle(-50, 0, 50, 50)), region(rectangle(-60, 80, 60, 90))
    slope = gradient("touch", (affine(), affine()), "residual", box, table)
    assert slope[0, 1, 2] == pytest.approx(-1, abs=1e-3)
    assert slope[0, 1, 0] == pytest.approx(0, abs=1.0)


def test_outlines_that_cross_are_taken_apart():
    slope = gradient("min_dist", (affine(shift=(40, 0)), affine()))
    assert slope[0, 0, 2] < -0.1


def test_float32_and_float64_agree_and_keep_their_type():
    s = region(disc(100, 100, 40))
    exact = evaluate("touch", [(s, TENT, np.stack((affine(), affine())))], "residual")[0][0]
    for dtype in (np.float32, np.float64):
        narrow = jax.tree.map(functools.partial(np.asarray, dtype=dtype), (s, TENT))
        with jax.enable_x64(dtype is np.float64):
            clearance = jax.jit(REGISTRY.residual("touch"))(*narrow)
        assert clearance.dtype == dtype
        assert float(clearance) == pytest.approx(exact, rel=1e-4)
