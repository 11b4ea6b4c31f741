"""What robots have begun at an instant and keep: stays, drives and bookings."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rightofway.execution.forecast import Forecast
from rightofway.model import Stage, Tick, VertexId

__all__ = ["Commitment", "closures_of", "commitment_of"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Commitment:
    """What one robot keeps of its route, and what is left for it to do.

    Attributes
    ----------
    visit
        The last visit that it has booked; index in its route.
    vertex
        The vertex of that visit.
    busy
        How long it is expected to be busy until that visit is done, from now [ticks].
    drives_to
        The vertex that it drives to without having booked it (``occupancy: one``), or None.
    begun, left
        The stages served until then, and those after that.
    """

    visit: int
    vertex: VertexId
    busy: Tick
    drives_to: VertexId | None = None
    begun: tuple[Stage, ...] = ()
    left: tuple[Stage, ...] = ()

    @property
    def goes_on_from(self) -> VertexId:
        """The vertex from which the robot is free to go anywhere."""
        return self.vertex if self.drives_to is None else self.drives_to


def commitment_of(forecast: Forecast, robot: int, stages: Sequence[Stage]) -> Commitment:
    """Return what a robot has begun at the instant of a forecast.

    Parameters
    ----------
    forecast
        The expectation.
    robot
        Its index. A broken one keeps its bookings and has nothing left.
    stages
        All that its route serves.
    """
    adg, route = forecast.adg, forecast.adg.routes[robot]
    first, end = adg.first_visit[robot : robot + 2].tolist()
    index = int(np.count_nonzero(forecast.booked[first:end])) - 1
    if robot in forecast.broken:
        vertex = route.vertices[index]
        return Commitment(visit=index, vertex=vertex, busy=Tick(0), begun=tuple(stages))
    is_driving = forecast.is_driving(robot)
    if is_driving and forecast.broken:
        # To a vertex that is free it drives on, as if it had booked it; else it may turn back.
        other = int(adg.before[first + index + 1])
        is_driving = False
        index += other < 0 or bool(forecast.entered[other + 1])
    ends = forecast.graph.enter(first + index) + forecast.graph.routes[robot].dwell[index]
    begun = sum(at <= index for at in route.serves)
    return Commitment(
        visit=index,
        vertex=route.vertices[index],
        busy=Tick(max(ends - forecast.now, 0)),
        drives_to=route.vertices[index + 1] if is_driving else None,
        begun=tuple(stages[:begun]),
        left=tuple(stages[begun:]),
    )


def closures_of(forecast: Forecast) -> frozenset[VertexId]:
    """Return the vertices that broken robots hold for ever: bookings of nobody."""
    adg, closed = forecast.adg, set()
    for robot in forecast.broken:
        here, end = forecast.visit_of(robot), int(adg.first_visit[robot + 1])
        held = np.arange(here, end)[forecast.booked[here:end]]
        closed.update(adg.vertex[held].tolist())
    return frozenset(closed)
