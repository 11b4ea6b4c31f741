"""Text files, read strictly."""

from __future__ import annotations

import sys
from pathlib import Path

from rightofway.errors import InputError

__all__ = ["MAX_BYTES", "read_text"]

MAX_BYTES = 2**29
"""A larger file than this is refused."""

_BYTE_ORDER_MARKS = {b"\xff\xfe": "UTF-16", b"\xfe\xff": "UTF-16"}


def read_text(path: Path) -> str:
    """Return the text of a file, UTF-8 with any kind of line end; ``-`` is standard input.

    Raises
    ------
    InputError
        If it cannot be read, is empty, too long, or no UTF-8 text.
    """
    source = str(path)
    try:
        data = _read(path, MAX_BYTES + 1)
    except (OSError, ValueError) as error:
        raise InputError.at("", _why_unreadable(error), source) from None
    if not data.strip():
        raise InputError.at("", "the file is empty (give it some content)", source)
    if len(data) > MAX_BYTES:
        message = f"the file is longer than {MAX_BYTES} bytes (is it the right one?)"
        raise InputError.at("", message, source)
    return _decoded(data, source).replace("\r\n", "\n").replace("\r", "\n")


def _read(path: Path, size: int) -> bytes:
    if str(path) == "-":
        return sys.stdin.buffer.read(size)
    with path.open("rb") as file:
        return file.read(size)


def _why_unreadable(error: Exception) -> str:
    if isinstance(error, FileNotFoundError):
        return "there is no such file (check the path)"
    if isinstance(error, IsADirectoryError):
        return "this is a directory (give a file in it)"
    reason = error.strerror if isinstance(error, OSError) else str(error)
    return f"the file cannot be read: {reason} (check the path and its permissions)"


def _decoded(data: bytes, source: str) -> str:
    encoding = _BYTE_ORDER_MARKS.get(data[:2])
    if encoding:
        raise InputError.at("", f"the file is {encoding} text (save it as UTF-8)", source)
    if b"\0" in data:
        at = data.index(b"\0")
        raise InputError.at("", f"the file is not text: byte {at} is 0 (give a text file)", source)
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        message = f"line {line}: byte {data[error.start]:#x} is not UTF-8 (save the file as UTF-8)"
        raise InputError.at("", message, source) from None
