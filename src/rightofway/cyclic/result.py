"""Results of repeated laps by group: pattern or deadlock, laps, waits, bottleneck."""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from rightofway.cyclic.bottleneck import Bottleneck, find_bottleneck
from rightofway.cyclic.pattern import History, Pattern
from rightofway.cyclic.route import GroupContext
from rightofway.cyclic.warmup import MeasuredLaps, measure
from rightofway.facts import Fact
from rightofway.model import NEVER, Scenario, Tick, Track
from rightofway.precedence import CyclicSchedule, TimedEventGraph, find_rotation
from rightofway.site import VertexId

BaselineEnds = Literal["repeats", "starves", "deadlock", "open"]

Enters = Callable[[int, range], NDArray[np.int64]]
"""Function from a robot and consecutive visits to their enters [ticks]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class LapWait:
    """A robot that waits for another one.

    Attributes
    ----------
    vertex
        The vertex that the robot waits to enter.
    waits, for_robot
        The waiting robot, and the robot that it waits for; numbers in the scenario.
    tick
        The enter without this wait [ticks]; in a pattern, as an offset in the period.
    ticks
        The duration of the wait [ticks].
    beside
        Where the other robot was, if not at that vertex: only where robots have a size.
    """

    vertex: VertexId
    waits: int
    for_robot: int
    tick: Tick
    ticks: Tick
    beside: VertexId | None = None

    @property
    def pair(self) -> tuple[int, int]:
        """The two robots, in the order of the scenario."""
        return min(self.waits, self.for_robot), max(self.waits, self.for_robot)


@dataclass(frozen=True, slots=True, kw_only=True)
class BaselineComparison:
    """Comparison of a chosen timetable with its baseline, first come first served.

    Attributes
    ----------
    throughput
        The value of the timetable's laps per tick; without weights, laps per tick.
    fairness
        The least ratio of laps made to laps possible alone, over all robots; 0 to 1.
    baseline_ends
        End of the baseline on the usual routes: as in `GroupResult`, or ``starves`` if its pattern
        repeats while a robot is permanently stuck.
    baseline
        The value of the baseline's laps per tick, in its pattern or else in the simulated time; 0
        in a deadlock.
    """

    throughput: Fraction
    fairness: Fraction
    baseline_ends: BaselineEnds
    baseline: Fraction


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class GroupResult:
    """The result of a group of robots that share vertices.

    Attributes
    ----------
    context
        The robots and their cyclic routes.
    ends
        ``repeats``: the pattern repeats for ever. ``deadlock``: robots wait for each other
        permanently. ``open``: time ran out before either was known.
    history
        For each robot, the enters of its visits from visit 0 on [ticks].
    pattern
        The pattern; None unless ``ends`` is ``repeats``.
    why
        For a deadlock, the robots that wait for each other; for an open end, the exceeded limit.
    comparison
        Comparison with first come first served; None for a simulated rule.
    """

    context: GroupContext
    ends: Literal["repeats", "deadlock", "open"]
    history: tuple[Sequence[int], ...]
    pattern: Pattern | None = None
    why: Fact | None = None
    comparison: BaselineComparison | None = None

    @property
    def robots(self) -> tuple[int, ...]:
        """The numbers of the robots in the scenario."""
        return self.context.robots

    @property
    def timetable(self) -> CyclicSchedule | None:
        """One period of the pattern; None without one, or if a robot is permanently stuck."""
        return self.pattern.make_timetable(self.context) if self.pattern else None

    def count_laps(self) -> tuple[int, ...]:
        """Return the number of laps that each robot completed in the history."""
        rows = zip(self.context.routes, self.history, strict=True)
        return tuple((len(past) - 1) // len(route) for route, past in rows)

    def compute_mean_laps(self) -> tuple[Fraction | None, ...]:
        """Return the mean lap time of each robot [ticks]; None if it makes no lap.

        Exact if a pattern repeats; otherwise as `measure_laps`.
        """
        if self.pattern:
            period = self.pattern.period
            return tuple(Fraction(period, n) if n else None for n in self.pattern.counts)
        return self.measure_laps().means

    def compute_rate(self, weights: Sequence[Fraction] | None = None) -> Fraction:
        """Return the number of laps per tick of all robots, each multiplied by its weight.

        Exact if a pattern repeats. A measured rate has twelve digits: exact sums of a thousand
        fractions have thousands of digits.
        """
        means = zip(
            weights or [Fraction(1)] * len(self.context), self.compute_mean_laps(), strict=True
        )
        rates = [weight / mean for weight, mean in means if mean]
        if self.pattern:
            return sum(rates, Fraction(0))
        return Fraction(f"{math.fsum(map(float, rates)):.12g}")

    def measure_laps(self) -> MeasuredLaps:
        """Return the mean lap times of the history, without its warm-up."""
        return measure(self.context.routes, self.history)

    def compute_waiting_shares(self) -> tuple[Fraction | None, ...]:
        """Return the share of its time that each robot waits; None if it makes no lap."""
        return tuple(
            None if mean is None else max(1 - lap.duration / mean, Fraction(0))
            for lap, mean in zip(self.context.laps, self.compute_mean_laps(), strict=True)
        )

    def waits(self) -> tuple[LapWait, ...]:
        """Return the waits of each period, by offset from `Pattern.begins`; none without one."""
        return waits_in_period(self.context, self.pattern) if self.pattern else ()

    def list_first_waits(self) -> tuple[LapWait, ...]:
        """Return the waits in the first lap of each robot, by tick."""
        return waits_in_first_laps(self.context, self.history)

    def has_rotation(self) -> bool:
        """Return whether robots rotate where the rules forbid it."""
        if not self.context.might_rotate:
            return False
        tracks = []
        for index, (past, lap) in enumerate(zip(self.history, self.context.laps, strict=True)):
            enter = np.asarray(past, np.int64)
            if self.pattern:
                period = self.pattern.counts[index] * len(lap)
                enter = self.pattern.enters(index, range(len(past) + period))
            vertices = np.resize(np.array(lap.vertices, np.int32), len(enter))
            tracks.append(Track(vertices=vertices, enter=enter))
        return bool(find_rotation(self.context.scenario.problem, tracks))

    def build_graph(self) -> TimedEventGraph | None:
        """Return the timed event graph of `timetable`; None without one."""
        timetable = self.timetable
        return None if timetable is None else self.context.build_graph(timetable)

    def find_bottleneck(self) -> Bottleneck | None:
        """Return the critical circuit of `build_graph`; None without one."""
        graph = self.build_graph()
        return None if graph is None else find_bottleneck(graph)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class CyclicResult:
    """The result of a fleet that repeats its laps.

    Attributes
    ----------
    scenario
        The problem.
    rule, routes
        The lap rule, and the choice of round trips.
    groups
        Groups of robots without shared vertices, ordered by their first robots.
    """

    scenario: Scenario
    rule: str
    routes: str
    groups: tuple[GroupResult, ...]

    def compute_throughput(self) -> Fraction:
        """Return the laps of all robots per time unit of the scenario."""
        ticks = 1 / self.scenario.problem.clock.tick
        return sum((group.compute_rate() * ticks for group in self.groups), Fraction(0))


def waits_in_first_laps(context: GroupContext, history: History) -> tuple[LapWait, ...]:
    """Return the waits in the first lap of each robot, by tick."""
    first = [
        range(min(len(past) - 1, len(route)))
        for past, route in zip(history, context.routes, strict=True)
    ]
    until = max(past[visits.stop] for past, visits in zip(history, first, strict=True))
    seen = [range(min(len(past) - 1, bisect_right(past, until))) for past in history]
    return _list_waits(
        context,
        lambda robot, visits: np.array(history[robot][visits.start : visits.stop], np.int64),
        seen,
        first,
    )


def waits_in_period(context: GroupContext, pattern: Pattern) -> tuple[LapWait, ...]:
    """Return the waits of each period, by offset from `Pattern.begins`.

    A wait for a decision that the rule reversed later is a wait for no robot, and is left out.
    """
    firsts = (pattern.list_visits(robot) for robot in range(len(context)))
    # The second period: without first departures from home, which have no turn.
    visits = [range(first.stop, first.stop + len(first)) for first in firsts]
    when = {"begins": pattern.begins, "period": pattern.period}
    return _list_waits(context, pattern.enters, visits, visits, **when)


def _list_waits(
    context: GroupContext,
    enters: Enters,
    seen: Sequence[range],
    asked: Sequence[range],
    *,
    begins: int = 0,
    period: int = NEVER,
) -> tuple[LapWait, ...]:
    """Return the waits before visits in ``asked``, for robots with visits in ``seen``."""
    rules, late = context.booking_rules, list[tuple[int, int, int, int, int]]()
    for robot, visits in enumerate(asked):
        if not visits:
            continue
        route, with_next = context.routes[robot], range(visits.start, visits.stop + 1)
        enter = enters(robot, with_next)
        could = enter[:-1] + np.diff(route.compute_undelayed(with_next))
        for index in np.flatnonzero(could < enter[1:]).tolist():
            visit, at = visits[index] + 1, int(enter[index + 1])
            booked = rules.start(at, int(route.drive(visit))) % period
            late.append((robot, visit, int(could[index]), at, booked))
    ticks = np.array(sorted({booked for *_, booked in late}), np.int64)
    freed_by: dict[tuple[int, int], tuple[int, VertexId]] = {}
    for robot, visits in enumerate(seen):
        if visits:
            leave = enters(robot, range(visits.start + 1, visits.stop + 1))
            free = rules.end(leave) % period
            for index in np.flatnonzero(np.isin(free, ticks)).tolist():
                vertex = context.routes[robot].get_vertex(visits[index])
                for row in context.list_booked(robot, visits[index]):
                    freed_by[row, int(free[index])] = robot, vertex
    robots, waits = context.robots, []
    for robot, visit, soonest, at, booked in late:
        rows = ((row, booked) for row in context.list_excluding(robot, visit))
        freed = (freed_by[row] for row in rows if row in freed_by)
        by, place = next((freeing for freeing in freed if freeing[0] != robot), (None, None))
        vertex = context.routes[robot].get_vertex(visit)
        if by is not None:  # else a wait for a planned time, or for no robot
            wait = LapWait(
                vertex=vertex,
                waits=robots[robot],
                for_robot=robots[by],
                tick=Tick((soonest - begins) % period),
                ticks=Tick(at - soonest),
                beside=None if place == vertex else place,
            )
            waits.append(wait)
    return tuple(sorted(waits, key=lambda freeing: (freeing.tick, freeing.waits)))
