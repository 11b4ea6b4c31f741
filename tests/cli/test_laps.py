"""``rightofway laps``: what it prints, for people and for programs, and how it ends."""

import json
import time
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from types import SimpleNamespace

import pytest

from rightofway import load
from rightofway.cyclic import find_best_timetable
from rightofway.report.laps import report_comparison
from tests.cli.conftest import EXAMPLES, Cli

SLOWER = """
format: rightofway-scenario/1
map: {grid: ["...", "@.@", "..."]}
robots:
  - {name: R1, home: N0, target: N6, speed: 1/2}
  - {name: R2, home: N2, target: N8, speed: 1/3}
"""
"""The second door of the paper: one robot needs two units of time for a cell, the other three."""


@pytest.fixture(autouse=True)
def _seconds_of_this_process(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let time limits count the work of this process, so that other work takes none of it."""
    clock = SimpleNamespace(monotonic=time.process_time)
    monkeypatch.setattr("rightofway.deadline.time", clock)


@pytest.fixture
def slower(tmp_path: Path) -> Path:
    path = tmp_path / "slower.yaml"
    path.write_text(SLOWER, encoding="utf-8")
    return path


def test_the_report_sets_the_first_lap_against_the_later_ones(cli: Cli, slower: Path) -> None:
    ended = cli("laps", slower)
    assert ended.code == 0
    assert max(map(len, ended.out.splitlines())) <= 80
    assert "2 robots: period 30 time units, from time 8 on\n" in ended.out
    assert "R1               1        30     20  33.3%\n" in ended.out
    assert "  N7: R1 waits for R2, first lap at time 12; each period at time 19\n" in ended.out
    assert "  N1: R2 waits for R1, first lap at time 3\n" in ended.out
    assert "bottleneck: R2's own lap: it waits for no robot" in ended.out


def test_the_report_for_programs_has_exact_times(cli: Cli, slower: Path) -> None:
    ended = cli("laps", slower, "--json")
    [group] = json.loads(ended.out)["groups"]
    assert group["robots"] == ["R1", "R2"]
    assert (group["transient"], group["period"]) == (8, 30)
    assert group["laps_per_period"] == {"R1": 1, "R2": 1}
    assert group["mean_lap"] == {"R1": 30, "R2": 30}
    assert group["waiting_share"] == {"R1": "1/3", "R2": 0}
    assert group["conflicts"] == [
        {"vertex": "N1", "robots": ["R1", "R2"], "waits": "R1", "offset": 4, "for": 5},
        {"vertex": "N7", "robots": ["R1", "R2"], "waits": "R1", "offset": 19, "for": 5},
    ]
    assert {piece["robot"] for piece in group["bottleneck"]} == {"R2"}


def test_steps_of_a_bottleneck_have_kinds_and_names_and_no_sentence(cli: Cli) -> None:
    """A right of way names the robot that has to leave first."""
    [group] = json.loads(cli("laps", EXAMPLES / "bay.yaml", "--json").out)["groups"]
    steps = group["bottleneck"]
    assert {tuple(step) for step in steps} == {("kind", "robot", "after", "vertices", "for")}
    after = [(step["robot"], step["after"]) for step in steps if step["kind"] == "right of way"]
    assert sorted(after) == [("R1", "R2"), ("R1", "R3"), ("R2", "R1"), ("R3", "R1")]
    assert all(step["after"] is None for step in steps if step["kind"] != "right of way")


def test_times_are_in_the_units_of_the_scenario_or_in_ticks(cli: Cli, slower: Path) -> None:
    slower.write_text(SLOWER + "units: {length: m, time: s}\n", encoding="utf-8")
    ended = cli("laps", slower)
    assert "throughput  240 laps per hour\n" in ended.out
    assert "2 robots: period 30 s, from 8 s on\n" in ended.out
    assert "robot  laps/period  mean lap [s]  alone [s]  waits\n" in ended.out
    assert "  N7 (1.5, 2.5): R1 waits for R2, first lap at 12 s; each period at 19 s\n" in ended.out
    assert "2 robots: period 30 ticks, from tick 8 on\n" in cli("laps", slower, "--ticks").out
    data = json.loads(cli("laps", slower, "--json").out)
    assert (data["tick"], data["units"]) == (1, {"length": "m", "time": "s"})
    assert data["throughput_per_hour"] == 240


def test_throughput_is_per_hour_whatever_the_unit_of_time(cli: Cli, slower: Path) -> None:
    slower.write_text(SLOWER + "units: {time: min}\n", encoding="utf-8")
    assert "throughput  4 laps per hour\n" in cli("laps", slower).out


def test_a_robot_that_waits_for_ever_never_makes_a_lap(cli: Cli, slower: Path) -> None:
    ended = cli("laps", slower, "--rule", "fixed-order")
    assert "R2               0     never     30\n" in ended.out


def test_a_run_becomes_a_plan_that_check_accepts(cli: Cli, slower: Path) -> None:
    assert cli("laps", slower, "-o", "plan.json").code == 0
    assert cli("check", "plan.json").code == 0
    alone = cli("laps", slower, "-o", "-")
    assert json.loads(alone.out)["format"] == "rightofway-plan/1"


@pytest.mark.parametrize("rule", ["first-come", "fixed-order", "two-level"])
@pytest.mark.parametrize("example", ["door", "crossroad"])
def test_the_cases_of_the_paper_repeat_under_every_rule(cli: Cli, example: str, rule: str) -> None:
    assert cli("laps", EXAMPLES / f"{example}.yaml", "--rule", rule).code == 0


def test_a_robot_that_never_gets_the_right_of_way_is_named(cli: Cli, slower: Path) -> None:
    """R1 is back at the door before R2 could be through it, lap after lap."""
    ended = cli("laps", slower, "--rule", "fixed-order", "--routes", "shortest")
    assert "1 robot stands still permanently: R2 in N2 on its way to N1 (another" in ended.out


def test_a_standstill_ends_with_1_and_says_who(cli: Cli, tmp_path: Path) -> None:
    scenario = tmp_path / "corridor.yaml"
    scenario.write_text(
        'format: rightofway-scenario/1\nmap: {grid: ["...."]}\nrobots:\n'
        "  - {name: R1, home: N0, target: N3}\n  - {name: R2, home: N3, target: N0}\n",
        encoding="utf-8",
    )
    ended = cli("laps", scenario)
    assert ended.code == 1
    assert "waiting cannot keep R1 and R2 apart at N" in ended.out


def test_time_that_runs_out_ends_with_3_and_says_what_was_seen(cli: Cli) -> None:
    ended = cli("laps", EXAMPLES / "warehouse.yaml", "--time-limit", "0.5")
    assert ended.code == 3
    told = " ".join(ended.out.split())
    assert "no state came again within the time limit. Measured, not proven: means of " in told
    assert " laps per robot from time " in told
    found = json.loads(
        cli("laps", EXAMPLES / "warehouse.yaml", "--time-limit", "0.5", "--json").out
    )
    [group] = [group for group in found["groups"] if group["ends"] == "open"]
    assert group["measured"]["laps"].keys() == group["mean_lap"].keys()
    assert all(group["measured"]["laps"].values())
    assert None not in group["mean_lap"].values()


@pytest.mark.parametrize(
    ("args", "message"),
    [
        (["--rule", "last-come"], "'last-come' is not one of"),
        (["--time-limit", "0"], "0 is not positive"),
        (["-o", "-", "--json"], "both go to standard output"),
        (["--page", "l.json"], "'l.json' does not end in .html or .htm (give a name that does)"),
    ],
)
def test_bad_use_ends_with_2(cli: Cli, door: Path, args: list[str], message: str) -> None:
    ended = cli("laps", door, *args)
    assert ended.code == 2
    assert message in ended.err


def test_trips_without_a_way_back_are_refused_with_their_place(cli: Cli, slower: Path) -> None:
    slower.write_text(SLOWER + "rules: {return: none}\n", encoding="utf-8")
    ended = cli("laps", slower)
    assert ended.code == 2
    assert "rules.return: 'none' leaves nothing to repeat (set return: home)" in ended.err


def test_a_chosen_timetable_reports_its_gain_and_its_fairness(cli: Cli, slower: Path) -> None:
    ended = cli("laps", slower, "--rule", "timetable", "--time-limit", "2", "-o", "plan.json")
    assert ended.code == 0
    assert "against first come first served\n" in ended.out
    assert "fairness: every robot makes at least " in ended.out
    assert cli("check", "plan.json").code == 0


def test_a_timetable_below_its_baseline_says_so(slower: Path) -> None:
    [group] = find_best_timetable(load(slower), time_limit=None, rounds=2).groups
    assert group.comparison is not None
    found = group.comparison
    worse = replace(found, baseline_ends="open", baseline=found.throughput * 2)
    said = " ".join(" ".join(report_comparison(worse)).split())
    assert "throughput: 50.00% below first come first served as measured within its time" in said


def test_what_would_help_is_exact_for_programs(cli: Cli, slower: Path) -> None:
    ended = cli("laps", slower, "--json")
    [group] = json.loads(ended.out)["groups"]
    # R2's own lap decides: 24 of its 30 are driving, 6 are turning at home and away, each in the
    # time in which it crosses a cell.
    assert [(lever["kind"], lever["gain"]) for lever in group["sensitivity"]] == [
        ("speed", 30),
        ("turn", 6),
    ]
    assert group["sensitivity"][0]["ten_per_cent"] == str(Fraction(300, 11))


def test_the_period_is_written_as_a_function_of_each_parameter(cli: Cli, slower: Path) -> None:
    [group] = json.loads(cli("laps", slower, "--json").out)["groups"]
    found = group["curves"]
    assert found["exact"]
    by_name = {(one["kind"], one["robot"]): one for one in found["curves"]}
    # R2's own lap: 8 cells, and 2 turns that take as long as a cell each.
    slow, fast = by_name["speed", "R2"]["pieces"]
    assert (slow["from"], slow["fixed"], slow["slope"]) == ("1/12", 0, 10)
    # At half a cell per unit of time that is 20, as long as the lap of R1.
    assert (slow["to"], fast["from"], fast["to"]) == ("1/2", "1/2", "4/3")
    pieces = found["circuits"][slow["circuit"]]["pieces"]
    assert {piece["robot"] for piece in pieces} == {"R2"}
    assert by_name["headway", None]["value"] == 0


def test_a_part_that_is_no_number_is_refused(cli: Cli, slower: Path) -> None:
    ended = cli("laps", slower, "--rule", "timetable", "--least-fairness", "half")
    assert ended.code == 2
    assert "'half' is not a number (for example 0.5 or 1/2)" in ended.err


def test_a_timetable_chooses_its_routes_itself(cli: Cli, slower: Path) -> None:
    ended = cli("laps", slower, "--rule", "timetable", "--routes", "shortest")
    assert ended.code == 2
    assert "--rule timetable chooses routes itself (leave out --routes)" in ended.err


def test_a_timetable_that_is_proven_impossible_ends_as_a_plan_does(
    cli: Cli, tmp_path: Path
) -> None:
    """Three cells in a row: each robot would have to pass the other one."""
    path = tmp_path / "row.yaml"
    path.write_text(
        'format: rightofway-scenario/1\nmap: {grid: ["..."]}\nrobots:\n'
        "  - {name: R1, home: N0, target: N2}\n  - {name: R2, home: N2, target: N0}\n",
        encoding="utf-8",
    )
    planned, laps = cli("plan", path), cli("laps", path, "--rule", "timetable")
    assert (planned.code, laps.code) == (1, 1)
    assert "no plan exists" in planned.err
    assert "no plan exists" in laps.err


TWICE = """
format: rightofway-scenario/1
map: {grid: ["..@", "@..", "@@."]}
robots:
  - {name: R1, home: N4, target: N1}
  - {name: R3, home: N5, target: N0, speed: 1/2}
"""
"""On one line, with R3 on the wrong side of R1: laps without end exist, and no way into them."""


def test_a_timetable_that_robots_at_home_cannot_begin_is_not_offered(
    cli: Cli, tmp_path: Path
) -> None:
    given = tmp_path / "line.yaml"
    given.write_text(TWICE, encoding="utf-8")
    ended = cli("laps", given, "--rule", "timetable", "--time-limit", "2", "--page", "l.html")
    assert ended.code == 1
    assert "R1 and R3 block each other" in ended.err
    assert not Path("l.html").exists()
