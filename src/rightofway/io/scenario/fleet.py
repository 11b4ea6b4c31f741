"""Robots of scenario documents: listed, in a table, or on the rows of a `.scen` file.

Robots are read once, with their places as written; on a map, places become vertices. A robot that
has no home is `HOMELESS`: to find one is the work of `rightofway.assign`.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import cycle
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rightofway.assign import HOMELESS
from rightofway.errors import (
    InputError,
    InputFault,
    Location,
    Steps,
    Where,
    locate_faults,
    name_file,
    quote,
)
from rightofway.io.faults import Faults, list_keys, validate
from rightofway.io.movingai import ScenRow, load_scen
from rightofway.io.scenario.loaded_map import FleetTraits, LoadedMap
from rightofway.io.scenario.maps import find_file_beside
from rightofway.io.scenario.work import read_state
from rightofway.model import Robot, Stop
from rightofway.model.robot import ROBOT_ATTRIBUTES
from rightofway.site import VertexId
from rightofway.site.places import as_place, list_kinds_of_places

if TYPE_CHECKING:
    from rightofway.io.fields import Document
    from rightofway.io.scenario.shape import RobotDocument, StopDocument
    from rightofway.io.tables import CellDocument

DEFAULT_SPEED, NO_WORK = Fraction(1), Fraction(0)

HOME = f"the place it starts from: {list_kinds_of_places(None)}"


def read_robots_in_table(data: dict[str, Any], base: Path | None) -> CellDocument:
    """Return the robots of a CSV file that the document names."""
    from rightofway.io.scenario.shape import RobotDocument, RobotTableDocument
    from rightofway.io.tables import read_csv, read_robots_of_rows

    with locate_faults("robots"):
        name = validate(RobotTableDocument, data).table
        with locate_faults("table"):
            rows, cell = read_csv(find_file_beside(base, name), ("robots", "table"))
            return read_robots_of_rows(rows, cell, list_keys(RobotDocument))


@dataclass(frozen=True, slots=True, kw_only=True)
class FleetRows:
    """Robots R1, R2, ... on the rows of a `.scen` file, speeds and work dealt out in turn.

    Attributes
    ----------
    file, rows
        The file, and its first rows.
    speeds, works
        The speeds and works that are dealt out.
    own
        The attributes that all have.
    place, aliases
        Where a document names the file, and keys of robots that stand elsewhere in it; without a
        document, nowhere.
    """

    file: Path
    rows: Sequence[ScenRow]
    speeds: Sequence[Fraction] = (DEFAULT_SPEED,)
    works: Sequence[Fraction] = (NO_WORK,)
    own: Mapping[str, Any] = field(default_factory=dict)
    place: Steps = ()
    aliases: Mapping[Steps, Steps] = field(default_factory=dict)

    @property
    def traits(self) -> FleetTraits:
        """Properties of a fleet on which a map depends."""
        speeds, radius = self.speeds[: len(self.rows)], self.own.get("radius", Fraction(0))
        return FleetTraits(speeds=speeds, radius=radius, types=frozenset([self.own.get("type")]))


@dataclass(frozen=True, slots=True, kw_only=True)
class ListedRobot:
    """A robot of a list, read before the map is known.

    Attributes
    ----------
    index
        Its number in the list, from 0.
    data, document
        The robot as written; and as a document with places as written, None where it has faults.
    own
        The attributes that can be read.
    faults
        Its faults, apart from those of its places.
    """

    index: int
    data: Any
    document: RobotDocument | None
    own: Mapping[str, Any]
    faults: Sequence[InputFault] = ()

    @property
    def place(self) -> Steps:
        """Where it stands in the document."""
        return ("robots", self.index)

    def find(self, on: LoadedMap | None, faults: Faults) -> dict[Steps, VertexId]:
        """Return the vertices of its places by their keys, or note why there are none."""
        if not isinstance(self.data, dict):
            return {}
        stops = self.data.get("stops")
        written: dict[Steps, Any] = {
            (key,): self.data[key] for key in ("home", "target") if key in self.data
        }
        for index, stop in enumerate(stops if isinstance(stops, list) else ()):
            if isinstance(stop, dict) and "at" in stop:
                written["stops", index, "at"] = stop["at"]
        start, charging = self.data.get("start"), self.data.get("charging")
        if isinstance(start, dict) and "at" in start:
            written["start", "at"] = start["at"]
        for index, place in enumerate(charging if isinstance(charging, list) else ()):
            written["charging", index] = place
        find: Callable[[Any], Any] = on.find if on else as_place
        places = {key: faults.attempt(key, find, place) for key, place in written.items()}
        return {key: vertex for key, vertex in places.items() if on and vertex is not None}


def read_robot(index: int, data: Any, *, has_jobs: bool) -> ListedRobot:
    """Return a robot of a list; of one with faults the attributes that have none."""
    from rightofway.io.scenario.shape import RobotAttributes, RobotDocument

    try:
        document = validate(RobotDocument, data)
        _check_trip(document, has_jobs=has_jobs)
    except InputError as error:
        faults, own = error.faults, dict[str, Any]()
        for attribute in ROBOT_ATTRIBUTES:
            if isinstance(data, dict) and attribute.key in data:
                with suppress(InputError):
                    own |= validate(
                        RobotAttributes, {attribute.key: data[attribute.key]}
                    ).get_own_attributes(Robot)
        return ListedRobot(index=index, data=data, document=None, own=own, faults=faults)
    return ListedRobot(
        index=index, data=data, document=document, own=document.get_own_attributes(Robot)
    )


def _check_trip(document: RobotDocument, *, has_jobs: bool) -> None:
    """Refuse a robot without a trip; with jobs, one that has a trip."""
    from rightofway.io.scenario.shape import OF_TRIPS

    trip = [key for key in OF_TRIPS if key in document.given]
    if has_jobs and trip:
        remedy = f"take it out; a fixed trip is a job with robot: {document.name}"
        raise InputError(InputFault(key, f"is given beside jobs ({remedy})") for key in trip)
    if not has_jobs and not trip:
        raise InputError.at("", "has nowhere to go (give target, or stops)")


@dataclass(frozen=True, slots=True, kw_only=True)
class ListedFleet:
    """Robots of a list."""

    robots: Sequence[ListedRobot] = ()

    @property
    def traits(self) -> FleetTraits:
        """Properties of a fleet on which a map depends."""
        known = all(
            isinstance(robot.data, dict) and ("speed" in robot.own or "speed" not in robot.data)
            for robot in self.robots
        )
        speeds = [robot.own.get("speed", DEFAULT_SPEED) for robot in self.robots]
        radius = max(
            (robot.own.get("radius", Fraction(0)) for robot in self.robots), default=Fraction(0)
        )
        types = frozenset(
            robot.own.get("type") for robot in self.robots if isinstance(robot.data, dict)
        )
        return FleetTraits(speeds=speeds if known else None, radius=radius, types=types)


@dataclass(frozen=True, slots=True, kw_only=True)
class PlacedRobot:
    """A robot, its place in the document, and keys of it that stand elsewhere."""

    robot: Robot
    place: Where
    aliases: Mapping[Steps, Steps] = field(default_factory=dict)


def read_robots(data: Any, base: Path | None, *, has_jobs: bool = False) -> ListedFleet | FleetRows:
    """Return robots with their places as written, or the rows of a file that they stand on."""
    from rightofway.io.scenario.shape import FLEETS, FleetDocument

    if data in (None, [], {}):
        raise InputError.at("", f"is empty (give {FLEETS})")
    if isinstance(data, list):
        return ListedFleet(
            robots=[
                read_robot(index, robot_data, has_jobs=has_jobs)
                for index, robot_data in enumerate(data)
            ]
        )
    if not isinstance(data, dict):
        raise InputError.at("", f"{quote(data)} is no fleet (give {FLEETS})")
    if "scen" not in data:
        raise InputError.at("", f"has neither scen nor table (give {FLEETS})")
    document = validate(FleetDocument, data)
    with locate_faults("scen"):
        file = find_file_beside(base, document.scen)
        rows = load_scen(file)
    own = document.get_own_attributes(Robot)
    aliases: dict[Steps, Steps] = {
        (attribute.name,): ("robots", attribute.key)
        for attribute in ROBOT_ATTRIBUTES
        if attribute.name in own
    }
    aliases["laps",] = _place_of_laps(document, ("robots",))
    if "turn_rate" not in own:
        aliases["turn_rate",] = ("rules", "turn_rate")
    return FleetRows(
        file=file,
        rows=take_rows(rows, document.count, file),
        speeds=document.speeds or [DEFAULT_SPEED],
        works=document.work or [NO_WORK],
        own=own,
        place=("robots", "scen"),
        aliases=aliases,
    )


def take_rows(rows: Sequence[ScenRow], count: int | None, file: Path) -> Sequence[ScenRow]:
    """Return the first rows of a `.scen` file, or all."""
    if count is not None and count > len(rows):
        message = f"{count} is more than the {len(rows)} rows of {file} (give fewer)"
        raise InputError.at("count", message)
    return rows[:count]


def _place_of_laps(document: Document, place: Steps) -> Steps:
    """Return where the document asks a robot without a way back for several laps."""
    if document.get_given("laps"):
        return (*place, "laps")
    return (*place, "return") if document.get_given("ends") else ("rules", "laps")


def place_robots(
    fleet: ListedFleet | FleetRows,
    on: LoadedMap | None,
    faults: Faults,
    *,
    deals: bool,
) -> Sequence[PlacedRobot]:
    """Return the robots at their homes; where homes are dealt out, some are `HOMELESS`."""
    if isinstance(fleet, FleetRows):
        return _place_rows(fleet, on, faults) if on else ()
    placed = list[PlacedRobot]()
    for robot in fleet.robots:
        if not deals and isinstance(robot.data, dict) and "home" not in robot.data:
            message = f"is missing (give {HOME}, or homes: parking for all)"
            faults.note((*robot.place, "home"), message)
        placed_robot = faults.attempt(robot.place, _place_robot, robot, on)
        if placed_robot and (deals or placed_robot.robot.home != HOMELESS):
            placed.append(placed_robot)
    return placed


def _place_robot(robot: ListedRobot, on: LoadedMap | None) -> PlacedRobot | None:
    """Return a robot of a list at its places, or raise its faults; without a map, None."""
    from rightofway.io.scenario.shape import RobotDocument

    faults, document, place = Faults(), robot.document, robot.place
    faults.add(robot.faults)
    places = robot.find(on, faults)
    faults.stop(list_keys(RobotDocument))
    if document is None or on is None:
        return None
    trip: list[tuple[Steps, RobotDocument | StopDocument]] = []
    if document.target is not None:
        trip = [(("target",), document)]
    elif document.stops is not None:
        trip = [(("stops", k, "at"), stop) for k, stop in enumerate(document.stops)]
    stops = tuple(Stop(at=places[at], **stop.get_given("work", "actions")) for at, stop in trip)
    home = places.get(("home",), HOMELESS)
    aliases: dict[Steps, Steps] = {("laps",): _place_of_laps(document, place)}
    if "turn_rate" not in robot.own:
        aliases["turn_rate",] = ("rules", "turn_rate")
    if document.target is not None:
        aliases["stops", 0, "at"] = (*place, "target")
    charging = None
    if document.charging is not None:
        charging = tuple(places["charging", k] for k in range(len(document.charging)))
    resolved = Robot(
        name=document.name,
        home=home,
        stops=stops,
        start=read_state(document.start, places, home),
        charging=charging,
        **document.get_given("capacity", "battery"),
        **robot.own,
    )
    return PlacedRobot(robot=resolved, place=place, aliases=aliases)


def read_robot_of_jobs(data: Any, on: LoadedMap) -> Robot:
    """Return the robot of a document on a map, for a scenario with jobs.

    Raises
    ------
    InputError
        With every fault of the document.
    """
    placed = _place_robot(read_robot(0, data, has_jobs=True), on)
    assert placed is not None, "there is a map"
    return placed.robot


def _place_rows(robots: FleetRows, on: LoadedMap, faults: Faults) -> list[PlacedRobot]:
    """Return the robots on the rows of a file, or none after noting why."""
    placed = list[PlacedRobot]()
    ends = faults.attempt(robots.place, _list_starts_and_goals, robots, on) or []
    dealt = zip(ends, cycle(robots.speeds), cycle(robots.works), strict=False)
    for number, ((home, goal), speed, work) in enumerate(dealt, start=1):
        stops = (Stop(at=goal, work=work),)
        robot = Robot(name=f"R{number}", home=home, stops=stops, speed=speed, **robots.own)
        placed.append(PlacedRobot(robot=robot, place=robots.place, aliases=robots.aliases))
    return placed


def _list_starts_and_goals(robots: FleetRows, on: LoadedMap) -> list[tuple[VertexId, VertexId]]:
    faults, ends, taken = Faults(), list[tuple[VertexId, VertexId]](), dict[VertexId, int]()
    with name_file(str(robots.file)):
        for row in robots.rows:
            _check_map(row, on)  # stops at the first: the others are for the same map
        for row in robots.rows:
            begin, end = (Location(line=row.line, path=(key,)) for key in ("start", "goal"))
            start = faults.attempt(begin, on.find, row.start)
            goal = faults.attempt(end, on.find, row.goal)
            if start is None or goal is None:
                continue
            if taken.setdefault(start, row.line) != row.line:
                message = "{other} starts there already (a cell holds one robot)"
                faults.note(begin, message, Location(line=taken[start]))
            ends.append((start, goal))
        faults.stop()
    return ends


def _check_map(row: ScenRow, on: LoadedMap) -> None:
    grid, place = on.roadmap.grid, Location(line=row.line)
    if grid is None:
        raise InputError.at("", "its rows need a grid (give the map as grid, file or floor)")
    if (row.width, row.height) != (grid.columns, grid.rows):
        size = f"{row.width} x {row.height} cells, but the map has {grid.columns} x {grid.rows}"
        raise InputError.at(place, f"{size} (give the map it was made for)")
    name = re.split(r"[\\/]", row.map_name)[-1]
    if on.file is not None and name != on.file.name:
        message = f"is for {name!r}, but the map is {on.file.name!r} (give the right one)"
        raise InputError.at(place, message)
