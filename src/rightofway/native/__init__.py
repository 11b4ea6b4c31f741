"""The waist of the native core: its twin of a problem, and what it takes beside."""

from rightofway.native.bookings import BookedRows, ClosedPlaces
from rightofway.native.problem import bound, compiler, tracks_of

__all__ = ["BookedRows", "ClosedPlaces", "bound", "compiler", "tracks_of"]
