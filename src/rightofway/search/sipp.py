"""Safe interval path planning: the earliest track of one robot among the bookings of the others.

References
----------
Phillips & Likhachev, *SIPP: Safe interval path planning for dynamic environments*, ICRA 2011.
"""

from __future__ import annotations

from rightofway import _core
from rightofway.errors import GaveUp
from rightofway.model import Track
from rightofway.search.bookings import Bookings
from rightofway.search.distances import Distances
from rightofway.search.native import bound

__all__ = ["earliest_track"]

STOPPED = 2


def earliest_track(
    robot: int,
    bookings: Bookings,
    distances: Distances,
    *,
    time_limit: float | None = None,
) -> Track | None:
    """Find the track of one robot that completes first and overlaps no booking.

    Parameters
    ----------
    robot
        Which robot; it can reach every stage.
    bookings
        What the other robots have booked.
    distances
        Tables for the lower bounds that guide the search.
    time_limit
        When to stop [s].

    Returns
    -------
    Track or None
        None if it is proven that there is no such track.

    Raises
    ------
    GaveUp
        If time ran out.

    Notes
    -----
    Complete and optimal for one robot among fixed bookings, and deterministic.
    """
    problem, itinerary = bookings.problem, bookings.problem.itineraries[robot]
    tables = [distances.to(stage.vertex, itinerary.edge_ticks) for stage in itinerary.stages]
    end, vertices, enter = _core.earliest_track(
        bound(problem), robot, bookings.table, tables, time_limit
    )
    if end == STOPPED:
        raise GaveUp("time ran out in the search for one robot (give a longer time limit)")
    return Track(vertices=vertices, enter=enter) if len(vertices) else None
