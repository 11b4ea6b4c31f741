"""Planning of the rest of a fleet behind the parts of its routes that it keeps.

Each robot starts at the end of what it keeps, once it has come there and has done its work on the
way. What is kept goes first in the new order, so it waits for nobody, and the rest has the order of
a plan: the new order has no cycle.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from typing import NamedTuple

from rightofway.check import check
from rightofway.errors import GaveUp, NoPlanExists
from rightofway.facts import Fact
from rightofway.model import Plan, PlannerRun, Robot, RobotState, Scenario, Stop, Tick, Track
from rightofway.precedence import build_timetable
from rightofway.resume.commitment import make_robot_of_rest
from rightofway.resume.waiting_places import ReachableStops, choose_waiting_places
from rightofway.search import Distances
from rightofway.site import Roadmap, VertexId

MOST_ASIDE = 3
"""Attempts with other waiting places; in one more, some robots stand."""


class StopToMake(NamedTuple):
    """A job that is not released yet, the end of a lap, or a place to pass."""

    place: str
    job: str = ""
    work: int = 0  # [ticks]
    ends_lap: bool = False


class KeptPart(NamedTuple):
    """The kept part of a robot's route, from the vertex on at which it has arrived."""

    vertices: tuple[int, ...]
    work: int  # that is not done yet [ticks]
    busy: int  # until it is done at the end of it [ticks]


class RestOfFleet:
    """Plans the rest of a fleet, as far as roads are passable.

    Parameters
    ----------
    scenario
        The problem; bookings are those of ``both``.
    solve
        Plans a scenario within a time limit [s]; None for no limit.
    time_limit
        For one plan [s]; None for no limit.
    """

    def __init__(
        self,
        scenario: Scenario,
        solve: Callable[[Scenario, float | None], Plan],
        time_limit: float | None,
    ) -> None:
        self._scenario, self._solve, self._time_limit = scenario, solve, time_limit

    def plan(
        self,
        parts: Mapping[int, KeptPart],
        ways: dict[int, list[StopToMake]],
        passable: Roadmap,
        stuck: Collection[int],
        attempt: int,
    ) -> tuple[Scenario, list[Track]]:
        """Return the fleet on the floor, and the whole tracks that bring it to its stops.

        Robots first make the stops to which a way leads on the passable roadmap; then, as if
        nothing was closed, all make the stops that are left. Waiting places are added to ``ways``.

        Raises
        ------
        GaveUp
            If no plan was found, or the judge refuses it.
        """
        moving = list(ways)
        ends = {robot: parts[robot].vertices[-1] for robot in moving}
        busy = {robot: parts[robot].busy for robot in moving}
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
            self.make_robot(
                robot,
                parts[robot].vertices[0],
                ends[robot],
                parts[robot].work,
                ways[robot],
            )
            for robot in moving
        ]
        whole = replace(self._scenario, robots=tuple(fleet))
        for robot in moving:
            before = parts[robot].vertices[:-1]
            visited[robot] = [*map(VertexId, before), *visited[robot]]
            arrivals[robot] = [*range(-len(before), 0), *arrivals[robot]]
        in_order = [Track.of(visited[robot], arrivals[robot]) for robot in moving]
        tracks = build_timetable(whole.problem, in_order)
        if tracks is None:
            raise GaveUp(Fact("order not kept behind released"))
        judged = check(Plan(scenario=whole, tracks=tuple(tracks), run=PlannerRun()))
        if not judged.ok:
            raise GaveUp(Fact("rest with faults", faults=judged.total))
        return whole, tracks

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
        robots = [self.make_robot(k, home, home, busy[k], stops[k]) for k, home in homes.items()]
        rest = replace(self._scenario, roadmap=roadmap, robots=tuple(robots))
        limit = None if self._time_limit is None else self._time_limit / share
        plan = self._solve(rest, limit)
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

    def make_robot(
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
