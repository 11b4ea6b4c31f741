"""The journal of a control: entries that are on the disk before anything is sent.

One process may write a journal, and any may read it. There is no journal in memory: without a
journal, nobody knows what robots hold. Each entry has the moment at which it was written, for
people who look at it later; no release depends on it.
"""

from __future__ import annotations

import json
import sqlite3
import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import closing, contextmanager
from pathlib import Path
from typing import Any, NamedTuple, Protocol

from rightofway.errors import InputError, quote

Entry = Mapping[str, Any]
"""A journal entry as JSON has it, with its ``kind``."""


UNFOLDED = ("notice", "pace")
"""Kinds of entries that are for people only: no snapshot has them, and no control reads them."""


class JournalRow(NamedTuple):
    """An entry as it stands in a journal, with its number and moment.

    Attributes
    ----------
    number
        Rises from entry to entry.
    moment
        When it was written [s]; None in journals of earlier versions.
    entry
        The entry.
    """

    number: int
    moment: float | None
    entry: Entry


class JournalFailed(Exception):
    """An entry could not be written; nothing that depends on it may be sent."""


class Journal(Protocol):
    """What is only ever appended to."""

    def read_entries(self) -> Iterable[Entry]:
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
    """A journal in a file of SQLite, locked for other processes that want to write it.

    Parameters
    ----------
    path
        The file; it is made where there is none, with another one beside it that is locked.
    now
        Returns the moment that entries get [s].

    Raises
    ------
    InputError
        If the file is no journal, cannot be written, or is open in another process.
    """

    def __init__(self, path: Path, now: Callable[[], float] = time.time) -> None:
        self._now = now
        try:
            self._lock = sqlite3.connect(_lock_of(path), timeout=0.5, isolation_level=None)
        except sqlite3.Error as error:
            raise self._refused(path, error) from error
        try:
            self._lock.execute("BEGIN EXCLUSIVE")  # the lock ends with the process
            self._database = sqlite3.connect(path, timeout=5, isolation_level=None)
        except sqlite3.Error as error:
            self._lock.close()
            raise self._refused(path, error) from error
        try:
            self._database.execute("PRAGMA journal_mode = WAL")
            self._database.execute("PRAGMA synchronous = FULL")
            self._database.execute(
                "CREATE TABLE IF NOT EXISTS entries"
                " (number INTEGER PRIMARY KEY, entry TEXT, moment REAL)"
            )
            if not _has_moments(self._database):  # of an earlier version
                self._database.execute("ALTER TABLE entries ADD COLUMN moment REAL")
            self._database.execute("CREATE TABLE IF NOT EXISTS snapshots (number INTEGER)")
        except sqlite3.Error as error:
            self.close()
            raise self._refused(path, error) from error

    @staticmethod
    def _refused(path: Path, error: sqlite3.Error) -> InputError:
        remedy = "name another file, or stop the process that has it open"
        return InputError.at(str(path), f"cannot be used as a journal: {error} ({remedy})")

    def read_entries(self) -> Iterator[Entry]:
        """Yield all entries in their order, from the last snapshot on."""
        last = self._database.execute("SELECT max(number) FROM snapshots").fetchone()[0]
        return self._entries(last or 0)

    def read_begin(self) -> float | None:
        """Return the moment of the first entry of the run [s]; None if none is known."""
        began: float | None = _find_begin(self._database).get("began")
        return began

    def read_history(self) -> Iterator[Entry]:
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
                message = f"{quote(text)} is no entry of a journal (name another file)"
                raise InputError.at(("entry", number), message) from error

    def commit(self, entries: Iterable[Entry]) -> None:
        """Append entries in one transaction."""
        with self._transaction() as database:
            moment = self._now()
            rows = [(_text_of(entry), moment) for entry in entries]
            database.executemany("INSERT INTO entries (entry, moment) VALUES (?, ?)", rows)

    def begin_again(self, snapshot: Entry) -> None:
        """Append a snapshot; drop the entries from before the last snapshot but one.

        The snapshot gets the moment at which the run began, as the first entry may go.
        """
        with self._transaction() as database:
            query = "INSERT INTO entries (entry, moment) VALUES (?, ?)"
            text = _text_of({**snapshot, **_find_begin(database)})
            number = database.execute(query, (text, self._now())).lastrowid
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
        self._lock.close()


class JournalReader:
    """A journal that is read while another process may write it.

    Parameters
    ----------
    path
        The file.

    Raises
    ------
    InputError
        If the file is no journal.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        try:
            self._database = sqlite3.connect(
                f"{path.absolute().as_uri()}?mode=rw", uri=True, check_same_thread=False
            )
            self._database.execute("PRAGMA query_only = TRUE")
            self._database.execute("SELECT 1 FROM entries LIMIT 1")
        except sqlite3.Error as error:
            message = f"cannot be read as a journal: {error} (name the journal of rightofway drive)"
            raise InputError.at(str(path), message) from error
        self._moment = "moment" if _has_moments(self._database) else "NULL"

    def read_rows(self, after: int = 0) -> list[JournalRow]:
        """Return the entries behind one, in their order, as far as they are still kept.

        Parameters
        ----------
        after
            The number of an entry.
        """
        query = f"SELECT number, {self._moment}, entry FROM entries WHERE number > ? ORDER BY 1"  # noqa: S608 (no text of others)
        rows = self._database.execute(query, (after,))
        return [JournalRow(number, moment, json.loads(text)) for number, moment, text in rows]

    @property
    def is_written(self) -> bool:
        """Whether a process has the journal open to write it."""
        lock = _lock_of(self._path)
        if not lock.exists():
            return False
        with closing(sqlite3.connect(lock, timeout=0)) as database:
            try:
                database.execute("SELECT count(*) FROM sqlite_master")
            except sqlite3.OperationalError:
                return True
        return False

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

    def read_entries(self) -> Iterable[Entry]:
        """Return all entries that are on the disk, from the last snapshot on."""
        return self._journal.read_entries()

    def commit(self, entries: Iterable[Entry]) -> None:
        """Append entries; they are not on the disk yet."""
        self._pending += entries

    def begin_again(self, snapshot: Entry) -> None:
        """Append a snapshot, in place of entries that are not on the disk yet."""
        self._pending = [entry for entry in self._pending if entry["kind"] in UNFOLDED]
        self._snapshot = snapshot

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


def _find_begin(database: sqlite3.Connection) -> Entry:
    """Return the moment at which the run began, as a snapshot has it; nothing if none is known."""
    row = database.execute("SELECT entry, moment FROM entries ORDER BY number LIMIT 1").fetchone()
    if row is None:
        return {}
    began = json.loads(row[0]).get("began", row[1])
    return {} if began is None else {"began": began}


def _lock_of(path: Path) -> Path:
    return path.with_name(f"{path.name}-lock")


def _has_moments(database: sqlite3.Connection) -> bool:
    columns = database.execute("SELECT name FROM pragma_table_info('entries')")
    return ("moment",) in columns.fetchall()
