"""The waist of the native core: its twin of a problem, and what it takes beside."""

from rightofway.native.bookings import (
    BookedRows,
    ClosedPlaces,
    bind_closures,
    bind_rows,
    book_times,
)
from rightofway.native.problem import (
    bind_roads,
    bind_rules,
    bind_turning,
    bound,
    compiler,
    tracks_of,
)
from rightofway.native.resources import bind_lists, clashes, excluded_by, find_vertices_near

__all__ = [
    "BookedRows",
    "ClosedPlaces",
    "bind_closures",
    "bind_lists",
    "bind_roads",
    "bind_rows",
    "bind_rules",
    "bind_turning",
    "book_times",
    "bound",
    "clashes",
    "compiler",
    "excluded_by",
    "find_vertices_near",
    "tracks_of",
]
