"""A picture of three rectangles, and a table of the few operators its programs use, which compiles in moments."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial

import numpy as np
import pytest
from edit_support import LABELS, small_picture

from iconjax.dsl.parse import parse
from iconjax.scene.build import build_scene
from iconjax.scene.types import Scene, Segmentation
from iconjax.search.config import SearchConfig
from iconjax.search.setup import Setup, prepare
from iconjax.solve.table import OperatorTable, operator_table

MEASURES = {"hori_len", "center_x"}
STEPS = {"equal", "plus", "mul"}
QUICK = {"xla_backend_optimization_level": 0, "xla_llvm_disable_expensive_passes": True}
"""Compiling takes most of the time."""

NARROWER = (
    'scale("Lamp:Shade")',
    'equal(hori_len("Lamp:Shade"), mul(0.5, hori_len(old("Lamp:Shade"))))',
    'equal(center_x("Lamp:Shade"), plus(center_x(old("Lamp:Shade")), 6))',
)
"""Half as wide and 6 px further to the right."""
APART = (
    'translate("Lamp:Shade")',
    'equal(center_x("Lamp:Shade"), plus(center_x(old("Lamp:Shade")), 16))',
    'stay("Lamp:Foot")',
)
"""The shade leaves the middle of the foot: they stay connected, but not at the place where they were."""


def picture() -> Scene:
    """A lamp's shade and foot, and a table, 96 x 96."""
    image, mask = small_picture()
    return build_scene(image, Segmentation(mask, LABELS))


def few_operators(registry, used=frozenset(), measures=frozenset(MEASURES)) -> OperatorTable:
    """The registry's table with only `measures` and `STEPS`; other operators cannot be used."""
    whole = operator_table(registry)

    def kept(keys, names):
        return [k for k, key in enumerate(keys) if key.split("#")[0] in names and "@" not in key]

    leaves, steps = kept(whole.leaf_keys, measures), kept(whole.step_keys, STEPS)
    return whole._replace(
        leaf_keys=tuple(whole.leaf_keys[k] for k in leaves),
        leaf_kinds=tuple(whole.leaf_kinds[k] for k in leaves),
        leaf_functions=tuple(whole.leaf_functions[k] for k in leaves),
        step_keys=tuple(whole.step_keys[k] for k in steps),
        step_functions=tuple(whole.step_functions[k] for k in steps),
        digest=hashlib.sha256(f"{sorted(measures)} of {whole.digest}".encode()).hexdigest()[:16],
    )


@contextmanager
def quick_compiles() -> Iterator[None]:
    """Programs are compiled with `few_operators`, and nothing is read from or written to the user's cache."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ICONJAX_CACHE", "")
        patch.setattr("iconjax.solve.cache.OPTIONS", QUICK)
        patch.setattr("iconjax.solve.regions.OUTLINE_POINTS", 16)  # enough for rectangles
        patch.setattr("iconjax.solve.regions.HULL_POINTS", 16)
        patch.setattr("iconjax.search.setup.operator_table", few_operators)
        relating = partial(few_operators, measures=frozenset(MEASURES | {"overlap"}))
        patch.setattr("iconjax.search.paper_program.operator_table", relating)
        yield


def prepared(program=NARROWER, **settings) -> Setup:
    """The picture with a program, ready to be searched."""
    scene = picture()
    return prepare(scene, parse(program, scene.names, scene.objects), SearchConfig(**settings))


def box_of(scene: Scene, matrices, name: str):
    """Box of a segment after the edit: min x, min y, max x, max y."""
    k = scene.names.index(name)
    points = np.concatenate(scene.segments[k].loops) @ matrices[k][:, :2].T + matrices[k][:, 2]
    return *points.min(0), *points.max(0)
