"""The timetable of a large group: a long stretch of the best run that is found, closed to a circle.

With hundreds of robots there is no time to choose anything twice. But a run under a rule that sees
two robots makes dozens of laps in a second, and closing it costs about half a lap of each robot
(`seams`). So what is chosen is the run: on routes that are clear of others only as much as it pays
over many laps, and with the right of way for who would lose more by waiting. Each is tried for a
moment; the best goes on as long as there is time.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction

from rightofway.cyclic.closing import closed, stretches
from rightofway.cyclic.native_rules import Native
from rightofway.cyclic.problem import CyclicProblem
from rightofway.cyclic.result import GroupRun
from rightofway.cyclic.route import CyclicRoute
from rightofway.cyclic.run import go_on, make_simulator
from rightofway.model import Lap, Scenario, Tick
from rightofway.planners import Deadline, Task
from rightofway.precedence import CyclicSchedule

__all__ = ["Watched", "cut_out", "rival_of", "runs_of"]

LEAST_SHARE, MOST_SHARE = 0.03, 0.15
"""The part of the time left that a run is tried for, at least and at most."""

LAPS_TRIED = 3
"""In between, a run is tried for so many of the longest laps."""

SETTING_OUT = 1
"""All set out first come first served, for so many of the longest laps: at first everybody is at
home, in the way of others."""

GOOD = 1.005
"""A run that is so much better than first come first served is gone on with, and none is tried."""

GOING_ON_SHARE = 0.75
"""The part of the time left then in which the best goes on; in the rest it is closed."""

SLICES = 4
"""In so many parts of that; after each it is asked what promises most then."""

SEAM = 0.55
"""How much of a lap each robot loses where a stretch is closed."""

LEAST_LAPS, GRACE = 5, 5
"""However little time there is, the best goes on for so many of the longest laps if it can in so
many seconds: a stretch that is too short cannot be closed."""

EACH, MOST_STRETCHES = 2, 4
"""How many stretches of each run, and in all, are tried to be closed until one is."""

MOMENT, SHORTEST_MOMENT = 0.2, 0.02
"""So often it is asked how far a run is: as a part of the time for it, and at least [s]."""


class Watched:
    """A group under a rule, and what it did so far.

    Parameters
    ----------
    scenario
        The problem.
    group
        Its robots and their routes.

    Attributes
    ----------
    run
        What it did so far.
    known
        How far it is [ticks].
    pace
        How many ticks it came on in a second, when it last went on.
    """

    def __init__(self, scenario: Scenario, group: Sequence[CyclicRoute]) -> None:
        self._longest = max(endless.lap.duration for endless in group)
        self._going = make_simulator(Task(scenario=scenario), group, "first-come")
        self._seconds = self.pace = 0.0
        self.run = go_on(self._going, Deadline.after(0))
        self.known = 0
        self._value: Fraction | None = None

    def go_on(self, seconds: float) -> None:
        """Go on for some time, if the end is open."""
        if self.run.ends == "open":
            before = self.known
            self.run = go_on(self._going, Deadline.after(seconds))
            self.known = max(past[-1] for past in self.run.history)
            self.pace = (self.known - before) / max(seconds, SHORTEST_MOMENT)
            self._seconds += seconds
            self._value = None

    def go_on_for(self, laps: float, least: float, most: float) -> None:
        """Go on for some of the longest laps, in at least and at most so much time [s]."""
        before, began = self.known, self._seconds
        until, end = before + laps * self._longest, began + most
        self.go_on(least)
        while self.run.ends == "open" and self.known < until and self._seconds < end:
            self.go_on(max(most * MOMENT, SHORTEST_MOMENT))
        self.pace = (self.known - before) / max(self._seconds - began, SHORTEST_MOMENT)

    def go_on_until(self, laps: float, most: float) -> None:
        """Go on until it is so many of the longest laps long, in at most so much time [s]."""
        self.go_on_for(laps - self.known / self._longest, 0, most)

    def follow(self, rule: str) -> None:
        """Go on under another rule, if the end is open."""
        if self.run.ends == "open" and isinstance(self._going, Native):
            self._going.follow(rule)

    def value(self, shift: CyclicProblem) -> Fraction:
        """Return what its laps are worth per tick; 0 if not all robots make laps, or fair ones."""
        if self._value is None:
            self._value = _value(self.run, shift)
        return self._value


def _value(run: GroupRun, shift: CyclicProblem) -> Fraction:
    means = run.mean_laps() if run.ends != "deadlock" else (None,)
    if None in means:
        return Fraction(0)
    parts = (alone / mean for alone, mean in zip(shift.alone, means, strict=True) if mean)
    return run.rate(shift.weights) if min(parts) >= shift.least_fairness else Fraction(0)


def rival_of(scenario: Scenario, group: Sequence[CyclicRoute], shift: CyclicProblem) -> Watched:
    """Let the group go on first come first served, for a moment."""
    return _tried(scenario, group, "first-come", shift)


def runs_of(
    scenario: Scenario, rival: Watched, group: Sequence[CyclicRoute], shift: CyclicProblem
) -> list[GroupRun]:
    """Return runs to cut a timetable out of; that which promises most went on.

    Parameters
    ----------
    scenario
        The problem.
    rival
        First come first served on the usual routes, for a moment.
    group
        The robots on their usual routes; their last ways are the direct ones.
    shift
        What laps are worth, what is fair, and when to stop.
    """
    ways = zip(group, shift.ways, strict=True)
    direct = [_on(endless, own[-1]) for endless, own in ways]
    rest = iter(((direct, "least-loss"), (direct, "first-come"), (group, "least-loss")))
    tried, enough = [rival], Fraction(GOOD) * rival.value(shift)
    for left in range(SLICES, 0, -1):
        best = _best(tried, shift)
        while best.value(shift) <= enough and (one := next(rest, None)):
            tried.append(_tried(scenario, *one, shift))
            best = _best(tried, shift)
        best.go_on(GOING_ON_SHARE ** (1 / left) * _left(shift) / left)
    _best(tried, shift).go_on_until(LEAST_LAPS, GRACE)
    return [one.run for one in tried if all(one.run.laps_made())]


def _best(tried: Sequence[Watched], shift: CyclicProblem) -> Watched:
    """Return what promises most, if it goes on as fast as it did last, and is closed then."""
    seconds = GOING_ON_SHARE * _left(shift)
    seam = SEAM * float(shift.worth([1] * len(shift.robots)))

    def promise(one: Watched) -> float:
        known = one.known + one.pace * seconds
        return float(one.value(shift)) - seam / max(known, 1)

    return max(tried, key=promise)


def _tried(
    scenario: Scenario, group: Sequence[CyclicRoute], rule: str, shift: CyclicProblem
) -> Watched:
    """Let a group go on for a moment."""
    one, left = Watched(scenario, group), _left(shift)
    if rule != "first-come":
        one.go_on_for(SETTING_OUT, 0, MOST_SHARE * left)
        one.follow(rule)
    one.go_on_for(LAPS_TRIED, LEAST_SHARE * left, MOST_SHARE * left)
    return one


def _on(endless: CyclicRoute, lap: Lap) -> CyclicRoute:
    """Return a robot on another way."""
    turn = endless.lap.least(0) - endless.first_least
    return replace(endless, lap=lap, first_least=Tick(lap.least(0) - turn))


def _left(shift: CyclicProblem) -> float:
    return shift.deadline.seconds_left() or 0.0


def cut_out(shift: CyclicProblem, runs: Sequence[GroupRun]) -> CyclicSchedule | None:
    """Return the timetable of a long stretch of a run; None if none can be closed, or is fair."""
    found = [(stretch, run) for run in runs for stretch in stretches(shift, run)[:EACH]]
    found.sort(key=lambda one: one[0], reverse=True)
    for stretch, run in found[:MOST_STRETCHES]:
        timetable = closed(shift, run, stretch)
        if timetable is not None and shift.is_fair(timetable.counts, int(timetable.period)):
            return timetable
    return None
