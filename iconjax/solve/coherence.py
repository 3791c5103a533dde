"""Residuals of what keeps a picture coherent: joints, alignments, the canvas. With derivatives by the parameters."""

from __future__ import annotations

from typing import NamedTuple

import jax
import jax.numpy as jnp
from jaxtyping import Array, Float, Int

from iconjax.solve.arrays import Candidate, Problem
from iconjax.solve.program import move


class Rows(NamedTuple):
    """Soft residuals, each with the weight of its absolute value (its force in the loss).

    Attributes:
        value: (S,) residuals, px.
        slope: (S, K, 5) their derivatives.
        norm: (S,) length of the vector that each residual is a component of, px.
        weight: (S,) weights.
    """

    value: Float[Array, " S"]
    slope: Float[Array, "S K 5"]
    norm: Float[Array, " S"]
    weight: Float[Array, " S"]


def point_slope(points: Float[Array, "*n 2"], d: Float[Array, "*n 6 5"]) -> Float[Array, "*n 2 5"]:
    """Derivative of moved points by the parameters, from that of their transforms."""
    x, y = points[..., 0, None], points[..., 1, None]
    along_x = d[..., 0, :] * x + d[..., 1, :] * y + d[..., 2, :]
    along_y = d[..., 3, :] * x + d[..., 4, :] * y + d[..., 5, :]
    return jnp.stack([along_x, along_y], axis=-2)


def joint_rows(
    problem: Problem,
    cand: Candidate,
    z: Float[Array, "K 5"],
    segments: Float[Array, "N1 6"],
    d: Float[Array, "K 6 5"],
    pick: Float[Array, "N1 K"],
) -> Rows:
    """How far the meeting points of every relation have come apart.

    The gap between the two sides of a contact turns with them but keeps its width. Where the two may slide, only the
    part across the contact counts.
    """
    joints, bodies = problem.joints, cand.bodies
    turns = pick[:-1] @ (bodies.free[:, 2] * z[:, 2] / bodies.radius)
    lever = pick[:-1] * (bodies.free[:, 2] / bodies.radius)  # d turn / d z2
    turn = (turns[joints.a] + turns[joints.b]) / 2
    turn_slope = (lever[joints.a] + lever[joints.b]) / 2
    c, s = jnp.cos(turn)[:, None], jnp.sin(turn)[:, None]

    gap = joints.points_b - joints.points_a
    gx, gy = gap[..., 0], gap[..., 1]
    gap_now = jnp.stack([c * gx - s * gy, s * gx + c * gy], -1)
    gap_slope = jnp.stack([-s * gx - c * gy, c * gx - s * gy], -1)
    seg_a, seg_b = segments[joints.a][:, None, :], segments[joints.b][:, None, :]
    apart = move(joints.points_b, seg_b) - move(joints.points_a, seg_a) - gap_now  # E 3 2

    d_seg = jnp.einsum("nk,kmv->nkmv", pick[:-1], d)
    slope_a = point_slope(joints.points_a[:, :, None], d_seg[joints.a][:, None])  # E 3 K 2 5
    slope_b = point_slope(joints.points_b[:, :, None], d_seg[joints.b][:, None])
    slope = slope_b - slope_a
    turn_part = gap_slope[:, :, None, :] * turn_slope[:, None, :, None]  # E 3 K 2
    slope = slope.at[..., 2].add(-turn_part)

    tx, ty = joints.tangent[:, :1], joints.tangent[:, 1:]
    tangent = jnp.concatenate([c * tx - s * ty, s * tx + c * ty], -1)
    sliding = cand.slide[:, None, None] * tangent[:, :, None] * tangent[:, None, :]
    keep = jnp.eye(2) - sliding  # E 2 2
    normal = jnp.stack([-tangent[:, 1], tangent[:, 0]], -1)
    swing = tangent[:, :, None] * normal[:, None, :] + normal[:, :, None] * tangent[:, None, :]
    bent = jnp.einsum("eij,epj->epi", -cand.slide[:, None, None] * swing, apart)  # the contact turns with its sides
    apart = jnp.einsum("eij,epj->epi", keep, apart)
    slope = jnp.einsum("eij,epkjv->epikv", keep, slope)
    slope = slope.at[..., 2].add(bent[:, :, :, None] * turn_slope[:, None, None, :])
    norm = jnp.sqrt(jnp.sum(apart**2, -1, keepdims=True) + 1e-12)
    weight = jnp.stack([cand.hold, cand.ends, cand.ends], 1)[..., None]
    k = z.shape[0]
    return Rows(
        apart.reshape(-1),
        slope.reshape(-1, k, 5),
        jnp.broadcast_to(norm, apart.shape).reshape(-1),
        jnp.broadcast_to(weight, apart.shape).reshape(-1),
    )


