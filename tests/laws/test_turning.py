"""Robots that need time to turn: searches and planners, against exhaustive ones and the judge."""

from __future__ import annotations

import random
from dataclasses import replace
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rightofway import check, simulate, solve
from rightofway.errors import NoPlanExists
from rightofway.metrics import alone, lost_time
from rightofway.model import Plan, Rules, Scenario, route_of
from rightofway.planners import registered
from rightofway.search import Bookings, Distances, alone_completions, earliest_track
from tests.builders.booked import booked_on, table_of
from tests.builders.fleets import grid_fleet, random_fleet
from tests.builders.seeds import seeds
from tests.builders.sizes import sized, sized_on_lanes
from tests.builders.turning import few_turning, fleet_on_lanes, turning
from tests.oracles.sipp import Booked, earliest_completion
from tests.oracles.turning import least_flowtime, turn

GRIDS = (["...", ".@.", "..."], ["....", "@.@@"], [".....", "..@..", "....."])
HORIZON = 90
PLANNERS = sorted(name for name, spec in registered().items() if spec.knows_turns)


@st.composite
def problems(draw: st.DrawFn) -> tuple[Scenario, list[Booked]]:
    """Draw a robot that turns, on a grid or on lanes, and bookings of others."""
    rules = Rules(
        occupancy=draw(st.sampled_from(["one", "both"])),
        headway=Fraction(draw(st.integers(0, 2))),
        ends=draw(st.sampled_from(["home", "none"])),
        turn_rate=draw(st.sampled_from([Fraction(45), Fraction(60), Fraction(180)])),
        turn=draw(st.sampled_from([None, None, Fraction(1)])),
    )
    work = draw(st.integers(0, 2))
    if draw(st.booleans()):
        grid = draw(st.sampled_from(GRIDS))
        free = [f"N{k}" for k, cell in enumerate("".join(grid)) if cell == "."]
        trip = (draw(st.sampled_from(free)), draw(st.sampled_from(free)))
        scenario = grid_fleet(grid, [trip], rules=rules, work=[work])
    else:
        scenario = fleet_on_lanes(draw(st.integers(0, 99)), robots=1, work=work, rules=rules)
    return scenario, draw(booked_on(scenario.roadmap))


@settings(max_examples=60, deadline=None, derandomize=True)
@given(problems())
def test_the_search_finds_the_earliest_completion(drawn: tuple[Scenario, list[Booked]]) -> None:
    scenario, booked = drawn
    problem = scenario.problem
    itinerary = problem.itineraries[0]
    track = earliest_track(0, table_of(problem, booked), Distances(scenario.roadmap))
    best = earliest_completion(
        scenario.roadmap,
        itinerary,
        booked,
        headway=problem.headway,
        books_ahead=problem.books_ahead,
        horizon=HORIZON,
        turn=lambda before, at, to: turn(scenario, 0, before, at, to),
    )
    if track is None or len(track) == 1:  # a trip that stays at home needs no time to get there
        assert best is None or track is not None
    else:
        done = int(track.enter[-1]) + route_of(scenario.roadmap, itinerary, track).dwell[-1]
        assert done == best or (best is None and done > HORIZON)


def keeps_turns(plan: Plan) -> bool:
    """Return whether each visit has time for its turn, by the oracle's angles."""
    for robot, track in enumerate(plan.tracks):
        drives = plan.scenario.problem.itineraries[robot].edge_ticks
        vertices, enter = track.vertices.tolist(), track.enter.tolist()
        for k in range(1, len(vertices) - 1):
            edge = plan.scenario.roadmap.edge(vertices[k], vertices[k + 1])
            assert edge is not None
            least = turn(plan.scenario, robot, *vertices[k - 1 : k + 2])
            least += drives[plan.scenario.roadmap.length_class[edge]]
            if enter[k + 1] - enter[k] < least:
                return False
    return True


@pytest.mark.parametrize("planner", PLANNERS)
@pytest.mark.parametrize("seed", seeds(6, 1))
def test_every_planner_gives_turns_their_time(planner: str, seed: int) -> None:
    """Grids, where robots follow each other at one instant or book ahead, rest and work."""
    draw = random.Random(seed)  # noqa: S311 (no secret depends on it)
    rules = (
        Rules(),
        Rules(occupancy="both"),
        Rules(headway=Fraction(1), laps=2),
        Rules(ends="none"),
        Rules(rotations=False),
        Rules(turn=Fraction(1)),
    )[seed]
    plan = solve(turning(random_fleet(seed, size=6, robots=6, rules=rules), draw), planner)
    assert check(plan).ok
    assert keeps_turns(plan)
    assert plan.lower_bound <= plan.flowtime


