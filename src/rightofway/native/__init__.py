"""The waist of the native core: its twin of a problem, and its other inputs."""

from rightofway.native.bookings import (
    BookedRows,
    ClosedPlaces,
    bind_closures,
    bind_rows,
    book_times,
    find_overlaps,
)
from rightofway.native.problem import (
    ANYWHERE,
    bind_native,
    bind_roads,
    bind_rules,
    bind_turning,
    list_native_stages,
    make_tracks,
    name_compiler,
)
from rightofway.native.resources import bind_lists, find_clashes, find_vertices_near, list_excluded

__all__ = [
    "ANYWHERE",
    "BookedRows",
    "ClosedPlaces",
    "bind_closures",
    "bind_lists",
    "bind_native",
    "bind_roads",
    "bind_rows",
    "bind_rules",
    "bind_turning",
    "book_times",
    "find_clashes",
    "find_overlaps",
    "find_vertices_near",
    "list_excluded",
    "list_native_stages",
    "make_tracks",
    "name_compiler",
]
