"""The journal in a file: whole transactions, one process, and no way without it."""

from __future__ import annotations

import json
import os
import re
import sqlite3
import subprocess
import sys
from contextlib import closing
from pathlib import Path
from typing import Any, cast

import pytest

from rightofway.control import (
    Entry,
    FleetControl,
    JournalFailed,
    JournalReader,
    SqliteJournal,
)
from rightofway.control.dispatcher import Dispatcher
from rightofway.control.journal import OLDEST, VERSION, BatchedJournal, JournalRow, _refuse_gaps
from rightofway.control.notices import make_notice
from rightofway.control.recording import Recording
from rightofway.errors import InputError
from rightofway.facts import Fact
from tests.builders.chaos import MemoryJournal
from tests.builders.floors import Floor
from tests.builders.plans import door

ENTRIES: list[Entry] = [{"kind": "started"}, {"kind": "arrived", "robot": 0, "visit": 3}]


def test_what_was_committed_is_there_after_the_next_start(tmp_path: Path) -> None:
    journal = SqliteJournal(tmp_path / "run.journal")
    journal.commit(ENTRIES)
    journal.commit([{"kind": "started"}])
    journal.close()
    again = SqliteJournal(tmp_path / "run.journal")
    assert list(again.read_entries()) == [*ENTRIES, {"kind": "started"}]
    again.close()


def test_a_journal_is_open_once(tmp_path: Path) -> None:
    journal = SqliteJournal(tmp_path / "run.journal")
    owner = rf"another control has it open, process {os.getpid()} on \S+ \(.*stop the process"
    with pytest.raises(InputError, match=rf"run\.journal: cannot be used as a journal: {owner}"):
        SqliteJournal(tmp_path / "run.journal")
    journal.close()


def test_there_is_no_journal_where_none_can_be_written(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="cannot be used as a journal"):
        SqliteJournal(tmp_path / "no folder" / "run.journal")
    (tmp_path / "a text").write_text("not a database, and long enough to be looked at " * 40)
    with pytest.raises(InputError, match="cannot be used as a journal"):
        SqliteJournal(tmp_path / "a text")


def test_a_transaction_is_on_the_disk_when_it_returns(tmp_path: Path) -> None:
    journal = SqliteJournal(tmp_path / "run.journal")
    pragma = journal._database.execute("PRAGMA synchronous").fetchone()
    assert pragma == (2,)  # FULL
    assert journal._database.execute("PRAGMA journal_mode").fetchone() == ("wal",)
    journal.close()


def test_on_a_full_disk_nothing_is_half_written(tmp_path: Path) -> None:
    """SQLite itself refuses more pages than it may have, as it does on a full disk."""
    journal = SqliteJournal(tmp_path / "run.journal")
    pages = journal._database.execute("PRAGMA page_count").fetchone()[0]
    journal._database.execute(f"PRAGMA max_page_count = {pages}")
    large: Entry = {"kind": "started", "text": "x" * 100_000}
    with pytest.raises(JournalFailed, match="full"):
        journal.commit([ENTRIES[0], large])
    assert list(journal.read_entries()) == []
    journal.close()


def test_another_process_reads_what_is_committed_while_the_journal_is_written(
    tmp_path: Path,
) -> None:
    moments = iter((10.5, 11.0))
    path = tmp_path / "run.journal"
    journal = SqliteJournal(path, lambda: next(moments))
    journal.commit(ENTRIES)
    reads = (
        "from pathlib import Path; from rightofway.control import JournalReader;"
        f"reader = JournalReader(Path({str(path)!r}));"
        "print(reader.is_written, *(row[:2] for row in reader.read_rows()))"
    )
    shown = subprocess.run([sys.executable, "-c", reads], capture_output=True, check=True)
    assert shown.stdout.decode().strip() == "True (1, 10.5) (2, 10.5)"
    reader = JournalReader(path)
    journal.commit(ENTRIES[:1])
    assert reader.read_rows(after=2) == [JournalRow(3, 11.0, ENTRIES[0])]
    journal.close()
    assert not reader.is_written
    reader.close()


def test_who_looks_at_a_journal_does_not_keep_a_control_from_starting(tmp_path: Path) -> None:
    path = tmp_path / "run.journal"
    SqliteJournal(path).close()
    reader = JournalReader(path)
    assert not reader.is_written
    SqliteJournal(path).close()
    reader.close()


def test_what_is_no_journal_is_not_read(tmp_path: Path) -> None:
    (tmp_path / "a text").write_text("not a database, and long enough to be looked at " * 40)
    for name in ("a text", "nothing"):
        with pytest.raises(InputError, match="cannot be read as a journal"):
            JournalReader(tmp_path / name)


def test_a_snapshot_leaves_the_notices_that_are_not_on_the_disk_yet(tmp_path: Path) -> None:
    """It says all that they would say of robots, and nothing of what people were told."""
    journal = SqliteJournal(tmp_path / "run.journal")
    batched = BatchedJournal(journal)
    told = make_notice(Fact("paused"), 0)
    batched.commit([*ENTRIES, told])
    batched.begin_again({"kind": "snapshot"})
    batched.flush()
    assert list(journal.read_entries()) == [{"kind": "snapshot"}, told]
    journal.close()


