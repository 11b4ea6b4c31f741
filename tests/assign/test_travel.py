"""Travel between the places of jobs: ways, turns at stops, batteries, kinds of robots."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from itertools import permutations
from typing import Any

import numpy as np
import pytest

from rightofway import FleetBuilder
from rightofway.assign import AssignmentSearch, Travel, measure_travel
from rightofway.model import Battery, Job, JobStop, Robot, RobotState, Rules, Scenario, Stop
from rightofway.search import Distances, compute_least_completions
from rightofway.site import VertexId

V = VertexId


def make_work(robot: dict[str, Any] | None = None, **changes: Any) -> Scenario:
    """Return two robots on a street with cells 0 to 9, and a job at 5 and one from 8 to 2."""
    robots = (Robot(name="R1", home=V(0)), Robot(name="R2", home=V(9)))
    known: dict[str, Any] = {
        "roadmap": FleetBuilder(grid=[".........."]).build_roadmap(),
        "rules": Rules(turn=Fraction(0)),
        "robots": tuple(replace(one, **robot or {}) for one in robots),
        "jobs": (
            Job(name="J1", stops=(JobStop(at=V(5), work=Fraction(3)),)),
            Job(name="J2", stops=(JobStop(at=V(8), load=1), JobStop(at=V(2), load=-1))),
        ),
    }
    return Scenario(**{**known, **changes})


def measure(scenario: Scenario) -> Travel:
    return measure_travel(scenario.problem, Distances(scenario.roadmap))


def find_ticks(travel: Travel, tail: int, head: int, robot: int = 0) -> int:
    ticks = travel.ticks[travel.kind_of[robot]]
    return int(ticks[travel.place_of[V(tail)], travel.place_of[V(head)]])


def test_places_are_stops_homes_and_starts() -> None:
    travel = measure(make_work())
    assert travel.vertices == (0, 2, 5, 8, 9, 0, 9)
    assert [travel.get_start(0), travel.get_start(1)] == [5, 6]
    assert find_ticks(travel, 2, 8) == 6


def test_robots_of_one_pace_share_a_table_and_slow_ones_have_their_own() -> None:
    scenario = make_work()
    assert measure(scenario).ticks.shape == (1, 7, 7)
    slow = replace(scenario.robots[1], speed=Fraction(1, 2))
    travel = measure(make_work(robots=(scenario.robots[0], slow)))
    assert travel.ticks.shape == (2, 7, 7)
    assert find_ticks(travel, 2, 8, robot=1) == 2 * find_ticks(travel, 2, 8)


def test_a_robot_turns_at_a_stop_that_it_leaves_but_not_at_its_start() -> None:
    travel = measure(make_work(rules=Rules(turn=Fraction(4))))
    assert find_ticks(travel, 5, 8) == 3 + 4
    assert find_ticks(travel, 5, 5) == 0
    ticks = travel.ticks[0]
    assert ticks[travel.get_start(0), travel.place_of[V(5)]] == 5


def test_drives_take_energy_and_a_charging_place_is_reached_with_least_energy() -> None:
    # Of 200 parts a length takes 2 and a tick 1, so each of 10 lengths of a tick takes 3.
    battery = Battery(drive=Fraction(1, 100), on=Fraction(1, 200), charge=Fraction(1, 50))
    states = {"battery": "B", "charging": (V(2),)}
    travel = measure(make_work(states, batteries={"B": battery}))
    kind = travel.batteries[travel.battery_of[0]]
    assert kind.battery.full == 200
    assert kind.drives[travel.place_of[V(0)], travel.place_of[V(8)]] == 16
    assert kind.to_charging[travel.place_of[V(8)]] == 3 * 6
    assert kind.charging == (travel.place_of[V(2)],)


def test_robots_with_other_states_of_charge_share_a_kind_of_battery() -> None:
    battery = Battery(drive=Fraction(1, 100))
    scenario = make_work({"battery": "B"}, batteries={"B": battery}, charging=(V(0),))
    low = replace(scenario.robots[0], start=RobotState(at=V(0), soc=Fraction(1, 7)))
    travel = measure(replace(scenario, robots=(low, scenario.robots[1])))
    assert travel.battery_of == (0, 0)
    assert travel.batteries[0].battery.full == 700


def test_delays_are_added_where_a_way_is() -> None:
    travel = measure(make_work())
    drains = [np.full_like(kind.drives, 2) for kind in travel.batteries]
    later = travel.delay(np.full_like(travel.ticks, 3), drains)
    assert find_ticks(later, 2, 8) == 9


@pytest.mark.parametrize(("ends", "flowtime"), [("home", 17), ("none", 10)])
def test_the_jobs_of_a_scenario_get_tours(ends: Any, flowtime: int) -> None:
    # R2 drives 1 to 8, 3 to 5, works 3, drives 3 to 2, and 7 back home. R1 stays.
    scenario = make_work(rules=Rules(turn=Fraction(0), ends=ends, objective="flowtime"))
    assert scenario.problem.work is not None
    search = AssignmentSearch(scenario.problem.work, measure(scenario))
    search.construct()
    search.improve(50)
    assert search.cost.value == flowtime
    assert not search.assignment.unserved


@pytest.mark.parametrize("rate", [30, 90, 400])
def test_times_with_a_turn_rate_are_those_of_a_robot_that_drives_alone(rate: int) -> None:
    """From each place to each other one; the first drive needs no turn."""
    roadmap = FleetBuilder(grid=["....", ".@@.", "....", "@..."]).build_roadmap()
    places = [V(vertex) for vertex in (0, 2, 4, 8, 12)]
    jobs = tuple(Job(name=f"J{place}", stops=(JobStop(at=place),)) for place in places)
    robot = Robot(name="R1", home=places[0], turn_rate=Fraction(rate))
    scenario = make_work(roadmap=roadmap, robots=(robot,), jobs=jobs)
    travel, tick = measure(scenario), scenario.problem.clock.tick
    for tail, head in permutations(places, 2):
        trip = replace(robot, home=tail, stops=(Stop(at=head),), ends="none")
        alone = Scenario(roadmap=roadmap, robots=(trip,), rules=Rules(turn=Fraction(0)))
        least = compute_least_completions(alone)
        assert least is not None
        time = find_ticks(travel, tail, head) * tick
        assert time == int(least[0]) * alone.problem.clock.tick


def test_times_with_a_turn_rate_on_a_roadmap_with_a_dead_end() -> None:
    """No lane leaves the first vertex; A, B, C is 2 + 2 long, with a turn of 2 at B."""
    fleet = FleetBuilder()
    for name, x, y in [("end", 4, 2), ("A", 0, 0), ("B", 2, 0), ("C", 2, 2)]:
        fleet.add_vertex(name, x, y)
    fleet.add_edge("A", "B").add_edge("B", "C", both_ways=False)
    fleet.add_edge("C", "end", both_ways=False)
    roadmap = fleet.build_roadmap()
    robot = Robot(name="R1", home=V(1), turn_rate=Fraction(45))
    jobs = (Job(name="J1", stops=(JobStop(at=V(3)),)),)
    scenario = make_work(roadmap=roadmap, robots=(robot,), jobs=jobs)
    time = find_ticks(measure(scenario), 1, 3) * scenario.problem.clock.tick
    assert time == 2 + 2 + 2
