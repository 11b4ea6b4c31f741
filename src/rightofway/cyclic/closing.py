"""Closing: turn a stretch of a simulation into a timetable, some laps per robot that repeat.

Two methods, for simulations in which no state recurs in reasonable time. The *seam* is the instant
at which the end of the stretch meets its beginning.

- By orders (`close_windows`), for groups small enough to try many windows. Laps that begin from a
  tick on and end within a period keep their order at each vertex, also across the seam; the cycle
  time of this order is exact. If the order causes a deadlock at the seam, visits keep their times
  instead, and robots with overlapping bookings leave out laps.
- By a seam (`close_stretch`), for hundreds of robots. Far from the seam, visits keep their times.
  At the seam, each robot waits at home from its last lap before to its first lap after the seam, or
  makes additional laps; it may give up laps next to the seam. A robot with other robots passing its
  home during this wait searches for a route first.

A seam costs about half a lap per robot for any length of stretch: the value of a timetable
approaches the value of the simulation as the stretch gets longer.
"""

from __future__ import annotations

from collections import Counter, deque
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise, product, zip_longest

import numpy as np
from numpy.typing import NDArray

from rightofway.cyclic.pattern import Enters, VisitTimes
from rightofway.cyclic.problem import Candidate, CyclicProblem, RobotCycle
from rightofway.cyclic.result import GroupResult
from rightofway.cyclic.warmup import find_homes
from rightofway.model import Lap
from rightofway.search import PeriodicBookings


@dataclass(frozen=True, slots=True, kw_only=True)
class ClosingParams:
    """Selection of stretches, and limits of changes at a seam."""

    # Windows compete within each range between consecutive lengths [longest laps].
    window_lengths: tuple[int, ...] = (1, 2, 4, 8, 16, 32, 64, 128, 256)
    window_begins: int = 32  # Number of begins per length.
    most_by_value: int = 12  # Windows closed per length, by value of laps.
    most_by_calm: int = 4  # Windows closed per length, by least waiting at the end.
    most_window_visits: int = 200_000  # Maximum visits of a window.
    most_left_out: int = 3  # Maximum laps left out per robot with overlaps at the seam.
    stretch_begins: int = 8  # Number of begins of long stretches.
    stretch_ends: int = 200  # Number of ends per begin.
    latest_begin: float = 0.1  # Latest begin, as a part of the simulation.
    shortest: float = 0.9  # Least length, as a part of the longest stretch.
    most_stretch_visits: int = 16_000_000  # Approximate maximum of visits, for memory.
    around: float = 1.75  # Visits may change within this distance of the seam [longest laps].
    fewer_laps: int = 4  # A robot makes fewer than this many laps below its maximum.
    given_up: int = 3  # A robot gives up fewer laps than this on each side of the seam.
    searches: int = 8  # Maximum searches per robot, on average.


DEFAULT = ClosingParams()


@dataclass(frozen=True, slots=True, order=True)
class Stretch:
    """A stretch of a simulation: its first tick, and its length [ticks]."""

    begins: int
    period: int


def _find_first_lap(home: Enters, begins: int) -> int:
    """Return the first lap, except lap 0, that begins at or after a tick."""
    return max(int(np.searchsorted(home, begins)), 1)


def close_windows(
    problem: CyclicProblem, run: GroupResult, params: ClosingParams = DEFAULT
) -> Iterator[Candidate]:
    """Yield timetables of windows of a simulation, until all are tried or time is over."""
    closing = _WindowClosing(problem, run, params)
    for window in closing.list_promising():
        if problem.is_out_of_time:
            return
        closed = closing.close(window)
        if closed is not None:
            yield closed


