"""The files of one folder: listed, read and written whole; no path climbs out."""

from __future__ import annotations

import hashlib
import os
import re
import threading
from collections import deque
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

from rightofway.errors import InputError
from rightofway.files import write_whole
from rightofway.studio.errors import Refused

MAX_FILES = 2000
"""Files that a list holds; the folder may have more."""

MAX_FOLDERS = 1000
"""Folders that a list looks into."""

MAX_FILE = 20_000_000
"""The largest file that is opened or uploaded [bytes]."""

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
"""Characters that some system reads as something else than a part of a name."""


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
        """Return where a file is.

        Raises
        ------
        Refused
            For a path that is absolute, climbs, is hidden, or leads through a symbolic link.
        """
        given = PurePosixPath(name)
        parts = given.parts
        is_plain = bool(parts) and name == "/".join(parts) and not given.is_absolute()
        if not is_plain or UNSAFE.search(name) or not name.isprintable():
            raise Refused(f"{name!r} is no path in the folder (give names with / between)")
        if any(part.startswith(".") or part.endswith((".", " ")) for part in parts):
            raise Refused(f"{name!r} has a hidden part (give names that begin with no dot)")
        if any(len(os.fsencode(part)) > LONGEST_NAME for part in parts):
            raise Refused(f"a name in the path is longer than {LONGEST_NAME} bytes (shorten it)")
        path = self.folder.joinpath(*parts)
        if _resolved(path) != path:
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
            If it cannot be written.
        """
        path = self.find_path(name)
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
        entries, folders, seen = list[Entry](), deque([self.folder]), 0
        while folders and len(entries) < MAX_FILES and seen < MAX_FOLDERS:
            files, inside = self._listed(folders.popleft())
            entries += files
            folders += inside
            seen += 1
        entries.sort(key=lambda entry: entry.path)
        return entries[:MAX_FILES], not folders and len(entries) <= MAX_FILES

    def _listed(self, folder: Path) -> tuple[list[Entry], list[Path]]:
        """Return the files of one folder that may be opened, and the folders in it."""
        files, folders = list[Entry](), list[Path]()
        try:
            inside = sorted(os.scandir(folder), key=lambda entry: entry.name)
        except OSError:
            return [], []  # a folder that may not be read has nothing to open
        for entry in inside:
            if entry.name.startswith(".") or entry.is_symlink():
                continue
            kind = KINDS.get(Path(entry.name).suffix.lower())
            if entry.is_dir(follow_symlinks=False):
                folders.append(Path(entry.path))
            elif kind and entry.is_file(follow_symlinks=False):
                stat = entry.stat(follow_symlinks=False)
                name = Path(entry.path).relative_to(self.folder).as_posix()
                files.append(Entry(name, kind, stat.st_size, stat.st_mtime))
        return files, folders


def _resolved(path: Path) -> Path | None:
    """Return where a path leads; None for links that lead in a circle."""
    try:
        return path.resolve()
    except (OSError, RuntimeError):
        return None


def compute_revision(content: bytes) -> str:
    """Return a text that changes with the content."""
    return hashlib.sha256(content).hexdigest()[:16]
