"""How the LLM translator is chosen and set: API, command line, environment."""

from __future__ import annotations

import json
import os
import subprocess
import sys

import pytest
from click.testing import CliRunner
from edit_support import LABELS, small_picture, use_fake_search, write_case
from llm_server import GOOD, KEY, answer, message, serving

from iconjax import edit
from iconjax.cli import main
from iconjax.edit import choose
from iconjax.errors import ConfigError
from iconjax.language.llm.settings import LlmSettings


@pytest.fixture(autouse=True)
def bare(monkeypatch):
    """An environment without credentials or settings."""
    for name in list(os.environ):
        if name.startswith(("ANTHROPIC_", "ICONJAX_")):
            monkeypatch.delenv(name)
    monkeypatch.setenv("NO_PROXY", "127.0.0.1")


class TestChoice:
    @pytest.mark.parametrize("variable", ["ANTHROPIC_API_KEY", "ANTHROPIC_AUTH_TOKEN", "ANTHROPIC_PROFILE"])
    def test_automatic_with_credentials_and_sdk(self, monkeypatch, variable):
        assert choose.choose_translator().name == "offline"
        monkeypatch.setenv(variable, KEY)
        assert choose.choose_translator().name == "anthropic"
        monkeypatch.setattr(choose, "find_spec", lambda name: None)
        assert choose.choose_translator().name == "offline"

    def test_by_name_without_credentials(self):
        with pytest.raises(ConfigError, match="set ANTHROPIC_API_KEY or ANTHROPIC_AUTH_TOKEN"):
            choose.choose_translator("anthropic")
        with pytest.raises(ConfigError, match="--replay or ICONJAX_REPLAY"):
            choose.choose_translator("llm-replay")

    def test_a_server_of_ones_own_needs_none(self, monkeypatch):
        monkeypatch.setenv("ANTHROPIC_BASE_URL", "http://127.0.0.1:9")
        assert choose.choose_translator("anthropic").name == "anthropic"
        assert choose.choose_translator().name == "offline"  # nobody asked for it

    def test_options_of_a_model_imply_one(self, tmp_path, monkeypatch):
        assert choose.llm_options("offline") == "offline" and choose.llm_options(None) is None
        assert choose.llm_options(None, replay=str(tmp_path)).name == "llm-replay"
        monkeypatch.setenv("ANTHROPIC_API_KEY", KEY)
        reader = choose.llm_options("auto", model="some-model", record=str(tmp_path))
        assert reader.name == "anthropic" and reader.settings.model == "some-model"
        with pytest.raises(ConfigError, match="record: only for a language model"):
            choose.llm_options("offline", record=str(tmp_path))
        with pytest.raises(ConfigError, match="llm-replay"):
            choose.llm_options("anthropic", replay=str(tmp_path))


class TestSettings:
    def test_environment_then_arguments(self, monkeypatch):
        monkeypatch.setenv("ICONJAX_MODEL", "from-environment")
        monkeypatch.setenv("ICONJAX_TIMEOUT", "7.5")
        monkeypatch.setenv("ICONJAX_IMAGE", "yes")
        monkeypatch.setenv("ICONJAX_REPAIRS", "")
        monkeypatch.setenv("ANTHROPIC_BASE_URL", "http://here")
        settings = LlmSettings.from_environment(model=None, repairs=5)
        assert (settings.model, settings.timeout, settings.image) == ("from-environment", 7.5, True)
        assert (settings.base_url, settings.repairs) == ("http://here", 5)
        assert LlmSettings.from_environment(model="given").model == "given"

    @pytest.mark.parametrize(
        ("variable", "value"),
        [("ICONJAX_TIMEOUT", "soon"), ("ICONJAX_RETRIES", "-1"), ("ICONJAX_RETRIES", "1.5"), ("ICONJAX_IMAGE", "maybe"),
         ("ICONJAX_EFFORT", "huge"), ("ICONJAX_TIMEOUT", "nan"), ("ICONJAX_READINGS", "100")],
    )  # fmt: skip
    def test_bad_values(self, monkeypatch, variable, value):
        monkeypatch.setenv(variable, value)
        with pytest.raises(ConfigError) as caught:
            LlmSettings.from_environment()
        said = str(caught.value)
        assert value in said and ("can be" in said or "has to be" in said)

    @pytest.mark.parametrize(
        "given", [{"model": " "}, {"model": 3}, {"retries": True}, {"hints": 1}, {"max_tokens": 1}]
    )
    def test_bad_arguments(self, given):
        with pytest.raises(ConfigError):
            LlmSettings(**given)

    def test_hold_no_credentials(self, monkeypatch):
        monkeypatch.setenv("ANTHROPIC_API_KEY", KEY)
        assert KEY not in repr(LlmSettings.from_environment()) + repr(choose.choose_translator().settings)


