"""What pictures of one plan have in common: its trips, where vertices are, and the colours."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from rightofway.model import Plan, Roadmap
from rightofway.viz.motion import Trip, end_of, trips_of
from rightofway.viz.palette import Theme, mix, robot_colours
from rightofway.viz.plane import Plane, plane_of
from rightofway.viz.raster.pen import Pen, Point

__all__ = ["Scene"]

SMALL_CELL = 13
"""Where a cell is smaller [pixels], robots fill more of it, and their homes and stops are faint."""


@dataclass(frozen=True, kw_only=True)
class Scene:
    """A plan to be drawn.

    Attributes
    ----------
    plan
        The plan.
    theme
        The colours of everything but the robots.
    """

    plan: Plan
    theme: Theme

    @property
    def roadmap(self) -> Roadmap:
        """The graph that robots drive on."""
        return self.plan.scenario.roadmap

    @cached_property
    def trips(self) -> tuple[Trip, ...]:
        """What each robot does."""
        return trips_of(self.plan)

    @cached_property
    def end(self) -> int:
        """The tick from which on nothing happens any more; at least 1."""
        return max(end_of(self.trips), 1)

    @cached_property
    def colours(self) -> tuple[str, ...]:
        """The colour of each robot."""
        return robot_colours(len(self.trips))

    @cached_property
    def plane(self) -> Plane:
        """Where vertices are."""
        return plane_of(self.roadmap)

    @cached_property
    def points(self) -> list[Point]:
        """The same as pairs."""
        return [(x, y) for x, y in self.plane.points.tolist()]

    @property
    def ground(self) -> str:
        """The colour under the robots."""
        return self.theme.paper if self.roadmap.grid is None else self.theme.floor

    def faint(self, colour: str, share: float) -> str:
        """Return a colour as seen when it covers only a share of the ground."""
        return mix(self.ground, colour, share)

    def is_small(self, pen: Pen) -> bool:
        """Return whether cells are drawn small."""
        return pen.scale < SMALL_CELL
