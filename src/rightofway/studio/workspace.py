"""The files of one folder: listed, read and written whole; no path climbs out."""

from __future__ import annotations

import hashlib
import os
import re
import threading
from collections import deque
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import islice
from pathlib import Path, PurePosixPath

from rightofway.errors import InputError
from rightofway.files import remove_abandoned, write_whole
from rightofway.io.content import refuse_special
from rightofway.studio.errors import Refused

MAX_FILES = 2000
"""Files that a list holds; the folder may have more."""

MAX_FOLDERS = 1000
"""Folders that a list looks into."""

MAX_FILE = 20_000_000
"""The largest file that is opened or uploaded [bytes]."""

CLIMBS = re.compile(rb"(^|[/\\])\.\.?($|[/\\])|[\x00-\x1f\\]")
"""Characters that no decoded path contains; files with such names are not listed."""

LONGEST_NAME = 200
"""Characters of a file's or a folder's name."""

KINDS = {
    **dict.fromkeys((".yaml", ".yml", ".json"), "document"),
    **dict.fromkeys((".xlsx", ".xlsm"), "workbook"),
    **dict.fromkeys((".xml", ".graphml", ".geojson", ".csv", ".map"), "layout"),
    ".scen": "scenario",
    ".txt": "document",
    **dict.fromkeys((".png", ".pgm", ".jpg", ".jpeg", ".bmp", ".webp"), "picture"),
}
"""Which files a list holds, by their endings; what is in them is seen when they are opened."""

UNSAFE = re.compile(r"[\x00-\x1f\x7f\\:*?\"<>|]")
"""Characters that some system reads as something else than a part of a name: no file gets such a
name here, but one that has it is opened and saved as others."""


@dataclass(frozen=True, slots=True)
class Entry:
    """A file in a list.

    Attributes
    ----------
    path
        From the folder on, with ``/`` between names.
    kind
        ``document``, ``workbook``, ``layout``, ``scenario`` or ``picture``.
    size
        In bytes.
    modified
        In seconds since 1970.
    """

    path: str
    kind: str
    size: int
    modified: float


