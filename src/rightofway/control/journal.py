"""The journal of a control: entries that are on the disk before anything is sent.

One process may write a journal, and any may read it. There is no journal in memory: without a
journal, the resources that robots hold are unknown. Each entry has the moment at which it was
written, for people who look at it later; no release depends on it.
"""

from __future__ import annotations

import json
import os
import sqlite3
import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import closing, contextmanager
from pathlib import Path
from socket import gethostname
from typing import Any, NamedTuple, Protocol

from rightofway.errors import InputError, quote

Entry = Mapping[str, Any]
"""A journal entry as JSON has it, with its ``kind``."""


VERSION, OLDEST = 3, 2
"""The version of the file, its ``user_version``, and the oldest one that is read: its entries are
read as before, and what is written makes the file one of the new version."""

UNFOLDED = ("charge", "notice", "pace")
"""Kinds of entries that are for people only: no snapshot has them, and no control reads them."""


class JournalRow(NamedTuple):
    """An entry of a journal, with its number and moment.

    Attributes
    ----------
    number
        Rises from entry to entry.
    moment
        When it was written [s].
    entry
        The entry.
    """

    number: int
    moment: float
    entry: Entry


class JournalFailed(Exception):
    """An entry could not be written, so no message that depends on it may be sent."""


class Journal(Protocol):
    """A file to which entries are only appended."""

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
        self._path, self._now = path, now
        try:
            self._lock = sqlite3.connect(_locate_lock(path), timeout=0.5, isolation_level=None)
        except sqlite3.Error as error:
            raise self._refuse_journal(path, str(error)) from error
        try:
            self._lock.execute("BEGIN EXCLUSIVE")  # the lock ends with the process
            self._database = sqlite3.connect(path, timeout=5, isolation_level=None)
        except sqlite3.Error as error:
            self._lock.close()
            raise self._refuse_journal(path, _find_owner(path) or str(error)) from error
        try:
            _refuse_other_version(self._database, path)
            self._database.execute("PRAGMA journal_mode = WAL")
            self._database.execute("PRAGMA synchronous = FULL")
            # Before the table: a reader may look meanwhile, and refuses entries without a version.
            self._database.execute(f"PRAGMA user_version = {VERSION}")
            self._database.execute(
                "CREATE TABLE IF NOT EXISTS entries"
                " (number INTEGER PRIMARY KEY AUTOINCREMENT, entry TEXT, moment REAL NOT NULL)"
            )
            self._database.execute("CREATE TABLE IF NOT EXISTS snapshots (number INTEGER)")
            _refuse_gaps(self._database, path)
            self._database.execute("CREATE TABLE IF NOT EXISTS owner (process INTEGER, host TEXT)")
            self._database.execute("DELETE FROM owner")
            self._database.execute("INSERT INTO owner VALUES (?, ?)", (os.getpid(), gethostname()))
        except sqlite3.Error as error:
            self.close()
            raise self._refuse_journal(path, str(error)) from error
        except InputError:
            self.close()
            raise

    @staticmethod
    def _refuse_journal(path: Path, reason: str) -> InputError:
        remedy = "name another file, or stop the process that has it open"
        return InputError.at(str(path), f"cannot be used as a journal: {reason} ({remedy})")

    def read_entries(self) -> Iterator[Entry]:
        """Yield all entries in their order, from the last snapshot on."""
        with _report_damage(self._path):
            last = self._database.execute("SELECT max(number) FROM snapshots").fetchone()[0]
        return self._read_entries(last or 0)

    def read_begin(self) -> float | None:
        """Return the moment of the first entry of the run [s]; None if none is known."""
        with _report_damage(self._path):
            began: float | None = _find_begin(self._database).get("began")
        return began

    def read_history(self) -> Iterator[Entry]:
        """Yield all entries that are still kept, in their order."""
        return self._read_entries(0)

    def _read_entries(self, first: int) -> Iterator[Entry]:
        query = "SELECT number, entry FROM entries WHERE number >= ? ORDER BY 1"
        with _report_damage(self._path):
            rows = self._database.execute(query, (first,)).fetchall()
        for number, text in rows:
            yield _read_entry(number, text)

    def commit(self, entries: Iterable[Entry]) -> None:
        """Append entries in one transaction."""
        with self._open_transaction() as database:
            moment = self._now()
            rows = [(_write_entry(entry), moment) for entry in entries]
            database.executemany("INSERT INTO entries (entry, moment) VALUES (?, ?)", rows)

    def begin_again(self, snapshot: Entry) -> None:
        """Append a snapshot; drop the entries from before the last snapshot but one.

        The snapshot gets the moment at which the run began, as the first entry may go.
        """
        with self._open_transaction() as database:
            query = "INSERT INTO entries (entry, moment) VALUES (?, ?)"
            text = _write_entry({**snapshot, **_find_begin(database)})
            number = database.execute(query, (text, self._now())).lastrowid
            last = database.execute("SELECT max(number) FROM snapshots").fetchone()[0] or 0
            database.execute("DELETE FROM entries WHERE number < ?", (last,))
            database.execute("DELETE FROM snapshots WHERE number < ?", (last,))
            database.execute("INSERT INTO snapshots VALUES (?)", (number,))

    @contextmanager
    def _open_transaction(self) -> Iterator[sqlite3.Connection]:
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
            _refuse_other_version(self._database, path)
            _refuse_gaps(self._database, path)
        except sqlite3.Error as error:
            message = f"cannot be read as a journal: {error} (name the journal of rightofway drive)"
            raise InputError.at(str(path), message) from error

    def read_rows(self, after: int = 0) -> list[JournalRow]:
        """Return the entries behind one, in their order, as far as they are still kept.

        Parameters
        ----------
        after
            The number of an entry.
        """
        query = "SELECT number, moment, entry FROM entries WHERE number > ? ORDER BY 1"
        with _report_damage(self._path):
            rows = self._database.execute(query, (after,)).fetchall()
        return [JournalRow(number, at, _read_entry(number, text)) for number, at, text in rows]

    @property
    def is_written(self) -> bool:
        """Whether a process has the journal open to write it."""
        lock = _locate_lock(self._path)
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

    A message that depends on an entry may be sent only after a flush that did not fail. Entries
    whose flush has failed are tried again by the next one.

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


