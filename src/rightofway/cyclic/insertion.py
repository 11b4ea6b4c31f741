"""Insertion: place one robot after another in a period, then add laps as long as there is room.

A robot in the way of one that finds no place is removed and placed again later. Where that comes to
no end, the period is too short.
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
from fractions import Fraction
from heapq import heapify, heappop, heappush

from rightofway.cyclic.problem import Candidate, CyclicProblem, RobotCycle
from rightofway.errors import GaveUp
from rightofway.search import PeriodicBookings

__all__ = ["InsertionParams", "fill", "insert_all"]


@dataclass(frozen=True, slots=True, kw_only=True)
class InsertionParams:
    """When a period is given up as too short, and by how much the next one is longer."""

    placements_per_robot: int = 6  # After more, on average, the period counts as too short.
    growth: Fraction = Fraction(5, 4)  # The next period is longer by this factor.
    longest: int = 2  # No longer period is tried [sums of all laps].


def insert_all(
    problem: CyclicProblem,
    period: int,
    *,
    filling: CyclicProblem,
    params: InsertionParams = InsertionParams(),
) -> Candidate:
    """Return a timetable with at least this period in which each robot makes at least one lap.

    ``filling`` is the same problem with the deadline for more laps. Raises `GaveUp` if no timetable
    was found, or time ran out.
    """
    period = max(period, *problem.alone)
    while period <= params.longest * sum(problem.alone):
        placed = _placed(problem, period, params)
        if placed is not None:
            return fill(filling, *placed)
        period = period * params.growth.numerator // params.growth.denominator + 1
    raise GaveUp("no timetable was found in which all robots have a place")


def _placed(
    problem: CyclicProblem, period: int, params: InsertionParams
) -> tuple[PeriodicBookings, list[RobotCycle]] | None:
    """Give every robot one lap in the period; None if the period is too short."""
    bookings, cycles = problem.empty_bookings(period), dict[int, RobotCycle]()
    queue = deque(sorted(range(len(problem)), key=lambda robot: -problem.alone[robot]))
    for _ in range(params.placements_per_robot * len(problem)):
        if not queue:
            break
        problem.deadline.check("finding every robot a place")
        robot = queue.popleft()
        cycle = problem.place(bookings, robot, 1)
        while cycle is None:
            lap = problem.draw.choice(problem.ways[robot])
            bookings.search(lap, 1, problem.draw.randrange(int(bookings.period)))
            near = sorted(bookings.users([bookings.stuck_at(lap)]) & cycles.keys())
            near = near or sorted(bookings.users(lap.vertices))
            if not near:
                return None
            removed = problem.draw.choice(near)
            bookings.remove(removed)
            del cycles[removed]
            queue.append(removed)
            cycle = problem.place(bookings, robot, 1, tries=1)
        bookings.add(robot, cycle.lap, cycle.count, cycle.enter)
        cycles[robot] = cycle
    return None if queue else (bookings, [cycles[robot] for robot in range(len(problem))])


def fill(problem: CyclicProblem, bookings: PeriodicBookings, cycles: list[RobotCycle]) -> Candidate:
    """Add laps as long as there is room, first for the robot that drives least."""
    turns = [
        (cycle.count * alone, robot)
        for robot, (cycle, alone) in enumerate(zip(cycles, problem.alone, strict=True))
    ]
    heapify(turns)
    while turns and not problem.is_out_of_time:
        _, robot = heappop(turns)
        before, alone = cycles[robot].count, problem.alone[robot]
        if (before + 1) * alone > bookings.period:
            continue
        bookings.remove(robot)
        cycles[robot] = cycle = _more_laps(problem, bookings, robot, cycles[robot]) or cycles[robot]
        bookings.add(robot, cycle.lap, cycle.count, cycle.enter)
        if cycle.count > before:
            heappush(turns, (cycle.count * alone, robot))
    return problem.candidate(problem.timetable(cycles, int(bookings.period)))


def _more_laps(
    problem: CyclicProblem, bookings: PeriodicBookings, robot: int, cycle: RobotCycle
) -> RobotCycle | None:
    """Find room for half as many laps again, or for one more; on the same lap, or on any."""
    most = int(bookings.period) // problem.alone[robot]
    many = min(cycle.count + max(cycle.count // 2, 1), most)
    for count in dict.fromkeys((many, cycle.count + 1)):
        more = problem.place(bookings, robot, count, lap=cycle.lap)
        if more is not None:
            return more
    if not problem.round_trips and len(problem.ways[robot]) == 1:
        return None
    return problem.place(bookings, robot, cycle.count + 1, tries=1)
