"""A group whose timetable is to be chosen: ways, what a lap is worth, what is fair."""

from __future__ import annotations

import random
from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from typing import Self

import numpy as np
from numpy.typing import NDArray

from rightofway.model import Lap, Tick
from rightofway.planners import Deadline
from rightofway.precedence import CyclicSchedule, TimedEventGraph
from rightofway.search import PeriodicBookings, RoundTrip

__all__ = ["Choice", "CyclicProblem", "Work"]


@dataclass(frozen=True, slots=True, eq=False)
class Work:
    """What one robot does in a period.

    Attributes
    ----------
    lap
        The way it takes.
    count
        How many laps it makes.
    enter
        When its visits begin [ticks]; int64.
    """

    lap: Lap
    count: int
    enter: NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class Choice:
    """A timetable of a group, and its exact cycle time [ticks]."""

    timetable: CyclicSchedule
    cycle_time: Fraction

    @property
    def period(self) -> int:
        """The least whole number of ticks that the period can be."""
        return -(-self.cycle_time.numerator // self.cycle_time.denominator)

    @property
    def visits(self) -> int:
        """How many visits all robots make in a period."""
        return sum(map(len, self.timetable.enter))


@dataclass(frozen=True, kw_only=True)
class CyclicProblem:
    """A group of robots and by which rules they are to work.

    Attributes
    ----------
    n_vertices
        How many vertices the roadmap has.
    headway, books_ahead
        What a visit books.
    robots
        The numbers of the robots.
    ways
        For each of them the laps to choose from; the first is the usual one.
    tours
        For each of them what it has to do, so that it can look for a way of its own; none where
        that would take too long.
    forbidden
        Vertices of other groups.
    weights
        What a lap of each is worth, above 0.
    least_fairness
        Which part of its laps alone every robot must make at least.
    deadline
        When to stop.
    draw
        The source of randomness.
    """

    n_vertices: int
    headway: Tick
    books_ahead: bool
    robots: tuple[int, ...]
    ways: tuple[tuple[Lap, ...], ...]
    tours: tuple[RoundTrip, ...]
    forbidden: frozenset[int]
    weights: tuple[Fraction, ...]
    least_fairness: Fraction
    deadline: Deadline
    draw: random.Random

    @cached_property
    def alone(self) -> tuple[Tick, ...]:
        """How long the shortest lap of each robot takes that nobody holds up [ticks]."""
        return tuple(min(lap.duration for lap in ways) for ways in self.ways)

    def until(self, deadline: Deadline) -> Self:
        """Return the same with another deadline."""
        return replace(self, deadline=deadline)

    def also(self, laps: Sequence[Lap]) -> Self:
        """Return the same with one more way for each robot."""
        ways = zip(self.ways, laps, strict=True)
        return replace(self, ways=tuple(tuple(dict.fromkeys((*own, lap))) for own, lap in ways))

    def has_ways(self, place: int) -> bool:
        """Tell whether a robot has more than one way to choose from."""
        return bool(self.tours) or len(self.ways[place]) > 1

    def worth(self, counts: Sequence[int]) -> Fraction:
        """Return what the laps of a period are worth."""
        return sum(
            (weight * count for weight, count in zip(self.weights, counts, strict=True)),
            Fraction(0),
        )

    @cached_property
    def bound(self) -> Fraction:
        """What no timetable exceeds: as if nobody ever waited for another."""
        alone = zip(self.weights, self.alone, strict=True)
        return sum((weight / ticks for weight, ticks in alone), Fraction(0))

    def value(self, choice: Choice) -> Fraction:
        """Return what the laps are worth per tick: what is to be made large."""
        return self.worth(choice.timetable.counts) / choice.cycle_time

    def fairness(self, counts: Sequence[int], period: Fraction | int) -> Fraction:
        """Return the least part of its laps alone that any robot makes."""
        return min(
            Fraction(count * alone) / period
            for count, alone in zip(counts, self.alone, strict=True)
        )

    def is_fair(self, counts: Sequence[int], period: Fraction | int) -> bool:
        """Tell whether nobody starves."""
        return self.fairness(counts, period) >= self.least_fairness

    def circle(self, period: int) -> PeriodicBookings:
        """Return an empty circle of that period."""
        return PeriodicBookings(
            self.n_vertices, Tick(period), headway=self.headway, books_ahead=self.books_ahead
        )

    def graph(self, timetable: CyclicSchedule) -> TimedEventGraph:
        """Return the event graph of a timetable under these rules."""
        return TimedEventGraph(timetable, headway=self.headway, books_ahead=self.books_ahead)

    def timetable(self, works: Sequence[Work], period: int) -> CyclicSchedule:
        """Join what all robots do to a timetable."""
        return CyclicSchedule(
            robots=self.robots,
            laps=tuple(work.lap for work in works),
            counts=tuple(work.count for work in works),
            period=Tick(period),
            enter=tuple(work.enter for work in works),
        )

    def on_circle(self, choice: Choice) -> tuple[PeriodicBookings, list[Work]]:
        """Return a circle as long as a timetable needs it, and what all robots do on it."""
        timetable = self.graph(choice.timetable).earliest(
            Tick(choice.period), cycle_time=choice.cycle_time
        )
        rows = zip(timetable.laps, timetable.counts, timetable.enter, strict=True)
        works, circle = [Work(*row) for row in rows], self.circle(choice.period)
        for place, work in enumerate(works):
            circle.add(place, work.lap, work.count, work.enter)
        return circle, works

    def tightened(self, timetable: CyclicSchedule) -> Choice:
        """Return the timetable with its cycle time: how short its orders let the period be."""
        return Choice(timetable, self.graph(timetable).critical_circuit().cycle_time)

    def closed(self, timetable: CyclicSchedule) -> Choice | None:
        """Return the same of a timetable of which only the orders are known to be meant.

        None if robots would wait for each other for ever in these orders, or swap.
        """
        graph = self.graph(timetable)
        if graph.has_swaps():
            return None
        try:
            return Choice(timetable, graph.critical_circuit().cycle_time)
        except ValueError:  # a circuit that takes time, but no period
            return None

    def place(
        self,
        circle: PeriodicBookings,
        place: int,
        count: int,
        *,
        lap: Lap | None = None,
        tries: int = 3,
    ) -> Work | None:
        """Return a way round the circle for a robot; None if none is found.

        On the lap that is given, or on one of its laps, and if there is no room on these, on any
        way at all.
        """
        ways = [lap] if lap else self.draw.sample(self.ways[place], len(self.ways[place]))
        for way in ways:
            for _ in range(tries):
                found = self._on(circle, way, count)
                if found is not None:
                    return found
        return None if lap else self.place_anywhere(circle, place, count)

    def place_anywhere(self, circle: PeriodicBookings, place: int, count: int) -> Work | None:
        """Return a way that is chosen for one lap among the bookings, and repeated for all."""
        if not self.tours:
            return None
        phase = self.draw.randrange(int(circle.period))
        seconds = self.deadline.seconds_left()
        found = circle.find_route(self.tours[place], phase, time_limit=seconds)
        if found is None:
            return None
        return Work(found[0], 1, found[1]) if count == 1 else self._on(circle, found[0], count)

    def _on(self, circle: PeriodicBookings, lap: Lap, count: int) -> Work | None:
        phase = self.draw.randrange(int(circle.period))
        enter = circle.search(lap, count, phase, time_limit=self.deadline.seconds_left())
        return None if enter is None else Work(lap, count, enter)
