"""What holds for all commands: -o by its ending, --page, - for standard output, -q, -k, -V."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from rightofway import __version__
from rightofway.cli.main import commands
from rightofway.cli.parts import GROUPS
from tests.cli.conftest import EXAMPLES, SWAP, Cli

SCEN = EXAMPLES / "maps" / "warehouse-10-20-10-2-1-random-1.scen"


def with_plan(cli: Cli, door: Path) -> None:
    assert cli("plan", door, "-o", "plan.json").code == 0


@pytest.mark.parametrize(
    ("args", "message"),
    [
        (["plan", "no.yaml", "-o", "a.html"], "end in .json or .xlsx (for a page give --page"),
        (["plan", "no.yaml", "-o", "a.gif"], "(for a film: rightofway show PLAN -o a.gif)"),
        (["plan", "no.yaml", "-o", "a.csv"], "(for a table: rightofway table PLAN -o a.csv)"),
        (["improve", "no.json", "-o", "a.txt"], "'a.txt' does not end in .json or .xlsx (give a"),
        (["laps", "no.yaml", "-o", "a.html"], "(for a page give --page a.html)"),
        (["laps", "no.yaml", "--page", "a.json"], "'a.json' does not end in .html or .htm"),
        (["simulate", "no.json", "-o", "a.csv"], "'a.csv' does not end in .json"),
        (["plan", "no.yaml", "--page", "-"], "'-' does not end in .html or .htm"),
        (["show", "no.json"], "nothing to write (give --page FILE, or -o FILE for a picture)"),
        (["convert", "no.yaml"], "give one file to write: convert SOURCE -o TARGET"),
        (["convert", "no.yaml", "a.json", "-o", "b.json"], "give one file to write"),
    ],
)
def test_a_wrong_ending_is_refused_before_any_work(cli: Cli, args: list[str], message: str) -> None:
    """The inputs do not exist: the outputs are looked at first."""
    ended = cli(*args)
    assert (ended.code, message in ended.err) == (2, True)


@pytest.mark.parametrize("name", ["plan", "improve", "laps", "simulate", "show"])
def test_page_writes_a_page(cli: Cli, door: Path, name: str) -> None:
    with_plan(cli, door)
    source = door if name in {"plan", "laps"} else "plan.json"
    cli(name, source, "--page", "a.html")
    assert Path("a.html").read_text(encoding="utf-8").startswith("<!doctype html>")


def test_a_film_and_a_page_are_written_by_one_command(cli: Cli, door: Path) -> None:
    with_plan(cli, door)
    ended = cli("show", "plan.json", "-o", "a.gif", "--page", "a.html")
    assert ended.code == 0
    assert Path("a.gif").exists()
    assert Path("a.html").exists()


def test_a_dash_sends_the_result_to_standard_output(cli: Cli, door: Path) -> None:
    with_plan(cli, door)
    cli("show", "plan.json", "-o", "a.html")
    assert cli("show", "plan.json", "-o", "-").out == Path("a.html").read_text(encoding="utf-8")
    cli("convert", door, "-o", "a.yaml")
    assert cli("convert", door, "-o", "-").out == Path("a.yaml").read_text(encoding="utf-8")
    assert cli("convert", door, "-").out == Path("a.yaml").read_text(encoding="utf-8")
    cli("simulate", "plan.json", "--runs", "10", "-o", "a.json")
    ended = cli("simulate", "plan.json", "--runs", "10", "-o", "-")
    assert ended.out == Path("a.json").read_text(encoding="utf-8")


def test_a_plan_goes_to_a_device_whatever_its_name(cli: Cli, door: Path) -> None:
    assert cli("plan", door, "-o", "/dev/null").code == 0


def test_quiet_leaves_only_results_and_errors(cli: Cli, door: Path) -> None:
    ended = cli("plan", door, "-o", "plan.json", "-q")
    assert (ended.code, ended.out, ended.err) == (0, "", "")
    assert cli("-q", "check", "plan.json").out == ""
    assert json.loads(cli("check", "plan.json", "-q", "--json").out)["ok"]
    Path("swap.yaml").write_text(SWAP, encoding="utf-8")
    ended = cli("plan", "swap.yaml", "--option", "swaps=leave", "-q")
    assert (ended.code, ended.out) == (1, "")
    assert "the plan still has 1 fault" in ended.err


def test_the_version_has_a_short_option(cli: Cli) -> None:
    assert __version__ in cli("-V").out


def test_several_plans_are_checked_at_once(cli: Cli, door: Path) -> None:
    with_plan(cli, door)
    Path("swap.yaml").write_text(SWAP, encoding="utf-8")
    cli("plan", "swap.yaml", "-o", "swap.json", "--option", "swaps=leave")
    ended = cli("check", "plan.json", "swap.json")
    assert ended.code == 1
    assert "plan.json: no fault in 2 robots" in ended.out
    assert "swap.json: 1 fault: 1 swap conflict" in ended.out
    data = json.loads(cli("check", "plan.json", "swap.json", "--json").out)
    assert [(each["plan"], each["ok"]) for each in data] == [
        ("plan.json", True),
        ("swap.json", False),
    ]


def test_a_plan_that_cannot_be_read_does_not_keep_others_from_being_checked(
    cli: Cli, door: Path
) -> None:
    with_plan(cli, door)
    ended = cli("check", "nowhere.json", "plan.json")
    assert ended.code == 2
    assert ended.err == "nowhere.json: there is no such file (check the path)\n"
    assert "plan.json: no fault" in ended.out


def test_examples_that_were_not_copied_yet_say_how(cli: Cli) -> None:
    assert cli("plan", "examples/door.yaml").err == (
        "examples/door.yaml: there is no such file"
        " (rightofway examples --copy . writes the examples)\n"
    )


def test_plans_of_other_programs_are_taken_and_given(cli: Cli, door: Path) -> None:
    """Two robots share a door and stay where they go."""
    cli("convert", door, "-o", "hall.scen")
    cli("plan", "hall.scen", "-o", "plan.json")
    assert cli("convert", "plan.json", "--to", "lns2", "-o", "paths.txt").code == 0
    assert Path("paths.txt").read_text(encoding="utf-8").startswith("Agent 0: (0,0)->(0,")
    assert "the plan does not name its map (give it with --map" in cli("check", "paths.txt").err
    for name in ("check", "table", "collisions"):
        ended = cli(name, "paths.txt", "--map", "hall.map")
        assert (ended.code, ended.err) == (0, "")
    assert cli("check", "paths.txt", "--scen", "hall.scen").code == 0
    cli("convert", "paths.txt", "--scen", "hall.scen", "-o", "theirs.json")
    assert cli("show", "plan.json", "theirs.json", "--page", "both.html").code == 0
    improved = cli("improve", "paths.txt", "--map", "hall.map", "-o", "better.json")
    assert (improved.code, cli("check", "better.json").code) == (0, 0)
    assert cli("show", "paths.txt", "--map", "hall.map", "--page", "page.html").code == 0
    assert "paths.txt: is a plan of another program, not a" in cli("plan", "paths.txt").err
    assert "hall.scen: a .scen file holds a scenario, not a" in cli("check", "hall.scen").err


def test_what_another_format_leaves_out_is_reported(cli: Cli, door: Path) -> None:
    with_plan(cli, door)
    ended = cli("convert", "plan.json", "--to", "lns2", "-o", "paths.txt")
    assert "paths.txt: work, turning and ways back are left out" in ended.err


@pytest.mark.parametrize(
    ("args", "message"),
    [
        (["--map", "hall.yaml", "-o", "a.json"], "'hall.yaml' does not end in .map (give a .map"),
        (["--to", "lns", "-o", "a.txt"], "'lns' is no format (did you mean lns2?)"),
        (["-o", "a.txt"], "'a.txt' does not end in .yaml, .yml, .json, .xlsx or .scen"),
    ],
)
def test_a_format_that_is_not_known_is_refused(cli: Cli, args: list[str], message: str) -> None:
    ended = cli("convert", "nowhere.json", *args)
    assert (ended.code, message in ended.err) == (2, True)


@pytest.mark.parametrize("name", ["plan", "bound", "convert", "show"])
def test_the_first_robots_of_a_scen_file_are_taken_by_number(cli: Cli, name: str) -> None:
    target = {"convert": ["-o", "a.json"], "show": ["--page", "a.html"]}.get(name, [])
    assert cli(name, SCEN, "-k", "2", *target).code == 0
    ended = cli(name, EXAMPLES / "door.yaml", "--count", "1", *target)
    assert ended.code == 2
    assert "door.yaml: the count 1 is for a .scen file, and this is none" in ended.err


def test_more_robots_than_rows_are_refused_with_their_number(cli: Cli) -> None:
    ended = cli("bound", SCEN, "-k", "5000")
    assert (ended.code, "5000 is more than the 1000 rows" in ended.err) == (2, True)


def test_bounds_are_those_of_each_robot_alone(cli: Cli, door: Path) -> None:
    """R1 and R2 drive four cells, turn, and drive back: 4 + 1 + 4 ticks each."""
    assert cli("bound", door).out.splitlines() == [
        "flowtime  at least 18 time units",
        "makespan  at least 9 time units",
        "",
        "robot  alone",
        "R1         9",
        "R2         9",
    ]
    data = json.loads(cli("bound", door, "--json").out)
    assert data["lower_bound"] == {"flowtime": 18, "makespan": 9}
    assert data["robots"][1] == {"name": "R2", "alone": 9}


def test_a_bound_with_time_has_what_robots_lose_to_each_other(cli: Cli, door: Path) -> None:
    """Both robots need the door, so one of them is a tick later than alone: 9 + 10."""
    lines = cli("bound", door, "--time-limit", "10").out.splitlines()
    assert lines[2] == "flowtime, proven  at least 19 time units, and a plan reaches it"
    assert " ".join(lines[-2:]).startswith("In every plan, R1 and R2 lose at least 1 time unit to")
    data = json.loads(cli("bound", door, "--time-limit", "10", "--json").out)
    assert data["lower_bound"] == {"flowtime": 19, "makespan": 9}
    assert [(pair["robots"], pair["ticks"]) for pair in data["forced_losses"]] == [
        (["R1", "R2"], 1)
    ]


def test_help_groups_every_command_once_and_cuts_no_sentence(cli: Cli) -> None:
    listed = [name for group in GROUPS.values() for name in group]
    assert sorted(listed) == sorted(commands.commands)
    help_text = cli("--help").out
    assert "..." not in help_text.partition("Options:")[2]
    assert all(f"{title}:" in help_text for title in GROUPS)
