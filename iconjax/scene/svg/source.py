"""The bytes of an SVG file as text, without trusting them."""

from __future__ import annotations

import codecs
import os
import re
import zlib
from dataclasses import dataclass
from pathlib import Path

from iconjax.errors import InputError
from iconjax.scene.svg.limits import MAX_BYTES

GZIP = b"\x1f\x8b"
BOMS = (
    (codecs.BOM_UTF8, "utf-8"),
    (codecs.BOM_UTF16_LE, "utf-16-le"),
    (codecs.BOM_UTF16_BE, "utf-16-be"),
)
ENCODINGS = ("utf-8", "ascii", "utf-16-le", "utf-16-be", "iso8859-", "cp125", "koi8", "mac-roman")
"""Beginnings of the names of codecs in which every byte stands for one thing."""
_DECLARED = re.compile(rb"""^<\?xml[^>]*?\sencoding\s*=\s*["']([A-Za-z0-9._-]{1,40})["']""")


@dataclass(frozen=True)
class Source:
    """An SVG file's text and how to write it back.

    Attributes:
        data: the file's bytes, unpacked where it was compressed.
        text: the same in UTF-8, without a byte order mark; all offsets count its bytes.
        bom: the byte order mark, b"" where there is none.
        encoding: Python's name of the file's encoding.
        what: how to call the file in an error.
    """

    data: bytes
    text: bytes
    bom: bytes
    encoding: str
    what: str

    def encode(self, text: bytes) -> bytes:
        """UTF-8 `text` as the file stores it.

        Raises:
            InputError: the file's encoding has no such character.
        """
        if self.encoding == "utf-8":
            return self.bom + text
        return self.bom + text.decode("utf-8").encode(self.encoding)


def read_source(source: str | os.PathLike[str] | bytes) -> Source:
    """Read an SVG from a path or from its bytes.

    Raises:
        InputError: it cannot be read, is too large, or its bytes are not text in the encoding it declares.
    """
    if isinstance(source, bytes):
        data, what = source, "the SVG"
    else:
        what = f"the SVG {os.fspath(source)}"
        data = _read(Path(source), what)
    if len(data) > MAX_BYTES:
        raise InputError(f"{what} is too large: at most {MAX_BYTES // 10**6} MB are read")
    if data[:2] == GZIP:
        data = _unpack(data, what)
    if not data.strip():
        raise InputError(f"{what} is empty: give a drawing")
    return _decode(data, what)


def _read(path: Path, what: str) -> bytes:
    if path.is_dir():
        raise InputError(f"{what} is a folder: give the file in it")
    try:
        with open(path, "rb") as stream:
            return stream.read(MAX_BYTES + 1)
    except FileNotFoundError:
        raise InputError(f"{what} does not exist: check the path") from None
    except (OSError, ValueError) as error:
        why = getattr(error, "strerror", None) or str(error)
        raise InputError(f"{what} cannot be read: {why}") from None


def _unpack(data: bytes, what: str) -> bytes:
    unpacker = zlib.decompressobj(wbits=31)
    try:
        out = unpacker.decompress(data, MAX_BYTES + 1)
        out += unpacker.flush(1) if len(out) <= MAX_BYTES and unpacker.eof else b""
    except zlib.error as error:
        raise InputError(f"{what} is compressed and damaged ({error}): save it again") from None
    if len(out) > MAX_BYTES:
        raise InputError(f"{what} unpacks to more than {MAX_BYTES // 10**6} MB: that is no icon")
    if not unpacker.eof:
        raise InputError(f"{what} is compressed and cut short: save it again")
    return out


def _decode(data: bytes, what: str) -> Source:
    bom, encoding = next(((b, e) for b, e in BOMS if data.startswith(b)), (b"", ""))
    if not bom and data[:4] in (b"<\0?\0", b"<\0s\0"):
        encoding = "utf-16-le"
    elif not bom and data[:4] in (b"\0<\0?", b"\0<\0s"):
        encoding = "utf-16-be"
    declared = _DECLARED.match(data[len(bom) :].lstrip())
    if not encoding and declared:
        encoding = _codec(declared[1].decode("ascii"), what)
    encoding = encoding or "utf-8"
    try:
        text = data[len(bom) :].decode(encoding)
    except UnicodeDecodeError as error:
        raise InputError(f"{what} is not {encoding} text at byte {error.start}: save it as UTF-8") from None
    if encoding != "utf-8" and text.encode(encoding) != data[len(bom) :]:
        raise InputError(f"{what} is in {encoding}, which cannot be written back exactly: save it as UTF-8")
    if "\0" in text:
        raise InputError(f"{what} holds NUL characters: it is no SVG text")
    return Source(data, text.encode("utf-8"), bom, encoding, what)


def _codec(name: str, what: str) -> str:
    try:
        codec = codecs.lookup("utf-8" if name.lower() == "us-ascii" else name).name
    except LookupError:
        raise InputError(f"{what} declares the encoding {name!r}, which is unknown: save it as UTF-8") from None
    if codec == "utf-16":
        raise InputError(f"{what} declares UTF-16 but its bytes are not: save it as UTF-8")
    if not codec.startswith(ENCODINGS):
        raise InputError(f"{what} declares the encoding {name!r}, which is not read: save it as UTF-8")
    return codec
