"""A first plan of a changed scenario, from the plan of the scenario before (a warm start).

A plan is routes and rights of way; times follow. A route is kept where the robot has the same
places to go to and all vertices and edges are still there. Of kept routes the order of visits at
each vertex is kept, too, so speeds, work times, turns and the tick may change: the earliest
timetable of that order has no conflict. Other robots are planned again around them (repair): a kept
robot in the way loses its track and is planned again, at a price that rises each time.

Where robots keep their route but not their times, for example a slower one, a second plan is made
in which these are planned again, too. The plan of lower cost is the first plan.

References
----------
Li, Chen, Harabor, Stuckey & Koenig, *MAPF-LNS2: Fast repairing for multi-agent path finding via
large neighborhood search*, AAAI 2022.

Notes
-----
Of a scenario that has not changed, no robot is later than in the old plan. Deterministic for a
seed, unless time runs out. A repair that finds nothing proves nothing.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import islice, pairwise

import numpy as np
from numpy.typing import NDArray

from rightofway.check import check
from rightofway.model import (
    NEVER,
    Plan,
    PlannerRun,
    Route,
    Scenario,
    StartPlan,
    Track,
    compute_cost,
    join_route,
    make_route,
)
from rightofway.precedence import build_graph, find_rotation
from rightofway.repair.fleet_search import make_fleet_search
from rightofway.repair.impossible import refuse_closed_ways
from rightofway.repair.plan_request import PlanRequest
from rightofway.search import FleetSearch
from rightofway.site import Roadmap, VertexId

SHARE = 0.5
"""The part of the time for a first plan; planning from nothing has the rest where there is none."""

SEARCHES = 30
"""Searches for each robot without a track, and as many for each ten robots of the fleet."""

MOST_REFUSED = 8
"""Robots that may lose their place in the old order; after them, its rest is dropped."""

STEP = 1e-6
"""Vertices without names are the same vertex where their positions agree to that [length unit]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class _Kept:
    """A route of the old plan that the robot can still drive."""

    route: Route
    when: NDArray[np.int64]  # its visits began, in ticks of the old plan
    has_changed: bool  # whether its times, or what it books, may be others than before


def make_first_plan(request: PlanRequest, old: Plan) -> tuple[Track, ...] | None:
    """Return a valid plan that keeps what it can of the old one; None if the repair found none.

    Raises
    ------
    NoPlanExists
        If closures leave a robot no way.
    """
    old_routes = dict(_list_kept_routes(request.scenario, old))
    changed = [robot for robot, old_route in old_routes.items() if old_route.has_changed]
    unchanged = [robot for robot, old_route in old_routes.items() if not old_route.has_changed]
    others = [robot for robot in range(len(request.scenario.robots)) if robot not in old_routes]
    refuse_closed_ways(request.scenario, request.deadline, others)
    hurried = replace(request, deadline=request.deadline.shorten(SHARE))
    search = make_fleet_search(hurried)
    drafts = [_plan_repair(hurried, search, old_routes, [*unchanged, *changed])]
    if changed and hurried.deadline.measure_seconds_left() != 0:
        drafts.append(_plan_repair(hurried, search, old_routes, unchanged))
    valid = [
        tracks for tracks in drafts if tracks is not None and _is_valid(request.scenario, tracks)
    ]
    return min(valid, key=lambda tracks: compute_cost(request.scenario, tracks), default=None)


def compare_with_start(old: Plan, scenario: Scenario, tracks: Sequence[Track]) -> StartPlan:
    """Return how much of an old plan the plan that was made from it has kept."""
    vertex = map_vertices(old.scenario.roadmap, scenario.roadmap)
    old_tick, tick = old.scenario.problem.clock.tick, scenario.problem.clock.tick
    routes = times = 0
    for track, partner in zip(tracks, _match_partners(old, scenario, vertex), strict=True):
        before = None if partner is None else old.tracks[partner]
        if before is None:
            continue
        visited = _list_visited(scenario.roadmap, vertex[before.vertices])
        if not np.array_equal(visited, track.vertices):
            continue
        routes += 1
        enter = zip(before.enter.tolist(), track.enter.tolist(), strict=True)
        times += all(tick_now * old_tick == other * tick for tick_now, other in enter)
    return StartPlan(routes=routes, tracks=times)


