"""Motions told in words."""

from __future__ import annotations

import math

import numpy as np
import pytest

from iconjax.edit.explain import describe_motion


def about(linear, centre=(50.0, 20.0), shift=(0.0, 0.0)):
    """The 2x3 matrix of a linear map about a centre."""
    linear, centre = np.array(linear, float), np.array(centre)
    return np.column_stack([linear, centre - linear @ centre + shift])


def turn(degrees):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return [[c, -s], [s, c]]


@pytest.mark.parametrize(
    ("matrix", "words"),
    [
        (np.eye(2, 3), ""),
        (about(np.eye(2), shift=(8, 0)), "moved 8.0 px right"),
        (about(np.eye(2), shift=(-3.25, -4)), "moved 3.2 px left and 4.0 px up"),
        (about(turn(20)), "turned 20.0 deg clockwise"),
        (about(turn(-90)), "turned 90.0 deg counter-clockwise"),
        (about([[0.5, 0], [0, 0.5]]), "scaled to 50.0%"),
        (about([[1, 0], [0, 0.6]], shift=(0, 2)), "moved 2.0 px down, scaled in height to 60.0%"),
        (about([[1.2, 0], [0, 0.6]]), "scaled in width to 120.0% and height to 60.0%"),
        (about(np.array(turn(30)) * 1.5), "turned 30.0 deg clockwise, scaled to 150.0%"),
        (
            about(np.array(turn(30)) @ np.diag([2, 1])),
            "turned 30.0 deg clockwise, scaled to 200.0% and 100.0% along its axes",
        ),
        (about(np.eye(2), shift=(1e-3, 0)), "changed by less than a tenth of a pixel"),
    ],
)
def test_motion_in_words(matrix, words):
    assert describe_motion(np.asarray(matrix), (50.0, 20.0)) == words


def test_a_mirrored_part_is_called_so():
    assert "mirrored" in describe_motion(about([[-1, 0], [0, 1]]), (50.0, 20.0))
