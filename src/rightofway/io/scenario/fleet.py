"""Robots of scenario documents: listed, in a table, on the rows of a `.scen` file, or housed."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import cycle
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rightofway.errors import InputError, shown
from rightofway.io.faults import Faults, blaming, checked, under
from rightofway.io.movingai import ScenRow, load_scen
from rightofway.io.robot_table import Located, robots_of_csv
from rightofway.io.scenario.homes import HOMELESS, housed
from rightofway.io.scenario.loaded_map import LoadedMap
from rightofway.io.scenario.maps import file_beside
from rightofway.model import Robot, Rules, Stop
from rightofway.model.robot import ROBOT_ATTRIBUTES
from rightofway.site import VertexId
from rightofway.site.places import kinds_of_places

if TYPE_CHECKING:
    from rightofway.io.fields import Document
    from rightofway.io.scenario.shape import FleetDocument

DEFAULT_SPEED = Fraction(1)

HOME = f"the place it starts from: {kinds_of_places(None)}"


def robots_in_table(data: dict[str, Any], base: Path | None) -> Located:
    """Return the robots of a CSV file that the document names."""
    from rightofway.io.scenario.shape import RobotDocument, RobotTableDocument

    with under("robots"):
        name = checked(RobotTableDocument, data).table
        with under("table"):
            known = [field.alias or key for key, field in RobotDocument.model_fields.items()]
            return robots_of_csv(file_beside(base, name), known)


@dataclass(frozen=True, slots=True, kw_only=True)
class FleetRows:
    """Robots R1, R2, ... on the rows of a `.scen` file, speeds and work dealt out in turn."""

    document: FleetDocument
    file: Path
    rows: Sequence[ScenRow]


@dataclass(frozen=True, slots=True, kw_only=True)
class Placed:
    """A robot, its place in the document, and keys of it that stand elsewhere."""

    robot: Robot
    place: str
    aliases: Mapping[str, str]


def written_robots(data: Any, base: Path | None) -> Sequence[Any] | FleetRows:
    """Return robots as they are listed, or the rows of a file that they stand on."""
    from rightofway.io.scenario.shape import FleetDocument

    if isinstance(data, list) and data:
        return data
    if not isinstance(data, dict):
        remedy = "give a list of robots, {scen: a file} or {table: a file}"
        message = f"{shown(data)} is no fleet ({remedy})"
        raise InputError.at("", message)
    document = checked(FleetDocument, data)
    with under("scen"):
        file = file_beside(base, document.scen)
        rows = load_scen(file)
    if document.count is not None and document.count > len(rows):
        message = f"{document.count} is more than the {len(rows)} rows of {file} (give fewer)"
        raise InputError.at("count", message)
    return FleetRows(document=document, file=file, rows=rows[: document.count])


def speeds_of(robots: Sequence[Any] | FleetRows) -> list[Fraction] | None:
    """Return the speeds of all robots, or None if some cannot be read."""
    from rightofway.io.fields import positive

    if isinstance(robots, FleetRows):
        return (robots.document.speeds or [DEFAULT_SPEED])[: len(robots.rows)]
    try:
        return [positive(robot.get("speed", DEFAULT_SPEED)) for robot in robots]
    except (AttributeError, ValueError):
        return None


def largest_radius(robots: Sequence[Any] | FleetRows) -> Fraction:
    """Return the largest radius of the fleet; a radius that cannot be read is a fault elsewhere."""
    from rightofway.io.scenario.shape import RobotDocument

    if isinstance(robots, FleetRows):
        return Fraction(robots.document.given("radius").get("radius", 0))
    found = Fraction(0)
    for robot in robots:
        try:
            space = checked(RobotDocument, robot).space()
        except InputError:
            continue
        found = max(found, space.get("radius", Fraction(0)))
    return found


def types_of(robots: Sequence[Any] | FleetRows) -> frozenset[str | None]:
    """Return the types of the fleet; None stands for a robot without one."""
    if isinstance(robots, FleetRows):
        return frozenset([robots.document.given("type").get("type")])
    found = (robot.get("type") for robot in robots if isinstance(robot, dict))
    return frozenset(name if isinstance(name, str) else None for name in found)


def _place_of_laps(document: Document, place: str) -> str:
    """Return where the document asks a robot without a way back for several laps."""
    if document.given("laps"):
        return f"{place}.laps"
    return f"{place}.return" if document.given("ends") else "rules.laps"


def placed_robots(
    robots: Sequence[Any] | FleetRows,
    on: LoadedMap | None,
    rules: Rules,
    faults: Faults,
    *,
    deals: bool,
) -> tuple[Sequence[Placed], Sequence[str]]:
    """Return the robots at their homes, and notes on homes that were dealt out."""
    if isinstance(robots, FleetRows):
        return (_dealt(robots, on, faults) if on else ()), ()
    placed = _listed(robots, on, faults, deals=deals)
    return _housed(placed, on, rules, faults) if deals and on and placed else (placed, ())


def _listed(
    robots: Sequence[Any], on: LoadedMap | None, faults: Faults, *, deals: bool
) -> list[Placed]:
    """Return robots that are listed; note the faults of others. Without a map, only note faults."""
    from rightofway.io.scenario.shape import RobotDocument

    placed = list[Placed]()
    for index, data in enumerate(robots):
        place = f"robots[{index}]"
        if not deals and isinstance(data, dict) and "home" not in data:
            faults.note(f"{place}.home", f"is missing (give {HOME}, or homes: parking for all)")
        document = faults.attempt(place, checked, RobotDocument, data, on)
        if document is None or on is None or (document.home is None and not deals):
            continue
        own = {**document.own(Robot), **document.space()}
        stops = tuple(Stop(at=at, work=work or Fraction(0)) for at, work in document.trip())
        home = HOMELESS if document.home is None else document.home
        robot = Robot(name=document.name, home=home, stops=stops, **own)
        aliases = {"laps": _place_of_laps(document, place)}
        if "turn_rate" not in own:
            aliases["turn_rate"] = "rules.turn_rate"
        if document.target is not None:
            aliases["stops[0].at"] = f"{place}.target"
        placed.append(Placed(robot=robot, place=place, aliases=aliases))
    return placed


def _housed(
    placed: Sequence[Placed], on: LoadedMap, rules: Rules, faults: Faults
) -> tuple[Sequence[Placed], Sequence[str]]:
    """Return the robots, those without a home at parking places, and a note of who starts where."""
    found = faults.attempt("", housed, [it.robot for it in placed], on.roadmap, rules)
    if found is None:
        return (), ()
    robots, notes = found
    return [replace(it, robot=robot) for it, robot in zip(placed, robots, strict=True)], notes


def _dealt(robots: FleetRows, on: LoadedMap, faults: Faults) -> list[Placed]:
    """Return the robots on the rows of a file, or none after noting why."""
    document, placed = robots.document, list[Placed]()
    ends = faults.attempt("robots.scen", _starts_and_goals, robots, on) or []
    speeds, works = cycle(document.speeds or [DEFAULT_SPEED]), cycle(document.work or [Fraction(0)])
    own = document.own(Robot)
    aliases = {it.name: f"robots.{it.key}" for it in ROBOT_ATTRIBUTES if it.name in own}
    aliases |= {"laps": _place_of_laps(document, "robots")}
    if "turn_rate" not in own:
        aliases["turn_rate"] = "rules.turn_rate"
    dealt = zip(ends, speeds, works, strict=False)
    for number, ((home, goal), speed, work) in enumerate(dealt, start=1):
        stops = (Stop(at=goal, work=work),)
        robot = Robot(name=f"R{number}", home=home, stops=stops, speed=speed, **own)
        placed.append(Placed(robot=robot, place="robots.scen", aliases=aliases))
    return placed


def _starts_and_goals(robots: FleetRows, on: LoadedMap) -> list[tuple[VertexId, VertexId]]:
    faults, ends, taken = Faults(), list[tuple[VertexId, VertexId]](), dict[VertexId, int]()
    with blaming(str(robots.file)):
        for row in robots.rows:
            _check_map(row, on)  # stops at the first: the others are for the same map
        for row in robots.rows:
            start = faults.attempt(f"line {row.line}, start", on.find, row.start)
            goal = faults.attempt(f"line {row.line}, goal", on.find, row.goal)
            if start is None or goal is None:
                continue
            if taken.setdefault(start, row.line) != row.line:
                message = f"line {taken[start]} starts there already (a cell holds one robot)"
                faults.note(f"line {row.line}, start", message)
            ends.append((start, goal))
        faults.stop()
    return ends


def _check_map(row: ScenRow, on: LoadedMap) -> None:
    grid, place = on.roadmap.grid, f"line {row.line}"
    if grid is None:
        raise InputError.at("", "its rows need a grid (give the map as grid, file or floor)")
    if (row.width, row.height) != (grid.columns, grid.rows):
        size = f"{row.width} x {row.height} cells, but the map has {grid.columns} x {grid.rows}"
        raise InputError.at(place, f"{size} (give the map it was made for)")
    name = re.split(r"[\\/]", row.map_name)[-1]
    if on.file is not None and name != on.file.name:
        message = f"is for {name!r}, but the map is {on.file.name!r} (give the right one)"
        raise InputError.at(place, message)
