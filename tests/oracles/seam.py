"""Ways through a seam, by trying every tick."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from rightofway.model import Lap


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
