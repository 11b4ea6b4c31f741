"""One lap that a robot may make on any way: what it has to do, and how it drives."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from itertools import takewhile
from typing import Self

import numpy as np
from numpy.typing import NDArray

from rightofway.model import Itinerary, Roadmap, Stage, Tick, VertexId
from rightofway.search.distances import Distances

__all__ = ["RoundTrip"]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RoundTrip:
    """A round trip without its route.

    Attributes
    ----------
    roadmap
        The graph to drive on.
    pace
        Ticks for an edge of each length class; int32.
    stages
        What to do, in order; the last is home, and how long the robot turns there between laps.
    tables
        For each of them the least ticks from every vertex, -1 from where it must not go; int32.
    """

    roadmap: Roadmap
    pace: NDArray[np.int32]
    stages: tuple[Stage, ...]
    tables: tuple[NDArray[np.int32], ...]

    @property
    def home(self) -> VertexId:
        """Where it begins and ends."""
        return self.stages[-1].vertex

    @classmethod
    def of(
        cls, itinerary: Itinerary, distances: Distances, *, forbidden: Collection[int] = ()
    ) -> Self:
        """Return the tour of a robot.

        Parameters
        ----------
        itinerary
            What it has to do in one lap; it ends at home.
        distances
            The tables that guide the search.
        forbidden
            Vertices that it must not visit.
        """
        stages = _with_one_home(itinerary.stages)
        tables = tuple(distances.to(stage.vertex, itinerary.edge_ticks) for stage in stages)
        if forbidden:
            tables = tuple(map(np.copy, tables))
            for table in tables:
                table[list(forbidden)] = -1
        return cls(
            roadmap=distances.roadmap,
            pace=np.array(itinerary.edge_ticks, np.int32),
            stages=stages,
            tables=tables,
        )


def _with_one_home(stages: Sequence[Stage]) -> tuple[Stage, ...]:
    """Return the stages with all that is done at home at the end as one."""
    home = stages[-1].vertex
    at_home = list(takewhile(lambda stage: stage.vertex == home, reversed(stages)))
    once = Stage(
        vertex=home,
        work=Tick(sum(stage.work for stage in at_home)),
        turn=Tick(sum(stage.turn for stage in at_home)),
    )
    return (*stages[: len(stages) - len(at_home)], once)
