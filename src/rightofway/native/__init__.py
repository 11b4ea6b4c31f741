"""The waist of the native core: its twin of a problem, and what it takes beside."""

from rightofway.native.bookings import (
    BookedRows,
    ClosedPlaces,
    booked_times,
    native_closures,
    native_rows,
)
from rightofway.native.problem import bound, compiler, lists_of, native_rules, roads_of, tracks_of

__all__ = [
    "BookedRows",
    "ClosedPlaces",
    "booked_times",
    "bound",
    "compiler",
    "lists_of",
    "native_closures",
    "native_rows",
    "native_rules",
    "roads_of",
    "tracks_of",
]