def test_each_snapshot_says_when_the_run_began(tmp_path: Path) -> None:
    """The first entry goes with the third snapshot; its moment, 10 s, stays."""
    moments = iter(range(10, 20))
    journal = SqliteJournal(tmp_path / "run.journal", lambda: next(moments))
    journal.commit(ENTRIES)
    for _ in range(3):
        journal.begin_again({"kind": "snapshot"})
    assert list(journal.read_history()) == [{"kind": "snapshot", "began": 10}] * 2
    journal.close()


# --- files of other versions, and damaged ones ----------------------------------------------------


@pytest.fixture
def driven(tmp_path: Path) -> Path:
    """Return the journal of a run with a snapshot, of which the first entries have gone."""
    path = tmp_path / "door.journal"
    journal = SqliteJournal(path)
    dispatcher = Dispatcher(FleetControl(journal), door())
    dispatcher.begin("run")
    floor = Floor(dispatcher)
    floor.drive(3)
    for _ in range(2):
        journal.begin_again(dispatcher.ledger.make_snapshot())
        floor.drive(3)
    journal.close()
    return path


def change(path: Path, *queries: str) -> None:
    """Change a journal by hand."""
    with closing(sqlite3.connect(path)) as database:
        for query in queries:
            database.execute(query)
        database.commit()


def start(path: Path) -> None:
    """Start a control on a journal, and read it for a page."""
    with closing(JournalReader(path)) as reader:
        Recording(door(), reader).read_on()
    with closing(SqliteJournal(path)) as journal:
        FleetControl(journal).start()


@pytest.mark.parametrize("version", [0, OLDEST - 1, VERSION + 1])
def test_a_journal_carries_its_version_and_others_are_refused(driven: Path, version: int) -> None:
    start(driven)
    with closing(sqlite3.connect(driven)) as database:
        assert database.execute("PRAGMA user_version").fetchone() == (VERSION,)
    change(driven, f"PRAGMA user_version = {version}")
    message = rf"door\.journal: is a journal of version {version}, and this"
    for opens in (SqliteJournal, JournalReader):
        with pytest.raises(InputError, match=message):
            opens(driven)


def test_a_journal_in_which_an_entry_is_missing_is_refused(driven: Path) -> None:
    """Whichever it is, the first or the last one, too."""
    with closing(sqlite3.connect(driven)) as database:
        numbers = [number for (number,) in database.execute("SELECT number FROM entries")]
    assert numbers[0] > 1
    whole = driven.read_bytes()
    for number in numbers:
        driven.write_bytes(whole)
        change(driven, f"DELETE FROM entries WHERE number = {number}")  # noqa: S608 (our own)
        for opens in (SqliteJournal, JournalReader):
            with pytest.raises(InputError, match=r"missing: the file is damaged"):
                opens(driven)


@pytest.mark.parametrize(
    "query",
    [
        "ALTER TABLE entries RENAME COLUMN entry TO word",
        "ALTER TABLE snapshots RENAME COLUMN number TO count",
        "DROP TABLE entries",
        "DELETE FROM entries",
    ],
)
def test_a_journal_of_another_make_is_refused(driven: Path, query: str) -> None:
    change(driven, query)
    with pytest.raises(InputError, match=r"door\.journal: "):
        start(driven)


KEYS = {"robot", "visit", "kind"}
WRONG: tuple[object, ...] = (None, -1, 99, 1.5, "x", [], {}, True)
"""What a value may be instead."""


def test_a_journal_with_a_wrong_entry_is_refused_with_its_number_or_drives(driven: Path) -> None:
    """Each key of each entry is left out; robots, visits and kinds have wrong values."""
    with closing(sqlite3.connect(driven)) as database:
        rows = database.execute("SELECT number, entry FROM entries ORDER BY 1").fetchall()
    refused = list[str]()
    for index, (_, own) in enumerate(rows):
        entry = json.loads(own)
        changes = [{key: value for key, value in entry.items() if key != left} for left in entry]
        changes += [{**entry, key: value} for key in {*entry} & KEYS for value in WRONG]
        for changed in [*changes, {**entry, "kind": "of a newer version"}, [], "x"]:
            altered = [json.loads(text) for _, text in rows]
            altered[index] = changed
            journal = MemoryJournal()
            journal.written = altered
            try:
                FleetControl(journal).start()
            except InputError as error:
                refused.append(str(error))
    assert len(refused) > 100
    assert all(re.match(r"entry\[\d+\]: ", message) for message in refused)


def test_a_journal_that_grows_while_it_is_opened_has_no_gaps(tmp_path: Path) -> None:
    """Another process commits an entry after each statement of the one that opens it."""
    path = tmp_path / "run.journal"
    journal = SqliteJournal(path)
    journal.commit([{"kind": "started"}])

    class Growing(sqlite3.Connection):
        def execute(self, *query: Any) -> sqlite3.Cursor:
            found = super().execute(*query)
            rows = found.fetchall()
            journal.commit([{"kind": "started"}])
            return cast("sqlite3.Cursor", FoundRows(rows))

    class FoundRows(list[Any]):
        def fetchone(self) -> Any:
            return self[0]

    _refuse_gaps(sqlite3.connect(path, factory=Growing), path)
    journal.close()
