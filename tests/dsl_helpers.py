"""Shapes with known geometry, as regions in any pose, and one jitted function per operator."""

from __future__ import annotations

import functools

import jax
import numpy as np

from iconjax.dsl.region import Region
from iconjax.dsl.registry import default_registry
from iconjax.dsl.units import Unit

VERTICES = 48
QUICK = {
    "xla_backend_optimization_level": 0,
    "xla_llvm_disable_expensive_passes": True,
}  # compiling takes most time


def polygon(corners, count=VERTICES):
    """A closed loop of `count` vertices with all corners kept and the rest spread evenly over the sides."""
    corners = np.asarray(corners, float)
    sides = np.roll(corners, -1, axis=0) - corners
    lengths = np.hypot(*sides.T)
    shares = np.floor(lengths / lengths.sum() * (count - len(corners))).astype(int)
    shares[0] += count - len(corners) - shares.sum()
    loop = [c + s * k / (n + 1) for c, s, n in zip(corners, sides, shares, strict=True) for k in range(n + 1)]
    return np.array(loop)


def rectangle(x0, y0, x1, y1, count=VERTICES):
    """A rectangle's loop, with positive shoelace area."""
    return polygon([(x0, y0), (x1, y0), (x1, y1), (x0, y1)], count)


def disc(x, y, radius, count=VERTICES):
    """A regular polygon on a circle."""
    t = np.linspace(0, 2 * np.pi, count, endpoint=False)
    return np.stack([x + radius * np.cos(t), y + radius * np.sin(t)], axis=1)


def affine(turn=0.0, scale=(1.0, 1.0), shift=(0.0, 0.0), about=(0.0, 0.0)):
    """Scale, then turn clockwise by degrees, both about a point, then shift."""
    t = np.radians(turn)
    linear = np.array([[np.cos(t), -np.sin(t)], [np.sin(t), np.cos(t)]]) @ np.diag(scale)
    return np.column_stack([linear, np.asarray(about) - linear @ np.asarray(about) + np.asarray(shift)])


IDENTITY = affine()


def region(*loops, matrix=IDENTITY, long_dir=(1.0, 0.0), frame=(1.0, 0.0), padding=3):
    """A region made of loops, with some padding, before any edit or moved by a matrix."""
    points = np.concatenate([*loops, np.full((padding, 2), 1e4)])
    ends = np.concatenate([*(np.roll(loop, -1, axis=0) for loop in loops), np.full((padding, 2), 1e4)])
    real = np.arange(len(points)) < len(points) - padding
    length = np.where(real, np.hypot(*(ends - points).T) + 1e-9, 0)
    still = Region(points, points, real, points, ends, points, length / length.sum(), IDENTITY,
                   np.array(long_dir, float), np.array(frame, float))  # fmt: skip
    return moved(still, matrix)


def moved(still, matrix):
    """The region carried along by an affine transform (NumPy or JAX)."""
    go = lambda p: p @ matrix[:, :2].T + matrix[:, 2]  # noqa: E731
    return still._replace(hull=go(still.hull0), points=go(still.points0), ends=go(still.ends), matrix=matrix)


def joined(*regions):
    """The union of regions, as the compiler makes it: all material, the mean transform."""
    stack = {f: np.concatenate([np.asarray(getattr(r, f)) for r in regions]) for f in Region._fields[:7]}
    stack["weight"] = stack["weight"] / len(regions)
    return Region(**stack, matrix=np.mean([r.matrix for r in regions], axis=0),
                  long_dir0=regions[0].long_dir0, frame0=regions[0].frame0)  # fmt: skip


@functools.cache
def jitted(name, role="value", unit=None):
    """The function of an operator (or its residual), compiled once per shape for all tests."""
    registry = default_registry()
    look_up = registry.function if role == "value" else registry.residual
    return jax.jit(look_up(name, Unit(unit) if unit else None), compiler_options=QUICK)


def value(name, *args, unit=None):
    """An operator's value as a float."""
    return float(jitted(name, unit=unit)(*args))


def residual(name, *args, unit=None):
    """A specifier's residual as a NumPy array."""
    return np.asarray(jitted(name, "residual", unit)(*args))
