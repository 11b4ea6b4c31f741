"""Replanning during execution, after delays and breakdowns.

Commitments are kept: a stay is finished, a drive arrives, bookings remain. After its commitment,
every robot gets a new route, and every vertex a new order. The *rest* is a scenario: each robot
starts at the end of its commitment and is busy until the commitment is done. Bookings of broken
robots become closures: vertices closed for ever, and whatever robots with a size cannot book beside
them. The first plan of the rest continues by right of way. If closures block it, LaCAM finds the
first plan, and for robots with a size planning one after another, or an order of moves; a robot
that cannot reach all its places is *cut off*: it serves reachable stages and ends at a vertex where
it blocks no robot. Large neighbourhood search (LNS) improves the first plan.

Closures of the scenario bind the rest, as far as they are not over. While a robot is caught in one,
or will be before its commitment is done, no plan of the rest keeps the rules, and none is made.

A robot with a size that drives keeps its tail and its edge booked until it has arrived: in the
order of visits, its visit of the tail comes before all visits of the new plan.

Deterministic for a seed: budgets are numbers of neighbourhoods and steps. The new order has no
cycle: commitments wait only for visits that have begun, and the rest has the order of a plan.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import combinations, islice, pairwise

import numpy as np
from numpy.typing import NDArray

from rightofway.check import check
from rightofway.errors import GaveUp, NoPlanExists
from rightofway.execution.forecast import Forecast
from rightofway.model import (
    Closure,
    Itinerary,
    Plan,
    PlannerRun,
    Robot,
    Route,
    Scenario,
    Stage,
    Stop,
    Tick,
    Track,
    compute_turns_along,
    make_route,
)
from rightofway.native import find_clashes, list_excluded
from rightofway.planners import Deadline, Task
from rightofway.precedence import ActionDependencyGraph, build_timetable
from rightofway.repair.fleet_search import make_fleet_search
from rightofway.repair.moves import find_tracks_by_moves
from rightofway.search import Distances, plan_by_lacam
from rightofway.site import Roadmap, VertexId
from rightofway.solve import improve

NEIGHBOURHOODS = 20
"""Neighbourhoods per robot; five times as many hardly lower the flowtime further."""

MOST_STEPS = 20_000
"""Maximum steps of LaCAM, each a choice for every robot, for one choice of cut-off robots."""

SEARCHES, SHARE = 10, 0.5
"""Searches per robot for robots with a size, one after another, and the part of the time left."""

MOST_STATES = 3_000
"""Maximum number of states in the search for an order of their moves."""

MOST_CHOICES = 200
"""Maximum number of choices of cut-off robots, smallest choices first."""

Stages = tuple[Stage, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Commitment:
    """What one robot keeps of its route, and what is left for it to do."""

    visit: int  # the last one that it has booked; index in its route
    vertex: VertexId  # of that visit
    busy: Tick  # until that visit is expected to be done, from now
    drives_to: VertexId | None = None  # without having booked it (``occupancy: one``)
    begun: Stages = ()  # served until that visit is done
    left: Stages = ()

    @property
    def free_from(self) -> VertexId:
        """The vertex from which the robot can take a new route."""
        return self.vertex if self.drives_to is None else self.drives_to


def find_commitment(forecast: Forecast, robot: int, stages: Sequence[Stage]) -> Commitment:
    """Return what a robot, whose route serves all these stages, has begun at a forecast's instant.

    A broken one keeps its bookings and has nothing left.
    """
    adg, route = forecast.adg, forecast.adg.routes[robot]
    first, end = adg.first_visit[robot : robot + 2].tolist()
    index = int(np.count_nonzero(forecast.booked[first:end])) - 1
    if robot in forecast.broken:
        vertex = route.vertices[index]
        return Commitment(visit=index, vertex=vertex, busy=Tick(0), begun=tuple(stages))
    is_driving = forecast.is_driving(robot)
    if is_driving and forecast.may_turn_back:
        # Towards a free vertex, the robot continues as if it had a booking; else it may turn back.
        before, closures = adg.comes_after(first + index + 1), adg.scenario.problem.closures
        closed = closures.list_at_vertex(robot, route.vertices[index + 1]) if closures else []
        is_closed = any(end > forecast.now for _, end in closed)
        is_driving = False
        index += not is_closed and all(forecast.entered[other + 1] for other in before)
    while route.vertices[index] >= adg.scenario.roadmap.n_drawn:
        index += 1  # the drive along a chain is finished
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


@dataclass(frozen=True, slots=True, kw_only=True)
class Held:
    """What broken robots keep booked for ever.

    Attributes
    ----------
    vertices
        Booked by broken robots.
    edges
        Tail and head of edges that robots with a size cannot drive beside them. Where robots have
        different sizes, what is closed to one of them counts as closed to all.
    """

    vertices: frozenset[VertexId]
    edges: frozenset[tuple[int, int]] = frozenset()


def find_held_by_broken(forecast: Forecast) -> Held:
    """Return what broken robots book for ever: for robots with a size, the edge driven on, too."""
    adg, booked, paths = forecast.adg, forecast.booked, dict[int, list[int]]()
    for robot in forecast.broken:
        current, end = forecast.get_visit(robot), int(adg.first_visit[robot + 1])
        paths[robot] = adg.vertex[current:end][booked[current:end]].tolist()
    return list_held(adg.scenario, paths)


def list_held(scenario: Scenario, paths: Mapping[int, Sequence[int]]) -> Held:
    """Return what robots exclude that stay on the vertices and edges of paths."""
    resources, roadmap = scenario.problem.resources, scenario.roadmap
    vertices = frozenset(VertexId(vertex) for path in paths.values() for vertex in path)
    if resources.are_points:
        return Held(vertices=vertices)
    rows = set[int]()
    for robot, path in paths.items():
        own = [resources.get_vertex_row(robot, vertex) for vertex in path]
        own += (
            resources.get_edge_row(robot, edge)
            for ends in pairwise(path)
            if (edge := roadmap.find_edge(*ends)) is not None
        )
        rows.update(other for row in own for other in list_excluded(resources, row))
    n_vertices, count = resources.n_vertices, resources.n_vertices + resources.n_edges
    sizes = {int(resources.size_of[k]) for k in range(len(scenario.robots)) if k not in paths}
    shut = {row % count for row in rows if row // count in sizes}
    tails = np.repeat(np.arange(n_vertices), np.diff(roadmap.indptr)).tolist()
    ends_of_edges = enumerate(zip(tails, roadmap.heads.tolist(), strict=True), n_vertices)
    edges = (ends for edge, ends in ends_of_edges if edge in shut or ends[1] in shut)
    return Held(vertices=vertices, edges=frozenset(edges))


@dataclass(frozen=True, slots=True, kw_only=True)
class Replanned:
    """A new plan during execution."""

    adg: ActionDependencyGraph  # what has begun, followed by the new plan of the rest
    stages: tuple[Stages, ...]  # all that the route of each robot serves
    cut_off: frozenset[int]  # robots that are not brought to all their places


def replan(
    forecast: Forecast, stages: Sequence[Stages], seed: int, deadline: Deadline
) -> tuple[Replanned, ...]:
    """Replan the rest: first cut off few robots, then lower the flowtime.

    ``stages`` are all that the route of each robot serves. The result is empty if no plan was
    found, or time ran out before; else the plan with the lowest flowtime of the rest, and the plan
    that it improves. The rest does not know the edges of drives that have begun: where such an edge
    keeps robots off, the second plan may be the better one. A forecast knows.
    """
    scenario, cut_off = forecast.adg.scenario, frozenset[int]()
    commitments = [find_commitment(forecast, robot, own) for robot, own in enumerate(stages)]
    closed = find_held_by_broken(forecast)
    roadmap = scenario.roadmap
    if closed.vertices:
        roadmap = roadmap.exclude(closed.vertices, closed.edges)
    closures = _closures_after(scenario, roadmap, forecast.now)
    if closures is None:
        return ()
    rest = _rest(replace(scenario, closures=closures), roadmap, commitments)
    tracks = _going_on(forecast, commitments, closed, rest)
    if tracks is None:
        other_ways = _another_way(rest, forecast.broken, commitments, seed, deadline)
        if other_ways is None:
            return ()
        commitments, cut_off, tracks = other_ways
        rest = _rest(rest, roadmap, commitments)
    first = Plan(scenario=rest, tracks=tuple(tracks), run=PlannerRun(name="by right of way"))
    if closures and not check(first).ok:  # a robot is caught, or will be
        return ()
    options = {"iterations": NEIGHBOURHOODS * len(stages)}
    plans = [first]
    try:
        left = deadline.measure_seconds_left()
        plans.insert(0, improve(first, time_limit=left, seed=seed, options=options))
    except (NoPlanExists, GaveUp):
        pass  # the first plan is kept
    replanned = []
    for plan in plans:
        # A plan may move a busy robot away and back. Splicing keeps it there, which may deadlock.
        try:
            adg = _spliced(forecast, commitments, plan)
        except ValueError:
            continue
        if not adg.list_deadlocked():
            served = tuple((*commitment.begun, *commitment.left) for commitment in commitments)
            replanned.append(Replanned(adg=adg, stages=served, cut_off=cut_off))
    return tuple(replanned)


def _going_on(
    forecast: Forecast,
    commitments: Sequence[Commitment],
    closed: Held,
    rest: Scenario,
) -> list[Track] | None:
    """Return the plan with the old routes and rights of way; None if a closure blocks it."""
    adg, times = forecast.adg, forecast.compute_times()
    old_tracks = []
    for robot, commitment in enumerate(commitments):
        first, end = int(adg.first_visit[robot]) + commitment.visit, int(adg.first_visit[robot + 1])
        if robot in forecast.broken:
            end = first + 1
        visited = adg.vertex[first:end].tolist()
        drives = pairwise(visited)
        if not closed.vertices.isdisjoint(visited[1:]) or not closed.edges.isdisjoint(drives):
            return None
        old_tracks.append(Track.of(visited, times[first:end].tolist()))
    return build_timetable(rest.problem, old_tracks)


def _another_way(
    rest: Scenario,
    broken: frozenset[int],
    commitments: Sequence[Commitment],
    seed: int,
    deadline: Deadline,
) -> tuple[list[Commitment], frozenset[int], list[Track]] | None:
    """Return commitments and stages, the smallest set of cut-off robots, and LaCAM's tracks."""
    is_simple = rest.problem.resources.are_points and not rest.closures
    find = _together if is_simple else _by_turns
    for cut_off, tried in islice(_choices(rest, broken, commitments), MOST_CHOICES):
        if deadline.measure_seconds_left() == 0:
            return None
        try:
            other_routes = find(_rest(rest, rest.roadmap, tried), cut_off, seed, deadline)
        except (NoPlanExists, GaveUp):
            continue
        if other_routes is None:
            continue
        ended = [
            _with_end(commitment, commitment.left[:-1], int(own.vertices[-1]))
            if robot in cut_off
            else commitment
            for robot, (commitment, own) in enumerate(zip(tried, other_routes, strict=True))
        ]
        tracks = build_timetable(_rest(rest, rest.roadmap, ended).problem, other_routes)
        if tracks is not None:
            return ended, cut_off, tracks
    return None


