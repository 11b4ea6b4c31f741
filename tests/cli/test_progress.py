"""What a terminal shows while a plan gets better."""

from __future__ import annotations

import sys

import pytest

from rightofway.cli.terminal import CLEAR, progress


def test_a_terminal_shows_the_latest_sentence_in_one_line(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True)
    monkeypatch.setenv("COLUMNS", "20")
    with progress() as report:
        report("flowtime 19")
        report("flowtime 18 and more than fits")
    assert capsys.readouterr().err == f"{CLEAR}flowtime 19{CLEAR}flowtime 18 and mor{CLEAR}"


def test_a_file_gets_none_of_it(capsys: pytest.CaptureFixture[str]) -> None:
    with progress() as report:
        report("flowtime 19")
    assert capsys.readouterr().err == ""
