"""Places over time, as in a railway's graphic timetable: lines are robots, fields bookings."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from rightofway.viz.motion import Activity, Trip
from rightofway.viz.palette import mix
from rightofway.viz.raster.axis import Axes, name_rows
from rightofway.viz.raster.pen import Pen
from rightofway.viz.raster.scene import Scene

__all__ = ["draw_space_time"]

WIDTHS = {Activity.WORK: 4.5, Activity.TURN: 4.5}
LINE_WIDTH = 2.0
FAINT = (Activity.WAIT, Activity.DONE)


def draw_space_time(pen: Pen, scene: Scene, axes: Axes, line: Sequence[int]) -> None:
    """Draw a diagram whose rows are the vertices of ``line``, from the bottom."""
    rows = {vertex: axes.row(row) for row, vertex in enumerate(line)}
    name_rows(pen, scene, axes, [scene.roadmap.name(vertex) for vertex in line])
    for trip, colour in zip(scene.trips, scene.colours, strict=True):
        tint, half = mix(scene.theme.paper, colour, 0.22), axes.row_height * 0.4
        for begin, end, vertex in _bookings(scene, trip):
            left, right = axes.x(max(begin, 0)), axes.x(end) - 1
            pen.box((left, rows[vertex] - half), (right, rows[vertex] + half), tint)
    for trip, colour in zip(scene.trips, scene.colours, strict=True):
        for begin, end, activity, tail, head in _strokes(trip, scene.end):
            tint = mix(scene.theme.paper, colour, 0.5) if activity in FAINT else colour
            ends = [(axes.x(begin), rows[tail]), (axes.x(end), rows[head])]
            pen.line(ends, tint, WIDTHS.get(activity, LINE_WIDTH))


def _bookings(scene: Scene, trip: Trip) -> Iterator[tuple[int, int, int]]:
    """Yield (begin, end, vertex) of what a robot books."""
    headway = scene.plan.scenario.problem.headway
    ahead = scene.plan.scenario.rules.books_ahead
    ends = [*(leave + headway for leave in trip.enter[1:]), scene.end]
    for vertex, enter, end, drive in zip(trip.vertices, trip.enter, ends, trip.drive, strict=True):
        yield enter - drive * ahead, end, vertex


def _strokes(trip: Trip, end: int) -> Iterator[tuple[int, int, Activity, int, int]]:
    """Yield (begin, end, activity, tail, head) of a robot's line."""
    until = 0
    for visit, here in enumerate(trip.vertices):
        until = trip.enter[visit]
        for begin, until, activity in trip.phases(visit):
            head = trip.vertices[visit + 1] if activity is Activity.DRIVE else here
            yield begin, until, activity, here, head
    yield until, end, Activity.DONE, trip.vertices[-1], trip.vertices[-1]
