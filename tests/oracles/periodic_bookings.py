"""Visits among bookings, by trying every tick; and whether a schedule keeps every rule."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import cache
from itertools import combinations
from typing import NamedTuple

import numpy as np

from rightofway.model import Itinerary, Lap, compute_drives_along
from rightofway.precedence import CyclicSchedule
from rightofway.site import Roadmap


def bookings(
    lap: Lap, enter: Sequence[int], period: int, *, headway: int, books_ahead: bool
) -> list[tuple[int, int, int]]:
    """Return (vertex, start, end) of all visits of one period."""
    times = [*enter, enter[0] + period]
    return [
        (
            lap.vertices[k % len(lap)],
            times[k] - (lap.drive[k % len(lap)] if books_ahead else 0),
            times[k + 1] + headway,
        )
        for k in range(len(enter))
    ]


def faults(timetable: CyclicSchedule, *, headway: int, books_ahead: bool) -> list[str]:
    """Return what is wrong in a timetable: drives too fast, overlaps, swaps; over three periods."""
    period = int(timetable.period)
    found = []
    for lap, count, enter in zip(timetable.laps, timetable.counts, timetable.enter, strict=True):
        times = [*enter.tolist(), int(enter[0]) + period]
        if len(enter) != count * len(lap) or not 0 <= times[0] < period:
            found.append("visits do not fit the laps")
        found += [
            f"too fast at visit {k}"
            for k in range(len(enter))
            if times[k + 1] - times[k] < lap.compute_least(k % len(lap))
        ]
    for one, other in combinations(range(len(timetable.laps)), 2):
        found += _meetings(timetable, one, other, headway=headway, books_ahead=books_ahead)
    return found


def _meetings(
    timetable: CyclicSchedule, one: int, other: int, *, headway: int, books_ahead: bool
) -> list[str]:
    period = int(timetable.period)
    own, others = (
        bookings(
            timetable.laps[robot],
            timetable.enter[robot].tolist(),
            period,
            headway=headway,
            books_ahead=books_ahead,
        )
        for robot in (one, other)
    )
    found = []
    for shift in range(-3 * period, 4 * period, period):
        for vertex, start, end in own:
            found += [
                f"{one} and {other} at {vertex}"
                for where, begins, ends in others
                if where == vertex and begins + shift < end and start < ends + shift
            ]
        found += _swaps(timetable, one, other, shift)
    return found


def _swaps(timetable: CyclicSchedule, one: int, other: int, shift: int) -> list[str]:
    moves = [_moves(timetable, robot) for robot in (one, other)]
    there = {(tick + shift, head, tail) for tick, tail, head in moves[1]}
    return [f"{one} and {other} swap at {move[0]}" for move in moves[0] if move in there]


def _moves(timetable: CyclicSchedule, robot: int) -> list[tuple[int, int, int]]:
    lap, enter = timetable.laps[robot], timetable.enter[robot].tolist()
    return [
        (tick, lap.vertices[(k - 1) % len(lap)], lap.vertices[k % len(lap)])
        for k, tick in enumerate(enter)
    ]


def can_close(lap: Lap, others: CyclicSchedule, *, headway: int, books_ahead: bool) -> bool:
    """Tell whether one lap fits in among others, by trying all starts and all waits, tick by tick.

    The robot's state is (visit, ticks since it entered it, up to what it needs there); it must be
    home again, in its first visit, when the period is over.
    """
    period = int(others.period)
    free, comes = _taken(others, headway=headway, books_ahead=books_ahead)
    return any(
        _closes(lap, start, period, free, comes, headway=headway, books_ahead=books_ahead)
        for start in range(period)
    )


def _taken(
    others: CyclicSchedule, *, headway: int, books_ahead: bool
) -> tuple[Callable[[int, int, int], bool], set[tuple[int, int, int]]]:
    """Return whether a vertex is free from one tick to another, and who moves when from where."""
    period = int(others.period)
    booked: dict[int, set[int]] = {}
    comes: set[tuple[int, int, int]] = set()
    for robot, one in enumerate(others.laps):
        enter = others.enter[robot].tolist()
        for vertex, start, end in bookings(
            one, enter, period, headway=headway, books_ahead=books_ahead
        ):
            booked.setdefault(vertex, set()).update(t % period for t in range(start, end))
        comes.update((t % period, a, b) for t, a, b in _moves(others, robot))

    is_free_for = {vertex: _free_ticks(ticks, period) for vertex, ticks in booked.items()}

    def free(vertex: int, first: int, end: int) -> bool:
        return vertex not in is_free_for or end - first <= is_free_for[vertex][first % period]

    return free, comes


def _free_ticks(booked: set[int], period: int) -> list[int]:
    """Return how many ticks from each tick on are free, where some tick is booked."""
    free = [0] * period
    for tick in reversed(range(2 * period)):  # the second time, what follows the end is known
        free[tick % period] = 0 if tick % period in booked else free[(tick + 1) % period] + 1
    return free


def has_a_route(
    itinerary: Itinerary,
    roadmap: Roadmap,
    others: CyclicSchedule,
    *,
    headway: int,
    books_ahead: bool,
) -> bool:
    """Tell whether one lap fits in among others on any way, by trying all ways tick by tick.

    The last stage of the itinerary is at home and the one before it is not. A robot that turns
    begins a lap with the heading with which it ends.
    """
    period, home = int(others.period), itinerary.home
    free, comes = _taken(others, headway=headway, books_ahead=books_ahead)
    turn = itinerary.stages[-1].work + itinerary.stages[-1].turn

    @cache
    def drive_of(tail: int, head: int) -> int:
        return compute_drives_along(roadmap, itinerary, [tail, head])[0]

    def steps(state: _State, dwell: int, end: int) -> Iterator[_State]:
        """Yield all that may follow a visit that lasts so long at least and is left by the end."""
        vertex, stage, enter, before = state
        for edge in range(int(roadmap.indptr[vertex]), int(roadmap.indptr[vertex + 1])):
            head = int(roadmap.heads[edge])
            drive = drive_of(vertex, head)
            ahead = drive if books_ahead else 0
            turns = itinerary.turning.compute_turn(before, edge) if itinerary.turning else 0
            for leave in range(enter + dwell + turns + drive, end + 1):
                if not free(vertex, enter, leave + headway):
                    break
                swaps = (leave % period, head, vertex) in comes and not headway and not ahead
                if free(head, leave - ahead, leave + 1 + headway) and not swaps:
                    yield head, stage, leave, edge if itinerary.turning else -1
        following = itinerary.stages[stage]
        if stage < len(itinerary.stages) - 1 and following.vertex == vertex:
            longer = dwell + following.work + following.turn
            yield from steps((vertex, stage + 1, enter, before), longer, end)

    def closes(start: int, heading: int) -> bool:
        last, end = len(itinerary.stages) - 1, start + period
        states = _reached(
            steps((home, 0, start, heading), turn, end),
            lambda state: steps(state, 0, end),
        )
        # At home again it waits there.
        return free(home, start, start + 1 + headway) and any(
            (vertex, stage, edge) == (home, last, heading) and free(home, enter, end + 1 + headway)
            for vertex, stage, enter, edge in states
        )

    headings = np.flatnonzero(roadmap.heads == home).tolist() if itinerary.turning else [-1]
    return any(closes(start, heading) for start in range(period) for heading in headings)


_State = tuple[int, int, int, int]


def _reached(first: Iterable[_State], steps: Callable[[_State], Iterable[_State]]) -> set[_State]:
    """Return all states that some steps lead to."""
    known = set(first)
    todo = list(known)
    while todo:
        new = set(steps(todo.pop())) - known
        known |= new
        todo += new
    return known


def _closes(
    lap: Lap,
    start: int,
    period: int,
    free: Callable[[int, int, int], bool],
    comes: set[tuple[int, int, int]],
    *,
    headway: int,
    books_ahead: bool,
) -> bool:
    """Tell whether a robot that enters its home at this tick can do so again a period later."""
    n = len(lap)
    drives = [lap.drive[k] if books_ahead else 0 for k in range(n)]
    at = {start} if free(lap.vertices[0], start - drives[0], start + 1 + headway) else set()
    for k in range(n):
        here, then = lap.vertices[k], (k + 1) % n
        later = set()
        for enter in at:
            for leave in range(enter + lap.compute_least(k), start + period + 1):
                if not free(here, enter, leave + headway):
                    break
                fits = free(lap.vertices[then], leave - drives[then], leave + 1 + headway)
                swaps = (leave % period, lap.vertices[then], here) in comes
                if fits and not (swaps and not headway and not books_ahead):
                    later.add(leave)
        at = later
    return start + period in at


class Visit(NamedTuple):
    """A robot is at a vertex."""

    robot: int
    vertex: int
    enter: int
    leave: int


class Booked(NamedTuple):
    """A vertex is a robot's for ``[start, end)``."""

    robot: int
    vertex: int
    start: int
    end: int


