"""The command `iconjax`. Each command imports what it needs when it runs, so that `--help` is quick."""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import click

from iconjax import __version__
from iconjax.checks import check_choices, check_outputs, check_picture, default_output, numbered, one_segment
from iconjax.cli_eval import evaluate
from iconjax.cli_segment import label, segment
from iconjax.console import PoliteGroup, progress, say
from iconjax.errors import ConfigError

Command = Callable[..., Any]


@click.group(
    cls=PoliteGroup,
    invoke_without_command=True,
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
)
@click.version_option(__version__, package_name="iconjax", message="%(prog)s %(version)s")
@click.pass_context
def main(context: click.Context) -> None:
    """Edit icons by a sentence."""
    if context.invoked_subcommand is None:
        click.echo(context.get_help())


def picture_options(command: Command) -> Command:
    """The argument and options by which a command is given a picture with its segments."""
    for decorate in (
        click.option(
            "--labels", metavar="FILE", help='Names of the segments, as JSON {"1": "Lamp:Shade", ...} or CSV.'
        ),
        click.option("--seg", metavar="FILE", help="Label map of the image: 0 is background, k is segment k."),
        click.argument("picture", metavar="CASE_OR_IMAGE"),
    ):
        command = decorate(command)
    return command


translator_option = click.option(
    "--translator", metavar="NAME", help="Who reads the request: auto (the default), offline, anthropic or llm-replay."
)


def model_options(command: Command) -> Command:
    """Options of a language model, which imply one."""
    for decorate in (
        click.option("--replay", metavar="DIR", help="Take the model's replies from this folder; no network."),
        click.option("--record", metavar="DIR", help="Record what the model is asked and answers in this folder."),
        click.option("--model", metavar="NAME", help="Language model that reads the request."),
    ):
        command = decorate(command)
    return command


@main.command(short_help="Edit a picture as a sentence asks.")
@picture_options
@click.argument("request", required=False)
@translator_option
@model_options
@click.option(
    "--program",
    metavar="FILE",
    help="Constraints in the DSL, one call a line ('-' is stdin); skips translation.",
)
@click.option(
    "-o",
    "--output",
    metavar="FILE",
    help="Edited picture; by default NAME-edited.png in the current folder, .svg for an SVG.",
)
@click.option(
    "--json",
    "json_file",
    metavar="FILE",
    help="Result with transforms and constraints as JSON ('-' is stdout).",
)
@click.option("--trace", metavar="FILE", help="HTML page that shows the edit and what the search tried.")
@click.option("--strategy", metavar="NAME", default="coherent", help="coherent (the default) or paper.")
@click.option("--strict", is_flag=True, help="Exit with status 1 when a constraint is missed.")
@click.option(
    "--interpretations",
    type=int,
    default=1,
    metavar="N",
    help="Most readings of an ambiguous request to follow; further pictures are written as NAME-2, NAME-3, ...",
)
def edit(
    picture: str, seg: str | None, labels: str | None, request: str | None, translator: str | None,
    program: str | None, output: str | None, json_file: str | None, trace: str | None, strategy: str,
    strict: bool, interpretations: int, model: str | None, record: str | None, replay: str | None,
) -> int:  # fmt: skip
    """Edit CASE_OR_IMAGE as REQUEST says.

    CASE_OR_IMAGE is a case folder, an SVG (--labels names its segments, where the file does not), a folder made
    by `iconjax segment`, or an image with --seg and --labels. Without REQUEST, that of the case folder is used.
    """
    reader = check_choices(translator, program, interpretations, model=model, record=record, replay=replay)
    if program is not None and request is not None:
        raise ConfigError("--program takes the place of a request: leave out one of them")
    target = Path(output) if output is not None else default_output(picture)
    pictures = numbered(target, interpretations)
    check_outputs(pictures, json_file, trace, inputs=(picture, seg, labels, program))
    check_picture(picture, seg, labels)
    text = None if program is None else _program(program)
    from iconjax.edit.aside import asides
    from iconjax.edit.config import EditConfig
    from iconjax.edit.explain import amount

    config = EditConfig(strategy=strategy)
    with progress() as stage:
        stage("starting")
        from iconjax.edit.pipeline import run_edit

        result = run_edit(
            picture,
            seg,
            request,
            labels=labels,
            translator=reader,
            program=text,
            config=config,
            interpretations=interpretations,
            progress=stage,
        )
    for path, one in zip(pictures, result.interpretations or (result,), strict=False):
        one.save(path)
    for number, one in enumerate(result.interpretations, start=1):
        say(f"reading {number} of {len(result.interpretations)}: {one.gloss}")
    if lonely := one_segment(picture, len(result.scene.segments)):
        say(lonely)
    if json_file == "-":
        click.echo(result.to_json())
    elif json_file is not None:
        result.to_json(json_file)
    if trace is not None:
        result.to_html(trace)
    for line in (*(result.vector.notes if result.vector is not None else ()), *asides(result)):
        say(line)
    missed = result.missed()
    for constraint in missed:
        say(f"missed {constraint.text} by {amount(constraint)}")
    total = len(result.constraints)
    say(f"{target}: {total - len(missed)} of {total} constraints hold ({result.translator})")
    return 1 if strict and missed else 0


