"""Visits among bookings, on a circle or a line of time, are found exactly where there are any."""

from __future__ import annotations

import random
from dataclasses import replace

import numpy as np
from hypothesis import strategies as st

from rightofway.model import BookingRules, Lap, Tick
from rightofway.precedence import TimedEventGraph
from rightofway.search import PeriodicBookings
from rightofway.site import VertexId
from tests.builders.laws import law
from tests.builders.periodic import random_timetable
from tests.oracles import periodic_bookings as oracle

CORRIDOR = 4


@law(
    st.integers(0, 10**9),
    st.integers(2, 4),
    st.sampled_from([0, 0, 1, 2]),
    st.booleans(),
    st.integers(0, 3),
)
def test_a_track_that_closes_is_found_exactly_where_there_is_one(
    seed: int, robots: int, headway: int, books_ahead: bool, spare: int
) -> None:
    drawn = random_timetable(
        seed, robots=robots, headway=headway, books_ahead=books_ahead, most_laps=1
    )
    graph = TimedEventGraph(
        drawn, rules=BookingRules(headway=Tick(headway), books_ahead=books_ahead)
    )
    least = graph.find_critical_circuit().cycle_time
    timetable = graph.compute_earliest(Tick(-(-least.numerator // least.denominator) + spare))
    period = timetable.period
    circle = PeriodicBookings(
        robots + 5, period, rules=BookingRules(headway=Tick(headway), books_ahead=books_ahead)
    )
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
    exists = oracle.can_close(lap, others, headway=headway, books_ahead=books_ahead)
    assert bool(ways) == exists
    for enter in ways:
        whole = replace(timetable, laps=(lap, *others.laps), enter=(enter, *others.enter))
        assert oracle.faults(whole, headway=headway, books_ahead=books_ahead) == []


@st.composite
def trips(draw: st.DrawFn) -> Lap:
    """To the end of a corridor and back, with work there."""
    far = draw(st.integers(1, CORRIDOR - 1))
    vertices = [*range(far + 1), *range(far - 1, 0, -1)]
    dwell = [draw(st.integers(0, 2)) if vertex in (0, far) else 0 for vertex in vertices]
    drive = [draw(st.integers(1, 2)) for _ in vertices]
    return Lap(
        vertices=tuple(map(VertexId, vertices)),
        dwell=tuple(map(Tick, dwell)),
        drive=tuple(map(Tick, drive)),
    )


@st.composite
def others(draw: st.DrawFn) -> list[oracle.Visit]:
    """Robots that come and go, and never two at one place."""
    free: dict[int, int] = {}
    visits = []
    for robot in range(1, draw(st.integers(1, 5))):
        tick = draw(st.integers(0, 25))
        place = draw(st.integers(0, CORRIDOR - 1))
        for _ in range(draw(st.integers(1, 3))):
            leave = tick + draw(st.integers(1, 3))
            if tick >= free.get(place, 0):
                visits.append(oracle.Visit(robot, place, tick, leave))
                free[place] = leave + 3  # more than any headway and approach
            tick, place = leave + 6, (place + 1) % CORRIDOR
    return visits


@law(
    lap=trips(),
    visits=others(),
    count=st.integers(0, 2),
    headway=st.integers(0, 2),
    books_ahead=st.booleans(),
    data=st.data(),
)
def test_visits_on_a_line_are_found_where_there_are_any_and_end_earliest(
    *,
    lap: Lap,
    visits: list[oracle.Visit],
    count: int,
    headway: int,
    books_ahead: bool,
    data: st.DataObject,
) -> None:
    begins = data.draw(st.integers(0, 6))
    until = begins + count * lap.duration + data.draw(st.integers(0, 12))
    leave = until + 1
    line = PeriodicBookings(
        CORRIDOR, None, rules=BookingRules(headway=Tick(headway), books_ahead=books_ahead)
    )
    for visit in visits:
        one = Lap(vertices=(VertexId(visit.vertex),), dwell=(Tick(0),), drive=(Tick(1),))
        enter = np.array([visit.enter + books_ahead])  # its drive there is booked before
        line.add_visits(visit.robot, one, range(1), enter, visit.leave + books_ahead)
    booked = [
        oracle.Booked(v.robot, v.vertex, v.enter, v.leave + books_ahead + headway) for v in visits
    ]
    expected = oracle.earliest(
        lap,
        count,
        booked,
        begins=begins,
        until=until,
        leave=leave,
        headway=headway,
        books_ahead=books_ahead,
    )
    found = line.connect(lap, count, begins, until, leave)
    assert (None if found is None else int(found[-1])) == expected
    if found is not None:
        assert oracle.fits(
            lap, found.tolist(), booked, leave, headway=headway, books_ahead=books_ahead
        )
