"""The problem of choosing a group's timetable: candidate laps, values, fairness."""

from __future__ import annotations

import random
from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from typing import Self

import numpy as np
from numpy.typing import NDArray

from rightofway.cyclic.route import GroupContext
from rightofway.cyclic.startup import find_start
from rightofway.model import Lap, Tick
from rightofway.planners import Deadline
from rightofway.precedence import CyclicSchedule, TimedEventGraph
from rightofway.search import PeriodicBookings, RoundTrip, RowsOfLaps

EARLIEST = 1.2e-6
"""The time that the earliest timetable of given orders takes for each visit [s]."""


@dataclass(frozen=True, slots=True, eq=False)
class RobotCycle:
    """The visits of one robot in a period."""

    lap: Lap
    count: int  # number of laps
    enter: NDArray[np.int64]  # the enters of its visits, shape (count * len(lap),) [ticks]


@dataclass(frozen=True, slots=True, eq=False)
class Candidate:
    """A timetable of a group, with its exact cycle time or a longer period [ticks]."""

    timetable: CyclicSchedule
    cycle_time: Fraction

    @classmethod
    def as_it_is(cls, timetable: CyclicSchedule) -> Self:
        """Return a timetable with its own period as cycle time."""
        return cls(timetable, Fraction(int(timetable.period)))

    @property
    def period(self) -> int:
        """The least whole period [ticks]."""
        return -(-self.cycle_time.numerator // self.cycle_time.denominator)

    @property
    def n_visits(self) -> int:
        """The number of visits of all robots in a period."""
        return sum(map(len, self.timetable.enter))


@dataclass(frozen=True, kw_only=True)
class CyclicProblem:
    """The problem of one group, with values, fairness, deadline and random numbers."""

    context: GroupContext  # the robots on their usual routes
    ways: tuple[tuple[Lap, ...], ...]  # candidate laps of each robot, the usual lap first
    round_trips: tuple[RoundTrip, ...]  # stages of each lap; empty: no search for new laps
    forbidden: frozenset[int]  # rows (for points: vertices) that other groups exclude
    weights: tuple[Fraction, ...]  # the value of a lap of each robot, above 0
    least_fairness: Fraction  # the least ratio of laps made to laps possible alone
    deadline: Deadline
    draw: random.Random

    def __len__(self) -> int:
        return len(self.ways)

    @cached_property
    def alone(self) -> tuple[Tick, ...]:
        """The duration of each robot's shortest lap without waiting [ticks]."""
        return tuple(min(lap.duration for lap in ways) for ways in self.ways)

    @cached_property
    def bound(self) -> Fraction:
        """An upper bound on `value`: no robot waits."""
        alone = zip(self.weights, self.alone, strict=True)
        return sum((weight / ticks for weight, ticks in alone), Fraction(0))

    def shorten(self, share: float) -> Self:
        """Return the same problem with a share of the time left."""
        return replace(self, deadline=self.deadline.shorten(share))

    def has_time_for(self, candidate: Candidate) -> bool:
        """Tell whether there is time to book a timetable, and to compute it once more."""
        left = self.deadline.measure_seconds_left()
        return left is None or left > 2 * EARLIEST * candidate.n_visits

    @property
    def is_out_of_time(self) -> bool:
        """Whether the deadline has passed."""
        return self.deadline.measure_seconds_left() == 0

    def add_ways(self, laps: Sequence[Lap]) -> Self:
        """Return the same problem with one more candidate lap for each robot."""
        ways = zip(self.ways, laps, strict=True)
        return replace(self, ways=tuple(tuple(dict.fromkeys((*own, lap))) for own, lap in ways))

    def compute_worth(self, counts: Sequence[int]) -> Fraction:
        """Return the value of all laps of a period."""
        rows = zip(self.weights, counts, strict=True)
        return sum((weight * count for weight, count in rows), Fraction(0))

    def compute_value(self, candidate: Candidate) -> Fraction:
        """Return the value of laps per tick: the objective to be maximized."""
        return self.compute_worth(candidate.timetable.counts) / candidate.cycle_time

    def compute_fairness(self, counts: Sequence[int], period: Fraction | int) -> Fraction:
        """Return the least ratio of laps made to laps possible alone, over all robots."""
        rows = zip(counts, self.alone, strict=True)
        return min(Fraction(count * alone) / period for count, alone in rows)

    def is_fair(self, counts: Sequence[int], period: Fraction | int) -> bool:
        """Tell whether every robot reaches the least fairness."""
        return self.compute_fairness(counts, period) >= self.least_fairness

    def accepts(self, candidate: Candidate) -> bool:
        """Tell whether a candidate is fair, and robots that wait at home can begin with it.

        Nor may it have a rotation that the rules forbid.
        """
        return (
            self.is_fair(candidate.timetable.counts, candidate.cycle_time)
            and not self.context.has_rotation(candidate.timetable)
            and find_start(self.context.scenario, candidate.timetable) is not None
        )

    def empty_bookings(self, period: int | None) -> PeriodicBookings:
        """Return empty bookings; without repetition if the period is None."""
        context, roadmap = self.context, self.context.scenario.roadmap
        resources = context.scenario.problem.resources
        rows = None
        if not resources.are_points:
            rows = RowsOfLaps(roadmap=roadmap, resources=resources, robots=context.robots)
        return PeriodicBookings(
            roadmap.n_vertices,
            None if period is None else Tick(period),
            rules=context.booking_rules,
            rows=rows,
        )

    def build_graph(self, timetable: CyclicSchedule) -> TimedEventGraph:
        """Return the timed event graph of a timetable under the rules of the scenario."""
        return self.context.build_graph(timetable)

    def join_cycles(self, cycles: Sequence[RobotCycle], period: int) -> CyclicSchedule:
        """Join the cycles of all robots to a timetable."""
        return CyclicSchedule(
            robots=self.context.robots,
            laps=tuple(cycle.lap for cycle in cycles),
            counts=tuple(cycle.count for cycle in cycles),
            period=Tick(period),
            enter=tuple(cycle.enter for cycle in cycles),
        )

    def make_candidate(self, timetable: CyclicSchedule) -> Candidate:
        """Return a candidate of a conflict-free timetable, with the cycle time of its orders."""
        return Candidate(timetable, self.build_graph(timetable).find_critical_circuit().cycle_time)

    def make_candidate_of_orders(self, timetable: CyclicSchedule) -> Candidate | None:
        """Return a candidate of the orders at the vertices of a timetable, ignoring its times.

        None if these orders cause a deadlock or a swap.
        """
        graph = self.build_graph(timetable)
        circuit = None if graph.has_swaps() else graph.find_critical_circuit_if_live()
        return None if circuit is None else Candidate(timetable, circuit.cycle_time)

    def book(self, candidate: Candidate) -> tuple[PeriodicBookings, list[RobotCycle]]:
        """Return the earliest timetable of a candidate's orders, as bookings and cycles."""
        timetable = self.build_graph(candidate.timetable).compute_earliest(
            Tick(candidate.period), cycle_time=candidate.cycle_time
        )
        rows = zip(timetable.laps, timetable.counts, timetable.enter, strict=True)
        cycles, bookings = [RobotCycle(*row) for row in rows], self.empty_bookings(candidate.period)
        for robot, cycle in enumerate(cycles):
            bookings.add(robot, cycle.lap, cycle.count, cycle.enter)
        return bookings, cycles

    def place(
        self,
        bookings: PeriodicBookings,
        robot: int,
        count: int,
        *,
        lap: Lap | None = None,
        tries: int = 3,
    ) -> RobotCycle | None:
        """Return a cycle of a robot among the bookings, from random phases; None if none fits.

        On ``lap`` if given; else on one of the robot's laps, or, if these do not fit, on a new lap.
        """
        ways = [lap] if lap else self.draw.sample(self.ways[robot], len(self.ways[robot]))
        for usual in ways:
            for _ in range(tries):
                placed = self._search(bookings, robot, usual, count)
                if placed is not None:
                    return placed
        if lap or not self.round_trips:
            return None
        phase = self.draw.randrange(int(bookings.period))
        seconds = self.deadline.measure_seconds_left()
        trip = self.round_trips[robot]
        way_found = bookings.find_route(trip, phase, robot=robot, time_limit=seconds)
        if way_found is None:
            return None
        new_lap, enter = way_found
        return (
            RobotCycle(new_lap, 1, enter)
            if count == 1
            else self._search(bookings, robot, new_lap, count)
        )

    def _search(
        self, bookings: PeriodicBookings, robot: int, lap: Lap, count: int
    ) -> RobotCycle | None:
        phase, seconds = (
            self.draw.randrange(int(bookings.period)),
            self.deadline.measure_seconds_left(),
        )
        enter = bookings.search(lap, count, phase, robot=robot, time_limit=seconds)
        return None if enter is None else RobotCycle(lap, count, enter)
