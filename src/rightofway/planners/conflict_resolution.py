"""Conflicts between robots on fixed routes, resolved one right of way after the other.

A *rule* decides which of two robots waits; this module does the rest. The earliest conflict is
resolved first. Where no waiting keeps two robots apart, one of them is deferred: it is rerouted
when all others have their times (`reroute`). Where that fails, or takes more than its share of
the time, the whole fleet is planned by `lacam`, or by `prioritized` where robots have a size. So a
planner made of this is complete whatever its rule: given time it finds a plan or proves that none
exists.
"""

from __future__ import annotations

import random
from collections import Counter, deque
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from rightofway.errors import GaveUp
from rightofway.model import Decision, Reroute, Route, Status, Tick, Track
from rightofway.model.kept_facts import RerouteReason
from rightofway.planners.lacam import plan_fleet
from rightofway.planners.prioritized import make_fleet_search, plan_in_turn
from rightofway.planners.routing import find_shortest_track
from rightofway.planners.task import Draft, Task
from rightofway.precedence import (
    Meeting,
    PrecedenceGraph,
    Segment,
    build_graph,
    build_graph_of_plan,
    find_rotation,
    make_crossing,
)
from rightofway.search import Booking, Bookings, Distances, find_earliest_track

SHARE = 0.8
"""The part of the time for rights of way; the rest is for planning the whole fleet."""

TRIES_PER_ROBOT = 10
"""How often robots are rerouted at most, per robot of the fleet."""

START_HOLD = 4
"""How long the home of a robot without a track is kept free, in drives of its slowest edge."""

