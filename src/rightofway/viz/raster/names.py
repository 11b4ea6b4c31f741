"""Names of robots and places in a picture, none over another; robots come first.

A name without room is left out. The page places names in the same way, in ``map_names.js``.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from rightofway.viz.motion import Moment, Phase
from rightofway.viz.palette import choose_ink
from rightofway.viz.raster.canvas import Pen, Point, Scene
from rightofway.viz.raster.sizes import Sizes

Box = tuple[float, float, float, float]
"""Left, top, right, bottom [pixels]."""

Label = tuple[str, Box]
"""A name and where it stands."""

MOST_NAMED = 100
"""Robots; the names of more cannot be read."""

NAMED_CELL = 40
"""From this size of a cell on [pixels] the vertices of a grid have their names."""

ROBOT_TYPE, PLACE_TYPE = 13.0, 12.0
"""Size of letters [pixels]."""

LEAST_NAMED_INSIDE = 13
"""Radius of a robot from which on its name may stand inside [pixels]."""

AT_HOME = 3
"""How near to its home a robot's name stands beside the frame [pixels]."""

LONGEST_NAME = 20
"""Characters; longer names are cut."""

SIDES = ((1, 0), (-1, 0), (0, -1), (0, 1), (0.75, -0.8), (-0.75, -0.8), (0.75, 0.8), (-0.75, 0.8))
"""Where a name may stand round a disc, best first: how far right and down its middle is."""


