"""Every type of check on shapes with known geometry, passing and failing."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from evaluation_support import scale, shift, stage, turn

from iconjax.errors import InputError
from iconjax.evaluation.checks import run_check
from iconjax.evaluation.kinds import KINDS

MIRROR = scale(-1, 1, (150, 120))
BAR, BLOCK = (150, 120), (230, 120)
TURNS = {1: turn(30), 2: turn(27, BLOCK)}
HINGED = {1: turn(40, (200, 120)), 2: shift(0, 5)}
WIDTH = {"attr": "width", "of": "Thing:Bar"}


HALF_AND_30 = {**WIDTH, "old": True, "scale": 0.5, "offset": 30}


def check(t: str, **fields: Any) -> dict[str, Any]:
    return {"t": t, **fields}


def then(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    return second @ np.vstack([first, [0, 0, 1]])


# (check, an edit that passes, an edit that fails)
EXAMPLES = [
    (check("ratio", of="Thing:Bar", attr="width", value=0.5), {1: scale(0.5, 1)}, {1: scale(0.6, 1)}),
    (check("ratio", of="Thing", attr="width", value=0.5), {1: scale(0.2, 1, (200, 0))}, {}),
    (check("ratio", of="Thing:Bar", attr="area", value=0.25), {1: scale(0.5, 0.5)}, {1: scale(0.5, 1)}),
    (check("ratio", of="Thing:Bar", attr="long", value=1), {1: turn(37, BAR)}, {1: scale(0.9, 1, BAR)}),
    (check("ratio", of="Post", attr="long", value=2), {3: then(scale(1, 2), turn(50))}, {3: scale(2, 1)}),
    (check("ratio", of="Post", attr="short", value=2), {3: scale(2, 1)}, {3: scale(1, 2)}),
    (check("compare", left=WIDTH, op="==", right=100), {}, {1: scale(1.2, 1)}),
    (check("compare", left=WIDTH, op="<=", right=90, tol=0), {1: scale(0.8, 1)}, {}),
    (check("compare", left=WIDTH, op=">=", right=90, tol=0), {}, {1: scale(0.8, 1)}),
    (check("compare", left=WIDTH, op="==", right=HALF_AND_30), {1: scale(0.8, 1)}, {}),
    (check("compare", left={"attr": "cy", "of": "Post"}, op="==", right=370), {}, {3: shift(0, 9)}),
    (check("rotation", of="Thing", deg=30, sign="cw"), TURNS, {1: turn(30), 2: turn(-30)}),
    (check("rotation", of="Post", deg=30, sign="ccw"), {3: turn(-30)}, {3: turn(30)}),
    (check("rotation", of="Post", deg=30), {3: turn(-30)}, {3: turn(36)}),
    (check("rotation", of="Post", deg=180), {3: turn(-178)}, {3: scale(-1, 1)}),
    (check("touch", a="Thing:Bar", b="Thing:Block"), {1: shift(5, 0)}, {1: shift(-8, 0)}),
    (check("touch", a="Thing:Bar", b="Thing:Block"), {}, {1: shift(20, 0)}),
    (check("connected", a="Thing:Bar", b="Thing:Block"), {1: shift(60, 0)}, {1: shift(-8, 0)}),
    (check("overlap", a="Thing:Bar", b="Thing:Block"), {1: shift(10, 0)}, {}),
    (check("detached", a="Thing:Bar", b="Thing:Block"), {1: shift(-2, 0)}, {}),
    (check("inside", a="Pane", b="Thing:Bar"), {4: shift(-20, 0)}, {4: shift(-25, 0)}),
    (check("above", a="Thing", b="Post"), {3: shift(0, -160)}, {3: shift(0, -170)}),
    (check("below", a="Post", b="Thing", tol=-150), {}, {3: shift(0, -20)}),
    (check("left_of", a="Thing:Bar", b="Thing:Block"), {1: shift(6, 0)}, {1: shift(8, 0)}),
    (check("right_of", a="Thing:Block", b="Thing:Bar", tol=0), {}, {2: shift(-1, 0)}),
    (check("left_of", a="Pane", b="Thing:Bar", centre=True, tol=0), {}, {4: shift(30, 0)}),
    (check("dist", a="Thing", b="Post", kind="min", value=np.hypot(40, 160)), {}, {3: shift(0, 10)}),
    (check("dist", a="Thing:Bar", b="Post", kind="cx", value=170), {3: shift(0, 50)}, {3: shift(9, 0)}),
    (check("dist", a="Thing:Bar", b="Post", kind="cy", value=250), {3: shift(50, 0)}, {3: shift(0, 9)}),
    (check("dist", a="Thing:Bar", b="Post", kind="center", value=np.hypot(170, 250)), {}, {3: shift(9, 9)}),
    (check("dist", a="Pane", b="Thing:Block", kind="cx", value=WIDTH), {}, {4: shift(-10, 0)}),
    (check("moved", of="Post", dx=[10, 20]), {3: shift(15, 90)}, {}),
    (check("moved", of="Post", dx=[10, 20], dy=[-5, 5]), {3: shift(15, 0)}, {3: shift(15, 9)}),
    (check("same", of="Thing"), {2: shift(4, 4)}, {2: shift(5, 5)}),
    (check("rigid", of="Thing"), {1: shift(90, 9), 2: turn(4)}, {1: turn(6)}),
    (check("rigid", of="Post", may_rotate=True), {3: turn(90)}, {3: scale(1.1, 1)}),
    (check("rigid", of="Thing:Bar", may_rotate=True), {}, {1: MIRROR}),
    (check("upright", of="Post"), {3: scale(3, 0.5)}, {3: turn(6)}),
    (check("upright", of="Thing:Bar"), {}, {1: MIRROR}),
    (check("uniform", of="Post"), {3: then(scale(2, 2), turn(20))}, {3: scale(2, 2.2)}),
    (check("uniform", of="Thing:Bar"), {}, {1: MIRROR}),
    (check("canvas", of="Thing"), {1: shift(-100, 0)}, {1: shift(-110, 0)}),
    (check("joint", a="Thing:Bar", b="Thing:Block"), HINGED, {1: shift(0, 13)}),
    (check("joint", a="Pane", b="Thing"), {4: shift(9, 0), 2: shift(90, 0)}, {1: shift(13, 0)}),
    (check("joint", a="Thing:Bar", b="Post"), {1: shift(50, 0), 3: shift(50, 0)}, {3: shift(13, 0)}),
]  # fmt: skip


@pytest.mark.parametrize(("fields", "good", "bad"), EXAMPLES)
def test_check(fields: dict[str, Any], good: dict[int, np.ndarray], bad: dict[int, np.ndarray]) -> None:
    passing, failing = run_check(stage(good), fields), run_check(stage(bad), fields)
    assert passing.passed, str(passing)
    assert not failing.passed, str(failing)
    assert failing.kind == fields["t"] and "\n" not in str(failing)


def test_every_type_has_an_example() -> None:
    assert {fields["t"] for fields, _, _ in EXAMPLES} == set(KINDS)


@pytest.mark.parametrize("unit", [0.5, 3.0])
@pytest.mark.parametrize(("fields", "good", "bad"), EXAMPLES)
def test_pixel_numbers_follow_the_size_of_the_picture(
    unit: float, fields: dict[str, Any], good: dict[int, np.ndarray], bad: dict[int, np.ndarray]
) -> None:
    assert run_check(stage(good, unit), fields).passed
    assert not run_check(stage(bad, unit), fields).passed


def test_a_list_counts_as_one_thing() -> None:
    fields = check("compare", left={"attr": "maxx", "of": ["Thing:Bar", "Post"]}, op="==", right=340, tol=0.1)
    assert run_check(stage(), fields).passed


@pytest.mark.parametrize(
    ("fields", "message"),
    [
        (check("wobble", of="Post"), "unknown check type 'wobble'"),
        (check("same", of="Nobody"), "unknown name 'Nobody'"),
        (check("same", of="Post", tolerance=3), "tolerance"),
        (check("touch", a="Post"), "missing"),
        (check("ratio", of="Post", attr="girth", value=1), "unknown attribute 'girth'"),
        (check("compare", left=1, op="!=", right=2), "op is '!='"),
        (check("compare", left={"attr": "width"}, op="==", right=2), "a side is a number"),
        (check("rotation", of="Post", deg=3, sign="left"), "sign is 'left'"),
        (check("dist", a="Post", b="Thing", kind="max", value=3), "kind is 'max'"),
        (check("moved", of="Post"), "give dx"),
    ],
)
def test_a_check_that_cannot_be_read_is_an_error(fields: dict[str, Any], message: str) -> None:
    with pytest.raises(InputError, match=message):
        run_check(stage(), fields)


@pytest.mark.parametrize("flat", [scale(0, 1, BAR), scale(0, 0, BAR), scale(1e-9, 1, BAR)])
@pytest.mark.parametrize("fields", [fields for fields, _, _ in EXAMPLES])
def test_a_flattened_segment_breaks_nothing(flat: np.ndarray, fields: dict[str, Any]) -> None:
    run_check(stage({1: flat}), fields)
