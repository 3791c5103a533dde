"""Edit ten icons, one command each, and draw a sheet of them before and after.

python examples/svg/sheet.py
"""

from __future__ import annotations

import io
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import resvg_py
from PIL import Image

HERE = Path(__file__).parent
SIDE = 256
REQUESTS = {
    "delivery-truck": "Make the cargo box half as tall.",
    "ice-cream": "Make the red circle twice as large.",
    "sailboat": "Move the boat to the left by 60 pixels.",
    "mantelpiece-clock": "Make the white circle half as large.",
    "alarm_clock": "Make the white circle half as large.",
    "reading": "Make the orange circle half as large.",
    "candle_sticks": "Make the left red piece half as tall.",
    "cup-hot": "Make the cup half as wide.",
    "lamp": "Make the base twice as wide.",
    "robot": "Make the visor half as wide.",
}


def main() -> None:
    pairs = []
    with tempfile.TemporaryDirectory() as folder:
        for name, request in REQUESTS.items():
            out = Path(folder) / f"{name}.svg"
            labels = HERE / f"{name}.json"
            options = ["--labels", str(labels)] if labels.is_file() else []
            command = ["edit", str(HERE / f"{name}.svg"), request, *options, "--translator", "offline", "-o", str(out)]
            subprocess.run([sys.executable, "-m", "iconjax", *command], check=True)
            pairs.append(np.vstack([drawn(HERE / f"{name}.svg"), drawn(out)]))
    rows = [np.hstack(pairs[k : k + 5]) for k in range(0, len(pairs), 5)]
    Image.fromarray(np.vstack(rows)).save(HERE / "before_after.png", optimize=True)


def drawn(path: Path) -> np.ndarray:
    """An SVG on white, by resvg alone, with a margin."""
    png = resvg_py.svg_to_bytes(
        svg_string=path.read_text("utf-8"), width=SIDE - 32, height=SIDE - 32, background="#fff", skip_system_fonts=True
    )
    picture = np.asarray(Image.open(io.BytesIO(png)).convert("RGB"))
    return np.pad(picture, ((16, 16), (16, 16), (0, 0)), constant_values=255)


if __name__ == "__main__":
    main()
