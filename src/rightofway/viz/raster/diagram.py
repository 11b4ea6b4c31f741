"""The diagram under the map: of three views over time, the one that explains a fleet of its size.

A few robots are lines over the places of the map, as in a railway's graphic timetable; some have a
row each, thin while they drive, a gap while they wait, full while they work; many are counted.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from rightofway.quantities import Quantities
from rightofway.viz.motion import Phase, Trip
from rightofway.viz.palette import mix
from rightofway.viz.placement import make_edge_length, order_in_line
from rightofway.viz.raster.canvas import Pen, Scene

MOST_ROWS = 60
"""Of robots; a larger fleet is counted."""

ROW_HEIGHT, CENSUS_HEIGHT, AXIS_HEIGHT = 24.0, 260.0, 26.0
GUTTER, PAD = 92.0, 24.0
"""Left of the time axis, and right of it [pixels]."""

LEAST_ROW = 16.0
"""Between the names of two rows, at least [pixels]."""

LABEL_GAP = 72.0
"""Between two labelled moments, at least [pixels]."""

MOST_MARKED = 14
"""Ticks between two labels, from which on nobody sees that a label stands between two ticks."""

MINUTES = (1, 2, 5, 10, 20, 30, 60, 120, 300, 600, 1440)
ROUND_SECONDS = (*map(Fraction, (10, 20, 30)), *(Fraction(60 * minutes) for minutes in MINUTES))
"""Times between labels, where the scenario says what its times are [s]."""

MOST_STRETCHED = 1.6
"""Largest stretch of a drive in the diagram that is drawn solid; steeper slopes mislead."""

MOST_CHARACTERS = 14

LINE_WIDTH, BUSY_WIDTH = 2.0, 4.5
BUSY = (Phase.WORK, Phase.TURN)

HALF_HEIGHTS = {Phase.DRIVE: 0.12, Phase.WORK: 0.36, Phase.TURN: 0.36}
"""Of a robot's row; an activity that is not here leaves a gap."""

STACK = (Phase.WORK, Phase.TURN, Phase.DRIVE, Phase.WAIT)
"""Bands of the census from the bottom up; robots that are done are the empty space above."""


