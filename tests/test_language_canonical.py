"""Programs that mean the same, and programs that do not."""

from __future__ import annotations

import pytest

from iconjax.language.canonical import canonical, same_meaning

MEMBERS = {"Lamp": frozenset({1, 2}), "Lamp:Shade": frozenset({1}), "Mug": frozenset({3})}


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ('equal(vert_len("Mug"), 20)', 'equal(20, vert_len("Mug"))'),
        (
            'equal(vert_len("Mug"), div(vert_len(old("Mug")), 2))',
            'equal(vert_len("Mug"), mul(0.5, vert_len(old("Mug"))))',
        ),
        (
            'equal(minus(center_x("Mug"), center_x(old("Mug"))), -30)',
            'equal(center_x("Mug"), minus(center_x(old("Mug")), 30))',
        ),
        ('smaller(min_x("Mug"), max_x("Lamp"))', 'larger(max_x("Lamp"), min_x("Mug"))'),
        ('touch("Mug", "Lamp")', 'touch("Lamp", "Mug")'),
        ('coincide_on_point("Mug", [1, 2], "Lamp", [3, 4])', 'coincide_on_point("Lamp", [3, 4], "Mug", [1, 2])'),
    ],
)
def test_same(one: str, other: str) -> None:
    assert canonical(one) == canonical(other)


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ('smaller(min_x("Mug"), max_x("Lamp"))', 'larger(min_x("Mug"), max_x("Lamp"))'),
        ('on_top("Mug", "Lamp")', 'on_top("Lamp", "Mug")'),
        (
            'equal(center_x("Mug"), plus(center_x(old("Mug")), 30))',
            'equal(center_x("Mug"), minus(center_x(old("Mug")), 30))',
        ),
        ('coincide_on_point("Mug", [1, 2], "Lamp", [3, 4])', 'coincide_on_point("Mug", [3, 4], "Lamp", [1, 2])'),
    ],
)
def test_different(one: str, other: str) -> None:
    assert canonical(one) != canonical(other)


def test_motions_are_compared_loosely_but_not_left_out() -> None:
    """That the shade moves says that the lamp does, and not that the mug does."""
    meets = 'touch("Lamp", "Mug")'
    assert same_meaning(['translate("Lamp")', meets], ['translate("Lamp:Shade")', meets], MEMBERS)
    assert not same_meaning(['translate("Lamp")', meets], ['translate("Mug")', meets], MEMBERS)
    assert not same_meaning(['translate("Lamp")', 'stay("Mug")', meets], ['translate("Lamp")', meets], MEMBERS)