def _together(
    rest: Scenario, cut_off: frozenset[int], seed: int, deadline: Deadline
) -> Sequence[Track] | None:
    """Return the plan that LaCAM finds in steps."""
    return plan_by_lacam(
        rest.problem.as_steps(),
        seed=seed,
        most_effort=MOST_STEPS * len(rest.robots),
        time_limit=deadline.measure_seconds_left(),
        spreads=False,
        ends_anywhere=cut_off,
    )


def _by_turns(
    rest: Scenario, cut_off: frozenset[int], seed: int, deadline: Deadline
) -> Sequence[Track] | None:
    """Return the plan for robots one after another, or else of single moves, or by LaCAM."""
    problem = rest.problem
    task = Task(scenario=rest, seed=seed, deadline=deadline)
    tracks: Sequence[Track] = ()
    ends = [itinerary.last for itinerary in problem.itineraries]
    if not any(find_clashes(problem.resources, ends)):
        search = make_fleet_search(task)
        turns = sorted(range(len(rest.robots)), key=search.compute_alone().tolist().__getitem__)
        searches, limit = SEARCHES * len(turns), deadline.shorten(SHARE).measure_seconds_left()
        if search.prioritize(turns, searches=searches, time_limit=limit):
            tracks = search.list_tracks()
    if tracks:
        return tracks
    if problem.resources.are_points:  # its order of visits may keep the closures
        return _together(rest, cut_off, seed, deadline)
    return find_tracks_by_moves(task, ends_anywhere=cut_off, most_states=MOST_STATES)


