"""The floor of a control as a simulated one, to forecast with: robots go on by right of way.

A forecast proves nothing and lets no robot go on. Rounds begin because of it, and it says when
robots are free, how full they are then, and when they would do the rest of the old plan.
"""

from __future__ import annotations

from collections import defaultdict, deque
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

from rightofway.control.commitments import begin_at_stop
from rightofway.control.ledger import Ledger
from rightofway.control.robot_ledger import RobotLedger
from rightofway.control.work_items import find_charge_step, find_stop
from rightofway.dispatch import PlannedStep
from rightofway.dispatch.delays import DelayDraws
from rightofway.dispatch.floor import FloorRobot, SimulatedFloor, StepToDo, VisitToCome
from rightofway.dispatch.takeover import (
    forecast_free,
    list_coming_visits,
    make_step_to_do,
)
from rightofway.model import NEVER, Scenario, Tick, Track
from rightofway.model.turning import find_heading_on_site
from rightofway.precedence import DelayModel, Part
from rightofway.site import Roadmap, VertexId

__all__ = [
    "FloorReports",
    "ForecastRobot",
    "ItemToDo",
    "forecast_kept_parts",
    "list_items_to_do",
    "list_vertices",
    "mirror_floor",
    "put_at_stop",
]

WHOLE = 1000
"""Into how many parts a measured charge is rounded: shares of a battery are exact."""

GONE = 2**62
"""The number of the visit of a robot that is off the floor: nobody waits for it."""


class FloorReports:
    """Reports of robots since the start, as far as forecasts need them.

    Parameters
    ----------
    charges
        The state of charge of each robot, from 0 to 1; a robot that reports none counts as full.
    headings
        As `RobotState.heading` [degrees].
    ready
        When each robot is ready [ticks].
    """

    def __init__(
        self,
        charges: Mapping[int, float],
        headings: Mapping[int, Fraction],
        ready: Sequence[int],
    ) -> None:
        self._charges, self.headings, self.ready = charges, headings, ready
        self._seen: dict[int, tuple[int, int, int]] = {}

    def look(self, ledger: Ledger, now: int) -> None:
        """Note which robots have arrived or worked since the last call.

        Parameters
        ----------
        ledger
            The state that the journal describes.
        now
            The tick.
        """
        for robot, own in enumerate(ledger.robots):
            if self._seen.get(robot, ())[:2] != (own.arrived, own.jobs_done):
                self._seen[robot] = own.arrived, own.jobs_done, now

    def find_since(self, robot: int, own: RobotLedger, now: int) -> int:
        """Return since when a robot has done nothing new, as far as that is known [ticks]."""
        arrived, done, tick = self._seen.get(robot, (-1, -1, now))
        return tick if (arrived, done) == (own.arrived, own.jobs_done) else now

    def get_soc(self, robot: int) -> Fraction:
        """Return the state of charge of a robot, from 0 to 1."""
        return Fraction(round(self._charges.get(robot, 1.0) * WHOLE), WHOLE)


@dataclass(frozen=True, slots=True, kw_only=True)
class ItemToDo:
    """Work or a charge along a route that is not done; ``is_sent`` if an order has its begin."""

    step: PlannedStep
    is_sent: bool


def list_items_to_do(scenario: Scenario, own: RobotLedger, begin: int) -> Iterator[ItemToDo]:
    """Yield the stops of a route that are not finished, and the charges that have not ended.

    A charge without an end goes on until the robot has more to do: it is none of them. Visits of
    steps count from ``begin``; of their times only the order counts.

    Parameters
    ----------
    scenario
        The problem.
    own
        The robot.
    begin
        The number of a visit.
    """
    for visit in range(begin, own.route.end):
        rows = zip(own.route.get_jobs(visit), own.route.get_work(visit), strict=True)
        for item, ticks in rows:
            stop, step = find_stop(item), find_charge_step(item)
            if item in own.finished or (stop is None and step != "end"):
                continue
            yield ItemToDo(
                step=PlannedStep(
                    visit=visit - begin,
                    vertex=VertexId(scenario.roadmap.get_vertex(own.route.get_place(visit))),
                    begin=Tick(0),
                    end=Tick(0),
                    job=stop and stop[0],
                    stop=stop and stop[1],
                    least=Tick(0 if stop else ticks),
                ),
                is_sent=own.is_sent(item.removesuffix(" end")),
            )


