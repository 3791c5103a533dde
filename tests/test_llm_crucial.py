"""What a vision LLM is asked about a picture: which connections are crucial, and what segments are called."""

from __future__ import annotations

import io
import json
from pathlib import Path

import pytest
from edit_support import small_picture
from llm_server import Scripted, lamp
from PIL import Image

from iconjax.edit.choose import make_translator
from iconjax.edit.inputs import open_inputs
from iconjax.evaluation.model import Meter
from iconjax.language.base import RelationJudge
from iconjax.language.llm.crucial import crucial_by_llm
from iconjax.language.llm.faults import LlmError
from iconjax.language.llm.labels import labels_exchange, name_segments
from iconjax.language.llm.record import Recorder, Replayer
from iconjax.language.llm.settings import LlmSettings
from iconjax.language.llm.translator import AnthropicTranslator
from iconjax.relations.detect import detect_relations

BENCHMARK = Path(__file__).parents[1] / "eval" / "benchmark"
RECORDINGS = Path(__file__).parents[1] / "eval" / "recordings"
SOME = (
    "basket-handles-apart",
    "telescope-level",
    "android-short-body",
    "anvil-hammer",
    "excavator-boom",
    "fish-body-shorter",
    "truck-cargo-shorter",
    "tulip-leaf-flower",
    "plane-fuselage-half",
    "scales-tip",
    "skate-wheel-back",
    "mosque-towers",
)
PAIRS = [("Lamp:Shade", "Lamp:Foot"), ("Lamp:Foot", "Table")]


@pytest.fixture
def folder(tmp_path):
    return tmp_path / "cache"


class TestCrucial:
    def test_one_question_with_the_picture_about_pairs_within_objects(self, folder):
        client = Scripted(['{"crucial": [1]}'])
        assert crucial_by_llm(lamp(), PAIRS, client, folder) == {frozenset(PAIRS[0])}
        (asked,) = client.asked
        assert asked.turns[0].picture is not None and "1. " in asked.turns[0].text
        assert "Table" not in asked.turns[0].text.split("Connections to judge")[1]

    def test_asked_once_whatever_the_order(self, folder):
        client = Scripted(['{"crucial": [1]}'])
        first = crucial_by_llm(lamp(), PAIRS, client, folder)
        turned = [(b, a) for a, b in reversed(PAIRS)]
        assert crucial_by_llm(lamp(), turned, client, folder) == first and len(client.asked) == 1

    def test_a_damaged_memory_is_none(self, folder):
        client = Scripted(['{"crucial": [1]}', '{"crucial": []}'])
        crucial_by_llm(lamp(), PAIRS, client, folder)
        for path in folder.glob("*.json"):
            path.write_text("{")
        assert crucial_by_llm(lamp(), PAIRS, client, folder) == frozenset()

    def test_a_folder_that_cannot_be_written_is_no_error(self, tmp_path):
        (tmp_path / "file").write_text("")
        client = Scripted(['{"crucial": [1]}'])
        assert crucial_by_llm(lamp(), PAIRS, client, tmp_path / "file") == {frozenset(PAIRS[0])}

    def test_the_user_may_want_no_cache(self, monkeypatch):
        monkeypatch.setenv("ICONJAX_CACHE", "")
        client = Scripted(['{"crucial": [1]}', '{"crucial": []}'])
        assert crucial_by_llm(lamp(), PAIRS, client) and not crucial_by_llm(lamp(), PAIRS, client)

    def test_nothing_to_ask(self, folder):
        assert crucial_by_llm(lamp(), PAIRS[1:], Scripted([]), folder) == frozenset()

    @pytest.mark.parametrize("reply", ["yes", "{}", '{"crucial": "all"}', '{"crucial": [1.5]}', '{"crucial": [true]}'])
    def test_no_answer_is_an_error_and_is_not_kept(self, folder, reply):
        with pytest.raises(LlmError):
            crucial_by_llm(lamp(), PAIRS, Scripted([reply]), folder)
        assert not folder.exists()

    def test_numbers_of_nothing_are_left_out(self, folder):
        assert crucial_by_llm(lamp(), PAIRS, Scripted(['{"crucial": [0, 1, 1, 99]}']), folder) == {frozenset(PAIRS[0])}

    def test_recorded_and_replayed(self, folder, tmp_path):
        crucial_by_llm(lamp(), PAIRS, Recorder(Scripted(['{"crucial": [1]}']), tmp_path / "record"), folder)
        again = crucial_by_llm(lamp(), PAIRS, Replayer(tmp_path / "record"), tmp_path / "elsewhere")
        assert again == {frozenset(PAIRS[0])} and not (tmp_path / "elsewhere").exists()

    def test_what_the_cache_knows_is_recorded_too(self, folder, tmp_path):
        crucial_by_llm(lamp(), PAIRS, Scripted(['{"crucial": [1]}']), folder)
        crucial_by_llm(lamp(), PAIRS, Recorder(Scripted([]), tmp_path / "record"), folder)
        assert Replayer(tmp_path / "record").holds("crucial")

    def test_the_same_from_behind_a_client_that_counts(self, folder, tmp_path):
        crucial_by_llm(lamp(), PAIRS, Recorder(Scripted(['{"crucial": []}']), tmp_path / "record"), tmp_path / "other")
        crucial_by_llm(lamp(), PAIRS, Scripted(['{"crucial": [1]}']), folder)
        assert not crucial_by_llm(lamp(), PAIRS, Meter(Replayer(tmp_path / "record")), folder)
        meter = Meter(Recorder(Scripted([]), tmp_path / "second"))
        assert crucial_by_llm(lamp(), PAIRS, meter, folder) and meter.calls == 0
        assert Replayer(tmp_path / "second").holds("crucial")

    def test_a_translator_asks_unless_told_not_to(self, monkeypatch):
        monkeypatch.setenv("ICONJAX_CACHE", "")
        judge = AnthropicTranslator(Scripted(['{"crucial": [1]}']), LlmSettings())
        assert isinstance(judge, RelationJudge) and judge.crucial(lamp(), PAIRS) == {frozenset(PAIRS[0])}
        assert AnthropicTranslator(Scripted([]), LlmSettings(crucial=False)).crucial(lamp(), PAIRS) is None

    def test_a_replay_asks_only_if_that_was_recorded(self, folder, tmp_path):
        def setting():
            return make_translator("llm-replay", LlmSettings(replay=str(tmp_path))).settings.crucial

        assert not setting()
        crucial_by_llm(lamp(), PAIRS, Recorder(Scripted(['{"crucial": [1]}']), tmp_path), folder)
        assert setting()

    def test_the_offline_rule_is_nearly_as_good(self):
        """Against recorded answers of a vision model that had not seen the rule (`eval/recordings/README.md`)."""
        same = total = 0
        for case in SOME:
            scene = open_inputs(BENCHMARK / case).scene
            inner = [r for r in detect_relations(scene) if r.scope != "inter"]
            pairs = [(scene.names[r.a], scene.names[r.b]) for r in inner]
            told = crucial_by_llm(scene, pairs, Replayer(RECORDINGS))
            same += sum(
                (r.scope == "intra-crucial") == (frozenset(p) in told) for r, p in zip(inner, pairs, strict=True)
            )
            total += len(pairs)
        assert total > 60 and same / total > 0.8  # over all 68 icons 296 of 335 when it was written


