"""The lap of one robot: its visits from home past its stops and home again, repeated."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import takewhile

from rightofway.model.problem import Itinerary
from rightofway.model.route import Route
from rightofway.model.units import Tick, VertexId

__all__ = ["Lap", "lap_of"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Lap:
    """The visits of one lap; after the last one the first comes again.

    Attributes
    ----------
    vertices
        Where each visit is; the first is at home.
    dwell
        How long each visit lasts at least, without the drive that follows: at a stop the work and
        the turn, at home the turn between two laps [ticks].
    drive
        Ticks of the edge driven into each visit; into the first: from the last one.
    """

    vertices: tuple[VertexId, ...]
    dwell: tuple[Tick, ...]
    drive: tuple[Tick, ...]

    def __len__(self) -> int:
        return len(self.vertices)

    @property
    def duration(self) -> Tick:
        """How long a lap without waits lasts [ticks]."""
        return Tick(sum(self.dwell) + sum(self.drive))

    def least(self, visit: int) -> Tick:
        """Return the least ticks from a visit's enter to the next one's."""
        return Tick(self.dwell[visit] + self.drive[(visit + 1) % len(self)])

    def leasts(self) -> tuple[Tick, ...]:
        """Return the least ticks of all visits."""
        drives = (*self.drive[1:], self.drive[0])
        return tuple(Tick(dwell + drive) for dwell, drive in zip(self.dwell, drives, strict=True))


def lap_of(itinerary: Itinerary, route: Route) -> Lap:
    """Wrap a round trip into a lap.

    Parameters
    ----------
    itinerary
        What the robot has to do in one lap; it ends at home.
    route
        Where it goes for that; the last visit serves all stages at home at the end.
    """
    at_home = takewhile(lambda stage: stage.vertex == itinerary.home, reversed(itinerary.stages))
    between = route.dwell[0] + sum(stage.work + stage.turn for stage in at_home)
    return Lap(
        vertices=route.vertices[:-1],
        dwell=(Tick(between), *route.dwell[1:-1]),
        drive=(route.drive[-1], *route.drive[1:-1]),
    )
