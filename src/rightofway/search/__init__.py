"""Shortest distances and searches for one robot, with and without others in the way."""

from rightofway.search.bookings import FOREVER, Booking, Bookings
from rightofway.search.circle import Circle
from rightofway.search.distances import Distances, Path
from rightofway.search.events import plan_by_events
from rightofway.search.fleet import FleetSearch
from rightofway.search.joint import joint_steps
from rightofway.search.native import compiler
from rightofway.search.seam import Seam
from rightofway.search.sipp import earliest_track
from rightofway.search.tours import Tour
from rightofway.search.traffic import Surcharges, Traffic

__all__ = [
    "FOREVER",
    "Booking",
    "Bookings",
    "Circle",
    "Distances",
    "FleetSearch",
    "Path",
    "Seam",
    "Surcharges",
    "Tour",
    "Traffic",
    "compiler",
    "earliest_track",
    "joint_steps",
    "plan_by_events",
]
