"""A run of laps as an ordinary plan, with whole laps for each robot."""

from __future__ import annotations

from dataclasses import replace

from rightofway.check import check
from rightofway.cyclic.result import CyclicResult, GroupRun
from rightofway.errors import GaveUp
from rightofway.model import NEVER, Plan, PlannerRun, Track

__all__ = ["plan_of", "whole_laps"]


def plan_of(run: CyclicResult, laps: int | None = None) -> Plan:
    """Turn a run into a plan that the judge has passed.

    Parameters
    ----------
    run
        What the fleet did.
    laps
        How many laps each robot makes. If None, as many as it completes until each group's
        transient and one more period are over, or until the first group was not followed further.

    Raises
    ------
    GaveUp
        If there is no such plan: the run ended before a robot had made its laps, or a robot that
        has come home for the last time stands in the way of others.
    """
    plan = whole_laps(run, laps)
    report = check(plan)
    if not report.ok:
        raise GaveUp(
            "whole laps make no plan here, as a robot that is home for the last time stays there:"
            f" {report.faults[0].message}"
        )
    return plan


def whole_laps(run: CyclicResult, laps: int | None = None) -> Plan:
    """Return what `plan_of` has judged; robots that have come home may be in the way of others.

    Raises
    ------
    GaveUp
        If a robot was not followed for so many laps.
    """
    until = _until(run)
    tracks, robots = {}, list(run.scenario.robots)
    for group in run.groups:
        for index, robot in enumerate(group.robots):
            own = laps or max(_laps_by(group, index, until), 1)
            if not group.pattern and own > group.laps_made()[index]:
                raise GaveUp(f"{robots[robot].name} was not followed for {own} laps")
            if group.pattern and not group.pattern.counts[index]:
                raise GaveUp(f"{robots[robot].name} waits for ever (choose another rule)")
            robots[robot] = replace(robots[robot], laps=own)
            tracks[robot] = _track(group, index, own)
    return Plan(
        scenario=replace(run.scenario, robots=tuple(robots)),
        tracks=tuple(tracks[robot] for robot in range(len(robots))),
        run=PlannerRun(
            name="laps", options={"rule": run.rule, "routes": run.routes}, status="whole laps"
        ),
    )


def _until(run: CyclicResult) -> int:
    """Return until when the run is worth to be seen [ticks]."""
    worth = (p.transient + 2 * p.period for group in run.groups if (p := group.pattern))
    known = (max(past[-1] for past in group.history) for group in run.groups if not group.pattern)
    return min([max(worth, default=NEVER), *known])


def _laps_by(group: GroupRun, index: int, until: int) -> int:
    length, laps = len(group.group[index].lap), 0
    while _reaches(group, index, (laps + 1) * length, until):
        laps += 1
    return laps


def _reaches(group: GroupRun, index: int, visit: int, until: int) -> bool:
    if group.pattern is None or not group.pattern.counts[index]:
        past = group.history[index]
        return visit < len(past) and past[visit] <= until
    return group.pattern.enter(index, visit) <= until


def _track(group: GroupRun, index: int, laps: int) -> Track:
    visits = range(laps * len(group.group[index].lap) + 1)
    endless, past = group.group[index], group.history[index]
    enter = group.pattern.enter if group.pattern else (lambda _, visit: past[visit])
    return Track.of(
        [endless.vertex(visit) for visit in visits], [enter(index, visit) for visit in visits]
    )
