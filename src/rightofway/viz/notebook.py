"""A scenario in a notebook: a drawing of its map, and a table of its robots."""

from __future__ import annotations

from collections.abc import Iterator
from html import escape
from itertools import groupby

import numpy as np

from rightofway.model import Robot, Scenario
from rightofway.report.place_names import PlaceNames
from rightofway.report.quantities import Quantities
from rightofway.viz.palette import LIGHT, choose_colours
from rightofway.viz.placement import Plane, lay_out_roadmap

MOST_VERTICES = 20_000
"""A larger map is not drawn."""

MOST_ROBOTS = 20
"""Robots in the table; the others are counted."""

LARGEST = 480
"""The longer side of the drawing [pixels]."""

LARGEST_UNIT = 48
"""A cell, or a short edge, of a small map [pixels]."""


SMALLEST_RADIUS = 3
"""Of a home or a stop [pixels]."""


def make_scenario_html(scenario: Scenario) -> str:
    """Return HTML that shows a scenario: map, homes (discs), stops (rings) and robots.

    Parameters
    ----------
    scenario
        The scenario.
    """
    count = len(scenario.robots)
    parts = [_draw_scenario(scenario)] if scenario.roadmap.n_vertices <= MOST_VERTICES else []
    head = "".join(f"<th>{name}</th>" for name in ("robot", "home", "stops", "speed"))
    rows = "".join(_write_row(scenario, robot) for robot in scenario.robots[:MOST_ROBOTS])
    parts.append(f"<table><thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table>")
    if count > MOST_ROBOTS:
        parts.append(f"<p>… and {count - MOST_ROBOTS} more robots</p>")
    return f"<div>{''.join(parts)}</div>"


def _write_row(scenario: Scenario, robot: Robot) -> str:
    place, quantities = PlaceNames(scenario).describe_place, Quantities.of(scenario)
    stops = []
    for stop in robot.stops:
        ticks = stop.work / quantities.tick
        work = f" (works {quantities.format_duration(ticks)})" if stop.work else ""
        stops.append(f"{place(stop.at)}{work}")
    cells = (robot.name, place(robot.home), ", ".join(stops), quantities.format_speed(robot.speed))
    return "<tr>" + "".join(f"<td>{escape(cell)}</td>" for cell in cells) + "</tr>"


def _draw_scenario(scenario: Scenario) -> str:
    plane = lay_out_roadmap(scenario.roadmap)
    scale = min(LARGEST / max(plane.width, plane.height), LARGEST_UNIT)
    width, height = (round(side * scale) for side in (plane.width, plane.height))
    box = f"-0.5 -0.5 {plane.width:.6g} {plane.height:.6g}"
    radius = max(0.3, SMALLEST_RADIUS / scale)
    shapes = "".join([*_map_shapes(scenario, plane), *_draw_robots(scenario, plane, radius)])
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" role="img" aria-label="map" width="{width}"'
        f' height="{height}" viewBox="{box}" style="background:{LIGHT.floor};'
        f'border:1px solid {LIGHT.wall}">{shapes}</svg>'
    )


def _map_shapes(scenario: Scenario, plane: Plane) -> Iterator[str]:
    """Yield the walls of a grid, or the lanes of a roadmap."""
    roadmap = scenario.roadmap.fold()
    if roadmap.grid is not None:
        runs = []
        for row, line in enumerate(roadmap.grid.as_lines()):
            for is_wall, run in groupby(enumerate(line), lambda cell: cell[1] == "@"):
                cells = [column for column, _ in run]
                if is_wall:
                    runs.append(f"M{cells[0] - 0.5} {row - 0.5}h{len(cells)}v1h-{len(cells)}z")
        yield f'<path fill="{LIGHT.wall}" d="{"".join(runs)}"/>'
        return
    tails = np.repeat(np.arange(roadmap.n_vertices), np.diff(roadmap.indptr))
    pairs = zip(tails.tolist(), roadmap.heads.tolist(), strict=True)
    ends = {(min(pair), max(pair)) for pair in pairs}
    lanes = "".join(
        "M{:.6g} {:.6g}L{:.6g} {:.6g}".format(*plane.points[tail], *plane.points[head])
        for tail, head in sorted(ends)
    )
    yield f'<path stroke="{LIGHT.wall}" stroke-width="0.12" fill="none" d="{lanes}"/>'


def _draw_robots(scenario: Scenario, plane: Plane, radius: float) -> Iterator[str]:
    """Yield a disc for the home and a ring for each stop of each robot, with its name."""
    colours = choose_colours(len(scenario.robots))
    for robot, colour in zip(scenario.robots, colours, strict=True):
        title = f"<title>{escape(robot.name)}</title>"
        for stop in robot.stops:
            x, y = plane.points[stop.at]
            yield (
                f'<circle cx="{x:.6g}" cy="{y:.6g}" r="{radius:.6g}" fill="none"'
                f' stroke="{colour}" stroke-width="{0.4 * radius:.6g}">{title}</circle>'
            )
        x, y = plane.points[robot.home]
        yield f'<circle cx="{x:.6g}" cy="{y:.6g}" r="{radius:.6g}" fill="{colour}">{title}</circle>'
