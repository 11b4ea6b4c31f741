"""Shortest distances and searches for one robot, with and without others in the way."""

from rightofway.search.bounds import PriceAscent
from rightofway.search.cbs import ConflictBasedSearch
from rightofway.search.congestion import Congestion
from rightofway.search.distances import Distances, Path
from rightofway.search.fleet import FleetSearch, least_completions
from rightofway.search.lacam import plan_by_lacam
from rightofway.search.periodic_bookings import PeriodicBookings, RoundTrip, RowsOfLaps
from rightofway.search.sipp import Booking, Bookings, earliest_track

__all__ = [
    "Booking",
    "Bookings",
    "ConflictBasedSearch",
    "Congestion",
    "Distances",
    "FleetSearch",
    "Path",
    "PeriodicBookings",
    "PriceAscent",
    "RoundTrip",
    "RowsOfLaps",
    "earliest_track",
    "least_completions",
    "plan_by_lacam",
]
