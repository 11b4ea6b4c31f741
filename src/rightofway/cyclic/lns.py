"""Large neighbourhood search: remove robots of the bottleneck from a timetable, insert them again.

The objective is the value of laps divided by the cycle time. A step changes the number of laps of a
robot, or none, and takes the longest period that keeps the objective, or a shorter one. Robots of
critical circuits are removed until the others alone can keep that period. The others get their
earliest times in their old orders, and the removed robots are inserted among them, on any of their
laps. So one step may reverse one right of way, or all of a robot, for whole segments at once.

References
----------
Shaw, *Using constraint programming and local search methods to solve vehicle routing problems*,
CP 1998 (large neighbourhood search).

Notes
-----
Never worse than the timetable it starts from. Anytime; deterministic for a seed if the steps end
before the time does. Not optimal.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from rightofway.cyclic.problem import Candidate, CyclicProblem, RobotCycle
from rightofway.model import Tick
from rightofway.precedence import CyclicSchedule, unrolled
from rightofway.search import PeriodicBookings

__all__ = ["LnsParams", "improve", "insert_laps"]


@dataclass(frozen=True, slots=True, kw_only=True)
class LnsParams:
    """The neighbourhoods of a search; of listed values one is drawn."""

    most_removed: int = 6  # A step that would remove more robots is given up.
    extra_removed: tuple[int, ...] = (0, 0, 1, 2)  # Removed beyond the robots that have to be.
    count_changes: tuple[int, ...] = (0, 0, 1, 1, -1)  # By how many laps a robot's count changes.
    insert_every: int = 10  # Every this many steps, laps are inserted without new times.
    patience: int = 60  # After this many steps in vain, two periods become one.
    most_visits: int = 8_000  # No period gets longer than this by that; it has laps inserted only.
    insertions_per_robot: int = 6  # Inserting laps takes this many steps for each robot.
    moves_every: int = 3  # One of these steps in this many adds no lap, and only moves robots.
    neighbours_moved: tuple[int, ...] = (0, 1, 1, 2)  # This many others make room for a lap.


DEFAULT = LnsParams()


def improve(
    problem: CyclicProblem,
    candidate: Candidate,
    *,
    steps: int | None = None,
    params: LnsParams = DEFAULT,
) -> Candidate:
    """Return the best timetable found in so many steps, or until the deadline of the problem."""
    best, in_vain, step = candidate, 0, 0
    while (steps is None or step < steps) and problem.value(best) < problem.bound:
        if problem.is_out_of_time:
            break
        step, in_vain = step + 1, in_vain + 1
        inserts = step % params.insert_every == 0 or candidate.n_visits > params.most_visits
        found = (insert_laps if inserts else _step)(problem, candidate, params)
        if found is not None and problem.accepts(found):
            if problem.value(found) > problem.value(candidate):
                best, in_vain = found, 0
            candidate = found
        if in_vain >= params.patience:
            in_vain = 0
            if 2 * candidate.n_visits <= params.most_visits:
                twice = unrolled(candidate.timetable, 2)
                candidate = Candidate(twice, candidate.cycle_time * 2)
    return best


def insert_laps(problem: CyclicProblem, candidate: Candidate, params: LnsParams) -> Candidate:
    """Return a timetable with at least as many laps, in a period that is not longer.

    In each of many small steps, a robot is to make one lap more, or as many as before; it and some
    robots whose vertices it shares are removed and placed again. If one finds no place, all return.
    """
    draw, (bookings, cycles) = problem.draw, problem.booked(candidate)
    for _ in range(params.insertions_per_robot * len(cycles)):
        if problem.is_out_of_time:
            break
        robot = draw.randrange(len(cycles))
        count = cycles[robot].count + (draw.randrange(params.moves_every) > 0)
        if count * problem.alone[robot] <= bookings.period:
            near = sorted(bookings.users(cycles[robot].lap.vertices) - {robot})
            others = draw.sample(near, min(len(near), draw.choice(params.neighbours_moved)))
            counts = {robot: count, **{one: cycles[one].count for one in others}}
            _move(problem, bookings, cycles, counts)
    return problem.candidate(problem.timetable(cycles, candidate.period))


def _move(
    problem: CyclicProblem,
    bookings: PeriodicBookings,
    cycles: list[RobotCycle],
    counts: Mapping[int, int],
) -> None:
    """Place some robots again with new numbers of laps; if one finds no place, all return."""
    for robot in counts:
        bookings.remove(robot)
    placed: dict[int, RobotCycle] = {}
    for robot in problem.draw.sample(list(counts), len(counts)):
        found = problem.place(bookings, robot, counts[robot], tries=2)
        if found is None:
            break
        bookings.add(robot, found.lap, found.count, found.enter)
        placed[robot] = found
    if len(placed) == len(counts):
        for robot, cycle in placed.items():
            cycles[robot] = cycle
        return
    for robot in placed:
        bookings.remove(robot)
    for robot in counts:
        bookings.add(robot, cycles[robot].lap, cycles[robot].count, cycles[robot].enter)


def _step(problem: CyclicProblem, candidate: Candidate, params: LnsParams) -> Candidate | None:
    """Return a timetable that is at least as good, or None if this step finds none."""
    draw, counts = problem.draw, list(candidate.timetable.counts)
    robot, change = draw.randrange(len(counts)), draw.choice(params.count_changes)
    removed = []
    if change != 0 and counts[robot] + change >= 1:
        counts[robot] += change
        removed = [robot]
    longest = problem.worth(counts) / problem.value(candidate)
    most = longest.numerator // longest.denominator  # the objective stays with this period
    rest = _removed(problem, candidate, removed, most, params)
    if rest is None:
        return None
    removed, least = rest
    least = max(least, *(n * alone for n, alone in zip(counts, problem.alone, strict=True)))
    period = draw.choice((most, most, most - 1, draw.randint(least, max(most, least))))
    period = max(period, least)
    if period > most or not problem.is_fair(counts, period):
        return None
    return _reinserted(problem, candidate, counts, removed, period)


def _removed(
    problem: CyclicProblem,
    candidate: Candidate,
    removed: list[int],
    most: int,
    params: LnsParams,
) -> tuple[list[int], int] | None:
    """Remove robots of critical circuits until the others can keep the period, and a few more.

    Returns the robots, and the least period of the others; None if these are too many.
    """
    extra = problem.draw.choice(params.extra_removed)
    while len(removed) <= params.most_removed:
        left = [robot for robot in range(len(problem)) if robot not in removed]
        if not left:
            return removed, 1
        graph = problem.graph(_part(candidate.timetable, left))
        circuit = graph.critical_circuit()
        on = sorted({left[robot] for robot in graph.robot[graph.arcs.head[circuit.arcs]].tolist()})
        if removed and circuit.cycle_time <= most:
            if not extra:
                return removed, -(-circuit.cycle_time.numerator // circuit.cycle_time.denominator)
            extra -= 1
        removed = [*removed, problem.draw.choice(on)]
    return None


def _part(timetable: CyclicSchedule, robots: Sequence[int]) -> CyclicSchedule:
    """Return the timetable of some of the robots."""
    return replace(
        timetable,
        robots=tuple(timetable.robots[robot] for robot in robots),
        laps=tuple(timetable.laps[robot] for robot in robots),
        counts=tuple(timetable.counts[robot] for robot in robots),
        enter=tuple(timetable.enter[robot] for robot in robots),
    )


def _reinserted(
    problem: CyclicProblem,
    candidate: Candidate,
    counts: Sequence[int],
    removed: Sequence[int],
    period: int,
) -> Candidate | None:
    """Give the other robots their earliest times in a period, and insert those removed."""
    bookings, cycles = problem.empty_bookings(period), dict[int, RobotCycle]()
    left = [robot for robot in range(len(problem)) if robot not in removed]
    if left:
        rest = problem.graph(_part(candidate.timetable, left)).earliest(Tick(period))
        rows = zip(left, rest.laps, rest.counts, rest.enter, strict=True)
        cycles = {robot: RobotCycle(lap, n, enter) for robot, lap, n, enter in rows}
    for robot, cycle in cycles.items():
        bookings.add(robot, cycle.lap, cycle.count, cycle.enter)
    for robot in problem.draw.sample(list(removed), len(removed)):
        found = problem.place(bookings, robot, counts[robot])
        if found is None:
            return None
        bookings.add(robot, found.lap, found.count, found.enter)
        cycles[robot] = found
    joined = [cycles[robot] for robot in range(len(problem))]
    return problem.candidate(problem.timetable(joined, period))
