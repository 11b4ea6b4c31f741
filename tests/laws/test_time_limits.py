"""A time limit holds for every native call that takes one, and for every planner.

A limit that is over, negative or tiny ends a call at once: it returns or gives up.
"""

from __future__ import annotations

import ast
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest

import rightofway
from rightofway import _core
from rightofway.assign import AssignmentSearch
from rightofway.cyclic import find_best_timetable
from rightofway.errors import NoPlanExists, RightOfWayError
from rightofway.model import BookingRules, Lap, Plan, Rules, Scenario, Tick
from rightofway.plan_work.neighbourhoods import Neighbourhoods
from rightofway.planners import find_all
from rightofway.precedence import ActionDependencyGraph, DelayModel, TimedEventGraph
from rightofway.repair.flip import flip_right_of_way
from rightofway.search import (
    Bookings,
    ConflictBasedSearch,
    Distances,
    FleetSearch,
    PeriodicBookings,
    PriceAscent,
    RoundTrip,
    compute_least_completions,
    find_earliest_track,
    find_fewest_actions,
    plan_by_lacam,
)
from rightofway.site import VertexId
from tests.builders.any_work import draw_work
from tests.builders.fleets import grid_fleet, random_fleet
from tests.builders.neighbourhoods import make_arguments, make_neighbourhoods
from tests.builders.periodic import random_timetable
from tests.builders.timed import with_problem

LIMITS = [0.0, -0.0, -1.0, -1e-9, 1e-9, 1e-4]

HARD = Path(__file__).parents[1] / "data" / "hard"

MOST = 0.5
"""How much longer than its limit a call may take [s]."""


@contextmanager
def in_time(limit: float) -> Iterator[None]:
    """Fail if what is inside takes much longer than a limit [s] of this process's time."""
    began = time.process_time()
    with suppress(RightOfWayError):
        yield
    assert time.process_time() - began < max(limit, 0) + MOST


@cache
def scenarios() -> dict[str, Scenario]:
    """Return fleets with a plan and without one."""
    swap = grid_fleet(["...."], [("N0", "N3"), ("N3", "N0")])
    return {
        "a fleet": random_fleet(3, size=16, robots=40),
        "no plan": swap,
        "one way": rightofway.load(HARD / "one-way-circle.json"),
    }


def native_calls_with_a_limit() -> set[str]:
    """Return what takes a limit, as the stub of the native core has it."""
    stub = Path(_core.__file__).with_name("_core.pyi")
    if not stub.exists():
        stub = Path(rightofway.__file__).with_name("_core.pyi")

    def named(body: list[ast.stmt], within: str = "") -> Iterator[str]:
        for node in body:
            if isinstance(node, ast.ClassDef):
                yield from named(node.body, f"{node.name}.")
            elif isinstance(node, ast.FunctionDef):
                arguments = [one.arg for one in (*node.args.args, *node.args.kwonlyargs)]
                if {"time_limit", "with_fallback", "pause"} & set(arguments):
                    yield within + node.name

    return set(named(ast.parse(stub.read_text()).body))


def order(scenario: Scenario) -> list[int]:
    return list(range(len(scenario.robots)))


def improve(scenario: Scenario, limit: float) -> None:
    search = FleetSearch(scenario.problem)
    if search.prioritize(order(scenario), searches=100, time_limit=None):
        search.improve(10**9, patience=10**9, time_limit=limit)


def resume(scenario: Scenario, limit: float) -> None:
    search = FleetSearch(scenario.problem)
    search.prioritize(order(scenario), searches=1, time_limit=None)
    search.resume(searches=10**9, time_limit=limit)


def prioritize(scenario: Scenario, limit: float) -> None:
    search = FleetSearch(scenario.problem)
    search.prioritize(order(scenario), searches=10**9, time_limit=limit)


def compete(scenario: Scenario, limit: float) -> None:
    search = FleetSearch(scenario.problem)
    if search.prioritize(order(scenario), searches=100, time_limit=None):
        search.compete(order(scenario), searches=10**9, time_limit=limit)


def hurry(scenario: Scenario, limit: float) -> None:
    search = FleetSearch(scenario.problem)
    if search.prioritize(order(scenario), searches=100, time_limit=None):
        search.hurry(order(scenario), searches=10**9, time_limit=limit)


