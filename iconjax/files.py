"""Writing files: a file appears whole or not at all, and what goes wrong is one `InputError`."""

from __future__ import annotations

import os
import tempfile
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

from iconjax.errors import InputError

if TYPE_CHECKING:
    import numpy as np
    from jaxtyping import UInt

IMAGE_SUFFIXES = {
    ".png": "PNG",
    ".jpg": "JPEG",
    ".jpeg": "JPEG",
    ".webp": "WEBP",
    ".bmp": "BMP",
    ".tif": "TIFF",
    ".tiff": "TIFF",
}
"""Image formats that can be written, by file name ending."""


def write_bytes(path: str | os.PathLike[str], data: bytes) -> None:
    """Write `data` to `path`, replacing what was there only once everything is on disk.

    Raises:
        InputError: the folder is missing or not writable, `path` is a folder, or the disk is full; no
            half-written file is left behind.
    """
    target = _target(path)
    try:
        if target.exists() and not target.is_file() and not target.is_dir():
            target.write_bytes(data)  # a device or a pipe cannot be replaced
        else:
            _replace(target, data)
    except OSError as error:
        raise InputError(f"cannot write {path}: {describe(error)}") from error


def write_text(path: str | os.PathLike[str], text: str) -> None:
    """Write `text` as UTF-8 to `path`; see `write_bytes`."""
    write_bytes(path, text.encode("utf-8"))


def check_writable(path: str | os.PathLike[str]) -> None:
    """Find out before the long work that `path` cannot be written.

    Raises:
        InputError: as `write_bytes` would, as far as that shows beforehand.
    """
    target = _target(path)
    try:
        if target.is_dir():
            raise IsADirectoryError(21, "it is a folder")
        if not target.exists():
            _probe(target.parent)
        elif not os.access(target, os.W_OK):
            raise PermissionError(13, "permission denied")
    except OSError as error:
        raise InputError(f"cannot write {path}: {describe(error)}") from error


def image_format(path: str | os.PathLike[str]) -> str:
    """Pillow's name of the image format that the ending of `path` stands for.

    Raises:
        InputError: the ending is missing or unknown.
    """
    suffix = Path(path).suffix.lower()
    if suffix not in IMAGE_SUFFIXES:
        raise InputError(f"cannot write {path}: the name of an image ends in one of {', '.join(IMAGE_SUFFIXES)}")
    return IMAGE_SUFFIXES[suffix]


def encode_image(pixels: UInt[np.ndarray, "H W *c"], kind: str = "PNG") -> bytes:
    """A picture or a label map in the file format that Pillow calls `kind`."""
    import io

    import numpy as np
    from PIL import Image

    stream = io.BytesIO()
    options: dict[str, Any] = {"quality": 95} if kind in ("JPEG", "WEBP") else {}
    Image.fromarray(np.ascontiguousarray(pixels)).save(stream, kind, **options)
    return stream.getvalue()


def describe(error: OSError) -> str:
    """What went wrong, in lower case and without the errno."""
    text = error.strerror or str(error) or type(error).__name__
    return text[:1].lower() + text[1:]


def _target(path: str | os.PathLike[str]) -> Path:
    """The file itself where `path` is a link to it, so that the link keeps pointing where it points."""
    try:
        return Path(os.path.realpath(path))
    except (OSError, ValueError) as error:  # a link to itself, a NUL character
        raise InputError(f"cannot write {str(path)!r}: {error}") from error


def _replace(target: Path, data: bytes) -> None:
    if target.is_dir():
        raise IsADirectoryError(21, "it is a folder")
    handle, name = tempfile.mkstemp(prefix=f".{target.name[:40]}.", suffix=".part", dir=target.parent)
    try:
        with os.fdopen(handle, "wb") as stream:
            stream.write(data)
            stream.flush()
            os.fsync(stream.fileno())
        os.chmod(name, _mode(target))
        os.replace(name, target)
    except BaseException:
        with suppress(OSError):
            os.unlink(name)
        raise


def _probe(folder: Path) -> None:
    handle, name = tempfile.mkstemp(prefix=".iconjax.", suffix=".part", dir=folder)
    os.close(handle)
    os.unlink(name)


def _mode(target: Path) -> int:
    """Permissions of the file that is replaced, or what a new file gets (temporary files are private)."""
    if target.exists():
        return target.stat().st_mode & 0o777
    mask = os.umask(0)
    os.umask(mask)
    return 0o666 & ~mask
