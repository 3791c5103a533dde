"""Numbers that belong to a name, and numbers that are amounts."""

from __future__ import annotations

import pytest
from test_language_requests import make_scene

from iconjax.errors import TranslationError
from iconjax.language.offline import OfflineTranslator

PIECES = make_scene(
    {"Blue piece 1": [10, 10, 60, 60], "Blue piece 2": [100, 100, 200, 200], "Red piece 3": [300, 300, 400, 400]}
)
WHEELS = make_scene({"Wheel #1": [10, 10, 60, 60], "Wheel #2": [100, 10, 160, 60], "Car": [10, 60, 200, 100]})


@pytest.mark.parametrize(
    ("scene", "request_", "name"),
    [
        (PIECES, "move piece 3 up by 10 px", "Red piece 3"),
        (PIECES, "move piece #3 up by 10 px", "Red piece 3"),
        (PIECES, "move blue piece 2 up by 10 px", "Blue piece 2"),
        (PIECES, "move the red piece 2 px up", "Red piece 3"),
        (PIECES, "make the red piece 2 times bigger", "Red piece 3"),
        (PIECES, "make red piece 3 2 times bigger", "Red piece 3"),
        (WHEELS, "move wheel #2 10 px right", "Wheel #2"),
        (WHEELS, "move wheel 2 to the right by 2 px", "Wheel #2"),
    ],
)
def test_the_number_of_a_name_is_no_amount_and_an_amount_no_name(scene, request_, name):
    program = OfflineTranslator().translate(request_, scene).program
    assert f'("{name}")' in program[0]


def test_an_amount_does_not_choose_between_like_things():
    with pytest.raises(TranslationError, match="could be any of"):
        OfflineTranslator().translate("Make the blue piece 2 times bigger", PIECES)
