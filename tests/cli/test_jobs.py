"""``rightofway jobs`` as an operator meets it, while a control drives."""

from __future__ import annotations

import json
import threading
from collections.abc import Iterator
from pathlib import Path

import pytest

from rightofway.control import FleetControl, SqliteJournal
from rightofway.control.commands import Commands
from rightofway.control.dispatcher import Dispatcher
from tests.builders.floors import Floor
from tests.builders.plans import door
from tests.cli.conftest import Cli


@pytest.fixture
def journal(tmp_path: Path) -> Iterator[Path]:
    """Return the journal of a control that has begun to drive the door, and answers."""
    path, ends, begun = tmp_path / "door.journal", threading.Event(), threading.Event()

    def drive() -> None:
        opened = SqliteJournal(path)
        dispatcher = Dispatcher(FleetControl(opened), door())
        dispatcher.begin("run")
        floor, commands = Floor(dispatcher), Commands(path)
        floor.drive(2)
        begun.set()
        while not ends.wait(0.02):
            messages, answers = floor.operator.obey(commands)
            floor.send(messages)
            for number, answer in answers:
                commands.answer(number, answer)
        commands.close()
        opened.close()

    control = threading.Thread(target=drive)
    control.start()
    begun.wait()
    yield path
    ends.set()
    control.join()


def test_any_file_but_a_journal_is_refused_at_once_and_nothing_is_written(cli: Cli) -> None:
    """A command to it would wait for an answer, and leave a file of commands beside it."""
    plan = Path("plan.json")
    plan.write_text("{}", encoding="utf-8")
    ended = cli("jobs", "plan.json", "list")
    assert (ended.code, ended.out) == (2, "")
    assert ended.err.startswith("plan.json: cannot be read as a journal: ")
    assert ended.err.endswith("(name the journal of rightofway drive)\n")
    assert list(Path.cwd().iterdir()) == [plan.absolute()]


def test_jobs_are_added_listed_changed_and_withdrawn(cli: Cli, journal: Path) -> None:
    added = cli("jobs", journal, "add", "--at", "N7", "--work", "2")
    assert added.out == "R1/job1 at N7 is added before R1/job0 at N6\n"
    rows = [line.split() for line in cli("jobs", journal, "list").out.splitlines()]
    assert rows == [
        ["R1/job1", "N7", "planned"],
        ["R1/job0", "N6", "planned"],
        ["R2/job0", "N8", "released"],
    ]
    assert cli("jobs", journal, "change", "R1/job1", "--at", "N8").out == "R1/job1 is changed\n"
    added = cli("jobs", journal, "add", "--at", "N6", "--after", "R1/job1")
    assert added.out == "R1/job2 at N6 is added after R1/job1 at N8 and before R1/job0 at N6\n"
    assert cli("jobs", journal, "withdraw", "R1/job2").code == 0
    assert cli("jobs", journal, "withdraw", "R1/job1").code == 0
    ended = cli("jobs", journal, "list", "--json")
    assert [job["name"] for job in json.loads(ended.out)["jobs"]] == ["R1/job0", "R2/job0"]


def test_what_cannot_be_done_is_refused_with_the_reason(cli: Cli, journal: Path) -> None:
    ended = cli("jobs", journal, "withdraw", "R2/job0")
    assert ended.code == 1
    assert "refused: job: 'R2/job0' is released already (it cannot be changed)" in ended.err


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("add",), "give --at"),
        (("withdraw",), "withdraw needs a NAME"),
        (("add", "--at", "N7", "--work", "-1"), "'-1' is no duration"),
    ],
)
def test_usage_that_asks_for_nothing_is_refused(
    cli: Cli, tmp_path: Path, words: tuple[str, ...], message: str
) -> None:
    SqliteJournal(tmp_path / "a.journal").close()
    ended = cli("jobs", tmp_path / "a.journal", *words)
    assert ended.code == 2
    assert message in ended.err


def test_a_control_that_does_not_run_answers_later(cli: Cli, tmp_path: Path) -> None:
    assert cli("jobs", tmp_path / "no.journal", "list").code == 2
    SqliteJournal(tmp_path / "a.journal").close()
    ended = cli("jobs", tmp_path / "a.journal", "hold", "--wait", "0")
    assert ended.code == 3
    assert "it is carried out when the control runs" in ended.err
    [(_, command)] = Commands(tmp_path / "a.journal").list_unanswered()
    assert json.loads(command) == {"kind": "hold"}
