"""The judge: the faults of any plan, each with robots, place and time.

It reads the scenario in ticks and the tracks, nothing else: no planner, no search, no native core.
"""

from __future__ import annotations

from itertools import chain

from rightofway.check.batteries import judge_batteries
from rightofway.check.closures import judge_barred, judge_closures
from rightofway.check.conflicts import judge_bookings, judge_rotations, judge_swaps
from rightofway.check.faults import Fault, FaultGroup, FaultKind, Report, make_report
from rightofway.check.space import judge_space
from rightofway.check.tracks import judge_drives, judge_stops, judge_trips, judge_turns
from rightofway.check.visits import lay_out_visits
from rightofway.check.work import judge_work
from rightofway.check.zones import judge_zones
from rightofway.kinds.arguments import checks_arguments
from rightofway.kinds.table import make_whole
from rightofway.model import Plan

__all__ = ["Fault", "FaultKind", "Report", "check"]


@checks_arguments
def check(plan: Plan, *, limit: int = 1000) -> Report:
    """Judge a plan.

    Parameters
    ----------
    plan
        Any plan; however wrong it is, it is judged and not refused.
    limit
        The largest number of faults to list, the earliest first; all are counted.

    Returns
    -------
    Report
        Its `ok` is true if the plan keeps every rule.

    Notes
    -----
    A visit books its vertex for ``[enter - approach, leave + headway)``. The approach is the drive
    into the vertex if robots book both ends of an edge, otherwise 0; a first visit has none, and a
    last visit never ends. Bookings of one vertex by different robots must not overlap.

    A robot with a turn rate turns on the spot between two edges before it drives on, and does no
    work meanwhile.

    Stops are matched to visits greedily: a robot works as early as it can, on several stops in one
    visit if they follow each other at one vertex. A visit too short for that is only passing.

    Robots with a size book the edges that they drive along, too. Bookings of places that are nearer
    than the radii and the clearance allow must not overlap either, and no two robots may ever be
    nearer than that, at any instant of stays and straight, uniform drives; both are judged exactly.

    Robots only drive through a passed vertex. All that such a drive touches, both ends included, is
    booked from the begin of the drive to its end.

    With jobs, a plan names the visit, the begin and the end of all work and charges, and robots may
    drive anywhere between them. Each job is done whole, in order, by one robot, or is unserved.

    The state of charge of a battery is followed exactly. It falls at the end of each drive, during
    work, and until the robot rests; in a charge it only rises.

    A closure is a booking without a robot and without headway; a robot's booking has its own.
    """
    visits = lay_out_visits(plan)
    limit = make_whole(0, 2**31 - 1).read_at("limit", limit)
    faults = chain[Fault | FaultGroup](
        judge_drives(visits),
        judge_turns(visits),
        judge_stops(visits),
        judge_trips(visits),
        judge_work(visits),
        judge_batteries(visits),
        judge_bookings(visits),
        judge_swaps(visits),
        judge_rotations(visits),
        judge_space(visits),
        judge_zones(visits),
        judge_barred(visits),
        judge_closures(visits),
    )
    return make_report(faults, limit)