def map_vertices(old: Roadmap, new: Roadmap) -> NDArray[np.int32]:
    """Return for each vertex of an old map the same vertex of a new one, -1 where there is none.

    Vertices with names are the same if their names are; others, as those of grids, if they lie at
    the same place of the site. Vertices of another map are those that are drawn.
    """
    if old == new:
        return np.arange(old.n_vertices, dtype=np.int32)
    keys: list[Iterable[Hashable]] = [_list_places(old), _list_places(new)]
    if old.labels is not None and new.labels is not None:
        keys = [old.labels, new.labels]
    known = {key: vertex for vertex, key in enumerate(islice(keys[1], new.n_drawn))}
    return np.array([known.get(key, -1) for key in keys[0]], np.int32)


def _list_visited(roadmap: Roadmap, vertices: NDArray[np.int32]) -> NDArray[np.int32]:
    """Return a route with the chains of a roadmap; -1 is no vertex of it."""
    if roadmap.passing is None:
        return vertices
    return np.array(roadmap.unfold_route(vertices.tolist()), np.int32)


def _list_places(roadmap: Roadmap) -> list[tuple[int, int]]:
    """Return where each vertex lies in the site's frame, in steps."""
    x, y = roadmap.positions.T
    frame = roadmap.frame
    y = -y if frame.y_up else y
    cos, sin = math.cos(frame.yaw), math.sin(frame.yaw)
    at = float(frame.x) + cos * x - sin * y, float(frame.y) + sin * x + cos * y
    columns = (np.rint(axis / STEP).astype(np.int64).tolist() for axis in at)
    return list(zip(*columns, strict=True))


def _match_partners(old: Plan, scenario: Scenario, vertex: NDArray[np.int32]) -> list[int | None]:
    """Return for each robot its number in the old plan: that of its name, or else of its home."""
    number = {robot.name: index for index, robot in enumerate(old.scenario.robots)}
    names = {robot.name for robot in scenario.robots}
    renamed = {
        int(vertex[robot.home]): index
        for index, robot in enumerate(old.scenario.robots)
        if robot.name not in names
    }
    return [number.get(robot.name, renamed.get(robot.home)) for robot in scenario.robots]


def _list_kept_routes(scenario: Scenario, old: Plan) -> Iterator[tuple[int, _Kept]]:
    """Yield the robots that can still drive their routes of the old plan, and these."""
    vertex = map_vertices(old.scenario.roadmap, scenario.roadmap)
    is_closed = _make_closed_test(scenario)
    ticks = old.scenario.problem.clock.tick / scenario.problem.clock.tick
    for robot, partner in enumerate(_match_partners(old, scenario, vertex)):
        if partner is None:
            continue
        track = old.tracks[partner]
        visited = _list_visited(scenario.roadmap, vertex[track.vertices])
        now, before = (fleet.problem.itineraries for fleet in (scenario, old.scenario))
        places = [stage.vertex for stage in now[robot].stages]
        old_places = [int(vertex[stage.vertex]) for stage in before[partner].stages]
        starts, ends = visited[[0, -1]].tolist()
        is_same = old_places == places and (starts, ends) == (now[robot].home, now[robot].last)
        if not is_same or visited.min() < 0:
            continue
        try:
            former = make_route(old.scenario.roadmap, before[partner], track)
            route = _route_again(scenario, robot, visited.tolist(), former.serves)
        except KeyError:
            continue  # an edge is gone
        serves_all = len(former.serves) == len(places)
        if not serves_all or min(route.drive) < 0 or is_closed(robot, visited, for_ever=True):
            continue
        is_as_long = _has_same_duration(route, former, ticks)
        is_as_wide = old.scenario.robots[partner].radius == scenario.robots[robot].radius
        is_affected = is_closed(robot, visited) and scenario.closures != old.scenario.closures
        has_changed = is_affected or not (is_as_long and is_as_wide)
        yield robot, _Kept(route=route, when=track.enter, has_changed=has_changed)


def _route_again(
    scenario: Scenario, robot: int, visited: Sequence[VertexId], serves: Sequence[int]
) -> Route:
    """Return the route through these vertices that serves its stages in the same visits."""
    legs = [visited[begin : end + 1] for begin, end in pairwise((0, *serves))]
    return join_route(scenario.roadmap, scenario.problem.itineraries[robot], legs)


