"""The registry: declarations and functions fit each other, and a user's package can add its own."""

from __future__ import annotations

import subprocess
import sys
import types

import pytest

from iconjax.dsl.declarations import read_declarations
from iconjax.dsl.docs import describe, main, to_markdown, to_reference
from iconjax.dsl.operators import MODULES, implements, residual_of
from iconjax.dsl.parse import parse
from iconjax.dsl.registry import Registry, default_registry, specs_folder
from iconjax.errors import ConfigError, InputError

REGISTRY = default_registry()

# Contract, section 5: the table and the additions.
NAMES = [
    "translate", "rotate", "scale", "stay", "equal", "smaller", "larger", "coincide_on_point", "inside",
    "contain", "touch", "overlap", "detach", "on_top", "on_bottom", "on_left", "on_right", "plus",
    "minus", "mul", "div", "min", "max", "vert_len", "hori_len", "center_x", "center_y", "min_x",
    "max_x", "min_y", "max_y", "long_dir_x", "long_dir_y", "short_dir_x", "short_dir_y", "old", "top",
    "bot", "left", "right", "min_dist", "max_dist", "avg_dist", "angle", "union", "inter", "rotation",
    "long_len", "short_len", "scale_x", "scale_y", "uniform", "together", "hinge", "dist_x", "dist_y",
    "align_x", "align_y", "parallel", "perpendicular",
]  # fmt: skip


SPEC = """
group = "mine"
title = "Mine"
about = "Added."

[[operator]]
name = "near"
params = ["S: Segment", "T: Segment"]
returns = "Violation"
unit = "length"
meaning = "S lies near T"
example = 'near("Cup", "Plate")'
"""


def near(s, t):
    return abs(s.hull[0, 0] - t.hull[0, 0])


def module(*functions):
    """A user's module that binds functions."""
    made = types.ModuleType("mine")
    for i, function in enumerate(functions):
        function.__module__ = "mine"
        setattr(made, f"f{i}", function)
    return made


def bound(function, name="near", both=True):
    copy = types.FunctionType(function.__code__, globals())
    copy = implements(name)(copy)
    return residual_of(name)(copy) if both else copy


@pytest.fixture
def spec(tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text(SPEC)
    return path


def test_every_operator_of_the_contract_is_declared_and_nothing_else():
    assert sorted(REGISTRY.operators) == sorted(NAMES)
    assert list(REGISTRY.names) == ["canvas"]


def test_declarations_and_functions_fit():
    REGISTRY.verify()


@pytest.mark.parametrize("name", NAMES)
def test_every_example_is_a_valid_call_of_its_operator(name):
    operator = REGISTRY.operators[name]
    example = operator.example
    assert example.startswith(f"{name}(")
    wrapped = {"Value": f"smaller({example}, {example})", "Segment": f"touch({example}, {example})"}
    parse(wrapped.get(operator.returns, example), None)
    assert operator.meaning and "\n" not in operator.meaning and not operator.meaning.endswith(".")


def test_a_package_can_add_an_operator(spec):
    extended = REGISTRY.extended(spec, module(bound(near)))
    assert parse('near("A", "B")', ["A", "B"], registry=extended).calls[0].name == "near"
    assert extended.function("near").__code__ is near.__code__
    assert "Mine" in to_markdown(extended)
    assert "near" not in REGISTRY.operators


@pytest.mark.parametrize(
    ("functions", "says"),
    [
        ([], "near is declared but has no value function"),
        ([bound(near, both=False)], "near is declared but has no residual function"),
        ([bound(near), bound(near, "far")], "far is implemented but not declared"),
        ([bound(near), bound(near)], "near is implemented twice"),
        ([bound(lambda s: 0)], "near is declared with 2 arguments"),
        ([bound(near), bound(near, "min_x")], "min_x is no specifier"),
        ([bound(near), bound(near, "old")], "old takes no function"),
    ],
)
def test_a_misfit_is_refused(spec, functions, says):
    with pytest.raises(ConfigError, match=says):
        REGISTRY.extended(spec, module(*functions))


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        ('meaning = "S lies near T"', "", "meaning missing"),
        ('returns = "Violation"', 'returns = "Thing"', "returns is one of"),
        ('unit = "length"', 'unit = "metre"', "unit is missing"),
        ('unit = "length"', "", "unit is missing"),
        ("T: Segment", "T: Sgment", "parameter types"),
        ('unit = "length"', 'unit = "length"\ncolour = "red"', "unknown field colour"),
        ('group = "mine"', "", "names their group"),
        ('name = "near"', 'name = "touch"', "already taken: touch"),
        ('name = "near"', 'name = "not a name"', "no identifier"),
        ("[[operator]]", "[[operator", "not readable as TOML"),
    ],
)
def test_a_faulty_declaration_is_refused(spec, old, new, says):
    spec.write_text(SPEC.replace(old, new))
    with pytest.raises(ConfigError, match=says):
        REGISTRY.extended(spec, module(bound(near)))


def test_declarations_must_exist(tmp_path):
    with pytest.raises(ConfigError, match="no operator declarations"):
        read_declarations(tmp_path)
    with pytest.raises(ConfigError, match="no operator declarations"):
        read_declarations(tmp_path / "none.toml")


def test_an_operator_that_has_no_function_says_so():
    with pytest.raises(ConfigError, match="translate has no value function"):
        REGISTRY.function("translate")


def test_loading_needs_no_jax_and_the_installed_folder_comes_first(tmp_path):
    code = (
        "import sys, iconjax.dsl.registry as r; r.default_registry(); assert 'jax' not in sys.modules; "
        "import pathlib; r.__file__ = str(pathlib.Path(sys.argv[1]) / 'registry.py'); print(r.specs_folder())"
    )
    (tmp_path / "specs").mkdir()
    run = subprocess.run([sys.executable, "-c", code, str(tmp_path)], check=True, capture_output=True, text=True)
    assert run.stdout.strip() == str(tmp_path / "specs")
    assert specs_folder().is_dir()
    assert Registry.load(specs_folder(), MODULES).operators == REGISTRY.operators


def test_references_name_every_operator(tmp_path, capsys):
    page, text = to_markdown(), to_reference()
    for name in NAMES:
        assert f"`{name}(" in page
        assert f"  {name}(" in text
    assert '`"canvas"`' in page
    assert '"canvas"' in text
    main([])
    assert capsys.readouterr().out == page
    main([str(tmp_path / "dsl.md")])
    assert (tmp_path / "dsl.md").read_text(encoding="utf-8") == page


def test_one_operator_in_full():
    assert describe("touch").startswith("touch(S: Segment, T: Segment) -> Violation [length]")
    with pytest.raises(InputError, match='did you mean "touch"'):
        describe("tuoch")
