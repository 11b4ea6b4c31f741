"""The waist of the native core: its twin of a problem, and what it takes beside."""

from rightofway.native.bookings import (
    BookedRows,
    ClosedPlaces,
    booked_times,
    native_closures,
    native_rows,
)
from rightofway.native.problem import (
    bound,
    compiler,
    native_rules,
    native_turning,
    roads_of,
    tracks_of,
)
from rightofway.native.resources import clashes, excluded_by, lists_of, vertices_near

__all__ = [
    "BookedRows",
    "ClosedPlaces",
    "booked_times",
    "bound",
    "clashes",
    "compiler",
    "excluded_by",
    "lists_of",
    "native_closures",
    "native_rows",
    "native_rules",
    "native_turning",
    "roads_of",
    "tracks_of",
    "vertices_near",
]
