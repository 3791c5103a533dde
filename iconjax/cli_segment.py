"""The commands `iconjax segment` and `iconjax label`: pictures without segments, and segments without names."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import fields, is_dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from iconjax.checks import is_vector, one_segment
from iconjax.console import progress, say
from iconjax.errors import IconjaxError, InputError
from iconjax.files import check_writable

if TYPE_CHECKING:
    from iconjax.scene.segment.base import LabelSuggester
    from iconjax.scene.types import Scene, Segmentation

force_option = click.option("--force", is_flag=True, help="Replace files that exist.")
suggester_option = click.option(
    "--suggester",
    metavar="NAME",
    help="Who names segments without a name: auto (the default: anthropic if set up), none, anthropic or llm-replay.",
)


@click.command(short_help="Find the segments of a picture that has none.")
@click.argument("picture", metavar="IMAGE")
@click.option("-o", "--output", metavar="FOLDER", help="Folder to write; by default NAME-parts in the current folder.")
@click.option("--method", metavar="NAME", help="auto (the default), colour, glyph, or a registered segmenter.")
@click.option("--holes", is_flag=True, help="What has the background's colour inside a shape is a segment, too.")
@click.option(
    "--most", type=click.IntRange(1, 80), metavar="N", help="Unite similar neighbours beyond N segments (24)."
)
@click.option("--merge", metavar="3,4", multiple=True, help="Make one segment of these numbers; may be repeated.")
@suggester_option
@force_option
def segment(
    picture: str, output: str | None, method: str | None, holes: bool, most: int | None, merge: tuple[str, ...],
    suggester: str | None, force: bool,
) -> None:  # fmt: skip
    """Find the segments of IMAGE and write a folder that the other commands take in place of a picture.

    The folder gets image.png, segmentation.png, sheet.png (the segments with their numbers) and labels.json, in
    which each number has a provisional name such as "Red circle 1": write your own names there, as "Object:Part".
    """
    _check_image(picture)
    folder = Path(output) if output is not None else Path(f"{Path(picture).stem}-parts")
    from iconjax.scene.segment.choose import choose_segmenter
    from iconjax.scene.segment.edits import merge_segments, read_merges

    merges = [read_merges(text) for text in merge]
    segmenter = choose_segmenter(method)
    namer = _namer(suggester)
    segmenter = _adjusted(segmenter, holes=holes or None, most=most)
    from iconjax.scene.segment import folder as files

    files.check_folder(folder, force)
    with progress() as stage:
        stage("looking for segments")
        from iconjax.scene.build import build_scene
        from iconjax.scene.segment.matte import open_picture

        opened = open_picture(picture)
        found = merge_segments(opened.segment(segmenter), merges)
        stage("naming segments")
        found = _named(opened.shown, found, namer, insist=suggester not in (None, "auto"))
        stage("drawing the sheet")
        scene = build_scene(opened.shown, found)
        files.make_folder(folder)
        files.write_picture(folder / files.IMAGE, opened.shown)
        files.write_mask(folder / files.MASK, found.mask)
        files.write_labels(folder / files.LABELS, found.labels)
        files.write_picture(folder / files.SHEET, _sheet(scene))
    if lonely := one_segment(picture, len(found.labels)):
        say(lonely)
    say(f'{folder}: {_counted(found)}; see {files.SHEET}, name them in {files.LABELS}, then: '
        f'iconjax edit {folder} "REQUEST"')  # fmt: skip


@click.command(short_help="Draw a numbered sheet of the segments, and a file to name them in.")
@click.argument("picture", metavar="PICTURE")
@click.option("--seg", metavar="FILE", help="Label map of an image: 0 is background, k is segment k.")
@click.option("--labels", metavar="FILE", help="Names that segments have already, as JSON or CSV.")
@click.option("-o", "--output", metavar="FILE", help="The sheet; by default NAME-sheet.png in the current folder.")
@click.option("--template", metavar="FILE", help="The file to fill in; by default NAME-labels.json beside the sheet.")
@suggester_option
@force_option
def label(
    picture: str, seg: str | None, labels: str | None, output: str | None, template: str | None, suggester: str | None,
    force: bool,
) -> None:  # fmt: skip
    """Draw the segments of PICTURE with their numbers, and write a labels file to fill in.

    PICTURE is an SVG, an image with --seg, a case folder, or a folder made by `iconjax segment`. Write names such
    as "Lamp:Shade" behind the numbers; --labels of the other commands takes the file. Names that are filled in stay
    when --force draws the sheet again.
    """
    from iconjax.scene.segment import folder as files

    name = Path(picture).resolve().name if Path(picture).is_dir() else Path(picture).stem
    sheet = Path(output) if output is not None else Path(f"{name}-sheet.png")
    table = Path(template) if template is not None else sheet.with_name(f"{name}-labels.json")
    namer = _namer(suggester)
    if sheet.suffix.lower() != ".png":
        raise InputError(f"the sheet is a PNG: give -o a name that ends in .png, not {sheet.name}")
    if sheet.resolve() == table.resolve():
        raise InputError(f"{sheet} is named twice as an output")
    for path in (sheet, table):
        files.refuse_existing(path, force)
        check_writable(path)
    with progress() as stage:
        stage("looking at the picture")
        from iconjax.scene.segment.given import open_segments

        given = open_segments(picture, seg, labels)
        kept, lost = _kept(table, labels, given.segmentation.labels)
        found = replace(given.segmentation, labels={**given.segmentation.labels, **kept})
        named = given.named | set(kept)
        if set(found.labels) - named:
            stage("naming segments")
            insist = suggester not in (None, "auto")
            found = _named(given.scene.image, found, namer, insist, keep=named)
        stage("drawing the sheet")
        files.write_picture(sheet, _sheet(given.renamed(found.labels)))
        files.write_labels(table, found.labels)
    for note in given.notes:
        say(note)
    if lost:
        say(f"{table} named segments that there are not, which were left out: {', '.join(lost)}")
    if lonely := one_segment(picture, len(found.labels)):
        say(lonely)
    say(f"{sheet}: {_counted(found)}; name them in {table}, which --labels takes")


def _kept(table: Path, labels: str | None, known: Collection[int]) -> tuple[dict[int, str], list[str]]:
    """Names that somebody filled in in an existing labels file and that `labels` does not say, and those of no segment.

    Raises:
        InputError: the file is no labels file.
    """
    if not table.exists():
        return {}, []
    from iconjax.scene.labels import read_labels
    from iconjax.scene.segment.names import is_provisional

    said = {} if labels is None else read_labels(labels)
    filled = {k: name for k, name in read_labels(table).items() if k not in said and not is_provisional(name, k)}
    return {k: name for k, name in filled.items() if k in known}, [n for k, n in filled.items() if k not in known]


def _counted(found: Segmentation) -> str:
    count = len(found.labels)
    return f"{count} segment{'s' if count != 1 else ''}"


def _check_image(picture: str) -> None:
    path = Path(picture)
    if is_vector(picture):
        raise InputError(f"{picture} is an SVG, which has its segments in itself: iconjax label {picture} shows them")
    if path.is_dir():
        raise InputError(f"{picture} is a folder: give an image file")
    if not path.exists():
        raise InputError(f"there is no file {picture}")


def _adjusted(segmenter: Any, **settings: Any) -> Any:
    """The segmenter with those settings that are not None, which it has to know."""
    given = {key: value for key, value in settings.items() if value is not None}
    known = {field.name for field in fields(segmenter)} if is_dataclass(segmenter) else set()
    for key in given:
        if key not in known:
            raise InputError(
                f"the segmenter {getattr(segmenter, 'name', segmenter)} has no setting --{key}: leave it out"
            )
    return replace(segmenter, **given) if given else segmenter


def _namer(wanted: str | None) -> LabelSuggester | None:
    from iconjax.edit.suggest import offer_suggesters
    from iconjax.scene.segment.choose import choose_suggester

    offer_suggesters()
    return choose_suggester(wanted)


def _named(
    image: Any, found: Segmentation, namer: LabelSuggester | None, insist: bool, keep: Collection[int] = ()
) -> Segmentation:
    """The segmentation with the names that a suggester has; without it, or where it fails unasked, with its own.

    Args:
        image: the picture.
        found: its segments under the names that they have.
        namer: who names them.
        insist: whether the user asked for it, so that a failure is one.
        keep: ids of segments whose names stay.
    """
    if namer is None:
        return found
    from iconjax.scene.labels import check_labels
    from iconjax.scene.types import Segmentation

    try:
        told = namer.suggest(image, found)
        names = check_labels({k: name for k, name in told.items() if k in found.labels and k not in keep})
    except IconjaxError as error:
        if insist:
            raise
        say(f"segments keep provisional names: {error}")
        return found
    say(f"{len(names)} of {len(found.labels)} segments named by {namer.name}: check them on the sheet")
    return Segmentation(found.mask, {k: names.get(k, own) for k, own in found.labels.items()})


def _sheet(scene: Scene) -> Any:
    from iconjax.render.numbered import numbered_sheet

    return numbered_sheet(scene)
