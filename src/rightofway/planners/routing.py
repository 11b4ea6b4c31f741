"""Shortest routes, one robot at a time, and proofs that there can be no plan."""

from __future__ import annotations

from rightofway.errors import NoPlanExists
from rightofway.model import Itinerary, Route, Scenario, VertexId, route_along
from rightofway.search import Distances

__all__ = ["refuse_the_impossible", "shortest_route", "shortest_routes"]


def shortest_routes(scenario: Scenario, distances: Distances) -> list[Route]:
    """Return a shortest route for each robot, as if it were alone.

    Raises
    ------
    NoPlanExists
        If a robot cannot get to a place, or two would have to stay at one for ever.
    """
    refuse_the_impossible(scenario, distances)
    return [shortest_route(itinerary, distances) for itinerary in scenario.timing.itineraries]


def shortest_route(itinerary: Itinerary, distances: Distances) -> Route:
    """Return the route of the paper: shortest paths to the stops, and home as it would come.

    The way home from the last stop of a lap is the path that leads there from home, reversed,
    wherever the roadmap allows that.
    """
    place, legs = itinerary.home, []
    for stage in itinerary.stages:
        legs.append(_leg(itinerary, place, stage.vertex, distances))
        place = stage.vertex
    return route_along(distances.roadmap, itinerary, legs)


def _leg(
    itinerary: Itinerary, place: VertexId, target: VertexId, distances: Distances
) -> tuple[VertexId, ...]:
    if target == itinerary.home:
        out = distances.path(target, place, itinerary.edge_ticks)
        if out is not None and _is_shortest_reversed(out, itinerary, distances):
            return out[::-1]
    path = distances.path(place, target, itinerary.edge_ticks)
    assert path is not None, "unreachable places were refused"
    return path


def _is_shortest_reversed(
    out: tuple[VertexId, ...], itinerary: Itinerary, distances: Distances
) -> bool:
    """Tell whether a path out, driven backwards, is a shortest way home."""
    roadmap, home, ticks = distances.roadmap, out[0], 0
    for tail, head in zip(out[1:], out, strict=False):
        edge = roadmap.edge(tail, head)
        if edge is None:
            return False
        ticks += itinerary.edge_ticks[roadmap.length_class[edge]]
    return ticks == int(distances.to(home, itinerary.edge_ticks)[out[-1]])


def refuse_the_impossible(scenario: Scenario, distances: Distances) -> None:
    """Raise if it is plain that no plan exists.

    Raises
    ------
    NoPlanExists
        If a robot cannot get to a place, or two would have to stay at one for ever.
    """
    holders: dict[VertexId, str] = {}
    for robot, itinerary in zip(scenario.robots, scenario.timing.itineraries, strict=True):
        _refuse_unreachable(robot.name, itinerary, distances)
        holder = holders.setdefault(itinerary.last, robot.name)
        if holder != robot.name:
            place = scenario.roadmap.name(itinerary.last)
            raise NoPlanExists(
                f"{holder} and {robot.name} would both have to stay at {place} for ever"
                " (let one of them end elsewhere)"
            )


def _refuse_unreachable(name: str, itinerary: Itinerary, distances: Distances) -> None:
    place, roadmap = itinerary.home, distances.roadmap
    for stage in itinerary.stages:
        if distances.to(stage.vertex, itinerary.edge_ticks)[place] < 0:
            ends = f"from {roadmap.name(place)} to {roadmap.name(stage.vertex)}"
            raise NoPlanExists(f"{name} has no way {ends} (join the two parts of the map)")
        place = stage.vertex
