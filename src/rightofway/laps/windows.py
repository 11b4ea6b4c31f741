"""Timetables cut out of a run: some laps of each robot, closed to a circle.

A run that does not repeat itself in any reasonable time still makes good use of the floor. Cut out
of it are all laps between two ticks; behind the last of them the first come again. At first nobody
sets out before all are home. The orders do not ask for that, so the cycle time is close to how
long the window is, and a lap's worth of loss at the seam weighs the less, the longer it is.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from rightofway.laps.outcome import GroupRun
from rightofway.laps.shift import Choice, Shift, Work

__all__ = ["windows"]

LENGTHS = (2, 3, 5, 8, 13, 21)
"""How long windows are, in the longest laps alone."""

BEGINNINGS = 8
"""How many windows of each length are looked at."""

MOST_VISITS = 60_000
"""Longer windows are left out."""


def windows(shift: Shift, run: GroupRun) -> Iterator[Choice]:
    """Yield timetables cut out of a run, all that are possible; ends when time is over."""
    homes = [np.array(past)[:: len(lap)] for past, lap in _laps(run)]
    known, longest = min(int(home[-1]) for home in homes), max(shift.alone)
    for length in LENGTHS:
        latest = known - length * longest
        for part in range(BEGINNINGS):
            if latest <= 0 or shift.deadline.seconds_left() == 0:
                return
            begins = latest * (part + 1) // BEGINNINGS
            found = _window(shift, run, homes, begins, begins + length * longest)
            if found is not None:
                yield found


def _laps(run: GroupRun) -> Iterator[tuple[tuple[int, ...], range]]:
    for past, endless in zip(run.history, run.group, strict=True):
        yield past, range(len(endless.lap))


def _window(
    shift: Shift, run: GroupRun, homes: list[np.ndarray], begins: int, ends: int
) -> Choice | None:
    """Return the timetable of the laps between two ticks; None if that is none."""
    first = [max(int(np.searchsorted(home, begins)), 1) for home in homes]
    last = [int(np.searchsorted(home, ends, side="right")) - 1 for home in homes]
    if any(b <= a for a, b in zip(first, last, strict=True)):
        return None
    if sum((b - a) * len(e.lap) for a, b, e in zip(first, last, run.group, strict=True)) > (
        MOST_VISITS
    ):
        return None
    begin = min(int(home[a]) for home, a in zip(homes, first, strict=True))
    end = max(int(home[b]) for home, b in zip(homes, last, strict=True))
    drives = max(max(endless.lap.drive) for endless in run.group)
    period = end - begin + int(shift.headway) + int(drives)
    works = []
    for past, endless, a, b in zip(run.history, run.group, first, last, strict=True):
        n = len(endless.lap)
        enter = np.array(past[a * n : b * n], np.int64) - begin
        works.append(Work(endless.lap, b - a, enter))
    circle = shift.circle(period)
    try:
        for place, work in enumerate(works):
            circle.add(place, work.lap, work.count, work.enter)
    except ValueError:  # somebody passes a home while its robot now waits there for the others
        return None
    return shift.tightened(shift.timetable(works, period))
