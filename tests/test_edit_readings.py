"""Several readings of one request, and a translator that is asked to think again."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from edit_support import write_case

from iconjax import edit
from iconjax.errors import ConfigError
from iconjax.language.base import Hint, Reading, Translation

LEFT = ('translate("Lamp:Shade")', 'equal(center_x("Lamp:Shade"), minus(center_x(old("Lamp:Shade")), 10))')
RIGHT = ('translate("Lamp:Shade")', 'equal(center_x("Lamp:Shade"), plus(center_x(old("Lamp:Shade")), 10))')
SAME = ('translate("Lamp:Shade")', 'equal(plus(center_x("Lamp:Shade"), 10), center_x(old("Lamp:Shade")))')
IMPOSSIBLE = (*LEFT, RIGHT[1])


class Scripted:
    """Gives the readings it was made with, and mends a program that cannot hold once."""

    name = "scripted"

    def __init__(self, *readings, mended=()):
        self.readings, self.mended, self.reports = readings, mended, []

    def translate(self, request, scene):
        first = self.readings[0]
        return Translation(first.program, self.name, ("moves",), readings=self.readings, hints=first.hints)

    def repair(self, translation, report):
        self.reports.append(report)
        program = self.mended or translation.program
        return replace(translation, program=program, readings=(Reading("mended", program),), rounds=1)


@pytest.fixture(scope="module")
def case(tmp_path_factory):
    return write_case(tmp_path_factory.mktemp("readings") / "lamp")


def shift(result):
    shade = next(s for s in result.scene.segments if s.name == "Lamp:Shade")
    return round(float(result.transforms[shade.id][0, 2]), 1)


def test_each_different_reading_gives_a_result_with_its_gloss(case):
    translator = Scripted(Reading("to the left", LEFT), Reading("to the right", RIGHT), Reading("left again", SAME))
    result = edit(case, request="move it", translator=translator, interpretations=3)
    assert [(r.gloss, shift(r)) for r in result.interpretations] == [("to the left", -10), ("to the right", 10)]
    assert shift(result) == -10
    assert [r["gloss"] for r in result.to_dict()["interpretations"]] == ["to the left", "to the right"]


def test_no_more_readings_than_asked_for(case):
    translator = Scripted(Reading("to the left", LEFT), Reading("to the right", RIGHT))
    assert edit(case, request="move it", translator=translator).interpretations == ()


def test_what_cannot_hold_goes_back_once_with_what_is_missed(case):
    translator = Scripted(Reading("both ways", IMPOSSIBLE), mended=LEFT)
    result = edit(case, request="move it", translator=translator)
    assert result.satisfied and result.rounds == 1 and shift(result) == -10
    (report,) = translator.reports
    assert {m.call for m in report.missed} & set(IMPOSSIBLE)
    assert set(report.boxes) == {s.name for s in result.scene.segments}


def test_a_repair_that_is_no_better_does_not_count(case):
    translator = Scripted(Reading("both ways", IMPOSSIBLE), mended=(*IMPOSSIBLE, RIGHT[1]))
    result = edit(case, request="move it", translator=translator)
    assert not result.satisfied and result.program == IMPOSSIBLE and result.rounds == 1


def test_hints_about_unknown_names_are_left_out(case):
    hints = (Hint("Nobody", (5, 5)), Hint("Lamp:Shade", (-10, 0)))
    result = edit(case, request="move it", translator=Scripted(Reading("left", LEFT, hints)))
    assert result.satisfied
    np.testing.assert_allclose(shift(result), -10, atol=0.1)


@pytest.mark.parametrize("count", [0, 9, True, 1.5])
def test_a_wrong_number_of_interpretations_is_refused(case, count):
    with pytest.raises(ConfigError, match="interpretations"):
        edit(case, request="move it", translator=Scripted(Reading("left", LEFT)), interpretations=count)


def test_a_program_has_one_interpretation(case):
    with pytest.raises(ConfigError, match="one interpretation"):
        edit(case, program=list(LEFT), interpretations=2)
