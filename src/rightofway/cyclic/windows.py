"""Timetables cut out of a run: some laps of each robot, closed to a circle.

A run that does not repeat itself in any reasonable time still makes good use of the floor. Cut out
of it are the laps that the robots begin from some tick on and end within a period each, and the
order of their visits at each vertex is kept, round the seam as well. What that costs is known
exactly: it is the cycle time of these orders. Where robots would wait for each other for ever at
the seam, they keep their times instead, and who would overlap others there leaves out a lap or two.
A seam costs the same however long the window is, so a long one is
hardly worse than the run; among many short ones some are better.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise, product, zip_longest

import numpy as np
from numpy.typing import NDArray

from rightofway.cyclic.problem import Choice, CyclicProblem, Work
from rightofway.cyclic.result import GroupRun
from rightofway.errors import GaveUp
from rightofway.model import Lap
from rightofway.search import PeriodicBookings

__all__ = ["windows"]

LENGTHS = (1, 2, 4, 8, 16, 32, 64, 128, 256)
"""Windows are sorted by how long they are, in the longest laps alone."""

BEGINNINGS = 32
"""From how many ticks on windows of each length are looked at."""

CLOSED = {"value": 12, "calm": 4}
"""How many of these are closed, by what they are chosen for."""

MOST_VISITS = 200_000
"""Longer windows are left out."""

MOST_LEFT_OUT = 3
"""How many laps a robot may lose at a seam."""


@dataclass(frozen=True, slots=True)
class _Window:
    """From when on, and for how long."""

    begins: int
    period: int


@dataclass(frozen=True)
class _Watched:
    """A run and when its robots are home in it."""

    shift: CyclicProblem
    run: GroupRun

    @cached_property
    def homes(self) -> list[NDArray[np.int64]]:
        """For each robot the ticks at which it comes home; at first it is there."""
        laps = zip(self.run.history, self.run.group, strict=True)
        return [np.array(past[:: len(endless.lap)], np.int64) for past, endless in laps]

    @cached_property
    def known(self) -> int:
        """Until when all robots were watched."""
        return min(int(home[-1]) for home in self.homes)

    def first(self, place: int, begins: int) -> int:
        """Return the first lap of a robot that begins from a tick on; never the very first one."""
        return max(int(np.searchsorted(self.homes[place], begins)), 1)

    def part(self, place: int, window: _Window) -> _Part:
        """Return the laps that a robot makes in a window."""
        home, lap = self.homes[place], self.run.group[place].lap
        first = self.first(place, window.begins)
        last = int(np.searchsorted(home, home[first] + window.period, side="right")) - 1
        visits = self.run.history[place][first * len(lap) : last * len(lap) + 1]
        return _Part(lap, last - first, np.array(visits, np.int64) - window.begins)


def windows(shift: CyclicProblem, run: GroupRun) -> Iterator[Choice]:
    """Yield timetables cut out of a run, all that are possible; ends when time is over."""
    watched = _Watched(shift, run)
    for window in _promising(watched):
        try:
            shift.deadline.check("closing windows")
            found = _closed(watched, window)
        except GaveUp:
            return
        if found is not None:
            yield found


def _promising(watched: _Watched) -> list[_Window]:
    """Return windows of all lengths: first the best of each, then the second best, and so on."""
    longest, ranked = max(watched.shift.alone), []
    for least, most in pairwise(length * longest for length in LENGTHS):
        latest = watched.known - least
        if latest <= longest:
            break
        ticks = np.linspace(longest, latest, BEGINNINGS).astype(np.int64).tolist()
        candidates = (_Candidates(watched, tick, least, most) for tick in ticks)
        some = [one for one in candidates if one.fit.any()]
        for score, most_closed in CLOSED.items():
            best = sorted((one.best(score) for one in some), key=lambda found: -found[0])
            ranked.append(list(dict.fromkeys(window for _, window in best))[:most_closed])
    in_turn = (one for row in zip_longest(*reversed(ranked)) for one in row if one is not None)
    return list(dict.fromkeys(in_turn))


class _Candidates:
    """All the windows from a tick on that may end when one of the robots is home again.

    Attributes
    ----------
    fit
        Which of them are long enough, not too long, and known.
    value
        How many laps they have per tick (weighted).
    calm
        How little time, in all, robots wait at home for the end of the window: none at all where
        all are just as far as at its beginning. Below 0.
    """

    def __init__(self, watched: _Watched, begins: int, least: int, most: int) -> None:
        self._begins = begins
        shift, group = watched.shift, watched.run.group
        laps = [home[watched.first(k, begins) :] for k, home in enumerate(watched.homes)]
        parts = [(home[1:] - home[0])[home[1:] - home[0] <= most] for home in laps]
        sizes = [len(part) for part in parts]
        every = max((int(part[0]) if len(part) else most + 1 for part in parts), default=most + 1)
        ends = np.concatenate(parts)
        order = np.argsort(ends, kind="stable")
        self._ends = ends[order]
        visits = np.repeat([len(endless.lap) for endless in group], sizes)[order]
        weights = np.repeat([float(weight) for weight in shift.weights], sizes)[order]
        since = np.concatenate([part - np.append(0, part[:-1]) for part in parts])[order]
        self.fit = (self._ends >= max(least, every)) & (self._ends <= watched.known - begins)
        self.fit &= np.cumsum(visits) <= MOST_VISITS
        self.value = np.cumsum(weights) / self._ends
        self.calm = np.cumsum(since) / self._ends - len(parts)

    def best(self, score: str) -> tuple[float, _Window]:
        """Return the best by one of its scores, and how good it is."""
        scores = np.where(self.fit, getattr(self, score), -np.inf)
        best = int(np.argmax(scores))
        return float(scores[best]), _Window(self._begins, int(self._ends[best]))


def _closed(watched: _Watched, window: _Window) -> Choice | None:
    """Return the timetable of a window; None if some robot finds no place."""
    shift, period = watched.shift, window.period
    parts = [watched.part(place, window) for place in range(len(watched.homes))]
    for early in (True, False):
        works = [part.work(period, early=early) for part in parts]
        in_order = shift.closed(shift.timetable(works, period))
        if in_order is not None:
            return in_order
    return _joined(shift, parts, period)


@dataclass(frozen=True, slots=True, eq=False)
class _Part:
    """Some laps of a run: when visits begin, and when the robot is home again at the end."""

    lap: Lap
    count: int
    enter: NDArray[np.int64]

    def work(self, period: int, *, early: bool = True) -> Work:
        """Return the same on a circle.

        It comes home as early as it did at the end of the window, or as late as at its beginning.
        """
        enter = self.enter[:-1].copy()
        if early:
            enter[0] = self.enter[-1] - period
        return Work(self.lap, self.count, enter - enter[0] // period * period)

    def without(self, head: int, tail: int) -> _Part:
        """Return the same without some laps at the beginning and at the end."""
        n, count = len(self.lap), self.count - head - tail
        return _Part(self.lap, count, self.enter[head * n : (head + count) * n + 1])


def _joined(shift: CyclicProblem, parts: list[_Part], period: int) -> Choice | None:
    """Put all on the circle, with some laps less where they overlap; None if that is no help."""
    circle, works = shift.circle(period), {}
    # Robots that others pass at home cannot wait there as they like: they come first.
    users = Counter(vertex for part in parts for vertex in set(part.lap.vertices))
    for place in sorted(range(len(parts)), key=lambda place: -users[parts[place].lap.vertices[0]]):
        work = _added(circle, place, parts[place], period)
        if work is None:
            return None
        works[place] = work
    return shift.closed(shift.timetable([works[place] for place in range(len(parts))], period))


def _added(circle: PeriodicBookings, place: int, part: _Part, period: int) -> Work | None:
    """Leave laps out at the seam until a robot overlaps no other, and add it."""
    for less in range(min(MOST_LEFT_OUT + 1, part.count)):
        for head, early in product(range(less + 1), (True, False)):
            work = part.without(head, less - head).work(period, early=early)
            try:
                circle.add(place, work.lap, work.count, work.enter)
            except ValueError:
                continue
            return work
    return None