def list_vertices(roadmap: Roadmap, own: RobotLedger, begin: int) -> list[VertexId]:
    """Return the vertices of a route from a visit on; chains may begin before it.

    Parameters
    ----------
    roadmap
        The map.
    own
        The robot.
    begin
        The number of a visit that is kept.
    """
    vertices = roadmap.unfold_route(list(map(roadmap.get_vertex, own.route.places)))
    return vertices[begin - own.route.first :]


def put_at_stop(roadmap: Roadmap, own: RobotLedger) -> RobotLedger:
    """Return a robot as if it had arrived no further than where it last might stop.

    Parameters
    ----------
    roadmap
        The map.
    own
        The robot.
    """
    if roadmap.passing is None:
        return own
    return begin_at_stop(own, lambda place: not roadmap.is_passed(roadmap.get_vertex(place)))


def mirror_floor(
    scenario: Scenario,
    ledger: Ledger,
    reports: FloorReports,
    *,
    now: int,
    unable: Collection[int],
    spare: Fraction = Fraction(0),
) -> SimulatedFloor:
    """Return a simulated floor with the robots of a control, as they are expected to be now.

    Parameters
    ----------
    scenario
        The fleet, with its closures and without jobs.
    ledger
        The state that the journal describes.
    reports
        What robots have reported.
    now
        The tick.
    unable
        Robots that do not go on.
    spare
        The share of a battery by which each is fuller than measured.
    """
    floor = SimulatedFloor(scenario, DelayDraws(DelayModel.none(len(scenario.robots)), 0, 0))
    for robot, own in enumerate(ledger.robots):
        if own.is_off:
            floor.robots[robot] = _put_away(floor.robots[robot])
            continue
        mirror = _Mirror(floor, robot, ledger, reports, now)
        floor.robots[robot] = mirrored = mirror.make_robot()
        mirrored.lost = now if robot in unable else None
        battery = floor.states[robot].battery
        if battery is not None:
            soc = min(Fraction(1), reports.get_soc(robot) + spare)
            mirrored.soc += int(soc * battery.full)
        mirrored.since, mirrored.counted = max(now, reports.ready[robot]), now
    afters = (name for own in ledger.pool.jobs.values() for name in own.job.after)
    floor.ends = {name: 0 for name in afters if name in ledger.pool.left}
    return floor


@dataclass(frozen=True, slots=True, kw_only=True)
class ForecastRobot:
    """The forecast of a robot that keeps a part of its route.

    Attributes
    ----------
    free
        When it is free at the end of the kept part [ticks], the takeover at the earliest; None if
        it is not expected to get there.
    soc
        Its state of charge then, or where it comes to stand, from 0 to 1.
    heading
        As `RobotState.heading`, at the same place [degrees].
    times
        When it enters the visits of the old route behind the kept part [ticks]; None if it does not
        come to the end of it.
    """

    free: Tick | None
    soc: Fraction
    heading: Fraction | None
    times: tuple[int, ...] | None


def forecast_kept_parts(
    floor: SimulatedFloor, caps: Mapping[int, tuple[int, int]], now: int, takeover: int
) -> tuple[dict[int, ForecastRobot], dict[str, int]]:
    """Return what is expected of robots that keep parts, and when jobs end in these [ticks].

    Parameters
    ----------
    floor
        The floor as it is expected to be now, by `mirror_floor`.
    caps
        For each robot on the floor the number of its last visit that is kept, and how many of the
        works and charges there are.
    now, takeover
        When the round begins, and when robots may begin more [ticks].
    """
    for robot, cap in caps.items():
        floor.robots[robot].cap = cap
    ahead = floor.fork(now)
    ahead.advance(NEVER - 1)
    ends, at_ends = dict(ahead.ends), dict[int, tuple[Tick | None, Fraction, Fraction | None]]()
    for robot, (last, _) in caps.items():
        own, (free, soc) = ahead.robots[robot], forecast_free(ahead, robot, takeover)
        is_there = own.first == last and own.lost is None
        heading = find_heading_on_site(own.heading, ahead.roadmap)
        at_ends[robot] = free if is_there else None, soc, heading
        own.cap, own.since = None, max(own.since, takeover)
    ahead.advance(NEVER - 1)
    expected = {}
    for robot, (is_free, soc, heading) in at_ends.items():
        own, last = ahead.robots[robot], caps[robot][0]
        comes = is_free is not None and len(own.visits) == 1
        times = tuple(own.enters[number] for number in range(last + 1, own.first + 1))
        expected[robot] = ForecastRobot(
            free=is_free, soc=soc, heading=heading, times=times if comes else None
        )
    return expected, ends


