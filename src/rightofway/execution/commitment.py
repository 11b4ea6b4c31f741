"""What robots have begun at an instant, and therefore keep: stays, drives and bookings."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rightofway.execution.forecast import Forecast
from rightofway.execution.stop import served
from rightofway.model import Stage, Tick, VertexId

__all__ = ["Commitment", "commitment_of"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Commitment:
    """What one robot keeps of its route, and what is left for it to do.

    Attributes
    ----------
    visit
        The last visit that it has booked; index in its route.
    busy
        How long it is expected to be busy until that one is done, from now [ticks].
    drives_to
        Where it drives without having booked it (``occupancy: one``), or None.
    left
        The stages after that.
    """

    visit: int
    busy: Tick
    drives_to: VertexId | None
    left: tuple[Stage, ...]

    @property
    def is_driving(self) -> bool:
        """Whether the next visit is kept as well."""
        return self.drives_to is not None


def commitment_of(outlook: Forecast, robot: int) -> Commitment:
    """Return what a robot has begun at the instant of an outlook."""
    floor, route = outlook.floor, outlook.floor.routes[robot]
    first, end = floor.first_visit[robot : robot + 2].tolist()
    index = int(np.count_nonzero(outlook.begun[first:end])) - 1
    stages = floor.scenario.problem.itineraries[robot].stages
    ends = outlook.graph.enter(first + index) + outlook.graph.routes[robot].dwell[index]
    return Commitment(
        visit=index,
        busy=Tick(max(ends - outlook.now, 0)),
        drives_to=route.vertices[index + 1] if _is_driving(outlook, robot) else None,
        left=tuple(
            stage for stage, at in zip(stages, served(route, stages), strict=True) if at > index
        ),
    )


def _is_driving(outlook: Forecast, robot: int) -> bool:
    """Tell whether a robot has set off without having booked where it drives to."""
    visit = outlook.visit_of(robot)
    is_last = visit + 1 == outlook.floor.first_visit[robot + 1]
    if is_last or outlook.floor.scenario.rules.books_ahead or outlook.is_ready(robot):
        return False
    return int(outlook.happens.enter[visit] + outlook.delay_sample.dwell[visit]) <= outlook.now
