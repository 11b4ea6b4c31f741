"""Suites of shifts: fleets of several sizes, their figures, and the least fleet."""

from __future__ import annotations

import json
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest

from rightofway.bench import (
    Case,
    FleetSizes,
    Row,
    compare_fleet_sizes,
    read_suite,
    write_report,
)
from rightofway.bench.run import run
from rightofway.model import Scenario

SCENARIO = """
format: rightofway-scenario/1
units: {time: s}
map:
  roadmap:
    vertices: {a: [0, 0], b: [1, 0], c: [2, 0], d: [3, 0], e: [4, 0], p: [1, 1], q: [2, 1]}
    edges: [[a, b], [b, c], [c, d], [d, e], [b, p], [c, q]]
    parking: [p, q]
    charging: [a]
robots:
  - {name: R1, home: a, battery: tank}
  - {name: R2, home: e, battery: tank, charging: [e], speed: 2}
batteries: {tank: {drive: 1/50, charge: 1/5, reserve: 1/10}}
charging: [e]
rules: {turn: 0}
jobs:
  - {name: J1, at: b, work: 2, due: 4}
  - {name: J2, at: d, work: 2, due: 4}
  - {name: J3, at: c, work: 2, due: 9, earliest: 5}
"""
"""R1 is at b after 1 s, R2 at d after 0.5 s."""


@pytest.fixture
def directory(tmp_path: Path) -> Path:
    (tmp_path / "hall.yaml").write_text(SCENARIO, encoding="utf-8")
    return tmp_path


def read_cases(directory: Path, text: str) -> tuple[Case, ...]:
    path = directory / "suite.toml"
    path.write_text(f'format = "rightofway-suite/1"\n{text}', encoding="utf-8")
    return read_suite(path)


def read_one(directory: Path, counts: str, fleet: str = "") -> Scenario:
    [case] = read_cases(
        directory,
        f'[[maps]]\nscenario = "hall.yaml"\ncounts = {counts}\n'
        f'[[fleets]]\nname = "x"\n{fleet}\n[[planners]]\nname = "shift"\n',
    )
    return case.make_scenario()


def list_homes(scenario: Scenario) -> dict[str, str]:
    return {robot.name: scenario.roadmap.name(robot.home) for robot in scenario.robots}


def test_a_smaller_fleet_has_the_first_robots(directory: Path) -> None:
    assert list_homes(read_one(directory, "[1]")) == {"R1": "a"}


def test_robots_beyond_those_of_the_scenario_are_copies_that_park(directory: Path) -> None:
    scenario = read_one(directory, "[4]")
    homes = list_homes(scenario)
    assert list(homes) == ["R1", "R2", "R1-2", "R2-2"]
    assert {homes["R1-2"], homes["R2-2"]} == {"p", "q"}
    assert [robot.speed for robot in scenario.robots] == [1, 2, 1, 2]
    assert scenario.robots[3].charging == scenario.robots[1].charging


def test_a_fleet_changes_speeds_rules_and_chargers(directory: Path) -> None:
    plain = read_one(directory, "[2]")
    assert [robot.speed for robot in plain.robots] == [1, 2]
    changed = read_one(directory, "[2]", "speeds = [3, 4]\nheadway = 2\nchargers = 1")
    assert [robot.speed for robot in changed.robots] == [3, 4]
    assert [plain.rules.headway, changed.rules.headway] == [0, 2]
    # The places of the map come first, and R2 has lost its own one.
    names = [changed.roadmap.name(at) for at in changed.roadmap.drawing.charging]
    assert (names, changed.charging) == (["a"], (0,))
    assert changed.robots[1].charging is None


def test_a_scenario_without_counts_is_taken_as_it_is(directory: Path) -> None:
    [case] = read_cases(
        directory,
        'counts = [1]\nmaps = [{scenario = "hall.yaml"}]\nfleets = [{name = "x", speeds = [9]}]\n'
        'planners = [{name = "shift"}]\n',
    )
    assert (case.fleet, case.robots, float(case.limit or 0)) == ("", 2, 1.0)
    assert [robot.speed for robot in case.make_scenario().robots] == [1, 2]


def run_shift(directory: Path, count: int, options: str) -> dict[str, Any]:
    [case] = read_cases(
        directory,
        f'maps = [{{scenario = "hall.yaml", counts = [{count}]}}]\n'
        f'planners = [{{name = "shift", options = {options}}}]\n',
    )
    return run(case)


def test_a_case_of_a_shift_has_its_figures(directory: Path) -> None:
    outcome = run_shift(directory, 2, "{lead = 0}")
    assert (outcome["status"], outcome["valid"]) == ("solved", True)
    assert outcome["message"] == "3 of 3 jobs done, 3 in time"
    figures = json.loads(outcome["figures"])
    # J1 ends at 3 s, J2 at 2.5 s; J3 can end at 7 s.
    assert figures["service_median"] in {2.5, 3}
    assert (figures["known"], figures["done"], figures["in_time"]) == (3, 3, 3)
    assert figures["time_unit"] == "s"
    uses = ("driving", "waiting", "working", "charging", "idle")
    assert sum(figures[part] for part in uses) == pytest.approx(1, abs=1e-3)


