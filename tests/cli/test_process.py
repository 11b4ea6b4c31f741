"""The command as a process: its streams, how it ends, what it imports."""

from __future__ import annotations

import json
import os
import re
import signal
import subprocess
import sys
import time
from importlib import import_module
from pathlib import Path

import pytest

import rightofway
from rightofway.io import write_scenario
from rightofway.model import Rules
from tests.builders.fleets import random_fleet
from tests.cli.conftest import Cli


def test_standard_input_is_read_for_a_dash(door: Path) -> None:
    with door.open("rb") as file:
        ended = subprocess.run(
            [sys.executable, "-m", "rightofway", "plan", "-", "-o", "-"],
            stdin=file, capture_output=True, check=True,
        )  # fmt: skip
    assert json.loads(ended.stdout)["metrics"]["flowtime"] == 19


def test_a_reader_that_goes_away_ends_it_without_a_word() -> None:
    """141 is what a shell makes of SIGPIPE; the pipe here has lost its reader from the start."""
    reader, writer = os.pipe()
    os.close(reader)
    command = [sys.executable, "-m", "rightofway", "schema", "plan"]
    ended = subprocess.run(command, stdout=writer, stderr=subprocess.PIPE, check=False)
    os.close(writer)
    assert (ended.returncode, ended.stderr) == (141, b"")


def test_results_are_utf8_whatever_the_locale(tmp_path: Path, door: Path) -> None:
    path = tmp_path / "door.yaml"
    path.write_text(door.read_text(encoding="utf-8").replace("R1", "Zoë→"), encoding="utf-8")
    ended = subprocess.run(
        [sys.executable, "-m", "rightofway", "plan", str(path)],
        env={**os.environ, "PYTHONIOENCODING": "latin-1"}, capture_output=True, check=True,
    )  # fmt: skip
    assert "Zoë→ waits 1 time unit in N0" in ended.stdout.decode("utf-8")


@pytest.mark.parametrize("debug", [False, True])
def test_a_defect_ends_with_70_and_one_line_unless_asked_for_more(
    cli: Cli, door: Path, monkeypatch: pytest.MonkeyPatch, debug: bool
) -> None:
    def fail(*_: object, **__: object) -> None:
        raise ValueError("two\nlines")

    monkeypatch.setattr(import_module("rightofway.solve"), "solve", fail)
    ended = cli(*["--debug"] * debug, "plan", door, "-o", "plan.json")
    *trace, line = ended.err.splitlines()
    assert ended.code == 70
    assert line.startswith("unexpected ValueError: two lines (please report it")
    assert bool(trace) == ("Traceback (most recent call last):" in trace) == debug
    assert not Path("plan.json").exists()


def test_an_interrupt_ends_with_130_and_one_line(tmp_path: Path) -> None:
    """Many robots that all want to get past each other keep the planner busy for long."""
    rows = "\n".join(["    " + "." * 100] * 100)
    robots = "\n".join(
        f"  - {{name: R{k}, home: [{k % 10}, {k // 10}], target: [{99 - k // 10}, {k // 10}]}}"
        for k in range(1000)
    )
    (tmp_path / "many.yaml").write_text(
        f"format: rightofway-scenario/1\nmap:\n  grid: |\n{rows}\nrobots:\n{robots}\n",
        encoding="utf-8",
    )
    ended, out, err = interrupted(tmp_path, "many.yaml", "--planner", "two-level", after=2)
    assert (ended, out, err.strip()) == (130, "", "interrupted")
    assert not (tmp_path / "plan.json").exists()


def test_an_interrupt_while_a_plan_gets_better_hands_out_the_best_so_far(tmp_path: Path) -> None:
    """So many robots that nothing left to gain cannot end it first, on any machine."""
    problem = random_fleet(1, size=40, robots=200, rules=Rules(occupancy="both"))
    write_scenario(problem, tmp_path / "fleet.yaml")
    ended, out, err = interrupted(tmp_path, "fleet.yaml", "--time-limit", "inf", after=5)
    assert (ended, err) == (0, "wrote plan.json\n")
    words = " ".join(out.split())
    assert re.search(r"; interrupted: \d+ attempts to improve the first plan saved", words)
    assert rightofway.check(rightofway.load_plan(tmp_path / "plan.json")).ok


def interrupted(where: Path, scenario: str, *more: str, after: float) -> tuple[int, str, str]:
    """Plan to a file, interrupt that after some seconds, and return how it ended."""
    # Python itself would answer an interrupt while it still imports the package; and whoever runs
    # the tests in the background has interrupts ignored, which children inherit.
    code = (
        "import signal, sys; from rightofway.cli.main import run;"
        "signal.signal(signal.SIGINT, signal.default_int_handler);"
        "print(); sys.exit(run(sys.argv[1:]))"
    )
    process = subprocess.Popen(
        [sys.executable, "-uc", code, "plan", scenario, "-o", "plan.json", *more],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, cwd=where, text=True,
    )  # fmt: skip
    assert process.stdout is not None
    assert process.stdout.readline() == "\n"
    time.sleep(after)
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=60)
    return process.returncode, out, err


def test_a_time_limit_begins_with_the_command_and_not_with_its_shell(door: Path) -> None:
    """A shell becomes its last command, and the process is as old as what the shell waited for."""
    line = f"sleep 9 && exec '{sys.executable}' -m rightofway plan '{door}' --time-limit 8"
    done = subprocess.run(["sh", "-c", line], capture_output=True, text=True, check=False)
    assert (done.returncode, "planner" in done.stdout) == (0, True), done.stderr


GIVES_UP = """
import atexit
from rightofway.cli.main import commands, main
from rightofway.errors import GaveUp

class Map:
    def __del__(self):
        print("freed")

def give_up(*args, **options):
    large = Map()
    raise GaveUp("time ran out")

atexit.register(print, "tidied")
commands.main = give_up
main()
"""


def test_a_command_frees_no_memory_when_it_ends() -> None:
    """A map of half a million lanes would take a second, after the limit; functions that were
    registered for the exit run, and all output is written."""
    ended = subprocess.run(
        [sys.executable, "-c", GIVES_UP], capture_output=True, check=False, text=True
    )
    assert (ended.returncode, ended.stdout) == (3, "tidied\n")
    assert ended.stderr == "no plan found: time ran out\n"


def test_help_imports_nothing_heavy() -> None:
    code = (
        "import sys; from rightofway.cli.main import run; run(['plan', '--help']);"
        "print(sorted({'pydantic', 'yaml', 'PIL', 'openpyxl', 'rightofway._core'}"
        " & set(sys.modules)), file=sys.stderr)"
    )
    ended = subprocess.run([sys.executable, "-c", code], capture_output=True, check=True, text=True)
    assert ended.stderr.strip() == "[]"


def test_a_scenario_from_standard_input_finds_its_map_in_the_working_directory(
    tmp_path: Path,
) -> None:
    (tmp_path / "hall.map").write_text("type octile\nheight 1\nwidth 3\nmap\n...\n", "utf-8")
    scenario = (
        "format: rightofway-scenario/1\nmap: {file: hall.map}\n"
        "robots: [{name: R1, home: N0, target: N2}]\n"
    )
    ended = subprocess.run(
        [sys.executable, "-m", "rightofway", "plan", "-", "-o", "-"],
        input=scenario.encode(), capture_output=True, check=True, cwd=tmp_path,
    )  # fmt: skip
    assert json.loads(ended.stdout)["metrics"]["flowtime"] == 5  # 2 out, 1 to turn, 2 back
