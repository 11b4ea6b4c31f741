"""The map with its homes, stops and routes, and the robots on it at an instant."""

from __future__ import annotations

from re import finditer

import numpy as np

from rightofway.model import Grid
from rightofway.viz.motion import Activity, Moment
from rightofway.viz.palette import ink_on
from rightofway.viz.raster.canvas import Pen, Scene

MOST_LANES = 5
LANES_WIDTH = 0.4
"""Of all lanes side by side [cells]."""

NAMED_CELL = 46
"""From this size of a cell on [pixels] vertices have their names."""

RADIUS, SMALL_RADIUS = 0.33, 0.46
"""Of a robot, and of one where cells are small [cells]."""

LEAST_TYPE = 7
"""Smaller letters [pixels] cannot be read."""

WHOLE = (0, 1)
"""A circle [turns]."""


def draw_ground(pen: Pen, scene: Scene, *, routes: bool) -> None:
    """Draw what does not move, with the routes of all robots if wanted."""
    if scene.roadmap.grid is not None:
        _grid(pen, scene, scene.roadmap.grid)
    else:
        _network(pen, scene)
    for robot in range(len(scene.trips)) if routes else ():
        _route(pen, scene, robot)
    for robot in range(len(scene.trips)):
        _home_and_stops(pen, scene, robot)
    if pen.scale >= NAMED_CELL:
        _vertex_names(pen, scene)


def _grid(pen: Pen, scene: Scene, grid: Grid) -> None:
    lines, theme, hair = grid.lines(), scene.theme, pen.hairline
    right, bottom = len(lines[0]) - 0.5, len(lines) - 0.5
    pen.box((-0.5, -0.5), (right, bottom), theme.floor)
    if not pen.is_small:
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


def _route(pen: Pen, scene: Scene, robot: int) -> None:
    """Draw a route a little to one side, so that routes along one way show side by side."""
    vertices, colour = scene.trips[robot].vertices, scene.colours[robot]
    lanes = min(len(scene.trips), MOST_LANES)
    aside = ((robot % lanes) - (lanes - 1) / 2) * LANES_WIDTH / lanes
    points = [(x + aside, y + aside) for x, y in map(scene.points.__getitem__, vertices)]
    if len(points) > 1:
        strength = max(0.4 - len(scene.trips) / 400, 0.12)  # many routes are a backdrop
        pen.line(points, scene.faint(colour, strength), max(0.05, pen.hairline))


def _home_and_stops(pen: Pen, scene: Scene, robot: int) -> None:
    """Draw a frame for the home, and a tinted field with a diamond for each stop."""
    trip, colour = scene.trips[robot], scene.colours[robot]
    home = trip.vertices[0]
    for vertex in sorted({stage.vertex for stage in trip.stages} - {home}):
        x, y = scene.points[vertex]
        pen.square((x, y), 0.84, scene.faint(colour, 0.08 if pen.is_small else 0.16))
        if not pen.is_small:
            pen.polygon([(x, y - 0.17), (x + 0.17, y), (x, y + 0.17), (x - 0.17, y)], colour)
    edge = scene.faint(colour, 0.45) if pen.is_small else colour
    pen.square(scene.points[home], 0.79, None, edge, max(0.03, pen.hairline))


def _vertex_names(pen: Pen, scene: Scene) -> None:
    size = min(max(pen.scale * 0.14, 9.5), 13)
    right, down, anchor = (0.0, -0.5, "mb") if scene.roadmap.grid is None else (-0.34, -0.35, "la")
    for vertex, (x, y) in enumerate(scene.points):
        name = scene.roadmap.name(vertex)
        if pen.text_width(name, size) < 1:
            pen.text((x + right, y + down), name, scene.theme.muted, size=size, anchor=anchor)


def draw_robots(pen: Pen, scene: Scene, tick: float) -> None:
    """Draw every robot where it is at an instant [ticks].

    A disc drives, a ring waits, a filling arc works, two arcs turn, a faint disc is done.
    """
    for robot, trip in enumerate(scene.trips):
        _robot(pen, scene, robot, trip.at(tick))


def _robot(pen: Pen, scene: Scene, robot: int, moment: Moment) -> None:
    (tail_x, tail_y), (head_x, head_y) = scene.points[moment.tail], scene.points[moment.head]
    middle = tail_x + (head_x - tail_x) * moment.share, tail_y + (head_y - tail_y) * moment.share
    colour, activity = scene.colours[robot], moment.activity
    radius = SMALL_RADIUS if pen.is_small else RADIUS
    dial, dial_width = radius * 1.38, max(radius * 0.17, pen.hairline)
    if activity is Activity.WAIT:
        pen.disc(middle, radius, scene.ground)
        pen.ring(middle, radius, WHOLE, colour, max(radius * 0.26, pen.hairline))
    else:
        pen.disc(middle, radius, scene.faint(colour, 0.38 if activity is Activity.DONE else 1))
    if activity is Activity.WORK:
        pen.ring(middle, dial, WHOLE, scene.faint(colour, 0.25), dial_width)
        pen.ring(middle, dial, (0, moment.share), colour, dial_width)
    elif activity is Activity.TURN:
        for side in (0, 0.5):
            begin = side + moment.share / 2
            pen.ring(middle, dial, (begin, begin + 0.14), colour, dial_width)
    is_hollow = activity in (Activity.WAIT, Activity.DONE)
    name, pixels = scene.plan.scenario.robots[robot].name, radius * pen.scale
    size = min(pixels * 0.8, pixels * 2.6 / max(len(name), 2))
    if size >= LEAST_TYPE:
        ink = scene.theme.ink if is_hollow else ink_on(colour)
        pen.text(middle, name, ink, size=size, anchor="mm")
