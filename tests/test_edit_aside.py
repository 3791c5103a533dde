"""The lines that tell what an edit did besides what was asked, and what it had to assume."""

from __future__ import annotations

import numpy as np
import pytest

from iconjax import Segmentation, edit
from iconjax.edit.aside import LONGEST, also_moved, asides, assumptions
from iconjax.scene.build import build_scene


def tower() -> tuple[np.ndarray, Segmentation]:
    """A stool under a box with a lid on it, and a ball that touches nothing."""
    mask = np.zeros((96, 96), np.int32)
    mask[60:80, 20:60], mask[40:60, 25:55], mask[34:40, 25:55], mask[10:20, 70:80] = 1, 2, 3, 4
    colours = np.array([[255] * 3, [150, 90, 40], [30, 90, 200], [20, 160, 80], [200, 40, 40]], np.uint8)
    return colours[mask], Segmentation(mask, {1: "Stool", 2: "Box:Body", 3: "Box:Lid", 4: "Ball"})


def test_what_moves_along_without_being_named_is_told():
    image, seg = tower()
    result = edit(image, seg, program=['translate("Box:Body")',
        'equal(minus(center_x("Box:Body"), center_x(old("Box:Body"))), 12)'])  # fmt: skip
    lid_moved = not np.allclose(result.transforms[3], np.eye(2, 3))
    assert lid_moved, "the lid is attached to the box"
    assert "Box:Lid" in also_moved(result)
    assert not {"Box:Body", "Ball"} & set(also_moved(result))
    assert asides(result)[0].startswith("also moved: ")


def test_nothing_is_told_where_only_what_was_named_moved():
    image, seg = tower()
    result = edit(image, seg, "Move the ball 12 px down", translator="offline")
    assert asides(result) == []


def test_what_moved_which_amount_was_chosen_and_what_was_respelt_are_a_line_each():
    image, seg = tower()
    result = edit(image, seg, "Move the stoool down a little", translator="offline")
    moved, amount, spelling = asides(result)
    assert moved == "also moved: Box:Body, Box:Lid"
    assert amount.startswith("no amount was named, so one was chosen: Stool moved ")
    assert amount.endswith("px down")
    assert spelling == 'note: "stoool" read as "stool"'


@pytest.mark.parametrize("count", [1, 40])
def test_many_remarks_are_two_short_lines(count):
    scene = build_scene(*tower())
    lines = ["Ball: moves up some way (the request names no amount; this one was chosen)", "Box: stays"]
    remarks = [f'left aside: "clause {k}"' for k in range(count)]
    guesses, notes = assumptions([*lines * count, *remarks], scene)
    assert set(guesses) == {"Ball: moves up some way"} and notes == remarks
    image, seg = tower()
    result = edit(image, seg, "Move the ball 12 px down", translator="offline")
    object.__setattr__(result, "understood", (*lines * count, *remarks))
    told = asides(result)
    assert len(told) == 2 and all(len(line) <= LONGEST for line in told)