class MapNames:
    """Places the names of one picture after another, so that they do not jump in a film."""

    def __init__(self, scene: Scene, sizes: Sizes, scale: float, bounds: Box) -> None:
        self.scene, self.sizes, self.scale = scene, sizes, scale
        self.bounds = bounds  # of the picture, seen from the map's (0, 0) [pixels]
        self._sides = [0] * len(scene.trips)  # of each robot's name
        self._lanes = _points_along_lanes(scene, scale, sizes.lane)

    def draw(self, pen: Pen, moments: Sequence[Moment], middles: Sequence[Point]) -> list[Label]:
        """Write the names of robots and places; return those that have room."""
        written: list[Label] = []
        if len(moments) > MOST_NAMED:
            return written
        scale = self.scale
        discs = [(x * scale, y * scale) for x, y in middles]
        taken = [
            (x - radius, y - radius, x + radius, y + radius)
            for (x, y), radius in zip(discs, self.sizes.robots, strict=True)
        ]
        for robot, (moment, (x, y)) in enumerate(zip(moments, discs, strict=True)):
            radius = self.sizes.robots[robot]
            name = _cut(self.scene.plan.scenario.robots[robot].name)
            inside = min(radius * 0.78, 20)
            if (
                radius >= LEAST_NAMED_INSIDE
                and pen.measure_text(name, inside) * scale < radius * 1.7
            ):
                self._write_inside(pen, robot, moment, middles[robot], inside)
                half = pen.measure_text(name, inside) * scale / 2
                written.append((name, (x - half, y - inside / 2, x + half, y + inside / 2)))
                continue
            box = self._beside(robot, (x, y), pen.measure_text(name, ROBOT_TYPE) * scale, taken)
            if box is not None:
                taken.append(box)
                done = moment.activity is Phase.DONE
                ink = self.scene.theme.muted if done else self.scene.theme.ink
                self._write(pen, name, box, ink, ROBOT_TYPE)
                written.append((name, box))
        taken += self._marks()
        for name, boxes, ink in self._places(pen):
            box = next((box for box in boxes if self._is_free(box, taken)), None)
            if box is not None:
                taken.append(box)
                self._write(pen, name, box, ink, PLACE_TYPE)
                written.append((name, box))
        return written

    def _write_inside(
        self, pen: Pen, robot: int, moment: Moment, middle: Point, size: float
    ) -> None:
        is_hollow = moment.activity in (Phase.WAIT, Phase.DONE)
        ink = self.scene.theme.ink if is_hollow else choose_ink(self.scene.colours[robot])
        name = self.scene.plan.scenario.robots[robot].name
        pen.write_text(middle, name, ink, size=size, anchor="mm")

    def _write(self, pen: Pen, name: str, box: Box, ink: str, size: float) -> None:
        left, top, _, bottom = box
        at = (left / self.scale, (top + bottom) / 2 / self.scale)
        pen.write_text(at, name, ink, size=size, anchor="lm", halo=self.scene.ground)

    def _beside(self, robot: int, disc: Point, width: float, taken: Sequence[Box]) -> Box | None:
        """Return the box of a name beside its disc: where it was if that is free."""
        home = self.scene.points[self.scene.trips[robot].vertices[0]]
        away = math.dist(disc, (home[0] * self.scale, home[1] * self.scale))
        radius = (self.sizes.homes if away < AT_HOME else self.sizes.robots)[robot]
        for step in range(len(SIDES)):
            side = (self._sides[robot] + step) % len(SIDES)
            box = _box_beside(disc, radius, width, ROBOT_TYPE + 2, SIDES[side])
            if self._is_free(box, taken):
                self._sides[robot] = side
                return box
        return None

    def _marks(self) -> Iterator[Box]:
        """Yield the boxes of homes and stops on a roadmap; a cell has room for its name as well."""
        if self.scene.roadmap.grid is not None:
            return
        for trip, home in zip(self.scene.trips, self.sizes.homes, strict=True):
            for vertex in {trip.vertices[0], *(stage.vertex for stage in trip.stages)}:
                half = home if vertex == trip.vertices[0] else self.sizes.stop
                x, y = (self.scale * part for part in self.scene.points[vertex])
                yield x - half, y - half, x + half, y + half

    def _places(self, pen: Pen) -> Iterator[tuple[str, list[Box], str]]:
        """Yield each place's name, where it may stand, and its colour; homes and stops first."""
        scene, scale, high = self.scene, self.scale, PLACE_TYPE + 2
        is_grid = scene.roadmap.grid is not None
        if is_grid and scale < NAMED_CELL:
            return
        homes = {
            trip.vertices[0]: half for trip, half in zip(scene.trips, self.sizes.homes, strict=True)
        }
        marks = {*homes, *(stage.vertex for trip in scene.trips for stage in trip.stages)}
        named = range(len(scene.points)) if scene.roadmap.sides is None else sorted(marks)
        for vertex in sorted(named, key=lambda vertex: vertex not in marks):
            x, y = (scale * part for part in scene.points[vertex])
            name = _cut(scene.where(vertex))
            width = pen.measure_text(name, PLACE_TYPE) * scale
            ink = scene.theme.ink if vertex in marks else scene.theme.muted
            if is_grid:
                left, top = x - scale * 0.45, y - scale * 0.45
                if width < scale * 0.9:
                    yield name, [(left, top, left + width, top + high)], ink
                continue
            radius = (
                homes.get(vertex, min(self.sizes.homes)) if vertex in marks else self.sizes.lane / 2
            )
            boxes = [_box_beside((x, y), radius, width, high, side) for side in SIDES]
            beside_lanes = [box for box in boxes if not self._covers_lane(box)]
            yield name, beside_lanes + (boxes if vertex in marks else []), ink

    def _is_free(self, box: Box, taken: Sequence[Box]) -> bool:
        left, top, right, bottom = box
        least_x, least_y, most_x, most_y = self.bounds
        if left < least_x or top < least_y or right > most_x or bottom > most_y:
            return False
        return all(
            label[0] >= right or label[2] <= left or label[1] >= bottom or label[3] <= top
            for label in taken
        )

    def _covers_lane(self, box: Box) -> bool:
        (left, top, right, bottom), (x, y) = box, self._lanes.T
        half = self.sizes.lane / 2
        covered = (x > left - half) & (x < right + half) & (y > top - half) & (y < bottom + half)
        return bool(covered.any())


def _points_along_lanes(scene: Scene, scale: float, apart: float) -> NDArray[np.float64]:
    """Return points along all lanes that are drawn [pixels]; shape (P, 2)."""
    points = [np.empty((0, 2))]
    if scene.roadmap.grid is None and scene.roadmap.sides is None:
        for tail, head in scene.edges:
            (x, y), (to_x, to_y) = scene.points[tail], scene.points[head]
            count = min(math.ceil(math.hypot(to_x - x, to_y - y) * scale / apart), 300) + 1
            points.append(np.linspace((x * scale, y * scale), (to_x * scale, to_y * scale), count))
    return np.concatenate(points)


def _box_beside(disc: Point, radius: float, width: float, height: float, side: Point) -> Box:
    x = disc[0] + side[0] * (radius + 3 + width / 2)
    y = disc[1] + side[1] * (radius + 2 + height / 2)
    return x - width / 2, y - height / 2, x + width / 2, y + height / 2


def _cut(name: str) -> str:
    return name if len(name) <= LONGEST_NAME else f"{name[: LONGEST_NAME - 1]}…"