def _choices(
    rest: Scenario, broken: frozenset[int], commitments: Sequence[Commitment]
) -> Iterator[tuple[frozenset[int], list[Commitment]]]:
    """Yield sets of cut-off robots, and stages of all robots: small sets, then most stages first.

    The last stage of a cut-off robot is its preferred end.
    """
    distances = Distances(rest.roadmap)
    reachable = [
        replace(commitment, left=_within_reach(distances, itinerary, commitment))
        for itinerary, commitment in zip(rest.problem.itineraries, commitments, strict=True)
    ]
    by_map = {
        robot
        for robot, commitment in enumerate(commitments)
        if len(reachable[robot].left) < len(commitment.left)
    }
    others = [robot for robot in range(len(commitments)) if robot not in broken | by_map]
    for count in range(len(others) + 1):
        for more in combinations(others, count):
            cut_off = frozenset(by_map.union(more))
            for most in (None, 0) if cut_off else (None,):
                tried = list(reachable)
                for robot in cut_off:
                    commitment, left = reachable[robot], reachable[robot].left[:most]
                    tried[robot] = _with_end(
                        commitment, left, left[-1].vertex if left else commitment.free_from
                    )
                yield cut_off, tried


def _within_reach(distances: Distances, itinerary: Itinerary, commitment: Commitment) -> Stages:
    """Return the stages that a robot can still reach, in order."""
    at, reached = commitment.free_from, []
    for stage in commitment.left:
        if distances.to(stage.vertex, itinerary.edge_ticks)[at] >= 0:
            reached.append(stage)
            at = stage.vertex
    return tuple(reached)


