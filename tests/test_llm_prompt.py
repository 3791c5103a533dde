"""The prompt: complete, made from the declarations, honest in its examples, and the same on every machine."""

from __future__ import annotations

import io
import json
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from llm_server import CONNECTIONS, REQUEST, lamp
from PIL import Image

from iconjax.dsl.parse import parse
from iconjax.dsl.registry import default_registry
from iconjax.language.base import Hint
from iconjax.language.llm.hints import hint_matrix
from iconjax.language.llm.picture import segmentation_picture
from iconjax.language.llm.prompt import example_reply, examples, system_prompt, text, translation_exchange
from iconjax.language.llm.reply import read_reply, reply_schema
from iconjax.language.llm.scene_text import MOST_VERTICES, describe_scene, outline_vertices
from iconjax.scene.build import build_scene
from iconjax.scene.labels import split_name

BENCHMARK = Path(__file__).parents[1] / "eval" / "benchmark"
WORKED = [e for e in examples() if e.reading is not None]


def objects(names):
    return {split_name(n)[0] for n in names}


class TestConstantPart:
    def test_every_operator_with_its_meaning(self):
        prompt = system_prompt()
        for operator in default_registry().operators.values():
            assert f"{operator.name}(" in prompt and operator.meaning in prompt
        for name, meaning in default_registry().names.items():
            assert f'"{name}"' in prompt and meaning in prompt

    def test_an_operator_that_the_rules_speak_of_exists(self):
        spoken = set(re.findall(r"\b([a-z_]+)\([A-Z\"0-9a-z]", text("rules.md")))
        assert len(spoken) > 10 and spoken <= set(default_registry().operators)

    def test_long_enough_for_the_cache_and_not_much_longer(self):
        assert 12_000 < len(system_prompt()) < len(system_prompt(True)) < 40_000  # characters, about 4 a token

    def test_no_template_is_left_open(self):
        assert "{problems}" not in system_prompt(True) and "TODO" not in system_prompt(True)


class TestExamples:
    @pytest.mark.parametrize("example", WORKED, ids=lambda e: e.request[:30])
    def test_programs_are_valid(self, example):
        parse(example.reading.program, tuple(example.boxes), tuple(objects(example.boxes)))
        assert example.reading.gloss and example.understood

    @pytest.mark.parametrize("example", WORKED, ids=lambda e: e.request[:30])
    def test_moved_segments_exist_lie_in_the_picture_and_are_not_told_to_stay(self, example):
        still = {call[6:-2] for call in example.reading.program if call.startswith('stay("')}
        for hint in example.reading.hints:
            matrix = hint_matrix(hint, example.boxes[hint.segment])
            x0, y0, x1, y1 = example.boxes[hint.segment]
            corners = np.array([[x0, y0], [x1, y1]]) @ matrix[:, :2].T + matrix[:, 2]
            assert corners.min() >= -0.5 and (corners.max(0) <= np.array(example.size) + 0.5).all()
            assert not {hint.segment, split_name(hint.segment)[0]} & still

    @pytest.mark.parametrize("hints", [False, True])
    def test_replies_are_replies(self, hints):
        for example in examples():
            data = example_reply(example, hints)
            answer = read_reply(json.dumps(data), tuple(example.boxes))
            assert answer.refusal == example.refusal and set(data) == set(reply_schema(hints)["properties"])
            if example.reading is not None:
                assert answer.readings[0].program == example.reading.program
                assert len(answer.readings[0].hints) == (len(example.reading.hints) if hints else 0)

    def test_a_refusal_is_among_them(self):
        assert any(e.refusal and e.reading is None for e in examples())

    def test_no_scene_is_one_of_the_benchmark(self):
        measured = {
            name.lower()
            for path in BENCHMARK.glob("*/case.json")
            for name in objects(json.loads(path.read_text(encoding="utf-8"))["labels"].values())
        }
        assert len(measured) > 30
        for example in examples():
            own = {name.lower() for name in objects(example.boxes)}
            # One thing may be common (a table); a scene that is made of things of a benchmark is not invented.
            assert len(own & measured) <= len(own) / 2, own & measured


class TestScene:
    def test_outlines_have_few_vertices_that_lie_on_the_outline(self):
        yy, xx = np.mgrid[:200, :200]
        mask = ((xx - 60) ** 2 + (yy - 80) ** 2 < 50**2).astype(np.uint8)
        mask[(xx - 150) ** 2 + (yy - 150) ** 2 < 30**2] = 2
        for k in range(12):  # many pieces
            mask[5 + 8 * k : 9 + 8 * k, 180:190] = 3
        scene = build_scene(np.full((200, 200, 3), 255, np.uint8), mask, {1: "Disc", 2: "Ball", 3: "Dots"})
        for segment in scene.segments:
            pieces = outline_vertices(segment)
            assert 3 <= sum(map(len, pieces)) <= MOST_VERTICES and all(len(p) >= 3 for p in pieces)
        disc = outline_vertices(scene.segments[0])[0]
        assert np.allclose(np.hypot(*(disc - [60.5, 80.5]).T), 50, atol=1.5) and len(disc) >= 8

    def test_says_what_is_there(self):
        text = describe_scene(lamp(), CONNECTIONS, outlines=True)
        assert 'several parts, which may be named as a whole: "Lamp"' in text
        assert '- "Table": 10,70' in text.split("Outlines")[1]
        assert "Connections: none" in describe_scene(lamp(), ())

    def test_labels_are_quoted(self):
        scene = lamp()
        odd = replace(scene.segments[0], name='Lamp:"Shade" \\ x')
        text = describe_scene(replace(scene, segments=(odd, *scene.segments[1:])), ())
        assert json.dumps(odd.name) in text


class TestPicture:
    def test_the_same_bytes_every_time_and_another_key_for_another_scene(self):
        one, again = segmentation_picture(lamp()), segmentation_picture(lamp())
        assert one == again
        scene = lamp()
        renamed = replace(scene, segments=(replace(scene.segments[0], name="Hat"), *scene.segments[1:]))
        assert len({one.key, segmentation_picture(renamed).key}) == 2
        assert segmentation_picture(renamed).png != one.png

    def test_every_segment_has_a_colour_of_its_own(self):
        mask = np.zeros((60, 400), np.uint8)
        for k in range(40):
            mask[:, 10 * k : 10 * k + 10] = k + 1
        image = np.full((60, 400, 3), 255, np.uint8)
        scene = build_scene(image, mask, {k + 1: f"Stripe:{k}" for k in range(40)})
        picture = np.asarray(Image.open(io.BytesIO(segmentation_picture(scene).png)).convert("RGB"))
        row = {tuple(p) for y in (1, -2) for p in picture[y]}
        assert len(row - {(255, 255, 255)}) >= 40


def test_hints_scale_then_turn_then_move_about_the_centre():
    box = (10.0, 20.0, 30.0, 40.0)
    matrix = hint_matrix(Hint("x", (5, -7), 90, (2, 1)), box)
    assert np.allclose(matrix @ [20, 30, 1], [25, 23])  # the centre only moves
    assert np.allclose(matrix @ [30, 30, 1], [25, 43])  # right of it, twice as far, is below it after a clockwise turn
    assert np.allclose(hint_matrix(Hint("x"), box), np.eye(2, 3))


def test_several_readings_do_not_change_the_constant_part():
    one, three = (translation_exchange(REQUEST, lamp(), (), readings=n) for n in (1, 3))
    assert one.system == three.system and one.schema == three.schema and one.key != three.key
