"""A late floor, tick by tick: robots on vertices, each asking whether it may go on.

Nothing here knows of longest paths, or of an order in which events can take place. A robot that is
done looks whether the next vertex is empty, whether whoever goes there before it has been there,
and whether the headway is over. Where robots wait for each other round a circle, and bookings allow
it, they go all at once. When nobody moves any more and nobody will, the floor stands still.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import combinations

NEVER = 2**62

Standstill = tuple[int, int]


@dataclass(kw_only=True)
class Floor:
    """Visits of one robot behind those of another, as the kernel has them."""

    first_visit: Sequence[int]
    vertex: Sequence[int]
    planned: Sequence[int]
    nominal_drive: Sequence[int]
    before: Sequence[int]
    since: Sequence[int]
    headway: int
    books_ahead: bool
    dwell: Sequence[int]
    drive: Sequence[int]
    standstills: Sequence[Sequence[Standstill]]

    def __post_init__(self) -> None:
        self.robots = range(len(self.first_visit) - 1)
        self.last = [end - 1 for end in self.first_visit[1:]]
        self.robot = [
            robot for robot in self.robots for _ in range(*self.first_visit[robot : robot + 2])
        ]


@dataclass(kw_only=True)
class Happened:
    enter: list[int]
    start: list[int]
    completion: list[int]


@dataclass(kw_only=True)
class _Robot:
    visit: int
    phase: str  # busy, waits, drives, done
    left: int
    standing: list[Standstill] = field(default_factory=list)

    def stands_at(self, tick: int) -> bool:
        return any(begin < tick < begin + ticks for begin, ticks in self.standing)

    def stands_after(self, tick: int) -> bool:
        return any(begin <= tick < begin + ticks for begin, ticks in self.standing)


class _Run:
    def __init__(self, floor: Floor) -> None:
        self.floor = floor
        count = len(floor.vertex)
        self.tick = 0
        self.enter, self.start, self.leave = [NEVER] * count, [NEVER] * count, [NEVER] * count
        self.completion = [NEVER] * len(floor.robots)
        self.robots = [
            _Robot(visit=first, phase="busy", left=0, standing=list(standing))
            for first, standing in zip(floor.first_visit, floor.standstills, strict=False)
        ]
        for robot in floor.robots:
            self.arrive(robot, floor.first_visit[robot])
            self.start[floor.first_visit[robot]] = 0

    def arrive(self, robot: int, visit: int) -> None:
        floor, state = self.floor, self.robots[robot]
        state.visit, state.phase, self.enter[visit] = visit, "busy", self.tick
        state.left = floor.dwell[visit]
        if visit != floor.last[robot] and not floor.books_ahead:
            state.left += floor.drive[visit + 1]

    def is_free(self, visit: int, leaving: set[int]) -> bool:
        """Tell whether a robot may have its next vertex, if those robots leave theirs now."""
        floor = self.floor
        if self.tick < floor.since[visit]:
            return False
        earlier = floor.before[visit]
        at_once = floor.headway == 0 and not floor.books_ahead
        if earlier >= 0:
            leaves = floor.robot[earlier] in leaving and at_once
            leaves &= self.robots[floor.robot[earlier]].visit == earlier
            if not leaves and self.leave[earlier] + floor.headway > self.tick:
                return False
        here = floor.vertex[visit]
        inside = [
            robot
            for robot in floor.robots
            if robot != floor.robot[visit]
            and here in self.held_by(robot)
            and not (at_once and robot in leaving)
        ]
        return not inside

    def held_by(self, robot: int) -> list[int]:
        state, vertex = self.robots[robot], self.floor.vertex
        ahead = [vertex[state.visit + 1]] if state.phase == "drives" else []
        return [vertex[state.visit], *ahead]

    def settle(self) -> None:
        while any([self.finish(), self.set_off()]):
            pass

    def finish(self) -> bool:
        changed = False
        for robot, state in enumerate(self.robots):
            if state.left or state.phase not in {"busy", "drives"} or state.stands_at(self.tick):
                continue
            changed = True
            if state.phase == "drives":
                self.leave[state.visit] = self.tick
                self.arrive(robot, state.visit + 1)
            elif state.visit == self.floor.last[robot]:
                state.phase, self.completion[robot] = "done", self.tick
            else:
                state.phase = "waits"
        return changed

    def set_off(self) -> bool:
        going = {
            robot
            for robot, state in enumerate(self.robots)
            if state.phase == "waits" and not state.stands_at(self.tick)
        }
        while blocked := {r for r in going if not self.is_free(self.robots[r].visit + 1, going)}:
            going -= blocked
        if self.floor.books_ahead:  # one after the other, so that nobody takes what another took
            going = set(sorted(going)[:1])
        for robot in going:
            self.leave[self.robots[robot].visit] = self.tick
        for robot in going:
            self.go(robot)
        return bool(going)

    def go(self, robot: int) -> None:
        state = self.robots[robot]
        self.start[state.visit + 1] = self.tick
        if self.floor.books_ahead:
            self.leave[state.visit] = NEVER
            state.phase, state.left = "drives", self.floor.drive[state.visit + 1]
        else:
            self.arrive(robot, state.visit + 1)

    def pass_a_tick(self) -> None:
        for state in self.robots:
            if state.left and not state.stands_after(self.tick):
                state.left -= 1
        self.tick += 1

    def is_over(self) -> bool:
        for state in self.robots:
            if state.left and not any(b <= self.tick and t >= NEVER for b, t in state.standing):
                return False
            if any(self.tick <= begin + ticks < NEVER for begin, ticks in state.standing):
                return False
        recent = [leave for leave in self.leave if leave < NEVER]
        return self.tick > max(max(recent, default=0) + self.floor.headway, *self.floor.since) + 1


def by_right_of_way(floor: Floor) -> Happened:
    """Let robots go when they may."""
    run = _Run(floor)
    run.settle()
    while not run.is_over():
        run.pass_a_tick()
        run.settle()
    return Happened(enter=run.enter, start=run.start, completion=run.completion)


def by_clock(floor: Floor) -> Happened:
    """Let each robot keep its planned times; nobody looks."""
    count = len(floor.vertex)
    happened = Happened(
        enter=[NEVER] * count, start=[NEVER] * count, completion=[NEVER] * len(floor.robots)
    )
    for robot in floor.robots:
        _alone(floor, robot, happened)
    return happened


def _alone(floor: Floor, robot: int, happened: Happened) -> None:
    standing = floor.standstills[robot]
    visit, tick = floor.first_visit[robot], 0
    happened.enter[visit] = happened.start[visit] = 0
    while visit < floor.last[robot] and tick < NEVER:
        planned = floor.planned[visit + 1]
        done = _after(tick, floor.dwell[visit], standing)
        depart = _not_before(done, planned - floor.nominal_drive[visit + 1], standing)
        arrive = _after(depart, floor.drive[visit + 1], standing)
        tick = _not_before(arrive, planned, standing)
        visit += 1
        happened.enter[visit] = tick
        happened.start[visit] = depart if floor.books_ahead else tick
    happened.completion[robot] = _after(tick, floor.dwell[visit], standing)


def _after(tick: int, work: int, standing: Sequence[Standstill]) -> int:
    """Return when so much is done, tick by tick."""
    while work and tick < NEVER:
        if any(begin <= tick and ticks >= NEVER for begin, ticks in standing):
            return NEVER
        work -= not any(begin <= tick < begin + ticks for begin, ticks in standing)
        tick += 1
    return tick


def _not_before(tick: int, planned: int, standing: Sequence[Standstill]) -> int:
    """Return when a robot goes on that is done at a tick and meant to wait."""
    tick = max(tick, planned)
    while tick < NEVER and any(begin < tick < begin + ticks for begin, ticks in standing):
        if any(begin < tick and ticks >= NEVER for begin, ticks in standing):
            return NEVER
        tick += 1
    return tick


def collisions(floor: Floor, happened: Happened) -> tuple[int, int, int, int]:
    """Return overlapping visits, those that overlap by the headway only, swaps, the first tick."""
    found = [0, 0, 0]
    first = NEVER
    for kind, tick in _collisions(floor, happened):
        found[kind] += 1
        first = min(first, tick)
    return found[0], found[1], found[2], first


def _collisions(floor: Floor, happened: Happened) -> Iterator[tuple[int, int]]:
    def leave(visit: int) -> int:
        return NEVER if visit in floor.last else happened.enter[visit + 1]

    for one, other in combinations(range(len(floor.vertex)), 2):
        if floor.robot[one] == floor.robot[other]:
            continue
        if floor.vertex[one] == floor.vertex[other]:
            begin = max(happened.start[one], happened.start[other])
            end = min(leave(one), leave(other))
            if begin < NEVER and begin < end + floor.headway:
                yield int(begin >= end), begin
        elif one not in floor.first_visit and other not in floor.first_visit:
            there = floor.vertex[one] == floor.vertex[other - 1]
            back = floor.vertex[one - 1] == floor.vertex[other]
            if there and back and happened.enter[one] == happened.enter[other] < NEVER:
                yield 2, happened.enter[one]
