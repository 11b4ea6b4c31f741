"""The journal in a file: whole transactions, one process, and no way without it."""

from __future__ import annotations

import sqlite3
import subprocess
import sys
from pathlib import Path

import pytest

from rightofway.control import Entry, JournalFailed, JournalReader, SqliteJournal
from rightofway.control.journal import BatchedJournal, JournalRow
from rightofway.errors import InputError

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
    with pytest.raises(InputError, match=r"run\.journal: cannot be used .* stop the process"):
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


def test_a_journal_of_an_earlier_version_goes_on_with_moments(tmp_path: Path) -> None:
    path = tmp_path / "run.journal"
    database = sqlite3.connect(path)
    database.execute("CREATE TABLE entries (number INTEGER PRIMARY KEY, entry TEXT)")
    database.execute("CREATE TABLE snapshots (number INTEGER)")
    database.execute("""INSERT INTO entries (entry) VALUES ('{"kind": "started"}')""")
    database.commit()
    database.close()
    reader = JournalReader(path)
    assert reader.read_rows() == [JournalRow(1, None, ENTRIES[0])]
    reader.close()
    journal = SqliteJournal(path, lambda: 7.0)
    journal.commit(ENTRIES[1:])
    assert list(journal.read_entries()) == ENTRIES
    reader = JournalReader(path)
    assert [row.moment for row in reader.read_rows()] == [None, 7.0]
    reader.close()
    journal.close()


def test_a_snapshot_leaves_the_notices_that_are_not_on_the_disk_yet(tmp_path: Path) -> None:
    """It says all that they would say of robots, and nothing of what people were told."""
    journal = SqliteJournal(tmp_path / "run.journal")
    batched = BatchedJournal(journal)
    told: Entry = {"kind": "notice", "robot": 0, "about": "", "over": False, "text": "is late"}
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