def _put_away(own: FloorRobot) -> FloorRobot:
    """Return a robot that is off the floor."""
    return FloorRobot(visits=own.visits, first=GONE, recent=own.recent, lost=0)


class _Mirror:
    """A robot of a control as one of a simulated floor."""

    def __init__(
        self, floor: SimulatedFloor, robot: int, ledger: Ledger, reports: FloorReports, now: int
    ) -> None:
        self._floor, self._robot, self._ledger = floor, robot, ledger
        own = ledger.robots[robot]
        self._own, self._now, self._reports = put_at_stop(floor.roadmap, own), now, reports
        self._since = reports.find_since(robot, own, now)
        known = ledger.pool.jobs
        items = list_items_to_do(floor.scenario, self._own, self._own.arrived)
        self._items = [
            item
            for item in items
            if (job := item.step.job) is None or (job in known and job not in ledger.outdated)
        ]

    def make_robot(self) -> FloorRobot:
        """Return the robot: it works, drives to its next visit, or stands."""
        own, visits, since = self._own, self._list_visits(), self._since
        begun = [item for item in self._items if item.step.visit == 0 and item.is_sent]
        robot = FloorRobot(
            visits=deque(visits),
            first=own.arrived,
            free=since,
            expected=since,
            recent=deque([(visits[0].vertex, since)]),
            enters={own.arrived: since},
            heading=self._floor.convert_heading(self._find_heading()),
            charging=self._now if self._is_charging() else None,
        )
        if begun:
            ticks = sum(step.ticks for step in visits[0].steps[: len(begun)])
            robot.n_begun, robot.has_worked = len(begun), True
            robot.free = robot.expected = self._expect(since + ticks)
        elif not visits[0].steps and own.released > own.arrived:
            self._drive(robot, visits[1])
        return robot

    def _drive(self, robot: FloorRobot, visit: VisitToCome) -> None:
        """Let a robot be on its way to its next visit."""
        end = self._expect(self._since + visit.turn + visit.drive)
        robot.visits.popleft()
        robot.first, robot.free, robot.expected = robot.first + 1, end, end
        robot.recent.append((visit.vertex, end))
        robot.enters[robot.first] = end
        robot.charging = None
        robot.heading = self._floor.find_heading(visit.edge) or robot.heading
        battery = self._floor.states[self._robot].battery
        if battery is not None:
            roadmap = self._floor.roadmap
            robot.soc -= battery.drive[int(roadmap.class_of_edge[visit.edge])]

    def _expect(self, end: int) -> int:
        """Return when an action is expected to end: what is overdue lasts as long again."""
        return end if end > self._now else 2 * self._now - end + 1

    def _list_visits(self) -> list[VisitToCome]:
        """Return the visits from that on at which the robot has arrived."""
        own, vertices = self._own, list_vertices(self._floor.roadmap, self._own, self._own.arrived)
        track = Track.of(vertices, own.route.enter[own.arrived - own.route.first :])
        rows = list_coming_visits(self._floor, self._robot, track, self._find_heading(), 0)
        steps = defaultdict[int, list[StepToDo]](list)
        for item in self._items:
            step = make_step_to_do(self._floor.scenario, item.step, self._ledger.pool.jobs)
            steps[item.step.visit].append(step)
        first = VisitToCome(vertex=int(vertices[0]), steps=tuple(steps.get(0, ())))
        graph, number = self._ledger.graph, own.arrived
        return [
            first,
            *(
                VisitToCome(
                    *row,
                    steps=tuple(steps.get(k, ())),
                    waits=graph.waits(Part(self._robot, number + k)),
                )
                for k, row in enumerate(rows, 1)
            ),
        ]

    def _find_heading(self) -> Fraction | None:
        """Return the heading of the edge that the robot has come along, else as it reports."""
        own, roadmap = self._own, self._floor.roadmap
        if own.arrived > own.route.first:
            tail, head = list_vertices(roadmap, own, own.arrived - 1)[:2]
            edges = roadmap.list_edges(tail, head)
            heading = self._floor.find_heading(int(edges[0])) if edges else None
            if heading is not None:
                return find_heading_on_site(heading, roadmap)
        return self._reports.headings.get(self._robot)

    def _is_charging(self) -> bool:
        """Return whether a charge has begun where the robot stands, and has not ended."""
        items = self._own.route.get_jobs(self._own.arrived)
        charges = [item for item in items if find_charge_step(item) == "begin"]
        finished = self._own.finished
        return any(item in finished and f"{item} end" not in finished for item in charges)
