"""Drafts and runs in one SQLite file: each row is on the disk when the call returns."""

from __future__ import annotations

import json
import sqlite3
import threading
import time
import zlib
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from rightofway.studio.errors import Refused
from rightofway.studio.workspace import compute_revision

FILE = ".rightofway-studio.sqlite"
"""The name of the file in the folder of the studio."""

TABLES = """
CREATE TABLE IF NOT EXISTS drafts (name TEXT PRIMARY KEY, saved REAL, document TEXT);
CREATE TABLE IF NOT EXISTS runs (id INTEGER PRIMARY KEY AUTOINCREMENT, data TEXT NOT NULL);
CREATE TABLE IF NOT EXISTS blobs (
    run INTEGER REFERENCES runs(id) ON DELETE CASCADE, kind TEXT, content BLOB,
    PRIMARY KEY (run, kind)
);
"""


UNWRITABLE = {
    sqlite3.SQLITE_CANTOPEN,
    sqlite3.SQLITE_FULL,
    sqlite3.SQLITE_IOERR,
    sqlite3.SQLITE_PERM,
    sqlite3.SQLITE_READONLY,
}
"""Primary error codes of a file that cannot be written."""


class Store:
    """The drafts and the runs of a folder.

    Parameters
    ----------
    folder
        Where the file is; None for memory. A file that cannot be used is left as it is, and memory
        is used instead.

    Attributes
    ----------
    trouble
        Why the file cannot be used, and the remedy; empty where it can, or for memory.
    is_kept
        Whether rows outlive the process.
    """

    def __init__(self, folder: Path | None) -> None:
        self._lock = threading.Lock()
        self.trouble = ""
        try:
            self._database = self._open_store(str(folder / FILE) if folder else ":memory:")
        except (sqlite3.Error, ValueError) as error:
            self._database, self.trouble = self._open_store(":memory:"), _describe_fault(error)
        self.is_kept = folder is not None and not self.trouble

    @staticmethod
    def _open_store(path: str) -> sqlite3.Connection:
        database = sqlite3.connect(path, timeout=0.5, check_same_thread=False)
        try:
            database.execute("PRAGMA locking_mode = EXCLUSIVE")
            _read_through(database)  # before anything is written: a damaged file stays as it is
            database.execute("PRAGMA journal_mode = WAL")
            database.execute("PRAGMA synchronous = FULL")
            database.execute("PRAGMA foreign_keys = ON")
            database.executescript(TABLES)
            database.execute("INSERT OR REPLACE INTO drafts VALUES ('', 0, 'null')")  # takes a lock
            database.execute("DELETE FROM drafts WHERE name = ''")
            database.commit()
        except (sqlite3.Error, ValueError):
            database.close()
            raise
        return database

    @contextmanager
    def _run_transaction(self) -> Iterator[sqlite3.Connection]:
        try:
            with self._lock, self._database:
                yield self._database
        except sqlite3.ProgrammingError:  # the store was closed
            raise
        except sqlite3.DatabaseError as error:
            remedy = "free some space, delete some runs"
            if _is_damage(error):
                remedy = f"end the studio, then move {FILE} away or put back a copy"
            raise Refused(f"drafts and runs cannot be kept: {error} ({remedy})", 507) from None

    def close(self) -> None:
        """Close the file."""
        with self._lock:
            self._database.close()

    def put_draft(
        self, name: str, document: Any, *, revision: str | None = None
    ) -> tuple[float, str]:
        """Keep a draft, and return when [s since 1970], and its revision.

        Raises
        ------
        Refused
            If it is another one by now.
        """
        saved, text = time.time(), json.dumps(document)
        with self._run_transaction() as database:
            self._is_still(database, name, revision)
            row = (name, saved, text)
            database.execute("INSERT OR REPLACE INTO drafts VALUES (?, ?, ?)", row)
        return saved, compute_revision(text.encode())

    @staticmethod
    def _is_still(database: sqlite3.Connection, name: str, revision: str | None) -> None:
        """Refuse where a draft is not the one that was opened."""
        if revision is None:
            return
        row = database.execute("SELECT document FROM drafts WHERE name = ?", (name,)).fetchone()
        if revision != (compute_revision(row[0].encode()) if row else ""):
            was = "was changed on another page" if row else "is not kept any more"
            raise Refused(f"the draft {name!r} {was} (open it again, or take another name)", 412)

    def read_draft(self, name: str) -> dict[str, Any] | None:
        """Return a draft with its revision and when it was kept, or None."""
        with self._run_transaction() as database:
            query = "SELECT saved, document FROM drafts WHERE name = ?"
            row = database.execute(query, (name,)).fetchone()
        if not row:
            return None
        saved, text = row
        revision = compute_revision(text.encode())
        document = json.loads(text)
        return {"name": name, "saved": saved, "revision": revision, "document": document}

    def list_drafts(self) -> list[dict[str, Any]]:
        """Return name, time and size of all drafts, the latest first."""
        with self._run_transaction() as database:
            query = "SELECT name, saved, length(document) FROM drafts ORDER BY saved DESC"
            rows = database.execute(query).fetchall()
        return [{"name": name, "saved": saved, "size": size} for name, saved, size in rows]

    def delete_draft(self, name: str, *, revision: str | None = None) -> bool:
        """Delete a draft, if it is still of a revision; false if there is none."""
        with self._run_transaction() as database:
            self._is_still(database, name, revision)
            return bool(database.execute("DELETE FROM drafts WHERE name = ?", (name,)).rowcount)

    def add_run(self, data: dict[str, Any], blobs: Sequence[tuple[str, bytes]] = ()) -> int:
        """Keep a new run with its blobs by kind, at once, and return its number."""
        with self._run_transaction() as database:
            added = database.execute("INSERT INTO runs (data) VALUES (?)", (json.dumps(data),))
            number = added.lastrowid
            assert number is not None, "a row was added"
            self._put_blobs(database, number, blobs)
        return number

    def put_run(
        self, number: int, data: dict[str, Any], blobs: Sequence[tuple[str, bytes]] = ()
    ) -> None:
        """Keep a run, and blobs by kind, in one transaction."""
        with self._run_transaction() as database:
            row = database.execute(
                "UPDATE runs SET data = ? WHERE id = ?", (json.dumps(data), number)
            )
            if row.rowcount:
                self._put_blobs(database, number, blobs)

    @staticmethod
    def _put_blobs(
        database: sqlite3.Connection, number: int, blobs: Sequence[tuple[str, bytes]]
    ) -> None:
        packed = [(number, kind, zlib.compress(content, 1)) for kind, content in blobs]
        database.executemany("INSERT OR REPLACE INTO blobs VALUES (?, ?, ?)", packed)

    def list_runs(self) -> list[tuple[int, dict[str, Any]]]:
        """Return all runs, the earliest first."""
        with self._run_transaction() as database:
            rows = database.execute("SELECT id, data FROM runs ORDER BY id").fetchall()
        return [(number, json.loads(data)) for number, data in rows]

    def read_blob(self, number: int, kind: str) -> bytes | None:
        """Return a blob of a run, or None."""
        with self._run_transaction() as database:
            query = "SELECT content FROM blobs WHERE run = ? AND kind = ?"
            row = database.execute(query, (number, kind)).fetchone()
        try:
            return row and zlib.decompress(row[0])
        except zlib.error:
            message = f"the {kind} of run {number} is damaged in {FILE} (make the run again)"
            raise Refused(message, 500) from None

    def delete_run(self, number: int) -> None:
        """Delete a run and its blobs."""
        with self._run_transaction() as database:
            database.execute("DELETE FROM runs WHERE id = ?", (number,))


