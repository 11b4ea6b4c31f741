"""The precedence graph of work that repeats, wrapped round in time: the event graph.

A node is a visit of one period, its time the enter. An arc leads from a visit to the next one of
its robot, and at each vertex from the visit after the one that goes first to the one that goes
second. Its *height* is the number of periods between the two visits: 1 where a robot starts its
next lap, or where the order at a vertex starts again. If robots wait only for these arcs, each
visit repeats after the *cycle time*, the largest mean of a circuit (length divided by height). A
circuit of that mean is the bottleneck: changes elsewhere do not shorten the period.

References
----------
Baccelli, Cohen, Olsder & Quadrat, *Synchronization and Linearity*, Wiley 1992.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from typing import Self

import numpy as np
from numpy.typing import NDArray

from rightofway import _core
from rightofway.errors import GaveUp
from rightofway.facts import Fact
from rightofway.model import BookingRules, Lap, Tick, make_visits_of_laps
from rightofway.native import BookedRows

MOST_ANSWERS = 1 << 21
"""Ends of visits that are looked up at once where robots have a size; bounds the memory."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class CyclicSchedule:
    """The visits of the robots of a group in each period.

    Attributes
    ----------
    robots
        The numbers of the group's robots in their scenario.
    laps
        The lap that each of them repeats.
    counts
        How many laps each makes in a period; at least 1.
    period
        The number of ticks after which all visits repeat.
    enter
        For each robot the ticks at which its visits of one period begin: ``counts * len(lap)`` of
        them, int64, strictly rising, the first at home in ``[0, period)`` and all before the first
        plus the period. The visit after the last is the first, a period later.
    """

    robots: tuple[int, ...]
    laps: tuple[Lap, ...]
    counts: tuple[int, ...]
    period: Tick
    enter: tuple[NDArray[np.int64], ...]


def unroll_schedule(timetable: CyclicSchedule, times: int) -> CyclicSchedule:
    """Return the same timetable with several of its periods as one.

    Parameters
    ----------
    timetable
        The timetable.
    times
        The number of periods that become one.
    """
    period = int(timetable.period)
    shifts = np.arange(times, dtype=np.int64)[:, None] * period
    return replace(
        timetable,
        counts=tuple(count * times for count in timetable.counts),
        period=Tick(period * times),
        enter=tuple((enter + shifts).ravel() for enter in timetable.enter),
    )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Arcs:
    """Arcs between visits that wait for each other, in arrays of shape (M,).

    Attributes
    ----------
    tail, head
        Visits; int32.
    length
        The least time from tail to head [ticks]; int64.
    height
        The number of periods between; int32.
    first
        The visit that goes first where the arc is a right of way, -1 where it is a robot's own
        progress; int32.
    """

    tail: NDArray[np.int32]
    head: NDArray[np.int32]
    length: NDArray[np.int64]
    height: NDArray[np.int32]
    first: NDArray[np.int32]

    def __len__(self) -> int:
        return len(self.tail)

    def stretch(self, length: NDArray[np.int64]) -> Self:
        """Return the same arcs, as long as given."""
        return replace(self, length=length)

    def choose(self, which: NDArray[np.int32] | NDArray[np.bool_]) -> Self:
        """Return some of the arcs, by their numbers or by a mask."""
        return replace(self, **{name: getattr(self, name)[which] for name in self.__slots__})


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Circuit:
    """A circuit of the event graph.

    Attributes
    ----------
    cycle_time
        Its length by its height [ticks]; exact.
    arcs
        The numbers of its arcs, in order; int32. None where nothing takes any time.
    """

    cycle_time: Fraction
    arcs: NDArray[np.int32]


