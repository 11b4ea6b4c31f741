"""A timetable of one plan for the whole fleet, made again and again: all start and end at home.

It takes as long as the plan. But its orders need not: the event graph lets robots set out anew
while others are still on their way, and so the cycle time is shorter. Above all there is such a
timetable wherever there is a plan, on other routes if the usual ones end in a deadlock.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from rightofway.cyclic.problem import Choice, CyclicProblem, Work
from rightofway.errors import GaveUp, NoPlanExists
from rightofway.model import Itinerary, Lap, Plan, Scenario, Track, lap_of, route_of
from rightofway.precedence import CyclicSchedule
from rightofway.solve import solve

__all__ = ["jointly", "one_lap"]

MOST_SECONDS = 60
"""For a plan, where time is not limited."""


def jointly(scenario: Scenario, shift: CyclicProblem) -> Choice | None:
    """Return the timetable of a plan in which each robot makes one lap; None if none was found.

    Parameters
    ----------
    scenario
        The problem.
    shift
        The group, and until when.
    """
    part = _part(scenario, shift.robots)
    seconds = shift.deadline.seconds_left()
    try:
        plan = solve(
            part,
            planner="lacam",
            time_limit=MOST_SECONDS if seconds is None else seconds,
            seed=shift.draw.randrange(2**31),
        )
    except (GaveUp, NoPlanExists):
        return None
    timetable = _repeated(scenario, shift, plan)
    if timetable is None or shift.graph(timetable).slack().min() < 0:
        return None
    return shift.tightened(timetable)


def _part(scenario: Scenario, robots: Sequence[int]) -> Scenario:
    """Return the problem of some robots that make one lap each."""
    some = tuple(replace(scenario.robots[robot], laps=1) for robot in robots)
    return replace(scenario, robots=some)


def _repeated(scenario: Scenario, shift: CyclicProblem, plan: Plan) -> CyclicSchedule | None:
    """Return the plan again and again; None where others' ticks leave it no whole ones."""
    factor = plan.scenario.problem.clock.tick / scenario.problem.clock.tick
    if factor.denominator != 1 or shift.forbidden.intersection(_places(plan)):
        return None
    tracks = [
        Track(vertices=track.vertices, enter=track.enter * factor.numerator)
        for track in plan.tracks
    ]
    laps = [_lap(scenario, *one) for one in zip(shift.robots, tracks, strict=True)]
    ends = [int(track.enter[-1]) for track in tracks]
    apart = int(shift.headway) + max(max(lap.drive) + lap.dwell[0] for lap in laps)
    period = max(ends) + apart
    works = []
    for lap, track, end in zip(laps, tracks, ends, strict=True):
        enter = track.enter[:-1].copy()
        enter[0] = end - period
        works.append(Work(lap, 1, enter + (period if enter[0] < 0 else 0)))
    return shift.timetable(works, period)


def _places(plan: Plan) -> set[int]:
    return {vertex for track in plan.tracks for vertex in track.vertices.tolist()}


def _lap(scenario: Scenario, robot: int, track: Track) -> Lap:
    once = one_lap(scenario, robot)
    return lap_of(once, route_of(scenario.roadmap, once, track))


def one_lap(scenario: Scenario, robot: int) -> Itinerary:
    """Return what a robot has to do in one lap."""
    itinerary = scenario.problem.itineraries[robot]
    return replace(itinerary, stages=itinerary.stages[: len(scenario.robots[robot].stops) + 1])
