"""What the page is told about robots that repeat themselves."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from rightofway.model import Plan, SteadyState, Track
from rightofway.model.steady_state import refuse_unknown_robots
from rightofway.viz.motion import Trip

__all__ = ["laps_of", "last_tick_of_all", "steady_of"]


def steady_of(plan: Plan, steady: Sequence[SteadyState]) -> list[dict[str, Any]]:
    """Return the steady periods of a plan, as plain data for JSON.

    Parameters
    ----------
    plan
        The plan.
    steady
        Groups of its robots.

    Raises
    ------
    InputError
        If these are no groups of the plan.
    """
    names = [robot.name for robot in plan.scenario.robots]
    refuse_unknown_robots(steady, names, list(map(len, plan.tracks)))
    return [
        {
            "robots": list(group.robots),
            "start": group.start,
            "period": group.period,
            "until": min(_until(group, plan.tracks[robot]) for robot in group.robots),
            "critical": [list(visit) for visit in group.critical],
        }
        for group in steady
    ]


def laps_of(plan: Plan) -> list[int]:
    """Return how many laps each robot makes."""
    return [robot.laps or plan.scenario.rules.laps for robot in plan.scenario.robots]


def last_tick_of_all(trips: Sequence[Trip], groups: Sequence[dict[str, Any]]) -> int:
    """Return until when all robots are out on laps, but those that stand still for ever.

    What comes later is not what they repeat.
    """
    untils = {robot: group["until"] for group in groups for robot in group["robots"]}
    ends: list[int] = [
        untils.get(robot, trip.enter[-1])
        for robot, trip in enumerate(trips)
        if robot in untils or min(trip.served) >= 0
    ]
    return max(1, min(ends))


def _until(group: SteadyState, track: Track) -> int:
    """Return the tick up to which a robot does what it did a period before.

    A plan ends, so the first visit that is missing or comes at another tick ends the repetition:
    it is sure up to the visit before.
    """
    first, again = np.searchsorted(track.enter, (group.start, group.start + group.period), "right")
    shift = int(again - first)
    if shift == 0 or track.vertices[again - 1] != track.vertices[first - 1]:
        return group.start
    before, after = slice(first, len(track) - shift), slice(again, None)
    same = (track.enter[after] - track.enter[before] == group.period) & (
        track.vertices[after] == track.vertices[before]
    )
    repeated = len(same) if same.all() else int(np.argmin(same))
    return int(track.enter[again - 1 + repeated])
