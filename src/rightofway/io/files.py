"""Text files: read whole and strictly, written whole or not at all."""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path

from rightofway.errors import InputError

__all__ = ["MAX_BYTES", "read_text", "write_text"]

MAX_BYTES = 2**29
"""A larger file than this is refused."""

_BYTE_ORDER_MARKS = {b"\xff\xfe": "UTF-16", b"\xfe\xff": "UTF-16"}


def read_text(path: Path) -> str:
    """Return the text of a file, UTF-8 with any kind of line end.

    Raises
    ------
    InputError
        If it cannot be read, is empty, too long, or no UTF-8 text.
    """
    source = str(path)
    try:
        with path.open("rb") as file:
            data = file.read(MAX_BYTES + 1)
    except (OSError, ValueError) as error:
        raise InputError.at("", _why_unreadable(error), source) from None
    if not data.strip():
        raise InputError.at("", "the file is empty (give it some content)", source)
    if len(data) > MAX_BYTES:
        message = f"the file is longer than {MAX_BYTES} bytes (is it the right one?)"
        raise InputError.at("", message, source)
    return _decoded(data, source).replace("\r\n", "\n").replace("\r", "\n")


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


def write_text(path: Path, text: str) -> None:
    """Write a file whole: at every moment it holds either what it held before, or the new text.

    Raises
    ------
    InputError
        If it cannot be written.
    """
    try:
        if path.exists() and not path.is_file():
            path.write_text(text, encoding="utf-8", newline="\n")  # a device, like /dev/stdout
        else:
            _replace(path.resolve(), text)
    except (OSError, ValueError, RuntimeError) as error:  # a loop of links is a RuntimeError
        raise InputError.at("", _why_unwritable(error, path), str(path)) from None


def _replace(path: Path, text: str) -> None:
    beside = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        beside.write_text(text, encoding="utf-8", newline="\n")
        beside.replace(path)
    except BaseException:
        with suppress(OSError):
            beside.unlink()
        raise


def _why_unwritable(error: Exception, path: Path) -> str:
    if isinstance(error, IsADirectoryError):
        return "this is a directory (give a file name in it)"
    if isinstance(error, FileNotFoundError):
        return f"there is no directory {str(path.parent)!r} (make it first)"
    reason = error.strerror if isinstance(error, OSError) else str(error)
    return f"the file cannot be written: {reason} (check the path and its permissions)"