def _has_same_duration(route: Route, former: Route, ticks: Fraction) -> bool:
    """Return whether all dwells and drives are as before; ``ticks``: of now in one of before."""
    now, before = (
        np.array([timed.dwell, timed.drive], np.int64) * scale
        for timed, scale in ((route, ticks.denominator), (former, ticks.numerator))
    )
    return np.array_equal(now, before)


def _make_closed_test(scenario: Scenario) -> Callable[..., bool]:
    """Return a function that tells whether a place on a way is ever closed, or is ``for_ever``."""
    closures, roadmap = scenario.problem.closures, scenario.roadmap
    if closures is None:
        return lambda *_, **__: False
    always = (closures.start <= 0) & (closures.end >= NEVER)

    def is_closed(robot: int, visited: NDArray[np.int32], *, for_ever: bool = False) -> bool:
        edges = roadmap.find_edges(visited[:-1], visited[1:])
        resources = np.concatenate((visited, roadmap.n_vertices + edges))
        rows = resources + closures.size_of[robot] * (closures.n_vertices + closures.n_edges)
        return bool(np.isin(rows, closures.row[always] if for_ever else closures.row).any())

    return is_closed


def _plan_repair(
    request: PlanRequest, search: FleetSearch, old_routes: Mapping[int, _Kept], order: Sequence[int]
) -> tuple[Track, ...] | None:
    """Return a plan that keeps as many as it can of some routes; None if it finds none."""
    in_time = _keep_old_order(request, old_routes, order)
    tracks = [in_time.get(robot) for robot in range(len(request.scenario.robots))]
    left = [robot for robot, track in enumerate(tracks) if track is None]
    if not left:
        return tuple(in_time[robot] for robot in range(len(tracks)))
    alone = search.compute_alone()
    try:
        search.start(tracks)
    except ValueError:
        return None  # the plan breaks a rule
    is_repaired = search.repair(
        sorted(left, key=lambda robot: alone[robot]),
        searches=SEARCHES * (len(left) + len(tracks) // 10),
        time_limit=request.deadline.measure_seconds_left(),
    )
    return search.list_tracks() if is_repaired else None


def _keep_old_order(
    request: PlanRequest, old_routes: Mapping[int, _Kept], order: Sequence[int]
) -> Mapping[int, Track]:
    """Return the tracks of robots in the earliest timetable that keeps the old order of visits.

    A robot for which that order is impossible beside those before it is left out. It is found by
    bisection, because an order stays possible if a robot is taken out.
    """
    fits, left = list[int](), list(order)
    tracks = _make_timetable(request.scenario, old_routes, left)
    for _ in range(MOST_REFUSED):
        if tracks is not None or request.deadline.measure_seconds_left() == 0:
            break
        low, high = 0, len(left)
        while high - low > 1:
            middle = (low + high) // 2
            tried = _make_timetable(request.scenario, old_routes, [*fits, *left[:middle]])
            low, high = (low, middle) if tried is None else (middle, high)
        fits, left = [*fits, *left[:low]], left[low + 1 :]
        tracks = _make_timetable(request.scenario, old_routes, [*fits, *left])
    return tracks or _make_timetable(request.scenario, old_routes, fits) or {}


def _make_timetable(
    scenario: Scenario, old_routes: Mapping[int, _Kept], robots: Sequence[int]
) -> Mapping[int, Track] | None:
    """Return the earliest tracks of some robots in the old order; None if it is impossible.

    They are in the order of the robots' numbers.
    """
    if not robots:
        return {}
    robots, part = sorted(robots), scenario
    if len(robots) < len(scenario.robots):
        fleet = tuple(scenario.robots[robot] for robot in robots)
        part = replace(scenario, robots=fleet, clock=scenario.problem.clock)
    try:
        routes = [old_routes[robot].route for robot in robots]
        graph = build_graph(part.problem, routes)
        is_possible = graph.keeps_order([old_routes[robot].when for robot in robots])
    except ValueError:
        return None  # closures leave a route no times, or the old plan has times that fall
    if not is_possible:
        return None
    tracks = graph.build_tracks()
    return None if find_rotation(part.problem, tracks) else dict(zip(robots, tracks, strict=True))


def _is_valid(scenario: Scenario, tracks: tuple[Track, ...]) -> bool:
    return check(Plan(scenario=scenario, tracks=tracks, run=PlannerRun())).ok