class Workspace:
    """The folder that the studio was given.

    Parameters
    ----------
    folder
        The folder; it must be there.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder.resolve(strict=True)
        self._writing = threading.Lock()

    def find_path(self, name: str) -> Path:
        """Return where a file is, or would be.

        Raises
        ------
        Refused
            For a path that is absolute, climbs, is hidden, or leads through a symbolic link; for
            that of a new file also if some system cannot have such a name.
        """
        given = PurePosixPath(name)
        parts = given.parts
        path = self.folder.joinpath(*parts)
        is_plain = bool(parts) and name == "/".join(parts) and path.is_relative_to(self.folder)
        if not is_plain or not _may_be_address(name):
            raise Refused(f"{name!r} is no path in the folder (give names with / between)")
        if any(part.startswith(".") for part in parts):
            raise Refused(f"{name!r} has a hidden part (give names that begin with no dot)")
        for count, part in enumerate(parts, 1):
            if not os.path.lexists(self.folder.joinpath(*parts[:count])):
                _refuse_unportable(part)
        if _resolve_path(path) != path:
            raise Refused(f"{name!r} leads through a symbolic link (give the file itself)")
        return path

    def find_existing(self, name: str) -> Path:
        """Return where a file is that can be read.

        Raises
        ------
        Refused
            As `find_path`, or if there is no such file, or it is too large.
        """
        path = self.find_path(name)
        if not path.is_file():
            raise Refused(f"there is no file {name!r} in the folder (see the list)", 404)
        size = path.stat().st_size
        if size > MAX_FILE:
            raise Refused(f"{name!r} has {size} bytes (at most {MAX_FILE} are opened)", 413)
        return path

    def read(self, name: str) -> bytes:
        """Return the content of a file; refused as by `find_existing`."""
        return self.find_existing(name).read_bytes()

    def write(self, name: str, content: bytes, *, revision: str | None = None) -> str:
        """Write a file whole, and return its revision.

        Raises
        ------
        Refused
            As `find_path`; or if the file holds something else by now.
        InputError
            If it cannot be written, or is a device or a pipe.
        """
        path = self.find_path(name)
        refuse_special(path)  # a pipe without a reader would block this and all later writes
        with self._writing:
            if revision is not None and revision != (self.compute_revision(name) or ""):
                was = "was changed by another program" if revision else "is there already"
                raise Refused(f"{name!r} {was} (open it again, or save under another name)", 412)
            try:
                write_whole(path, content)
            except InputError as error:
                raise InputError(fault.name_file(name) for fault in error.faults) from None
        return compute_revision(content)

    def compute_revision(self, name: str) -> str | None:
        """Return a text that changes with the content of a file; None where there is none."""
        path = self.find_path(name)
        return compute_revision(path.read_bytes()) if path.is_file() else None

    def list_files(self) -> tuple[list[Entry], bool]:
        """Return the files that may be opened, in the order of their paths, and whether all.

        Folders near the top come first; a list that is not whole lacks files far inside.
        """
        entries, is_whole = list[Entry](), True
        for seen, inside in enumerate(self._visit_folders()):
            if seen == MAX_FOLDERS or len(entries) >= MAX_FILES:
                is_whole = False
                break
            entries += self._list_opened(inside)
        entries.sort(key=lambda entry: entry.path)
        return entries[:MAX_FILES], is_whole and len(entries) <= MAX_FILES

    def remove_abandoned(self) -> None:
        """Remove files that programs were writing into the folder when they were killed."""
        for inside in islice(self._visit_folders(), MAX_FOLDERS):
            for entry in inside:
                remove_abandoned(Path(entry.path))

    def _visit_folders(self) -> Iterator[list[os.DirEntry[str]]]:
        """Yield the entries of folders except symbolic links; folders near the top come first."""
        folders = deque([self.folder])
        while folders:
            try:
                entries = sorted(os.scandir(folders.popleft()), key=lambda entry: entry.name)
            except OSError:
                continue  # a folder that may not be read has nothing to open
            inside = [entry for entry in entries if not entry.is_symlink()]
            folders += [
                Path(entry.path)
                for entry in inside
                if not entry.name.startswith(".") and entry.is_dir(follow_symlinks=False)
            ]
            yield inside

    def _list_opened(self, inside: Iterable[os.DirEntry[str]]) -> Iterator[Entry]:
        """Yield the files of one folder that may be opened."""
        for entry in inside:
            kind = KINDS.get(Path(entry.name).suffix.lower())
            name = Path(entry.path).relative_to(self.folder).as_posix()
            if not kind or entry.name.startswith(".") or not _may_be_address(name):
                continue
            if entry.is_file(follow_symlinks=False):
                stat = entry.stat(follow_symlinks=False)
                yield Entry(name, kind, stat.st_size, stat.st_mtime)


def _may_be_address(name: str) -> bool:
    """Return whether an address may have the name; it must be whole Unicode text for that, too."""
    try:
        return not CLIMBS.search(name.encode())
    except UnicodeEncodeError:
        return False


def make_portable(name: str) -> str:
    """Return the name of a file or a path in the folder as every system can have it."""
    return "".join("-" if UNSAFE.match(sign) or not sign.isprintable() else sign for sign in name)


def _refuse_unportable(part: str) -> None:
    """Refuse the name of a new file or folder that some system cannot have."""
    if part != make_portable(part) or part.endswith((".", " ")):
        remedy = 'leave out \\ : * ? " < > | and what cannot be printed; end in no dot or space'
        raise Refused(f"{part!r} is no name of a file on every system ({remedy})")
    if len(os.fsencode(part)) > LONGEST_NAME:
        raise Refused(f"a name in the path is longer than {LONGEST_NAME} bytes (shorten it)")


def _resolve_path(path: Path) -> Path | None:
    """Return where a path leads; None for links that lead in a circle."""
    try:
        return path.resolve()
    except (OSError, RuntimeError):
        return None


def compute_revision(content: bytes) -> str:
    """Return a text that changes with the content."""
    return hashlib.sha256(content).hexdigest()[:16]
