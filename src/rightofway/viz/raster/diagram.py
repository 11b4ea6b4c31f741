"""The diagram under the map: of three views over time, the one that explains a fleet of its size.

A few robots are lines over the places of the map, as in a railway's graphic timetable; some have a
row each, thin while they drive, a gap while they wait, full while they work; many are counted.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rightofway.viz.motion import Activity, Trip
from rightofway.viz.palette import mix
from rightofway.viz.placement import edge_length, vertices_in_line
from rightofway.viz.raster.canvas import Pen, Scene

MOST_ROWS = 60
"""Of robots; a larger fleet is counted."""

ROW_HEIGHT, CENSUS_HEIGHT, AXIS_HEIGHT = 24.0, 260.0, 26.0
GUTTER, PAD = 92.0, 24.0
"""Left of the time axis, and right of it [pixels]."""

LABEL_GAP = 56.0
"""Between two labelled moments, at least [pixels]."""

MOST_CHARACTERS = 12

LINE_WIDTH, BUSY_WIDTH = 2.0, 4.5
BUSY = (Activity.WORK, Activity.TURN)

HALF_HEIGHTS = {Activity.DRIVE: 0.12, Activity.WORK: 0.36, Activity.TURN: 0.36}
"""Of a robot's row; an activity that is not here leaves a gap."""

STACK = (Activity.WORK, Activity.TURN, Activity.DRIVE, Activity.WAIT)
"""Bands of the census from the bottom up; robots that are done are the empty space above."""