class TimedEventGraph:
    """The visits of one period and the arcs into each.

    Parameters
    ----------
    timetable
        Whose laps and orders to keep; its times say nothing else.
    rules
        When visits book.
    rows
        The bookings of the visits, where robots have a size.

    Attributes
    ----------
    first
        Where each robot's visits begin, and where all end; int64, shape (robots + 1,).
    vertex
        Where each visit is; int32.
    robot
        Whose it is, as a position in ``timetable.robots``; int32.
    drive, dwell
        Ticks of the drive into it, and how long it lasts at least; int64.
    """

    def __init__(
        self,
        timetable: CyclicSchedule,
        *,
        rules: BookingRules,
        rows: BookedRows | None = None,
    ) -> None:
        self.timetable = timetable
        self.rows = rows
        self.rules = rules
        laps, counts = timetable.laps, timetable.counts
        sizes = [len(lap) * count for lap, count in zip(laps, counts, strict=True)]
        self.first = np.concatenate(([0], np.cumsum(sizes)))
        self.robot = np.repeat(np.arange(len(laps), dtype=np.int32), sizes)
        columns = zip(*map(make_visits_of_laps, laps, counts), strict=True)
        self.vertex, self.dwell, self.drive = map(np.concatenate, columns)

    def __len__(self) -> int:
        return len(self.vertex)

    @cached_property
    def index(self) -> NDArray[np.int32]:
        """Which visit of the robot's lap each one is; int32."""
        visits_of_lap = np.array(list(map(len, self.timetable.laps)), np.int32)
        place = np.arange(len(self)) - self.first[self.robot]
        return (place % visits_of_lap[self.robot]).astype(np.int32)

    @cached_property
    def after(self) -> NDArray[np.int32]:
        """The visit that follows each one; int32."""
        after = np.arange(1, len(self) + 1, dtype=np.int32)
        after[self.first[1:] - 1] = self.first[:-1]
        return after

    @cached_property
    def wraps(self) -> NDArray[np.int32]:
        """Number of periods to the visit that follows each one: 0 or 1; int32."""
        wraps = np.zeros(len(self), np.int32)
        wraps[self.first[1:] - 1] = 1
        return wraps

    @cached_property
    def arcs(self) -> Arcs:
        """First each visit's own progress, in the order of visits; then the rights of way."""
        progress = Arcs(
            tail=np.arange(len(self), dtype=np.int32),
            head=self.after,
            length=self.dwell + self.drive[self.after],
            height=self.wraps,
            first=np.full(len(self), -1, np.int32),
        )
        rights = (
            self._list_rights_of_way()
            if self.rows is None
            else self._list_rights_by_rows(self.rows)
        )
        return Arcs(
            **{
                name: np.concatenate((getattr(progress, name), getattr(rights, name)))
                for name in Arcs.__slots__
            }
        )

    @cached_property
    def drives(self) -> NDArray[np.int64]:
        """The part of each arc that is the drive into its head [ticks]; int64."""
        drive = self.drive[self.arcs.head]
        of_rights = self.rules.follow(np.zeros(len(drive), np.int64), drive)
        return np.where(self.arcs.first < 0, drive, of_rights)

    @cached_property
    def headways(self) -> NDArray[np.int64]:
        """The part of each arc that is the headway [ticks]; int64."""
        return np.where(self.arcs.first < 0, 0, self.rules.end(0))

    def _list_rights_of_way(self) -> Arcs:
        """Return an arc for each two visits of different robots next to each other at a vertex."""
        period = int(self.timetable.period)
        turn, tick = np.divmod(np.concatenate(self.timetable.enter), period)
        order = np.lexsort((tick, self.vertex))
        starts = np.flatnonzero(np.diff(self.vertex[order], prepend=-1))
        ends = np.append(starts[1:], len(order)) - 1
        then = np.roll(order, -1)
        then[ends] = order[starts]
        rounds = np.zeros(len(order), np.int64)
        rounds[ends] = 1
        meets = self.robot[order] != self.robot[then]
        first, second, rounds = order[meets], then[meets], rounds[meets]
        return Arcs(
            tail=self.after[first],
            head=second.astype(np.int32),
            length=self.rules.follow(
                self.rules.end(np.zeros(len(first), np.int64)), self.drive[second]
            ),
            height=(turn[first] + rounds - turn[second] - self.wraps[first]).astype(np.int32),
            first=first.astype(np.int32),
        )

    def _list_rights_by_rows(self, rows: BookedRows) -> Arcs:
        """Return for each start, of each other robot, an arc from its latest end before.

        Of two incompatible visits, that one goes first which ends first. A visit ends with its
        leave; the start that counts is its own, or that of the next visit, whose drive in is along
        the edge that is too near.
        """
        period, n = int(self.timetable.period), len(self)
        enter = np.concatenate(self.timetable.enter)
        turn, tick = np.divmod(enter[self.after] + self.wraps * period, period)
        rank = np.empty(n, np.int64)
        rank[np.lexsort((np.arange(n), tick))] = np.arange(n)
        visit, row = np.tile(np.arange(n), 2), np.concatenate((rows.vertex, rows.edge))
        start = np.concatenate((np.arange(n), self.after))
        later = np.concatenate((np.zeros(n, np.int64), self.wraps))
        # All ends by row and robot, in the order of a period.
        n_robots = len(self.timetable.laps)
        key = row.astype(np.int64) * n_robots + self.robot[visit]
        order = np.lexsort((rank[visit], key))
        keys, begins = np.unique(key[order], return_index=True)
        ends, of_row = np.append(begins[1:], 2 * n), keys // n_robots
        places = np.repeat(np.arange(len(keys)), ends - begins) * n + rank[visit[order]]
        # Each start asks all rows that exclude it, and there each other robot.
        used, at_used = np.unique(row, return_inverse=True)  # few of all rows
        lists = [rows.lists.of(number) for number in used.tolist()]
        first = np.append(0, np.cumsum([len(others) for others in lists]))
        excluded = np.concatenate(lists)
        robots_at = np.searchsorted(of_row, [excluded, excluded + 1])
        n_asked = np.append(0, np.cumsum(robots_at[1] - robots_at[0]))
        before = np.empty(n, np.int64)
        before[self.after] = np.arange(n)
        by_start = np.column_stack((np.arange(n), n + before)).ravel()
        n_answers = np.cumsum(np.diff(n_asked[first])[at_used][by_start])[1::2]
        parts = []
        for some in np.split(by_start, 2 * _split_into_parts(n_answers, MOST_ANSWERS)):
            of_asked, at = _expand_ranges(first[at_used[some]], first[at_used[some] + 1])
            again, of = _expand_ranges(robots_at[0][at], robots_at[1][at])
            asks = some[of_asked[again]]
            is_other = keys[of] % n_robots != self.robot[visit[asks]]
            asks, of = asks[is_other], of[is_other]
            place = np.searchsorted(places, of * n + rank[visit[asks]]) - 1
            is_earlier_round = place < begins[of]
            ended = visit[order][np.where(is_earlier_round, ends[of] - 1, place)]
            rounds = turn[visit[asks]] - turn[ended] - is_earlier_round
            height = later[asks] - rounds - self.wraps[ended]
            parts.append(self._find_latest_ends(start[asks], ended, height))
        head, ended, height = (np.concatenate(column) for column in zip(*parts, strict=True))
        return Arcs(
            tail=self.after[ended],
            head=head.astype(np.int32),
            length=self.rules.follow(
                self.rules.end(np.zeros(len(head), np.int64)), self.drive[head]
            ),
            height=height.astype(np.int32),
            first=ended.astype(np.int32),
        )

    def _find_latest_ends(
        self, head: NDArray[np.int64], ended: NDArray[np.int64], height: NDArray[np.int64]
    ) -> tuple[NDArray[np.int64], ...]:
        """Return, of arcs from ends to starts, for each start the latest end of each robot.

        Without those ends that an earlier start of the same robot in the period waits for.
        """
        own, other = self.robot[head].astype(np.int64), self.robot[ended]
        n_visits = np.diff(self.first)[other]
        when = self.after[ended] - self.first[other] - height * n_visits
        pair = own * len(self.timetable.laps) + other
        in_order = np.lexsort((-when, head, pair))
        pair, when = pair[in_order], when[in_order]
        if not len(when):
            return head, ended, height
        # The latest end so far: no end of one pair of robots is as late as those of the next pair.
        span = int(when.max() - when.min()) + 1
        reached = np.maximum.accumulate(
            np.cumsum(np.diff(pair, prepend=pair[0]) != 0) * span + when
        )
        rising = in_order[np.diff(reached, prepend=reached[0] - 1) > 0]
        return head[rising], ended[rising], height[rising]

    def has_swaps(self) -> bool:
        """Tell whether two robots would exchange two vertices: each waits for the other to go.

        No timetable that keeps the rules has these orders; but no circuit of them takes any time.
        """
        rights = self.arcs.choose((self.arcs.first >= 0) & (self.arcs.length == 0))
        if not len(rights):
            return False
        forward = rights.tail.astype(np.int64) * len(self) + rights.head
        back = rights.head.astype(np.int64) * len(self) + rights.tail
        order = np.argsort(forward)
        matches = order[np.searchsorted(forward[order], back).clip(max=len(forward) - 1)]
        swaps = (forward[matches] == back) & (rights.height + rights.height[matches] == 0)
        return bool(swaps.any())

    def compute_slack(self) -> NDArray[np.int64]:
        """Return how much later than it had to each arc's head comes in the timetable [ticks].

        Below 0 for a timetable that does not keep its own orders: robots drive too fast in it, or
        bookings overlap.
        """
        enter, arcs = np.concatenate(self.timetable.enter), self.arcs
        due = enter[arcs.tail] + arcs.length
        return enter[arcs.head] + arcs.height.astype(np.int64) * int(self.timetable.period) - due

    def find_critical_circuit(self, *, time_limit: float | None = None) -> Circuit:
        """Return a circuit of the largest mean, and with it the exact cycle time.

        The cycle time is for one period of the timetable, so for all its ``counts`` of laps. A
        fleet that keeps the orders and waits for nothing else settles in it, wherever it starts.

        Raises
        ------
        ValueError
            If robots wait for each other for ever in these orders.
        GaveUp
            If time ran out.
        """
        circuit = self.find_critical_circuit_if_live(time_limit=time_limit)
        if circuit is None:
            raise ValueError("timetable: robots wait for each other permanently in its orders")
        return circuit

    def find_critical_circuit_if_live(self, *, time_limit: float | None = None) -> Circuit | None:
        """Return a critical circuit; None if robots wait for each other for ever in these orders.

        Raises
        ------
        GaveUp
            If time ran out.
        """
        return trace_circuit(len(self), self.arcs, time_limit)

    def compute_earliest(
        self,
        period: Tick,
        *,
        cycle_time: Fraction | None = None,
        time_limit: float | None = None,
    ) -> CyclicSchedule:
        """Return the timetable of the same orders in which everything comes as early as it can.

        Parameters
        ----------
        period
            At least the cycle time [ticks].
        cycle_time
            That, where it is known already.
        time_limit
            When to stop [s].

        Raises
        ------
        ValueError
            If the period is less than the cycle time.
        GaveUp
            If time ran out.
        """
        if cycle_time is None:
            cycle_time = self.find_critical_circuit(time_limit=time_limit).cycle_time
        if period < cycle_time:
            raise ValueError(f"period: {period} is less than the cycle time {cycle_time}")
        arcs, ticks = self.arcs, int(period)
        times = _core.earliest_times(
            len(self), arcs.tail, arcs.head, arcs.length, arcs.height, ticks, 1, time_limit
        )
        if times is None:
            raise GaveUp(Fact("time over for the earliest timetable"))
        # By whole periods to where the first visit of each robot is in the first period.
        parts = np.split(times, self.first[1:-1])
        enter = tuple(part - part[0] // ticks * ticks for part in parts)
        return replace(self.timetable, period=period, enter=enter)


def _split_into_parts(counts: NDArray[np.int64], most: int) -> NDArray[np.int64]:
    """Return where to cut a sequence with these running totals, into parts of about ``most``."""
    cuts = np.searchsorted(counts, np.arange(most, int(counts[-1]) + 1, most))
    return np.unique(cuts)


def _expand_ranges(
    first: NDArray[np.integer], end: NDArray[np.integer]
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return all numbers of some ranges, and before them the range that each is of."""
    counts = (end - first).astype(np.int64)
    of = np.repeat(np.arange(len(first)), counts)
    return of, np.arange(len(of)) - (np.cumsum(counts) - counts - first)[of]


def trace_circuit(n_visits: int, arcs: Arcs, time_limit: float | None) -> Circuit | None:
    """Return a circuit of the largest mean among arcs between visits; None for deadlock.

    Raises
    ------
    GaveUp
        If time ran out.
    """
    circuit = _core.critical_circuit(
        n_visits, arcs.tail, arcs.head, arcs.length, arcs.height, time_limit
    )
    if circuit is None:
        raise GaveUp(Fact("time over for the bottleneck"))
    length, height, numbers = circuit
    return Circuit(cycle_time=Fraction(length, height), arcs=numbers) if height else None
