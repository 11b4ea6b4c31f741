"""What the page is told about a run of a plan on the floor."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from rightofway.errors import InputError
from rightofway.metrics.stays import Stays, stays_of
from rightofway.metrics.waits import waits_in
from rightofway.model import Actual, Plan, Tick, Track
from rightofway.viz.page.figures import differences, wait_row

__all__ = ["floor_of"]


def floor_of(plan: Plan, actual: Actual) -> dict[str, Any]:
    """Return what became of a plan, as plain data for JSON.

    Parameters
    ----------
    plan
        The plan.
    actual
        A run of it; times are ticks of the plan.

    Raises
    ------
    InputError
        If a robot is missing, or went another way than planned.
    """
    _refuse_other_ways(plan, actual)
    planned = stays_of(plan.scenario, plan.tracks)
    stays = tuple(map(_stays, planned, actual.tracks, actual.held))
    broken = actual.broken or (None,) * len(stays)
    completions = [
        stay.completion if len(track) == len(whole) else None
        for stay, track, whole in zip(stays, actual.tracks, plan.tracks, strict=True)
    ]
    return {
        "end": max(*_ends(stays), *(tick or 0 for tick in broken), 1),
        "robots": [
            {
                "enter": differences(track.enter),
                "held": [[int(visit), int(held[visit])] for visit in np.flatnonzero(held)],
                "completion": completion,
                "broken": tick,
            }
            for track, held, completion, tick in zip(
                actual.tracks, actual.held, completions, broken, strict=True
            )
        ],
        "waits": [wait_row(wait) for wait in waits_in(plan.scenario, actual.tracks, stays)],
    }


def _refuse_other_ways(plan: Plan, actual: Actual) -> None:
    if len(actual.tracks) != len(plan.tracks):
        counts = f"{len(actual.tracks)} for {len(plan.tracks)} robots"
        raise InputError.at("tracks", f"{counts} (give one for each)")
    for robot, (whole, track) in enumerate(zip(plan.tracks, actual.tracks, strict=True)):
        if not np.array_equal(track.vertices, whole.vertices[: len(track)]):
            message = "goes another way than planned (give the planned vertices, or the first)"
            raise InputError.at(f"tracks[{robot}]", message)


def _stays(planned: Stays, track: Track, held: np.ndarray[Any, np.dtype[np.int64]]) -> Stays:
    """Return what the visits of a track are for: as planned, and being held up."""
    reached = len(track)
    dwell = planned.dwell[:reached] + held
    drive = np.append(planned.drive[: reached - 1], 0)
    waits = np.append(np.diff(track.enter), 0) - drive - dwell
    waits[-1] = 0
    return replace(
        planned,
        dwell=dwell,
        drive=drive,
        waits=waits,
        completion=Tick(int(track.enter[-1] + dwell[-1])),
    )


def _ends(stays: Sequence[Stays]) -> Iterator[int]:
    return (stay.completion for stay in stays)
