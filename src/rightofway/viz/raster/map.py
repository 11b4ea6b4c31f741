"""The map with its homes, stops and routes, and the robots on it at an instant."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise
from re import finditer
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from rightofway.site import Grid
from rightofway.viz.motion import Moment, Phase
from rightofway.viz.page.background import explain_unreadable, find_background, place_of
from rightofway.viz.palette import choose_ink
from rightofway.viz.raster.canvas import Ground, Pen, Point, Scene
from rightofway.viz.raster.sizes import MOST_ROUTES, LaneSizes, Sizes

ARROW_GAP = 56
"""Between two arrow heads of a lane, about [pixels]."""

TURNS_BACK = -0.5
"""Cosine of a turn below which a line beside a route has two corners."""

WHOLE = (0, 1)
"""A circle [turns]."""

FAULT_RING = 1.7
"""Radius of the ring round a robot that has part in a fault, in radii of a robot without a size."""

DIAL = {"point": 1.38, "size": 0.62}
"""Radius of the circle that work fills [radii of the robot]: inside of a true size."""


def draw_ground(pen: Pen, scene: Scene, sizes: Sizes, *, routes: bool) -> None:
    """Draw everything that does not move, with the routes of all robots if wanted."""
    draw_roadmap(pen, scene, sizes)
    for robot in range(len(scene.trips)) if routes else ():
        _route(pen, scene, sizes, robot)
    for robot in range(len(scene.trips)):
        _draw_home(pen, scene, sizes, robot)
    _draw_stops(pen, scene, sizes)


def draw_roadmap(pen: Pen, scene: Ground, sizes: LaneSizes) -> None:
    """Draw cells or lanes, and the picture of the site."""
    if scene.roadmap.grid is not None:
        _draw_grid(pen, scene, scene.roadmap.grid)
        _draw_picture(pen, scene)
    elif scene.roadmap.sides is not None:
        _draw_squares(pen, scene, scene.roadmap.drawn_sides / scene.plane.unit / 2)
        _draw_picture(pen, scene)
    else:
        _draw_picture(pen, scene)
        _draw_network(pen, scene, sizes)


def _draw_picture(pen: Pen, scene: Ground) -> None:
    """Draw the picture of the site; over cells, as these have no gaps."""
    background = find_background(scene.roadmap)
    if background is None:
        return
    try:
        with Image.open(background.picture) as picture:
            place = place_of(scene.roadmap, background, *picture.size)
            opacity = background.opacity * (
                0.4 if choose_ink(scene.theme.paper) == "#ffffff" else 1
            )
            pen.draw_picture(picture, place, opacity)
    except (OSError, ValueError, SyntaxError, Image.DecompressionBombError):
        raise explain_unreadable(background.picture) from None


def _draw_grid(pen: Pen, scene: Ground, grid: Grid) -> None:
    lines, theme, hair = grid.as_lines(), scene.theme, pen.hairline
    right, bottom = len(lines[0]) - 0.5, len(lines) - 0.5
    pen.fill_box((-0.5, -0.5), (right, bottom), theme.floor)
    if not pen.is_small:
        for x in range(1, len(lines[0])):
            pen.draw_line([(x - 0.5, -0.5), (x - 0.5, bottom)], theme.line, hair)
        for y in range(1, len(lines)):
            pen.draw_line([(-0.5, y - 0.5), (right, y - 0.5)], theme.line, hair)
    for y, line in enumerate(lines):
        for run in finditer(r"[^.]+", line):
            pen.fill_box((run.start() - 0.5, y - 0.5), (run.end() - 0.5, y + 0.5), theme.wall)
    border = [(-0.5, -0.5), (right, -0.5), (right, bottom), (-0.5, bottom), (-0.5, -0.5)]
    pen.draw_line(border, theme.wall, hair)


def _draw_squares(pen: Pen, scene: Ground, halves: NDArray[np.float64]) -> None:
    """Draw the cells of a quadtree; half their sides are given."""
    corner = (scene.plane.width - 0.5, scene.plane.height - 0.5)
    pen.fill_box((-0.5, -0.5), corner, scene.theme.wall)
    for (x, y), half in zip(scene.points, halves.tolist(), strict=True):
        pen.fill_box((x - half, y - half), (x + half, y + half), scene.theme.line)
        inner = half if pen.is_small else half - pen.hairline / 2
        pen.fill_box((x - inner, y - inner), (x + inner, y + inner), scene.theme.floor)


def _draw_network(pen: Pen, scene: Ground, sizes: LaneSizes) -> None:
    """Draw lanes: broad where both ways are driven, narrower with arrow heads for one way."""
    theme, edges = scene.theme, set(scene.edges)
    _draw_zones(pen, scene, sizes)
    for tail, head in scene.edges:
        is_one_way = (head, tail) not in edges
        width = sizes.lane * (0.7 if is_one_way else 1) * pen.hairline
        pen.draw_line([scene.points[tail], scene.points[head]], theme.wall, width)
        for end in (tail, head):
            pen.fill_disc(scene.points[end], width / 2, theme.wall)
    for tail, head in scene.edges:
        if (head, tail) not in edges:
            _draw_arrows(pen, scene, sizes, scene.points[tail], scene.points[head])
    for point in scene.points:
        pen.fill_disc(point, sizes.vertex * pen.hairline, theme.muted)
        pen.fill_disc(point, (sizes.vertex - 1.25) * pen.hairline, theme.paper)


def _draw_zones(pen: Pen, scene: Ground, sizes: LaneSizes) -> None:
    """Draw the members of each zone as a band."""
    colour, width = scene.fade(scene.theme.zone, 0.35), sizes.zone * pen.hairline
    for zone in scene.roadmap.zones:
        for tail, head in zone.edges:
            pen.draw_line([scene.points[tail], scene.points[head]], colour, width)
        for vertex in {*zone.vertices, *(end for edge in zone.edges for end in edge)}:
            pen.fill_disc(scene.points[vertex], width / 2, colour)


def _draw_arrows(pen: Pen, scene: Ground, sizes: LaneSizes, tail: Point, head: Point) -> None:
    (x, y), right, down = tail, head[0] - tail[0], head[1] - tail[1]
    size = min(max(sizes.lane * 0.32, 3), 5)
    length = math.hypot(right, down) * pen.scale
    if length < 2 * sizes.vertex + 3 * size:
        return
    along_x, along_y = right / length * size, down / length * size  # one arrow head [units]
    count = max(int(length / ARROW_GAP), 1)
    for step in range(count):
        share = (step + 0.5) / count
        tip_x, tip_y = x + right * share + along_x / 2, y + down * share + along_y / 2
        back_x, back_y = tip_x - along_x, tip_y - along_y
        wings = [(back_x - along_y, back_y + along_x), (back_x + along_y, back_y - along_x)]
        chevron = [wings[0], (tip_x, tip_y), wings[1]]
        pen.draw_line(chevron, scene.theme.muted, 1.5 * pen.hairline)


def _route(pen: Pen, scene: Scene, sizes: Sizes, robot: int) -> None:
    """Draw a route a little to its right, so that routes along one way show side by side."""
    aside = (robot % MOST_ROUTES + 0.5) * sizes.apart * pen.hairline
    points = to_the_right([scene.points[vertex] for vertex in scene.trips[robot].vertices], aside)
    if len(points) > 1:
        strength = max(0.55 - len(scene.trips) / 300, 0.12)  # many routes are a backdrop
        pen.draw_line(
            points, scene.fade(scene.colours[robot], strength), sizes.route * pen.hairline
        )


def to_the_right(points: Sequence[Point], aside: float) -> list[Point]:
    """Return a line that runs to the right of another one; it has two points where that turns."""
    ways = [(tail, head) for tail, head in pairwise(points) if tail != head]
    sides = []
    for (x, y), (to_x, to_y) in ways:
        length = math.hypot(to_x - x, to_y - y)
        sides.append((-(to_y - y) / length * aside, (to_x - x) / length * aside))
    around: list[Point] = []
    befores, afters = [*sides[:1], *sides], [*sides, *sides[-1:]]
    corners = [side[0] for side in ways] + [side[1] for side in ways[-1:]]
    for (x, y), before, after in zip(corners, befores, afters, strict=True):
        along = (before[0] * after[0] + before[1] * after[1]) / aside**2
        if along < TURNS_BACK:
            around += [(x + before[0], y + before[1]), (x + after[0], y + after[1])]
        else:
            share = 1 / (1 + along)
            around.append((x + (before[0] + after[0]) * share, y + (before[1] + after[1]) * share))
    return around


def _draw_home(pen: Pen, scene: Scene, sizes: Sizes, robot: int) -> None:
    """Draw a tinted frame."""
    colour, home = scene.colours[robot], scene.points[scene.trips[robot].vertices[0]]
    half = sizes.homes[robot]
    width, side = min(max(half * 0.1, 1.5), 3) * pen.hairline, 2 * half * pen.hairline
    has_size = scene.plan.scenario.robots[robot].radius > 0  # its true size may cover lanes
    pen.draw_square(home, side, None if has_size else scene.fade(colour, 0.12), colour, width)


def _draw_stops(pen: Pen, scene: Scene, sizes: Sizes) -> None:
    """Draw a diamond for each stop; those of several robots stand side by side."""
    robots_at: dict[int, list[int]] = {}
    for robot, trip in enumerate(scene.trips):
        for vertex in sorted({stage.vertex for stage in trip.stages} - {trip.vertices[0]}):
            robots_at.setdefault(vertex, []).append(robot)
    for place, robots in robots_at.items():
        x, y = scene.points[place]
        size = sizes.stop * pen.hairline / math.sqrt(min(len(robots), 3))
        for rank, robot in enumerate(robots):
            middle = x + (rank - (len(robots) - 1) / 2) * 2.1 * size
            for reach, colour in (
                (size + 1.75 * pen.hairline, scene.ground),
                (size, scene.colours[robot]),
            ):
                corners = [(0, -reach), (reach, 0), (0, reach), (-reach, 0)]
                pen.fill_polygon([(middle + right, y + down) for right, down in corners], colour)


def draw_robots(pen: Pen, scene: Scene, sizes: Sizes, tick: float) -> None:
    """Draw every robot where it is at an instant [ticks].

    A disc drives, a ring waits, a filling arc works, two arcs turn, a faint disc is done. A wide
    ring in red is round each robot that has part in a fault.
    """
    moments = [trip.locate(tick) for trip in scene.trips]
    middles = [_locate_middle(scene, moment) for moment in moments]
    for robot, (moment, middle) in enumerate(zip(moments, middles, strict=True)):
        has_size = scene.plan.scenario.robots[robot].radius > 0
        radius = sizes.robots[robot] * pen.hairline
        _draw_robot(pen, scene, moment, Disc(middle, radius, scene.colours[robot], has_size))
    for robot in scene.faulty:
        has_size = scene.plan.scenario.robots[robot].radius > 0
        wide = sizes.robots[robot] + 4 if has_size else sizes.robots[robot] * FAULT_RING
        radius = wide * pen.hairline
        pen.draw_ring(middles[robot], radius, WHOLE, scene.theme.held, radius * 0.15)


def _locate_middle(scene: Scene, moment: Moment) -> Point:
    (x, y), (to_x, to_y) = scene.points[moment.tail], scene.points[moment.head]
    return x + (to_x - x) * moment.share, y + (to_y - y) * moment.share


class Disc(NamedTuple):
    """Where a robot is drawn, how large [units], in which colour, and whether that is its size."""

    middle: Point
    radius: float
    colour: str
    has_size: bool


def _draw_robot(pen: Pen, scene: Scene, moment: Moment, disc: Disc) -> None:
    (middle, radius, colour, has_size), activity = disc, moment.activity
    dial, dial_width = (
        radius * DIAL["size" if has_size else "point"],
        max(radius * 0.17, pen.hairline),
    )
    ink = scene.ground if has_size else colour
    pen.fill_disc(middle, radius + 1.25 * pen.hairline, scene.ground)
    if activity is Phase.WAIT:
        pen.draw_ring(middle, radius, WHOLE, colour, max(radius * 0.26, pen.hairline))
    else:
        pen.fill_disc(middle, radius, scene.fade(colour, 0.45 if activity is Phase.DONE else 1))
    if activity is Phase.WORK:
        pen.draw_ring(
            middle, dial, WHOLE, scene.fade(colour, 0.75 if has_size else 0.25), dial_width
        )
        pen.draw_ring(middle, dial, (0, moment.share), ink, dial_width)
    elif activity is Phase.TURN:
        for side in (0, 0.5):
            begin = side + moment.share / 2
            pen.draw_ring(middle, dial, (begin, begin + 0.14), ink, dial_width)
