"""The journal in a file: whole transactions, one process, and no way without it."""

from __future__ import annotations

from pathlib import Path

import pytest

from rightofway.control import Entry, JournalFailed, SqliteJournal
from rightofway.errors import InputError

ENTRIES: list[Entry] = [{"kind": "started"}, {"kind": "arrived", "robot": 0, "visit": 3}]


def test_what_was_committed_is_there_after_the_next_start(tmp_path: Path) -> None:
    journal = SqliteJournal(tmp_path / "run.journal")
    journal.commit(ENTRIES)
    journal.commit([{"kind": "started"}])
    journal.close()
    again = SqliteJournal(tmp_path / "run.journal")
    assert list(again.entries()) == [*ENTRIES, {"kind": "started"}]
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
    assert list(journal.entries()) == []
    journal.close()
