"""How large robots, marks and lanes are in a picture; the twin of the page's ``map_sizes.js``."""

from __future__ import annotations

import math
from dataclasses import dataclass

from rightofway.viz.raster.canvas import Scene

READABLE_RADIUS = 10.0
"""A robot need not be larger to be seen from afar [pixels]."""

SMALLEST_CAP = {"many": 4.5, "few": 7.0}
"""Robots may be as large where cells are smaller [pixels]."""

SMALLEST_RADIUS = 2.0
"""Of a robot that is drawn at its true size [pixels]."""

IN_CELL = 0.35
"""Of a cell's side: robots that follow each other round a corner do not touch."""

LARGEST_RADIUS = {"grid": 44.0, "network": 20.0}
"""Of a robot that has no size [pixels]."""

MOST_ROUTES = 5
"""Side by side on one way."""


@dataclass(frozen=True, slots=True, kw_only=True)
class LaneSizes:
    """Sizes of a roadmap in a picture [pixels].

    Attributes
    ----------
    lane
        Width of a lane that is driven both ways.
    vertex
        Radius of a vertex.
    zone
        Width of the band of a zone.
    """

    lane: float
    vertex: float
    zone: float

    @classmethod
    def at(cls, scale: float, *, is_grid: bool) -> LaneSizes:
        """Return the sizes at a scale [pixels for a unit]."""
        lane = min(max(scale * 0.42, 7), max(scale * 0.8, 1.5), 18)
        return cls(
            lane=lane, vertex=min(lane * 0.45, 5.5), zone=scale if is_grid else lane * 1.5 + 8
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class Sizes(LaneSizes):
    """Sizes of robots and all else in a picture [pixels].

    Attributes
    ----------
    robots
        Radius of each robot: its own, if it has one.
    homes
        Half the side of the frame of each robot's home.
    stop
        Half the width of a stop's diamond.
    route, apart
        Width of a route, and how far two routes on one way are apart.
    """

    robots: tuple[float, ...]
    homes: tuple[float, ...]
    stop: float
    route: float
    apart: float


def compute_sizes(scene: Scene, scale: float) -> Sizes:
    """Return the sizes at a scale [pixels for a unit]; they grow with the cells of a fine scale.

    Where cells are small, robots stay large enough to be seen, as far as there is room.
    """
    plane, is_grid = scene.plane, scene.roadmap.grid is not None
    spacing = math.sqrt(plane.width * plane.height / len(scene.trips)) * scale
    cap = max(SMALLEST_CAP["many"], min(SMALLEST_CAP["few"], spacing * 0.1), scale * 0.95)
    least = min(spacing * 0.16, READABLE_RADIUS, cap)
    largest = LARGEST_RADIUS["network"]
    if is_grid:
        largest = min(LARGEST_RADIUS["grid"], max(scale * IN_CELL, SMALLEST_CAP["many"]))
    point = min(max(scale * 0.31, least, 1.8), largest)
    radii = [float(robot.radius) / plane.unit * scale for robot in scene.plan.scenario.robots]
    robots = tuple(max(radius, SMALLEST_RADIUS) if radius else point for radius in radii)
    in_cell = scale * 0.345 if is_grid else 0
    homes = tuple(
        in_cell if radius and is_grid else max(in_cell, robot + 1.5)
        for radius, robot in zip(radii, robots, strict=True)
    )
    lanes = LaneSizes.at(scale, is_grid=is_grid)
    route = min(max(scale * 0.04, 1.5), 4)
    beside = (scale * 0.45 if is_grid else lanes.lane * 0.6) / min(len(scene.trips), MOST_ROUTES)
    return Sizes(
        robots=robots,
        homes=homes,
        stop=max(min(max(robots) * 0.75, 17), 3),
        lane=lanes.lane,
        vertex=lanes.vertex,
        zone=lanes.zone,
        route=route,
        apart=min(route + 1, beside),
    )
