"""Files that are there whole or not at all, and archives without dates; for all who write some."""

from __future__ import annotations

import os
import re
from collections.abc import Callable
from contextlib import suppress
from io import BytesIO
from pathlib import Path

from rightofway.errors import InputError, quote

__all__ = ["as_path", "make_archive", "write_whole"]

NO_DATE = (1980, 1, 1, 0, 0, 0)
"""The first date that a zip archive can hold."""

SAVED = re.compile(rb"(<dcterms:(?:created|modified)[^>]*>)[^<]*")
"""When a workbook was written, by its own account."""


def make_archive(save: Callable[[BytesIO], object]) -> bytes:
    """Return a workbook, which is a zip archive, without the dates at which it was written.

    Parameters
    ----------
    save
        Writes the archive into a buffer. Equal content gives equal bytes.
    """
    dated, undated = BytesIO(), BytesIO()
    save(dated)
    from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

    with ZipFile(dated) as source, ZipFile(undated, "w") as target:
        for name in source.namelist():
            content = SAVED.sub(rb"\g<1>1980-01-01T00:00:00Z", source.read(name))
            target.writestr(ZipInfo(name, NO_DATE), content, ZIP_DEFLATED)
    return undated.getvalue()


def as_path(given: str | os.PathLike[str], place: str = "path") -> Path:
    """Return what a caller gave as the path of a file.

    Parameters
    ----------
    given
        Anything.
    place
        The name of the argument.

    Raises
    ------
    InputError
        If it is neither text nor a path.
    """
    try:
        return Path(given)
    except TypeError:
        raise InputError.at(place, f"{quote(given)} is no path (give text or a Path)") from None


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
    target = as_path(path)
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
        with beside.open("wb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())  # or a machine that goes down could leave an empty file
        beside.replace(target)
        with suppress(OSError):  # some systems cannot open a directory, or need not
            _synchronize(target.parent)
    except BaseException:
        with suppress(OSError):
            beside.unlink()
        raise


def _synchronize(directory: Path) -> None:
    """Wait until the names in a directory are on the disk."""
    opened = os.open(directory, os.O_RDONLY)
    try:
        os.fsync(opened)
    finally:
        os.close(opened)


def _why_unwritable(error: Exception, target: Path) -> str:
    if isinstance(error, IsADirectoryError):
        return "this is a directory (give a file name in it)"
    if isinstance(error, FileNotFoundError):
        return f"there is no directory {str(target.parent)!r} (make it first)"
    reason = error.strerror if isinstance(error, OSError) else str(error)
    return f"the file cannot be written: {reason} (check the path and its permissions)"
