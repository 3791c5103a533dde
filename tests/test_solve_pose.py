"""Parameters of a motion as transforms, their derivatives, and the linear solver behind every step."""

from __future__ import annotations

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from engine_support import numeric_slope

from iconjax.solve.cache import precise_cpu
from iconjax.solve.linear import solve_positive
from iconjax.solve.pose import DOF, IDENTITY, Bodies, jacobians, matrices


def bodies(count=4, **changes):
    """Bodies with everything different from one to the next."""
    k = np.arange(count)
    plain = Bodies(
        centre=np.stack([20.0 + 30 * k, 90.0 - 17 * k], 1),
        axis=0.4 * k,
        radius=10.0 + 5 * k,
        free=np.ones((count, DOF)),
        uniform=np.zeros(count),
        inertia=np.ones((count, DOF)),
        sparsity=np.zeros((count, DOF)),
        start=np.zeros((count, DOF)),
    )
    return plain._replace(**changes)


@pytest.fixture(scope="module")
def pose():
    """Compiled `matrices` and `jacobians`, with NumPy in and out."""
    with precise_cpu():
        run = {f: jax.jit(f) for f in (matrices, jacobians)}

        def call(function, *args):
            return np.asarray(run[function](*args))

        yield call


def some_motion(seed=0, count=4):
    return np.random.default_rng(seed).normal(0, 6, (count, DOF))


def linear(row):
    return np.asarray(row).reshape(2, 3)[:, :2]


def test_nothing_is_the_exact_identity_whatever_the_frame(pose):
    found = pose(matrices, np.zeros((4, DOF)), bodies(axis=np.zeros(4)))
    assert np.array_equal(found, np.tile(IDENTITY, (4, 1)))
    assert np.allclose(pose(matrices, np.zeros((4, DOF)), bodies()), IDENTITY, atol=1e-12)


def test_the_first_two_parameters_shift_by_pixels(pose):
    z = np.zeros((4, DOF))
    z[:, :2] = [3.5, -8]
    found = pose(matrices, z, bodies()).reshape(4, 2, 3)
    assert np.allclose(found[:, :, 2], [3.5, -8]) and np.allclose(found[:, :, :2], np.eye(2))


def test_the_third_turns_clockwise_about_the_centre_by_pixels_at_the_rim(pose):
    about = bodies()
    z = np.zeros((4, DOF))
    z[:, 2] = about.radius * np.radians(90)
    for row, centre in zip(pose(matrices, z, about).reshape(4, 2, 3), about.centre, strict=True):
        assert np.allclose(row @ [*centre, 1], centre)
        right, below = centre + np.array([10, 0]), centre + np.array([0, 10])
        assert np.allclose(row @ [*right, 1], below)


def test_the_last_two_scale_along_and_across_the_own_axis(pose):
    about = bodies()
    z = np.zeros((4, DOF))
    z[:, 3], z[:, 4] = about.radius * np.log(2), about.radius * np.log(0.5)
    for row, centre, axis in zip(pose(matrices, z, about).reshape(4, 2, 3), about.centre, about.axis, strict=True):
        along, across = np.array([np.cos(axis), np.sin(axis)]), np.array([-np.sin(axis), np.cos(axis)])
        assert np.allclose(row @ [*centre, 1], centre)
        assert np.allclose(row[:, :2] @ along, 2 * along)
        assert np.allclose(row[:, :2] @ across, across / 2)


def test_a_motion_is_scaling_then_turning_then_shifting(pose):
    about, z = bodies(), some_motion()
    parts = [z * np.isin(np.arange(DOF), keep) for keep in ((3, 4), (2,), (0, 1))]
    whole = pose(matrices, z, about)
    scaled, turned, shifted = (pose(matrices, p, about) for p in parts)
    for k in range(4):
        one = np.eye(3)
        for step in (scaled, turned, shifted):
            one = np.vstack([step[k].reshape(2, 3), [0, 0, 1]]) @ one
        assert np.allclose(one[:2].reshape(-1), whole[k])


def test_uniform_bodies_scale_alike_in_all_directions(pose):
    z = some_motion()
    z[:, 2] = 0
    even = pose(matrices, z, bodies(uniform=np.array([1.0, 0, 1, 0])))
    for k, uniform in enumerate((True, False, True, False)):
        values = np.linalg.svd(linear(even[k]), compute_uv=False)
        assert (values[0] - values[1] < 1e-9) == uniform
    assert np.linalg.det(linear(even[0])) == pytest.approx(np.exp(2 * z[0, 3] / bodies().radius[0]))


def test_no_motion_mirrors(pose):
    found = pose(matrices, 20 * some_motion(1), bodies())
    assert all(np.linalg.det(linear(row)) > 0 for row in found)


@pytest.mark.parametrize("uniform", [0.0, 1.0])
def test_derivatives_agree_with_finite_differences(pose, uniform):
    about, z = bodies(uniform=np.full(4, uniform)), some_motion(2)
    slope = numeric_slope(lambda x: pose(matrices, x, about), z).reshape(4, 6, 4, DOF)
    exact = pose(jacobians, z, about)
    for k in range(4):
        assert np.allclose(slope[k, :, k], exact[k], atol=1e-6)
        assert not slope[k][:, [j for j in range(4) if j != k]].any()


def test_a_mask_zeroes_its_column_and_no_other(pose):
    z, free = some_motion(3), np.ones((4, DOF))
    free[1, 2] = free[3, 0] = 0
    masked, whole = pose(jacobians, z, bodies(free=free)), pose(jacobians, z, bodies())
    assert not masked[1, :, 2].any() and not masked[3, :, 0].any()
    assert whole[1, :, 2].any() and whole[3, :, 0].any()
    assert np.array_equal(masked, whole * free[:, None, :])


@pytest.mark.parametrize(("size", "block"), [(5, 5), (40, 5), (12, 3)])
def test_systems_are_solved_as_numpy_does(size, block):
    random = np.random.default_rng(size)
    root = random.normal(size=(6, size, size))
    matrix = root @ root.transpose(0, 2, 1) + 1e-2 * np.eye(size)
    right = random.normal(size=(6, size))
    with precise_cpu():
        found = jax.vmap(lambda m, r: solve_positive(m, r, block))(jnp.asarray(matrix), jnp.asarray(right))
    assert np.allclose(found, np.linalg.solve(matrix, right[..., None])[..., 0], rtol=1e-7, atol=1e-8)


def test_systems_with_entries_of_very_different_size_are_solved():
    random = np.random.default_rng(7)
    root = random.normal(size=(40, 12)) * 10.0 ** random.integers(-2, 3, (40, 1))
    matrix = root @ root.T + np.diag(10.0 ** random.integers(-2, 5, 40))
    right = random.normal(size=40)
    with precise_cpu():
        found = np.asarray(solve_positive(jnp.asarray(matrix), jnp.asarray(right), DOF))
    assert np.allclose(matrix @ found, right, atol=1e-6)
