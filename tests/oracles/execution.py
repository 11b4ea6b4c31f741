"""An execution, tick by tick: robots on vertices, each asking whether it may drive.

Nothing here uses longest paths, or an order in which events can take place. A robot that is done
looks whether the next vertex is empty, whether the visit before its own is over, and whether the
headway is over. Where robots wait for each other in a cycle, and bookings allow it, they go all at
once. The execution ends when no robot moves and none will.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import combinations

NEVER = 2**62

Stoppage = tuple[int, int]


@dataclass(kw_only=True)
class Orders:
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
    stoppages: Sequence[Sequence[Stoppage]]

    def __post_init__(self) -> None:
        self.robots = range(len(self.first_visit) - 1)
        self.last = [end - 1 for end in self.first_visit[1:]]
        self.robot = [
            robot for robot in self.robots for _ in range(*self.first_visit[robot : robot + 2])
        ]


@dataclass(kw_only=True)
class Times:
    enter: list[int]
    start: list[int]
    completion: list[int]


@dataclass(kw_only=True)
class _Robot:
    visit: int
    phase: str  # busy, waits, drives, done
    left: int
    stoppages: list[Stoppage] = field(default_factory=list)

    def stands_at(self, tick: int) -> bool:
        return any(begin < tick < begin + ticks for begin, ticks in self.stoppages)

    def stands_after(self, tick: int) -> bool:
        return any(begin <= tick < begin + ticks for begin, ticks in self.stoppages)


class _Run:
    def __init__(self, orders: Orders) -> None:
        self.orders = orders
        count = len(orders.vertex)
        self.tick = 0
        self.enter, self.start, self.leave = [NEVER] * count, [NEVER] * count, [NEVER] * count
        self.completion = [NEVER] * len(orders.robots)
        self.robots = [
            _Robot(visit=first, phase="busy", left=0, stoppages=list(own))
            for first, own in zip(orders.first_visit, orders.stoppages, strict=False)
        ]
        for robot in orders.robots:
            self.arrive(robot, orders.first_visit[robot])
            self.start[orders.first_visit[robot]] = 0

    def arrive(self, robot: int, visit: int) -> None:
        orders, state = self.orders, self.robots[robot]
        state.visit, state.phase, self.enter[visit] = visit, "busy", self.tick
        state.left = orders.dwell[visit]
        if visit != orders.last[robot] and not orders.books_ahead:
            state.left += orders.drive[visit + 1]

    def is_free(self, visit: int, leaving: set[int]) -> bool:
        """Tell whether a robot may have its next vertex, if those robots leave theirs now."""
        orders = self.orders
        if self.tick < orders.since[visit]:
            return False
        earlier = orders.before[visit]
        at_once = orders.headway == 0 and not orders.books_ahead
        if earlier >= 0:
            leaves = orders.robot[earlier] in leaving and at_once
            leaves &= self.robots[orders.robot[earlier]].visit == earlier
            is_own = orders.robot[earlier] == orders.robot[visit]
            headway = 0 if is_own else orders.headway
            if not leaves and self.leave[earlier] + headway > self.tick:
                return False
        here = orders.vertex[visit]
        inside = [
            robot
            for robot in orders.robots
            if robot != orders.robot[visit]
            and here in self.held_by(robot)
            and not (at_once and robot in leaving)
        ]
        return not inside

    def held_by(self, robot: int) -> list[int]:
        state, vertex = self.robots[robot], self.orders.vertex
        ahead = [vertex[state.visit + 1]] if state.phase == "drives" else []
        return [vertex[state.visit], *ahead]

    def move_all(self) -> None:
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
            elif state.visit == self.orders.last[robot]:
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
        if self.orders.books_ahead:  # one after the other, so that nobody takes what another took
            going = set(sorted(going)[:1])
        for robot in going:
            self.leave[self.robots[robot].visit] = self.tick
        for robot in going:
            self.go(robot)
        return bool(going)

    def go(self, robot: int) -> None:
        state = self.robots[robot]
        self.start[state.visit + 1] = self.tick
        if self.orders.books_ahead:
            self.leave[state.visit] = NEVER
            state.phase, state.left = "drives", self.orders.drive[state.visit + 1]
        else:
            self.arrive(robot, state.visit + 1)

    def pass_a_tick(self) -> None:
        for state in self.robots:
            if state.left and not state.stands_after(self.tick):
                state.left -= 1
        self.tick += 1

    def is_over(self) -> bool:
        for state in self.robots:
            if state.left and not any(b <= self.tick and t >= NEVER for b, t in state.stoppages):
                return False
            if any(self.tick <= begin + ticks < NEVER for begin, ticks in state.stoppages):
                return False
        recent = [leave for leave in self.leave if leave < NEVER]
        return self.tick > max(max(recent, default=0) + self.orders.headway, *self.orders.since) + 1


def by_right_of_way(orders: Orders) -> Times:
    """Let robots go when they may."""
    run = _Run(orders)
    run.move_all()
    while not run.is_over():
        run.pass_a_tick()
        run.move_all()
    return Times(enter=run.enter, start=run.start, completion=run.completion)


def by_clock(orders: Orders) -> Times:
    """Let each robot keep its planned times; nobody looks."""
    count = len(orders.vertex)
    times = Times(
        enter=[NEVER] * count, start=[NEVER] * count, completion=[NEVER] * len(orders.robots)
    )
    for robot in orders.robots:
        _alone(orders, robot, times)
    return times


def _alone(orders: Orders, robot: int, times: Times) -> None:
    stoppages = orders.stoppages[robot]
    visit, tick = orders.first_visit[robot], 0
    times.enter[visit] = times.start[visit] = 0
    while visit < orders.last[robot] and tick < NEVER:
        planned = orders.planned[visit + 1]
        done = _after(tick, orders.dwell[visit], stoppages)
        depart = _not_before(done, planned - orders.nominal_drive[visit + 1], stoppages)
        arrive = _after(depart, orders.drive[visit + 1], stoppages)
        tick = _not_before(arrive, planned, stoppages)
        visit += 1
        times.enter[visit] = tick
        times.start[visit] = depart if orders.books_ahead else tick
    times.completion[robot] = _after(tick, orders.dwell[visit], stoppages)


def _after(tick: int, work: int, stoppages: Sequence[Stoppage]) -> int:
    """Return when so much is done, tick by tick."""
    while work and tick < NEVER:
        if any(begin <= tick and ticks >= NEVER for begin, ticks in stoppages):
            return NEVER
        work -= not any(begin <= tick < begin + ticks for begin, ticks in stoppages)
        tick += 1
    return tick


def _not_before(tick: int, planned: int, stoppages: Sequence[Stoppage]) -> int:
    """Return when a robot goes on that is done at a tick and meant to wait."""
    tick = max(tick, planned)
    while tick < NEVER and any(begin < tick < begin + ticks for begin, ticks in stoppages):
        if any(begin < tick and ticks >= NEVER for begin, ticks in stoppages):
            return NEVER
        tick += 1
    return tick


def collisions(orders: Orders, times: Times) -> tuple[int, int, int, int]:
    """Return overlapping visits, those that overlap by the headway only, swaps, the first tick."""
    found = [0, 0, 0]
    first = NEVER
    for kind, tick in _collisions(orders, times):
        found[kind] += 1
        first = min(first, tick)
    return found[0], found[1], found[2], first


def _collisions(orders: Orders, times: Times) -> Iterator[tuple[int, int]]:
    def leave(visit: int) -> int:
        return NEVER if visit in orders.last else times.enter[visit + 1]

    for one, other in combinations(range(len(orders.vertex)), 2):
        if orders.robot[one] == orders.robot[other]:
            continue
        if orders.vertex[one] == orders.vertex[other]:
            begin = max(times.start[one], times.start[other])
            end = min(leave(one), leave(other))
            if begin < NEVER and begin < end + orders.headway:
                yield int(begin >= end), begin
        elif one not in orders.first_visit and other not in orders.first_visit:
            there = orders.vertex[one] == orders.vertex[other - 1]
            back = orders.vertex[one - 1] == orders.vertex[other]
            if there and back and times.enter[one] == times.enter[other] < NEVER:
                yield 2, times.enter[one]
