"""A route on the circle is found exactly where there is one, and it keeps all rules."""

from __future__ import annotations

import random
from dataclasses import replace
from fractions import Fraction

from hypothesis import strategies as st

from rightofway.cyclic.route import make_cyclic_routes
from rightofway.model import (
    BookingRules,
    Itinerary,
    Lap,
    Rules,
    Scenario,
    Tick,
    compute_drives_along,
)
from rightofway.model.lap import compute_turns_of_lap
from rightofway.precedence import CyclicSchedule
from rightofway.search import Distances, PeriodicBookings, RoundTrip
from tests.builders.fleets import grid_fleet, random_fleet
from tests.builders.laws import law, leave
from tests.builders.periodic import timetable_of
from tests.oracles import periodic_bookings as oracle

RULES = [
    Rules(),
    Rules(headway=Fraction(1)),
    Rules(occupancy="both"),
    Rules(rotations=False),
    Rules(turn_rate=Fraction(90)),
    Rules(turn_rate=Fraction(45), occupancy="both"),
]
"""Some robots turn on the spot: by 90 degrees in one tick, or in two."""


def crowd(
    scenario: Scenario, draw: random.Random
) -> tuple[PeriodicBookings, CyclicSchedule, list[Lap]]:
    """Put robots on a circle, all but the first, as far as they find a place; return all laps."""
    laps = [one.lap for one in make_cyclic_routes(scenario, draw.choice(("clear", "shortest")))]
    period = Tick(int(laps[0].duration) + draw.randrange(25))
    circle = PeriodicBookings(
        scenario.roadmap.n_vertices,
        period,
        rules=scenario.problem.booking_rules.keep_apart(),
    )
    there = []
    for robot in range(1, len(laps)):
        enter = circle.search(laps[robot], 1, draw.randrange(period))
        if enter is not None:
            circle.add(robot, laps[robot], 1, enter)
            there.append((laps[robot], enter.tolist()))
    if not there:
        leave("no other lap fits")
    others = timetable_of([lap for lap, _ in there], [enter for _, enter in there], period=period)
    return circle, others, laps


def does_its_work(scenario: Scenario, itinerary: Itinerary, lap: Lap) -> bool:
    """Tell whether a lap of one stop is on the roadmap and serves what is to be done."""
    stop, home = itinerary.stages
    drives = compute_drives_along(scenario.roadmap, itinerary, [lap.vertices[-1], *lap.vertices])
    dwells = (lap.dwell - compute_turns_of_lap(scenario.roadmap, itinerary, lap.vertices)).tolist()
    served = [(v, dwell) for v, dwell in zip(lap.vertices, dwells, strict=True) if dwell]
    due = [(one.vertex, one.work + one.turn) for one in (home, stop)]
    return (
        list(lap.drive) == drives
        and served == [one for one in due if one[1]]
        and stop.vertex in lap.vertices
    )


@law(st.integers(0, 10**6), st.integers(2, 4), st.sampled_from(RULES))
def test_a_route_is_found_exactly_where_there_is_one(seed: int, robots: int, rules: Rules) -> None:
    draw = random.Random(seed)  # noqa: S311 (no secret depends on it)
    size = 3 if robots == 2 else 4
    scenario = random_fleet(seed, size=size, robots=robots, rules=rules, apart=True)
    circle, others, laps = crowd(scenario, draw)
    itinerary = scenario.problem.itineraries[0]
    trip = RoundTrip.of(itinerary, Distances(scenario.roadmap))
    headway, ahead = (
        int(scenario.problem.booking_rules.keep_apart().headway),
        scenario.problem.booking_rules.books_ahead,
    )
    passed = any(itinerary.home in other.vertices for other in others.laps)
    period = int(circle.period)
    routes = []
    for phase in [draw.randrange(period)] if passed else range(period):
        found, usual = circle.find_route(trip, phase), circle.search(laps[0], 1, phase)
        if found is not None:
            routes.append(found)
        if usual is not None:
            assert found is not None
            if not passed:
                assert (found[1][0] - phase - 1) % period <= (usual[0] - phase - 1) % period
    for lap, enter in routes:
        assert does_its_work(scenario, itinerary, lap)
        whole = replace(
            others,
            robots=(*others.robots, len(others.robots)),
            laps=(*others.laps, lap),
            counts=(*others.counts, 1),
            enter=(*others.enter, enter),
        )
        assert oracle.faults(whole, headway=headway, books_ahead=ahead) == []
        circle.add(0, lap, 1, enter)
        circle.remove(0)
    assert bool(routes) == oracle.has_a_route(
        itinerary, scenario.roadmap, others, headway=headway, books_ahead=ahead
    )


def test_a_route_does_not_enter_forbidden_vertices() -> None:
    scenario = grid_fleet(["...", "...", "..."], [("N0", "N8")])
    itinerary, distances = scenario.problem.itineraries[0], Distances(scenario.roadmap)
    circle = PeriodicBookings(9, Tick(20), rules=BookingRules())
    forbidden = {1, 5, 4}
    found = circle.find_route(RoundTrip.of(itinerary, distances, forbidden=forbidden), 0)
    assert found is not None
    assert found[0].vertices == (0, 3, 6, 7, 8, 7, 6, 3)


def test_a_robot_that_turns_slowly_drives_round_the_border() -> None:
    """Round the border it turns 4 times by 90 degrees; there and back by 180, 90, 180 and 90."""
    scenario = grid_fleet(["...", "...", "..."], [("N0", "N8")])
    scenario = replace(scenario, rules=replace(scenario.rules, turn=None, turn_rate=Fraction(30)))
    itinerary, distances = scenario.problem.itineraries[0], Distances(scenario.roadmap)
    circle = PeriodicBookings(9, Tick(40), rules=BookingRules())
    found = circle.find_route(RoundTrip.of(itinerary, distances), 0)
    assert found is not None
    lap, enter = found
    turns = compute_turns_of_lap(scenario.roadmap, itinerary, lap.vertices).tolist()
    assert sorted(turns) == [0, 0, 0, 0, 3, 3, 3, 3]
    assert lap.duration == 8 + 4 * 3
    assert enter[0] % 40 == enter[0]