def box_rows(
    problem: Problem,
    cand: Candidate,
    segments: Float[Array, "N1 6"],
    d: Float[Array, "K 6 5"],
    pick: Float[Array, "N1 K"],
) -> Rows:
    """Alignments that came apart, and how far boxes stick out of the picture further than before."""
    hull = move(problem.hull, segments[:-1, None, :])  # N H 2
    low, high = jnp.argmin(hull, 1), jnp.argmax(hull, 1)  # N 2
    witness = jnp.stack([low[:, 0], high[:, 0], low[:, 1], high[:, 1]], 1)  # N 4: min x, max x, min y, max y
    axis = jnp.array([0, 0, 1, 1])
    value = jnp.take_along_axis(hull[..., axis], witness[:, None, :], 1)[:, 0]  # N 4
    at = jnp.take_along_axis(problem.hull[:, :, None, :], witness[:, None, :, None], 1)[:, 0]  # N 4 2
    d_seg = jnp.einsum("nk,kmv->nkmv", pick[:-1], d)
    slope = point_slope(at[:, :, None], d_seg[:, None])  # N 4 K 2 5
    slope = jnp.where(axis[:, None, None] == 0, slope[..., 0, :], slope[..., 1, :])  # N 4 K 5

    start = problem.hull
    before = jnp.stack([start[..., 0].min(1), start[..., 0].max(1), start[..., 1].min(1), start[..., 1].max(1)], 1)
    mixing = jnp.array([[1.0, 0, 0, 0], [0.5, 0.5, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0.5, 0.5], [0, 0, 0, 1]])
    rows = problem.alignments
    mix = mixing[rows.feature]  # F 4
    values = jnp.concatenate([value, jnp.zeros((1, 4))])
    slopes = jnp.concatenate([slope, jnp.zeros((1, *slope.shape[1:]))])
    off = jnp.einsum("fj,fj->f", mix, values[rows.a] - values[rows.b]) - rows.offset
    beyond = jnp.abs(off) > rows.slack
    off = jnp.where(beyond, off - jnp.sign(off) * rows.slack, 0.0)
    off_slope = beyond[:, None, None] * jnp.einsum("fj,fjkv->fkv", mix, slopes[rows.a] - slopes[rows.b])

    sign = jnp.array([-1.0, 1.0, -1.0, 1.0])
    bound = jnp.maximum(sign * problem.canvas, sign * before)  # never worse than it was
    out = sign * value - bound
    over = jnp.maximum(out, 0.0)
    over_slope = jnp.where((out > 0)[..., None, None], sign[:, None, None] * slope, 0.0)
    k = d.shape[0]
    value_rows = jnp.concatenate([off, over.reshape(-1)])
    return Rows(
        value_rows,
        jnp.concatenate([off_slope, over_slope.reshape(-1, k, 5)]),
        jnp.abs(value_rows),
        jnp.concatenate([cand.align, jnp.full(over.size, 1.0) * cand.canvas]),
    )


def one_hot_bodies(body: Int[Array, " N"], count: int) -> Float[Array, "N1 K"]:
    """Which body carries each segment, one row a segment; the last row is the segment that never moves."""
    return jax.nn.one_hot(jnp.append(body, count), count)