def _with_end(commitment: Commitment, left: Stages, vertex: int) -> Commitment:
    return replace(
        commitment, left=(*left, Stage(vertex=VertexId(vertex), work=Tick(0), turn=Tick(0)))
    )


def _closures_after(scenario: Scenario, roadmap: Roadmap, now: Tick) -> tuple[Closure, ...] | None:
    """Return the closures that are not over, from an instant on.

    None where broken robots have taken the edges of a closed lane, and the radius of its closure
    reaches farther: its place is no part of the roadmap that is left.
    """
    passed = scenario.problem.clock.convert_to_time(now)
    after = []
    for closure in scenario.closures:
        until = None if closure.until is None else closure.until - passed
        if until is not None and until <= 0:
            continue
        if closure.edge is not None and not roadmap.find_ways_along(closure.edge):
            if closure.radius is not None:
                return None
            continue
        after.append(replace(closure, from_=max(closure.from_ - passed, Fraction(0)), until=until))
    return tuple(after)


def _rest(scenario: Scenario, roadmap: Roadmap, commitments: Sequence[Commitment]) -> Scenario:
    """Return the scenario of the rest; turning becomes work, since a turn may have begun."""
    time = scenario.problem.clock.convert_to_time

    def one_way(robot: Robot, commitment: Commitment) -> Robot:
        stops = [Stop(at=commitment.vertex, work=time(commitment.busy))]
        if commitment.drives_to is not None:
            stops.append(Stop(at=commitment.drives_to))
        for number, stage in enumerate(commitment.left, 1):
            turn = stage.turn if number < len(commitment.left) else 0
            stops.append(Stop(at=stage.vertex, work=time(Tick(stage.work + turn))))
        if not commitment.left:
            stops.append(Stop(at=stops[-1].at))
        return replace(
            robot, home=commitment.vertex, stops=tuple(stops), turn=Fraction(0), ends="none", laps=1
        )

    robots = tuple(map(one_way, scenario.robots, commitments))
    return replace(scenario, roadmap=roadmap, robots=robots, clock=scenario.problem.clock)


