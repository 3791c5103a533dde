"""Small pictures made of rectangles and discs, and short ways into the solver and the search."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from iconjax.dsl.parse import parse
from iconjax.relations.detect import detect_relations
from iconjax.scene.build import build_scene
from iconjax.search.api import search_edit
from iconjax.search.candidate import build_candidate
from iconjax.search.config import SearchConfig
from iconjax.search.intent import read_intent
from iconjax.search.setup import prepare
from iconjax.search.state import State

SIZE = 128
STILL = np.eye(2, 3)


def rect(x0, y0, x1, y1):
    """The pixels from column x0 to x1 and row y0 to y1, both ends excluded at the far side."""
    return lambda x, y: (x > x0) & (x < x1) & (y > y0) & (y < y1)


def disc(x0, y0, radius):
    """The pixels whose centres lie in a disc."""
    return lambda x, y: (x - x0) ** 2 + (y - y0) ** 2 < radius**2


def picture(shapes, size=SIZE):
    """A scene from `{name: shape or [shapes]}`; later shapes cover earlier ones."""
    y, x = np.mgrid[:size, :size] + 0.5
    mask = np.zeros((size, size), np.uint8)
    for k, shape in enumerate(shapes.values(), start=1):
        for part in shape if isinstance(shape, list) else [shape]:
            mask[part(x, y)] = k
    grey = np.where(mask, 40 + 10 * mask, 255).astype(np.uint8)
    return build_scene(np.repeat(grey[:, :, None], 3, 2), mask, dict(enumerate(shapes, start=1)))


def program(scene, text):
    """A checked program about `scene`."""
    return parse(text, scene.names, scene.objects)


def intent(scene, text):
    """What a program asks."""
    return read_intent(program(scene, text), scene)


def relations(scene):
    """Relations by the names of the two, ordered as detected."""
    found = detect_relations(scene)
    return {(scene.names[r.a], scene.names[r.b]): r for r in found}


class Bench:
    """One scene and program, ready to solve chosen states with the default solver."""

    def __init__(self, scene, text):
        self.scene = scene
        self.setup = prepare(scene, program(scene, text), SearchConfig())
        self.engine = self.setup.engine("irls")
        self.used = len(self.setup.compiled.owner)

    def candidate(self, **modes):
        """A candidate; modes by the last word of a segment's name, all others stay."""
        short = [name.split(":")[-1] for name in self.scene.names]
        assert set(modes) <= set(short)
        state = State(tuple(modes.get(name, "N") for name in short))
        return build_candidate(self.setup.setting, state, self.setup.sizes)

    def solve(self, *candidates):
        """All candidates in one batch; residuals cut down to those in use."""
        solution = self.engine.solve(candidates)
        return solution._replace(primary=solution.primary[:, : self.used])

    def matrix(self, solution, name, which=0):
        """The transform of a segment, (2, 3)."""
        at = [n.split(":")[-1] for n in self.scene.names].index(name)
        return solution.matrices[which, at].reshape(2, 3)


def unjoined(candidate):
    """The same candidate with no relation, alignment or canvas to hold anything."""
    none = {f: np.zeros_like(getattr(candidate, f)) for f in ("hold", "ends", "slide", "align", "canvas")}
    return candidate._replace(**none)


def with_bodies(candidate, **changes):
    """The same candidate with some arrays of its bodies replaced."""
    return candidate._replace(bodies=candidate.bodies._replace(**changes))


def searched(scene, text, **settings):
    """The outcome of the default search."""
    return search_edit(scene, program(scene, text), replace(SearchConfig(), **settings))


def transforms(scene, outcome):
    """Transforms by the last word of each segment's name."""
    return {name.split(":")[-1]: m for name, m in zip(scene.names, outcome.matrices, strict=True)}


def met(outcome):
    """Whether every primary constraint holds."""
    return all(c.satisfied for c in outcome.constraints)


def moved_box(scene, outcome, name):
    """The box of a segment after the edit."""
    at = [n.split(":")[-1] for n in scene.names].index(name)
    loops = np.concatenate(scene.segments[at].loops)
    m = outcome.matrices[at]
    points = loops @ m[:, :2].T + m[:, 2]
    return np.concatenate([points.min(0), points.max(0)])


def numeric_slope(function, x, step=1e-5):
    """Central differences of a vector function, by the entries of `x` in order: (outputs, x.size)."""
    columns = []
    for k in range(x.size):
        delta = np.zeros(x.size)
        delta[k] = step
        delta = delta.reshape(x.shape)
        up, down = np.asarray(function(x + delta)), np.asarray(function(x - delta))
        columns.append((up - down).reshape(-1) / (2 * step))
    return np.stack(columns, 1)
