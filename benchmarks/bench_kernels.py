"""How long the native kernels take on one fleet of 200 robots."""

from __future__ import annotations

import pytest
from pytest_benchmark.fixture import BenchmarkFixture

from rightofway.model import BookingRules, Scenario
from rightofway.precedence import PrecedenceGraph, build_timetable
from rightofway.repair.routing import find_shortest_routes
from rightofway.search import Bookings, Distances, find_earliest_track, plan_by_lacam
from tests.builders.fleets import random_fleet

ROBOTS = 200


@pytest.fixture(scope="module")
def scenario() -> Scenario:
    return random_fleet(1, size=64, robots=ROBOTS, walls=0.1)


def graph_of_routes(scenario: Scenario) -> PrecedenceGraph:
    routes = find_shortest_routes(scenario, Distances(scenario.roadmap))
    return PrecedenceGraph(
        routes,
        rules=BookingRules(headway=scenario.problem.booking_rules.headway, books_ahead=False),
    )


def test_distance_table(benchmark: BenchmarkFixture, scenario: Scenario) -> None:
    itinerary = scenario.problem.itineraries[0]
    benchmark(lambda: Distances(scenario.roadmap).to(itinerary.last, itinerary.edge_ticks))


def test_count_all_conflicts(benchmark: BenchmarkFixture, scenario: Scenario) -> None:
    benchmark(lambda: graph_of_routes(scenario).count_conflicts())


def test_give_and_take_back_a_right_of_way(benchmark: BenchmarkFixture, scenario: Scenario) -> None:
    graph = graph_of_routes(scenario)
    meeting = graph.find_next_meeting()
    assert meeting is not None

    def give_and_take_back() -> None:
        mark = graph.checkpoint()
        graph.give_way(first, second)
        graph.rollback(mark)

    first, second = meeting.visits
    if not graph.give_way(first, second):
        first, second = second, first
    graph.rollback(0)
    benchmark(give_and_take_back)


def test_search_for_one_robot(benchmark: BenchmarkFixture, scenario: Scenario) -> None:
    distances = Distances(scenario.roadmap)
    bookings = Bookings(scenario.problem)
    last = len(scenario.robots) - 1
    for robot in range(last):
        track = find_earliest_track(robot, bookings, distances)
        if track is not None:
            bookings.add(robot, track)
    benchmark(find_earliest_track, last, bookings, distances)


def test_search_for_the_fleet(benchmark: BenchmarkFixture, scenario: Scenario) -> None:
    def plan_in_steps() -> None:
        tracks = plan_by_lacam(scenario.problem.as_steps(), spreads=False)
        assert tracks is not None
        build_timetable(scenario.problem, tracks)

    benchmark(plan_in_steps)
