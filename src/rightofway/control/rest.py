"""Planning of the rest: routes behind all that is released, judged whole before they count.

Each robot starts at the end of what is released to it, once it has come there and has done its work
on the way. All that is released goes first in the new order, so commitments wait for nobody, and
the rest has the order of a plan: the new order has no cycle. Bookings are those of ``both``.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from itertools import accumulate

from rightofway.check import check
from rightofway.control.commitments import (
    RobotCommitment,
    StopToMake,
    list_stops_to_make,
    make_robot_commitment,
)
from rightofway.control.laps import build_graph_behind_released
from rightofway.control.robot_ledger import RobotLedger
from rightofway.control.routes import RouteToDrive
from rightofway.errors import GaveUp, InputError, NoPlanExists
from rightofway.facts import Fact
from rightofway.model import (
    Plan,
    PlannerRun,
    Robot,
    RobotState,
    Scenario,
    Stop,
    Tick,
    Track,
    make_route,
)
from rightofway.model.route import make_route_through
from rightofway.precedence import ReleaseGraph, build_graph, build_timetable
from rightofway.repair.local_search import LocalSearch
from rightofway.repair.task import Task
from rightofway.resume.commitment import make_robot_of_rest
from rightofway.resume.held import list_held
from rightofway.resume.waiting_places import ReachableStops, choose_waiting_places
from rightofway.search import Distances
from rightofway.site import Roadmap, VertexId
from rightofway.site.chains import list_next_stops
from rightofway.solve import solve

__all__ = ["RestPlanner", "explain_error"]

SHARE = 50
"""Rights of way are switched where that saves a fiftieth of the flowtime of the rest, or more."""

MOST_ASIDE = 3
"""Neighbours that are tried where a robot has to leave a place and come back to work there, and
ways to choose waiting places; in one more attempt some robots stand."""


def explain_error(error: Exception) -> Fact | str:
    """Return the reason of an error as the journal keeps it: a fact with names, or English text."""
    reason = getattr(error, "reason", None)
    if isinstance(reason, Fact) and reason.about is None:
        return reason
    return str(error)


class RestPlanner:
    """Plans the rest of a fleet that drives.

    Parameters
    ----------
    scenario
        The problem.
    planner
        The name of a planner.
    time_limit
        For one plan [s]; None for no limit.
    """

    def __init__(
        self, scenario: Scenario, planner: str = "auto", time_limit: float | None = 2
    ) -> None:
        rules = replace(scenario.rules, occupancy="both", rotations=False)
        clock = scenario.problem.clock
        self._scenario = replace(scenario, rules=rules, clock=clock, closures=())
        self._planner, self._time_limit = planner, time_limit

    def may_stop(self, place: str) -> bool:
        """Return whether robots may stop at a vertex; they may at one that the map does not have.

        Parameters
        ----------
        place
            Its name.
        """
        roadmap = self._scenario.roadmap
        try:
            return not roadmap.is_passed(roadmap.get_vertex(place))
        except InputError:
            return True

    def begin_at_stop(self, own: RobotLedger) -> RobotLedger:
        """Return a robot as if it had arrived no further than where it last might stop.

        A drive through passed vertices is planned as a whole.

        Parameters
        ----------
        own
            What is known of it.
        """
        visit = own.arrived
        while visit > own.route.first and not self.may_stop(own.route.get_place(visit)):
            visit -= 1
        return own if visit == own.arrived else replace(own, arrived=visit)

    def plan(
        self,
        robots: Sequence[RobotLedger],
        released: Sequence[int],
        stops: Sequence[Sequence[StopToMake]],
        closed: Collection[tuple[str, str]] = (),
        stuck: Collection[int] = (),
    ) -> tuple[list[RouteToDrive], ReleaseGraph]:
        """Return routes behind what is released, and who waits for whom on them.

        Robots first make the stops to which a way leads that is neither closed nor held by a robot
        that is stuck. Then, as if nothing was closed, all make the stops that are left.

        Parameters
        ----------
        robots
            What is known of each robot.
        released
            The last part of each that is kept.
        stops
            What each shall do behind it, in order.
        closed
            Edges that robots shall not enter any more, as names of their vertices.
        stuck
            Robots that do not go on for now.

        Raises
        ------
        GaveUp
            If no plan was found, or the judge refuses it.
        """
        robots = list(map(self.begin_at_stop, robots))
        commitments = [
            make_robot_commitment(self._scenario, robot, own, end)
            for robot, (own, end) in enumerate(zip(robots, released, strict=True))
        ]
        moving = [robot for robot, own in enumerate(robots) if not own.is_off]
        standing = [robot for robot in stuck if not robots[robot].is_off]
        passable = self._find_passable(commitments, closed, standing)
        reason: Fact | str | None = None
        for attempt in range(MOST_ASIDE + 1):
            try:
                ways = {k: self._way(robots[k], commitments[k], stops[k], attempt) for k in moving}
                planned_routes = self._routes(commitments, ways, passable, standing, attempt)
            except (NoPlanExists, GaveUp, InputError) as error:
                reason = reason or explain_error(error)
                continue
            routes = [own.route.cut_before(own.arrived) for own in robots]
            for robot, route in zip(moving, planned_routes, strict=True):
                routes[robot] = route
            absent = [robot for robot, own in enumerate(robots) if own.is_off]
            graph = build_graph_behind_released(self._scenario, routes, released, absent)
            if not graph.find_rotation():
                return routes, graph
            reason = reason or Fact("robots would rotate")
        raise GaveUp(Fact("no routes for the rest", reason=reason))

    def find_better_order(
        self, robots: Sequence[RobotLedger], released: Sequence[int], stuck: Collection[int] = ()
    ) -> tuple[list[RouteToDrive], ReleaseGraph] | None:
        """Return the same routes in a better order, as far as robots have come; None if none is.

        Rights of way are switched where that lowers the sum of the times at which robots come to
        their ends. All that is released keeps its own.

        Parameters
        ----------
        robots
            What is known of each robot.
        released
            The last part of each that is kept.
        stuck
            Robots that do not go on for now: others go first where they can.
        """
        robots = list(map(self.begin_at_stop, robots))
        moving = [robot for robot, own in enumerate(robots) if not own.is_off]
        routes = [own.route.cut_before(own.arrived) for own in robots]
        commitments = {
            robot: make_robot_commitment(self._scenario, robot, robots[robot], released[robot])
            for robot in moving
        }
        stops = {
            robot: [
                *list_stops_to_make(robots[robot], released[robot]),
                StopToMake(route.places[-1]),
            ]
            for robot, route in enumerate(routes)
        }
        span = 1 + sum(route.enter[-1] - route.enter[0] for route in routes)
        fleet = [
            self._robot(
                robot,
                own_commitment.vertices[0],
                own_commitment.vertices[-1],
                own_commitment.work + (span if robot in stuck else 0),
                stops[robot],
            )
            for robot, own_commitment in commitments.items()
        ]
        whole = replace(self._scenario, robots=tuple(fleet))
        try:
            itineraries = whole.problem.itineraries
        except InputError:  # robots that are stuck would be busy for longer than a problem may last
            return None
        visited = [
            make_route_through(
                whole.roadmap,
                itinerary,
                whole.roadmap.unfold_route(
                    [whole.roadmap.get_vertex(place) for place in routes[robot].places]
                ),
            )
            for robot, itinerary in zip(moving, itineraries, strict=True)
        ]
        times = [
            [
                tick + span * (routes[robot].first + index > released[robot])
                for index, tick in enumerate(routes[robot].enter)
            ]
            for robot in moving
        ]
        graph = build_graph(whole.problem, visited)
        if not graph.keeps_order(times):
            return None
        committed = {
            visit
            for first, robot in zip(accumulate(map(len, visited), initial=0), moving, strict=False)
            for visit in range(first, first + len(commitments[robot].vertices))
        }
        before = graph.compute_flowtime()
        LocalSearch(Task(scenario=whole), graph, lambda visit: visit not in committed).descend()
        if (before - graph.compute_flowtime()) * SHARE < before:
            return None
        tracks = graph.build_tracks()
        if not check(Plan(scenario=whole, tracks=tuple(tracks), run=PlannerRun())).ok:
            return None
        for robot, track in zip(moving, tracks, strict=True):
            enter = tuple(track.enter.tolist())
            routes[robot] = replace(routes[robot], enter=enter, in_step=False)
        absent = [robot for robot, own in enumerate(robots) if own.is_off]
        released_first = build_graph_behind_released(self._scenario, routes, released, absent)
        return None if released_first.find_rotation() else (routes, released_first)

    def _find_passable(
        self,
        commitments: Sequence[RobotCommitment],
        closed: Collection[tuple[str, str]],
        stuck: Sequence[int],
    ) -> Roadmap:
        """Return the roadmap without what is closed, and what robots that are stuck exclude."""
        roadmap = self._scenario.roadmap
        shut = {(roadmap.get_vertex(tail), roadmap.get_vertex(head)) for tail, head in closed}
        held = list_held(self._scenario, {k: commitments[k].vertices for k in stuck})
        if not shut and not held.vertices:
            return roadmap
        return roadmap.exclude(held.vertices, {*shut, *held.edges})

    def _routes(
        self,
        commitments: Sequence[RobotCommitment],
        ways: dict[int, list[StopToMake]],
        passable: Roadmap,
        stuck: Collection[int],
        attempt: int,
    ) -> list[RouteToDrive]:
        """Return the whole route of each robot on the floor; add waiting places to its stops."""
        moving = list(ways)
        ends = {robot: commitments[robot].vertices[-1] for robot in moving}
        busy = {robot: commitments[robot].busy for robot in moving}
        begun = {
            robot: 0
            if robot in stuck
            else self._count_reachable(robot, passable, ends[robot], stops)
            for robot, stops in ways.items()
        }
        trips = self._list_reachable_stops(ends, ways, begun)
        waiting = self._find_waiting_places(passable, trips, ways, stuck, attempt)
        for robot, place in waiting.items():
            ways[robot].insert(begun[robot], StopToMake(place))
            begun[robot] += 1
        first = {robot: ways[robot][: begun[robot]] for robot in moving}
        if attempt < MOST_ASIDE:
            visited, arrivals = self._plan_stops(passable, ends, busy, first)
        else:
            visited, arrivals = self._plan_some_stops(passable, ends, busy, first)
            begun = {robot: len(first[robot]) for robot in moving}
        if any(begun[robot] < len(ways[robot]) for robot in moving):
            then = {robot: ways[robot][begun[robot] :] for robot in moving}
            ends_then = {robot: visited[robot][-1] for robot in moving}
            begins = 1 + max(times[-1] for times in arrivals.values())
            more, times = self._plan_stops(
                self._scenario.roadmap, ends_then, dict.fromkeys(moving, 0), then
            )
            for robot in moving:
                visited[robot] += more[robot][1:]
                arrivals[robot] += [begins + tick for tick in times[robot][1:]]
        fleet = [
            self._robot(
                robot,
                commitments[robot].vertices[0],
                ends[robot],
                commitments[robot].work,
                ways[robot],
            )
            for robot in moving
        ]
        whole = replace(self._scenario, robots=tuple(fleet))
        for robot in moving:
            before = commitments[robot].vertices[:-1]
            visited[robot] = [*map(VertexId, before), *visited[robot]]
            arrivals[robot] = [*range(-len(before), 0), *arrivals[robot]]
        in_order = [Track.of(visited[robot], arrivals[robot]) for robot in moving]
        tracks = build_timetable(whole.problem, in_order)
        if tracks is None:
            raise GaveUp(Fact("order not kept behind released"))
        judged = check(Plan(scenario=whole, tracks=tuple(tracks), run=PlannerRun()))
        if not judged.ok:
            raise GaveUp(Fact("rest with faults", faults=judged.total))
        return [
            self._route(whole, index, track, commitments[robot], ways[robot])
            for index, (robot, track) in enumerate(zip(moving, tracks, strict=True))
        ]

    def _list_reachable_stops(
        self,
        ends: Mapping[int, int],
        ways: Mapping[int, Sequence[StopToMake]],
        begun: Mapping[int, int],
    ) -> dict[int, ReachableStops]:
        """Return the stops that each robot can make for now, and the next one that it cannot."""
        trips = {}
        for robot, stops in ways.items():
            vertices = [self._scenario.roadmap.get_vertex(stop.place) for stop in stops]
            trips[robot] = ReachableStops(
                start=VertexId(ends[robot]),
                stops=tuple(vertices[: begun[robot]]),
                then=vertices[begun[robot]] if begun[robot] < len(stops) else None,
            )
        return trips

    def _find_waiting_places(
        self,
        passable: Roadmap,
        trips: Mapping[int, ReachableStops],
        ways: Mapping[int, Sequence[StopToMake]],
        stuck: Collection[int],
        attempt: int,
    ) -> dict[int, str]:
        """Return where robots wait behind the stops that they can make, where that is not there.

        They wait as near as they block nobody; in the second attempt at the ends of their routes,
        which never exclude each other; in the third one where they are.
        """
        get_vertex, name = self._scenario.roadmap.get_vertex, self._scenario.roadmap.name
        cut_off = [k for k, trip in trips.items() if trip.then is not None and k not in stuck]
        if attempt in {0, MOST_ASIDE} and cut_off:
            places = choose_waiting_places(self._scenario, passable, trips, stuck)
        elif attempt == 1:
            places = {
                k: get_vertex(ways[k][-1].place)
                for k in cut_off
                if self._count_reachable(k, passable, trips[k].end, ways[k][-1:])
            }
        else:
            places = {}
        return {k: name(place) for k, place in places.items() if place != trips[k].end}

    def _plan_stops(
        self,
        roadmap: Roadmap,
        homes: Mapping[int, int],
        busy: Mapping[int, int],
        stops: Mapping[int, Sequence[StopToMake]],
        share: int = 1,
    ) -> tuple[dict[int, list[VertexId]], dict[int, list[int]]]:
        """Return the visits of robots that make stops on a roadmap, and when each begins.

        It may take the time for one plan, or that part of it of which there are ``share``.
        """
        robots = [self._robot(k, home, home, busy[k], stops[k]) for k, home in homes.items()]
        rest = replace(self._scenario, roadmap=roadmap, robots=tuple(robots))
        limit = None if self._time_limit is None else self._time_limit / share
        plan = solve(rest, self._planner, time_limit=limit)
        tracks = dict(zip(homes, plan.tracks, strict=True))
        visited = {k: list(map(VertexId, track.vertices.tolist())) for k, track in tracks.items()}
        return visited, {k: track.enter.tolist() for k, track in tracks.items()}

    def _plan_some_stops(
        self,
        roadmap: Roadmap,
        homes: Mapping[int, int],
        busy: Mapping[int, int],
        stops: dict[int, list[StopToMake]],
    ) -> tuple[dict[int, list[VertexId]], dict[int, list[int]]]:
        """Return the same for robots that do not block each other; clear the stops of others.

        Robots are taken in one after another, those that are left out stand meanwhile.
        """
        wanted = {robot: own for robot, own in stops.items() if own}
        stops.update({robot: [] for robot in wanted})
        planned = self._plan_stops(roadmap, homes, busy, stops, share=len(wanted) + 1)
        for robot, own in wanted.items():
            with suppress(NoPlanExists, GaveUp):
                more = {**stops, robot: own}
                planned = self._plan_stops(roadmap, homes, busy, more, share=len(wanted) + 1)
                stops[robot] = own
        return planned

    def _count_reachable(
        self, robot: int, passable: Roadmap, home: int, stops: Sequence[StopToMake]
    ) -> int:
        """Return how many stops, from the first one on, a way leads to one after the other."""
        if passable is self._scenario.roadmap:
            return len(stops)
        distances, ticks = Distances(passable), self._scenario.problem.itineraries[robot].edge_ticks
        for number, stop in enumerate(stops):
            vertex = passable.get_vertex(stop.place)
            if distances.to(vertex, ticks)[home] < 0:
                return number
            home = vertex
        return len(stops)

    def _way(
        self, own: RobotLedger, commitment: RobotCommitment, stops: Sequence[StopToMake], aside: int
    ) -> list[StopToMake]:
        """Return the stops behind what is kept, with one beside it where the robot comes back.

        An action is done at a node that is new: a robot that stands where it has work to do drives
        away and comes back.
        """
        roadmap, place = self._scenario.roadmap, commitment.vertices[-1]
        stops_ahead = [*stops, StopToMake(own.route.places[-1])]
        if stops_ahead[0].job and roadmap.get_vertex(stops_ahead[0].place) == place:
            ends = list_next_stops(roadmap, place)
            if not ends:
                raise GaveUp(Fact("place not entered again", place=stops_ahead[0].place))
            # From a neighbour on a one-way lane the planner finds a longer way back.
            back = [stop for stop in ends if place in list_next_stops(roadmap, stop)] or ends
            stops_ahead.insert(0, StopToMake(roadmap.name(back[aside % len(back)])))
        return stops_ahead

    def _robot(
        self, robot: int, home: int, end: int, busy: int, stops: Sequence[StopToMake]
    ) -> Robot:
        """Return a robot that is busy at the end of what it keeps, and then makes its stops."""
        time = self._scenario.problem.clock.convert_to_time
        state = RobotState(at=VertexId(end), ready=time(Tick(busy)))
        to_make = [
            Stop(at=self._scenario.roadmap.get_vertex(stop.place), work=time(Tick(stop.work)))
            for stop in stops
        ]
        return make_robot_of_rest(self._scenario.robots[robot], state, to_make, home=VertexId(home))

    @staticmethod
    def _route(
        whole: Scenario,
        index: int,
        track: Track,
        commitment: RobotCommitment,
        stops: Sequence[StopToMake],
    ) -> RouteToDrive:
        """Return the route of a whole track, with its jobs and ends of laps."""
        route, last = commitment.route, len(commitment.vertices) - 1
        serves = make_route(whole.roadmap, whole.problem.itineraries[index], track).serves[1:]
        jobs = [*map(list, route.jobs), *([] for _ in range(last + 1, len(track)))]
        work = [*map(list, route.work), *([] for _ in range(last + 1, len(track)))]
        lap_ends = list(route.lap_ends)
        for stop, visit in zip(stops, serves, strict=True):
            if stop.job and visit == last:
                raise GaveUp(Fact("job at a sent node", job=stop.job))
            if stop.job:
                jobs[visit].append(stop.job)
                work[visit].append(stop.work)
            if stop.ends_lap:
                lap_ends.append(route.first + visit)
        return replace(
            route,
            places=tuple(map(whole.roadmap.name, track.vertices.tolist())),
            jobs=tuple(map(tuple, jobs)),
            work=tuple(map(tuple, work)),
            enter=tuple(track.enter.tolist()),
            lap_ends=tuple(sorted(lap_ends)),
            in_step=False,
        )
