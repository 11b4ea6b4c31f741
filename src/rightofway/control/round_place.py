"""Placing a robot of a plan with jobs, which was off the floor: it stands, and a round follows.

Until then others drive to the ends of their released parts: it may be in their way.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from rightofway.control.commitments import leave_out_unsent
from rightofway.control.laps import build_graph_behind_released
from rightofway.control.ledger import Ledger
from rightofway.control.round_floor import put_at_stop
from rightofway.control.routes import RouteToDrive, make_route_from
from rightofway.errors import GaveUp
from rightofway.facts import Fact
from rightofway.model import Scenario
from rightofway.precedence import ReleaseGraph
from rightofway.resume.held import list_held
from rightofway.search import Distances

__all__ = ["list_lost", "make_routes_to_stand", "refuse_place"]


def refuse_place(
    scenario: Scenario, ledger: Ledger, committed: Sequence[int], robot: int, place: str
) -> None:
    """Refuse a place at which a robot cannot be put.

    Parameters
    ----------
    scenario
        The fleet.
    ledger
        The state that the journal describes.
    committed
        The last part of each robot that a splice has to keep.
    robot
        The number of a robot that is off the floor.
    place
        The name of a vertex.

    Raises
    ------
    GaveUp
        If another robot keeps the place, or what excludes it, or no way leads home from there.
    """
    vertex, home = scenario.roadmap.get_vertex(place), scenario.robots[robot].home
    ticks = scenario.problem.itineraries[robot].edge_ticks
    if Distances(scenario.roadmap).to(home, ticks)[vertex] < 0:
        raise GaveUp(Fact("no way to home", place=place, home=scenario.roadmap.name(home)))
    excluded = list_held(scenario, {robot: [int(vertex)]})
    near = {*map(int, excluded.vertices), *(int(head) for _, head in excluded.edges)}
    for name, own, last in zip(ledger.names, ledger.robots, committed, strict=True):
        places = own.route.stretch(own.arrived, last + 1)
        held = {int(scenario.roadmap.get_vertex(vertex)) for vertex in places}
        if not own.is_off and not held.isdisjoint(near):
            raise GaveUp(Fact("place held", place=place, robot=name))


def make_routes_to_stand(
    scenario: Scenario, ledger: Ledger, committed: Sequence[int], robot: int, place: str
) -> tuple[list[RouteToDrive], ReleaseGraph]:
    """Return routes that end with what is released, and that of a robot that stands at a place.

    Work that no order has yet is left to the next round: its job may have changed.

    Parameters
    ----------
    scenario, ledger, committed, robot, place
        As for `refuse_place`.
    """
    routes = []
    for own, last in zip(ledger.robots, committed, strict=True):
        placed = leave_out_unsent(put_at_stop(scenario.roadmap, own), last)
        routes.append(placed.route.cut_before(placed.arrived).cut_after(last))
    before = ledger.robots[robot].route
    routes[robot] = replace(
        make_route_from(before, place),
        places=(place,),
        jobs=((),),
        work=((),),
        enter=(before.enter[-1],),
    )
    released = [*committed]
    released[robot] = routes[robot].first
    absent = [k for k, own in enumerate(ledger.robots) if own.is_off and k != robot]
    return routes, build_graph_behind_released(scenario, routes, released, absent)


def list_lost(ledger: Ledger, routes: Sequence[RouteToDrive]) -> list[tuple[int, str]]:
    """Return the work that robots had to do and have no more on new routes: others do it, or later.

    Parameters
    ----------
    ledger
        The state that the journal describes.
    routes
        The new routes.
    """
    return [
        (robot, item)
        for robot, (own, route) in enumerate(zip(ledger.robots, routes, strict=True))
        for item in sorted(own.route.all_jobs - own.finished - route.all_jobs)
    ]
