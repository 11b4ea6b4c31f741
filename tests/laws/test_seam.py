"""Ways through a seam are those of a plain search, tick by tick."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from rightofway.model import Lap, Tick, VertexId
from rightofway.search import Seam
from tests.oracles import seam as oracle

law = settings(max_examples=300, derandomize=True, deadline=None)
CORRIDOR = 4


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


@law
@given(
    lap=trips(),
    visits=others(),
    count=st.integers(0, 2),
    headway=st.integers(0, 2),
    books_ahead=st.booleans(),
    data=st.data(),
)
def test_a_way_through_the_seam_is_found_where_there_is_one_and_it_is_the_earliest(
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
    seam = Seam(CORRIDOR, headway=Tick(headway), books_ahead=books_ahead)
    for visit in visits:
        one = Lap(vertices=(VertexId(visit.vertex),), dwell=(Tick(0),), drive=(Tick(1),))
        enter = np.array([visit.enter + books_ahead])  # its drive there is booked before
        seam.add(visit.robot, one, range(1), enter, visit.leave + books_ahead)
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
    found = seam.connect(lap, count, begins, until, leave)
    assert (None if found is None else int(found[-1])) == expected
    if found is not None:
        assert oracle.fits(
            lap, found.tolist(), booked, leave, headway=headway, books_ahead=books_ahead
        )
