"""Scenarios, written: as a document that needs no other file."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np

from rightofway.errors import InputError
from rightofway.files import as_path, write_whole
from rightofway.io.formats import SCENARIO_FORMAT
from rightofway.io.json_text import format_json
from rightofway.io.scenario.work_writer import (
    dump_actions,
    dump_moment,
    dump_robot_of_jobs,
    dump_rules_of_jobs,
    dump_work,
)
from rightofway.kinds.arguments import checks_arguments
from rightofway.kinds.numbers import format_number
from rightofway.model import Robot, Scenario
from rightofway.model.attributes import list_plain_attributes
from rightofway.site import EdgeClass, Roadmap
from rightofway.site.drawing import Picture
from rightofway.units import Units, write_start


def dump_scenario(scenario: Scenario) -> dict[str, Any]:
    """Return a scenario as a document, its map inlined, its numbers exact.

    Parameters
    ----------
    scenario
        The scenario.

    Notes
    -----
    Reading the document gives an equal scenario, where robots and vertices have printable names,
    numbers have at most 18 digits, and a roadmap without a grid has labels.
    """
    roadmap = scenario.roadmap
    return {
        "format": SCENARIO_FORMAT,
        "map": _map(roadmap) | _write_spacing(scenario),
        **_write_units(scenario.units),
        "robots": [dump_robot(robot, scenario) for robot in scenario.robots],
        "rules": list_plain_attributes(scenario.rules) | dump_rules_of_jobs(scenario.rules),
        **_write_closures(scenario),
        **_write_actions(scenario),
        **dump_work(scenario),
    }


@checks_arguments
def write_scenario(scenario: Scenario, path: Path | str) -> None:
    """Write a scenario as YAML, JSON or a workbook, by the suffix of the path.

    Parameters
    ----------
    scenario
        The scenario.
    path
        A name that ends in .yaml, .yml, .json or .xlsx.

    Raises
    ------
    InputError
        For another suffix, or if the file cannot be written.
    """
    path = as_path(path)
    document = dump_scenario(scenario)
    if path.suffix.lower() == ".json":
        write_whole(path, format_json(document))
    elif path.suffix.lower() in {".yaml", ".yml"}:
        write_whole(path, format_yaml(document))
    elif path.suffix.lower() == ".xlsx":
        from rightofway.io.workbook.writer import format_workbook

        write_whole(path, format_workbook(document))
    else:
        endings = "end the name in .yaml, .json or .xlsx"
        message = f"the suffix {path.suffix!r} is no scenario's ({endings})"
        raise InputError.at("", message, str(path))


def format_scenario(scenario: Scenario) -> str:
    """Return a scenario as YAML, as `write_scenario` writes it.

    Parameters
    ----------
    scenario
        The scenario.
    """
    return format_yaml(dump_scenario(scenario))


def format_yaml(document: dict[str, Any]) -> str:
    """Return a scenario's document as YAML."""
    import yaml

    class Dumper(yaml.SafeDumper):
        """Writes text of several lines as a block, and each value where it stands."""

        def ignore_aliases(self, data: object) -> bool:  # noqa: ARG002
            """Return whether a value that stands in two places is written twice."""
            return True

    def block(dumper: yaml.SafeDumper, text: str) -> yaml.ScalarNode:
        style = "|" if "\n" in text else None
        return dumper.represent_scalar("tag:yaml.org,2002:str", text, style=style)

    Dumper.add_representer(str, block)
    shape = document.get("map")
    if isinstance(shape, dict) and isinstance(shape.get("grid"), list):
        shape = {**shape, "grid": "".join(f"{row}\n" for row in shape["grid"])}
        document = {**document, "map": shape}
    return str(
        yaml.dump(
            document,
            Dumper=Dumper,
            default_flow_style=None,  # a list or mapping of plain values stays on one line
            sort_keys=False,
            allow_unicode=True,
            width=float("inf"),
        )
    )


def _write_units(units: Units) -> dict[str, Any]:
    known = {"length": units.length, "time": units.time}
    written_units = {key: value for key, value in known.items() if value is not None}
    start = {} if units.start is None else {"start": write_start(units.start)}
    return ({"units": written_units} if written_units else {}) | start


def _map(roadmap: Roadmap) -> dict[str, Any]:
    return {**_write_shape(roadmap), **_write_picture(roadmap.drawing.picture)}