@pytest.mark.parametrize("planner", [name for name in PLANNERS if registered()[name].knows_sizes])
@pytest.mark.parametrize("seed", seeds(6, 1))
def test_every_planner_gives_turns_of_robots_with_sizes_their_time(planner: str, seed: int) -> None:
    draw = random.Random(seed)  # noqa: S311 (no secret depends on it)
    for scenario in (sized(seed, robots=3), sized_on_lanes(seed)):
        try:
            plan = solve(turning(scenario, draw), planner)
        except NoPlanExists:
            continue
        assert check(plan).ok
        assert keeps_turns(plan)


@pytest.mark.parametrize("seed", seeds(40, 2))
def test_auto_finds_the_optimum_of_two_robots_with_sizes(seed: int) -> None:
    scenario = few_turning(seed, sizes=True)
    least = least_flowtime(scenario)
    try:
        plan = solve(scenario)
    except NoPlanExists:
        assert least is None
        return
    assert check(plan).ok
    assert plan.flowtime == least
    assert plan.lower_bound <= least


@pytest.mark.slow
def test_auto_finds_the_optimum_of_two_points_in_nine_of_ten_cases() -> None:
    found = []
    for seed in range(20):
        scenario = few_turning(seed, sizes=False)
        least = least_flowtime(scenario)
        try:
            plan = solve(scenario)
        except NoPlanExists:
            assert least is None
            continue
        assert check(plan).ok
        assert least is not None
        assert plan.flowtime >= least
        found.append(plan.flowtime == least)
    assert sum(found) >= 0.9 * len(found)


@pytest.mark.parametrize("seed", seeds(10, 3))
def test_the_bound_of_a_robot_alone_is_what_it_reaches_alone(seed: int) -> None:
    """By tables of the native core, by the metrics, and by the search itself."""
    draw = random.Random(seed)  # noqa: S311 (no secret depends on it)
    fleet = random_fleet(seed, size=6, robots=4) if seed % 2 else fleet_on_lanes(seed, robots=4)
    scenario = turning(replace(fleet, rules=replace(fleet.rules, laps=1 + seed % 3)), draw)
    native = alone_completions(scenario)
    assert native is not None
    assert native.tolist() == list(alone.alone_completions(scenario))
    for robot, least in enumerate(native.tolist()):
        track = earliest_track(robot, Bookings(scenario.problem), Distances(scenario.roadmap))
        assert track is not None
        work = route_of(scenario.roadmap, scenario.problem.itineraries[robot], track).dwell[-1]
        assert int(track.enter[-1]) + work == least


@pytest.mark.parametrize("seed", seeds(6, 1))
def test_the_parts_of_lost_time_sum_up_and_none_is_negative(seed: int) -> None:
    draw = random.Random(seed)  # noqa: S311 (no secret depends on it)
    plan = solve(turning(random_fleet(seed, size=5, robots=7), draw), "lacam")
    for lost, done in zip(lost_time(plan), plan.completions, strict=True):
        assert lost.completion == done
        assert min(lost.detours, lost.making_room, lost.waiting) >= 0


@pytest.mark.parametrize("seed", seeds(4, 2))
def test_late_robots_still_turn_and_never_meet(seed: int) -> None:
    draw = random.Random(seed)  # noqa: S311 (no secret depends on it)
    plan = solve(turning(random_fleet(seed, size=5, robots=5), draw), "lacam")
    for delays in ("exponential:0.5", "chance:0.1x15"):
        outcome = simulate(plan, delays, runs=10, switch=seed % 2 == 0)
        assert (outcome.collisions, outcome.deadlocks) == (0, 0)
        assert check(replace(plan, tracks=outcome.trace(7).tracks)).ok


@pytest.mark.parametrize("seed", seeds(24, 1))
def test_replanned_robots_turn_from_the_heading_that_they_have(seed: int) -> None:
    """Robots are late or break down; the judge looks at runs of new plans."""
    draw = random.Random(seed)  # noqa: S311 (no secret depends on it)
    rules = (Rules(), Rules(occupancy="both"), Rules(headway=Fraction(1)), Rules(ends="none"))
    scenario = turning(random_fleet(seed, size=5, robots=5, rules=rules[seed % 4]), draw)
    plan = solve(scenario, "prioritized")
    for delays in ("exponential:0.5", "chance:0.1x15", "breaks:0.1"):
        outcome = simulate(plan, delays, runs=8, replan=True, switch=seed % 2 == 1)
        assert (outcome.collisions, outcome.deadlocks) == (0, 0)
        for run in range(8):
            judged = check(replace(plan, tracks=outcome.trace(run).tracks))
            assert not {"turn cut short", "too fast", "vertex conflict"} & set(judged.counts)


def test_moving_a_roadmap_changes_no_plan() -> None:
    """The same lanes, some 1000 units away, whose coordinates have other last digits."""
    fleet = turning(fleet_on_lanes(1, robots=3), random.Random(1))  # noqa: S311
    moved = replace(
        fleet, roadmap=replace(fleet.roadmap, positions=fleet.roadmap.positions + 1000.1)
    )
    here, there = solve(fleet), solve(moved)
    assert here.tracks == there.tracks