def test_an_edit_from_the_model_and_again_from_the_recording(tmp_path, monkeypatch):
    """Record with the API, replay on the command line; the key is in nothing that either leaves behind."""
    use_fake_search(monkeypatch)
    monkeypatch.setenv("ANTHROPIC_API_KEY", KEY)
    case, record = write_case(tmp_path / "case"), tmp_path / "record"
    with serving(message(answer(GOOD))) as server:
        monkeypatch.setenv("ANTHROPIC_BASE_URL", server.url)
        reader = choose.llm_options(None, record=str(record))
        result = edit(case, translator=reader)
    assert result.translator == "anthropic" and result.program == tuple(GOOD)
    result.to_json(tmp_path / "live.json")
    result.to_html(tmp_path / "live.html")
    monkeypatch.delenv("ANTHROPIC_API_KEY")
    arguments = ["edit", str(case), "--replay", str(record), "-o", str(tmp_path / "out.png"), "--json", "-"]
    done = CliRunner().invoke(main, arguments)
    assert done.exit_code == 0, done.stderr
    assert json.loads(done.stdout)["program"] == GOOD and json.loads(done.stdout)["translator"] == "llm-replay"
    for path in tmp_path.rglob("*"):
        assert not path.is_file() or KEY.encode() not in path.read_bytes()
    assert KEY not in repr(result) + done.output


class TestCommandLine:
    def run(self, *arguments):
        return CliRunner().invoke(main, [str(a) for a in arguments])

    def fails(self, *arguments):
        done = self.run(*arguments)
        assert done.exit_code == 2 and done.stderr.count("\n") == 1 and "Traceback" not in done.output
        return done.stderr

    def test_a_missing_recording_names_the_request(self, tmp_path):
        case = write_case(tmp_path / "case")
        text = self.fails("translate", case, "turn the shade upside down", "--replay", tmp_path)
        assert "turn the shade upside down" in text and "key " in text

    def test_no_credentials(self, tmp_path):
        assert "ANTHROPIC_API_KEY" in self.fails("translate", write_case(tmp_path / "case"), "--model", "some-model")

    def test_options_that_do_not_fit(self, tmp_path):
        case = write_case(tmp_path / "case")
        program = tmp_path / "program.txt"
        program.write_text(GOOD[0])
        assert "offline" in self.fails("translate", case, "--translator", "offline", "--record", tmp_path)
        assert "no folder" in self.fails("translate", case, "--replay", tmp_path / "none")
        assert "--model" in self.fails("edit", case, "--program", program, "--model", "x")

    def test_translate_prints_a_program(self, tmp_path, monkeypatch):
        monkeypatch.setenv("ANTHROPIC_API_KEY", KEY)
        case = write_case(tmp_path / "case")
        with serving(message(answer(GOOD, understood=["the shade\nmoves"]))) as server:
            monkeypatch.setenv("ANTHROPIC_BASE_URL", server.url)
            done = self.run("translate", case, "--translator", "anthropic", "--record", tmp_path / "record")
        assert done.exit_code == 0, done.stderr
        lines = done.stdout.splitlines()
        assert lines[-2:] == GOOD and "# the shade moves" in lines and "# translator: anthropic" in lines
        assert len(list((tmp_path / "record").glob("translate-*.json"))) == 1


def test_nothing_of_it_is_loaded_before_it_is_needed():
    code = """
import sys; sys.path.insert(0, {tests!r})
import iconjax, iconjax.cli
from iconjax.edit.choose import choose_translator, translator_names
choose_translator("offline"); assert "llm-replay" in translator_names()
print([m for m in ("anthropic", "pydantic", "httpx2", "httpx", "jax") if m in sys.modules])
"""
    code = code.format(tests=os.path.dirname(__file__))
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
    assert done.stdout.strip() == "[]", done.stderr


def test_replay_needs_no_sdk(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "anthropic", None)
    image, mask = small_picture()
    with pytest.raises(Exception, match="no reply is recorded"):
        edit(image, mask, "move the shade", labels=LABELS, translator=choose.llm_options(None, replay=str(tmp_path)))