def repair(scenario: Scenario, limit: float) -> None:
    search = FleetSearch(scenario.problem)
    search.repair(order(scenario), searches=10**9, time_limit=limit)


def take_over(scenario: Scenario, limit: float) -> None:
    tracks = [None] * len(scenario.robots)
    FleetSearch(scenario.problem).take_over(tracks, order(scenario), time_limit=limit)


def move_one_at_a_time(scenario: Scenario, limit: float) -> None:
    timed = with_problem(scenario, list(scenario.problem.itineraries))
    FleetSearch(timed.problem).move_one_at_a_time(time_limit=limit)


def search_tours(limit: float, *, has_first: bool) -> None:
    """Assign a hundred jobs to ten robots, or improve such an assignment."""
    search = AssignmentSearch(*draw_work(1, n_jobs=100, n_robots=10, size=100))
    if not has_first:
        search.construct(limit)
        return
    search.construct()
    search.improve(10**9, limit)


@cache
def find_neighbourhoods() -> Neighbourhoods:
    return make_neighbourhoods(5, n_robots=3, n_jobs=8)


def move_jobs(limit: float) -> None:
    arguments = make_arguments(find_neighbourhoods())
    _core.RoutedMoves(**arguments).run(10**12, 10**12, limit)


def track(scenario: Scenario, limit: float) -> None:
    bookings, distances = Bookings(scenario.problem), Distances(scenario.roadmap)
    find_earliest_track(0, bookings, distances, time_limit=limit)


def periodic() -> tuple[PeriodicBookings, Lap]:
    """Return bookings of a door that are free for a tick now and then, and a lap through it."""
    made = PeriodicBookings(3, Tick(30_000), rules=BookingRules())
    busy = Lap(
        vertices=(VertexId(2), VertexId(1)), dwell=(Tick(0), Tick(1)), drive=(Tick(1), Tick(1))
    )
    made.add(0, busy, 5_000, np.arange(10_000, dtype=np.int64) * 3)
    return made, replace(busy, vertices=(VertexId(0), VertexId(1)))


def search(_: Scenario, limit: float) -> None:
    made, lap = periodic()
    made.search(lap, 1_000, 0, time_limit=limit)


def find_route(scenario: Scenario, limit: float) -> None:
    problem, distances = scenario.problem, Distances(scenario.roadmap)
    made = PeriodicBookings(scenario.roadmap.n_vertices, Tick(10**6), rules=BookingRules())
    made.find_route(RoundTrip.of(problem.itineraries[0], distances), 0, time_limit=limit)


def lacam(scenario: Scenario, limit: float) -> None:
    for problem in (scenario.problem, scenario.problem.as_steps()):
        with suppress(NoPlanExists):
            plan_by_lacam(problem, time_limit=limit)


def overlaps(_: Scenario, limit: float) -> None:
    """Ten thousand robots are at one vertex at one time: fifty million pairs."""
    robots = np.arange(10_000, dtype=np.int32)
    starts = np.zeros(len(robots), np.int64)
    _core.find_overlaps(np.zeros_like(robots), robots, starts, starts + 1, 2**31 - 1, limit)


def event_graph() -> TimedEventGraph:
    timetable = random_timetable(1, robots=5, headway=0, books_ahead=False)
    return TimedEventGraph(timetable, rules=BookingRules())


@cache
def plan() -> Plan:
    return rightofway.solve(scenarios()["a fleet"], "lacam", time_limit=None)


def runs(_: Scenario, limit: float) -> None:
    adg = ActionDependencyGraph(plan().scenario, plan().tracks, DelayModel.none(40))
    adg.make_runs(0, 0, 10**7, limit)


def least_plan(scenario: Scenario, limit: float) -> None:
    ConflictBasedSearch(scenario.problem).run(time_limit=limit)


def least_sum(scenario: Scenario, limit: float) -> None:
    search = ConflictBasedSearch(scenario.problem)
    search.search_together(range(len(scenario.robots)), states=10**9, time_limit=limit)


def act_less(_: Scenario, limit: float) -> None:
    find_fewest_actions(plan().scenario, plan().tracks, states=10**9, time_limit=limit)


def raise_prices(scenario: Scenario, limit: float) -> None:
    with suppress(NoPlanExists):
        PriceAscent(scenario.problem).run(time_limit=limit)


