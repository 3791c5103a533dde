"""Pixels of files, PIL images and arrays as 8-bit RGB or as segment ids."""

from __future__ import annotations

import os
import warnings
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from jaxtyping import Int32, UInt8

from iconjax.errors import InputError

if TYPE_CHECKING:
    from PIL.Image import Image

MAX_PIXELS = 64_000_000
"""Largest picture, in pixels, that is read."""
MOST = f"{MAX_PIXELS // 10**6} million"
MAX_ID = 65535
"""Largest segment id: label maps are 8- or 16-bit."""


def is_pil(source: Any) -> bool:
    from PIL.Image import Image

    return isinstance(source, Image)


def open_image(source: str | os.PathLike[str], what: str) -> Image:
    """The fully read first frame of an image file."""
    from PIL import Image, UnidentifiedImageError

    path = Path(os.fspath(source))
    if os.path.isdir(path):
        raise InputError(f"{what} {path} is a folder: give the image file in it")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            with Image.open(path) as image:
                _check_pixels(image.width, image.height, f"the {what} {path}")
                image.load()
                return image.copy()
    except InputError:
        raise
    except FileNotFoundError:
        raise InputError(f"{what} file {path} does not exist: check the path") from None
    except PermissionError:
        raise InputError(f"{what} file {path} cannot be opened: permission denied") from None
    except Image.DecompressionBombError:
        raise InputError(f"the {what} {path} has too many pixels: at most {MOST} are read, scale it down") from None
    except UnidentifiedImageError:
        empty = path.stat().st_size == 0
        why = "is empty" if empty else "is not an image Pillow can read"
        raise InputError(f"{what} file {path} {why}: give a PNG") from None
    except OSError as error:
        why = f"cannot be opened ({error.strerror})" if error.strerror else f"is damaged ({_one_line(error)})"
        raise InputError(f"{what} file {path} {why}: check the path or save it again as PNG") from None
    except Exception as error:  # Pillow's decoders raise almost anything on damaged files
        why = _one_line(error)
        raise InputError(f"{what} file {path} is damaged ({why}): save it again as PNG") from None


def _one_line(error: BaseException) -> str:
    return " ".join(str(error).split())[:120] or type(error).__name__


def _check_pixels(width: int, height: int, what: str) -> None:
    if width < 1 or height < 1:
        raise InputError(f"{what} has no pixels ({width}x{height}): give a picture of at least 1x1")
    if width * height > MAX_PIXELS:
        raise InputError(f"{what} has too many pixels ({width}x{height}): at most {MOST} are read, scale it down")


def as_array(source: Any, what: str) -> np.ndarray:
    hint = "give a path, a PIL image or an array"
    if source is None or isinstance(source, bytes | bytearray | Mapping | int | float):
        raise InputError(f"cannot use {type(source).__name__} as {what}: {hint}")
    try:
        array = np.asarray(source)
    except Exception as error:
        name, why = type(source).__name__, _one_line(error)
        raise InputError(f"cannot use {name} as {what} ({why}): {hint}") from None
    if array.dtype.kind not in "biuf":
        raise InputError(f"cannot use values of type {array.dtype} as {what}: {hint} of numbers")
    return array


def rgb_of_pil(image: Image, what: str) -> UInt8[np.ndarray, "H W 3"]:
    _check_pixels(image.width, image.height, what)
    try:
        return _convert(image, what)
    except InputError:
        raise
    except Exception as error:
        raise InputError(f"{what} cannot be turned into RGB ({_one_line(error)}): save it as RGB PNG") from None


def _convert(image: Image, what: str) -> UInt8[np.ndarray, "H W 3"]:
    if image.mode.startswith("I") or image.mode == "F":
        array = np.asarray(image)
        if image.mode == "I" and array.min() >= 0 and array.max() <= 65535:
            array = array.astype(np.uint16)  # how some readers give 16-bit grey
        return rgb_of_array(array, what)
    if image.mode in ("LA", "La", "PA", "RGBA", "RGBa") or "transparency" in image.info:
        return _on_white(np.asarray(image.convert("RGBA")))
    return np.array(image.convert("RGB"))


