"""Timetables that repeat, for tests: random laps on few vertices, in an order that takes place."""

from __future__ import annotations

import random

import numpy as np
from hypothesis import strategies as st

from rightofway.model import BookingRules, Lap, Tick
from rightofway.precedence import CyclicSchedule, TimedEventGraph
from rightofway.site import VertexId

__all__ = ["patterns", "random_timetable", "timetable_of"]


def timetable_of(laps: list[Lap], enter: list[list[int]], *, period: int) -> CyclicSchedule:
    """Return a timetable of robots 0, 1, …"""
    return CyclicSchedule(
        robots=tuple(range(len(laps))),
        laps=tuple(laps),
        counts=tuple(len(ticks) // len(lap) for lap, ticks in zip(laps, enter, strict=True)),
        period=Tick(period),
        enter=tuple(np.array(ticks, np.int64) for ticks in enter),
    )


def random_timetable(
    seed: int, *, robots: int, headway: int, books_ahead: bool, most_laps: int = 2
) -> CyclicSchedule:
    """Return laps that all pass one door, and when they do so in a random order without a deadlock.

    Robots move one at a time; whoever can, and is drawn, is next. All start and end at home.
    """
    draw = random.Random(seed)  # noqa: S311 (no secret depends on it)
    while True:
        laps = [_random_lap(draw, robot, robots) for robot in range(robots)]
        counts = [draw.randint(1, most_laps) for _ in laps]
        moves = _random_moves(draw, laps, counts)
        if moves is not None:
            return _timed(draw, laps, moves, headway=headway, books_ahead=books_ahead)


def _random_lap(draw: random.Random, robot: int, robots: int) -> Lap:
    """Return a lap from a home of its own through some of four shared vertices and the door."""
    door, shared = robots, range(robots + 1, robots + 5)
    way = draw.sample(shared, draw.randint(0, 3))
    way.insert(draw.randint(0, len(way)), door)
    back = way[-2::-1] if draw.random() < 0.5 else []
    n = 1 + len(way) + len(back)
    return Lap(
        vertices=tuple(VertexId(v) for v in (robot, *way, *back)),
        dwell=tuple(Tick(draw.choice((0, 0, 1, 7))) for _ in range(n)),
        drive=tuple(Tick(draw.randint(1, 3)) for _ in range(n)),
    )


def _random_moves(
    draw: random.Random, laps: list[Lap], counts: list[int]
) -> list[tuple[int, int]] | None:
    """Return (robot, visit) in an order in which all can be entered; None if that got stuck."""
    at, holder = [0] * len(laps), {robot: robot for robot in range(len(laps))}
    moves: list[tuple[int, int]] = []
    while True:
        left = [r for r, lap in enumerate(laps) if at[r] < counts[r] * len(lap)]
        if not left:
            return moves
        free = [r for r in left if laps[r].vertices[(at[r] + 1) % len(laps[r])] not in holder]
        if not free:
            return None
        robot = draw.choice(free)
        lap = laps[robot]
        del holder[lap.vertices[at[robot] % len(lap)]]
        at[robot] += 1
        holder[lap.vertices[at[robot] % len(lap)]] = robot
        moves.append((robot, at[robot]))


def _timed(
    draw: random.Random,
    laps: list[Lap],
    moves: list[tuple[int, int]],
    *,
    headway: int,
    books_ahead: bool,
) -> CyclicSchedule:
    """Give each move a time: as soon as it can, but not before the one that was drawn before it."""
    clock, left = 0, dict[int, int]()
    enter = [[0] for _ in laps]
    for robot, visit in moves:
        lap = laps[robot]
        here, there = lap.vertices[(visit - 1) % len(lap)], lap.vertices[visit % len(lap)]
        drive = lap.drive[visit % len(lap)]
        free = left.get(there, -100) + headway + (drive if books_ahead else 0)
        clock = max(clock, enter[robot][-1] + lap.compute_least((visit - 1) % len(lap)), free)
        left[here] = clock
        enter[robot].append(clock)
    period = clock + 100  # from the last to the first, whatever was booked is free again
    return _begun_anywhere(draw, laps, [[e[-1] - period, *e[1:-1]] for e in enter], period)


def _begun_anywhere(
    draw: random.Random, laps: list[Lap], enter: list[list[int]], period: int
) -> CyclicSchedule:
    """Let the period begin anywhere: the order goes round the circle."""
    shift = draw.randrange(period)
    moved = [[tick + shift for tick in ticks] for ticks in enter]
    return timetable_of(
        laps,
        [[tick - ticks[0] // period * period for tick in ticks] for ticks in moved],
        period=period,
    )


@st.composite
def patterns(draw: st.DrawFn) -> TimedEventGraph:
    """Two to five robots that all pass a door, under every rule, in an order that takes place."""
    headway, books_ahead = draw(st.sampled_from([0, 0, 1, 3])), draw(st.booleans())
    timetable = random_timetable(
        draw(st.integers(0, 10**9)),
        robots=draw(st.integers(2, 5)),
        headway=headway,
        books_ahead=books_ahead,
    )
    return TimedEventGraph(
        timetable, rules=BookingRules(headway=Tick(headway), books_ahead=books_ahead)
    )