class TestLabels:
    def sheet(self, **options):
        stream = io.BytesIO()
        Image.fromarray(small_picture()[0]).save(stream, "PNG", **options)
        return stream.getvalue()

    def test_names_as_far_as_they_are_names(self):
        rows = [
            {"number": 1, "name": "Lamp:Shade"},
            {"number": 2, "name": " Lamp : Foot "},
            {"number": 2, "name": "Twice"},
            {"number": 3, "name": "a:b:c"},
            {"number": 4, "name": ""},
            {"number": 99, "name": "Nobody"},
            {"number": True, "name": "No"},
            {"number": 5, "name": "Ta\x1b[2Jble"},
            {"name": "x"},
            "Table",
        ]
        names = name_segments(self.sheet(), 5, Scripted([json.dumps({"labels": rows})]))
        assert names == {1: "Lamp:Shade", 2: "Lamp:Foot", 5: "Ta [2Jble"}

    @pytest.mark.parametrize("reply", ["", "{}", '{"labels": []}', '{"labels": {"1": "Lamp"}}'])
    def test_none(self, reply):
        with pytest.raises(LlmError):
            name_segments(self.sheet(), 3, Scripted([reply]))

    def test_the_key_is_that_of_the_pixels(self):
        keys = {labels_exchange(self.sheet(compress_level=level), 3).key for level in (0, 9)}
        assert len(keys) == 1 and labels_exchange(self.sheet(), 4).key not in keys

    def test_bad_sheets(self):
        with pytest.raises(LlmError, match="no picture"):
            labels_exchange(b"text", 3)
        with pytest.raises(LlmError, match="1 to 200"):
            labels_exchange(self.sheet(), 0)
