"""Shortest distances and searches for one robot, with and without others in the way."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rightofway.provision import import_later

if TYPE_CHECKING:
    from rightofway.search.bounds import PriceAscent
    from rightofway.search.cbs import ConflictBasedSearch, JointPlan, find_fewest_actions
    from rightofway.search.congestion import Congestion
    from rightofway.search.distances import Distances, Path
    from rightofway.search.fleet import FleetSearch, compute_least_completions
    from rightofway.search.lacam import plan_by_lacam
    from rightofway.search.periodic_bookings import PeriodicBookings, RoundTrip, RowsOfLaps
    from rightofway.search.sipp import Booking, Bookings, find_earliest_track

_MODULES = {
    "bounds": ("PriceAscent",),
    "cbs": (
        "ConflictBasedSearch",
        "JointPlan",
        "find_fewest_actions",
    ),
    "congestion": ("Congestion",),
    "distances": (
        "Distances",
        "Path",
    ),
    "fleet": (
        "FleetSearch",
        "compute_least_completions",
    ),
    "lacam": ("plan_by_lacam",),
    "periodic_bookings": (
        "PeriodicBookings",
        "RoundTrip",
        "RowsOfLaps",
    ),
    "sipp": (
        "Booking",
        "Bookings",
        "find_earliest_track",
    ),
}

__all__ = [
    "Booking",
    "Bookings",
    "ConflictBasedSearch",
    "Congestion",
    "Distances",
    "FleetSearch",
    "JointPlan",
    "Path",
    "PeriodicBookings",
    "PriceAscent",
    "RoundTrip",
    "RowsOfLaps",
    "compute_least_completions",
    "find_earliest_track",
    "find_fewest_actions",
    "plan_by_lacam",
]

if not TYPE_CHECKING:  # a checker would take any misspelt name for an object
    __getattr__ = import_later(__name__, _MODULES)