def _write_spacing(scenario: Scenario) -> dict[str, str]:
    """Return that lanes have been split, where a reader would split them for sizes."""
    splits = any(robot.radius for robot in scenario.robots) and not scenario.roadmap.has_cells
    return {"spacing": "whole"} if splits else {}


def _write_picture(picture: Picture | None) -> dict[str, Any]:
    """Return the picture below a map, if a scenario has named it."""
    if picture is None or not picture.name:
        return {}
    data: dict[str, Any] = {"file": picture.name}
    if picture.pixel is not None:
        data["scale"] = format_number(picture.pixel)
    if picture.origin is not None:
        data["origin"] = [format_number(part) for part in picture.origin]
    if picture.yaw:
        data["yaw"] = format_number(picture.yaw)
    if picture.opacity is not None:
        data["opacity"] = format_number(picture.opacity)
    return {"picture": data}


def _write_shape(roadmap: Roadmap) -> dict[str, Any]:
    grid, frame = roadmap.grid, roadmap.frame
    y = {"y": "up"} if frame.y_up else {}
    yaw = {"yaw": format_number(frame.yaw)} if frame.yaw else {}
    if grid is None:
        pivot = {"origin": [format_number(frame.x), format_number(frame.y)]} if frame.yaw else {}
        return {"roadmap": _write_roadmap(roadmap), **y, **pivot, **yaw}
    size = grid.cell_size
    left, bottom = frame.to_site((-size / 2, grid.rows * size - size / 2))
    usual = (Fraction(0), Fraction(0) if frame.y_up else grid.rows * size)
    origin = (
        {} if (left, bottom) == usual else {"origin": [format_number(left), format_number(bottom)]}
    )
    shape = {"grid": list(grid.as_lines()), "cell_size": format_number(size), **y, **origin, **yaw}
    named = [
        {
            "name": obstacle.name,
            "rect": [
                format_number(part)
                for part in (obstacle.x, obstacle.y, obstacle.width, obstacle.height)
            ],
        }
        for obstacle in roadmap.obstacles
    ]
    return {**shape, "obstacles": named} if named else shape


def _write_roadmap(roadmap: Roadmap) -> dict[str, Any]:
    passed = () if roadmap.passing is None else sorted(roadmap.passing.vertices)
    roadmap = roadmap.fold()
    name = roadmap.name
    positions = _write_positions(roadmap)
    vertices: dict[str, Any] = {name(vertex): position for vertex, position in enumerate(positions)}
    for vertex, types in roadmap.barred_vertices.items():
        vertices[name(vertex)] = {"at": positions[vertex], "barred": sorted(types)}
    for vertex in passed:
        own = vertices[name(vertex)]
        vertices[name(vertex)] = (own if isinstance(own, dict) else {"at": own}) | {"pass": True}
    for vertex, heading in roadmap.drawing.headings:
        own = vertices[name(vertex)]
        own = own if isinstance(own, dict) else {"at": own}
        vertices[name(vertex)] = own | {"heading": format_number(heading)}
    for vertex in sorted(roadmap.fixed):
        own = vertices[name(vertex)]
        own = own if isinstance(own, dict) else {"at": own}
        vertices[name(vertex)] = own | {"turning": False}
    own_keys: dict[tuple[int, int], dict[str, Any]] = {
        (int(tail), int(head)): {
            "curve": [[format_number(part) for part in point] for point in points]
        }
        for tail, head, points in roadmap.drawing.controls
    }
    for tail, head, orientation in roadmap.drawing.orientations:
        own_keys.setdefault((int(tail), int(head)), {})["orientation"] = format_number(orientation)
    for tail, head, may_turn in roadmap.drawing.turning:
        own_keys.setdefault((int(tail), int(head)), {})["turning"] = may_turn
    for tail, head, edge_id in roadmap.drawing.edge_ids:
        own_keys.setdefault((int(tail), int(head)), {})["id"] = edge_id
    names, of_class = (
        list(vertices),
        [_write_class(edge_class) for edge_class in roadmap.edge_classes],
    )
    tails = np.repeat(np.arange(roadmap.n_vertices), np.diff(roadmap.indptr))
    columns = (tails.tolist(), roadmap.heads.tolist(), roadmap.class_of_edge.tolist())
    nothing: dict[str, Any] = {}
    edges = [
        {
            "from": names[tail],
            "to": names[head],
            **of_class[kind],
            **own_keys.get((tail, head), nothing),
        }
        for tail, head, kind in zip(*columns, strict=True)
    ]
    zones = [
        {
            "name": zone.name,
            "vertices": [name(vertex) for vertex in zone.vertices],
            "edges": [[name(tail), name(head)] for tail, head in zone.edges],
        }
        for zone in roadmap.zones
    ]
    drawing = roadmap.drawing
    places = {
        "zones": zones,
        "stations": {station: name(at) for station, at in drawing.stations},
        "parking": [name(at) for at in drawing.parking],
        "charging": [name(at) for at in drawing.charging],
        "sides": list(map(_format_coordinate, roadmap.sides or ())),
    }
    return {"vertices": vertices, "edges": edges} | {
        key: value for key, value in places.items() if value
    }


