"""``table`` and ``collisions`` as a user types them."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import pytest

from tests.cli.conftest import SWAP, Cli

CROSSING = """\
format: rightofway-scenario/1
map: {grid: ["@.@", "...", "@.@"]}
units: {length: m, time: s}
robots:
  - {name: R1, home: N3, target: N5}
  - {name: R2, home: N1, target: N7}
"""


@pytest.fixture
def plan(cli: Cli) -> str:
    """Return the file of a plan with a swap that the published method leaves."""
    Path("swap.yaml").write_text(SWAP, encoding="utf-8")
    options = ("--planner", "two-level", "--option", "swaps=leave")
    assert cli("plan", "swap.yaml", *options, "-o", "plan.json").code == 1
    return "plan.json"


def test_the_window_is_given_in_time_or_in_ticks(cli: Cli) -> None:
    Path("fast.yaml").write_text(SWAP.replace("home: N0", "speed: 2, home: N0"), encoding="utf-8")
    cli("plan", "fast.yaml", "-o", "fast.json")
    in_time = cli("table", "fast.json", "--from", "1", "--to", "3/2", "-o", "-").out
    assert in_time.startswith("robot,row,1,1.5\n")
    in_ticks = cli("table", "fast.json", "--from", "2", "--to", "3", "--ticks", "-o", "-").out
    assert in_ticks == in_time.replace("1,1.5", "2,3")


def test_a_place_has_one_number_in_report_log_table_and_collisions(cli: Cli) -> None:
    """N3 is the home of R1, N4 the crossing: 1.5 to the right and 1.5 down."""
    Path("crossing.yaml").write_text(CROSSING, encoding="utf-8")
    planned = cli("plan", "crossing.yaml", "--planner", "two-level", "--log", "-o", "p.json")
    words = " ".join(planned.out.split())
    assert "R1 waits 1 s in the home of R1 (N3) for R2 to leave N4 (1.5, 1.5)." in words
    assert "At 1 s: R1 and R2 would both have been in N4 (1.5, 1.5). R1 waits 1 s" in words
    shown = cli("table", "p.json").out
    assert "R1 final    3= 3" in shown
    assert "3: the cell N3 of reports" in shown
    assert "N4     collision" in cli("collisions", "p.json").out


@pytest.mark.parametrize(
    ("args", "message"),
    [
        (["--step", "0"], "--step: 0 is not positive (give the time of a column)"),
        (["--from", "1e99999999"], "'1e99999999' is out of range"),
        (["--from", "40"], "--from: 40 is too late: everything has ended at time 22 (give less)"),
        (["--from", "4", "--to", "3"], "--to: 3 is before --from, 4 (give 4 or more)"),
        (["--to", "3 s"], "'3 s' is not a number (write it like 3, 0.5 or 1/3)"),
        (["--from", "-1"], "'-1' is negative (give 0 or more)"),
        (
            ["--events", "--decision", "1"],
            "--all, --events and --decision are different: choose one",
        ),
        (["-o", "t.pdf"], "'t.pdf' does not end in .txt, .csv or .xlsx"),
        (["-o", "-", "--json"], "--json and -o - both go to standard output"),
        (["--decision", "2"], "--decision: 2 is not there, the last one is 1"),
        (["--robots", "R3"], "no robot is named 'R3'"),
    ],
)
def test_what_cannot_be_shown_is_refused_with_the_names_of_options(
    cli: Cli, plan: str, args: list[str], message: str
) -> None:
    ended = cli("table", plan, *args)
    assert (ended.code, ended.out) == (2, "")
    assert message in " ".join(ended.err.split())


def test_events_go_to_text_csv_workbook_and_json(cli: Cli, plan: str) -> None:
    text = cli("table", plan, "--events").out
    assert "R2     N4     wait                      4      7      1  R1         N7" in text
    assert cli("table", plan, "--events", "-o", "e.txt").code == 0
    assert Path("e.txt").read_text(encoding="utf-8") == text
    assert cli("table", plan, "--events", "-o", "e.xlsx").code == 0
    assert Path("e.xlsx").read_bytes().startswith(b"PK")
    rows = list(csv.DictReader(cli("table", plan, "--events", "-o", "-").out.splitlines()))
    data = json.loads(cli("table", plan, "--events", "--json").out)["events"]
    assert [row["place"] for row in rows] == [row["vertex"] for row in data]
    assert data[11] == {
        "robot": "R2", "visit": 2, "vertex": "N4", "purpose": "wait", "enter": 4, "leave": 7,
        "waits": 1, "waits_for": "R1", "to_leave": "N7",
    }  # fmt: skip


def test_both_movement_groups_of_a_decision_are_timetables(cli: Cli, plan: str) -> None:
    """R1 waiting gives 11 + 21, R2 waiting 9 + 22: the smaller sum, and a swap."""
    lines = cli("table", plan, "--decision", "1").out.splitlines()
    assert lines[0] == "Decision 1: R1 and R2 meet at N7 at time 6."
    assert lines[5] == "R1 list 1    0   1   4   7   6   6=  6=  6   7   4   1   0"
    assert lines[7] == "R1 list 2    0   1   4   7   6   6   7!  4!  1   0"
    assert lines[-3:] == [
        "List 1: W(R1) + W(R2) = 11 + 21 = 32 time units",
        "List 2: W(R1) + W(R2) = 9 + 22 = 31 time units",
        "R2 waits (robot level).",
    ]
    data = json.loads(cli("table", plan, "--decision", "1", "--json").out)
    assert data["completions"] == [[11, 21], [9, 22]]
    assert [row["kind"] for row in data["rows"]] == ["planned"] * 2 + ["list 1"] * 2 + [
        "list 2"
    ] * 2


def test_collisions_of_a_scenario_are_those_of_free_running_robots(cli: Cli) -> None:
    Path("swap.yaml").write_text(SWAP, encoding="utf-8")
    out = cli("collisions", "swap.yaml").out
    assert out.startswith("On the shortest routes, without waits: 1 collision and 0 swaps.\n")
    assert "R1       R2          6      7  N7     collision" in out
    told = "On the shortest routes, without waits: 1 collision and 0 swaps, in 1 tick.\n"
    assert cli("collisions", "swap.yaml", "--each-tick").out.startswith(told)
    ticks = cli("collisions", "swap.yaml", "--each-tick", "-o", "-").out
    assert ticks == "i,j,t,n,kind\nR1,R2,6,N7,collision\n"


def test_collisions_of_a_plan_go_on_with_decisions_and_what_is_left(cli: Cli, plan: str) -> None:
    out = cli("collisions", plan).out
    assert "  1     6  N7     R1  R2  R2     N4      1  robot       1     0     0     0" in out
    assert "Left in the plan: 0 collisions and 1 swap." in out
    data = json.loads(cli("collisions", plan, "--json").out)
    assert data["decisions"][0]["conflicts_before"] == 1
    assert data["left"] == [
        {"robots": ["R1", "R2"], "vertices": ["N7", "N4"], "start": 7, "end": 7, "kind": "swap"}
    ]


def test_a_planner_plans_a_scenario_first(cli: Cli) -> None:
    Path("swap.yaml").write_text(SWAP, encoding="utf-8")
    out = cli("collisions", "swap.yaml", "--planner", "two-level").out
    assert "On the routes of the plan, without waits: 1 collision and 0 swaps." in out
    assert "Left in the plan: 0 collisions and 0 swaps." in out
