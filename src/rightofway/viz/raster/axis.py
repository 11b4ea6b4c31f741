"""The time axis of every diagram, and the names of its rows."""

from __future__ import annotations

import math
from collections.abc import Sequence

from rightofway.viz.raster.pen import Pen
from rightofway.viz.raster.scene import Scene

__all__ = ["AXIS_HEIGHT", "Axes", "name_rows"]

GUTTER, PAD = 92.0, 24.0
"""Left of the time axis, and right of it [pixels]."""

AXIS_HEIGHT = 26.0
LABEL_GAP = 56.0
"""Between two labelled moments, at least [pixels]."""

MOST_CHARACTERS = 12


class Axes:
    """Where a tick and a row are in a diagram [pixels].

    Parameters
    ----------
    width
        Width of the diagram with its margins.
    rows
        How many rows it has.
    row_height
        Height of each.
    end
        The last tick on it.
    """

    def __init__(self, *, width: float, rows: int, row_height: float, end: int) -> None:
        self.left, self.right = GUTTER, width - PAD
        self.row_height = row_height
        self.bottom = rows * row_height
        self.end = end

    def x(self, tick: float) -> float:
        """Return where a tick is."""
        return self.left + min(tick, self.end) / self.end * (self.right - self.left)

    def row(self, row: int) -> float:
        """Return the middle of a row, counted from the bottom."""
        return self.bottom - (row + 0.5) * self.row_height

    def draw(self, pen: Pen, scene: Scene) -> None:
        """Draw moments along the bottom, with hairlines up through the diagram."""
        clock, theme = scene.plan.scenario.problem.clock, scene.theme
        for tick in range(0, self.end + 1, self._label_step()):
            x, time = self.x(tick), clock.time(tick)
            pen.line([(x, 0), (x, self.bottom)], theme.line, 1)
            label = str(time) if time.denominator == 1 else f"{float(time):.6g}"
            pen.text((x, self.bottom + 7), label, theme.muted, size=12, anchor="ma")
        pen.line([(self.left, self.bottom), (self.right, self.bottom)], theme.wall, 1)

    def _label_step(self) -> int:
        """Return a round number of ticks between two labels."""
        least = LABEL_GAP / (self.right - self.left) * self.end
        step = 10 ** max(math.floor(math.log10(least)), 0) if least > 1 else 1
        return next(step * digit for digit in (1, 2, 5, 10) if step * digit >= least)


def name_rows(pen: Pen, scene: Scene, axes: Axes, names: Sequence[str]) -> None:
    """Name the rows from the bottom, as many as have room."""
    every = max(round(15 / axes.row_height), 1)
    for row in range(0, len(names), every):
        y, name = axes.row(row), names[row]
        short = name if len(name) <= MOST_CHARACTERS else f"{name[: MOST_CHARACTERS - 1]}…"
        pen.line([(axes.left, y), (axes.right, y)], scene.theme.line, 1)
        pen.text((axes.left - 10, y), short, scene.theme.muted, size=12, anchor="rm")