def _read_through(database: sqlite3.Connection) -> None:
    """Raise an error where a page or a row of the file cannot be read."""
    [verdict] = database.execute("PRAGMA quick_check(1)").fetchone()
    if verdict != "ok":
        raise ValueError(verdict)
    tables = {name for (name,) in database.execute("SELECT name FROM sqlite_master")}
    for table, column in (("drafts", "document"), ("runs", "data")):
        if table not in tables:
            continue  # the file is new
        for number, text in database.execute(f"SELECT rowid, {column} FROM {table}"):  # noqa: S608 (both are above)
            if not isinstance(json.loads(text), dict):
                raise sqlite3.DataError(f"row {number} of the table {table} is no mapping")


def _is_damage(error: Exception) -> bool:
    """Return whether an error is of the content of the file, not of its place."""
    code = getattr(error, "sqlite_errorcode", sqlite3.SQLITE_CORRUPT) & 0xFF
    return code not in UNWRITABLE | {sqlite3.SQLITE_BUSY}


def _describe_fault(error: Exception) -> str:
    """Return why the file cannot be used, and the remedy."""
    if _is_damage(error):
        return f"{FILE} is damaged: {error} (move it away, or put back a copy; then start again)"
    if getattr(error, "sqlite_errorcode", 0) & 0xFF == sqlite3.SQLITE_BUSY:
        return "another studio has the folder open (end that one)"
    return f"the folder cannot be written: {error} (check its permissions and the disk)"