Right = tuple[int, int]
"""Two visits of the graph, of which the first goes first."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Resolution:
    """How a conflict of two robots is resolved."""

    decisions: tuple[Decision, ...]
    rights: tuple[Right, ...]


class PartialPlan:
    """A fleet on its routes, with the rights of way that are decided so far.

    Attributes
    ----------
    sees_swaps
        Whether a swap is a conflict, and segments are decided at once; the published method does
        neither.
    graph
        The rights of way.
    settled
        Per robot whether a decision holds for it; uint8, as masks are for the graph.
    deferred
        Robots that are rerouted at the end, and why.
    decisions
        All decisions in the order they were taken.
    """

    def __init__(
        self,
        task: Task,
        routes: Sequence[Route],
        *,
        sees_swaps: bool = True,
        graph: PrecedenceGraph | None = None,
    ) -> None:
        self.task = task
        self.routes = routes
        self.sees_swaps = sees_swaps
        self.settled = np.zeros(len(routes), np.uint8)
        self.deferred: dict[int, RerouteReason] = {}
        self.decisions: list[Decision] = []
        self.graph = graph or build_graph(task.scenario.problem, routes, forbid_swaps=sees_swaps)

    def resolve_all(self, rule: Rule) -> None:
        """Resolve the earliest conflict until none is left; defer where the rule cannot."""
        while True:
            self.task.deadline.check("giving right of way")
            meeting = self.graph.find_next_meeting()
            if meeting is None:
                rotation = find_rotation(self.task.scenario.problem, self._list_tracks())
                if not rotation:
                    return
                self.defer(rotation, self._explain_rotation(rotation))
                continue
            resolution = rule(self, meeting)
            if resolution is None:
                self.defer(meeting.robots, self.explain_deadlock(meeting))
                continue
            self.graph.give_all(resolution.rights)
            self.decisions += resolution.decisions
            self.settled[list(meeting.robots)] = 1

    def _list_tracks(self) -> list[Track]:
        """Return the tracks at their times; that of a deferred robot has its home only."""
        return [
            Track.of([route.vertices[0]], [0]) if robot in self.deferred else track
            for robot, (route, track) in enumerate(
                zip(self.routes, self.graph.build_tracks(), strict=True)
            )
        ]

    def find_segment(self, meeting: Meeting) -> Segment:
        """Return the visits of which one robot goes first in all."""
        if self.sees_swaps:
            return self.graph.find_segment(*meeting.visits)
        (i, visit_i), (j, visit_j) = (self.graph.place(visit) for visit in meeting.visits)
        return make_crossing(self.routes[i], visit_i, self.routes[j], visit_j)

    def defer(self, robots: Sequence[int], why: RerouteReason) -> None:
        """Take out one of some robots that no waiting keeps apart; the others keep their rights."""
        if not self.sees_swaps:
            raise GaveUp(f"{why} (the published method is stuck here; try two-level)")
        everyone = np.ones(len(self.routes), np.uint8)
        robot = max(
            robots,
            key=lambda candidate: (self.graph.count_conflicts_of(candidate, everyone), candidate),
        )
        self.deferred[robot] = why
        self.settled[robot] = 0
        self.graph.withdraw(robot)

    def _explain_rotation(self, rotation: Sequence[int]) -> RerouteReason:
        """Name the robots that would move round a circle at one instant."""
        names = [self.task.scenario.robots[robot].name for robot in rotation]
        return RerouteReason("rotation", robots=names)

    def explain_deadlock(self, meeting: Meeting) -> RerouteReason:
        """Name the two robots, and the cycle of robots that one of them would close by waiting."""
        scenario, segment = self.task.scenario, self.find_segment(meeting)
        names = [scenario.robots[robot].name for robot in meeting.robots]
        place = scenario.roadmap.name(self.graph.get_vertex(meeting.visits[0]))
        mark = self.graph.checkpoint()
        for waits in (0, 1):
            possible = self.graph.give_all(
                list_rights_if_waits(self.graph, meeting, segment, waits)
            )
            self.graph.rollback(mark)
            cycle = [] if possible else self.graph.list_deadlocked()
            if cycle:
                circle = [scenario.robots[robot].name for robot in cycle]
                return describe_deadlock(names, place, circle)
        return describe_deadlock(names, place)

    def decide(self, meeting: Meeting, segment: Segment, waits: int, delay: Tick) -> Decision:
        """Record that one of two robots (0: i, 1: j) waits; rules add their reasons."""
        first_visit = segment.i_first if waits == 0 else segment.j_first
        return Decision(
            tick=meeting.tick,
            kind=segment.kind,
            vertices=segment.list_vertices_ahead(waits),
            robots=meeting.robots,
            waits=meeting.robots[waits],
            waits_at=self.routes[meeting.robots[waits]].vertices[first_visit - 1],
            ticks=delay,
            level="only",
            conflicts_left=(None, None),
        )


Rule = Callable[[PartialPlan, Meeting], Resolution | None]
"""Decides which of two robots waits; None if no waiting keeps them apart."""


def list_rights_if_waits(
    graph: PrecedenceGraph, meeting: Meeting, segment: Segment, waits: int
) -> tuple[Right, ...]:
    """Return the rights of way in a segment if one of two robots (0: i, 1: j) waits."""
    i, j = meeting.robots
    if waits == 0:
        return tuple(
            (graph.get_visit(j, b), graph.get_visit(i, a)) for a, b in segment.list_rights_of_j()
        )
    return tuple(
        (graph.get_visit(i, a), graph.get_visit(j, b)) for a, b in segment.list_rights_of_i()
    )


def plan_by_rule(task: Task, distances: Distances, routes: Sequence[Route], rule: Rule) -> Draft:
    """Plan a fleet by rights of way, and where time is short for that by `lacam`."""
    try:
        hurried = replace(task, deadline=task.deadline.shorten(SHARE))
        return plan_on_routes(hurried, distances, PartialPlan(hurried, routes), rule)
    except GaveUp:
        because = RerouteReason("short time")
        return _plan_together(task, because)


def plan_on_routes(task: Task, distances: Distances, plan: PartialPlan, rule: Rule) -> Draft:
    """Resolve all conflicts, then reroute the robots that were deferred."""
    plan.resolve_all(rule)
    tracks = {r: t for r, t in enumerate(plan.graph.build_tracks()) if r not in plan.deferred}
    made_way = reroute(task, distances, tracks, list(plan.deferred))
    if made_way is None:
        because = RerouteReason("no way in turn")
        return _plan_together(task, because)
    ordered = [track for _, track in sorted(tracks.items())]
    status, names = Status("waits only"), [robot.name for robot in task.scenario.robots]
    if made_way:  # shift the visits of robots that waited for a robot on its former route
        ordered = build_graph_of_plan(task.scenario.problem, ordered).build_tracks()
    rerouted = [
        robot
        for robot in sorted(made_way)
        if tuple(ordered[robot].vertices.tolist()) != plan.routes[robot].vertices
    ]
    if rerouted:
        status = Status("re-routed", robots=[names[robot] for robot in rerouted])
    return Draft(
        tracks=tuple(ordered),
        status=status,
        decisions=tuple(
            decision for decision in plan.decisions if not made_way.keys() & set(decision.robots)
        ),
        reroutes=tuple(
            Reroute(robot=robot, because=plan.deferred.get(robot) or _for(names, made_way[robot]))
            for robot in rerouted
        ),
        keeps_swaps=not plan.sees_swaps,
    )


def describe_deadlock(
    names: Sequence[str], place: str, circle: Sequence[str] = ()
) -> RerouteReason:
    """Return which two robots no waiting keeps apart, and the circle that a wait would close."""
    meeting = {"one": names[0], "other": names[1], "place": place}
    if len(circle) < 3:  # noqa: PLR2004 (the two themselves)
        return RerouteReason("deadlock of two", **meeting)
    return RerouteReason("deadlock in circle", **meeting, robots=circle)


def _for(names: Sequence[str], robot: int | None) -> RerouteReason:
    if robot is None:
        return RerouteReason("makes way")
    return RerouteReason("makes way for", robot=names[robot])


def _plan_together(task: Task, because: RerouteReason) -> Draft:
    robots, problem = range(len(task.scenario.robots)), task.scenario.problem
    draft = None
    if not problem.resources.are_points or not problem.is_open:
        draft = plan_in_turn(task, make_fleet_search(task), "shortest")
    return replace(
        draft or plan_fleet(task),
        status=Status("re-routed together"),
        reroutes=tuple(Reroute(robot=robot, because=because) for robot in robots),
    )


class _Reservations:
    """The tracks of some robots of a fleet, and what these tracks book."""

    def __init__(self, task: Task, distances: Distances, tracks: dict[int, Track]) -> None:
        scenario = task.scenario
        self.task = task
        self.distances = distances
        self.itineraries = scenario.problem.itineraries
        self.tracks = tracks
        self.bookings = Bookings(scenario.problem)
        for robot, track in tracks.items():
            self.bookings.add(robot, track)

    def hold_home(self, robot: int) -> None:
        """Book the home of a robot without a track for a while, so that it can leave."""
        itinerary = self.itineraries[robot]
        row = self.bookings.get_vertex_row(robot, itinerary.home)
        booked = [booking for booking in self.bookings.list_bookings(row) if booking.robot != robot]
        hold = Tick(START_HOLD * max(itinerary.edge_ticks, default=0))
        end = min([hold, *(booking.start for booking in booked)])
        if end > 0:
            self.bookings.book(row, Booking(Tick(0), end, robot))

    def place(self, robot: int) -> bool:
        """Give a robot its earliest track among the others, if there is one."""
        self.bookings.release(robot)
        left = self.task.deadline.measure_seconds_left()
        track = find_earliest_track(robot, self.bookings, self.distances, time_limit=left)
        if track is None:
            self.hold_home(robot)
            return False
        self.tracks[robot] = track
        self.bookings.add(robot, track)
        return True

    def evict(self, robots: Iterable[int]) -> list[int]:
        """Remove the tracks of some robots; return those that had one."""
        evicted = sorted(robot for robot in robots if self.tracks.pop(robot, None) is not None)
        for robot in evicted:
            self.bookings.release(robot)
            self.hold_home(robot)
        return evicted

    def find_blockers(self, robot: int) -> set[int]:
        """Return the robots in the way of this one on its shortest route without waits.

        With closures: on its best track among them.
        """
        itinerary = self.itineraries[robot]
        track = None
        if self.bookings.problem.closures is not None:
            alone = Bookings(self.bookings.problem)
            track = find_earliest_track(robot, alone, self.distances)
        if track is None:
            track = find_shortest_track(self.bookings.problem.roadmap, itinerary, self.distances)
        return self.bookings.find_blockers(robot, track)


def reroute(
    task: Task, distances: Distances, tracks: dict[int, Track], deferred: list[int]
) -> dict[int, int | None] | None:
    """Add a track among the others to ``tracks`` for each robot without one.

    A robot that finds no way evicts the robots in its way, and these follow it in any order. The
    more often a robot fails, the more others are evicted.

    Returns
    -------
    dict or None
        All robots that were planned again, and the robot that each had to make way for first, None
        for the deferred ones; None if that failed in a bounded number of tries.

    Raises
    ------
    GaveUp
        When time ran out.
    """
    table = _Reservations(task, distances, tracks)
    waiting, made_way = deque(deferred), dict[int, int | None].fromkeys(deferred)
    failures: Counter[int] = Counter()
    draw = random.Random(task.seed)  # noqa: S311 (no secret depends on it)
    for robot in deferred:
        table.hold_home(robot)
    for _ in range(TRIES_PER_ROBOT * len(table.itineraries)):
        if not waiting:
            return made_way
        task.deadline.check("sending robots another way")
        robot = waiting.popleft()
        if table.place(robot):
            continue
        more = draw.sample(sorted(tracks), min(failures[robot], len(tracks)))
        failures[robot] += 1
        evicted = table.evict(table.find_blockers(robot).union(more))
        draw.shuffle(evicted)
        made_way = dict.fromkeys(evicted, robot) | made_way
        waiting.extend(evicted if table.place(robot) else [robot, *evicted])
    return None
