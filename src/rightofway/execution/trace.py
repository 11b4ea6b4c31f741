"""What became of a plan in one run, as pages show it: where robots were, and what took how long."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from rightofway.execution.run import RunResult
from rightofway.model import NEVER, ExecutionTrace, Tick, Track, stays_of
from rightofway.precedence import ActionDependencyGraph, DelaySample

__all__ = ["trace_after_replanning", "trace_of"]


def trace_of(floor: ActionDependencyGraph, delay_sample: DelaySample) -> ExecutionTrace:
    """Return a run of one plan, whatever was changed on the way, with what befell each visit."""
    happens = floor.execute(delay_sample)
    tracks = floor.split(happens.enter)
    return ExecutionTrace(
        tracks=tracks,
        dwell=_split(floor, delay_sample.dwell, tracks),
        drive=_split(floor, delay_sample.drive, tracks),
        completion=_completion(happens.completion),
        standstills=_standstills(delay_sample, len(tracks)),
    )


def trace_after_replanning(
    floor: ActionDependencyGraph, delay_sample: DelaySample, ended: RunResult
) -> ExecutionTrace:
    """Return a run that came to a stand on the way, and went on by another plan.

    What befell its visits is not kept, so they are taken to have lasted as planned; what they
    lasted beyond that reads as waiting.
    """
    tracks = ended.tracks
    stays = stays_of(floor.scenario, tracks)
    return ExecutionTrace(
        tracks=tracks,
        dwell=tuple(stay.dwell for stay in stays),
        drive=tuple(np.append(0, stay.drive[:-1]) for stay in stays),
        completion=_completion(ended.completion),
        standstills=_standstills(delay_sample, len(tracks)),
    )


def _split(
    floor: ActionDependencyGraph, values: NDArray[np.int64], tracks: Sequence[Track]
) -> tuple[NDArray[np.int64], ...]:
    """Return the values of the visits that took place, robot by robot."""
    firsts = pairwise(floor.first_visit.tolist())
    return tuple(
        values[first : first + len(track)] for (first, _), track in zip(firsts, tracks, strict=True)
    )


def _completion(ticks: NDArray[np.int64]) -> tuple[Tick | None, ...]:
    return tuple(None if tick >= NEVER else Tick(tick) for tick in ticks.tolist())


def _standstills(
    delay_sample: DelaySample, robots: int
) -> tuple[tuple[tuple[Tick, Tick | None], ...], ...]:
    return tuple(
        tuple((tick, None if ticks >= NEVER else ticks) for tick, ticks in delay_sample.of(robot))
        for robot in range(robots)
    )
