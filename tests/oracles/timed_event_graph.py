"""Cycle times by Karp's algorithm, and by letting the fleet run until its state comes again."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from fractions import Fraction
from itertools import accumulate, count, pairwise
from typing import NamedTuple

from rightofway.precedence import CyclicSchedule

MINUS_INFINITY = float("-inf")


class Arc(NamedTuple):
    """The head comes at least so long after the tail, counted so many periods later."""

    tail: int
    head: int
    length: int
    height: int


class _Booking(NamedTuple):
    vertex: int
    enter: int
    robot: int
    visit: int
    period: int


def arcs_of(timetable: CyclicSchedule, *, headway: int, books_ahead: bool) -> list[Arc]:
    """Return all arcs, the rights of way by laying out the visits of some periods one by one."""
    sizes = [len(enter) for enter in timetable.enter]
    starts = list(accumulate(sizes, initial=0))
    arcs, bookings, approach = [], [], {}
    for robot, (lap, size) in enumerate(zip(timetable.laps, sizes, strict=True)):
        for k in range(size):
            visit = starts[robot] + k
            after, wraps = starts[robot] + (k + 1) % size, int(k == size - 1)
            arcs.append(Arc(visit, after, lap.compute_least(k % len(lap)), wraps))
            approach[visit] = lap.drive[k % len(lap)] if books_ahead else 0
            bookings += [
                _Booking(
                    lap.vertices[k % len(lap)],
                    int(timetable.enter[robot][k]) + period * timetable.period,
                    robot,
                    visit,
                    period,
                )
                for period in range(-2, 4)
            ]
    for one, then in pairwise(sorted(bookings)):
        if one.vertex == then.vertex and one.robot != then.robot and then.period == 1:
            last = one.visit + 1 == starts[one.robot + 1]
            leave = starts[one.robot] if last else one.visit + 1
            height = then.period - one.period - int(last)
            arcs.append(Arc(leave, then.visit, headway + approach[then.visit], height))
    return arcs


def turned(timetable: CyclicSchedule, arcs: Sequence[Arc]) -> list[Arc]:
    """Return the arcs with each visit counted in the period that it is in: no height below 0."""
    turn = [int(tick) // timetable.period for enter in timetable.enter for tick in enter]
    return [arc._replace(height=arc.height + turn[arc.head] - turn[arc.tail]) for arc in arcs]


def karp(n_nodes: int, arcs: Sequence[Arc]) -> Fraction:
    """Return the largest ratio of length to height; no height is negative.

    Higher arcs are cut into arcs of height 1; longest paths of height 0 are added to what they
    lead on from. Then Karp's theorem gives the largest mean.

    References
    ----------
    Karp, *A characterization of the minimum cycle mean in a digraph*, Discrete Mathematics 23,
    1978.
    """
    n, steps = _steps(n_nodes, arcs)
    at: list[list[float]] = [[0.0] * n]  # the longest walks of k steps, from anywhere
    for _ in range(n):
        longest = [MINUS_INFINITY] * n
        for (tail, head), length in steps.items():
            longest[head] = max(longest[head], at[-1][tail] + length)
        at.append(longest)
    return max(
        (
            min(Fraction(int(at[n][v] - at[k][v]), n - k) for k in range(n) if _is(at[k][v]))
            for v in range(n)
            if _is(at[n][v])
        ),
        default=Fraction(0),
    )


def _is(length: float) -> bool:
    return length > MINUS_INFINITY


def _steps(n_nodes: int, arcs: Sequence[Arc]) -> tuple[int, dict[tuple[int, int], float]]:
    """Return the longest way from node to node of height 1, on as many nodes as it takes."""
    n_nodes, cut = _cut(n_nodes, arcs)
    flat = _flat_ways(n_nodes, cut)
    steps: dict[tuple[int, int], float] = defaultdict(lambda: MINUS_INFINITY)
    for arc in cut:
        if arc.height == 1:
            for v, way in enumerate(flat[arc.head]):
                steps[arc.tail, v] = max(steps[arc.tail, v], arc.length + way)
    return n_nodes, steps


def _cut(n_nodes: int, arcs: Sequence[Arc]) -> tuple[int, list[Arc]]:
    """Cut arcs into such of height 0 or 1, by nodes in between."""
    cut: list[Arc] = []
    for arc in arcs:
        tail = arc.tail
        for _ in range(arc.height - 1):
            cut.append(Arc(tail, n_nodes, 0, 1))
            tail, n_nodes = n_nodes, n_nodes + 1
        cut.append(Arc(tail, arc.head, arc.length, min(arc.height, 1)))
    return n_nodes, cut


def _flat_ways(n_nodes: int, arcs: Sequence[Arc]) -> list[list[float]]:
    """Return the longest way between each two nodes along arcs of height 0."""
    flat = [[0.0 if i == j else MINUS_INFINITY for j in range(n_nodes)] for i in range(n_nodes)]
    for arc in arcs:
        if arc.height == 0:
            flat[arc.tail][arc.head] = max(flat[arc.tail][arc.head], arc.length)
    for k in range(n_nodes):
        for row in flat:
            row[:] = [max(a, row[k] + b) for a, b in zip(row, flat[k], strict=True)]
    assert all(flat[i][i] == 0 for i in range(n_nodes)), "what takes time takes a period"
    return flat


def run_until_it_repeats(n_nodes: int, arcs: Sequence[Arc]) -> Fraction:
    """Let everything take place as soon as it may, from rest; return its mean time a period.

    No height is negative, and everything waits for everything, through others at least.
    """
    deepest = max(arc.height for arc in arcs)
    past: list[tuple[int, ...]] = [(0,) * n_nodes] * deepest
    seen: dict[tuple[tuple[int, ...], ...], tuple[int, int]] = {}
    for period in count():
        now = list(past[-1])
        changes = True
        while changes:
            changes = False
            for tail, head, length, height in arcs:
                before = now[tail] if height == 0 else past[-height][tail]
                if before + length > now[head]:
                    now[head], changes = before + length, True
        past = [*past[1:], tuple(now)] if deepest > 1 else [tuple(now)]
        least = min(now)
        state = tuple(tuple(tick - least for tick in row) for row in past)
        if state in seen:
            then, tick = seen[state]
            return Fraction(least - tick, period - then)
        seen[state] = period, least
    raise AssertionError("it always repeats")
