"""Files that are there whole or not at all; for all who write some."""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path

from rightofway.errors import InputError

__all__ = ["write_whole"]


def write_whole(path: str | os.PathLike[str], content: bytes | str) -> None:
    """Write a file so that at every moment it holds what it held before, or all that is new.

    Parameters
    ----------
    path
        Where; a file that is there already is replaced, a device is written to.
    content
        What; text is written as UTF-8.

    Raises
    ------
    InputError
        If it cannot be written; a file that was there before is untouched.
    """
    target = Path(path)
    try:
        data = content.encode() if isinstance(content, str) else content
        if target.exists() and not target.is_file():
            target.write_bytes(data)  # a device, like /dev/stdout
        else:
            _replace(target.resolve(), data)
    except (OSError, ValueError, RuntimeError) as error:  # a loop of links is a RuntimeError
        raise InputError.at("", _why_unwritable(error, target), str(target)) from None


def _replace(target: Path, content: bytes) -> None:
    beside = target.with_name(f".{target.name}.{os.getpid()}.part")
    try:
        beside.write_bytes(content)
        beside.replace(target)
    except BaseException:
        with suppress(OSError):
            beside.unlink()
        raise


def _why_unwritable(error: Exception, target: Path) -> str:
    if isinstance(error, IsADirectoryError):
        return "this is a directory (give a file name in it)"
    if isinstance(error, FileNotFoundError):
        return f"there is no directory {str(target.parent)!r} (make it first)"
    reason = error.strerror if isinstance(error, OSError) else str(error)
    return f"the file cannot be written: {reason} (check the path and its permissions)"
