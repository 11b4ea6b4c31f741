"""Repeated laps of any fleet, the slow way: all bookings round a circle of time."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations, product
from typing import NamedTuple

from rightofway.cyclic import CyclicResult
from rightofway.model import Lap, Scenario, Tick
from rightofway.precedence import CyclicSchedule
from tests.oracles.space import Shape, incompatible

SLOW = 400
"""Visits in a period for which this oracle is too slow."""


class Cycle(NamedTuple):
    """The visits of a robot in one period."""

    robot: int
    lap: Lap
    enter: tuple[int, ...]


class Booked(NamedTuple):
    shape: Shape
    start: int
    length: int


def cycles_of(timetable: CyclicSchedule) -> list[Cycle]:
    """Return the cycles of a timetable."""
    rows = zip(timetable.robots, timetable.laps, timetable.enter, strict=True)
    return [Cycle(robot, lap, tuple(enter.tolist())) for robot, lap, enter in rows]


def bookings(scenario: Scenario, cycle: Cycle, period: int) -> Iterator[Booked]:
    """Yield what a robot books in one period; without booking ahead, only where it stays."""
    headway, n = int(scenario.problem.booking_rules.headway), len(cycle.lap)
    ahead = scenario.problem.booking_rules.books_ahead
    leaves = [*cycle.enter[1:], cycle.enter[0] + period]
    for k, (enter, leave) in enumerate(zip(cycle.enter, leaves, strict=True)):
        here, there = cycle.lap.vertices[k % n], cycle.lap.vertices[(k + 1) % n]
        drive_in, drive_out = cycle.lap.drive[k % n], cycle.lap.drive[(k + 1) % n]
        approach = drive_in if ahead else 0
        yield Booked((here,), enter - approach, leave - enter + approach + headway)
        if ahead:
            yield Booked((here, there), leave - drive_out, drive_out + headway)


def is_kept(cycle: Cycle, period: int) -> bool:
    """Return whether no stay of a robot is too short."""
    leaves, n = [*cycle.enter[1:], cycle.enter[0] + period], len(cycle.lap)
    visits = enumerate(zip(cycle.enter, leaves, strict=True))
    return all(leave - enter >= cycle.lap.compute_least(k % n) for k, (enter, leave) in visits)


def overlap(one: Booked, other: Booked, period: int) -> bool:
    """Return whether two bookings overlap in some periods."""
    after = (other.start - one.start) % period
    return after < one.length or period - after < other.length


def conflicts(scenario: Scenario, cycles: Sequence[Cycle], period: int) -> set[tuple[int, int]]:
    """Return the pairs of robots with incompatible bookings that overlap."""
    booked = [list(bookings(scenario, cycle, period)) for cycle in cycles]
    return {
        (cycles[i].robot, cycles[j].robot)
        for i, j in combinations(range(len(cycles)), 2)
        for one, other in product(booked[i], booked[j])
        if overlap(one, other, period)
        and incompatible(scenario, cycles[i].robot, one.shape, cycles[j].robot, other.shape)
    }


def all_cycles(robot: int, lap: Lap, period: int, *, phases: Sequence[int]) -> Iterator[Cycle]:
    """Yield every way to make a lap in a period: all phases, and all waits."""
    spare = period - lap.duration
    for phase, waits in product(phases, product(range(spare + 1), repeat=len(lap) - 1)):
        if sum(waits) <= spare:
            enter = [phase]
            for k, wait in enumerate(waits):
                enter.append(enter[-1] + lap.compute_least(k) + wait)
            yield Cycle(robot, lap, tuple(enter))


def least_period(scenario: Scenario, laps: Sequence[Lap], most: int) -> int | None:
    """Return the least period in which two robots can make a lap each; None above a limit."""
    for period in range(max(lap.duration for lap in laps), most + 1):
        own, others = (
            [list(bookings(scenario, cycle, period)) for cycle in cycles]
            for cycles in (
                all_cycles(0, laps[0], period, phases=[0]),
                all_cycles(1, laps[1], period, phases=range(period)),
            )
        )
        # All cycles of a robot book the same shapes in the same order.
        pairs = [
            (k, m)
            for (k, one), (m, other) in product(enumerate(own[0]), enumerate(others[0]))
            if incompatible(scenario, 0, one.shape, 1, other.shape)
        ]
        for one, other in product(own, others):
            if not any(overlap(one[k], other[m], period) for k, m in pairs):
                return period
    return None


def load(scenario: Scenario, timetable: CyclicSchedule) -> int:
    """Return a lower bound of the period: the longest time that one place or zone is in use.

    Robots use it one after another. A robot uses it from when it enters, or where robots book ahead
    from the start of the drive in, until it leaves the last one of consecutive visits; each robot's
    use is followed by the headway at least once.
    """
    roadmap, headway = scenario.roadmap, int(scenario.problem.booking_rules.headway)
    ahead = scenario.problem.booking_rules.books_ahead
    cliques = [{vertex} for vertex in {int(v) for lap in timetable.laps for v in lap.vertices}] + [
        set(map(int, zone.vertices)) for zone in roadmap.zones
    ]
    most = max(
        n * int(lap.duration) for n, lap in zip(timetable.counts, timetable.laps, strict=True)
    )
    for clique in cliques:
        times = []
        for lap, count in zip(timetable.laps, timetable.counts, strict=True):
            inside = [int(vertex) in clique for vertex in lap.vertices]
            used = sum(
                lap.compute_least(k) + (lap.drive[k] if ahead and not inside[k - 1] else 0)
                for k in range(len(lap))
                if inside[k]
            )
            if used:
                times.append(count * used)
        if len(times) > 1:
            most = max(most, sum(times) + headway * len(times))
    return most


def check_periods(run: CyclicResult) -> None:
    """Check the timetable of each group, the bottleneck, and the earliest one of its orders."""
    for group in run.groups:
        graph, timetable = group.build_graph(), group.timetable
        if graph is None or timetable is None or sum(map(len, timetable.enter)) > SLOW:
            continue
        cycles, period = cycles_of(timetable), int(timetable.period)
        assert all(is_kept(cycle, period) for cycle in cycles)
        assert not conflicts(run.scenario, cycles, period)
        assert graph.compute_slack().min() >= 0
        critical = graph.find_critical_circuit().cycle_time
        assert load(run.scenario, timetable) <= critical <= period
        shortest = Tick(-(-critical.numerator // critical.denominator))
        earliest = cycles_of(graph.compute_earliest(shortest))
        assert all(is_kept(cycle, shortest) for cycle in earliest)
        assert not conflicts(run.scenario, earliest, shortest)
