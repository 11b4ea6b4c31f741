"""Exceptions that are not ours, out of anything that comes in: reported once, and nothing ends."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from rightofway.control import FleetControl, JournalFailed, SqliteJournal
from rightofway.control.commands import Commands
from rightofway.control.dispatcher import Dispatcher
from rightofway.control.fleet_control import LedgerFailed
from rightofway.control.operator import Operator
from tests.builders.plans import door
from tests.builders.sentences import tell_answer
from tests.builders.sites import Site


def fail(*_: Any, **__: Any) -> Any:
    """Fail as code with a defect does."""
    raise RuntimeError("of a defect")


def test_a_message_that_raises_is_reported_once_and_the_next_one_is_used(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    site = Site()
    with monkeypatch.context() as patch:
        patch.setattr(site.control, "receive", fail)
        site.say(1)
        site.say(1)
    assert len(site.said) == 1
    begin = (
        "R2 sent a message that the control cannot process: unexpected RuntimeError: of a defect"
    )
    assert site.said[0].startswith(f'{begin} (please report it): {{"headerId": ')
    site.say(1)
    assert site.said[1:] == ["R2 sends messages that can be used again (state)"]
    assert site.released[1] > 0


@pytest.mark.parametrize("error", [JournalFailed("full"), LedgerFailed("of a defect")])
def test_a_control_that_does_not_know_any_longer_who_holds_what_ends(
    monkeypatch: pytest.MonkeyPatch, error: Exception
) -> None:
    site = Site()

    def fail_so(*_: Any) -> Any:
        raise error

    monkeypatch.setattr(site.control, "receive", fail_so)
    with pytest.raises(type(error)):
        site.say(1)


def test_an_entry_that_was_written_and_cannot_be_applied_ends_the_control(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    site = Site()
    monkeypatch.setattr(site.control.ledger, "apply", fail)
    with pytest.raises(LedgerFailed, match="of a defect"):
        site.say(1)


def begin(journal: SqliteJournal) -> Dispatcher:
    """Return what drives the door with a journal."""
    dispatcher = Dispatcher(FleetControl(journal), door())
    if not dispatcher.ledger.run:
        dispatcher.begin("run")
    return dispatcher


def test_a_command_that_raises_is_answered_as_failed_and_no_start_repeats_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The control is killed before its answer is written; the next command is carried out."""
    commands, journal = Commands(tmp_path / "a.journal"), SqliteJournal(tmp_path / "a.journal")
    dispatcher = begin(journal)
    commands.ask({"kind": "replan"})
    commands.ask({"kind": "hold", "name": "R1"})
    with monkeypatch.context() as patch:
        patch.setattr(dispatcher, "replan", fail)
        _, first = Operator(dispatcher).obey(commands)
    reason = "unexpected RuntimeError: of a defect (please report it), from the command"
    text = f"""refused: {reason} '{{"kind": "replan"}}'"""
    assert first[0][0] == 1
    assert tell_answer(first[0][1]) == (False, text)
    assert dispatcher.ledger.robots[0].is_on_hold
    journal.close()
    again = SqliteJournal(tmp_path / "a.journal")
    replanned = begin(again)
    with monkeypatch.context() as patch:
        patch.setattr(replanned, "replan", fail)
        _, second = Operator(replanned).obey(commands)
    assert [tell_answer(answer)[1] for _, answer in second] == [
        "carried out before a start",
        "R1: on hold",
    ]
    again.close()
    commands.close()


def test_the_last_command_of_a_journal_stays_failed_at_the_next_start(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    commands, journal = Commands(tmp_path / "a.journal"), SqliteJournal(tmp_path / "a.journal")
    dispatcher = begin(journal)
    commands.ask({"kind": "replan"})
    monkeypatch.setattr(dispatcher, "replan", fail)
    _, [(_, first)] = Operator(dispatcher).obey(commands)
    journal.begin_again(dispatcher.ledger.make_snapshot())
    journal.close()
    again = SqliteJournal(tmp_path / "a.journal")
    _, [(_, second)] = Operator(begin(again)).obey(commands)
    assert not first["done"]
    assert second == first
    again.close()
    commands.close()