class Diagram:
    """Places over time for a few robots, a row for each of some, a census of many.

    The width [pixels] includes the margins.
    """

    def __init__(self, scene: Scene, width: float) -> None:
        self.scene = scene
        self.left, self.right = GUTTER, width - PAD
        routes = [trip.vertices for trip in scene.trips]
        self.distance = make_edge_length(scene.roadmap)
        self.line = order_in_line(routes, self.distance)
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
            pen.draw_line([(x, -4), (x, self.bottom)], self.scene.theme.ink, 1.5)

    def _x(self, tick: float) -> float:
        end = self.scene.end
        return self.left + min(tick, end) / end * (self.right - self.left)

    def _y(self, row: int) -> float:
        """Return the middle of a row, counted from the bottom."""
        return self.bottom - (row + 0.5) * ROW_HEIGHT

    def _draw_axis(self, pen: Pen) -> None:
        """Draw moments along the bottom, with hairlines up through the diagram."""
        theme, end = self.scene.theme, self.scene.end
        quantities = self.scene.plan.scenario.quantities
        write = quantities.format_duration if quantities.units.time else quantities.format_cell
        step = find_label_step(quantities, LABEL_GAP / (self.right - self.left) * end)
        for tick in (number * step for number in range(int(end / step) + 1)):
            x = self._x(float(tick))
            pen.draw_line([(x, 0), (x, self.bottom)], theme.line, 1)
            pen.write_text((x, self.bottom + 7), write(tick), theme.muted, size=12, anchor="ma")
        pen.draw_line([(self.left, self.bottom), (self.right, self.bottom)], theme.wall, 1)

    def _name_rows(self, pen: Pen, rows: Iterable[tuple[str, float]]) -> None:
        """Name rows, each with its height in the picture."""
        for name, y in rows:
            short = name if len(name) <= MOST_CHARACTERS else f"{name[: MOST_CHARACTERS - 1]}…"
            pen.draw_line([(self.left, y), (self.right, y)], self.scene.theme.line, 1)
            pen.write_text((self.left - 10, y), short, self.scene.theme.muted, size=12, anchor="rm")

    def _draw_places(self, pen: Pen) -> None:
        """Draw vertices as rows, bookings as fields and robots as lines."""
        scene, half = self.scene, LEAST_ROW * 0.4
        heights = _row_heights(list(self.line.values()), self.bottom - ROW_HEIGHT)
        rows = {
            vertex: self.bottom - ROW_HEIGHT / 2 - height
            for vertex, height in zip(self.line, heights, strict=True)
        }
        self._name_rows(pen, ((scene.where(vertex), y) for vertex, y in rows.items()))
        rules = scene.plan.scenario.problem.booking_rules
        for trip, colour in zip(scene.trips, scene.colours, strict=True):
            tint = mix(scene.theme.paper, colour, 0.22)
            ends = [*(rules.end(leave) for leave in trip.enter[1:]), scene.end]
            visits = zip(trip.vertices, trip.enter, trip.drive, ends, strict=True)
            for vertex, enter, drive, end in visits:
                left, right = self._x(max(rules.start(enter, drive), 0)), self._x(end) - 1
                pen.fill_box((left, rows[vertex] - half), (right, rows[vertex] + half), tint)
        for trip, colour in zip(scene.trips, scene.colours, strict=True):
            faint, until = mix(scene.theme.paper, colour, 0.5), trip.enter[-1]
            for visit, begin, until, activity in trip.trace_all_phases():
                head = trip.vertices[visit + (activity is Phase.DRIVE)]
                stroke = (self._x(begin), rows[trip.vertices[visit]]), (self._x(until), rows[head])
                width = BUSY_WIDTH if activity in BUSY else LINE_WIDTH
                is_faint = activity is Phase.WAIT or not self._is_true(trip.vertices[visit], head)
                pen.draw_line(stroke, faint if is_faint else colour, 1 if is_faint else width)
            y = rows[trip.vertices[-1]]
            pen.draw_line([(self._x(until), y), (self._x(scene.end), y)], faint, LINE_WIDTH)

    def _is_true(self, tail: int, head: int) -> bool:
        """Return whether the line has two vertices about as far apart as they are."""
        apart = abs(self.line[head] - self.line[tail])
        return tail == head or apart < MOST_STRETCHED * self.distance(tail, head)

    def _draw_robots(self, pen: Pen) -> None:
        """Draw a row for each robot, the first one at the top."""
        names = [robot.name for robot in self.scene.plan.scenario.robots]
        self._name_rows(pen, ((name, self._y(row)) for row, name in enumerate(names[::-1])))
        for robot, trip in enumerate(self.scene.trips):
            y = self._y(len(names) - 1 - robot)
            for _, begin, end, activity in trip.trace_all_phases():
                half = HALF_HEIGHTS.get(activity, 0) * ROW_HEIGHT
                if half:
                    corners = (self._x(begin), y - half), (self._x(end), y + half)
                    pen.fill_box(*corners, self.scene.colours[robot])

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
                    pen.fill_box((x, self.bottom - high), (x + 1, self.bottom - low), colour)
                low = high
        for place, (activity, colour) in enumerate(zip(STACK, colours, strict=True)):
            y = self.bottom - 10 - place * 20
            pen.fill_box((20, y - 5), (30, y + 5), colour)
            pen.write_text((37, y), activity.value, theme.muted, size=12, anchor="lm")


def _row_heights(places: Sequence[float], room: float) -> list[float]:
    """Return how high rows are: as far apart as their places, but not nearer than names need."""
    steps = np.diff(places)
    least = min(LEAST_ROW, room / max(len(steps), 1))
    low, high = 0.0, room / (places[-1] - places[0] or 1)
    for _ in range(40):
        scale = (low + high) / 2
        if np.maximum(steps * scale, least).sum() > room:
            high = scale
        else:
            low = scale
    return [0.0, *np.cumsum(np.maximum(steps * low, least)).tolist()]


def find_label_step(quantities: Quantities, least: float) -> Fraction:
    """Return the ticks between two labels: a round time, whole ticks where each could be seen."""
    below = [Fraction(digit, 10**power) for power in (3, 2, 1, 0) for digit in (1, 2, 5)]
    decimal = [
        *below,
        *(Fraction(digit * 10**power) for power in range(1, 15) for digit in (1, 2, 5)),
    ]
    times = [time / quantities.tick for time in decimal]
    if quantities.units.seconds is not None:
        unit = quantities.units.seconds * quantities.tick
        times = [time / unit for time in (*below, *ROUND_SECONDS)]
    fitting = [step for step in (*times, *decimal) if step >= max(least, 1)]
    return next(step for step in fitting if step.denominator == 1 or least > MOST_MARKED)


def _counts(trips: Sequence[Trip], end: int, samples: int) -> NDArray[np.int64]:
    """Return robots by activity of the stack and sample, in the middle of each sample."""
    changes = np.zeros((len(STACK), samples + 1), np.int64)
    for trip in trips:
        for _, begin, until, activity in trip.trace_all_phases():
            for tick, change in ((begin, 1), (until, -1)):
                first = -((end - 2 * tick * samples) // (2 * end))  # its middle is not before
                changes[STACK.index(activity), min(max(first, 0), samples)] += change
    return np.cumsum(changes, axis=1)[:, :-1]
