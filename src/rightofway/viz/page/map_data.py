"""A map as the pages read it, with or without a plan; ``roadmap.js`` reads all this."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Sequence
from fractions import Fraction
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from rightofway.model.resources import close_pairs
from rightofway.model.work import Work
from rightofway.site import Grid, Point, Roadmap
from rightofway.viz.page.background import Background, find_background, make_background_data
from rightofway.viz.page.schema import CloseData, FrameData, MapData, ObstacleRow
from rightofway.viz.placement import Plane, lay_out_roadmap

DECIMALS = {"grid": 3, "network": 6}
"""Decimals of a position [units of the drawing]; vertices of a roadmap are right to a micrometre or
so, because distances of robots with a size are read from them."""

MOST_CLOSE = 5_000
"""Crossings, and pairs that are too near, that the page marks."""


def map_data(
    roadmap: Roadmap,
    *,
    room: Fraction = Fraction(0),
    background: Background | None = None,
) -> MapData:
    """Return a map as plain data for JSON: graph, frame, places, zones, limits, picture.

    Raises
    ------
    InputError
        If the picture cannot be read.
    """
    roadmap = roadmap.fold()
    plane, grid = lay_out_roadmap(roadmap), roadmap.grid
    decimals = DECIMALS["network" if grid is None else "grid"]
    data: dict[str, Any] = {
        "width": round(plane.width, decimals),
        "height": round(plane.height, decimals),
        "frame": _make_frame(plane, roadmap),
    }
    if grid is not None:
        data["rows"] = grid.as_lines()
    else:
        tails = np.repeat(np.arange(roadmap.n_vertices), np.diff(roadmap.indptr))
        data |= {
            "names": [roadmap.name(vertex) for vertex in range(roadmap.n_vertices)],
            "points": np.round(plane.points, decimals).ravel().tolist(),
            "tails": compute_differences(tails.tolist()),
            "heads": compute_differences(roadmap.heads.tolist()),
            "lengths": [
                float(roadmap.get_edge_class(edge).length) for edge in range(roadmap.n_edges)
            ],
        }
    drawing = roadmap.drawing
    sides = () if roadmap.sides is None else roadmap.drawn_sides / plane.unit
    marks = {
        "obstacles": [] if grid is None else _list_obstacles(roadmap, grid),
        "sides": np.round(sides, decimals).tolist(),
        "limits": _list_limits(roadmap),
        "passed": [] if roadmap.passing is None else sorted(roadmap.passing.vertices),
        "zones": [(zone.name, list(zone.vertices), list(zone.edges)) for zone in roadmap.zones],
        "joints": _list_joints(roadmap),
        "curves": [
            [
                tail,
                head,
                *np.round(_convert_to_drawing(plane, roadmap, points), decimals).ravel().tolist(),
            ]
            for tail, head, points in drawing.curves
            if not room  # robots with a size are judged on straight lanes
        ],
        "stations": list(drawing.stations),
        "parking": list(drawing.parking),
        "charging": list(drawing.charging),
        "close": _close(roadmap, room) if room and grid is None else {},
    }
    data |= {key: value for key, value in marks.items() if value}
    background = background or find_background(roadmap)
    if background:
        data["background"] = make_background_data(roadmap, background)
    return cast("MapData", data)


def mark_charging_places(data: MapData, work: Work) -> None:
    """Add the charging places of the robots of a scenario with jobs to those of its map."""
    own = {int(place) for robot in work.robots for place in robot.charging}
    data["charging"] = sorted({*data.get("charging", []), *own})


def compute_differences(numbers: Iterable[int]) -> list[int]:
    """Return first differences: those of ``[3, 4, 6]`` are ``[3, 1, 2]``."""
    first_differences: list[int] = np.diff(np.fromiter(numbers, np.int64), prepend=0).tolist()
    return first_differences


def _make_frame(plane: Plane, roadmap: Roadmap) -> FrameData:
    """Return where (0, 0) of the drawing lies on the site, and the length of its unit there."""
    left, top = map(Fraction, plane.corner)
    x, y = roadmap.frame.to_site((left, top))
    data: FrameData = {
        "x": float(x),
        "y": float(y),
        "yUp": roadmap.frame.y_up,
        "unit": plane.unit,
    }
    return {**data, "yaw": float(roadmap.frame.yaw)} if roadmap.frame.yaw else data


def _convert_to_drawing(
    plane: Plane, roadmap: Roadmap, points: Sequence[Point]
) -> NDArray[np.float64]:
    """Return where points of the site are in the drawing; shape (n, 2)."""
    at = [[float(part) for part in roadmap.frame.to_plane(point)] for point in points]
    in_units: NDArray[np.float64] = (np.array(at) - plane.corner) / plane.unit
    return in_units


def _list_obstacles(roadmap: Roadmap, grid: Grid) -> list[ObstacleRow]:
    """Return the named obstacles: name, left, top, width and height in the drawing."""
    size, rows = grid.cell_size, list[ObstacleRow]()
    low = grid.rows * size - size / 2
    left, bottom = roadmap.frame.to_site((-size / 2, low))
    for obstacle in roadmap.obstacles:
        down = bottom - obstacle.y - obstacle.height if roadmap.frame.y_up else obstacle.y - bottom
        sides = (obstacle.x - left - size / 2, low + down, obstacle.width, obstacle.height)
        x, y, width, height = (round(float(side / size), DECIMALS["grid"]) for side in sides)
        rows.append((obstacle.name, x, y, width, height))
    return rows


def _list_joints(roadmap: Roadmap) -> list[list[int]]:
    """Return the vertices between the pieces of each split lane, once for both directions.

    The page names a lane at the middle of its list: this is a vertex of the first direction.
    """
    joints = dict[tuple[int, ...], list[int]]()
    for lane in roadmap.lanes:
        places = [sorted(map(int, roadmap.list_place(vertex))) for vertex in lane.joints]
        firsts = [place[0] for place in places]
        others = [vertex for place in places for vertex in place[1:]]
        half = -(-len(others) // 2)
        key = min(tuple(firsts), tuple(firsts[::-1]))
        joints.setdefault(key, [*others[:half], *firsts, *others[half:]])
    return list(joints.values())


def _list_limits(roadmap: Roadmap) -> list[tuple[str, list[int]]]:
    """Return the speed limits, each with its edges."""
    edges = defaultdict[str, list[int]](list)
    for edge in range(roadmap.n_edges):
        edge_class = roadmap.get_edge_class(edge)
        limits = (edge_class.max_speed, *dict(edge_class.max_speed_by_type).values())
        for limit in sorted({limit for limit in limits if limit is not None}):
            edges[str(limit)].append(edge)
    return list(edges.items())


def _close(roadmap: Roadmap, room: Fraction) -> CloseData:
    """Return lanes that cross without a vertex, and vertices and lanes that are nearer than room.

    Vertices that a lane joins are left out: no robot is surprised there.
    """
    pairs = close_pairs(roadmap, room)
    tails = np.repeat(np.arange(roadmap.n_vertices), np.diff(roadmap.indptr)).tolist()
    joined = set(zip(tails, roadmap.heads.tolist(), strict=True))
    data: CloseData = {
        "crossings": [(*first, *other) for first, other in pairs.crossings[:MOST_CLOSE]],
        "beside": [(vertex, *lane) for vertex, lane in pairs.beside[:MOST_CLOSE]],
        "vertices": [
            pair for pair in pairs.vertices if pair not in joined and pair[::-1] not in joined
        ][:MOST_CLOSE],
    }
    return cast("CloseData", {key: value for key, value in data.items() if value})
