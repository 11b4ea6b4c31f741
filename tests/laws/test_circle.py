"""The search on the circle finds a way exactly where there is one, and the way keeps all rules."""

from __future__ import annotations

import random
from dataclasses import replace

from hypothesis import given, settings
from hypothesis import strategies as st

from rightofway.model import Tick
from rightofway.precedence import TimedEventGraph
from rightofway.search import PeriodicBookings
from tests.builders.periodic import random_timetable
from tests.oracles import circle as oracle

law = settings(max_examples=300, derandomize=True, deadline=None)


@law
@given(
    st.integers(0, 10**9),
    st.integers(2, 4),
    st.sampled_from([0, 0, 1, 2]),
    st.booleans(),
    st.integers(0, 3),
)
def test_a_way_round_is_found_exactly_where_there_is_one(
    seed: int, robots: int, headway: int, books_ahead: bool, spare: int
) -> None:
    drawn = random_timetable(
        seed, robots=robots, headway=headway, books_ahead=books_ahead, most_laps=1
    )
    graph = TimedEventGraph(drawn, headway=Tick(headway), books_ahead=books_ahead)
    least = graph.critical_circuit().cycle_time
    timetable = graph.earliest(Tick(-(-least.numerator // least.denominator) + spare))
    period = timetable.period
    circle = PeriodicBookings(robots + 5, period, headway=Tick(headway), books_ahead=books_ahead)
    for robot in range(1, robots):
        circle.add(robot, timetable.laps[robot], 1, timetable.enter[robot])
    # A home that others pass: the search has to try all its starts by itself.
    lap, draw = timetable.laps[0], random.Random(seed)  # noqa: S311 (no secret depends on it)
    if draw.randrange(3):
        turn = draw.randrange(len(lap))
        lap = replace(
            lap,
            vertices=lap.vertices[turn:] + lap.vertices[:turn],
            dwell=lap.dwell[turn:] + lap.dwell[:turn],
            drive=lap.drive[turn:] + lap.drive[:turn],
        )
    others = replace(
        timetable,
        robots=timetable.robots[1:],
        laps=timetable.laps[1:],
        counts=timetable.counts[1:],
        enter=timetable.enter[1:],
    )
    passed = any(lap.vertices[0] in other.vertices for other in others.laps)
    phases = [draw.randrange(period)] if passed else range(period)
    found = [circle.search(lap, 1, phase) for phase in phases]
    ways = [enter for enter in found if enter is not None]
    exists = oracle.can_go_round(lap, others, headway=headway, books_ahead=books_ahead)
    assert bool(ways) == exists
    for enter in ways:
        whole = replace(timetable, laps=(lap, *others.laps), enter=(enter, *others.enter))
        assert oracle.faults(whole, headway=headway, books_ahead=books_ahead) == []
