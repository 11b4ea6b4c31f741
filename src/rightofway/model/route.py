"""Where one robot goes: an ordered list of visits, each with a least dwell; no times yet."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

from rightofway.model.itinerary import Itinerary, Stage, least_dwell
from rightofway.model.roadmap import Roadmap
from rightofway.model.units import Tick, VertexId

__all__ = ["Route", "edge_ticks", "route_along", "route_through"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Route:
    """The visits of one robot.

    Attributes
    ----------
    vertices
        Where each visit is.
    dwell
        How long each visit lasts at least, without the drive that follows [ticks].
    drive
        Ticks of the edge driven into each visit; 0 for the first.
    """

    vertices: tuple[VertexId, ...]
    dwell: tuple[Tick, ...]
    drive: tuple[Tick, ...]

    def __len__(self) -> int:
        return len(self.vertices)

    def least(self, visit: int) -> Tick:
        """Return the least ticks from a visit's enter to the next one's (or to completion)."""
        last = visit == len(self.vertices) - 1
        return Tick(self.dwell[visit] + (0 if last else self.drive[visit + 1]))


def route_along(
    roadmap: Roadmap, itinerary: Itinerary, legs: Sequence[Sequence[VertexId]]
) -> Route:
    """Join paths into a route.

    Parameters
    ----------
    roadmap
        The graph the paths run on.
    itinerary
        What the robot has to do.
    legs
        One path for each stage, from where the stage before it is (or home) to its own vertex, both
        included. A stage at the vertex where the robot already is has a leg of that one vertex.
    """
    vertices = [itinerary.home]
    served: list[list[Stage]] = [[]]
    for stage, leg in zip(itinerary.stages, legs, strict=True):
        vertices += leg[1:]
        served += [[] for _ in leg[1:]]
        served[-1].append(stage)
    last = len(vertices) - 1
    dwell = [least_dwell(stages, leaves=visit < last) for visit, stages in enumerate(served)]
    drive = [
        edge_ticks(roadmap, itinerary, tail, head)
        for tail, head in pairwise(vertices)
    ]
    return Route(vertices=tuple(vertices), dwell=tuple(dwell), drive=(Tick(0), *drive))


def route_through(roadmap: Roadmap, itinerary: Itinerary, vertices: Sequence[VertexId]) -> Route:
    """Make a route of the vertices it visits; each stage is served as early as it can be.

    Parameters
    ----------
    roadmap
        The graph the route runs on.
    itinerary
        What the robot has to do; the vertices lead from its home past all stages to the last one.
    vertices
        Where it goes, visit by visit.
    """
    legs: list[list[VertexId]] = []
    begin = 0
    for stage in itinerary.stages[:-1]:
        end = vertices.index(stage.vertex, begin)
        legs.append(list(vertices[begin : end + 1]))
        begin = end
    return route_along(roadmap, itinerary, [*legs, vertices[begin:]])


def edge_ticks(roadmap: Roadmap, itinerary: Itinerary, tail: int, head: int) -> Tick:
    """Return how long a robot drives from one vertex to the next [ticks].

    Raises
    ------
    KeyError
        If no edge leads there.
    """
    edge = roadmap.edge(tail, head)
    if edge is None:
        raise KeyError((tail, head))
    return itinerary.edge_ticks[int(roadmap.length_class[edge])]
