"""Large neighbourhood search on the circle: take robots of the bottleneck off, put them on better.

The value of a timetable is what its laps are worth by its cycle time. To raise it, the laps of some
robot may become more or fewer, and the period has to be as short as makes up for it. The robots on
the critical circuits are taken off until the others alone could keep that period; these are timed
anew for it, in their old orders, and those taken off look for a place among them, on any of their
ways. So a step may turn one right of way, or all that a robot has, for whole segments at once.

References
----------
Shaw, *Using constraint programming and local search methods to solve vehicle routing problems*,
CP 1998 (large neighbourhood search).

Notes
-----
Never worse than the timetable it starts from. Anytime; deterministic for a seed where the steps
come to an end in time. Not optimal.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from rightofway.cyclic.crowding import crowded
from rightofway.cyclic.problem import Choice, CyclicProblem, Work
from rightofway.errors import GaveUp
from rightofway.model import Tick
from rightofway.precedence import CyclicSchedule, unrolled

__all__ = ["improve"]

MOST_TAKEN = 6
"""How many robots at most a step takes off the circle."""

CROWDS_AFTER = 10
"""Every so many steps, laps are added on the circle as it is."""

PATIENCE = 60
"""After so many steps in vain a period becomes two, so that laps can be shared out more finely."""

MOST_VISITS = 8_000
"""No period gets more visits by becoming two; on a longer one laps are added at most."""


def improve(shift: CyclicProblem, choice: Choice, *, steps: int | None = None) -> Choice:
    """Make what the laps of a group are worth per tick as large as steps and time allow."""
    best, in_vain, step = choice, 0, 0
    try:
        while (steps is None or step < steps) and shift.value(best) < shift.bound:
            shift.deadline.check("improving a timetable")
            step += 1
            crowds = step % CROWDS_AFTER == 0 or choice.visits > MOST_VISITS
            found = crowded(shift, choice) if crowds else _step(shift, choice)
            in_vain += 1
            if found is None or not shift.is_fair(found.timetable.counts, found.cycle_time):
                pass
            elif shift.value(found) > shift.value(choice):
                best, choice, in_vain = found, found, 0
            else:
                choice = found
            if in_vain >= PATIENCE:
                choice, in_vain = _doubled(choice), 0
    except GaveUp:
        pass
    return best


def _doubled(choice: Choice) -> Choice:
    """Return two periods as one, if that is not too long."""
    if 2 * choice.visits > MOST_VISITS:
        return choice
    return Choice(unrolled(choice.timetable, 2), choice.cycle_time * 2)


def _step(shift: CyclicProblem, choice: Choice) -> Choice | None:
    """Return a timetable that is at least as good, or None if this step finds none."""
    changed, counts = _other_counts(shift, choice)
    worth = shift.worth(counts) / shift.value(choice)
    most = worth.numerator // worth.denominator  # with this period it is as good as before
    taken = [changed] if changed is not None else []
    rest = _rest(shift, choice, taken, most)
    if rest is None:
        return None
    taken, least = rest
    least = max(
        least,
        *(count * alone for count, alone in zip(counts, shift.alone, strict=True)),
    )
    period = shift.draw.choice((most, most, most - 1, shift.draw.randint(least, max(most, least))))
    period = max(period, least)
    if period > most or not shift.is_fair(counts, period):
        return None
    return _put_back(shift, choice, counts, taken, period)


def _other_counts(shift: CyclicProblem, choice: Choice) -> tuple[int | None, list[int]]:
    """Return a robot that is to make a lap more or fewer, or None, and all counts then."""
    counts = list(choice.timetable.counts)
    place, more = shift.draw.randrange(len(counts)), shift.draw.choice((0, 0, 1, 1, -1))
    if more == 0 or counts[place] + more < 1:
        return None, counts
    counts[place] += more
    return place, counts


def _rest(
    shift: CyclicProblem, choice: Choice, taken: list[int], most: int
) -> tuple[list[int], int] | None:
    """Take robots of the bottleneck off until the others can keep the period; and a few more.

    Returns whom, and the least period of the others; None if it takes too many.
    """
    extra = shift.draw.choice((0, 0, 1, 2))
    while len(taken) <= MOST_TAKEN:
        left = [place for place in range(len(shift.robots)) if place not in taken]
        if not left:
            return taken, 1
        graph = shift.graph(_part(choice.timetable, left))
        circuit = graph.critical_circuit()
        on = sorted({left[robot] for robot in graph.robot[graph.arcs.head[circuit.arcs]].tolist()})
        if taken and circuit.cycle_time <= most:
            if not extra:
                return taken, -(-circuit.cycle_time.numerator // circuit.cycle_time.denominator)
            extra -= 1
        taken = [*taken, shift.draw.choice(on)]
    return None


def _part(timetable: CyclicSchedule, places: Sequence[int]) -> CyclicSchedule:
    """Return the timetable of some of the robots."""
    return replace(
        timetable,
        robots=tuple(timetable.robots[place] for place in places),
        laps=tuple(timetable.laps[place] for place in places),
        counts=tuple(timetable.counts[place] for place in places),
        enter=tuple(timetable.enter[place] for place in places),
    )


def _put_back(
    shift: CyclicProblem, choice: Choice, counts: Sequence[int], taken: Sequence[int], period: int
) -> Choice | None:
    """Time the others for a period and find those taken off a place among them."""
    works = _timed(shift, choice, taken, period)
    circle = shift.circle(period)
    for place, work in works.items():
        circle.add(place, work.lap, work.count, work.enter)
    for place in shift.draw.sample(list(taken), len(taken)):
        found = shift.place(circle, place, counts[place])
        if found is None:
            return None
        circle.add(place, found.lap, found.count, found.enter)
        works[place] = found
    joined = [works[place] for place in range(len(shift.robots))]
    return shift.tightened(shift.timetable(joined, period))


def _timed(
    shift: CyclicProblem, choice: Choice, taken: Sequence[int], period: int
) -> dict[int, Work]:
    """Return what the robots do that were not taken off, as early as they can in that period."""
    left = [place for place in range(len(shift.robots)) if place not in taken]
    if not left:
        return {}
    rest = shift.graph(_part(choice.timetable, left)).earliest(Tick(period))
    return {
        place: Work(lap, count, enter)
        for place, lap, count, enter in zip(left, rest.laps, rest.counts, rest.enter, strict=True)
    }