@main.command(short_help="Print the constraints that a sentence asks for.")
@picture_options
@click.argument("request", required=False)
@translator_option
@model_options
def translate(
    picture: str, seg: str | None, labels: str | None, request: str | None, translator: str | None,
    model: str | None, record: str | None, replay: str | None,
) -> None:  # fmt: skip
    """Print the constraints that REQUEST asks for, as a program that `iconjax edit --program` takes."""
    check_picture(picture, seg, labels)
    reader = check_choices(translator, None, 1, model=model, record=record, replay=replay)
    with progress() as stage:
        stage("reading the request")
        from iconjax.edit.inputs import open_inputs
        from iconjax.edit.pipeline import read_request

        inputs = open_inputs(picture, seg, request, labels)
        translation = read_request(inputs.request, inputs.scene, reader)
    notes = [f"request: {inputs.request}", f"translator: {translation.translator}", *translation.understood]
    for line in notes:
        click.echo("# " + " ".join(line.split()))
    for call in translation.program:
        click.echo(call)


@main.command(short_help="Print how a picture's segments hold together.")
@picture_options
@click.option("--json", "as_json", is_flag=True, help="Print JSON.")
def relations(picture: str, seg: str | None, labels: str | None, as_json: bool) -> None:
    """Print how the segments of a picture hold together: the secondary constraints of any edit."""
    check_picture(picture, seg, labels)
    with progress() as stage:
        stage("looking at the picture")
        from iconjax.edit.inputs import open_inputs
        from iconjax.relations.detect import detect_relations

        scene = open_inputs(picture, seg, None, labels).scene
        found = [(scene.names[r.a], scene.names[r.b], r.kind, r.scope) for r in detect_relations(scene)]
    if as_json:
        import json

        click.echo(
            json.dumps(
                [dict(zip(("a", "b", "kind", "scope"), r, strict=True)) for r in found],
                ensure_ascii=False,
                indent=1,
            )
        )
    else:
        _print_columns(found)


@main.command(short_help="Print the operators of the constraint language.")
@click.argument("name", required=False)
def dsl(name: str | None) -> None:
    """Print the operators of the constraint language, or all about NAME."""
    from iconjax.edit.reference import describe_operator, list_operators

    click.echo("\n".join(list_operators() if name is None else describe_operator(name)))


main.add_command(evaluate)
main.add_command(segment)
main.add_command(label)


def _program(path: str) -> str:
    from iconjax.edit.inputs import program_text, read_text

    text = read_text(path, "program") if path != "-" else sys.stdin.read()
    program_text(text)
    return text


def _print_columns(rows: Sequence[tuple[str, ...]]) -> None:
    widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))] if rows else []
    for row in rows:
        click.echo("  ".join(cell.ljust(w) for cell, w in zip(row, widths, strict=True)).rstrip())
