"""What does not move: floor, walls, edges, homes, stops, routes, names of vertices."""

from __future__ import annotations

from collections.abc import Sequence
from re import finditer

import numpy as np

from rightofway.viz.motion import Trip
from rightofway.viz.raster.pen import Pen
from rightofway.viz.raster.scene import Scene

__all__ = ["draw_ground"]

MOST_LANES = 5
LANES_WIDTH = 0.4
"""Of all lanes side by side [cells]."""

NAMED_CELL = 46
"""From this size on [pixels] vertices have their names."""


def draw_ground(pen: Pen, scene: Scene, *, routes: bool) -> None:
    """Draw the map, with the routes of all robots if wanted."""
    if scene.roadmap.grid is not None:
        _grid(pen, scene, scene.roadmap.grid.lines())
    else:
        _network(pen, scene)
    if routes:
        for robot in range(len(scene.trips)):
            _route(pen, scene, robot)
    for trip, colour in zip(scene.trips, scene.colours, strict=True):
        _marks(pen, scene, trip, colour)
    if pen.scale >= NAMED_CELL:
        _vertex_names(pen, scene)


def _grid(pen: Pen, scene: Scene, lines: Sequence[str]) -> None:
    right, bottom = len(lines[0]) - 0.5, len(lines) - 0.5
    hair, theme = pen.pixels(1), scene.theme
    pen.box((-0.5, -0.5), (right, bottom), theme.floor)
    if not scene.is_small(pen):
        for x in range(1, len(lines[0])):
            pen.line([(x - 0.5, -0.5), (x - 0.5, bottom)], theme.line, hair)
        for y in range(1, len(lines)):
            pen.line([(-0.5, y - 0.5), (right, y - 0.5)], theme.line, hair)
    for y, line in enumerate(lines):
        for run in finditer(r"[^.]+", line):
            pen.box((run.start() - 0.5, y - 0.5), (run.end() - 0.5, y + 0.5), theme.wall)
    border = [(-0.5, -0.5), (right, -0.5), (right, bottom), (-0.5, bottom), (-0.5, -0.5)]
    pen.line(border, theme.wall, hair)


def _network(pen: Pen, scene: Scene) -> None:
    roadmap = scene.roadmap
    tails = np.repeat(np.arange(roadmap.n_vertices), np.diff(roadmap.indptr)).tolist()
    for tail, head in zip(tails, roadmap.heads.tolist(), strict=True):
        pen.line([scene.points[tail], scene.points[head]], scene.theme.wall, 0.07)
    for point in scene.points:
        pen.disc(point, 0.13, scene.theme.wall)


def _marks(pen: Pen, scene: Scene, trip: Trip, colour: str) -> None:
    """Draw a frame for the home, and a tinted field with a diamond for each stop."""
    small, home = scene.is_small(pen), trip.vertices[0]
    for vertex in sorted({stage.vertex for stage in trip.stages} - {home}):
        pen.field(scene.points[vertex], 0.84, scene.faint(colour, 0.08 if small else 0.16))
        if not small:
            pen.diamond(scene.points[vertex], 0.17, colour)
    edge = scene.faint(colour, 0.45) if small else colour
    pen.frame(scene.points[home], 0.79, edge, max(0.03, pen.pixels(1)))


def _route(pen: Pen, scene: Scene, robot: int) -> None:
    """Draw a route a little to one side, so that routes along one way show side by side."""
    vertices, colour = scene.trips[robot].vertices, scene.colours[robot]
    lanes = min(len(scene.trips), MOST_LANES)
    aside = ((robot % lanes) - (lanes - 1) / 2) * LANES_WIDTH / lanes
    points = [(x + aside, y + aside) for x, y in map(scene.points.__getitem__, vertices)]
    if len(points) > 1:
        strength = max(0.4 - len(scene.trips) / 400, 0.12)  # many routes are a backdrop
        pen.line(points, scene.faint(colour, strength), max(0.05, pen.pixels(1)))


def _vertex_names(pen: Pen, scene: Scene) -> None:
    size = min(max(pen.scale * 0.14, 9.5), 13)
    right, down, anchor = (0.0, -0.5, "mb") if scene.roadmap.grid is None else (-0.34, -0.35, "la")
    for vertex, (x, y) in enumerate(scene.points):
        name = scene.roadmap.name(vertex)
        if pen.text_width(name, size) < 1:
            pen.text((x + right, y + down), name, scene.theme.muted, size=size, anchor=anchor)
