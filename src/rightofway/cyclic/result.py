"""What a fleet that repeats its work does in the long run, group by group."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Literal

from rightofway.cyclic.bottleneck import Bottleneck, bottleneck_of
from rightofway.cyclic.pattern import Pattern
from rightofway.cyclic.route import CyclicRoute
from rightofway.cyclic.waits import Bookings, Conflict
from rightofway.cyclic.warmup import Measured, measure
from rightofway.model import Scenario
from rightofway.planners import planning_headway
from rightofway.precedence import CyclicSchedule, TimedEventGraph, timed_event_graph

__all__ = ["CyclicResult", "GroupRun"]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class GroupRun:
    """What a group of robots did that have to do with each other.

    Attributes
    ----------
    ends
        ``repeats``: for ever as in the pattern. ``deadlock``: it comes to a standstill. ``open``:
        time ran out before either was known.
    why
        For a deadlock, who waits for whom; for an open end, what was not enough.
    group
        The endless routes of its robots.
    history
        For each robot the ticks at which its visits began, from visit 0 on.
    pattern
        What repeats; None if nothing is known to.
    """

    ends: Literal["repeats", "deadlock", "open"]
    why: str
    group: tuple[CyclicRoute, ...]
    history: tuple[Sequence[int], ...]
    pattern: Pattern | None

    @property
    def robots(self) -> tuple[int, ...]:
        """The numbers of its robots in the scenario."""
        return tuple(endless.robot for endless in self.group)

    @property
    def timetable(self) -> CyclicSchedule | None:
        """What repeats, as a timetable; None if nothing does or a robot stands still for ever."""
        return self.pattern.timetable(self.group) if self.pattern else None

    def laps_made(self) -> tuple[int, ...]:
        """Return how many laps each robot completed while it was watched."""
        return tuple(
            (len(past) - 1) // len(endless.lap)
            for endless, past in zip(self.group, self.history, strict=True)
        )

    def mean_laps(self) -> tuple[Fraction | None, ...]:
        """Return how long a lap of each robot takes on average [ticks]; None if it makes none.

        In the long run if the group repeats itself, otherwise as `measured`.
        """
        if self.pattern:
            period = self.pattern.period
            return tuple(Fraction(period, n) if n else None for n in self.pattern.counts)
        return self.measured().means

    def rate(self, weights: Sequence[Fraction] | None = None) -> Fraction:
        """Return how many laps its robots complete per tick, each counted by its weight.

        Exact if the group repeats itself; what is measured has twelve digits, as an exact sum
        of a thousand fractions has thousands.
        """
        means = zip(weights or [Fraction(1)] * len(self.group), self.mean_laps(), strict=True)
        rates = [weight / mean for weight, mean in means if mean]
        if self.pattern:
            return sum(rates, Fraction(0))
        return Fraction(f"{math.fsum(map(float, rates)):.12g}")

    def measured(self) -> Measured:
        """Return what the laps that were seen say; of use where nothing is known to repeat."""
        return measure(self.group, self.history)

    def waiting_shares(self) -> tuple[Fraction | None, ...]:
        """Return which part of its time each robot waits for others; None if it makes no lap."""
        return tuple(
            None if mean is None else max(1 - endless.lap.duration / mean, Fraction(0))
            for endless, mean in zip(self.group, self.mean_laps(), strict=True)
        )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class CyclicResult:
    """What a fleet did that repeats its work.

    Attributes
    ----------
    scenario
        The problem.
    rule, routes
        How rights of way were given, and how the round trips were chosen.
    groups
        Groups of robots that never meet each other, by their first robots.
    """

    scenario: Scenario
    rule: str
    routes: str
    groups: tuple[GroupRun, ...]

    def conflicts(self, group: GroupRun) -> tuple[Conflict, ...]:
        """Return where robots of a group wait for each other in each period, by offset.

        Offsets count from `Pattern.begins`. Empty if nothing repeats.
        """
        return self._bookings(group).in_period(group.pattern) if group.pattern else ()

    def first_conflicts(self, group: GroupRun) -> tuple[Conflict, ...]:
        """Return where robots of a group wait for each other in their first laps, by tick."""
        return self._bookings(group).in_first_laps(group.history)

    def bottleneck(self, group: GroupRun) -> Bottleneck | None:
        """Return what a group's period is made of; None if nothing repeats, or a robot stands."""
        graph = self.graph(group)
        return None if graph is None else bottleneck_of(graph)

    def graph(self, group: GroupRun) -> TimedEventGraph | None:
        """Return the event graph of what a group repeats; None if nothing, or a robot stands."""
        timetable = group.timetable
        if timetable is None:
            return None
        how = self._bookings(group)
        return timed_event_graph(timetable, headway=how.headway, books_ahead=how.books_ahead)

    def throughput(self) -> Fraction:
        """Return how many laps all robots complete in a time unit of the scenario."""
        ticks = 1 / self.scenario.problem.clock.tick
        return sum((group.rate() * ticks for group in self.groups), Fraction(0))

    def _bookings(self, group: GroupRun) -> Bookings:
        return Bookings(
            group=group.group,
            headway=planning_headway(self.scenario),
            books_ahead=self.scenario.rules.books_ahead,
        )
