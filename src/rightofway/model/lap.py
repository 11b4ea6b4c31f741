"""Laps: round trips that a robot makes again and again."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import takewhile

import numpy as np
from numpy.typing import NDArray

from rightofway.model.itinerary import Itinerary, Stage, compute_least_dwell
from rightofway.model.route import Route, compute_turns_along
from rightofway.model.units import Tick
from rightofway.site import Roadmap, VertexId


@dataclass(frozen=True, slots=True, kw_only=True)
class Lap:
    """The visits of one lap; after the last visit the first one follows.

    Attributes
    ----------
    vertices
        Where each visit is; the first is at home.
    dwell
        The least duration of each visit, without the drive that follows: at a stop the work and the
        turn, at home the turn between two laps; of a robot with a turn rate also the change of
        heading [ticks].
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
        """The duration of a lap without waits [ticks]."""
        return Tick(sum(self.dwell) + sum(self.drive))

    def compute_least(self, visit: int) -> Tick:
        """Return the least ticks from a visit's enter to the next one's."""
        return Tick(self.dwell[visit] + self.drive[(visit + 1) % len(self)])

    def compute_leasts(self) -> tuple[Tick, ...]:
        """Return the least ticks of all visits."""
        drives = (*self.drive[1:], self.drive[0])
        return tuple(Tick(dwell + drive) for dwell, drive in zip(self.dwell, drives, strict=True))


@lru_cache(maxsize=1 << 14)
def make_visits_of_laps(
    lap: Lap, count: int
) -> tuple[NDArray[np.int32], NDArray[np.int64], NDArray[np.int64]]:
    """Return vertex, dwell and drive [ticks] of all visits of some laps."""
    return (
        np.array(lap.vertices * count, np.int32),
        np.array(lap.dwell * count, np.int64),
        np.array(lap.drive * count, np.int64),
    )


def make_lap(roadmap: Roadmap, itinerary: Itinerary, route: Route) -> Lap:
    """Wrap a round trip into a lap.

    Parameters
    ----------
    roadmap
        The graph the route runs on.
    itinerary
        The trip of the robot in one lap; it ends at home.
    route
        Where it goes for that; the last visit serves all stages at home at the end.
    """
    vertices = route.vertices[:-1]
    between = route.dwell[0] + compute_dwell_between_laps(roadmap, itinerary, vertices)
    return Lap(
        vertices=vertices,
        dwell=(Tick(between), *route.dwell[1:-1]),
        drive=(route.drive[-1], *route.drive[1:-1]),
    )


def compute_dwell_between_laps(
    roadmap: Roadmap, itinerary: Itinerary, vertices: Sequence[VertexId]
) -> Tick:
    """Return how much longer a robot stays at home between two laps than before its first [ticks].

    It serves the stages with which a lap ends, and turns from the last edge to the first one.
    """
    turn = int(compute_turns_of_lap(roadmap, itinerary, vertices)[0])
    return Tick(compute_least_dwell(_list_stages_at_home(itinerary), leaves=True) + turn)


def compute_turns_of_lap(
    roadmap: Roadmap, itinerary: Itinerary, vertices: Sequence[VertexId]
) -> NDArray[np.int64]:
    """Return how long a robot turns between two edges in each visit of a lap [ticks]; int64."""
    around = np.array((vertices[-1], *vertices, vertices[0]), np.int32)
    return compute_turns_along(roadmap, itinerary, around)[1:-1]


def _list_stages_at_home(itinerary: Itinerary) -> tuple[Stage, ...]:
    """Return the stages at home with which each lap of an itinerary ends."""
    at_home = takewhile(lambda stage: stage.vertex == itinerary.home, reversed(itinerary.stages))
    return tuple(reversed(tuple(at_home)))