class Diagram:
    """Places over time for a few robots, a row for each of some, a census of many.

    The width [pixels] includes the margins.
    """

    def __init__(self, scene: Scene, width: float) -> None:
        self.scene = scene
        self.left, self.right = GUTTER, width - PAD
        routes = [trip.vertices for trip in scene.trips]
        self.line = list(vertices_in_line(routes, edge_length(scene.roadmap)))
        rows = len(self.line) or len(scene.trips)
        self.is_census = rows > MOST_ROWS
        self.bottom = CENSUS_HEIGHT if self.is_census else rows * ROW_HEIGHT
        self.height = self.bottom + AXIS_HEIGHT

    def draw(self, pen: Pen, tick: float | None) -> None:
        """Draw it, the pen's units being pixels, with a needle at ``tick``."""
        self._draw_axis(pen)
        if self.line:
            self._draw_places(pen)
        elif self.is_census:
            self._draw_census(pen)
        else:
            self._draw_robots(pen)
        if tick is not None:
            x = self._x(tick)
            pen.line([(x, -4), (x, self.bottom)], self.scene.theme.ink, 1.5)

    def _x(self, tick: float) -> float:
        end = self.scene.end
        return self.left + min(tick, end) / end * (self.right - self.left)

    def _y(self, row: int) -> float:
        """Return the middle of a row, counted from the bottom."""
        return self.bottom - (row + 0.5) * ROW_HEIGHT

    def _draw_axis(self, pen: Pen) -> None:
        """Draw moments along the bottom, with hairlines up through the diagram."""
        clock, theme, end = self.scene.plan.scenario.problem.clock, self.scene.theme, self.scene.end
        least = LABEL_GAP / (self.right - self.left) * end
        power = 10 ** max(math.floor(math.log10(least)), 0) if least > 1 else 1
        step = next(power * digit for digit in (1, 2, 5, 10) if power * digit >= least)
        for tick in range(0, end + 1, step):
            x, time = self._x(tick), clock.time(tick)
            pen.line([(x, 0), (x, self.bottom)], theme.line, 1)
            label = str(time) if time.denominator == 1 else f"{float(time):.6g}"
            pen.text((x, self.bottom + 7), label, theme.muted, size=12, anchor="ma")
        pen.line([(self.left, self.bottom), (self.right, self.bottom)], theme.wall, 1)

    def _name_rows(self, pen: Pen, names: Sequence[str]) -> None:
        """Name the rows from the bottom."""
        for row, name in enumerate(names):
            y = self._y(row)
            short = name if len(name) <= MOST_CHARACTERS else f"{name[: MOST_CHARACTERS - 1]}…"
            pen.line([(self.left, y), (self.right, y)], self.scene.theme.line, 1)
            pen.text((self.left - 10, y), short, self.scene.theme.muted, size=12, anchor="rm")

    def _draw_places(self, pen: Pen) -> None:
        """Draw vertices as rows, bookings as fields and robots as lines."""
        scene, half = self.scene, ROW_HEIGHT * 0.4
        rows = {vertex: self._y(row) for row, vertex in enumerate(self.line)}
        self._name_rows(pen, [scene.roadmap.name(vertex) for vertex in self.line])
        headway, ahead = scene.plan.scenario.problem.headway, scene.plan.scenario.rules.books_ahead
        for trip, colour in zip(scene.trips, scene.colours, strict=True):
            tint = mix(scene.theme.paper, colour, 0.22)
            ends = [*(leave + headway for leave in trip.enter[1:]), scene.end]
            visits = zip(trip.vertices, trip.enter, trip.drive, ends, strict=True)
            for vertex, enter, drive, end in visits:
                left, right = self._x(max(enter - drive * ahead, 0)), self._x(end) - 1
                pen.box((left, rows[vertex] - half), (right, rows[vertex] + half), tint)
        for trip, colour in zip(scene.trips, scene.colours, strict=True):
            faint, until = mix(scene.theme.paper, colour, 0.5), trip.enter[-1]
            for visit, begin, until, activity in trip.all_phases():
                head = trip.vertices[visit + (activity is Activity.DRIVE)]
                stroke = (self._x(begin), rows[trip.vertices[visit]]), (self._x(until), rows[head])
                width = BUSY_WIDTH if activity in BUSY else LINE_WIDTH
                pen.line(stroke, faint if activity is Activity.WAIT else colour, width)
            y = rows[trip.vertices[-1]]
            pen.line([(self._x(until), y), (self._x(scene.end), y)], faint, LINE_WIDTH)

    def _draw_robots(self, pen: Pen) -> None:
        """Draw a row for each robot, the first one at the top."""
        names = [robot.name for robot in self.scene.plan.scenario.robots]
        self._name_rows(pen, names[::-1])
        for robot, trip in enumerate(self.scene.trips):
            y = self._y(len(names) - 1 - robot)
            for _, begin, end, activity in trip.all_phases():
                half = HALF_HEIGHTS.get(activity, 0) * ROW_HEIGHT
                if half:
                    corners = (self._x(begin), y - half), (self._x(end), y + half)
                    pen.box(*corners, self.scene.colours[robot])

    def _draw_census(self, pen: Pen) -> None:
        """Draw how many robots work, turn, drive and wait, over time."""
        theme, samples = self.scene.theme, round(self.right - self.left)
        colours = [getattr(theme, activity.value) for activity in STACK]
        counts = _counts(self.scene.trips, self.scene.end, samples)
        stacked = np.cumsum(counts, axis=0) * self.bottom / len(self.scene.trips)
        for sample, heights in enumerate(stacked.T.tolist()):
            low, x = 0.0, self.left + sample
            for high, colour in zip(heights, colours, strict=True):
                if high > low:
                    pen.box((x, self.bottom - high), (x + 1, self.bottom - low), colour)
                low = high
        for place, (activity, colour) in enumerate(zip(STACK, colours, strict=True)):
            y = self.bottom - 10 - place * 20
            pen.box((20, y - 5), (30, y + 5), colour)
            pen.text((37, y), activity.value, theme.muted, size=12, anchor="lm")


def _counts(trips: Sequence[Trip], end: int, samples: int) -> NDArray[np.int64]:
    """Return robots by activity of the stack and sample, in the middle of each sample."""
    changes = np.zeros((len(STACK), samples + 1), np.int64)
    for trip in trips:
        for _, begin, until, activity in trip.all_phases():
            for tick, change in ((begin, 1), (until, -1)):
                first = -((end - 2 * tick * samples) // (2 * end))  # its middle is not before
                changes[STACK.index(activity), min(max(first, 0), samples)] += change
    return np.cumsum(changes, axis=1)[:, :-1]
