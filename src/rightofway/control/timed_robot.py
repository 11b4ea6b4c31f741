"""A simulated robot whose steps take time: as long as planned, and longer by delays of a seed."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import cache, lru_cache

from rightofway.control.endpoints import RobotEnd
from rightofway.control.laps import LapsToDrive
from rightofway.control.robot_ledger import RobotLedger
from rightofway.control.routes import RouteToDrive, make_routes_to_drive
from rightofway.execution import replay
from rightofway.model import ExecutionTrace, Plan, Tick

__all__ = ["Durations", "TimedRobot"]


class Durations:
    """How long actions of robots take: as planned, and longer by delays of a seed.

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
        self._class_of_edge = cache(self._find_class)

    def _round(self, number: int) -> ExecutionTrace:
        return replay(self._plan, self._delays, number, self._seed)

    def stay(self, robot: int, own: RobotLedger, visit: int) -> int:
        """Return how long a robot works and turns in a visit [ticks]."""
        number, planned = self._find_planned(robot, visit)
        sample, lap = self.round(number).dwell[robot], self._routes[robot]
        more = int(sample[planned]) - sum(lap.get_work(planned))
        if planned == lap.end - 1 and self._laps:  # it goes on, and turns for that
            more += self._plan.scenario.problem.itineraries[robot].stages[-1].turn
        return sum(own.route.get_work(visit)) + max(more, 0)

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
    """A simulated robot whose steps take time.

    Parameters
    ----------
    end
        The robot with its messages.
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
        stay: Callable[[int], int],
        drive_into: Callable[[int], int],
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

    def begin_step(self, now: int) -> int | None:
        """Begin the next step, if there is one; return when it ends."""
        match self.end.robot.next_step:
            case None:
                return None
            case "arrive":
                lasts = self._drive_into(self.visit + 1)
                self.drive.append(lasts)
            case "begin work":
                lasts = 0
            case "end work" | "begin to drive":
                lasts, self._left = self._left, 0
        self.is_busy = True
        end = now + lasts
        for first, length in self.stoppages:
            assert length is not None, "a demo has no robot that breaks down for ever"
            if first < end and now < first + length:  # the rest of the step comes after it
                end += first + length - max(first, now)
        return end

    def end_step(self, now: int) -> None:
        """End the step."""
        if self.end.robot.next_step == "arrive":
            self.visit += 1
            self._left = self._stay(self.visit)
            self.enter.append(now)
            self.dwell.append(self._left)
        self.end.robot.step()
        self.is_busy, self.since = False, now
