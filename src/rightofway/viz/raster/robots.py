"""The robots at an instant: a disc drives, a ring waits, a filling arc works, two arcs turn."""

from __future__ import annotations

from collections.abc import Iterator

from rightofway.viz.motion import Activity, Moment
from rightofway.viz.palette import ink_on
from rightofway.viz.raster.pen import Pen, Point
from rightofway.viz.raster.scene import Scene

__all__ = ["draw_robots"]

RADIUS = 0.33
SMALL_RADIUS = 0.46
"""Where cells are small."""

LEAST_TYPE = 7
"""Smaller letters [pixels] cannot be read."""


def draw_robots(pen: Pen, scene: Scene, tick: float) -> None:
    """Draw every robot where it is at an instant [ticks]."""
    for robot, trip in enumerate(scene.trips):
        _robot(pen, scene, robot, trip.at(tick))


def _robot(pen: Pen, scene: Scene, robot: int, moment: Moment) -> None:
    middle, colour = _position(scene, moment), scene.colours[robot]
    radius = SMALL_RADIUS if scene.is_small(pen) else RADIUS
    if moment.activity is Activity.WAIT:
        pen.disc(middle, radius, scene.ground)
        pen.ring(middle, radius, colour, max(radius * 0.26, pen.pixels(1)))
    else:
        done = moment.activity is Activity.DONE
        pen.disc(middle, radius, scene.faint(colour, 0.38) if done else colour)
    for begin, end, share in _dial(moment):
        width = max(radius * 0.17, pen.pixels(1))
        pen.arc(middle, radius * 1.38, (begin, end), scene.faint(colour, share), width)
    hollow = moment.activity in (Activity.WAIT, Activity.DONE)
    ink = scene.theme.ink if hollow else ink_on(colour)
    _name(pen, scene.plan.scenario.robots[robot].name, middle, radius, ink)


def _position(scene: Scene, moment: Moment) -> Point:
    (tail_x, tail_y), (head_x, head_y) = scene.points[moment.tail], scene.points[moment.head]
    share = moment.share if moment.activity is Activity.DRIVE else 0
    return tail_x + (head_x - tail_x) * share, tail_y + (head_y - tail_y) * share


def _dial(moment: Moment) -> Iterator[tuple[float, float, float]]:
    """Yield arcs (begin, end, strength): work fills a circle, turning sweeps half of one."""
    if moment.activity is Activity.WORK:
        yield 0, 1, 0.25
        yield 0, moment.share, 1
    elif moment.activity is Activity.TURN:
        for side in (0, 0.5):
            begin = side + moment.share / 2
            yield begin, begin + 0.14, 1


def _name(pen: Pen, name: str, middle: Point, radius: float, ink: str) -> None:
    """Write a robot's name into its disc, if it can be read there."""
    pixels = radius * pen.scale
    size = min(pixels * 0.8, pixels * 2.6 / max(len(name), 2))
    if size >= LEAST_TYPE:
        pen.text(middle, name, ink, size=size, anchor="mm")
