"""One run as pages show it: where robots were, and how long each visit and drive took."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rightofway.model import NEVER, ExecutionTrace, Tick
from rightofway.precedence import ActionDependencyGraph, DelaySample

__all__ = ["trace_of"]


def trace_of(
    adg: ActionDependencyGraph, delay_sample: DelaySample, completion: NDArray[np.int64]
) -> ExecutionTrace:
    """Return the run of a plan with these delays.

    Parameters
    ----------
    adg, delay_sample
        The plan as it was in the end, and its delays.
    completion
        When each robot completed, `NEVER` if it did not [ticks]; int64[R].
    """
    tracks = adg.tracks_at(adg.execute(delay_sample).enter)
    visits = [
        slice(first, first + len(track))
        for first, track in zip(adg.first_visit.tolist(), tracks, strict=False)
    ]
    return ExecutionTrace(
        tracks=tracks,
        dwell=tuple(delay_sample.dwell[own] for own in visits),
        drive=tuple(delay_sample.drive[own] for own in visits),
        completion=tuple(None if tick >= NEVER else Tick(tick) for tick in completion.tolist()),
        stoppages=tuple(
            tuple(
                (tick, None if ticks >= NEVER else ticks)
                for tick, ticks in delay_sample.stoppages_of(robot)
            )
            for robot in range(len(tracks))
        ),
    )
