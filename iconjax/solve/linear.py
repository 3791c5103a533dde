"""Solving small symmetric positive definite systems in plain JAX.

LAPACK's batched factorisations wait inside XLA's own thread pool; two executables that run at once, as ours do, can
then wait for each other for ever. Block elimination needs no call out of XLA, and batches well.
"""

from __future__ import annotations

import jax
import jax.numpy as jnp
from jaxtyping import Array, Float


def _inverse(block: Float[Array, "b b"]) -> Float[Array, "b b"]:
    """Inverse of a small positive definite matrix, by elimination without pivoting, unrolled."""
    size = block.shape[0]
    work = jnp.concatenate([block, jnp.eye(size, dtype=block.dtype)], 1)
    for k in range(size):
        row = work[k] / work[k, k]
        work = work - work[:, k : k + 1] * row[None, :]
        work = work.at[k].set(row)
    return work[:, size:]


def solve_positive(matrix: Float[Array, "v v"], right: Float[Array, " v"], block: int) -> Float[Array, " v"]:
    """Solution x of `matrix @ x = right`, eliminating `block` unknowns at a time; `block` divides v."""
    size = matrix.shape[0]
    work = jnp.concatenate([matrix, right[:, None]], 1)

    def eliminate(k, work):  # type: ignore[no-untyped-def]
        at = k * block
        rows = jax.lax.dynamic_slice(work, (at, 0), (block, size + 1))
        pivot = jax.lax.dynamic_slice(rows, (0, at), (block, block))
        scaled = _inverse(pivot) @ rows
        columns = jax.lax.dynamic_slice(work, (0, at), (size, block))
        work = work - columns @ scaled
        return jax.lax.dynamic_update_slice(work, scaled, (at, 0))

    solved: Array = jax.lax.fori_loop(0, size // block, eliminate, work)
    return solved[:, -1]
