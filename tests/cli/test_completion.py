"""What Tab offers in a shell."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from rightofway.cli.main import run

Offered = Callable[..., list[str]]


@pytest.fixture
def offered(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsysbinary: pytest.CaptureFixture[bytes]
) -> Offered:
    """Return a function that returns what is offered for the last of some words."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("_RIGHTOFWAY_COMPLETE", "bash_complete")

    def call(*words: str) -> list[str]:
        monkeypatch.setenv("COMP_WORDS", "\n".join(["rightofway", *words]))
        monkeypatch.setenv("COMP_CWORD", str(len(words)))
        assert run([]) == 0
        lines = capsysbinary.readouterr().out.decode().splitlines()
        return [line.removeprefix("plain,") for line in lines if line]

    return call


def test_commands_are_offered(offered: Offered) -> None:
    assert offered("pl") == ["plan"]


def test_planners_are_offered_and_for_improve_those_that_can(offered: Offered) -> None:
    assert {"auto", "two-level", "lns"} <= set(offered("plan", "--planner", ""))
    assert offered("plan", "--planner", "lo") == ["local-search"]
    assert offered("improve", "--planner", "") == ["auto", "local-search", "lns"]


def test_options_are_those_of_the_planner_with_their_values(offered: Offered) -> None:
    words = ("plan", "--planner", "two-level", "--option")
    assert offered(*words, "s") == ["swaps=resolve", "swaps=leave"]
    assert offered("plan", "--option", "i") == ["iterations=0"]
    assert offered("plan", "--planner", "nobody", "--option", "") == []


def test_bash_is_offered_the_value_after_the_sign_that_parts_words(
    offered: Offered,
) -> None:
    assert offered("plan", "--option", "swaps", "=") == ["resolve", "leave"]
    assert offered("plan", "--option", "swaps", "=", "l") == ["leave"]


def test_files_are_offered_by_their_endings_and_folders_with_a_slash(offered: Offered) -> None:
    for name in ("a.yaml", "a.json", "a.html", ".hidden.json"):
        Path(name).touch()
    Path("all").mkdir()
    Path("all", "b.scen").touch()
    assert offered("plan", "") == ["a.json", "a.yaml", "all/"]
    assert offered("check", "a") == ["a.json", "a.yaml", "all/"]
    assert offered("plan", "all/") == ["all/b.scen"]
    assert offered("plan", "[") == []


def test_examples_are_offered_by_name(offered: Offered) -> None:
    assert offered("examples", "do") == ["door"]


def test_rules_routes_and_formats_are_offered_by_name(offered: Offered) -> None:
    assert offered("laps", "--rule", "t") == ["two-level", "timetable"]
    assert offered("laps", "--routes", "") == ["clear", "direct", "shortest"]
    assert offered("convert", "--to", "l") == ["lacam", "lns2", "lif"]


@pytest.mark.skipif(shutil.which("bash") is None, reason="no Bash here")
def test_the_script_for_bash_fills_in_what_is_offered(tmp_path: Path) -> None:
    """The shell's own function is called as Bash calls it when Tab is pressed."""
    path = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
    script = (
        'eval "$(rightofway completion bash)";'
        " COMP_WORDS=(rightofway plan --option swaps = l); COMP_CWORD=5;"
        ' _rightofway_completion rightofway; echo "${COMPREPLY[@]}"'
    )
    ended = subprocess.run(
        ["bash", "--norc", "-c", script],
        env={**os.environ, "PATH": path}, cwd=tmp_path, capture_output=True, check=True,
    )  # fmt: skip
    assert ended.stdout == b"leave\n"
