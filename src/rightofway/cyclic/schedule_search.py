"""The timetable of one group: many first ones, the best improved, none below its rival."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import count, islice
from typing import Literal

import numpy as np

from rightofway.cyclic.from_plan import jointly
from rightofway.cyclic.from_run import cut_out, rival_of, runs_of
from rightofway.cyclic.insertion import build, filled
from rightofway.cyclic.lns import improve
from rightofway.cyclic.problem import Choice, CyclicProblem, Work
from rightofway.cyclic.result import GroupRun
from rightofway.cyclic.route import CyclicRoute
from rightofway.cyclic.run import run_group
from rightofway.cyclic.windows import windows
from rightofway.errors import GaveUp
from rightofway.model import Scenario, Tick
from rightofway.planners import Task
from rightofway.precedence import CyclicSchedule, unrolled

__all__ = ["GroupTimetable", "choose"]

LARGE = 100
"""Groups of more robots have a stretch of a run, if one can be closed: they have no time to choose.
"""

RIVAL_SHARE = 0.2
"""The part of its time that a group may take to see what first come first served does."""

OTHERS_SHARE = 0.05
"""The part of what is left that each other rule may take."""

CUTTING_SHARE = 0.25
"""The part of what is left that goes into timetables cut out of that run."""

CLOSING_SHARE = 0.6
"""The part of that in which they are cut; in the rest the best get more laps."""

CUT, SHORT = 2, 4_000
"""How many more are kept than the best; how many visits they have at most: these improve soon."""

BUILDING_SHARE = 0.2
"""The part of what is left then that goes into first timetables."""

MANY, FILLING_SHARE = 300, 0.3
"""Groups of more robots are built once and filled; there is hardly time to improve them."""

PLACING_SHARE = 0.7
"""The part of what is left that the very first one may take to find every robot a place."""

TRYING_SHARE = 0.5
"""The part of what is left then that shows which of those kept is worth going on with."""

GOING_ON_SHARE = 0.7
"""The part of the rest in which the best of those is improved; what remains is for the best of all.
"""

LONGEST_PERIOD = 5
"""First timetables have periods of at most so many of the longest laps."""

KEPT = 3
"""How many first timetables are improved a little, before one of them is gone on with."""

MOST_VISITS = 20_000
"""A cycle time that is a fraction becomes whole in more periods, up to so many visits."""


FirstComeEnds = Literal["repeats", "starves", "deadlock", "open"]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class GroupTimetable:
    """The timetable chosen for a group of robots that have to do with each other.

    Attributes
    ----------
    timetable
        Laps, how many each robot makes in a period, and when.
    worth
        What the laps of a period are worth in all; without weights: how many there are.
    fairness
        The least part of its laps alone that any robot makes, 0 to 1.
    first_come_ends
        How first come first served ends on the usual ways: as in `GroupRun`, or ``starves`` if it
        repeats for ever while a robot stands still.
    first_come
        What its laps are worth per tick: of its pattern, or of the laps that were seen; 0 in a
        deadlock.
    """

    timetable: CyclicSchedule
    worth: Fraction
    fairness: Fraction
    first_come_ends: FirstComeEnds
    first_come: Fraction

    @property
    def throughput(self) -> Fraction:
        """What its laps are worth per tick."""
        return self.worth / int(self.timetable.period)


def choose(
    scenario: Scenario,
    group: Sequence[CyclicRoute],
    shift: CyclicProblem,
    *,
    rounds: int | None = None,
) -> GroupTimetable:
    """Choose the timetable of a group.

    Parameters
    ----------
    scenario
        The problem.
    group
        The usual round trips of its robots.
    shift
        What there is to choose from, and what for.
    rounds
        How many first timetables to build, and in how many steps to improve each that is kept.

    Raises
    ------
    GaveUp
        If none was found in which all robots have a place and nobody starves.
    """
    if len(group) == 1:
        alone = _alone(shift)
        return _told(shift, alone, "repeats", shift.worth((1,)) / int(alone.period))
    if len(group) > LARGE and (long := _long(scenario, group, shift)):
        return long
    rival = _run(scenario, group, shift, "first-come", RIVAL_SHARE)
    pattern, (ends, worth) = rival.timetable, _rival(shift, rival)
    is_fair = pattern is not None and shift.is_fair(pattern.counts, int(pattern.period))
    others = _by_other_rules(scenario, group, shift)
    starts = [*others, *_cut(shift, rival), *_first_timetables(shift, rounds)]
    if pattern is not None and is_fair:
        starts.append(shift.tightened(pattern))
    if not starts and (together := jointly(scenario, shift)):
        shift = shift.also(together.timetable.laps)
        starts = [together]
    if not starts or not shift.is_fair(starts[0].timetable.counts, starts[0].cycle_time):
        raise GaveUp(_nothing(shift))
    whole = _whole(shift, _improved(shift, starts, rounds))
    if pattern is not None and is_fair and worth > _value(shift, whole):
        whole = pattern
    return _told(shift, whole, ends, worth)


def _long(
    scenario: Scenario, group: Sequence[CyclicRoute], shift: CyclicProblem
) -> GroupTimetable | None:
    """Return the timetable of a long stretch of a run, or the rival's pattern if that is better."""
    if shift.deadline.at is None:
        return None
    rival = rival_of(scenario, group, shift)
    found = cut_out(shift, runs_of(scenario, rival, group, shift))
    pattern = rival.run.timetable
    some = [one for one in (found, pattern) if one is not None]
    fair = [one for one in some if shift.is_fair(one.counts, int(one.period))]
    if not fair:
        return None
    best = max(fair, key=lambda one: _value(shift, one))
    return _told(shift, best, *_rival(shift, rival.run))


