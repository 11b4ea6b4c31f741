"""Round trips past no other home, where two robots would bar each other's way for good.

Of two robots that each pass the other one's home, neither can set out before the other is gone. In
a single lap a planner sends one of them another way when it comes to that; for laps, ways are
chosen once, so it is done before.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np

from rightofway.errors import NoPlanExists
from rightofway.model import Roadmap, Route, Scenario, VertexId
from rightofway.planners.routing import refuse_unreachable, shortest_route
from rightofway.search import Distances

__all__ = ["avoid_homes"]


def avoid_homes(scenario: Scenario, routes: Sequence[Route]) -> list[Route]:
    """Send robots round all homes of others where they and another one pass each other's homes.

    Parameters
    ----------
    scenario
        The problem, one lap for each robot.
    routes
        One for each robot.

    Returns
    -------
    list
        The same routes, but for robots that were sent another way; a shortest one without homes.
    """
    found = list(routes)
    passed = [set(route.vertices) for route in found]
    robot_at = {itinerary.home: r for r, itinerary in enumerate(scenario.problem.itineraries)}
    for robot, itinerary in enumerate(scenario.problem.itineraries):
        others = (robot_at[home] for home in passed[robot] & robot_at.keys() - {itinerary.home})
        if any(itinerary.home in passed[other] for other in others):
            found[robot] = _round_homes(scenario, robot, robot_at) or found[robot]
            passed[robot] = set(found[robot].vertices)
    return found


def _round_homes(scenario: Scenario, robot: int, homes: Iterable[VertexId]) -> Route | None:
    """Return a way past no other home; None if there is none."""
    itinerary = scenario.problem.itineraries[robot]
    distances = Distances(_without(scenario.roadmap, set(homes) - {itinerary.home}))
    try:
        refuse_unreachable(scenario.robots[robot].name, itinerary, distances)
    except NoPlanExists:
        return None
    return shortest_route(itinerary, distances)


def _without(roadmap: Roadmap, vertices: set[VertexId]) -> Roadmap:
    """Return the roadmap without the edges that lead to some vertices."""
    stays = ~np.isin(roadmap.heads, list(vertices))
    before = np.concatenate(([0], np.cumsum(stays)))
    return replace(
        roadmap,
        indptr=before[roadmap.indptr].astype(np.int32),
        heads=roadmap.heads[stays],
        length_class=roadmap.length_class[stays],
    )
