"""Timetables by going over all arcs until nothing changes, conflicts by looking at all pairs."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import accumulate, combinations, pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from rightofway._core import CONFLICT_CAP, BookingRules, PrecedenceGraph, Routes
from rightofway.model import NEVER

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

VERTEX, SWAP = 0, 1


class Right(NamedTuple):
    """Visit ``first`` leaves the vertex before visit ``second`` enters it."""

    first: int
    second: int


class Arc(NamedTuple):
    """The enter of ``head`` is at least that of ``tail`` plus ``length``."""

    tail: int
    head: int
    length: int


class Conflict(NamedTuple):
    """In the order in which conflicts are compared."""

    tick: int
    robot_a: int
    robot_b: int
    visit_a: int
    visit_b: int
    kind: int
    weight: int

    def as_tuple(self) -> tuple[int, int, int, int]:
        """Return what the kernel would."""
        return self.tick, self.kind, self.visit_a, self.visit_b


@dataclass(frozen=True, kw_only=True)
class System:
    """Routes, and the rules for what a visit books."""

    routes: tuple[tuple[int, ...], ...]
    least: tuple[int, ...]
    approach: tuple[int, ...]
    headway: int = 0
    swaps_conflict: bool = True
    active: tuple[bool, ...]

    @cached_property
    def first_visit(self) -> list[int]:
        """Where each robot's visits begin, and where all end."""
        return list(accumulate((len(route) for route in self.routes), initial=0))

    @cached_property
    def vertex(self) -> list[int]:
        """Where each visit is."""
        return [vertex for route in self.routes for vertex in route]

    @cached_property
    def robot(self) -> list[int]:
        """Whose each visit is."""
        return [r for r, route in enumerate(self.routes) for _ in route]

    def is_first(self, visit: int) -> bool:
        """Return whether the robot starts with this visit."""
        return visit in self.first_visit

    def is_last(self, visit: int) -> bool:
        """Return whether the robot stays at this visit for ever."""
        return visit + 1 in self.first_visit

    def kernel(self) -> PrecedenceGraph:
        """Return the native kernel for this system."""
        ends = [self.is_last(visit) for visit in range(len(self.vertex))]
        drives = [0 if end else self.approach[x + 1] for x, end in enumerate(ends)]
        dwells = [least - drive for least, drive in zip(self.least, drives, strict=True)]
        graph = PrecedenceGraph(
            BookingRules(self.headway, True),
            Routes(
                np.array(self.first_visit, np.int32),
                np.array(self.vertex, np.int32),
                np.array(dwells, np.int64),
                np.array(self.approach, np.int64),
            ),
            self.swaps_conflict,
        )
        for robot, is_active in enumerate(self.active):
            if not is_active:
                graph.withdraw(robot)
        return graph


def arcs(system: System, rights: Sequence[Right]) -> list[Arc]:
    """Return everything that makes one enter wait for another."""
    visits = range(len(system.vertex))
    progress = [Arc(x, x + 1, system.least[x]) for x in visits if not system.is_last(x)]
    waits = [Arc(a + 1, b, system.headway + system.approach[b]) for a, b in rights]
    return progress + waits


def enters(system: System, rights: Sequence[Right]) -> list[int] | None:
    """Return the earliest times by Bellman and Ford, None if a cycle of positive length forbids."""
    enter = [0] * len(system.vertex)
    everything = arcs(system, rights)
    for _ in range(len(enter) + 1):
        before = list(enter)
        for tail, head, length in everything:
            enter[head] = max(enter[head], enter[tail] + length)
        if enter == before:
            return enter
    return None


def is_possible(system: System, rights: Sequence[Right], right: Right) -> bool:
    """Return whether the fleet can still move if this right of way is given as well."""
    if system.is_last(right.first) or system.is_first(right.second):
        return False
    if enters(system, [*rights, right]) is None:
        return False
    opposite = Right(right.second - 1, right.first + 1)
    gaps = system.headway + system.approach[right.second] + system.approach[right.first + 1]
    return not (system.swaps_conflict and opposite in rights and gaps == 0)


def conflicts(system: System, enter: Sequence[int]) -> list[Conflict]:
    """Return all conflicts, the earliest first."""
    pairs = [
        (x, y)
        for x, y in combinations(range(len(enter)), 2)
        if system.robot[x] != system.robot[y]
        and system.active[system.robot[x]]
        and system.active[system.robot[y]]
    ]
    vertex_conflicts = [c for x, y in pairs for c in _overlap(system, enter, x, y)]
    return sorted(vertex_conflicts + [c for x, y in pairs for c in _swap(system, enter, x, y)])


def _booking(system: System, enter: Sequence[int], x: int) -> tuple[int, int]:
    end = NEVER if system.is_last(x) else enter[x + 1] + system.headway
    return enter[x] - system.approach[x], end


def _overlap(system: System, enter: Sequence[int], x: int, y: int) -> Iterator[Conflict]:
    if system.vertex[x] != system.vertex[y]:
        return
    (x_start, x_end), (y_start, y_end) = _booking(system, enter, x), _booking(system, enter, y)
    start, end = max(x_start, y_start), min(x_end, y_end)
    if start < end:
        robots = system.robot[x], system.robot[y]
        yield Conflict(start, *robots, x, y, VERTEX, min(end - start, CONFLICT_CAP))


def _swap(system: System, enter: Sequence[int], x: int, y: int) -> Iterator[Conflict]:
    """Visits x and y are entered from each other's vertex at one instant."""
    if not system.swaps_conflict or system.is_first(x) or system.is_first(y):
        return
    exchange = (
        system.vertex[x - 1] == system.vertex[y]
        and system.vertex[y - 1] == system.vertex[x]
        and enter[x] == enter[y]
    )
    if exchange and not [
        *_overlap(system, enter, x - 1, y),
        *_overlap(system, enter, x, y - 1),
    ]:
        yield Conflict(enter[x], system.robot[x], system.robot[y], x, y, SWAP, 1)


def length_of_cycle(system: System, rights: Sequence[Right], cycle: Sequence[int]) -> int | None:
    """Return the length of the longest arcs round the cycle, None if one is missing."""
    longest: dict[tuple[int, int], int] = {}
    for tail, head, length in arcs(system, rights):
        longest[tail, head] = max(length, longest.get((tail, head), length))
    steps = list(pairwise([*cycle, cycle[0]]))
    if any(step not in longest for step in steps):
        return None
    return sum(longest[step] for step in steps)