def _is_free(booked: Sequence[Booked], vertex: int, start: int, end: int) -> bool:
    return all(one.vertex != vertex or one.end <= start or end <= one.start for one in booked)


def earliest(
    lap: Lap,
    count: int,
    booked: Sequence[Booked],
    *,
    begins: int,
    until: int,
    leave: int,
    headway: int,
    books_ahead: bool,
) -> int | None:
    """Return when a robot can be home again, by a search over all ticks; None if it cannot."""
    n, steps = len(lap), len(lap) * count
    at = {begins}  # all ticks at which it can enter the present visit
    for step in range(steps + 1):
        here = step % n
        approach = lap.drive[here] if books_ahead else 0
        vertex = lap.vertices[here]
        if step == steps:
            fits = [
                tick
                for tick in at
                if tick <= until and _is_free(booked, vertex, tick - approach, leave + headway)
            ]
            return min(fits, default=None)
        following = (step + 1) % n
        least = lap.dwell[here] + lap.drive[following]
        then = set()
        for tick in at:
            for out in range(tick + least, until + 1):
                if not _is_free(booked, vertex, tick - approach, out + headway):
                    break
                then.add(out)
        at = then
    raise AssertionError("the last visit returns")


def fits(
    lap: Lap,
    enter: Sequence[int],
    booked: Sequence[Booked],
    leave: int,
    *,
    headway: int,
    books_ahead: bool,
) -> bool:
    """Tell whether visits are as long as they have to be, and nobody is in the way."""
    n = len(lap)
    for visit, tick in enumerate(enter):
        here = visit % n
        approach = lap.drive[here] if books_ahead else 0
        end = enter[visit + 1] if visit + 1 < len(enter) else leave
        if visit + 1 < len(enter) and end - tick < lap.dwell[here] + lap.drive[(visit + 1) % n]:
            return False
        if not _is_free(booked, lap.vertices[here], tick - approach, end + headway):
            return False
    return True
