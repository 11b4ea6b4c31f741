"""Content of files, pipes and standard input: bytes and UTF-8 text, with limits of size."""

from __future__ import annotations

import os
import re
import stat
import sys
from pathlib import Path
from typing import BinaryIO
from weakref import WeakKeyDictionary

from rightofway.errors import InputError, Location, name_file, quote
from rightofway.io.plain_data import LONGEST_TOKEN

MAX_BYTES = 2**29
"""Largest file that is read [bytes]."""

LIMIT = "RIGHTOFWAY_MOST_CHARACTERS"
"""The variable of the environment that raises the limit on layouts."""

MAX_CHARACTERS = 60_000_000
"""The longest layout that is read without it: a file takes twenty times its size of memory."""

PICTURES = (b"P5", b"P2", b"P6", b"\x89PNG", b"BM", b"\xff\xd8", b"GIF8")
"""How pictures begin."""

_FORMAT_KEY = re.compile(r"""^[ \t{]*["']?format["']?[ \t]*:""", re.MULTILINE)

PIECE = 2**20
"""Size of one read from a file [bytes]."""


def read_text(path: Path) -> str:
    """Return the text of a file, UTF-8 with any kind of line end; ``-`` is standard input."""
    source = str(path)
    with name_file(source):
        data = read_content(path)
    if not data or data.isspace():
        raise InputError.at("", "the file is empty (give it some content)", source)
    return _decode(data, source).replace("\r\n", "\n").replace("\r", "\n")


def read_content(path: Path, most: int | None = None) -> bytes | bytearray:
    """Return the bytes of a file, a pipe, or of standard input as ``-``.

    Raises
    ------
    InputError
        If it cannot be read, is a device or a directory, or is longer.

    Notes
    -----
    A pipe can be read only once: its content is kept.
    """
    most = MAX_BYTES if most is None else most
    try:
        if str(path) == "-":
            data = _STREAMS.get(sys.stdin.buffer)
            if data is None:
                data = _STREAMS[sys.stdin.buffer] = _read_content(sys.stdin.buffer, most)
        else:
            data = _read_file_content(path, most)
    except InputError:
        raise
    except (OSError, ValueError) as error:
        raise InputError.at("", _explain_unreadable(error, path)) from None
    if len(data) > most:
        raise _make_too_long(most)
    return data


_STREAMS: WeakKeyDictionary[BinaryIO, bytearray] = WeakKeyDictionary()
"""Content of each standard input."""

_PIPES: dict[tuple[int, int], bytearray] = {}
"""Content of each pipe, by device and number."""


def _read_file_content(path: Path, most: int) -> bytearray:
    status = path.stat()
    if stat.S_ISDIR(status.st_mode):
        raise IsADirectoryError
    is_pipe = stat.S_ISFIFO(status.st_mode) or stat.S_ISSOCK(status.st_mode)
    if not (is_pipe or stat.S_ISREG(status.st_mode)):
        raise InputError.at("", "this is a device (give a file)")
    if status.st_size > most:
        raise _make_too_long(most)
    key = status.st_dev, status.st_ino
    if is_pipe and key in _PIPES:
        return _PIPES[key]
    with path.open("rb") as file:
        data = _read_content(file, most)
    if is_pipe:
        _PIPES[key] = data
    return data


def _read_content(file: BinaryIO, most: int) -> bytearray:
    """Return the bytes of a file up to the limit, in pieces: one read reserves all that it asks."""
    content = bytearray()
    while len(content) <= most and (piece := file.read(PIECE)):
        content += piece
    return content


def _make_too_long(most: int) -> InputError:
    return InputError.at("", f"the file is longer than {most} bytes (is it the right one?)")


def choose_limit() -> int:
    """Return how long a layout may be: a limit on the memory that reading it takes."""
    given = os.environ.get(LIMIT)
    if given is None:
        return MAX_CHARACTERS
    if not given.isascii() or not given.isdecimal() or len(given) > LONGEST_TOKEN:
        raise InputError.at("", f"{LIMIT} is {quote(given)} (give a number of characters)")
    return int(given)


def refuse_long(text: str) -> None:
    """Refuse a layout whose reading would take gigabytes.

    Raises
    ------
    InputError
        If it is longer than `choose_limit`.
    """
    if len(text) > choose_limit():
        message = f"the file has {len(text)} characters, more than {choose_limit()}, and takes"
        message += f" about {20 * len(text) // 10**6} MB to read"
        raise InputError.at("", f"{message} (set {LIMIT}={len(text)} if you have them)")


def refuse_picture(path: Path) -> None:
    """Refuse a picture, recognized by its first bytes.

    Raises
    ------
    InputError
        If it is one.
    """
    if not is_regular(path):
        return  # reading the text says why
    try:
        with path.open("rb") as file:
            begin = file.read(8)
    except (OSError, ValueError):
        return
    if begin.startswith(PICTURES):
        message = "this is a picture (give the YAML file beside it, which has its resolution)"
        raise InputError.at("", message)


def is_own_document(text: str) -> bool:
    """Return whether a text has the key that all documents of this package have."""
    return _FORMAT_KEY.search(text) is not None


def is_regular(path: Path) -> bool:
    """Return whether a file is there, and is no directory, device or pipe."""
    return os.path.isfile(path)  # noqa: PTH113 - Path.is_file raises for a name that is too long


def refuse_special(path: Path) -> None:
    """Refuse a device or a pipe where a document names a file.

    Raises
    ------
    InputError
        If it is there, and is not a file like others.
    """
    if str(path) == "-":  # readers take it for standard input
        raise InputError.at("", "'-' names no file here (name a file)")
    is_there = os.path.exists(path)  # noqa: PTH110 - Path.exists raises for a long name
    if is_there and not (is_regular(path) or path.is_dir()):
        message = f"{quote(str(path))} is a device or a pipe, not a file (name a file)"
        raise InputError.at("", message)


def find_remedy_for_missing(path: Path) -> str:
    """Return the remedy for a file that is not there."""
    if path.parts[:1] == ("examples",):
        return "rightofway examples --copy . writes the examples"
    return "check the path"


def _explain_unreadable(error: Exception, path: Path) -> str:
    if isinstance(error, FileNotFoundError):
        return f"there is no such file ({find_remedy_for_missing(path)})"
    if isinstance(error, IsADirectoryError):
        return "this is a directory (give a file in it)"
    reason = error.strerror if isinstance(error, OSError) else str(error)
    return f"the file cannot be read: {reason} (check the path and its permissions)"


def _decode(data: bytes | bytearray, source: str) -> str:
    if data.startswith((b"\xff\xfe", b"\xfe\xff")):
        raise InputError.at("", "the file is UTF-16 text (save it as UTF-8)", source)
    if b"\0" in data:
        at = data.index(b"\0")
        raise InputError.at("", f"the file is not text: byte {at} is 0 (give a text file)", source)
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        message = f"byte {data[error.start]:#x} is not UTF-8 (save the file as UTF-8)"
        raise InputError.at(Location(line=line), message, source) from None
