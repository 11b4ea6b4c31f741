"""One more lap for a robot where others make room: small steps on a circle that stays as it is.

A robot that is to make a lap more, and one or two others whose ways it shares, are taken off and
look for new places. If all find one, the period holds a lap more; if not, they go back. Nothing is
timed anew, so there are many such steps in the time of one of `improving`.
"""

from __future__ import annotations

from rightofway.cyclic.problem import Choice, CyclicProblem, Work
from rightofway.search import PeriodicBookings

__all__ = ["crowded"]

STEPS_OF_A_ROBOT = 6
"""How many steps there are, by the number of robots."""

SOMETIMES = 3
"""Every so often, nobody makes a lap more: places just change."""


def crowded(shift: CyclicProblem, choice: Choice) -> Choice:
    """Return a timetable with as many laps, or more, in a period as short as it can be."""
    circle, works = shift.on_circle(choice)
    for _ in range(STEPS_OF_A_ROBOT * len(works)):
        if shift.deadline.seconds_left() == 0:
            break
        _step(shift, circle, works)
    return shift.tightened(shift.timetable(works, choice.period))


def _step(shift: CyclicProblem, circle: PeriodicBookings, works: list[Work]) -> None:
    place = shift.draw.randrange(len(works))
    count = works[place].count + (shift.draw.randrange(SOMETIMES) > 0)
    if count * shift.alone[place] > circle.period:
        return
    near = sorted(circle.users(works[place].lap.vertices) - {place})
    others = shift.draw.sample(near, min(len(near), shift.draw.choice((0, 1, 1, 2))))
    before = {one: works[one] for one in (place, *others)}
    for one in before:
        circle.remove(one)
    placed = []
    for one in shift.draw.sample(list(before), len(before)):
        found = shift.place(circle, one, count if one == place else before[one].count, tries=2)
        if found is None:
            break
        circle.add(one, found.lap, found.count, found.enter)
        works[one] = found
        placed.append(one)
    if len(placed) < len(before):
        _go_back(circle, works, before, placed)


def _go_back(
    circle: PeriodicBookings, works: list[Work], before: dict[int, Work], placed: list[int]
) -> None:
    for one in placed:
        circle.remove(one)
    for one, work in before.items():
        works[one] = work
        circle.add(one, work.lap, work.count, work.enter)
