"""Flowtime, makespan, gap, waiting and detours, counted by hand."""

from __future__ import annotations

import json
from collections.abc import Sequence
from fractions import Fraction

import pytest

from rightofway.errors import NoPlanExists
from rightofway.metrics import measure
from rightofway.model import (
    Plan,
    PlannerRun,
    Robot,
    Rules,
    Scenario,
    Stop,
    Track,
    compute_completions,
)
from rightofway.site import make_grid_roadmap
from tests.builders.fleets import PAPER, grid_fleet, paper_scenario

DOOR = ["...", "@.@", "..."]
ONE_WAY = Rules(ends="none")

OUT_AND_BACK = "N0 N1 N4 N7 N6 N7 N4 N1 N0"


def make_plan(scenario: Scenario, *trips: tuple[str, Sequence[int]]) -> Plan:
    """Make a plan of trips: names of vertices, and when each is entered."""
    vertex = scenario.roadmap.get_vertex
    tracks = (Track.of([vertex(name) for name in names.split()], enter) for names, enter in trips)
    return Plan(scenario=scenario, tracks=tuple(tracks), run=PlannerRun(name="by hand"))


def test_a_published_plan_measures_as_its_table_says() -> None:
    """Table 4: alone each robot is home at tick 9; R1 waits one tick, so it is home at 10."""
    plan = make_plan(
        paper_scenario(PAPER[0]),
        (OUT_AND_BACK, [0, 2, 3, 4, 5, 7, 8, 9, 10]),
        ("N2 N1 N4 N7 N8 N7 N4 N1 N2", [0, 1, 2, 3, 4, 6, 7, 8, 9]),
    )
    metrics = measure(plan)
    assert metrics.as_dict() == {
        "flowtime": 19,
        "makespan": 10,
        "lower_bound": 18,
        "waiting": 1,
        "moves": 16,
        "completions": [10, 9],
        "alone": [9, 9],
    }
    assert metrics.gap == pytest.approx(1 / 18)
    assert metrics.detours == 0


def test_files_get_plain_integers() -> None:
    plan = make_plan(grid_fleet(DOOR, [("N0", "N1")]), ("N0 N1 N0", [0, 1, 3]))
    assert json.loads(json.dumps(measure(plan).as_dict()))["flowtime"] == 3


def test_one_way_the_last_work_belongs_to_the_completion() -> None:
    scenario = grid_fleet(DOOR, [("N0", "N4")], rules=ONE_WAY, work=[5])
    metrics = measure(make_plan(scenario, ("N0 N1 N4", [0, 1, 4])))
    # There at tick 4 after 2 ticks of waiting, and 5 of work; no turning.
    assert (metrics.flowtime, metrics.lower_bound, metrics.waiting) == (9, 7, 2)


def test_a_longer_way_is_a_detour_and_no_waiting() -> None:
    scenario = grid_fleet(["...", "..."], [("N0", "N2")], rules=ONE_WAY)
    metrics = measure(make_plan(scenario, ("N0 N3 N4 N5 N2", [0, 1, 2, 3, 5])))
    # Five ticks instead of two: two more to drive, one of waiting in N5.
    assert (metrics.flowtime, metrics.lower_bound) == (5, 2)
    assert (metrics.detours, metrics.waiting, metrics.moves) == (2, 1, 4)
    assert metrics.gap == 1.5


def test_work_and_turning_are_no_waiting() -> None:
    # 3 of work and 1 of turning in N1, then home.
    scenario = grid_fleet(DOOR, [("N0", "N1")], work=[3])
    assert measure(make_plan(scenario, ("N0 N1 N0", [0, 1, 6]))).waiting == 0
    assert measure(make_plan(scenario, ("N0 N1 N0", [0, 1, 8]))).waiting == 2


def test_nothing_to_do_has_no_gap() -> None:
    scenario = grid_fleet(DOOR, [("N0", "N0")], rules=ONE_WAY)
    assert measure(make_plan(scenario, ("N0", [0]))).gap == 0


def test_doing_something_where_nothing_is_needed_has_no_gap_either() -> None:
    scenario = grid_fleet(DOOR, [("N0", "N0")], rules=ONE_WAY)
    assert measure(make_plan(scenario, ("N0 N1 N0", [0, 1, 2]))).gap is None


def test_the_work_at_the_end_of_a_trip_counts_after_the_last_arrival() -> None:
    """R1 stands in N1 from 1 to 5, makes room, is back at 7, and works there for 3."""
    scenario = grid_fleet(DOOR, [("N0", "N1")], rules=ONE_WAY, work=[3])
    plan = make_plan(scenario, ("N0 N1 N4 N1", [0, 1, 6, 7]))
    assert compute_completions(scenario, plan.tracks) == (10,)


def test_a_visit_serves_only_what_it_has_time_for() -> None:
    """Twice 2 of work at N1; the first visit has 3 ticks, which is one work and its turning."""
    roadmap = make_grid_roadmap(DOOR)
    stop = Stop(at=roadmap.get_vertex("N1"), work=Fraction(2))
    robot = Robot(name="R1", home=roadmap.get_vertex("N0"), stops=(stop, stop))
    scenario = Scenario(roadmap=roadmap, robots=(robot,), rules=ONE_WAY)
    plan = make_plan(scenario, ("N0 N1 N4 N1", [0, 1, 5, 6]))
    assert compute_completions(scenario, plan.tracks) == (6 + 2,)


def test_without_a_way_there_is_no_bound() -> None:
    scenario = grid_fleet([".@."], [("N0", "N2")])
    plan = make_plan(scenario, ("N0", [0]))
    with pytest.raises(NoPlanExists, match=r"^R1 has no way from N0 to N2: the map is in parts"):
        measure(plan)


def test_times_are_ticks_of_the_fleet() -> None:
    # Speeds 1 and 2/3: edges of 1 and 3/2, so that a tick is 1/2 and they take 2 and 3.
    scenario = grid_fleet(
        ["..", ".."],
        [("N0", "N1"), ("N2", "N3")],
        rules=ONE_WAY,
        speeds=[Fraction(1), Fraction(2, 3)],
    )
    assert measure(make_plan(scenario, ("N0 N1", [0, 2]), ("N2 N3", [0, 3]))).completions == (2, 3)