class _WindowClosing:
    """Closing of windows of a simulation by the order of visits at each vertex."""

    def __init__(self, problem: CyclicProblem, run: GroupResult, params: ClosingParams) -> None:
        self.problem, self.run, self.params = problem, run, params
        self.homes = find_homes(run.context.routes, run.history)
        self.known = min(int(home[-1]) for home in self.homes)

    def list_promising(self) -> list[Stretch]:
        """Return windows of all lengths: the best of each length, then the second best, ..."""
        params, longest = self.params, max(self.problem.alone)
        ranked: list[list[Stretch]] = []
        for least, most in pairwise(length * longest for length in params.window_lengths):
            latest = self.known - least
            if latest <= longest:
                break
            ticks = np.linspace(longest, latest, params.window_begins).astype(np.int64).tolist()
            best = [ends for tick in ticks if (ends := self.list_best_ends(tick, least, most))]
            for score, n_closed in enumerate((params.most_by_value, params.most_by_calm)):
                in_order = sorted((ends[score] for ends in best), key=lambda scored: -scored[0])
                ranked.append(list(dict.fromkeys(window for _, window in in_order))[:n_closed])
        in_turn = (
            stretch
            for row in zip_longest(*reversed(ranked))
            for stretch in row
            if stretch is not None
        )
        return list(dict.fromkeys(in_turn))

    def list_best_ends(self, begins: int, least: int, most: int) -> list[tuple[float, Stretch]]:
        """Return the best windows from a tick to an arrival at home, with their scores.

        The first window has the largest value of laps per tick, the second the least waiting at
        home before the end of the window. Empty without an end at the required length.
        """
        laps = [home[_find_first_lap(home, begins) :] for home in self.homes]
        ends_of = [(home[1:] - home[0])[home[1:] - home[0] <= most] for home in laps]
        every = max(int(part[0]) if len(part) else most + 1 for part in ends_of)
        ends, sizes = np.concatenate(ends_of), [len(part) for part in ends_of]
        order = np.argsort(ends, kind="stable")
        visits = np.repeat([len(route) for route in self.run.context.routes], sizes)[order]
        weights = np.repeat([float(weight) for weight in self.problem.weights], sizes)[order]
        lasted = np.concatenate([part - np.append(0, part[:-1]) for part in ends_of])[order]
        ends = ends[order]
        fit = (ends >= max(least, every)) & (ends <= self.known - begins)
        fit &= np.cumsum(visits) <= self.params.most_window_visits
        if not fit.any():
            return []
        scored = []
        for score in (np.cumsum(weights) / ends, np.cumsum(lasted) / ends - len(ends_of)):
            best = int(np.argmax(np.where(fit, score, -np.inf)))
            scored.append((float(score[best]), Stretch(begins, int(ends[best]))))
        return scored

    def close(self, window: Stretch) -> Candidate | None:
        """Return the timetable of a window; None if a robot finds no place."""
        problem, period, laps = self.problem, window.period, self.run.context.laps
        parts = []
        for lap, past, home in zip(laps, self.run.history, self.homes, strict=True):
            first = _find_first_lap(home, window.begins)
            last = int(np.searchsorted(home, home[first] + period, side="right")) - 1
            visits = past[first * len(lap) : last * len(lap) + 1]
            parts.append((lap, np.array(visits, np.int64) - window.begins))
        for early in (True, False):
            cycles = [_make_cycle(lap, enter, period, early=early) for lap, enter in parts]
            in_order = problem.make_candidate_of_orders(problem.join_cycles(cycles, period))
            if in_order is not None:
                return in_order
        bookings, placed = problem.empty_bookings(period), dict[int, RobotCycle]()
        # Robots with busy homes have least freedom to wait: placed first.
        users = Counter(vertex for lap in laps for vertex in set(lap.vertices))
        for robot in sorted(range(len(laps)), key=lambda number: -users[laps[number].vertices[0]]):
            cycle = self.book_without_overlap(bookings, robot, *parts[robot])
            if cycle is None:
                return None
            placed[robot] = cycle
        cycles = [placed[robot] for robot in range(len(laps))]
        return problem.make_candidate_of_orders(problem.join_cycles(cycles, period))

    def book_without_overlap(
        self, bookings: PeriodicBookings, robot: int, lap: Lap, enter: Enters
    ) -> RobotCycle | None:
        """Leave out laps at the seam until a robot has no conflict, and book its visits."""
        n, period = len(lap), int(bookings.period)
        for less in range(min(self.params.most_left_out + 1, len(enter) // n)):
            for head, early in product(range(less + 1), (True, False)):
                part = enter[head * n : len(enter) - (less - head) * n]
                cycle = _make_cycle(lap, part, period, early=early)
                if bookings.add_if_free(robot, lap, cycle.count, cycle.enter):
                    return cycle
        return None


def _make_cycle(lap: Lap, enter: Enters, period: int, *, early: bool) -> RobotCycle:
    """Return a cycle; its stay at home begins with the last arrival, or else the first.

    Of a robot that makes no lap it is empty.
    """
    visits = enter[:-1].copy()
    if not len(visits):
        return RobotCycle(lap, 0, visits)
    if early:
        visits[0] = enter[-1] - period
    return RobotCycle(lap, len(visits) // len(lap), visits - visits[0] // period * period)


def find_stretches(
    problem: CyclicProblem, run: GroupResult, params: ClosingParams = DEFAULT
) -> list[tuple[float, Stretch]]:
    """Return long stretches of a simulation with upper bounds on their values, best first."""
    known, longest = max(past[-1] for past in run.history), run.context.longest
    visits_per_tick = sum(map(len, run.history)) / max(known, 1)
    homes = find_homes(run.context.routes, run.history)
    candidates = []
    latest = max(params.latest_begin * known, longest)
    ticks = np.linspace(longest, latest, params.stretch_begins).astype(np.int64)
    for begins in np.unique(ticks).tolist():
        most = min(known - begins, int(params.most_stretch_visits / visits_per_tick))
        least = max(int(params.shortest * most), int(2 * params.around * longest) + 1)
        if least <= most:
            periods = np.unique(np.linspace(least, most, params.stretch_ends).astype(np.int64))
            values = _compute_values(problem, run, homes, begins, periods)
            best = int(np.argmax(values))
            candidates.append((float(values[best]), Stretch(begins, int(periods[best]))))
    return sorted((candidate for candidate in candidates if candidate[0] > 0), reverse=True)


def _compute_values(
    problem: CyclicProblem,
    run: GroupResult,
    homes: Sequence[Enters],
    begins: int,
    periods: NDArray[np.int64],
) -> NDArray[np.float64]:
    """Return the value of laps per tick if each robot makes the most laps that fit."""
    worth = np.zeros(len(periods))
    for weight, lap, home in zip(problem.weights, run.context.laps, homes, strict=True):
        first = _find_first_lap(home, begins)
        if first >= len(home):
            return worth * 0
        last = np.searchsorted(home, begins + periods, side="right") - 1
        more = (home[first] + periods - home[last]) // int(lap.duration)
        laps = np.where(last >= first, last - first + more, 0)
        worth += np.where(laps > 0, float(weight) * laps, -np.inf)
    return np.maximum(worth, 0) / periods


def close_stretch(
    problem: CyclicProblem, run: GroupResult, stretch: Stretch, params: ClosingParams = DEFAULT
) -> Candidate | None:
    """Return the timetable of a long stretch; None if a robot finds no route through the seam.

    Precondition: a simulation by a native rule, with a history of `VisitTimes`.
    """
    if 2 * int(params.around * run.context.longest) >= stretch.period:
        return None
    closing = _SeamClosing(problem, run, stretch, params)
    if not closing.connect_all():
        return None
    closing.add_laps()
    cycles = [closing.make_cycle(robot) for robot in range(len(run.context))]
    if not all(cycle.count for cycle in cycles):
        return None
    return Candidate.as_it_is(problem.join_cycles(cycles, stretch.period))


@dataclass(frozen=True, slots=True, eq=False)
class _Kept:
    """The laps that one robot keeps of the simulation, and its visits at the seam."""

    lap: Lap
    past: VisitTimes
    home: Enters  # the enters of the visits home
    period: int
    first: int  # the first kept lap
    last: int  # the lap after the last kept lap
    through: Enters | None = None  # visits at the seam, from home to home; None if unknown

    @property
    def begins(self) -> int:
        """The tick of the arrival at home before the seam."""
        return int(self.home[self.last])

    @property
    def until(self) -> int:
        """The latest tick of the arrival at home after the seam."""
        return int(self.home[self.first]) + self.period

    @property
    def leave(self) -> int:
        """The tick of the departure from home after the seam."""
        return self.past[self.first * len(self.lap) + 1] + self.period

    @property
    def n_through(self) -> int:
        """The number of laps at the seam."""
        return 0 if self.through is None else len(self.through) // len(self.lap)

    @property
    def n_kept(self) -> int:
        """The number of kept laps."""
        return self.last - self.first


class _SeamClosing:
    """All robots around the seam of one stretch, with bookings that do not repeat."""

    def __init__(
        self, problem: CyclicProblem, run: GroupResult, stretch: Stretch, params: ClosingParams
    ) -> None:
        self._problem, self._params, self._period = problem, params, stretch.period
        around = int(params.around * run.context.longest)
        seam = stretch.begins + stretch.period
        self._from, self._to = seam - around, seam + around
        self._seam, self._searches = problem.empty_bookings(None), 0
        self._kept: list[_Kept] = []
        homes, laps = find_homes(run.context.routes, run.history), run.context.laps
        for robot, (lap, past, home) in enumerate(zip(laps, run.history, homes, strict=True)):
            assert isinstance(past, VisitTimes), "native rules have these"
            first = _find_first_lap(home, stretch.begins)
            last = int(np.searchsorted(home, seam, side="right")) - 1
            self._kept.append(_Kept(lap, past, home, stretch.period, first, last))
            self._book_kept(robot)

    def connect_all(self) -> bool:
        """Connect robots by waits at home, or else by laps; return whether all are connected."""
        queue = deque(robot for robot in range(len(self._kept)) if not self._wait_at_home(robot))
        most = self._params.searches * len(self._kept)
        while queue and self._searches < most and not self._problem.is_out_of_time:
            self._searches += 1  # counts also without choices
            robot = queue.popleft()
            blocking = self._connect(robot, self._list_choices(robot))
            if blocking is None:
                continue
            for blocker in sorted(blocking):
                self._book(blocker, replace(self._kept[blocker], through=None))
            queue.extend(sorted(blocking))
            if self._connect(robot, self._list_choices(robot)) is not None:
                queue.append(robot)
        return not queue

    def add_laps(self) -> None:
        """Add laps of all robots while they fit, robots with short laps first."""
        for robot in sorted(
            range(len(self._kept)), key=lambda number: self._kept[number].lap.duration
        ):
            if self._problem.is_out_of_time:
                break
            n_laps = self._kept[robot].n_kept + self._kept[robot].n_through
            choices = self._list_choices(robot)
            self._connect(
                robot, (choice for choice in choices if choice[0].n_kept + choice[1] > n_laps)
            )

    def make_cycle(self, robot: int) -> RobotCycle:
        """Return the cycle of a robot."""
        stretch, n = self._kept[robot], len(self._kept[robot].lap)
        assert stretch.through is not None, "all robots are connected"
        visits = stretch.past.enters(range(stretch.first * n, stretch.last * n))
        return _make_cycle(
            stretch.lap, np.concatenate((visits, stretch.through)), self._period, early=True
        )

    def _wait_at_home(self, robot: int) -> bool:
        """Connect a robot by a wait at home; return whether its home stays free."""
        stretch = self._kept[robot]
        times = stretch.begins, stretch.until, stretch.leave
        through = self._seam.connect(stretch.lap, 0, *times, robot=robot)
        self._kept[robot] = replace(stretch, through=through)
        self._book_through(robot)
        return through is not None

    def _list_choices(self, robot: int) -> Iterator[tuple[_Kept, int]]:
        """Yield kept laps of a robot and the number of laps at the seam, most laps first."""
        stretch, params = replace(self._kept[robot], through=None), self._params
        most = stretch.n_kept + (stretch.until - stretch.begins) // int(stretch.lap.duration)
        given_up = sorted(product(range(params.given_up), repeat=2), key=sum)
        for fewer in range(params.fewer_laps):
            for later, sooner in given_up:
                less = replace(stretch, first=stretch.first + later, last=stretch.last - sooner)
                n_through = most - fewer - less.n_kept
                inside = less.n_kept >= 0 and n_through >= 0
                if inside and self._from <= less.begins and less.until <= self._to:
                    yield less, n_through

    def _connect(self, robot: int, choices: Iterator[tuple[_Kept, int]]) -> set[int] | None:
        """Find a route through the seam; without one, return robots that may give way.

        These robots wait at home at the vertex where the search got stuck, or pass this vertex at
        the seam.
        """
        before, blocking = self._kept[robot], set[int]()
        self._seam.remove(robot)  # its own bookings do not block it
        for stretch, n_through in choices:
            times = stretch.begins, stretch.until, stretch.leave
            through = self._seam.connect(stretch.lap, n_through, *times, robot=robot)
            self._searches += 1
            if through is not None:
                self._book(robot, replace(stretch, through=through))
                return None
            for blocker in self._seam.find_blockers(
                robot, stretch.lap, stretch.begins, stretch.leave
            ):
                other = self._kept[blocker]
                at_home = self._seam.keeps_out(blocker, other.lap, robot, stretch.lap)
                if other.through is not None and (other.n_through or at_home):
                    blocking.add(blocker)
        self._book(robot, before)
        return blocking - {robot}

    def _book(self, robot: int, stretch: _Kept) -> None:
        """Replace all bookings of a robot."""
        self._kept[robot] = stretch
        self._seam.remove(robot)
        self._book_kept(robot)
        self._book_through(robot)

    def _book_kept(self, robot: int) -> None:
        """Book the kept laps of a robot around the seam."""
        stretch, n = self._kept[robot], len(self._kept[robot].lap)
        first = max(int(np.searchsorted(stretch.home, self._from)) - 1, stretch.first)
        last = min(int(np.searchsorted(stretch.home, self._to - self._period)), stretch.last)
        before = range(first * n, stretch.last * n)
        after = range(stretch.first * n + 1, last * n)
        for visits, later in ((before, 0), (after, self._period)):
            if visits:
                enter = stretch.past.enters(range(visits.start, visits.stop + 1)) + later
                self._seam.add_visits(robot, stretch.lap, visits, enter[:-1], int(enter[-1]))

    def _book_through(self, robot: int) -> None:
        """Book the visits at the seam; if unknown, both stays at home."""
        stretch, leave = (
            self._kept[robot],
            self._kept[robot].begins + self._kept[robot].lap.compute_least(0),
        )
        stays = [(stretch.begins, leave), (stretch.until, stretch.leave)]
        if stretch.through is not None:
            visits = range(len(stretch.through))
            self._seam.add_visits(robot, stretch.lap, visits, stretch.through, stretch.leave)
            return
        for begins, ends in stays if leave < stretch.until else [(stretch.begins, stretch.leave)]:
            self._seam.add_visits(robot, stretch.lap, range(1), np.array([begins]), ends)