def test_one_robot_is_late(directory: Path) -> None:
    """R1 ends J1 at 3 s, is at d at 5 s and ends J2 there at 7 s."""
    assert run_shift(directory, 1, "{lead = 0}")["message"].startswith("3 of 3 jobs done, ")
    assert json.loads(run_shift(directory, 1, "{lead = 0}")["figures"])["in_time"] < 3


def test_a_shift_with_delays_is_not_judged(directory: Path) -> None:
    outcome = run_shift(directory, 2, '{lead = 0, delays = "exponential:0.1", until = 40}')
    assert (outcome["status"], outcome["valid"]) == ("solved", None)


def test_the_arrival_rate_is_an_option(directory: Path) -> None:
    outcome = run_shift(directory, 2, '{lead = 0, known = "uniform:100"}')
    assert json.loads(outcome["figures"])["throughput"] < 3 / 20


def make_row(robots: int, in_time: int, seed: int = 0, **values: Any) -> Row:
    """Return the row of a shift of 10 jobs in 1000 s, with 3 s of service for each robot."""
    figures = {
        "known": 10, "done": 10, "in_time": in_time, "time_unit": "s", "throughput": 0.01,
        "service_median": 3.0 * robots, "service_p95": None, "driving": 0.5, "waiting": 0.1,
        "working": 0.2, "charging": 0.0, "idle": 0.2,
    }  # fmt: skip
    return {
        "key": f"{robots} {seed} {values}", "map": "hall", "fleet": "slow", "planner": "shift",
        "options": "", "robots": robots, "seed": seed, "limit": 1.0, "solved": True,
        "version": "0.1.0", "commit": "", "cpu": "abacus", "cores": 2, "compiler": "GCC 12",
        "python": "3.11.0", "figures": json.dumps(figures), **values,
    }  # fmt: skip


ROWS = [make_row(5, 10), make_row(3, 9), make_row(1, 4), make_row(3, 10, seed=1)]


def compare(rows: list[Row]) -> FleetSizes:
    [sizes] = compare_fleet_sizes(rows)
    return sizes


def test_sizes_are_in_order_and_the_worst_seed_counts() -> None:
    sizes = compare(ROWS).sizes
    assert [(size.robots, size.cases, size.in_time) for size in sizes] == [
        (1, 1, 0.4), (3, 2, 0.9), (5, 1, 1.0),
    ]  # fmt: skip
    assert [size.service_median for size in sizes] == [3, 9, 15]
    assert sizes[0].rate == 36  # 0.01 a second


@pytest.mark.parametrize(
    ("share", "sentence"),
    [
        ("9/10", "hall, slow: 3 robots for 90 % of jobs in time; 1 is too few."),
        ("19/20", "hall, slow: 5 robots for 95 % of jobs in time; 3 are too few."),
        ("2/5", "hall, slow: 1 robot for 40 % of jobs in time; no fewer were tried."),
    ],
)
def test_the_least_fleet_is_named(share: str, sentence: str) -> None:
    assert compare(ROWS).describe_least(Fraction(share)) == sentence


def test_where_no_fleet_is_enough_the_best_one_is_named() -> None:
    text = "hall, slow: no fleet has 100 % of jobs in time; the most is 90.0 %, with 3 robots."
    assert compare(ROWS[1:3]).describe_least(Fraction(1)) == text


def test_a_size_with_a_shift_that_failed_is_not_the_least() -> None:
    failed = make_row(3, 10, seed=1, solved=False)
    least = compare([make_row(3, 10), failed, make_row(5, 10)]).find_least(Fraction(1))
    assert least is not None
    assert least.robots == 5


def test_options_that_differ_make_series_of_their_own() -> None:
    rows = [make_row(1, 4, options=f"known=poisson:1/{gap}") for gap in (20, 30)]
    titles = [sizes.title for sizes in compare_fleet_sizes(rows)]
    assert titles == ["hall, slow, known=poisson:1/20", "hall, slow, known=poisson:1/30"]


def test_the_report_has_the_plot_the_tables_and_the_sentence(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    write_report(ROWS, tmp_path / "r.md", "Fleets", in_time=Fraction(9, 10))
    text = (tmp_path / "r.md").read_text(encoding="utf-8")
    assert "![Throughput, service times and jobs in time by number of robots](r-fleets.png)" in text
    assert "| 3 | 2/2 | 20/20 | 90.0 % | 36.0 | 9.0 | - | 10 % | 20 % |" in text
    assert "3 robots for 90 % of jobs in time; 1 is too few." in text
    assert "cactus" not in text
    assert (tmp_path / "r-fleets.png").read_bytes()[1:4] == b"PNG"
    write_report(ROWS, tmp_path / "r.html", "Fleets")
    assert (tmp_path / "r.html").read_text(encoding="utf-8").count("data:image/svg+xml") == 1
