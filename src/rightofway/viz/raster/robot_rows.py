"""A row for each robot: thin while it drives, a gap while it waits, full while it works."""

from __future__ import annotations

from rightofway.viz.motion import Activity
from rightofway.viz.raster.axis import Axes, name_rows
from rightofway.viz.raster.pen import Pen
from rightofway.viz.raster.scene import Scene

__all__ = ["draw_robot_rows"]

HALF_HEIGHTS = {Activity.DRIVE: 0.12, Activity.WORK: 0.36, Activity.TURN: 0.36}
"""Of a row; what is not here leaves a gap."""


def draw_robot_rows(pen: Pen, scene: Scene, axes: Axes) -> None:
    """Draw a diagram whose rows are the robots, the first one at the top."""
    names = [robot.name for robot in scene.plan.scenario.robots]
    name_rows(pen, scene, axes, names[::-1])
    for robot, trip in enumerate(scene.trips):
        y = axes.row(len(names) - 1 - robot)
        for visit in range(len(trip.vertices)):
            for begin, end, activity in trip.phases(visit):
                half = HALF_HEIGHTS.get(activity, 0) * axes.row_height
                if half:
                    corners = (axes.x(begin), y - half), (axes.x(end), y + half)
                    pen.box(*corners, scene.colours[robot])
