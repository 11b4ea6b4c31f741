"""Plans of every planner, on any fleet: two judges that share no code pass them, or none exists."""

from __future__ import annotations

import random
from dataclasses import replace
from fractions import Fraction
from math import sqrt

import numpy as np
import pytest
from hypothesis import strategies as st

import rightofway
from rightofway.cyclic import find_best_timetable, plan_of_laps, run_laps
from rightofway.errors import GaveUp, InputError, NoPlanExists
from rightofway.model import Plan, PlannerRun, Scenario, Track
from rightofway.precedence import build_graph
from rightofway.repair.routing import find_shortest_routes
from rightofway.report.quantities import Quantities
from rightofway.search import Distances
from rightofway.site.geometry import find_fractions
from tests.builders.any_fleet import LAPS_REFUSE, any_fleet
from tests.builders.any_plan import ALL, QUICK, STRICT, broken, by_both_judges, knows, planned
from tests.builders.fleets import grid_fleet
from tests.builders.laws import law, leave
from tests.builders.sizes import with_radii
from tests.oracles.judge import faults
from tests.oracles.space import encounters

seeds = st.integers(0, 2**32 - 1)


@law(any_fleet(), st.sampled_from(STRICT), seeds)
def test_a_plan_passes_both_judges_and_is_not_below_its_bound(
    fleet: Scenario, planner: str, seed: int
) -> None:
    plan = planned(fleet, planner, seed)
    assert by_both_judges(plan) == (set(), set())
    assert plan.flowtime >= plan.lower_bound


@law(any_fleet(), st.lists(st.sampled_from(STRICT), min_size=2, max_size=2, unique=True))
def test_where_one_planner_proves_that_no_plan_exists_no_other_one_finds_a_plan(
    fleet: Scenario, planners: list[str]
) -> None:
    ends = {_end(fleet, planner) for planner in planners}
    if None in ends:
        leave("a planner does not know such fleets")
    assert ends != {"none exists", "a plan"}


def _end(fleet: Scenario, planner: str) -> str | None:
    if not knows(planner, fleet):
        return None
    try:
        rightofway.solve(fleet, planner, None, options=QUICK.get(planner))
    except NoPlanExists:
        return "none exists"
    except GaveUp:
        return "gave up"
    return "a plan"


@law(any_fleet(), st.sampled_from(ALL), seeds)
def test_both_judges_find_the_same_faults(fleet: Scenario, planner: str, seed: int) -> None:
    plan, draw = planned(fleet, planner, seed), random.Random(seed)  # noqa: S311
    for _ in range(8):
        by_check, by_the_other = by_both_judges(broken(plan, draw))
        assert by_check == by_the_other


@law(any_fleet(robots=(1, 3)), st.sampled_from(STRICT), seeds)
def test_the_same_seed_gives_the_same_plan(fleet: Scenario, planner: str, seed: int) -> None:
    assert planned(fleet, planner, seed).tracks == planned(fleet, planner, seed).tracks


@law(any_fleet(robots=(2, 4)))
def test_both_judges_find_the_same_faults_where_nobody_heeds_others(fleet: Scenario) -> None:
    by_check, by_the_other = by_both_judges(heedless(fleet))
    assert by_check == by_the_other


@law(any_fleet(robots=(2, 4), always={"sizes"}))
def test_robots_that_come_too_close_come_as_close_as_the_oracle_finds(fleet: Scenario) -> None:
    plan = heedless(fleet)
    met = encounters(fleet, list(plan.tracks))
    found = [fault for fault in rightofway.check(plan).faults if fault.kind == "too close"]
    assert {fault.robots for fault in found} == set(met)
    for robots, square in met.items():
        within = f"come within {Quantities.of(fleet).format_length(sqrt(square))} ("
        assert any(fault.robots == robots and within in fault.message for fault in found)


def heedless(fleet: Scenario) -> Plan:
    """Return a plan in which each robot drives a shortest route as if it were alone."""
    try:
        routes = find_shortest_routes(fleet, Distances(fleet.roadmap))
    except NoPlanExists:
        leave("a robot has no way")
    graph = build_graph(replace(fleet, closures=()).problem, routes)
    return Plan(scenario=fleet, tracks=tuple(graph.build_tracks()), run=PlannerRun(name="heedless"))


@law(any_fleet(always={"limits"}), st.sampled_from(STRICT))
def test_moving_a_roadmap_changes_no_plan(fleet: Scenario, planner: str) -> None:
    points = [(x + 1000, y - 7000) for x, y in fleet.roadmap.list_positions()]
    roadmap = replace(
        fleet.roadmap, positions=np.array(points, np.float64), fractions=find_fractions(points)
    )
    moved = replace(fleet, roadmap=roadmap)
    assert planned(fleet, planner).tracks == planned(moved, planner).tracks


@law(any_fleet(robots=(1, 1), always={"stops"}, without=LAPS_REFUSE))
def test_laps_of_a_robot_alone_are_as_short_as_the_second_judge_allows(fleet: Scenario) -> None:
    """None of its visits may begin a tick sooner. Laps refuse closures and one way."""
    try:
        plan = plan_of_laps(run_laps(fleet))
    except (NoPlanExists, GaveUp):
        leave("no laps")
    except InputError:  # its only way has length 0: it stays at home
        leave("the robot does not drive")
    assert faults(plan) == faults(plan_of_laps(find_best_timetable(fleet, rounds=5))) == set()
    [track] = plan.tracks
    for visit in range(1, len(track)):
        sooner = track.enter.copy()
        sooner[visit:] -= 1
        shorter = Track(vertices=track.vertices, enter=sooner)
        assert faults(replace(plan, tracks=(shorter,))) == {("trip", (0,))}


def test_planners_refuse_fleets_that_they_do_not_know() -> None:
    """Closures and barred edges have tests of their own."""
    fleet = grid_fleet(["...."], [("N0", "N1")])
    sized = with_radii(fleet, [Fraction(1, 4)])
    turning = replace(fleet, rules=replace(fleet.rules, turn_rate=Fraction(90)))
    for planner in ALL:
        assert knows(planner, fleet)
        for other, message in (
            (sized, f"planner {planner} is for points: it leaves swaps"),
            (turning, f"planner {planner} does not know robots with a turn_rate"),
        ):
            if not knows(planner, other):
                with pytest.raises(InputError, match=message):
                    rightofway.solve(other, planner)
    with pytest.raises(InputError, match=r"swaps=leave does not know .* \(choose swaps=resolve\)"):
        rightofway.solve(sized, "two-level", swaps="leave")
