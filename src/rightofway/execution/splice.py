"""Joining what has begun with a new plan of the rest.

No circle can come about where robots stay that the new plan lets stay: what has begun waits for
nobody that has not, and what has not begun takes place in the order of a plan.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rightofway.execution.commitment import Commitment
from rightofway.execution.forecast import Forecast, Times
from rightofway.execution.stop import served
from rightofway.model import Plan, Route, Tick, Track, route_of
from rightofway.precedence import ActionDependencyGraph

__all__ = ["joined"]


def joined(outlook: Forecast, begun: Sequence[Commitment], rest: Plan) -> ActionDependencyGraph:
    """Return what has begun, followed by a plan of the rest.

    Parameters
    ----------
    outlook
        The plan until now.
    begun
        What each robot keeps of it.
    rest
        The new plan; in its scenario a robot is first busy with what it has begun.
    """
    floor, parts = outlook.floor, []
    for robot, one in enumerate(begun):
        itinerary, track = rest.scenario.problem.itineraries[robot], rest.tracks[robot]
        new = route_of(rest.scenario.roadmap, itinerary, track)
        goes_on = served(new, itinerary.stages)[one.is_driving]
        route = _joined_route(floor.routes[robot], new, one, goes_on)
        to_come = track.enter[goes_on + (not one.is_driving) :]
        parts.append((route, *_joined_times(outlook, robot, one, to_come)))
    return ActionDependencyGraph(
        floor.scenario,
        [Track(vertices=np.array(r.vertices, np.int32), enter=enter) for r, enter, _ in parts],
        floor.hazards,
        routes=[route for route, _, _ in parts],
        since=np.concatenate([since for _, _, since in parts]),
    )


def _joined_route(old: Route, new: Route, begun: Commitment, goes_on: int) -> Route:
    """Join routes; where a robot would go before it is done with what it has begun is left out."""
    here = begun.visit
    vertices, drive = old.vertices[: here + 1], old.drive[: here + 1]
    dwell = (*old.dwell[:here], Tick(old.dwell[here] + new.dwell[goes_on] - begun.busy))
    if begun.drives_to is not None:
        vertices, drive = (*vertices, begun.drives_to), old.drive[: here + 2]
        dwell = (*old.dwell[: here + 1], new.dwell[goes_on])
    return Route(
        vertices=(*vertices, *new.vertices[goes_on + 1 :]),
        dwell=(*dwell, *new.dwell[goes_on + 1 :]),
        drive=(*drive, *new.drive[goes_on + 1 :]),
    )


def _joined_times(
    outlook: Forecast, robot: int, begun: Commitment, to_come: Times
) -> tuple[Times, Times]:
    """Return times in whose order visits take place, and since when each was told of it."""
    first = int(outlook.floor.first_visit[robot])
    kept = slice(first, first + begun.visit + 1)
    enter = np.minimum(outlook.happens.enter[kept], outlook.now)
    told = np.full(len(to_come), outlook.now)
    return (
        np.append(enter, outlook.now + 1 + to_come),
        np.append(outlook.floor.since[kept], told),
    )