CALLS: dict[str, Callable[[Scenario, float], object]] = {
    "ActionDependencyGraph.runs": runs,
    "ConflictBasedSearch.run": least_plan,
    "ConflictBasedSearch.search_together": least_sum,
    "CyclicSimulator.advance": lambda one, limit: rightofway.run_laps(one, time_limit=limit),
    "FleetSearch.alone": lambda one, limit: compute_least_completions(one, time_limit=limit),
    "FleetSearch.compete": compete,
    "FleetSearch.hurry": hurry,
    "FleetSearch.resume": resume,
    "FleetSearch.improve": improve,
    "FleetSearch.move_one_at_a_time": move_one_at_a_time,
    "FleetSearch.prioritize": prioritize,
    "FleetSearch.repair": repair,
    "FleetSearch.take_over": take_over,
    "PeriodicBookings.find_route": find_route,
    "PeriodicBookings.search": search,
    "PriceAscent.run": raise_prices,
    "RoutedMoves.run": lambda _, limit: move_jobs(limit),
    "TourSearch.construct": lambda _, limit: search_tours(limit, has_first=False),
    "TourSearch.improve": lambda _, limit: search_tours(limit, has_first=True),
    "critical_circuit": lambda _, limit: event_graph().find_critical_circuit(time_limit=limit),
    "earliest_times": lambda _, limit: event_graph().compute_earliest(
        Tick(10**6), time_limit=limit
    ),
    "earliest_track": track,
    "fewest_actions": act_less,
    "find_overlaps": overlaps,
    "plan_by_lacam": lacam,
}


def test_every_native_call_with_a_limit_is_tested() -> None:
    assert set(CALLS) == native_calls_with_a_limit()


@pytest.mark.parametrize("fleet", ["a fleet", "no plan", "one way"])
@pytest.mark.parametrize("name", CALLS)
def test_a_native_call_ends_when_its_limit_is_over(name: str, fleet: str) -> None:
    scenario = scenarios()[fleet]
    plan()
    for limit in LIMITS:
        with in_time(limit):
            CALLS[name](scenario, limit)


@pytest.mark.parametrize("fleet", ["a fleet", "no plan", "one way"])
@pytest.mark.parametrize("planner", find_all())
def test_a_planner_ends_when_its_limit_is_over(planner: str, fleet: str) -> None:
    for limit in (0, 1e-9, 1e-4, 0.02):
        with in_time(limit):
            rightofway.solve(scenarios()[fleet], planner, time_limit=limit)


def longest_wait(plan: Plan) -> tuple[int, int, Tick]:
    """Return the robot of the longest wait for another one, that one, and when the wait ends."""
    losses = [loss for one in plan.lost_time for loss in one.losses if loss.for_robot is not None]
    loss = max(losses, key=lambda loss: loss.ticks)
    assert loss.for_robot is not None
    return loss.robot, loss.for_robot, loss.end


def test_what_follows_a_plan_ends_when_its_limit_is_over() -> None:
    some = plan()
    waits, goes_first, end = longest_wait(some)
    for limit in (0, 1e-9, 1e-4):
        with in_time(limit):
            rightofway.improve(some, time_limit=limit)
        with in_time(limit):
            find_best_timetable(some.scenario, time_limit=limit)
        with in_time(limit):
            rightofway.simulate(some, runs=10**6, switch=True, time_limit=limit)
        with in_time(limit):
            rightofway.simulate(some, "stop:R1@3+50", runs=10**6, replan=True, time_limit=limit)
        with in_time(limit):
            flip_right_of_way(some, waits, goes_first, end, time_limit=limit)


@pytest.mark.parametrize("limit", [0.05, 1])
@pytest.mark.parametrize(("robots", "size"), [(30, 20), (90, 40), (150, 40), (800, 80)])
def test_a_timetable_of_any_fleet_is_chosen_within_a_short_limit(
    robots: int, size: int, limit: float
) -> None:
    """The effort for all robots of a large fleet is many times the limit."""
    rules = Rules(occupancy="both")
    scenario = random_fleet(1, size=size, robots=robots, walls=0, rules=rules, apart=True)
    assert scenario.problem
    with in_time(limit):
        find_best_timetable(scenario, time_limit=limit)
