"""The diagram under the map: of three views, the one that explains a fleet of that size."""

from __future__ import annotations

from rightofway.viz.ordering import vertices_in_line
from rightofway.viz.raster.axis import AXIS_HEIGHT, Axes
from rightofway.viz.raster.census import draw_census
from rightofway.viz.raster.pen import Pen
from rightofway.viz.raster.robot_rows import draw_robot_rows
from rightofway.viz.raster.scene import Scene
from rightofway.viz.raster.space_time import draw_space_time

__all__ = ["Diagram"]

MOST_ROWS = 60
"""Of robots; a larger fleet is counted."""

ROW_HEIGHT = 24.0
CENSUS_HEIGHT = 260.0


class Diagram:
    """Places over time for a few robots, a row for each of some, a census of many.

    Parameters
    ----------
    scene
        What to draw.
    """

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        self.line = vertices_in_line([trip.vertices for trip in scene.trips])
        self.rows = len(self.line) or len(scene.trips)
        self.counts_only = self.rows > MOST_ROWS

    @property
    def height(self) -> float:
        """How high it is [pixels]."""
        return AXIS_HEIGHT + (CENSUS_HEIGHT if self.counts_only else self.rows * ROW_HEIGHT)

    def draw(self, pen: Pen, width: float, tick: float | None) -> None:
        """Draw it, the pen's units being pixels, with a needle at ``tick``."""
        scene = self.scene
        rows, height = (1, CENSUS_HEIGHT) if self.counts_only else (self.rows, ROW_HEIGHT)
        axes = Axes(width=width, rows=rows, row_height=height, end=scene.end)
        axes.draw(pen, scene)
        if self.line:
            draw_space_time(pen, scene, axes, self.line)
        else:
            (draw_census if self.counts_only else draw_robot_rows)(pen, scene, axes)
        if tick is not None:
            needle = [(axes.x(tick), -4), (axes.x(tick), axes.bottom)]
            pen.line(needle, scene.theme.ink, 1.5)
