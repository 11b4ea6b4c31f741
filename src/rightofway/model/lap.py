"""What one robot repeats: its visits from home past its stops and home again, without an end."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from rightofway.model.itinerary import Itinerary
from rightofway.model.roadmap import Roadmap
from rightofway.model.route import route_through
from rightofway.model.units import Tick, VertexId

__all__ = ["Lap", "lap_along"]


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
        """How long a lap lasts that nobody holds up [ticks]."""
        return Tick(sum(self.dwell) + sum(self.drive))

    def least(self, visit: int) -> Tick:
        """Return the least ticks from a visit's enter to the next one's."""
        return Tick(self.dwell[visit] + self.drive[(visit + 1) % len(self)])


def lap_along(roadmap: Roadmap, itinerary: Itinerary, vertices: Sequence[VertexId]) -> Lap:
    """Wrap a round trip into a lap.

    Parameters
    ----------
    roadmap
        The graph it runs on.
    itinerary
        What the robot has to do in one lap.
    vertices
        Where it goes, from home past all stops and home again.
    """
    twice = replace(itinerary, stages=itinerary.stages * 2)
    route = route_through(roadmap, twice, [*vertices, *vertices[1:]])
    second = slice(len(vertices) - 1, -1)
    return Lap(
        vertices=route.vertices[second], dwell=route.dwell[second], drive=route.drive[second]
    )
