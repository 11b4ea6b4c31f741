"""Random bookings of other robots, drawn for one robot that is searched a track."""

from __future__ import annotations

from hypothesis import strategies as st

from rightofway.model import NEVER, Problem, Tick
from rightofway.search import Booking, Bookings
from rightofway.site import Roadmap
from tests.oracles.sipp import Booked


@st.composite
def booked_on(draw: st.DrawFn, roadmap: Roadmap) -> list[Booked]:
    """Draw bookings that do not overlap."""
    booked: list[Booked] = []
    for robot in range(draw(st.integers(0, 8))):
        vertex = draw(st.integers(0, roadmap.n_vertices - 1))
        start = draw(st.integers(-1, 15))
        end = draw(st.one_of(st.integers(start + 1, start + 8), st.just(NEVER)))
        if all(b.vertex != vertex or b.end <= start or end <= b.start for b in booked):
            booked.append(Booked(vertex, start, end, draw(st.integers(0, robot))))
    return booked


def table_of(problem: Problem, booked: list[Booked]) -> Bookings:
    """Return the bookings as the search takes them."""
    bookings = Bookings(problem)
    for one in booked:
        bookings.book(one.vertex, Booking(Tick(one.start), Tick(one.end), one.robot))
    return bookings
