"""Timetables cut out of a run: some laps of each robot, closed to a circle.

A run that does not repeat itself in any reasonable time still makes good use of the floor. Cut out
of it are all laps between two ticks, and the time between becomes a circle. Most robots keep their
times. Those that meet others at the seam look for another place, with a lap or two less if need
be; and then whoever finds room makes more.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from rightofway.laps.outcome import GroupRun
from rightofway.search import Circle
from rightofway.timetables.building import filled
from rightofway.timetables.shift import Choice, Shift, Work

__all__ = ["windows"]

LENGTHS = (2, 3, 5, 8, 13, 21)
"""How long windows are, in the longest laps alone."""

BEGINNINGS = 8
"""How many windows of each length are looked at."""

MOST_VISITS = 60_000
"""Longer windows are left out."""


def windows(shift: Shift, run: GroupRun) -> Iterator[Choice]:
    """Yield timetables cut out of a run, all that are possible; ends when time is over."""
    homes = [
        np.array(past, np.int64)[:: len(endless.lap)]
        for past, endless in zip(run.history, run.group, strict=True)
    ]
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


def _window(
    shift: Shift, run: GroupRun, homes: list[NDArray[np.int64]], begins: int, ends: int
) -> Choice | None:
    """Return a timetable of the laps between two ticks; None if some robot finds no place."""
    works = []
    for past, endless, home in zip(run.history, run.group, homes, strict=True):
        n, first = len(endless.lap), max(int(np.searchsorted(home, begins)), 1)
        last = max(int(np.searchsorted(home, ends, side="right")) - 1, first + 1)
        enter = np.array(past[first * n : last * n], np.int64) - begins
        works.append(Work(endless.lap, last - first, enter))
    if sum(len(work.enter) for work in works) > MOST_VISITS:
        return None
    circle = shift.circle(ends - begins)
    return filled(shift, circle, works) if _joined(shift, circle, works) else None


def _joined(shift: Shift, circle: Circle, works: list[Work]) -> bool:
    """Put all on the circle, others than these where they overlap; false if that is impossible."""
    late = []
    for place in shift.draw.sample(range(len(works)), len(works)):
        try:
            circle.add(place, works[place].lap, works[place].count, works[place].enter)
        except ValueError:
            late.append(place)
    for place in late:
        found = _elsewhere(shift, circle, place, works[place])
        if found is None:
            return False
        works[place] = found
        circle.add(place, found.lap, found.count, found.enter)
    return True


def _elsewhere(shift: Shift, circle: Circle, place: int, work: Work) -> Work | None:
    for count in range(work.count, 0, -1):
        found = shift.place(circle, place, count, tries=1)
        if found is not None:
            return found
    return None