def rgb_of_array(array: np.ndarray, what: str) -> UInt8[np.ndarray, "H W 3"]:
    channels = 1 if array.ndim == 2 else array.shape[-1] if array.ndim == 3 else 0
    if channels not in (1, 3, 4) and array.size:
        first = " (move the channel axis last)" if array.ndim == 3 and array.shape[0] in (1, 3, 4) else ""
        raise InputError(
            f"{what} has shape {array.shape}: it must be (height, width) or (height, width, 3 or 4){first}"
        )
    height, width = array.shape[:2] if array.ndim >= 2 else (array.size, 0)
    _check_pixels(width if array.size else 0, height, what)
    pixels = _to_bytes(array.reshape(height, width, channels), what)
    if channels == 4:
        return _on_white(pixels)
    return np.repeat(pixels, 3, axis=2) if channels == 1 else pixels.copy()


def _to_bytes(array: np.ndarray, what: str) -> UInt8[np.ndarray, "H W C"]:
    if array.dtype == np.uint8:
        return array
    if array.dtype.kind == "b":
        return array.astype(np.uint8) * np.uint8(255)
    if array.dtype == np.uint16:
        return ((array.astype(np.uint32) + 128) // 257).astype(np.uint8)
    if array.dtype.kind == "f" and not np.isfinite(array).all():
        raise InputError(f"{what} has NaN or infinite values: replace them by numbers from 0 to 1")
    low, high = array.min(), array.max()
    if array.dtype.kind == "f":
        if low < 0 or high > 1:
            raise InputError(f"{what} has floats from {low:g} to {high:g}: use 0 to 1, or uint8 from 0 to 255")
        return np.rint(array * 255.0).astype(np.uint8)
    if low < 0 or high > 255:
        raise InputError(f"{what} has values from {low} to {high}: use 0 to 255 (or dtype uint16 for 16-bit)")
    return array.astype(np.uint8)


def _on_white(rgba: UInt8[np.ndarray, "H W 4"]) -> UInt8[np.ndarray, "H W 3"]:
    alpha = rgba[..., 3:].astype(np.uint32)
    return ((rgba[..., :3] * alpha + 255 * (255 - alpha) + 127) // 255).astype(np.uint8)


def mask_of_pil(image: Image, what: str) -> Int32[np.ndarray, "H W"]:
    """Grey values or palette indices as they are stored: nothing is scaled."""
    _check_pixels(image.width, image.height, what)
    try:
        array = np.asarray(image)
    except Exception as error:
        raise InputError(f"{what} cannot be read ({_one_line(error)}): save it again as PNG") from None
    return mask_of_array(array, what)


def mask_of_array(array: np.ndarray, what: str) -> Int32[np.ndarray, "H W"]:
    if array.ndim == 3 and array.shape[-1] in (1, 2, 3, 4):
        array = _grey(array, what)
    if array.ndim != 2:
        raise InputError(f"{what} has shape {array.shape}: it must be one segment id per pixel, (height, width)")
    height, width = array.shape
    _check_pixels(width, height, what)
    if array.dtype.kind == "f":
        raise InputError(f"{what} has values of type {array.dtype}: ids are integers, use mask.astype(int)")
    if array.min() < 0:
        raise InputError(
            f"{what} has negative ids (down to {array.min()}): use 0 for background, 1, 2, ... for segments"
        )
    if array.max() > MAX_ID:
        raise InputError(f"{what} has ids up to {array.max()}: at most {MAX_ID} is allowed, number them 1, 2, ...")
    return array.astype(np.int32)


def _grey(array: np.ndarray, what: str) -> np.ndarray:
    """The one channel of a mask that was saved as colour, if its channels say the same."""
    channels = array.shape[-1]
    colour = array[..., : 3 if channels >= 3 else 1]
    if (colour != colour[..., :1]).any():
        raise InputError(f"{what} is a colour picture: save it as 8- or 16-bit grey PNG with one id per pixel")
    alpha = array[..., -1][colour[..., 0] > 0] if channels in (2, 4) else array[:0, :0, 0]
    if alpha.size and alpha.min() != alpha.max():
        raise InputError(f"{what} is partly transparent: save it as 8- or 16-bit grey PNG with one id per pixel")
    return colour[..., 0]
