"""Search for a timetable: insertion of robots and laps, then large neighbourhood search (LNS).

*Insertion* places robots one by one in a period, then adds laps while they fit. If a robot does not
fit, a robot in its way is removed and placed again later. If the number of placements exceeds its
limit, the period is too short.

*LNS* removes robots of the bottleneck and inserts them again. The objective is the value of laps
divided by the cycle time. A step may change the number of laps of one robot, and takes a period not
longer than the objective allows. Robots of critical circuits are removed until the other robots can
keep the period. The other robots get their earliest times in their old orders, and the removed
robots are inserted, each on any of its laps.

References
----------
Shaw, *Using constraint programming and local search methods to solve vehicle routing problems*,
CP 1998 (large neighbourhood search).

Notes
-----
The result of LNS is never worse than the first timetable. Anytime; deterministic for a seed if the
steps end before the deadline. Not optimal.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from heapq import heapify, heappop, heappush

from rightofway.cyclic.problem import Candidate, CyclicProblem, RobotCycle
from rightofway.errors import GaveUp
from rightofway.facts import Fact
from rightofway.model import Tick
from rightofway.precedence import CyclicSchedule, unroll_schedule
from rightofway.search import PeriodicBookings

PLACING = Fact("placing every robot")


@dataclass(frozen=True, slots=True, kw_only=True)
class InsertionParams:
    """Limits of placements per period, and growth of the period."""

    placements_per_robot: int = 6  # More placements, on average: the period is too short.
    growth: Fraction = Fraction(5, 4)  # Factor from a period to the next.
    longest: int = 2  # Longest period [sum of all laps].


def insert_all(
    problem: CyclicProblem,
    period: int,
    *,
    filling: CyclicProblem,
    params: InsertionParams = InsertionParams(),
) -> Candidate:
    """Return a timetable of at least this period with at least one lap per robot.

    ``filling`` is the same problem with the deadline for additional laps. Raises `GaveUp` if no
    timetable was found in time.
    """
    period = max(period, *problem.alone)
    while period <= params.longest * sum(problem.alone):
        placed = _place_laps(problem, period, params)
        if placed is not None:
            return fill(filling, *placed)
        period = period * params.growth.numerator // params.growth.denominator + 1
    raise GaveUp(Fact("no timetable with all robots"))


def _place_laps(
    problem: CyclicProblem, period: int, params: InsertionParams
) -> tuple[PeriodicBookings, list[RobotCycle]] | None:
    """Place one lap of every robot in the period; None if the period is too short."""
    bookings, cycles = problem.empty_bookings(period), dict[int, RobotCycle]()
    queue = deque(sorted(range(len(problem)), key=lambda robot: -problem.alone[robot]))
    for _ in range(params.placements_per_robot * len(problem)):
        if not queue:
            break
        problem.deadline.check(PLACING)
        robot = queue.popleft()
        cycle = problem.place(bookings, robot, 1)
        while cycle is None:
            lap = problem.draw.choice(problem.ways[robot])
            bookings.search(lap, 1, problem.draw.randrange(int(bookings.period)), robot=robot)
            near = sorted(bookings.find_blockers(robot, lap) & cycles.keys())
            near = near or sorted(bookings.find_neighbours(robot, lap))
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
    """Add laps while they fit, each time of the robot that drives least."""
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
        cycles[robot] = cycle = (
            _place_more_laps(problem, bookings, robot, cycles[robot]) or cycles[robot]
        )
        bookings.add(robot, cycle.lap, cycle.count, cycle.enter)
        if cycle.count > before:
            heappush(turns, (cycle.count * alone, robot))
    return problem.make_candidate(problem.join_cycles(cycles, int(bookings.period)))


def _place_more_laps(
    problem: CyclicProblem, bookings: PeriodicBookings, robot: int, cycle: RobotCycle
) -> RobotCycle | None:
    """Place 1.5 times as many laps, or one more lap; on the same lap, or on any lap."""
    most = int(bookings.period) // problem.alone[robot]
    many = min(cycle.count + max(cycle.count // 2, 1), most)
    for count in dict.fromkeys((many, cycle.count + 1)):
        more = problem.place(bookings, robot, count, lap=cycle.lap)
        if more is not None:
            return more
    if not problem.round_trips and len(problem.ways[robot]) == 1:
        return None
    return problem.place(bookings, robot, cycle.count + 1, tries=1)


@dataclass(frozen=True, slots=True, kw_only=True)
class LnsParams:
    """The neighbourhoods of a search; one of several values is drawn at random."""

    most_removed: int = 6  # Maximum robots removed per step.
    extra_removed: tuple[int, ...] = (0, 0, 1, 2)  # Robots removed beyond the necessary ones.
    count_changes: tuple[int, ...] = (0, 0, 1, 1, -1)  # Change of a robot's number of laps.
    insert_every: int = 10  # Steps from one insertion of laps to the next.
    patience: int = 60  # Steps without improvement before the period is doubled.
    most_visits: int = 8_000  # No doubling beyond; above, only laps are inserted.
    insertions_per_robot: int = 6  # Moves per robot in one insertion of laps.
    moves_every: int = 3  # One move in this many adds no lap.
    neighbours_moved: tuple[int, ...] = (0, 1, 1, 2)  # Other robots moved to make room.


DEFAULT = LnsParams()


def improve(
    problem: CyclicProblem,
    candidate: Candidate,
    *,
    steps: int | None = None,
    params: LnsParams = DEFAULT,
) -> Candidate:
    """Return the best timetable after ``steps`` steps, or at the deadline of the problem."""
    best, in_vain, step = candidate, 0, 0
    while (steps is None or step < steps) and problem.compute_value(best) < problem.bound:
        if not problem.has_time_for(candidate):
            break
        step, in_vain = step + 1, in_vain + 1
        inserts = step % params.insert_every == 0 or candidate.n_visits > params.most_visits
        changed = (insert_laps if inserts else _step)(problem, candidate, params)
        if changed is not None and problem.accepts(changed):
            if problem.compute_value(changed) > problem.compute_value(candidate):
                best, in_vain = changed, 0
            candidate = changed
        if in_vain >= params.patience:
            in_vain = 0
            if 2 * candidate.n_visits <= params.most_visits:
                twice = unroll_schedule(candidate.timetable, 2)
                candidate = Candidate(twice, candidate.cycle_time * 2)
    return best


def insert_laps(problem: CyclicProblem, candidate: Candidate, params: LnsParams) -> Candidate:
    """Return a timetable with at least as many laps, in a period that is not longer.

    Each move removes and places again a robot, with one more or as many laps, and some robots that
    share its vertices. If one of these robots does not fit, the move is undone.
    """
    draw, (bookings, cycles) = problem.draw, problem.book(candidate)
    for _ in range(params.insertions_per_robot * len(cycles)):
        if problem.is_out_of_time:
            break
        robot = draw.randrange(len(cycles))
        count = cycles[robot].count + (draw.randrange(params.moves_every) > 0)
        if count * problem.alone[robot] <= bookings.period:
            near = sorted(bookings.find_neighbours(robot, cycles[robot].lap) - {robot})
            others = draw.sample(near, min(len(near), draw.choice(params.neighbours_moved)))
            counts = {robot: count, **{number: cycles[number].count for number in others}}
            _move(problem, bookings, cycles, counts)
    return problem.make_candidate(problem.join_cycles(cycles, candidate.period))


def _move(
    problem: CyclicProblem,
    bookings: PeriodicBookings,
    cycles: list[RobotCycle],
    counts: Mapping[int, int],
) -> None:
    """Place robots again with new numbers of laps; undo the move if a robot does not fit."""
    for robot in counts:
        bookings.remove(robot)
    placed: dict[int, RobotCycle] = {}
    for robot in problem.draw.sample(list(counts), len(counts)):
        route = problem.place(bookings, robot, counts[robot], tries=2)
        if route is None:
            break
        bookings.add(robot, route.lap, route.count, route.enter)
        placed[robot] = route
    if len(placed) == len(counts):
        for robot, cycle in placed.items():
            cycles[robot] = cycle
        return
    for robot in placed:
        bookings.remove(robot)
    for robot in counts:
        bookings.add(robot, cycles[robot].lap, cycles[robot].count, cycles[robot].enter)


def _step(problem: CyclicProblem, candidate: Candidate, params: LnsParams) -> Candidate | None:
    """Return a timetable that is at least as good, or None if the step fails."""
    draw, counts = problem.draw, list(candidate.timetable.counts)
    robot, change = draw.randrange(len(counts)), draw.choice(params.count_changes)
    removed = []
    if change != 0 and counts[robot] + change >= 1:
        counts[robot] += change
        removed = [robot]
    longest = problem.compute_worth(counts) / problem.compute_value(candidate)
    most = longest.numerator // longest.denominator  # longest period that keeps the objective
    rest = _choose_removed(problem, candidate, removed, most, params)
    if rest is None:
        return None
    removed, least = rest
    least = max(least, *(n * alone for n, alone in zip(counts, problem.alone, strict=True)))
    period = draw.choice((most, most, most - 1, draw.randint(least, max(most, least))))
    period = max(period, least)
    if period > most or not problem.is_fair(counts, period):
        return None
    return _insert_removed(problem, candidate, counts, removed, period)


def _choose_removed(
    problem: CyclicProblem,
    candidate: Candidate,
    removed: list[int],
    most: int,
    params: LnsParams,
) -> tuple[list[int], int] | None:
    """Choose robots of critical circuits until the others can keep the period, and a few more.

    Returns the removed robots and the least period of the others; None above ``most_removed``.
    """
    extra = problem.draw.choice(params.extra_removed)
    while len(removed) <= params.most_removed:
        left = [robot for robot in range(len(problem)) if robot not in removed]
        if not left:
            return removed, 1
        graph = problem.build_graph(_take_part(candidate.timetable, left))
        circuit = graph.find_critical_circuit()
        on = sorted({left[robot] for robot in graph.robot[graph.arcs.head[circuit.arcs]].tolist()})
        if removed and circuit.cycle_time <= most:
            if not extra:
                return removed, -(-circuit.cycle_time.numerator // circuit.cycle_time.denominator)
            extra -= 1
        removed = [*removed, problem.draw.choice(on)]
    return None


def _take_part(timetable: CyclicSchedule, robots: Sequence[int]) -> CyclicSchedule:
    """Return the timetable of some of the robots."""
    return replace(
        timetable,
        robots=tuple(timetable.robots[robot] for robot in robots),
        laps=tuple(timetable.laps[robot] for robot in robots),
        counts=tuple(timetable.counts[robot] for robot in robots),
        enter=tuple(timetable.enter[robot] for robot in robots),
    )


def _insert_removed(
    problem: CyclicProblem,
    candidate: Candidate,
    counts: Sequence[int],
    removed: Sequence[int],
    period: int,
) -> Candidate | None:
    """Give the other robots their earliest times in a period; insert the removed robots."""
    bookings, cycles = problem.empty_bookings(period), dict[int, RobotCycle]()
    left = [robot for robot in range(len(problem)) if robot not in removed]
    if left:
        rest = problem.build_graph(_take_part(candidate.timetable, left)).compute_earliest(
            Tick(period)
        )
        rows = zip(left, rest.laps, rest.counts, rest.enter, strict=True)
        cycles = {robot: RobotCycle(lap, n, enter) for robot, lap, n, enter in rows}
    for robot, cycle in cycles.items():
        bookings.add(robot, cycle.lap, cycle.count, cycle.enter)
    for robot in problem.draw.sample(list(removed), len(removed)):
        placed = problem.place(bookings, robot, counts[robot])
        if placed is None:
            return None
        bookings.add(robot, placed.lap, placed.count, placed.enter)
        cycles[robot] = placed
    joined = [cycles[robot] for robot in range(len(problem))]
    return problem.make_candidate(problem.join_cycles(joined, period))
