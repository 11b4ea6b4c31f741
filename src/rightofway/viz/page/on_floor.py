"""What the page is told about a run of a plan on the floor."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rightofway.errors import InputError
from rightofway.metrics.waits import waits_in
from rightofway.model import ExecutionTrace, Plan, Stays, Tick, Track
from rightofway.viz.motion import Trip, trips_of
from rightofway.viz.page.figures import differences, wait_row

__all__ = ["floor_of"]

Stoppages = Sequence[tuple[Tick, Tick | None]]


def floor_of(plan: Plan, actual: ExecutionTrace, trips: Sequence[Trip]) -> dict[str, Any]:
    """Return what became of a plan, as plain data for JSON.

    Parameters
    ----------
    plan
        The plan.
    actual
        A run of it; times are ticks of the plan.
    trips
        The planned trip of each robot.

    Raises
    ------
    InputError
        If not every robot has a track.
    """
    if len(actual.tracks) != len(plan.tracks):
        counts = f"{len(actual.tracks)} for {len(plan.tracks)} robots"
        raise InputError.at("actual.tracks", f"{counts} (give one for each)")
    still = actual.stoppages or ((),) * len(trips)
    stays = tuple(map(_stays, actual.tracks, actual.dwell, actual.drive, still))
    anew = trips_of(replace(plan, tracks=actual.tracks, steady=()))
    return {
        "end": max(1, *(stay.completion for stay in stays), *filter(None, actual.completion)),
        "robots": [
            {
                **_way(planned, taken, dwell),
                "enter": differences(taken.enter),
                "drive": drive.tolist(),
                "still": [list(stoppage) for stoppage in stoppages],
                "completion": completion,
            }
            for planned, taken, dwell, drive, stoppages, completion in zip(
                trips, anew, actual.dwell, actual.drive, still, actual.completion, strict=True
            )
        ],
        "waits": [wait_row(wait) for wait in waits_in(plan.scenario, actual.tracks, stays)],
    }


def _way(planned: Trip, taken: Trip, dwell: NDArray[np.int64]) -> dict[str, Any]:
    """Return what a robot did on its way, and the way itself unless it is that of the plan."""
    if taken.vertices == planned.vertices[: len(taken.vertices)]:
        return {"stages": _stages(planned, dwell)}
    return {"stages": _stages(taken, dwell), "vertices": differences(taken.vertices)}


def _stays(
    track: Track, dwell: NDArray[np.int64], drive: NDArray[np.int64], still: Stoppages
) -> Stays:
    """Return what the visits of a track are for; standing still is not waiting."""
    out = np.append(drive[1:], 0)
    stood = dwell + _stood(track, still)
    waits = np.maximum(np.append(np.diff(track.enter), 0) - out - stood, 0)
    waits[-1] = 0
    completion = Tick(int(track.enter[-1] + dwell[-1]))
    return Stays(dwell=stood, drive=out, waits=waits, serves=(), completion=completion)


def _stood(track: Track, still: Stoppages) -> NDArray[np.int64]:
    """Return how much of each visit the robot stood still; nothing for the last one."""
    stood = np.zeros(len(track), np.int64)
    for begin, ticks in still:
        if ticks is not None:
            inside = np.clip(track.enter, begin, begin + ticks)
            stood[:-1] += np.diff(inside)
    return stood


def _stages(trip: Trip, dwell: NDArray[np.int64]) -> list[list[int]]:
    """Return the stages with what they really took, each its part of what the visit took."""
    reached, last = len(dwell), len(trip.vertices) - 1
    planned = np.zeros(reached, np.int64)
    for stage, visit in zip(trip.stages, trip.served, strict=True):
        if 0 <= visit < reached:
            planned[visit] += stage.work + (stage.turn if visit < last else 0)
    pace = [ticks / least if least else 1 for ticks, least in zip(dwell, planned, strict=True)]
    return [
        [stage.vertex, round(stage.work * pace[visit]), round(stage.turn * pace[visit]), visit]
        if 0 <= visit < reached
        else [stage.vertex, stage.work, stage.turn, -1]
        for stage, visit in zip(trip.stages, trip.served, strict=True)
    ]
