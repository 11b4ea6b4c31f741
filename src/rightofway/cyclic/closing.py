"""A long stretch of a run, closed to a circle: most of it stays as it was, and costs nothing.

Far from the seam all robots do what they did in the run, so that needs no proof. At the seam each
waits at home, from its last lap before it until its first lap after it, or makes as many laps more
as there is room for; laps that end or begin there may be given up for that. Where others pass a
home while its robot would wait there, that robot has to find its way first, and robots that only
wait make room for it.

What that costs is less than half a lap of each robot on average, however long the stretch is: no
robot makes a part of a lap. So the more laps the stretch has, the less it is below the run.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import product
from time import monotonic

import numpy as np
from numpy.typing import NDArray

from rightofway.cyclic.problem import CyclicProblem, Work
from rightofway.cyclic.result import GroupRun
from rightofway.cyclic.visit_times import VisitTimes
from rightofway.model import Lap, VertexId
from rightofway.precedence import CyclicSchedule
from rightofway.search import PeriodicBookings

__all__ = ["Stretch", "closed", "stretches"]

BEGINNINGS, ENDS = 8, 200
"""How many beginnings and ends of stretches are looked at."""

LATEST, SHORTEST = 0.1, 0.9
"""The latest beginning, as a part of the run; the shortest stretch, of the longest one."""

MOST_VISITS = 16_000_000
"""No stretch has many more: all its visits are kept in memory, and told."""

AROUND = 1.75
"""How many of the longest laps before and after the seam may change."""

FEWER_LAPS, GIVEN_UP = 4, 3
"""A robot makes less than so many laps fewer than it could, and gives up less than so many of the
run on each side of the seam."""

MOST_ROUNDS = 6
"""How often each robot that is not free to wait looks for its way, on average."""


MOST_SECONDS = 4
"""And for so long at most: another stretch may be closed sooner."""


@dataclass(frozen=True, slots=True, order=True)
class Stretch:
    """A stretch of a run: what its laps may be worth per tick, its first tick, and its length."""

    value: float
    begins: int
    period: int


def stretches(shift: CyclicProblem, run: GroupRun) -> list[Stretch]:
    """Return stretches of a run, the best first; none if the run is too short.

    Parameters
    ----------
    shift
        What laps are worth.
    run
        What native rules do, so that it has a `VisitTimes` of each robot.
    """
    known = max(past[-1] for past in run.history)
    longest = max(endless.lap.duration for endless in run.group)
    per_tick = sum(map(len, run.history)) / max(known, 1)
    homes = _homes(run)
    found = []
    beginnings = np.linspace(longest, max(LATEST * known, longest), BEGINNINGS)
    for begins in np.unique(beginnings.astype(np.int64)).tolist():
        most = min(known - begins, int(MOST_VISITS / per_tick))
        least = max(int(SHORTEST * most), int(2 * AROUND * longest) + 1)
        if least <= most:
            periods = np.unique(np.linspace(least, most, ENDS).astype(np.int64))
            values = _values(shift, run, homes, begins, periods)
            best = int(np.argmax(values))
            found.append(Stretch(float(values[best]), begins, int(periods[best])))
    return sorted((one for one in found if one.value > 0), reverse=True)


def _homes(run: GroupRun) -> list[NDArray[np.int64]]:
    """Return for each robot when it came home; at first it is there."""
    return [
        np.asarray(past[:: len(endless.lap)], np.int64)
        for past, endless in zip(run.history, run.group, strict=True)
    ]


def _values(
    shift: CyclicProblem,
    run: GroupRun,
    homes: Sequence[NDArray[np.int64]],
    begins: int,
    periods: NDArray[np.int64],
) -> NDArray[np.float64]:
    """Return what laps are worth per tick, if each robot makes as many as it has time for."""
    worth = np.zeros(len(periods))
    for weight, endless, home in zip(shift.weights, run.group, homes, strict=True):
        first = _first(home, begins)
        if first >= len(home):
            return worth * 0
        last = np.searchsorted(home, begins + periods, side="right") - 1
        more = (home[first] + periods - home[last]) // int(endless.lap.duration)
        laps = np.where(last >= first, last - first + more, 0)
        worth += np.where(laps > 0, float(weight) * laps, -np.inf)
    return np.maximum(worth, 0) / periods


def _first(home: NDArray[np.int64], begins: int) -> int:
    """Return the first lap that begins from a tick on; never the very first one."""
    return max(int(np.searchsorted(home, begins)), 1)


def closed(shift: CyclicProblem, run: GroupRun, stretch: Stretch) -> CyclicSchedule | None:
    """Return the timetable of a stretch; None if some robot finds no way through the seam."""
    around = int(AROUND * max(endless.lap.duration for endless in run.group))
    if 2 * around >= stretch.period:
        return None
    closing = _Closing(shift, run, stretch, around)
    if not closing.let_all_through():
        return None
    closing.add_laps()
    works = [closing.work(place) for place in range(len(run.group))]
    return shift.timetable(works, stretch.period) if all(work.count for work in works) else None


@dataclass(frozen=True, slots=True, eq=False)
class _Part:
    """What one robot keeps of the run, and how it gets through the seam.

    Attributes
    ----------
    lap, past, home
        What it repeats, when its visits began, and when it came home.
    period
        How long the circle is [ticks].
    first, last
        The first lap that it keeps, and the one before which it stops.
    through
        When the visits of the laps that it makes at the seam begin, with the one home after them;
        None if that is not known.
    """

    lap: Lap
    past: VisitTimes
    home: NDArray[np.int64]
    period: int
    first: int
    last: int
    through: NDArray[np.int64] | None = None

    @property
    def begins(self) -> int:
        """When it comes home before the seam."""
        return int(self.home[self.last])

    @property
    def until(self) -> int:
        """By when it has to be home after it."""
        return int(self.home[self.first]) + self.period

    @property
    def leave(self) -> int:
        """When it sets out from there."""
        return self.past[self.first * len(self.lap) + 1] + self.period

    @property
    def more(self) -> int:
        """How many laps it makes at the seam."""
        return 0 if self.through is None else len(self.through) // len(self.lap)

    @property
    def laps(self) -> int:
        """How many laps it makes in a period."""
        return self.last - self.first + self.more

    @property
    def most(self) -> int:
        """How many laps it has time for."""
        return self.last - self.first + (self.until - self.begins) // int(self.lap.duration)


class _Closing:
    """All robots around the seam of one stretch."""

    def __init__(self, shift: CyclicProblem, run: GroupRun, stretch: Stretch, around: int) -> None:
        self._period = stretch.period
        seam = stretch.begins + stretch.period
        self._from, self._to = seam - around, seam + around
        self._seam = PeriodicBookings(
            shift.n_vertices, None, headway=shift.headway, books_ahead=shift.books_ahead
        )
        rows = zip(run.group, run.history, _homes(run), strict=True)
        self._parts = [
            _Part(
                lap=endless.lap,
                past=past,
                home=home,
                period=stretch.period,
                first=_first(home, stretch.begins),
                last=int(np.searchsorted(home, seam, side="right")) - 1,
            )
            for endless, past, home in rows
            if isinstance(past, VisitTimes)
        ]
        for place, part in enumerate(self._parts):
            self._keep(place, part)

    def let_all_through(self) -> bool:
        """Let robots wait at home, or make laps where they cannot; tell whether all can."""
        queue = deque(place for place in range(len(self._parts)) if not self._waits(place))
        end = monotonic() + MOST_SECONDS
        for _ in range(MOST_ROUNDS * len(queue) + len(self._parts)):
            if not queue or monotonic() > end:
                break
            place = queue.popleft()
            near = self._find(place, self._tries(place))
            if near is None:
                continue
            waiting = sorted(near)
            for one in waiting:
                self._put(one, replace(self._parts[one], through=None))
            queue.extend(waiting)
            if self._find(place, self._tries(place)) is not None:
                queue.append(place)
        return not queue

    def add_laps(self) -> None:
        """Let all make as many laps as there is room for, those with short ones first."""
        for place in sorted(range(len(self._parts)), key=lambda k: self._parts[k].lap.duration):
            laps = self._parts[place].laps
            tries = self._tries(place)
            self._find(place, (one for one in tries if one[0].last - one[0].first + one[1] > laps))

    def work(self, place: int) -> Work:
        """Return what a robot does in a period."""
        part, n = self._parts[place], len(self._parts[place].lap)
        assert part.through is not None, "all have found their way"
        kept = part.past.enters(range(part.first * n, part.last * n))
        enter = np.concatenate((kept, part.through[:-1]))
        enter[0] = part.through[-1] - self._period
        return Work(part.lap, part.laps, enter - enter[0] // self._period * self._period)

    def _waits(self, place: int) -> bool:
        """Let a robot wait at home, and tell whether nobody passes there."""
        part = self._parts[place]
        there = self._seam.connect(part.lap, 0, part.begins, part.until, part.leave)
        self._parts[place] = part = replace(part, through=there)
        self._book_through(place, part)
        return there is not None

    def _tries(self, place: int) -> Iterator[tuple[_Part, int]]:
        """Yield what a robot may keep, and how many laps it makes at the seam then: most first."""
        part = replace(self._parts[place], through=None)
        for fewer in range(FEWER_LAPS):
            for later, sooner in sorted(product(range(GIVEN_UP), repeat=2), key=sum):
                less = replace(part, first=part.first + later, last=part.last - sooner)
                more = part.most - fewer - (less.last - less.first)
                inside = less.first <= less.last and more >= 0
                if inside and self._from <= less.begins and less.until <= self._to:
                    yield less, more

    def _find(self, place: int, tries: Iterator[tuple[_Part, int]]) -> set[int] | None:
        """Find a robot its way through the seam; if it finds none, return who was in its way."""
        before, near = self._parts[place], set[int]()
        self._seam.remove(place)  # what it keeps is never in its own way
        for part, more in tries:
            found = self._seam.connect(part.lap, more, part.begins, part.until, part.leave)
            if found is not None:
                self._put(place, replace(part, through=found))
                return None
            vertex = self._seam.stuck_at(part.lap)
            near |= self._waiting(vertex, self._seam.users([vertex], part.begins, part.leave))
        self._put(place, before)
        return near - {place}

    def _waiting(self, vertex: VertexId, users: set[int]) -> set[int]:
        """Return who may make room at a place: who waits at home there, or makes laps past it."""
        parts = ((place, self._parts[place]) for place in users)
        return {
            place
            for place, part in parts
            if part.through is not None and (part.more or part.lap.vertices[0] == vertex)
        }

    def _put(self, place: int, part: _Part) -> None:
        """Book a robot anew."""
        self._parts[place] = part
        self._seam.remove(place)
        self._keep(place, part)
        self._book_through(place, part)

    def _keep(self, place: int, part: _Part) -> None:
        """Book what a robot keeps of the run, as far as it is around the seam."""
        n = len(part.lap)
        first = max(int(np.searchsorted(part.home, self._from)) - 1, part.first)
        last = min(int(np.searchsorted(part.home, self._to - self._period)), part.last)
        before = range(first * n, part.last * n)
        after = range(part.first * n + 1, last * n)
        for visits, later in ((before, 0), (after, self._period)):
            if visits:
                enter = part.past.enters(range(visits.start, visits.stop + 1)) + later
                self._seam.add_visits(place, part.lap, visits, enter[:-1], int(enter[-1]))

    def _book_through(self, place: int, part: _Part) -> None:
        """Book its way through the seam; if that is not known yet, both times that it is home."""
        home = np.array([part.begins, part.until])
        if part.through is not None:
            visits = range(len(part.through))
            self._seam.add_visits(place, part.lap, visits, part.through, part.leave)
        elif part.begins + part.lap.least(0) < part.until:
            self._seam.add_visits(
                place, part.lap, range(1), home[:1], part.begins + part.lap.least(0)
            )
            self._seam.add_visits(place, part.lap, range(1), home[1:], part.leave)
        else:
            self._seam.add_visits(place, part.lap, range(1), home[:1], part.leave)
