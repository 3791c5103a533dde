"""Two edits of an icon of 40 segments: time, candidates, peak memory, and pictures to look at.

    python eval/perf/forty.py FOLDER

Writes `before.png` and one picture for each edit to FOLDER. Compiled solvers are cached as ever; set `ICONJAX_CACHE` to
an empty folder to see a first run.
"""

from __future__ import annotations

import resource
from pathlib import Path
from time import perf_counter

import click
from PIL import Image
from shelf import draw, shelf

EDITS = {
    "clock": (
        'translate("Clock")',
        'stay("Shelf")',
        'on_right("Clock", "Vase")',
        'on_left("Clock", "Globe")',
    ),
    "narrower": ('scale("Shelf")', 'equal(hori_len("Shelf"), mul(0.9, hori_len(old("Shelf"))))'),
}


@click.command(help=__doc__)
@click.argument("folder", type=click.Path(file_okay=False, path_type=Path))
def main(folder: Path) -> None:
    import iconjax
    from iconjax.scene.types import Segmentation

    folder.mkdir(parents=True, exist_ok=True)
    shapes = shelf()
    image, labels = draw(shapes)
    Image.fromarray(image).save(folder / "before.png")
    seg = Segmentation(labels, {k + 1: s.name for k, s in enumerate(shapes)})
    click.echo(f"{len(shapes)} segments, {image.shape[1]}x{image.shape[0]}\n")
    columns = ("relations", "candidates", "compile s", "search s", "render s", "total s", "moved", "peak MiB")
    click.echo(f"| edit | satisfied | {' | '.join(columns)} |")
    click.echo("| --- | --- |" + " ---: |" * len(columns))
    for name, program in EDITS.items():
        begin = perf_counter()
        result = iconjax.edit(image, seg, program=program)
        total = perf_counter() - begin
        result.save(folder / f"{name}.png")
        moved = sum(state != "N" for state in result.motion_states.values())
        memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
        t = result.timings
        click.echo(
            f"| {name} | {result.satisfied} | {len(result.relations)} | {len(result.trace)} | {t['compile']:.1f} "
            f"| {t['search']:.1f} | {t['render']:.1f} | {total:.1f} | {moved} | {memory:.0f} |"
        )
    click.echo("\n" + "\n".join(" ".join(program) for program in EDITS.values()))


if __name__ == "__main__":
    main()
