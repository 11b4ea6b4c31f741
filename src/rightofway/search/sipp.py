"""Safe interval path planning: the earliest track of one robot among the bookings of the others.

References
----------
Phillips & Likhachev, *SIPP: Safe interval path planning for dynamic environments*, ICRA 2011.
"""

from __future__ import annotations

import numpy as np

from rightofway import _core
from rightofway.errors import GaveUp
from rightofway.model import Itinerary, Track
from rightofway.search.bookings import Bookings
from rightofway.search.distances import Distances

__all__ = ["earliest_track"]

STOPPED = 2

NO_PRICES = np.zeros(0, np.int64)
"""No prices: bookings of others are never overlapped."""


def earliest_track(
    itinerary: Itinerary,
    bookings: Bookings,
    distances: Distances,
    *,
    time_limit: float | None = None,
) -> Track | None:
    """Find the track of one robot that completes first and overlaps no booking.

    Parameters
    ----------
    itinerary
        What the robot has to do; every stage can be reached.
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
    stages, ticks = itinerary.stages, itinerary.edge_ticks
    end, vertices, enter, _ = _core.earliest_track(
        distances.roadmap.indptr,
        distances.roadmap.heads,
        distances.roadmap.length_class,
        np.array(ticks, np.int32),
        bookings.table,
        int(bookings.headway),
        bookings.books_ahead,
        int(itinerary.home),
        np.array([stage.vertex for stage in stages], np.int32),
        np.array([stage.work for stage in stages], np.int64),
        np.array([stage.turn for stage in stages], np.int64),
        [distances.to(stage.vertex, ticks) for stage in stages],
        NO_PRICES,
        time_limit,
    )
    if end == STOPPED:
        raise GaveUp("time ran out in the search for one robot (give a longer time limit)")
    return Track(vertices=vertices, enter=enter) if len(vertices) else None
