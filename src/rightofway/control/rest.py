"""Planning of the rest: routes behind all that is released, judged whole before they count.

Each robot starts at the end of what is released to it, once it has come there and has done its work
on the way. All that is released goes first in the new order, so commitments wait for nobody, and
the rest has the order of a plan: the new order has no cycle. Bookings are those of ``both``.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace
from itertools import accumulate

from rightofway.check import check
from rightofway.control.commitments import (
    RobotCommitment,
    begin_at_stop,
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
    Scenario,
    Track,
    make_route,
)
from rightofway.model.route import make_route_through
from rightofway.precedence import ReleaseGraph, build_graph
from rightofway.repair.local_search import LocalSearch
from rightofway.repair.plan_request import PlanRequest
from rightofway.resume.held import list_held
from rightofway.resume.rest_of_fleet import MOST_ASIDE, RestOfFleet, StopToMake
from rightofway.site import Roadmap
from rightofway.site.chains import list_next_stops
from rightofway.solve import solve

__all__ = ["RestPlanner"]

SHARE = 50
"""Rights of way are switched where that saves a fiftieth of the flowtime of the rest, or more."""


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
        self._rest = RestOfFleet(
            self._scenario,
            lambda rest, limit: solve(rest, planner, time_limit=limit),
            time_limit,
        )

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
            Its state in the ledger.
        """
        return begin_at_stop(own, self.may_stop)

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
        reason: Fact | None = None
        for attempt in range(MOST_ASIDE + 1):
            try:
                ways = {
                    k: self._choose_way(robots[k], commitments[k], stops[k], attempt)
                    for k in moving
                }
                parts = {k: commitments[k].part for k in moving}
                whole, tracks = self._rest.plan(parts, ways, passable, standing, attempt)
                planned_routes = [
                    self._route(whole, index, track, commitments[robot], ways[robot])
                    for index, (robot, track) in enumerate(zip(moving, tracks, strict=True))
                ]
            except (NoPlanExists, GaveUp, InputError) as error:
                reason = reason or error.explain().detach()
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
            self._rest.make_robot(
                robot,
                own_commitment.part.vertices[0],
                own_commitment.part.vertices[-1],
                own_commitment.part.work + (span if robot in stuck else 0),
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
            for visit in range(first, first + len(commitments[robot].part.vertices))
        }
        before = graph.compute_flowtime()
        LocalSearch(
            PlanRequest(scenario=whole), graph, lambda visit: visit not in committed
        ).descend()
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
        held = list_held(self._scenario, {k: commitments[k].part.vertices for k in stuck})
        if not shut and not held.vertices:
            return roadmap
        return roadmap.exclude(held.vertices, {*shut, *held.edges})

    def _choose_way(
        self, own: RobotLedger, commitment: RobotCommitment, stops: Sequence[StopToMake], aside: int
    ) -> list[StopToMake]:
        """Return the stops behind what is kept, with one beside it where the robot comes back.

        An action is done at a node that is new: a robot that stands where it has work to do drives
        away and comes back.
        """
        roadmap, place = self._scenario.roadmap, commitment.part.vertices[-1]
        stops_ahead = [*stops, StopToMake(own.route.places[-1])]
        if stops_ahead[0].job and roadmap.get_vertex(stops_ahead[0].place) == place:
            ends = list_next_stops(roadmap, place)
            if not ends:
                raise GaveUp(Fact("place not entered again", place=stops_ahead[0].place))
            # From a neighbour on a one-way lane the planner finds a longer way back.
            back = [stop for stop in ends if place in list_next_stops(roadmap, stop)] or ends
            stops_ahead.insert(0, StopToMake(roadmap.name(back[aside % len(back)])))
        return stops_ahead

    @staticmethod
    def _route(
        whole: Scenario,
        index: int,
        track: Track,
        commitment: RobotCommitment,
        stops: Sequence[StopToMake],
    ) -> RouteToDrive:
        """Return the route of a whole track, with its jobs and ends of laps."""
        route, last = commitment.route, len(commitment.part.vertices) - 1
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
