"""The paper's baselines: what is asked, what a recorded reply makes of the picture, and what a bad one costs."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner
from edit_support import use_fake_search
from evaluation_support import BENCHMARK, shift, write_case
from solve_support import quick_compiles

from iconjax.cli import main
from iconjax.errors import ConfigError, IconjaxError
from iconjax.evaluation.asking import baseline_exchange, outline_text, read_motions, system_text
from iconjax.evaluation.cases import load_eval_case
from iconjax.evaluation.editors import scene_of
from iconjax.evaluation.model import open_translator
from iconjax.evaluation.record import CaseRecord
from iconjax.evaluation.run import run_benchmark
from iconjax.language.base import Usage
from iconjax.language.llm.exchange import Reply
from iconjax.language.llm.record import MissingRecordingError, write_recording
from iconjax.language.llm.settings import LlmSettings

MOVE = {"segment": "Red:Square", "translate": [20, 0], "rotate": 0, "scale": [1, 1]}


@pytest.fixture
def case(tmp_path: Path) -> Path:
    return write_case(tmp_path / "bench" / "case")


def record(case: Path, method: str, reply: Any) -> Path:
    """Record a reply to the question of a method ("dm", "dc +image"); gives back the folder."""
    loaded = load_eval_case(case)
    base, *flags = method.split()
    exchange = baseline_exchange(base, loaded.request, scene_of(loaded), bool(flags))
    text = reply if isinstance(reply, str) else json.dumps(reply)
    folder = case.parent.parent / "replies"
    write_recording(folder, exchange, Reply(text, "test", Usage(1000, 50)))
    return folder


def run(case: Path, method: str, replies: Path) -> CaseRecord:
    settings = LlmSettings(replay=str(replies))
    (found,) = run_benchmark(case, case.parent.parent / "out", [method], settings=settings).of(method)
    return found


def test_a_reply_to_dm_becomes_the_edit(case: Path) -> None:
    found = run(case, "dm", record(case, "dm", {"plan": "right", "motions": [MOVE]}))
    assert found.error is None and found.right and found.cd == pytest.approx(0) and found.mse == 0
    np.testing.assert_allclose(found.transforms["1"], shift(20, 0))
    np.testing.assert_allclose(found.transforms["2"], shift(0, 0))
    usage = found.details["usage"]
    assert (usage["calls"], usage["input_tokens"], usage["output_tokens"]) == (1, 1000, 50)
    assert usage["prompt_characters"] > 1000 and usage["reply_characters"] > 50


def test_motions_are_about_the_middle_of_the_box(case: Path) -> None:
    motion = {**MOVE, "translate": [0, 5], "rotate": 90, "scale": [2, 1]}
    found = run(case, "dm", record(case, "dm", {"motions": [motion]}))
    matrix = np.array(found.transforms["1"])
    np.testing.assert_allclose(matrix @ (15, 15, 1), (15, 20), atol=1e-9)  # the square is from 10 to 20
    np.testing.assert_allclose(matrix @ (20, 15, 1), (15, 30), atol=1e-9)  # its right side points down, twice as far


@pytest.mark.parametrize(
    "reply",
    [
        "I would move the red square to the right.",
        "",
        "[1, 2]",
        {"motions": "none"},
        {"motions": [{**MOVE, "segment": "Red"}]},
        {"motions": [{**MOVE, "translate": [20]}]},
        {"motions": [{**MOVE, "scale": ["2", 1]}]},
        {"motions": [{**MOVE, "rotate": True}]},
        {"motions": [MOVE, MOVE]},
        '{"motions": [{"segment": "Red:Square", "translate": [1e999, 0]}]}',
        {"plan": "x" * 40_000, "motions": []},
    ],
    ids=lambda reply: str(reply)[:30],
)
def test_a_reply_that_cannot_be_used_is_a_failed_unedited_case(case: Path, reply: Any) -> None:
    found = run(case, "dm", record(case, "dm", reply))
    assert found.error is not None and "reply" in found.error and "\n" not in found.error
    assert not found.right and found.satisfied is False
    np.testing.assert_allclose(found.transforms["1"], shift(0, 0))


def test_a_reply_to_dc_is_solved_once(case: Path) -> None:
    program = ['translate("Red:Square")', 'equal(center_x("Red:Square"), 35)', 'stay("Green:Square")']
    replies = record(case, "dc", {"plan": "", "program": program})
    with quick_compiles():
        found = run(case, "dc", replies)
    assert found.error is None and found.right and found.cd is not None and found.cd < 0.01
    assert found.details["program"] == program and found.details["timings"]["search"] > 0
    record(case, "dc", {"program": ['moove("Red:Square")']})
    wrong = run(case, "dc", replies)
    assert wrong.error is not None and "moove" in wrong.error and not wrong.right


def test_the_translator_answers_from_recordings_too(case: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    use_fake_search(monkeypatch, satisfied=False)  # a constraint is missed, so the translator is asked once more
    loaded, folder = load_eval_case(case), case.parent.parent / "replies"
    folder.mkdir()
    assert "no reply is recorded" in str(run(case, "ours +llm-replay", folder).error)
    reader, _ = open_translator("llm-replay", LlmSettings(replay=str(folder)))
    with pytest.raises(MissingRecordingError) as missing:
        reader.translate(loaded.request, scene_of(loaded))
    reading = {"gloss": "to the right", "program": ['translate("Red:Square")']}
    reply = json.dumps({"understood": ["move it"], "readings": [reading], "refusal": None})
    write_recording(folder, missing.value.exchange, Reply(reply, "test", Usage(700, 30)))
    found = run(case, "ours +llm-replay", folder)
    assert found.error is None and found.details["translator"] == "llm-replay"
    assert found.details["program"] == reading["program"] and found.transforms["1"][0][2] == 8
    assert found.details["usage"]["calls"] == 1 and found.details["usage"]["input_tokens"] == 700


def test_with_the_picture_it_is_another_question(case: Path) -> None:
    replies = record(case, "dm", {"motions": [MOVE]})
    found = run(case, "dm +image", replies)
    assert found.error is not None and "no reply is recorded" in found.error
    record(case, "dm +image", {"motions": [MOVE]})
    assert run(case, "dm +image", replies).right


def test_a_new_reply_is_used_and_an_old_one_is_not_asked_for_again(case: Path) -> None:
    replies = record(case, "dm", {"motions": [MOVE]})
    first = run(case, "dm", replies)
    assert run(case, "dm", replies).seconds == first.seconds
    record(case, "dm", {"motions": []})
    assert not run(case, "dm", replies).right


def test_prompts_show_every_segment_and_the_language() -> None:
    case = load_eval_case(BENCHMARK / "basket-handles-apart")
    scene = scene_of(case)
    text = outline_text(scene)
    outlines = [line.split()[1:] for line in text.splitlines() if line.startswith("  outline")]
    assert len(outlines) == len(scene.segments)
    assert all(3 <= len([v for v in vertices if v != "|"]) <= 24 for vertices in outlines)
    assert all(f'"{name}"' in text for name in scene.names)
    question = baseline_exchange("dm", case.request, scene, image=True)
    assert case.request in question.turns[0].text and question.turns[0].picture is not None
    assert "coincide_on_point" in system_text("dc") and "{" + "operators}" not in system_text("dc")


@pytest.mark.parametrize("image", [False, True])
def test_prompts_go_out_and_replies_come_in(
    case: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, image: bool
) -> None:
    monkeypatch.syspath_prepend(str(BENCHMARK.parent))
    from baseline_prompts import write_prompts
    from llm_prompts import collect

    out, replies = tmp_path / "prompts", tmp_path / "replies"
    assert write_prompts([case.parent], "dm", image, out, None) == 1
    assert "Red:Square" in (out / "case.prompt.md").read_text() and (out / "case.png").exists() == image
    (out / "case.reply.json").write_text(f"```json\n{json.dumps({'motions': [MOVE]})}\n```\n")  # verbatim
    assert collect(out, replies, "test") == 1
    assert write_prompts([case.parent], "dm", image, out, replies) == 0
    assert run(case, "dm +image" if image else "dm", replies).right


def test_the_example_in_the_prompt_has_the_form_that_is_read() -> None:
    scene = scene_of(load_eval_case(BENCHMARK / "basket-handles-apart"))
    (line,) = [part for part in system_text("dm").split("\n\n") if part.startswith("{")]
    with pytest.raises(IconjaxError, match="not a segment"):
        read_motions(line, scene)  # the form is right, only the label is not of this picture
    (hint,) = read_motions(line.replace("Lamp:Shade", scene.names[0]), scene)
    assert hint.translate == (0, -12.5)


def test_without_recordings_it_is_one_clear_line(case: Path, tmp_path: Path) -> None:
    with pytest.raises(ConfigError, match="--replay"):
        run_benchmark(case, tmp_path / "out", ["dm"], settings=LlmSettings())
    with pytest.raises(ConfigError, match="there is no folder"):
        run_benchmark(case, tmp_path / "out", ["dm"], settings=LlmSettings(replay=str(tmp_path / "none")))
    assert not (tmp_path / "out").exists()


def test_the_command_answers_from_recordings_and_tells_what_failed(case: Path, tmp_path: Path) -> None:
    replies = record(case, "dm", "no")
    args = ["eval", str(case), "--out", str(tmp_path / "out"), "--method", "dm", "--replay", str(replies)]
    result = CliRunner().invoke(main, args)
    assert result.exit_code == 0, result.stderr
    assert "| dm | 1 | 1 |" in result.stdout and "| 4.03 |" in result.stdout
    assert "dm failed on case: the model's reply is not JSON" in result.stderr
    both = CliRunner().invoke(main, [*args, "--jobs", "2", "--dask", "tcp://127.0.0.1:9"])
    assert both.exit_code == 2 and "leave one out" in both.stderr
