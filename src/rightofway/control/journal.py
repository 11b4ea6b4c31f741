"""The journal of a control: entries that are on the disk before anything is sent.

One process may have a journal open. There is no journal in memory: without a journal, nobody knows
what robots hold.
"""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
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
        """Return all entries in their order, from the last snapshot on."""

    def commit(self, entries: Iterable[Entry]) -> None:
        """Append entries, all or none; on return they outlive the process and the machine.

        Raises
        ------
        JournalFailed
            If they could not be written.
        """

    def begin_again(self, snapshot: Entry) -> None:
        """Append a snapshot, which says all that the entries before it say together.

        Entries from before the last snapshot but one may go, so that a journal stays small.

        Raises
        ------
        JournalFailed
            If it could not be written.
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
            self._database.execute("CREATE TABLE IF NOT EXISTS snapshots (number INTEGER)")
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
        """Yield all entries in their order, from the last snapshot on."""
        last = self._database.execute("SELECT max(number) FROM snapshots").fetchone()[0]
        return self._entries(last or 0)

    def history(self) -> Iterator[Entry]:
        """Yield all entries that are still kept, in their order."""
        return self._entries(0)

    def _entries(self, first: int) -> Iterator[Entry]:
        rows = self._database.execute(
            "SELECT number, entry FROM entries WHERE number >= ? ORDER BY 1", (first,)
        )
        for number, text in rows:
            try:
                yield json.loads(text)
            except ValueError as error:
                message = f"{shown(text)} is no entry of a journal (name another file)"
                raise InputError.at(("entry", number), message) from error

    def commit(self, entries: Iterable[Entry]) -> None:
        """Append entries in one transaction."""
        with self._transaction() as database:
            rows = [(_text_of(entry),) for entry in entries]
            database.executemany("INSERT INTO entries (entry) VALUES (?)", rows)

    def begin_again(self, snapshot: Entry) -> None:
        """Append a snapshot; drop the entries from before the last snapshot but one."""
        with self._transaction() as database:
            query = "INSERT INTO entries (entry) VALUES (?)"
            number = database.execute(query, (_text_of(snapshot),)).lastrowid
            last = database.execute("SELECT max(number) FROM snapshots").fetchone()[0] or 0
            database.execute("DELETE FROM entries WHERE number < ?", (last,))
            database.execute("DELETE FROM snapshots WHERE number < ?", (last,))
            database.execute("INSERT INTO snapshots VALUES (?)", (number,))

    @contextmanager
    def _transaction(self) -> Iterator[sqlite3.Connection]:
        """Write all that is executed, or nothing of it."""
        try:
            self._database.execute("BEGIN IMMEDIATE")
            try:
                yield self._database
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


class BatchedJournal:
    """A journal whose entries reach the disk together, when `flush` is called.

    What depends on an entry may be sent only after a flush that did not fail. Entries whose flush
    has failed are tried again by the next one.

    Parameters
    ----------
    journal
        Where they go.
    """

    def __init__(self, journal: Journal) -> None:
        self._journal = journal
        self._pending: list[Entry] = []
        self._snapshot: Entry | None = None  # of all before the pending entries

    def entries(self) -> Iterable[Entry]:
        """Return all entries that are on the disk, from the last snapshot on."""
        return self._journal.entries()

    def commit(self, entries: Iterable[Entry]) -> None:
        """Append entries; they are not on the disk yet."""
        self._pending += entries

    def begin_again(self, snapshot: Entry) -> None:
        """Append a snapshot, in place of entries that are not on the disk yet."""
        self._pending, self._snapshot = [], snapshot

    def flush(self) -> None:
        """Bring all entries to the disk, in one transaction behind a snapshot, if there is one.

        Raises
        ------
        JournalFailed
            If they could not be written; they are kept for the next flush.
        """
        if self._snapshot is not None:
            self._journal.begin_again(self._snapshot)
            self._snapshot = None
        if self._pending:
            self._journal.commit(self._pending)
            self._pending = []


def _text_of(entry: Entry) -> str:
    return json.dumps(entry, separators=(",", ":"))
