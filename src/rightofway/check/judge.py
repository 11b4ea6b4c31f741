"""All rules, one after the other."""

from __future__ import annotations

from rightofway.check.drives import judge_drives
from rightofway.check.exchanges import judge_rotations, judge_swaps
from rightofway.check.meetings import judge_meetings
from rightofway.check.report import Report
from rightofway.check.sieve import Sieve
from rightofway.check.trips import judge_trips
from rightofway.check.visits import visits_of
from rightofway.check.words import Words
from rightofway.model import Plan

__all__ = ["check"]


def check(plan: Plan, *, limit: int = 1000) -> Report:
    """Judge a plan.

    Parameters
    ----------
    plan
        Any plan; however wrong it is, it is judged and not refused.
    limit
        How many faults to list, the earliest first; all are counted.

    Returns
    -------
    Report
        Its `ok` is true if the plan keeps every rule.

    Notes
    -----
    A visit books its vertex for ``[enter - approach, leave + headway)``. The approach is the drive
    into the vertex where robots book both ends of an edge, else nothing; a first visit has none,
    and a last visit never ends. Bookings of one vertex by different robots must not overlap.

    Stops are matched to visits greedily: a robot works as early as it can, on several stops in one
    visit if they follow each other at one vertex. A visit too short for that is only passing.
    """
    visits = visits_of(plan)
    words = Words(plan.scenario)
    sieve = Sieve(limit)
    judge_drives(visits, words, sieve)
    judge_trips(plan, visits, words, sieve)
    judge_meetings(plan, visits, words, sieve)
    judge_swaps(visits, words, sieve)
    if not plan.scenario.rules.rotations:
        judge_rotations(visits, words, sieve)
    return sieve.report()