@contextmanager
def _report_damage(path: Path) -> Iterator[None]:
    """Report an error of SQLite as a fault of the file."""
    try:
        yield
    except sqlite3.Error as error:
        message = f"cannot be read: {error} (the file is damaged: name another one)"
        raise InputError.at(str(path), message) from error


def _read_entry(number: int, text: Any) -> Entry:
    """Return the entry of a row."""
    try:
        entry = json.loads(text)
    except (TypeError, ValueError, RecursionError):
        entry = None
    if not isinstance(entry, dict) or not isinstance(entry.get("kind"), str):
        message = f"{quote(text)} is no entry of a journal (name another file)"
        raise InputError.at(("entry", number), message)
    return entry


def _refuse_other_version(database: sqlite3.Connection, path: Path) -> None:
    """Refuse a file with entries of another version."""
    (version,) = database.execute("PRAGMA user_version").fetchone()
    query = "SELECT count(*) FROM sqlite_master WHERE name = 'entries'"
    if not OLDEST <= version <= VERSION and database.execute(query).fetchone()[0]:
        message = (
            f"is a journal of version {version}, and this program reads {OLDEST} to {VERSION}"
            " (use the rightofway that wrote it)"
        )
        raise InputError.at(str(path), message)


def _refuse_gaps(database: sqlite3.Connection, path: Path) -> None:
    """Refuse a file in which entries are missing: numbers rise by one, from 1 or a snapshot on."""
    query = (  # one statement: a control may write meanwhile
        "SELECT count(*), min(number), max(number),"
        " (SELECT max(seq) FROM sqlite_sequence WHERE name = 'entries'),"
        " (SELECT min(number) FROM snapshots) FROM entries"
    )
    count, first, last, numbered, expected = database.execute(query).fetchone()
    last, expected = numbered or last, expected or 1
    if not last:
        return
    if first not in {1, expected}:
        missing = f"entries before {first} are missing" if first else "all entries are missing"
    elif count != last - first + 1:
        query = (
            "SELECT number + 1 FROM entries WHERE number + 1 NOT IN"
            " (SELECT number FROM entries) ORDER BY 1 LIMIT 1"
        )
        missing = f"entry {database.execute(query).fetchone()[0]} is missing"
    else:
        return
    raise InputError.at(str(path), f"{missing}: the file is damaged (name another one)")


def _find_owner(path: Path) -> str:
    """Return which control has a journal open; empty where that is not known."""
    try:
        with closing(sqlite3.connect(f"{path.absolute().as_uri()}?mode=ro", uri=True)) as database:
            row = database.execute("SELECT process, host FROM owner").fetchone()
    except sqlite3.Error:
        return ""
    return f"another control has it open, process {row[0]} on {row[1]}" if row else ""


def _write_entry(entry: Entry) -> str:
    return json.dumps(entry, separators=(",", ":"))


def _find_begin(database: sqlite3.Connection) -> Entry:
    """Return the moment at which the run began, as a snapshot has it; nothing if none is known."""
    query = "SELECT number, entry, moment FROM entries ORDER BY number LIMIT 1"
    row = database.execute(query).fetchone()
    if row is None:
        return {}
    number, text, moment = row
    began = _read_entry(number, text).get("began", moment)
    return {"began": began} if isinstance(began, int | float) else {}


def _locate_lock(path: Path) -> Path:
    return path.with_name(f"{path.name}-lock")
