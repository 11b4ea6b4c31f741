"""What a large fleet does: how many robots work, turn, drive and wait, over time."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rightofway.viz.motion import Activity
from rightofway.viz.raster.axis import Axes
from rightofway.viz.raster.pen import Pen
from rightofway.viz.raster.scene import Scene

__all__ = ["draw_census"]

STACK = (Activity.WORK, Activity.TURN, Activity.DRIVE, Activity.WAIT)
"""From the bottom up; who is done, is the empty space above."""

LEGEND_STEP = 20


def draw_census(pen: Pen, scene: Scene, axes: Axes) -> None:
    """Draw a diagram of stacked bands, one for each activity."""
    samples = round(axes.right - axes.left)
    colours = [getattr(scene.theme, activity.value) for activity in STACK]
    stacked = np.cumsum(_counts(scene, samples), axis=0) * axes.bottom / len(scene.trips)
    for sample, heights in enumerate(stacked.T.tolist()):
        low, x = 0.0, axes.left + sample
        for high, colour in zip(heights, colours, strict=True):
            if high > low:
                pen.box((x, axes.bottom - high), (x + 1, axes.bottom - low), colour)
            low = high
    for place, (activity, colour) in enumerate(zip(STACK, colours, strict=True)):
        y = axes.bottom - 10 - place * LEGEND_STEP
        pen.box((20, y - 5), (30, y + 5), colour)
        pen.text((37, y), activity.value, scene.theme.muted, size=12, anchor="lm")


def _counts(scene: Scene, samples: int) -> NDArray[np.int64]:
    """Return robots by activity of the stack and sample, in the middle of each sample."""
    changes = np.zeros((len(STACK), samples + 1), np.int64)
    for trip in scene.trips:
        for visit in range(len(trip.vertices)):
            for begin, end, activity in trip.phases(visit):
                row = changes[STACK.index(activity)]
                row[_sample(begin, scene.end, samples)] += 1
                row[_sample(end, scene.end, samples)] -= 1
    return np.cumsum(changes, axis=1)[:, :-1]


def _sample(tick: int, end: int, samples: int) -> int:
    """Return the first sample whose middle is not before a tick."""
    return min(max(-((end - 2 * tick * samples) // (2 * end)), 0), samples)