def _write_positions(roadmap: Roadmap) -> list[list[Any]]:
    """Return x and y of each vertex in the site's frame before its yaw, exactly."""
    frame = roadmap.frame
    down = -1 if frame.y_up else 1
    if frame.x == frame.y == 0:
        # The sum has no -0.0, which would be read as 0.0.
        positions: list[list[Any]] = (roadmap.positions * (1.0, down) + 0.0).tolist()
        shifted = roadmap.fractions
    else:
        positions = roadmap.positions.tolist()
        shifted = dict(enumerate(roadmap.list_positions()))
    for vertex, (x, y) in shifted.items():
        positions[vertex] = list(map(_format_coordinate, (x + frame.x, down * y + frame.y)))
    return positions


def _format_coordinate(number: Fraction) -> float | str:
    """Return a coordinate as a decimal where that is exact, else as text like ``1/3``."""
    decimal = float(number)
    return decimal if Fraction(repr(decimal)) == number else str(number)


def _write_class(edge_class: EdgeClass) -> dict[str, Any]:
    """Return the common properties of the edges of a class."""
    data: dict[str, Any] = {"length": format_number(edge_class.length), "both_ways": False}
    if edge_class.max_speed is not None:
        data["max_speed"] = format_number(edge_class.max_speed)
    if edge_class.max_speed_by_type:
        data["max_speed_by_type"] = {
            name: format_number(speed) for name, speed in edge_class.max_speed_by_type
        }
    if edge_class.barred:
        data["barred"] = sorted(edge_class.barred)
    if edge_class.surcharge:
        data["surcharge"] = format_number(edge_class.surcharge)
    return data


def _write_closures(scenario: Scenario) -> dict[str, Any]:
    name = scenario.roadmap.name
    lanes = []
    for closure in scenario.closures:
        times = {"from": closure.from_, "until": closure.until, "radius": closure.radius}
        place = (
            {"at": name(closure.at)}
            if closure.edge is None and closure.at is not None
            else {"edge": [name(end) for end in closure.edge or ()]}
        )
        known = {
            key: dump_moment(value, scenario.units) if key != "radius" else format_number(value)
            for key, value in times.items()
            if value is not None
        }
        lanes.append({**place, **known})
    return {"closures": lanes} if lanes else {}


def _write_actions(scenario: Scenario) -> dict[str, Any]:
    """Return the actions of places."""
    actions = {
        scenario.roadmap.name(own.at): dump_actions(work=own.work, pick=own.pick, drop=own.drop)
        for own in scenario.actions
    }
    return {"actions": actions} if actions else {}


def dump_robot(robot: Robot, scenario: Scenario) -> dict[str, Any]:
    """Return a robot as scenario files have it."""
    roadmap = scenario.roadmap
    stops = [
        {
            "at": roadmap.name(stop.at),
            "work": format_number(stop.work),
            **dump_actions(actions=stop.actions),
        }
        for stop in robot.stops
    ]
    trip: dict[str, Any] = {"stops": stops}
    if scenario.jobs is not None:
        trip = dump_robot_of_jobs(robot, roadmap)
    elif len(stops) == 1:
        trip = {"target": stops[0].pop("at"), **stops[0]}
    return {
        "name": robot.name,
        "home": roadmap.name(robot.home),
        **trip,
        **list_plain_attributes(robot),
    }
