"""Repeated work, slowly: orders at every vertex, repeated, and the longest paths through them."""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise, product

from rightofway.precedence import CyclicSchedule

__all__ = ["largest_mean_cycle_is", "replay"]

Arc = tuple[tuple[int, int], tuple[int, int], int, int]
"""From one visit of the period (robot, index) to another, length [ticks], height [periods]."""

GIVEN = 2
"""Periods whose times are given: no arc reaches further."""


def event_arcs(timetable: CyclicSchedule, *, headway: int, books_ahead: bool) -> list[Arc]:
    """Return what each visit of a period has to wait for: its robot, and the one before it.

    A visit belongs to the period in which it begins, so no height is negative.
    """
    arcs: list[Arc] = []
    at: dict[int, list[tuple[int, int, int]]] = {}
    for robot, (lap, enter) in enumerate(zip(timetable.laps, timetable.enter, strict=True)):
        for index, tick in enumerate((enter % timetable.period).tolist()):
            least, after = lap.compute_least(index % len(lap)), (index + 1) % len(enter)
            leave = tick + lasts(timetable, robot, index)
            arcs.append(((robot, index), (robot, after), least, leave // timetable.period))
            at.setdefault(lap.vertices[index % len(lap)], []).append((tick, robot, index))
    for visits in map(sorted, at.values()):
        again = (visits[0][0] + timetable.period, *visits[0][1:])
        for (one_tick, one, a), (other_tick, other, b) in pairwise([*visits, again]):
            if one == other:
                continue
            leave = one_tick + lasts(timetable, one, a)
            lap = timetable.laps[other]
            gap = headway + (lap.drive[b % len(lap)] if books_ahead else 0)
            height = other_tick // timetable.period - leave // timetable.period
            source = one, (a + 1) % len(timetable.enter[one])
            arcs.append((source, (other, b), gap, height))
    return arcs


def lasts(timetable: CyclicSchedule, robot: int, index: int) -> int:
    """Return how long a visit lasts."""
    enter: list[int] = [
        *timetable.enter[robot].tolist(),
        int(timetable.enter[robot][0]) + timetable.period,
    ]
    return enter[index + 1] - enter[index]


def replay(
    timetable: CyclicSchedule, periods: int, *, headway: int, books_ahead: bool
) -> dict[tuple[int, int, int], int]:
    """Return when visits (robot, index, period) begin if the orders of a period are kept.

    The first two periods' times are given; all others are the least that keep the orders.
    """
    arcs = event_arcs(timetable, headway=headway, books_ahead=books_ahead)
    when = {
        (robot, index, period): tick + period * timetable.period if period < GIVEN else 0
        for robot, enter in enumerate(timetable.enter)
        for index, tick in enumerate((enter % timetable.period).tolist())
        for period in range(periods)
    }
    changed = True
    while changed:
        changed = False
        for ((one, a), (other, b), length, height), period in product(arcs, range(GIVEN, periods)):
            source, target = (one, a, period - height), (other, b, period)
            if when[source] + length > when[target]:
                when[target] = when[source] + length
                changed = True
    return when


def largest_mean_cycle_is(timetable: CyclicSchedule, *, headway: int, books_ahead: bool) -> bool:
    """Tell whether the period is the largest mean cycle of the orders: length by height."""
    arcs = event_arcs(timetable, headway=headway, books_ahead=books_ahead)
    most = sum(height for *_, height in arcs)
    slightly_less = timetable.period - Fraction(1, 2 * most)
    return not _gains(arcs, Fraction(timetable.period)) and _gains(arcs, slightly_less)


def _gains(arcs: list[Arc], period: Fraction) -> bool:
    """Tell whether a circle takes longer than its height in periods (Bellman and Ford)."""
    late = {node: Fraction(0) for arc in arcs for node in arc[:2]}
    for _ in range(len(late) + 1):
        changed = False
        for source, target, length, height in arcs:
            tick = late[source] + length - period * height
            if tick > late[target]:
                late[target], changed = tick, True
        if not changed:
            return False
    return True