def _turn_aside(
    scenario: Scenario, robot: int, commitment: Commitment, old: Route, ahead: Sequence[VertexId]
) -> int:
    """Return how long a robot turns at the end of its commitment to the vertex ahead, if any.

    Where it drives on as planned, the turn is a part of what the robot is busy with.
    """
    came, planned = (
        old.vertices[max(commitment.visit - 1, 0) : commitment.visit],
        old.vertices[commitment.visit + 1 :],
    )
    if commitment.drives_to is not None:
        came, planned = (commitment.vertex,), ()
    if not came or not ahead or ahead == planned[:1]:
        return 0
    path = np.array([*came, commitment.free_from, *ahead], np.int32)
    return int(compute_turns_along(scenario.roadmap, scenario.problem.itineraries[robot], path)[1])


def _number_arrivals(enter: NDArray[np.int64], arrives: int) -> NDArray[np.int64]:
    """Return when committed visits begin; those that have not begun, in their order from a tick."""
    is_ahead = enter > arrives
    return np.where(is_ahead, arrives + np.maximum(np.cumsum(is_ahead) - 1, 0), enter)


def _spliced(
    forecast: Forecast, commitments: Sequence[Commitment], plan: Plan
) -> ActionDependencyGraph:
    """Return the commitments followed by a plan of the rest."""
    adg, now = forecast.adg, forecast.now
    # The arrival of a robot with a size comes after all that has ended until now, and before all
    # that is new. For points both begin at the vertex, and the order there is known.
    arrives = now if adg.scenario.problem.resources.are_points else now + 1
    firsts = adg.first_visit.tolist()
    begins_of_kept = [
        _number_arrivals(forecast.progress.enter[first : first + commitment.visit + 1], arrives)
        for first, commitment in zip(firsts[:-1], commitments, strict=True)
    ]
    latest = max(int(enter[-1]) for enter in begins_of_kept)
    routes, tracks, sinces = [], [], []
    for robot, (commitment, old) in enumerate(zip(commitments, adg.routes, strict=True)):
        itinerary, track = plan.scenario.problem.itineraries[robot], plan.tracks[robot]
        new = make_route(plan.scenario.roadmap, itinerary, track)
        is_driving = commitment.drives_to is not None
        # The new route's visit at the end of the commitment is the last visit of the old route.
        begins, n_begun = new.serves[is_driving], commitment.visit + 1 + is_driving
        before = 0 if is_driving else old.dwell[commitment.visit] - commitment.busy
        # The new route does not know where the robot has come from.
        known = compute_turns_along(plan.scenario.roadmap, itinerary, track.vertices)[begins]
        aside = _turn_aside(
            adg.scenario, robot, commitment, old, new.vertices[begins + 1 : begins + 2]
        )
        shift = n_begun - 1 - begins
        to_come = new.serves[len(new.serves) - len(commitment.left) :]
        serves = [*old.serves[: len(commitment.begun)], *(visit + shift for visit in to_come)]
        serves[-1] = len(new) - 1 + shift  # a completed robot may give way and return
        route = Route(
            vertices=(*old.vertices[:n_begun], *new.vertices[begins + 1 :]),
            dwell=(
                *old.dwell[: n_begun - 1],
                Tick(before + new.dwell[begins] - int(known) + aside),
                *new.dwell[begins + 1 :],
            ),
            drive=(*old.drive[:n_begun], *new.drive[begins + 1 :]),
            serves=tuple(serves),
        )
        booked = slice(first := int(adg.first_visit[robot]), first + commitment.visit + 1)
        enter = max(arrives, latest) + 1 + track.enter[begins + 1 - is_driving :]
        since = np.full(len(enter), now)
        next_visit = slice(commitment.visit + 1, commitment.visit + 2)
        turns_back = old.vertices[next_visit] != route.vertices[next_visit]
        if len(enter) and forecast.may_turn_back and forecast.has_set_off(robot) and turns_back:
            since[0] += route.drive[commitment.visit + 1]
        enter = np.append(begins_of_kept[robot], enter)
        tracks.append(Track(vertices=np.array(route.vertices, np.int32), enter=enter))
        routes.append(route)
        sinces.append(np.append(adg.since[booked], since))
    return ActionDependencyGraph(
        adg.scenario, tracks, adg.delay_model, routes=routes, since=np.concatenate(sinces)
    )
