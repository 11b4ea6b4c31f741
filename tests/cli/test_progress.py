"""What a terminal shows while a plan gets better."""

from __future__ import annotations

import re
import sys
import threading
import time

import pytest

import rightofway
from rightofway.cli.terminal import CLEAR, show_progress
from tests.cli.conftest import EXAMPLES, Cli


def test_a_terminal_shows_the_time_and_the_latest_sentence_in_one_line(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True)
    monkeypatch.setenv("COLUMNS", "21")
    times = iter([100, 100, 103.14])
    monkeypatch.setattr(time, "monotonic", lambda: next(times))
    with show_progress(10) as report:
        report("cost 19")
        report("cost 18, more than fits")
    shown = capsys.readouterr().err
    assert shown == f"{CLEAR}0.0 of 10 s, cost 19{CLEAR}3.1 of 10 s, cost 18{CLEAR}"


def test_verbose_prints_each_step_as_a_line(cli: Cli) -> None:
    door = str(EXAMPLES / "door.yaml")
    for words in (("plan", door, "-v"), ("-v", "plan", door)):
        lines = cli(*words).err.splitlines()
        assert re.fullmatch(r" +\d+\.\d\d s  auto plans 2 robots", lines[0])
        assert "judged: flowtime 19 time units" in lines[-1]
    assert cli("plan", door).err == ""
    assert cli("plan", door, "-v", "-q").err == ""


def test_the_library_logs_progress_for_programs_that_listen(
    caplog: pytest.LogCaptureFixture,
) -> None:
    scenario = rightofway.load(EXAMPLES / "door.yaml")
    with caplog.at_level("INFO", logger="rightofway"):
        rightofway.solve(scenario)
        rightofway.run_laps(scenario)
    assert caplog.records[0].getMessage() == "auto plans 2 robots"
    caplog.clear()
    rightofway.solve(scenario, report=lambda _: None)
    assert not caplog.records


def test_the_line_is_kept_up_to_date_while_a_planner_says_nothing(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True)
    written = threading.Event()
    write = sys.stderr.write

    def heard(text: str) -> int:
        written.set()
        return write(text)

    monkeypatch.setattr(sys.stderr, "write", heard)
    with show_progress(10):
        assert written.wait(30)
    *lines, end = capsys.readouterr().err.split(CLEAR)[1:]
    assert lines
    assert all(re.fullmatch(r"\d\.\d of 10 s", line) for line in lines)
    assert end == ""


def test_a_file_gets_none_of_it(capsys: pytest.CaptureFixture[str]) -> None:
    with show_progress() as report:
        report("flowtime 19")
    assert capsys.readouterr().err == ""
