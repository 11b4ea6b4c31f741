"""Scenario documents, read: every fault at once, or a scenario that is valid by construction.

A file becomes plain data (`read_document`), the data become checked parts (`shape`), the parts a
`Scenario`. Each step notes its faults and goes on with the parts that have none.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import cycle
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rightofway.errors import InputError, InputFault
from rightofway.io.faults import Faults, blaming, checked, shown, under
from rightofway.io.formats import SCENARIO_FORMAT, checked_format
from rightofway.io.movingai import ScenRow, load_scen
from rightofway.io.scenario.maps import LoadedMap, file_beside, map_of
from rightofway.io.scenario.places import Place, as_place, find_place
from rightofway.io.text import read_document
from rightofway.model import Roadmap, Robot, Rules, Scenario, Stop
from rightofway.model.units import MAX_TICKS_OF_SHORTEST

if TYPE_CHECKING:
    from rightofway.io.scenario.shape import FleetDocument, TripDocument

__all__ = ["MAX_STAGES", "Loaded", "load", "load_with_notes", "read_scenario", "scenario_of"]

MAX_STAGES = 1_000_000
"""Stops and ways home of a whole fleet, laps unrolled, at most."""

MAX_TICKS = 2**40
"""Longest duration of a scenario [ticks]; routes of any length then stay within 64 bits."""

DEFAULT_SPEED = Fraction(1)


@dataclass(frozen=True, slots=True, kw_only=True)
class Loaded:
    """A scenario, and notes of its reader.

    Attributes
    ----------
    scenario
        The scenario.
    notes
        Sentences for the user: how a floor was cut into cells, whether durations are rounded.
    """

    scenario: Scenario
    notes: tuple[str, ...] = ()


def load(path: Path | str) -> Scenario:
    """Return the scenario of a file.

    Parameters
    ----------
    path
        A scenario as YAML or JSON; or a `.scen` file, which is classic MAPF: unit speeds, no work,
        no turning, no way back, the map beside it or in ``../maps``.

    Raises
    ------
    InputError
        With every independent fault, its place, value and remedy.
    """
    return load_with_notes(path).scenario


def load_with_notes(path: Path | str) -> Loaded:
    """Return the scenario of a file with the notes of its reader; otherwise as `load`."""
    path = Path(path)
    with blaming(str(path)):
        if path.suffix.lower() == ".scen":
            return _classic(path)
        return read_scenario(read_document(path), path.parent)


def scenario_of(document: dict[str, Any], base: Path | None = None, source: str = "") -> Scenario:
    """Return the scenario of a document.

    Parameters
    ----------
    document
        Plain data, as a YAML or JSON file would hold. A float counts as the shortest decimal that
        stands for it.
    base
        The directory that files in it are relative to; None if it may name none.
    source
        The name of the document in messages.

    Raises
    ------
    InputError
        With every independent fault, its place, value and remedy.
    """
    with blaming(source):
        return read_scenario(document, base).scenario


def read_scenario(document: Any, base: Path | None) -> Loaded:
    """Return the scenario of a document with notes; the work behind `load` and `scenario_of`."""
    from rightofway.io.scenario.shape import MapDocument, RulesDocument, ScenarioFrame

    def rules_of(data: Any) -> Rules:
        given = checked(RulesDocument, data).given
        return Rules(**given("occupancy", "headway", "turn", "ends", "laps", "rotations"))

    def loaded_map_of(data: Any) -> LoadedMap | None:
        return map_of(checked(MapDocument, data), speeds, base)

    document = checked_format(document, SCENARIO_FORMAT)
    faults = Faults()
    faults.attempt("", checked, ScenarioFrame, document)
    rules = faults.part(document, "rules", rules_of) or Rules()
    entries = faults.part(document, "robots", _entries, base, faults) or []
    known = [entry.speed for entry in entries if entry.speed is not None]
    speeds = known if len(known) == len(entries) else None
    loaded = faults.part(document, "map", loaded_map_of)
    placed = _placed(entries, loaded, faults) if loaded else []
    scenario = _assembled(loaded.roadmap, placed, rules, faults) if loaded and placed else None
    faults.stop(document)
    assert loaded is not None, "or there was a fault"
    assert scenario is not None, "or there was a fault"
    return Loaded(scenario=scenario, notes=tuple(_notes(loaded, scenario)))


def _classic(path: Path) -> Loaded:
    """Return the scenario of all rows of a `.scen` file."""
    map_name = re.split(r"[\\/]", load_scen(path)[0].map_name)[-1]
    beside = [Path(map_name), Path("..", "maps", map_name)]
    found = next((each for each in beside if (path.parent / each).is_file()), None)
    if found is None:
        message = f"its map {map_name!r} is neither beside it nor in ../maps (put it there)"
        raise InputError.at("", message)
    document = {
        "format": SCENARIO_FORMAT,
        "map": {"file": str(found)},
        "robots": {"scen": path.name},
        "rules": {"turn": 0, "return": "none"},
    }
    try:
        return read_scenario(document, path.parent)
    except InputError as error:  # places in the document mean nothing to the user of the file
        raise InputError(
            InputFault("", fault.message.removeprefix(f"{path}: "))
            if fault.place == "robots.scen"
            else fault
            for fault in error.faults
        ) from None


@dataclass(frozen=True, slots=True, kw_only=True)
class _Entry:
    """A robot of a document, its places not yet found on the map."""

    place: str  # of the robot in the document: robots[3]
    places: Sequence[tuple[str, Place]]  # home and stops: the key and the place as written
    name: str = ""
    works: Sequence[Fraction] = ()  # work time at each stop [time unit]
    own: Mapping[str, Any] = field(default_factory=dict)  # rules of its own
    speed: Fraction | None = None  # None for a robot with faults, of which only places are read
    aliases: Mapping[str, str] = field(default_factory=dict)  # keys that stand elsewhere
    row: ScenRow | None = None  # of the .scen file that the robot is from
    file: Path | None = None


def _entries(data: Any, base: Path | None, faults: Faults) -> list[_Entry]:
    from rightofway.io.scenario.shape import FleetDocument

    if isinstance(data, dict):
        return _entries_of_rows(checked(FleetDocument, data), base)
    if not isinstance(data, list) or not data:
        message = f"{shown(data)} is no fleet (give a list of robots, or {{scen: a file}})"
        raise InputError.at("", message)
    return [_entry(f"robots[{index}]", robot, faults) for index, robot in enumerate(data)]


def _entry(place: str, data: Any, faults: Faults) -> _Entry:
    from rightofway.io.scenario.shape import RobotDocument

    document = faults.attempt(place, checked, RobotDocument, data)
    if document is None:
        return _Entry(place=place, places=list(_readable_places(data)))
    if document.stops is None:
        stops = [("target", document.target, document.work)]
    else:
        stops = [(f"stops[{i}].at", stop.at, stop.work) for i, stop in enumerate(document.stops)]
    return _Entry(
        place=place,
        places=[("home", document.home), *((key, at) for key, at, _ in stops)],
        name=document.name,
        works=[work or Fraction(0) for _, _, work in stops],
        own=document.given("turn", "ends", "laps"),
        speed=document.speed or DEFAULT_SPEED,
        aliases={"laps": _place_of_laps(document, place)},
    )


def _readable_places(data: Any) -> Iterator[tuple[str, Place]]:
    """Yield the places of a robot with faults, so that all its faults are reported at once."""
    robot = data if isinstance(data, dict) else {}
    stops = robot.get("stops")
    written = [("home", robot.get("home")), ("target", robot.get("target"))]
    for index, stop in enumerate(stops if isinstance(stops, list) else ()):
        written.append((f"stops[{index}].at", stop.get("at") if isinstance(stop, dict) else None))
    yield from ((key, place) for key, value in written if (place := as_place(value)) is not None)


def _place_of_laps(document: TripDocument, place: str) -> str:
    """Return where the document asks a robot without a way back for several laps."""
    if document.laps is not None:
        return f"{place}.laps"
    return "rules.laps" if document.ends is None else f"{place}.return"


def _entries_of_rows(document: FleetDocument, base: Path | None) -> list[_Entry]:
    """Return robots R1, R2, ... on the rows of a `.scen` file, speeds and work dealt in turn."""
    with under("scen"):
        file = file_beside(base, document.scen)
        rows = load_scen(file)
    if document.count is not None and document.count > len(rows):
        message = f"{document.count} is more than the {len(rows)} rows of {file} (give fewer)"
        raise InputError.at("count", message)
    speeds, works = cycle(document.speeds or [DEFAULT_SPEED]), cycle(document.work or [Fraction(0)])
    aliases = {"turn": "robots.turn", "laps": _place_of_laps(document, "robots")}
    return [
        _Entry(
            place="robots.scen",
            places=[(f"line {row.line}, start", row.start), (f"line {row.line}, goal", row.goal)],
            name=f"R{number}",
            works=[work],
            own=document.given("turn", "ends", "laps"),
            speed=speed,
            aliases=aliases,
            row=row,
            file=file,
        )
        for number, (row, speed, work) in enumerate(
            zip(rows[: document.count], speeds, works, strict=False), start=1
        )
    ]


def _placed(entries: Sequence[_Entry], on: LoadedMap, faults: Faults) -> list[tuple[_Entry, Robot]]:
    """Return the robots that can be placed on a map; note why others cannot."""
    placed: list[tuple[_Entry, Robot]] = []
    lines: dict[tuple[int, int], int] = {}  # of rows, by start
    for entry in entries:
        if entry.row and not faults.attempt(entry.place, _fits, entry.row, entry.file, on):
            return []  # further rows are for the same map
        robot = faults.attempt(entry.place, _robot, entry, on, lines)
        if robot:
            placed.append((entry, robot))
    return placed


def _fits(row: ScenRow, file: Path | None, on: LoadedMap) -> bool:
    """Return True for a row made for this map; InputError for others."""
    grid, place, source = on.roadmap.grid, f"line {row.line}", str(file)
    if grid is None:
        message = "its rows need a grid (give the map as grid, file or floor)"
        raise InputError.at("", message, source)
    if (row.width, row.height) != (grid.columns, grid.rows):
        size = f"{row.width} x {row.height} cells, but the map has {grid.columns} x {grid.rows}"
        raise InputError.at(place, f"{size} (give the map it was made for)", source)
    name = re.split(r"[\\/]", row.map_name)[-1]
    if on.file is not None and name != on.file.name:
        message = f"is for {name!r}, but the map is {on.file.name!r} (give the right one)"
        raise InputError.at(place, message, source)
    return True


def _robot(entry: _Entry, on: LoadedMap, lines: dict[tuple[int, int], int]) -> Robot | None:
    """Return a robot at the vertices of its places; None if it has faults elsewhere."""
    faults = Faults()
    with blaming(str(entry.file or "")):
        found = [faults.attempt(key, find_place, place, on) for key, place in entry.places]
        row = entry.row
        if row and None not in found and lines.setdefault(row.start, row.line) != row.line:
            message = f"line {lines[row.start]} starts there already (a cell holds one robot)"
            faults.note(f"line {row.line}, start", message)
        faults.stop()
    if entry.speed is None:
        return None
    home, *targets = (vertex for vertex in found if vertex is not None)
    stops = tuple(Stop(at=at, work=work) for at, work in zip(targets, entry.works, strict=True))
    return Robot(name=entry.name, home=home, stops=stops, speed=entry.speed, **entry.own)


def _assembled(
    roadmap: Roadmap, placed: Sequence[tuple[_Entry, Robot]], rules: Rules, faults: Faults
) -> Scenario | None:
    """Return the scenario, or None after noting the faults that the model finds."""
    robots = tuple(robot for _, robot in placed)
    stages = sum((len(robot.stops) + 1) * (robot.laps or rules.laps) for robot in robots)
    try:
        if stages > MAX_STAGES:
            message = f"{stages} stops and ways home in all laps, more than {MAX_STAGES}"
            raise InputError.at("robots", f"{message} (give fewer laps)")
        scenario = Scenario(roadmap=roadmap, robots=robots, rules=rules)
        _check_ticks(scenario)
    except InputError as error:
        entries = [entry for entry, _ in placed]
        for fault in error.faults:
            faults.note(*_in_document(fault, entries))
        return None
    return scenario


def _check_ticks(scenario: Scenario) -> None:
    problem = scenario.problem
    longest = max(
        problem.headway,
        *(max(itinerary.edge_ticks, default=0) for itinerary in problem.itineraries),
        *(stage.work + stage.turn for it in problem.itineraries for stage in it.stages),
    )
    if longest > MAX_TICKS:
        ticks = f"{shown(longest)} ticks of {shown(problem.clock.tick)}"
        message = f"a duration of {ticks} is too long (bring speeds and times closer together)"
        raise InputError.at("robots", message)


def _in_document(fault: InputFault, entries: Sequence[_Entry]) -> tuple[str, str]:
    """Return place and message of a fault of the model as the document has them.

    The model numbers the robots that it was given, among which those with faults are missing.
    """
    found = re.fullmatch(r"robots\[(\d+)\]\.(.*)", fault.place)
    if not found:
        return fault.place, fault.message
    entry, key, message = entries[int(found[1])], found[2], fault.message
    other = re.match(r"(.*) of robots\[(\d+)\] already", message)
    if other:
        message = f"{other[1]} of {entries[int(other[2])].place} already{message[other.end() :]}"
    return entry.aliases.get(key, f"{entry.place}.{key}"), message


def _notes(loaded: LoadedMap, scenario: Scenario) -> Iterator[str]:
    grid = loaded.roadmap.grid
    if loaded.floor and grid:
        cells = f"{grid.columns} x {grid.rows} = {grid.columns * grid.rows}"
        yield f"floor cut into {cells} cells of {grid.cell_size}"
    if not scenario.problem.clock.exact:
        yield (
            f"durations are rounded up to 1/{MAX_TICKS_OF_SHORTEST} of the shortest;"
            " give speeds with smaller denominators to be exact"
        )
