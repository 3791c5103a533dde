"""Open broken and hostile SVGs and print what each leads to, in what time, with what it asked of the machine.

    python eval/svg/fuzz.py

Every one runs in a process of its own, in which any file that is opened after the start, any use of the network and
any new process is recorded by Python's audit hooks. Memory is that of this process and of the rasteriser's.
"""

from __future__ import annotations

import json
import resource
import subprocess
import sys
from pathlib import Path
from time import perf_counter

TESTS = Path(__file__).parents[2] / "tests"
TIMEOUT = 60


def main() -> None:
    sys.path.insert(0, str(TESTS))
    from svg_hostile import HOSTILE

    if len(sys.argv) > 1:
        print(json.dumps(probe(HOSTILE[sys.argv[1]][0])))
        return
    print("| file | result | seconds | MB | opened, connected to or started |")
    print("| --- | --- | --- | --- | --- |")
    for name in HOSTILE:
        done = subprocess.run(
            [sys.executable, __file__, name], capture_output=True, text=True, timeout=TIMEOUT, check=False
        )
        if done.returncode:
            print(f"| {name} | CRASHED: {done.stderr.strip().splitlines()[-1][:100]} | | | |")
            continue
        row = json.loads(done.stdout)
        print(f"| {name} | {row['result']} | {row['seconds']:.2f} | {row['memory']} | {row['reached'] or 'nothing'} |")


def probe(data: bytes) -> dict[str, object]:
    """Open one SVG and see what it reaches for."""
    from svg_hostile import DOT, svg

    from iconjax.errors import IconjaxError
    from iconjax.scene.svg import open_svg, rasteriser

    open_svg(svg(f'<style>a{{}}</style><path d="M1 1h2v2zM9 9h2v2z"/>{DOT}'))  # what is imported late, is now
    reached: list[str] = []

    def watch(event: str, arguments: tuple[object, ...]) -> None:
        if event == "open" and str(arguments[0]).endswith((".py", ".pyc")):
            return  # Python's own codecs
        if event == "open" or event.startswith(("socket.", "urllib.", "subprocess.", "os.system", "os.exec")):
            reached.append(f"{event} {arguments[:1]}")

    sys.addaudithook(watch)
    start = perf_counter()
    try:
        vector = open_svg(data)
        result = f"opened: {len(vector.scene.segments)} segments" + "".join(f"; {note}" for note in vector.notes)
    except IconjaxError as error:
        result = str(error)
    seconds = perf_counter() - start
    rasteriser._SHARED.close()
    who = (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)
    memory = " + ".join(str(resource.getrusage(w).ru_maxrss // 1024) for w in who)
    return {"result": result, "seconds": seconds, "memory": memory, "reached": reached[:3]}


if __name__ == "__main__":
    main()
