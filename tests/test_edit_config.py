"""Settings and the choice of a translator."""

from __future__ import annotations

from dataclasses import FrozenInstanceError

import pytest

from iconjax import ConfigError, EditConfig
from iconjax.edit import choose


def test_defaults_reach_the_search():
    search = EditConfig().to_search()
    assert search.strategy == "coherent"
    assert search.relation_search
    assert search.motion_search


def test_settings_reach_the_search():
    search = EditConfig(strategy="paper", relation_search=False, motion_search=False).to_search()
    assert (search.strategy, search.relation_search, search.motion_search) == ("paper", False, False)


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"strategy": "fast"}, "'coherent' or 'paper'"),
        ({"strategy": None}, "'coherent' or 'paper'"),
        ({"relation_search": 1}, "True or False"),
        ({"motion_search": "yes"}, "True or False"),
        ({"search": 3}, "mapping"),
        ({"search": {"rounds": 0}}, "rounds must be"),
        ({"solver": 3}, "has to be a name"),
    ],
)
def test_wrong_settings_name_what_is_allowed(settings, message):
    with pytest.raises(ConfigError, match=message):
        EditConfig(**settings)


@pytest.mark.parametrize(
    ("search", "message"),
    [({"no_such_thing": 1}, "it can hold rounds"), ({"strategy": "paper"}, "strategy=")],
)
def test_wrong_search_settings_name_what_is_allowed(search, message):
    with pytest.raises(ConfigError, match=message):
        EditConfig(search=search).to_search()


def test_config_is_frozen():
    config = EditConfig(search={})
    with pytest.raises(FrozenInstanceError):
        config.strategy = "paper"  # type: ignore[misc]
    with pytest.raises(TypeError):
        config.search["solver"] = "x"  # type: ignore[index]


class Silent:
    name = "silent"

    def translate(self, request, scene):
        raise NotImplementedError


@pytest.fixture
def registry(monkeypatch):
    """The registry without traces of other tests, and no credentials."""
    monkeypatch.setattr(choose, "_FACTORIES", dict(choose._FACTORIES))
    for name in choose.CREDENTIALS:
        monkeypatch.delenv(name, raising=False)


@pytest.mark.usefixtures("registry")
class TestChoice:
    @pytest.mark.parametrize("variable", choose.CREDENTIALS)
    def test_automatic_is_anthropic_once_configured(self, monkeypatch, variable):
        choose.register_translator("anthropic", Silent)
        assert choose.choose_translator("auto").name == "offline"
        monkeypatch.setenv(variable, "placeholder")
        assert choose.choose_translator("auto").name == "silent"

    def test_empty_credentials_do_not_count(self, monkeypatch):
        choose.register_translator("anthropic", Silent)
        monkeypatch.setenv("ANTHROPIC_API_KEY", " ")
        assert choose.choose_translator().name == "offline"

    def test_asking_for_anthropic_says_what_is_missing(self, monkeypatch):
        monkeypatch.delenv("ANTHROPIC_BASE_URL", raising=False)
        with pytest.raises(ConfigError, match="ANTHROPIC_API_KEY"):
            choose.choose_translator("anthropic")

    def test_unknown_names_get_a_hint(self):
        with pytest.raises(ConfigError, match="did you mean 'offline'"):
            choose.choose_translator("ofline")
        with pytest.raises(ConfigError, match="'auto' or 'offline'"):
            choose.choose_translator("xyz")

    def test_own_translators_are_taken_by_name_and_as_objects(self):
        choose.register_translator("silent", Silent)
        assert choose.choose_translator("silent").name == "silent"
        own = Silent()
        assert choose.choose_translator(own) is own
        with pytest.raises(ConfigError, match="no method translate"):
            choose.choose_translator(3)

    @pytest.mark.parametrize("name", ["", "auto"])
    def test_reserved_names(self, name):
        with pytest.raises(ConfigError):
            choose.register_translator(name, Silent)
