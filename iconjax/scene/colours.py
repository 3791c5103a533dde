"""How colours look: their place in CIELAB, and the plain word that a person would use for one."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from jaxtyping import Float

WORDS = {
    "Black": "000000 1a1a1a", "Dark gray": "414141 555b60", "Gray": "7f7f7f 8a8f94", "Light gray": "b4b4b4 d2d6d8",
    "White": "ffffff f2f2f2", "Red": "dd2e44 b41c1c f44336 ff5a5f", "Orange": "ff8c1a f4900c f59b42 e06a10",
    "Yellow": "ffcc33 fff04a fcea2b ffe08a", "Green": "2e9e4a 5c913b 77d94a 1e6b30 a6d388 c5e64a",
    "Teal": "00a3a3 3fd0c9 00727a",
    "Blue": "2a7de1 55acee 8fc9f9 1b3f8b 226699 12306e 6cc4ee", "Purple": "7b3fb8 9266cc b59ae0 4a2480 a32bc0 321b41",
    "Pink": "ea596e f49ac2 ffc0cb f25bb0 e8a0a8", "Brown": "6b4226 8a5a3c a0522d c1694f 4a2e23 9b6a45 7a4a2a",
    "Beige": "d9b48a f0d5b5 efc49a c9a27a",
}  # fmt: skip
"""Words for colours, with examples (hexadecimal RGB); a colour is called as the nearest example in CIELAB is."""


def lab(colours: Float[np.ndarray, "*n 3"]) -> Float[np.ndarray, "*n 3"]:
    """CIELAB of sRGB values 0..255, in which equal steps look equal; single precision stays single."""
    from skimage.color import rgb2lab

    return np.asarray(rgb2lab(colours / 255.0))


def colour_word(colour: Float[np.ndarray, " 3"]) -> str:
    """The plain English word for an RGB colour (0..255)."""
    words, places = _examples()
    return words[int(np.linalg.norm(places - lab(np.asarray(colour, float)), axis=1).argmin())]


@lru_cache(maxsize=1)
def _examples() -> tuple[tuple[str, ...], Float[np.ndarray, "n 3"]]:
    pairs = [(word, code) for word, codes in WORDS.items() for code in codes.split()]
    return tuple(word for word, _ in pairs), lab(np.array([list(bytes.fromhex(code)) for _, code in pairs], float))
