"""A simulated robot whose steps take time: as long as planned, and longer by delays of a seed."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import cache, lru_cache

import numpy as np

from rightofway.control.endpoints import Letter, RobotEnd
from rightofway.control.laps import LapsToDrive
from rightofway.control.robot_ledger import RobotLedger
from rightofway.control.routes import RouteToDrive, make_routes_to_drive
from rightofway.control.work_items import find_charge_step
from rightofway.execution import replay
from rightofway.model import ExecutionTrace, Plan, Scenario, Tick
from rightofway.model.route import compute_turns_along

__all__ = ["Durations", "TimedRobot"]


class Durations:
    """Durations of actions of robots: as planned, and longer by delays of a seed.

    Each time that robots come to the end of the plan, the next run of the seed has the delays.
    """

    def __init__(
        self, plan: Plan, delays: str | Iterable[str], seed: int, laps: LapsToDrive | None
    ) -> None:
        # Who waits for a closure is decided as robots drive; it makes nothing take longer.
        scenario, clock = plan.scenario, plan.scenario.problem.clock
        plan = replace(plan, scenario=replace(scenario, closures=(), clock=clock))
        self._plan, self._delays, self._seed, self._laps = plan, delays, seed, laps
        self._routes, self._roadmap = make_routes_to_drive(plan), plan.scenario.roadmap
        self.round = lru_cache(maxsize=4)(self._round)
        self._calm = replay(plan, (), 0, seed)  # without delays
        self._class_of_edge = cache(self._find_class)

    def _round(self, number: int) -> ExecutionTrace:
        return replay(self._plan, self._delays, number, self._seed)

    def stay(self, robot: int, own: RobotLedger, visit: int) -> int:
        """Return how long a robot works and turns in a visit [ticks].

        How long it charges is decided by the control.
        """
        number, planned = self._find_planned(robot, visit)
        if self._plan.scenario.jobs is not None:
            late = self.round(number).dwell[robot][planned] - self._calm.dwell[robot][planned]
            return self._count_stay(robot, own.route, visit) + max(int(late), 0)
        sample, lap = self.round(number).dwell[robot], self._routes[robot]
        more = int(sample[planned]) - sum(lap.get_work(planned))
        if planned == lap.end - 1 and self._laps:  # it goes on, and turns for that
            more += self._plan.scenario.problem.itineraries[robot].stages[-1].turn
        return sum(own.route.get_work(visit)) + max(more, 0)

    def _count_stay(self, robot: int, route: RouteToDrive, visit: int) -> int:
        """Return how long the work of a tour in a visit and the turns after it last [ticks]."""
        items = route.get_jobs(visit)
        rows = zip(items, route.get_work(visit), strict=True)
        work = sum(ticks for item, ticks in rows if find_charge_step(item) is None)
        places = route.stretch(visit - 1, visit + 2)
        path = np.array(list(map(self._roadmap.get_vertex, places)), np.int32)
        itinerary, index = self._plan.scenario.problem.itineraries[robot], int(visit > route.first)
        turn = int(compute_turns_along(self._roadmap, itinerary, path)[index])
        bound = self._plan.scenario.problem.work
        return work + turn + (bound.robots[robot].turn if bound and items else 0)

    def drive(self, robot: int, own: RobotLedger, visit: int) -> int:
        """Return how long a robot drives into a visit [ticks]."""
        number, planned = self._find_planned(robot, visit)
        sample, lap = self.round(number).drive[robot], self._routes[robot]
        more = int(sample[planned]) - self._measure_drive(robot, lap, planned) if planned else 0
        return self._measure_drive(robot, own.route, visit) + max(more, 0)

    def _measure_drive(self, robot: int, route: RouteToDrive, visit: int) -> int:
        """Return how long the drive into a visit lasts without delays [ticks]."""
        edge_class = self._class_of_edge(route.get_place(visit - 1), route.get_place(visit))
        return self._plan.scenario.problem.itineraries[robot].edge_ticks[edge_class]

    def _find_class(self, tail: str, head: str) -> int:
        """Return the class of the edge between two places."""
        roadmap = self._roadmap
        edges = roadmap.list_edges(roadmap.get_vertex(tail), roadmap.get_vertex(head))
        assert edges, "a control has its routes from a dispatcher, which knows the map"
        return int(roadmap.class_of_edge[edges[0]])

    def _find_planned(self, robot: int, visit: int) -> tuple[int, int]:
        """Return the run that has the delays of a visit, and a visit of the plan."""
        if self._laps:
            return self._laps.find_planned_visit(robot, visit)
        return divmod(visit, self._routes[robot].end)


class TimedRobot:
    """A simulated robot whose steps take time, and whose battery falls and rises.

    Parameters
    ----------
    end
        The robot with its messages.
    scenario
        The scenario of the plan; lengths without a unit are metres.
    stay, drive_into
        How long work and turning of a visit take, and the drive into it [ticks].
    stoppages
        When it stands still, in order: first tick and length [ticks].
    times_kept
        How many visits have their times kept; None for all.
    """

    def __init__(
        self,
        end: RobotEnd,
        scenario: Scenario,
        stay: Callable[[int], int],
        drive_into: Callable[[int], int],
        *,
        stoppages: tuple[tuple[Tick, Tick | None], ...],
        times_kept: int | None,
    ) -> None:
        self.end, self._stay, self._drive_into, self.stoppages = end, stay, drive_into, stoppages
        self.visit = 0  # the number of the last one
        self.enter = deque([0], times_kept)  # when each visit began
        self.dwell = deque([stay(0)], times_kept)
        self.drive = deque([0], times_kept)
        self.since = 0  # when its last step ended
        self.is_busy = False
        self._left = self.dwell[0]  # what is left of work and turning of this visit
        self._tick = float(scenario.problem.clock.tick)
        self._metre = float(scenario.units.metres or 1)
        self._measured = 0  # when the battery was measured last

    def report_state(self, now: int) -> Letter:
        """Return its state with the charge of its battery, as it is sent."""
        self._measure(now)
        return self.end.report_state()

    def _measure(self, now: int) -> None:
        """Let the battery fall or rise until now."""
        robot, battery = self.end.robot, self.end.battery
        if battery is not None:
            works = self.is_busy and robot.next_step == "end work"
            passed = self._tick * (now - self._measured)
            battery.pass_time(passed, is_charging=robot.is_charging, works=works)
        self._measured = now

    def begin_step(self, now: int) -> int | None:
        """Begin the next step, if there is one; return when it ends."""
        self._measure(now)
        match self.end.robot.next_step:
            case None:
                return None
            case "arrive":
                lasts = self._drive_into(self.visit + 1)
                self.drive.append(lasts)
            case "begin work":
                lasts = 0
            case "end work" if self.end.robot.next_action in self.end.robot.charging:
                lasts = 0
            case "end work" | "begin to drive":
                lasts, self._left = self._left, 0
        self.is_busy = True
        end = now + lasts
        for first, length in self.stoppages:
            assert length is not None, "a demo has no robot that breaks down permanently"
            if first < end and now < first + length:  # the rest of the step comes after it
                end += first + length - max(first, now)
        return end

    def end_step(self, now: int) -> None:
        """End the step."""
        self._measure(now)
        if self.end.robot.next_step == "arrive":
            if self.end.battery is not None:
                lane = self.end.lanes[self.end.robot.place, self.end.robot.ahead[0].place]
                self.end.battery.drive(lane.length / self._metre)
            self.visit += 1
            self._left = self._stay(self.visit)
            self.enter.append(now)
            self.dwell.append(self._left)
        self.end.robot.step()
        self.is_busy, self.since = False, now