def _rival(shift: CyclicProblem, rival: GroupRun) -> tuple[FirstComeEnds, Fraction]:
    """Return how first come first served ends, and what its laps are worth per tick."""
    starves = rival.ends == "repeats" and rival.timetable is None
    worth = Fraction(0) if rival.ends == "deadlock" else rival.rate(shift.weights)
    return "starves" if starves else rival.ends, worth


def _nothing(shift: CyclicProblem) -> str:
    who = f"{len(shift.robots)} robots that have to do with each other"
    if shift.least_fairness:
        return f"no timetable was found for {who} that is fair enough (ask for less, or give time)"
    return f"no timetable was found for {who} (give more time)"


def _alone(shift: CyclicProblem) -> CyclicSchedule:
    """Return the timetable of a robot that meets nobody."""
    lap = min(shift.ways[0], key=lambda lap: lap.duration)
    enter = np.cumsum([0, *(lap.least(visit) for visit in range(len(lap) - 1))])
    return shift.timetable([Work(lap, 1, enter)], int(lap.duration))


def _run(
    scenario: Scenario, group: Sequence[CyclicRoute], shift: CyclicProblem, rule: str, share: float
) -> GroupRun:
    """Let the group go on by a rule."""
    task = Task(
        scenario=scenario,
        options={"swaps": "resolve"},
        deadline=shift.deadline.sooner(share),
    )
    return run_group(task, group, rule)


def _by_other_rules(
    scenario: Scenario, group: Sequence[CyclicRoute], shift: CyclicProblem
) -> Iterator[Choice]:
    """Yield the patterns of the other rules that are soon found; where time is not limited, none.

    Nothing says that a pattern is found at all, and these are no rivals but one more chance.
    """
    if shift.deadline.at is None or len(group) > MANY:
        return
    for rule in ("two-level", "fixed-order"):
        found = _run(scenario, group, shift, rule, OTHERS_SHARE).timetable
        if found is not None and shift.is_fair(found.counts, int(found.period)):
            yield shift.tightened(found)


def _cut(shift: CyclicProblem, run: GroupRun) -> list[Choice]:
    """Return the best timetables cut out of a run, with more laps where there is room."""
    if not all(run.mean_laps()):
        return []
    part = shift.until(shift.deadline.sooner(CUTTING_SHARE))
    closing = part.until(part.deadline.sooner(CLOSING_SHARE))
    cut = windows(closing, run)
    fair = [one for one in cut if shift.is_fair(one.timetable.counts, one.cycle_time)]
    best = sorted(fair, key=shift.value, reverse=True)
    short = [one for one in best if one.visits <= SHORT]
    kept = dict.fromkeys((*best[:1], *short[:CUT]))
    return [max(one, filled(part, *part.on_circle(one)), key=shift.value) for one in kept]


def _value(shift: CyclicProblem, timetable: CyclicSchedule) -> Fraction:
    return shift.worth(timetable.counts) / int(timetable.period)


def _first_timetables(shift: CyclicProblem, rounds: int | None) -> Iterator[Choice]:
    """Yield the best of many timetables, built for periods of all kinds."""
    few = len(shift.robots) <= MANY
    building = shift.until(shift.deadline.sooner(BUILDING_SHARE if few else FILLING_SHARE))
    first = shift.until(shift.deadline.sooner(PLACING_SHARE))
    built: list[Choice] = []
    for number in islice(count(), rounds):
        longest = max(shift.alone)
        times = shift.draw.uniform(1, LONGEST_PERIOD) if number else 1.2
        try:
            placing = building if built else first
            built.append(build(placing, int(longest * times), filling=building))
        except GaveUp:
            break
        if shift.value(built[-1]) == shift.bound:
            break
    fair = [one for one in built if shift.is_fair(one.timetable.counts, one.cycle_time)]
    yield from sorted(fair, key=shift.value, reverse=True)[:KEPT]


def _improved(shift: CyclicProblem, starts: Sequence[Choice], rounds: int | None) -> Choice:
    """Improve all that are short a little, go on with the best of these, then with the best."""
    net = max(starts, key=shift.value)
    short = [start for start in starts if start.visits <= SHORT] or [net]
    trying = shift.deadline.sooner(TRYING_SHARE)
    tried = []
    for index, start in enumerate(short):
        share = shift.until(trying.sooner(1 / (len(short) - index)))
        tried.append(improve(share, start, steps=rounds))
    going_on = shift.until(shift.deadline.sooner(GOING_ON_SHARE))
    best = improve(going_on, max(tried, key=shift.value), steps=rounds)
    return improve(shift, max(net, best, key=shift.value), steps=rounds)


def _whole(shift: CyclicProblem, choice: Choice) -> CyclicSchedule:
    """Return the timetable as tight as it can be in whole ticks."""
    timetable, parts = choice.timetable, choice.cycle_time.denominator
    if parts * sum(map(len, timetable.enter)) <= MOST_VISITS:
        timetable = unrolled(timetable, parts)
        whole = choice.cycle_time.numerator
        return shift.graph(timetable).earliest(Tick(whole), cycle_time=Fraction(whole))
    return shift.graph(timetable).earliest(Tick(choice.period), cycle_time=choice.cycle_time)


def _told(
    shift: CyclicProblem,
    timetable: CyclicSchedule,
    ends: FirstComeEnds,
    first_come: Fraction,
) -> GroupTimetable:
    return GroupTimetable(
        timetable=timetable,
        worth=shift.worth(timetable.counts),
        fairness=shift.fairness(timetable.counts, int(timetable.period)),
        first_come_ends=ends,
        first_come=first_come,
    )
