"""The journal of a control: entries that are on the disk before anything is sent.

One process may have a journal open. There is no journal in memory: without a journal, nobody knows
what robots hold.
"""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any, Protocol

from rightofway.errors import InputError, shown

Entry = Mapping[str, Any]
"""A journal entry as JSON has it, with its ``kind``."""


class JournalFailed(Exception):
    """An entry could not be written; nothing that depends on it may be sent."""


class Journal(Protocol):
    """What is only ever appended to."""

    def entries(self) -> Iterable[Entry]:
        """Return all entries in their order."""

    def commit(self, entries: Iterable[Entry]) -> None:
        """Append entries, all or none; on return they outlive the process and the machine.

        Raises
        ------
        JournalFailed
            If they could not be written.
        """


class SqliteJournal:
    """A journal in a file of SQLite, locked for other processes.

    Parameters
    ----------
    path
        The file; it is made where there is none.

    Raises
    ------
    InputError
        If the file is no journal, cannot be written, or is open in another process.
    """

    def __init__(self, path: Path) -> None:
        try:
            self._database = sqlite3.connect(path, timeout=0.5, isolation_level=None)
        except sqlite3.Error as error:
            raise self._refused(path, error) from error
        try:
            self._database.execute("PRAGMA locking_mode = EXCLUSIVE")
            self._database.execute("PRAGMA journal_mode = WAL")
            self._database.execute("PRAGMA synchronous = FULL")
            self._database.execute(
                "CREATE TABLE IF NOT EXISTS entries (number INTEGER PRIMARY KEY, entry TEXT)"
            )
            self._database.execute("BEGIN IMMEDIATE")  # takes the lock, which is kept
            self._database.execute("COMMIT")
        except sqlite3.Error as error:
            self._database.close()
            raise self._refused(path, error) from error

    @staticmethod
    def _refused(path: Path, error: sqlite3.Error) -> InputError:
        remedy = "name another file, or stop the process that has it open"
        return InputError.at(str(path), f"cannot be used as a journal: {error} ({remedy})")

    def entries(self) -> Iterator[Entry]:
        """Yield all entries in their order."""
        for number, text in self._database.execute("SELECT number, entry FROM entries ORDER BY 1"):
            try:
                yield json.loads(text)
            except ValueError as error:
                message = f"{shown(text)} is no entry of a journal (name another file)"
                raise InputError.at(f"entry {number}", message) from error

    def commit(self, entries: Iterable[Entry]) -> None:
        """Append entries in one transaction."""
        rows = [(json.dumps(entry, separators=(",", ":")),) for entry in entries]
        try:
            self._database.execute("BEGIN IMMEDIATE")
            try:
                self._database.executemany("INSERT INTO entries (entry) VALUES (?)", rows)
                self._database.execute("COMMIT")
            except BaseException:
                if self._database.in_transaction:
                    self._database.execute("ROLLBACK")
                raise
        except sqlite3.Error as error:
            raise JournalFailed(str(error)) from error

    def close(self) -> None:
        """Give the file free."""
        self._database.close()
