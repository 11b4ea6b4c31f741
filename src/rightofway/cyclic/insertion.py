"""A first timetable: one robot after another finds its place, then as many laps as fit.

Whoever stands in the way of a robot that finds no place is taken off and has to look again. Where
that comes to no end, the period is too short.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from heapq import heapify, heappop, heappush

from rightofway.cyclic.problem import Choice, CyclicProblem, Work
from rightofway.errors import GaveUp
from rightofway.search import PeriodicBookings

__all__ = ["build", "filled"]

MOST_ROUNDS = 6
"""How often each robot is placed, on average, before a period is found too short."""

GROWS = 5, 4
"""By which fraction a period grows that is found too short."""


def build(shift: CyclicProblem, period: int, *, filling: CyclicProblem | None = None) -> Choice:
    """Return a timetable.

    Parameters
    ----------
    shift
        Who is to find a place, and until when.
    period
        Its period is at least so many ticks.
    filling
        The same, with another deadline for more than one lap each.

    Raises
    ------
    GaveUp
        If none was found, or time ran out.
    """
    longest = max(shift.alone)
    period = max(period, longest)
    one_by_one = 2 * sum(shift.alone)
    while period <= one_by_one:
        placed = _placed(shift, period)
        if placed is not None:
            return filled(filling or shift, *placed)
        period = period * GROWS[0] // GROWS[1] + 1
    raise GaveUp("no timetable was found in which all robots have a place")


def _placed(shift: CyclicProblem, period: int) -> tuple[PeriodicBookings, list[Work]] | None:
    """Give every robot one lap in the period; None if that comes to no end."""
    circle, works = shift.circle(period), dict[int, Work]()
    order = sorted(range(len(shift.robots)), key=lambda place: -shift.alone[place])
    queue = deque(order)
    for _ in range(MOST_ROUNDS * len(order)):
        if not queue:
            return circle, [works[place] for place in range(len(order))]
        shift.deadline.check("finding every robot a place")
        place = queue.popleft()
        work = shift.place(circle, place, 1)
        while work is None:
            away = _in_the_way(shift, circle, place, works)
            if away is None:
                return None
            circle.remove(away)
            del works[away]
            queue.append(away)
            work = shift.place(circle, place, 1, tries=1)
        _add(circle, works, place, work)
    return None if queue else (circle, [works[place] for place in range(len(order))])


def _in_the_way(
    shift: CyclicProblem, circle: PeriodicBookings, place: int, works: dict[int, Work]
) -> int | None:
    """Return a robot to take off, so that another finds its place; None if nobody is left."""
    lap = shift.draw.choice(shift.ways[place])
    circle.search(lap, 1, shift.draw.randrange(int(circle.period)))
    near = sorted(circle.users([circle.stuck_at(lap)]) & works.keys())
    near = near or sorted(circle.users(lap.vertices))
    return shift.draw.choice(near) if near else None


def _add(circle: PeriodicBookings, works: dict[int, Work], place: int, work: Work) -> None:
    circle.add(place, work.lap, work.count, work.enter)
    works[place] = work


def filled(shift: CyclicProblem, circle: PeriodicBookings, works: list[Work]) -> Choice:
    """Let robots make more laps as long as there is room, first who makes least of its own."""
    for place in _behind(shift, circle, works):
        work = works[place]
        circle.remove(place)
        more = _more(shift, circle, place, work)
        works[place] = more or work
        circle.add(place, works[place].lap, works[place].count, works[place].enter)
    return shift.tightened(shift.timetable(works, int(circle.period)))


def _more(shift: CyclicProblem, circle: PeriodicBookings, place: int, work: Work) -> Work | None:
    """Find room for half as many laps again, or for one more; on the same way, or on any."""
    most = int(circle.period) // shift.alone[place]
    many = min(work.count + max(work.count // 2, 1), most)
    for count in dict.fromkeys((many, work.count + 1)):
        more = shift.place(circle, place, count, lap=work.lap)
        if more is not None:
            return more
    return shift.place(circle, place, work.count + 1, tries=1) if shift.has_ways(place) else None


def _behind(shift: CyclicProblem, circle: PeriodicBookings, works: list[Work]) -> Iterator[int]:
    """Yield whose turn it is to get one more lap, until nobody did since its last turn."""
    turns = [
        (work.count * alone, place)
        for place, (work, alone) in enumerate(zip(works, shift.alone, strict=True))
    ]
    heapify(turns)
    while turns and shift.deadline.seconds_left() != 0:
        _, place = heappop(turns)
        before, alone = works[place].count, shift.alone[place]
        if (before + 1) * alone <= circle.period:
            yield place
        if works[place].count > before:
            heappush(turns, (works[place].count * alone, place))
