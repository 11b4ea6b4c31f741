"""Files that are there whole or not at all, and archives without dates; for all who write some."""

from __future__ import annotations

import os
import re
import time
from collections.abc import Callable
from contextlib import suppress
from glob import escape
from io import BytesIO
from pathlib import Path
from stat import S_ISREG

from rightofway.errors import InputError, quote

try:
    import fcntl
except ImportError:  # pragma: no cover (not on Windows)
    fcntl = None  # type: ignore[assignment]

__all__ = ["as_path", "make_archive", "remove_abandoned", "take_lock", "write_whole"]

NO_DATE = (1980, 1, 1, 0, 0, 0)
"""The first date that a zip archive can hold."""

PART = re.compile(r"\.(?P<name>.+)\.[0-9]+\.part", re.DOTALL)
"""Names of files that are being written, each with the name of its target."""

LONGEST_IN_PART = 230
"""Bytes of the target's name in such a name: systems allow 255 in all."""

MAY_BE_LOCKED_SOON = 1.0
"""The time within which a program locks a file that it has just made, with much to spare [s]."""

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
    """Return the path of a file that a caller gave.

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
    """Write a file so that at every moment it holds its old content or all of the new one.

    Parameters
    ----------
    path
        Where; a file that is there already is replaced, a device is written to.
    content
        The content; text is written as UTF-8.

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
        raise InputError.at("", _explain_unwritable(error, target), str(target)) from None


def take_lock(descriptor: int) -> bool:
    """Lock an open file until it is closed, also by the end of the process.

    Returns
    -------
    bool
        False where another program has it locked, or its file system has no locks. True on
        Windows, where a file that is open cannot be removed.
    """
    try:
        if fcntl is not None:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        return False
    return True


def remove_abandoned(part: Path) -> None:
    """Remove a file that a program was writing when it was killed.

    Parameters
    ----------
    part
        Any path. A file with another name than those of `write_whole`, or that a running program
        still writes, is not changed.
    """
    with suppress(OSError):  # it cannot be read or removed, or is gone
        status = part.lstat()
        is_new = not status.st_size and time.time() - status.st_mtime < MAY_BE_LOCKED_SOON
        if not PART.fullmatch(part.name) or not S_ISREG(status.st_mode) or is_new:
            return
        with part.open("rb") as file:
            is_abandoned = take_lock(file.fileno())
        if is_abandoned:
            part.unlink()


def _replace(target: Path, content: bytes) -> None:
    name = os.fsdecode(os.fsencode(target.name)[:LONGEST_IN_PART])
    beside = target.with_name(f".{name}.{os.getpid()}.part")
    for part in target.parent.glob(f".{escape(name)}.*.part"):
        remove_abandoned(part)
    try:
        with beside.open("wb") as file:
            take_lock(file.fileno())  # so that no other program takes it for abandoned
            file.write(content)
            file.flush()
            os.fsync(file.fileno())  # or a machine that goes down could leave an empty file
        beside.replace(target)
        with suppress(OSError):  # some systems cannot open a directory, or need not
            _flush_directory(target.parent)
    except BaseException:
        with suppress(OSError):
            beside.unlink()
        raise


def _flush_directory(directory: Path) -> None:
    """Wait until the names in a directory are on the disk."""
    opened = os.open(directory, os.O_RDONLY)
    try:
        os.fsync(opened)
    finally:
        os.close(opened)


def _explain_unwritable(error: Exception, target: Path) -> str:
    if isinstance(error, IsADirectoryError):
        return "this is a directory (give a file name in it)"
    if isinstance(error, FileNotFoundError):
        return f"there is no directory {str(target.parent)!r} (make it first)"
    reason = error.strerror if isinstance(error, OSError) else str(error)
    return f"the file cannot be written: {reason} (check the path and its permissions)"
