"""Scenario documents, read: every fault at once, or a scenario that is valid by construction.

A file becomes plain data (`document_of`), the data become checked parts (`shape`), the parts a
`Scenario`. Each step notes its faults and goes on with the parts that have none.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import cycle
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rightofway.errors import InputError, InputFault, shown
from rightofway.io.faults import Faults, blaming, checked, under
from rightofway.io.formats import SCENARIO_FORMAT, checked_format
from rightofway.io.movingai import ScenRow, load_scen
from rightofway.io.robot_table import Located, robots_of_csv
from rightofway.io.scenario.crossings import crossing_note
from rightofway.io.scenario.homes import HOMELESS, housed
from rightofway.io.scenario.loaded_map import LoadedMap
from rightofway.io.scenario.maps import file_beside, map_of
from rightofway.model import Roadmap, Robot, Rules, Scenario, Stop, Units, VertexId
from rightofway.model.closures import Closure, closure_faults
from rightofway.model.places import kinds_of_places
from rightofway.model.units import MAX_TICKS_OF_SHORTEST

if TYPE_CHECKING:
    from rightofway.io.scenario.shape import FleetDocument, TripDocument

MAX_STAGES = 1_000_000
"""Stops and ways home of a whole fleet, laps unrolled, at most."""

MAX_TICKS = 2**40
"""Longest duration of a scenario [ticks]; routes of any length then stay within 64 bits."""

DEFAULT_SPEED = Fraction(1)

HOME = f"the place it starts from: {kinds_of_places(None)}"

CLASSIC = Rules(turn=Fraction(0), ends="none")
"""The rules of the classic benchmark: robots need not turn, and stay at their targets."""


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
    from rightofway.io.scenario.shape import (
        MapDocument,
        RulesDocument,
        ScenarioFrame,
        UnitsDocument,
    )

    def rules_of(data: Any) -> Rules:
        if data == "classic":
            return CLASSIC
        if isinstance(data, str):
            remedy = "give classic, or a mapping like {headway: 1}"
            raise InputError.at("", f"{shown(data)} is no name of rules ({remedy})")
        given = checked(RulesDocument, data).given
        keys = ("occupancy", "headway", "turn", "ends", "laps", "rotations", "clearance")
        return Rules(**given(*keys, "turn_rate"))

    def units_of(data: Any) -> Units:
        return Units(**checked(UnitsDocument, data).given("length", "time"))

    def loaded_map_of(data: Any) -> LoadedMap | None:
        found = map_of(
            checked(MapDocument, data),
            speeds,
            base,
            units,
            lambda: _largest_radius(robots),
            types=lambda: _types(robots),
        )
        return found if found is None or found.units.length else replace(found, units=units)

    document = checked_format(document, SCENARIO_FORMAT)
    given = document.get("robots")
    if isinstance(given, dict) and "table" in given:
        table = _robots_in_table(given, base)
        with table.naming_cells():
            return read_scenario({**document, "robots": table.part}, base)
    faults = Faults()
    faults.attempt("", checked, ScenarioFrame, document)
    rules = faults.part(document, "rules", rules_of) or Rules()
    units = faults.part(document, "units", units_of) or Units()
    robots = faults.part(document, "robots", _written_robots, base) or []
    speeds = _speeds(robots)
    loaded = faults.part(document, "map", loaded_map_of)
    if loaded:
        rules = replace(rules, clearance=rules.clearance + 2 * loaded.chord_error)
    deals = document.get("homes") == "parking"
    placed, more = _fleet(robots, loaded, rules, faults, deals=deals)
    closures = faults.part(document, "closures", _closures, loaded) or []
    scenario = None
    if loaded and placed:
        others = {"rules": rules, "units": loaded.units, "closures": tuple(closures)}
        scenario = _assembled(loaded.roadmap, placed, others, faults)
    faults.stop(document)
    assert loaded is not None, "or there was a fault"
    assert scenario is not None, "or there was a fault"
    return Loaded(scenario=scenario, notes=(*_notes(loaded, scenario), *more))


def _robots_in_table(data: dict[str, Any], base: Path | None) -> Located:
    """Return the robots of a CSV file that the document names."""
    from rightofway.io.scenario.shape import RobotDocument, RobotTableDocument

    with under("robots"):
        name = checked(RobotTableDocument, data).table
        with under("table"):
            known = [field.alias or key for key, field in RobotDocument.model_fields.items()]
            return robots_of_csv(file_beside(base, name), known)


@dataclass(frozen=True, slots=True, kw_only=True)
class _Rows:
    """Robots R1, R2, ... on the rows of a `.scen` file, speeds and work dealt out in turn."""

    document: FleetDocument
    file: Path
    rows: Sequence[ScenRow]


@dataclass(frozen=True, slots=True, kw_only=True)
class _Placed:
    """A robot, its place in the document, and keys of it that stand elsewhere."""

    robot: Robot
    place: str
    aliases: Mapping[str, str]


def _written_robots(data: Any, base: Path | None) -> Sequence[Any] | _Rows:
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
    return _Rows(document=document, file=file, rows=rows[: document.count])


def _speeds(robots: Sequence[Any] | _Rows) -> list[Fraction] | None:
    """Return the speeds of all robots, or None if some cannot be read."""
    from rightofway.io.fields import positive

    if isinstance(robots, _Rows):
        return (robots.document.speeds or [DEFAULT_SPEED])[: len(robots.rows)]
    try:
        return [positive(robot.get("speed", DEFAULT_SPEED)) for robot in robots]
    except (AttributeError, ValueError):
        return None


def _largest_radius(robots: Sequence[Any] | _Rows) -> Fraction:
    """Return the largest radius of the fleet; a radius that cannot be read is a fault elsewhere."""
    from rightofway.io.scenario.shape import RobotDocument

    if isinstance(robots, _Rows):
        return robots.document.radius or Fraction(0)
    found = Fraction(0)
    for robot in robots:
        try:
            space = checked(RobotDocument, robot).space()
        except InputError:
            continue
        found = max(found, space.get("radius", Fraction(0)))
    return found


def _types(robots: Sequence[Any] | _Rows) -> frozenset[str | None]:
    """Return the types of the fleet; None stands for a robot without one."""
    if isinstance(robots, _Rows):
        return frozenset([None])
    found = (robot.get("type") for robot in robots if isinstance(robot, dict))
    return frozenset(name if isinstance(name, str) else None for name in found)


def _place_of_laps(document: TripDocument, place: str) -> str:
    """Return where the document asks a robot without a way back for several laps."""
    if document.laps is not None:
        return f"{place}.laps"
    return "rules.laps" if document.ends is None else f"{place}.return"


def _fleet(
    robots: Sequence[Any] | _Rows,
    on: LoadedMap | None,
    rules: Rules,
    faults: Faults,
    *,
    deals: bool,
) -> tuple[Sequence[_Placed], Sequence[str]]:
    """Return the robots at their homes, and notes on homes that were dealt out."""
    if isinstance(robots, _Rows):
        return (_dealt(robots, on, faults) if on else ()), ()
    placed = _listed(robots, on, faults, deals=deals)
    return _housed(placed, on, rules, faults) if deals and on and placed else (placed, ())


def _listed(
    robots: Sequence[Any], on: LoadedMap | None, faults: Faults, *, deals: bool
) -> list[_Placed]:
    """Return robots that are listed; note the faults of others. Without a map, only note faults."""
    from rightofway.io.scenario.shape import RobotDocument

    placed = list[_Placed]()
    for index, data in enumerate(robots):
        place = f"robots[{index}]"
        if not deals and isinstance(data, dict) and "home" not in data:
            faults.note(f"{place}.home", f"is missing (give {HOME}, or homes: parking for all)")
        document = faults.attempt(place, checked, RobotDocument, data, on)
        if document is None or on is None or (document.home is None and not deals):
            continue
        keys = ("speed", "turn", "ends", "laps", "type", "turn_rate")
        own = {**document.given(*keys), **document.space()}
        stops = tuple(Stop(at=at, work=work or Fraction(0)) for at, work in document.trip())
        home = HOMELESS if document.home is None else document.home
        robot = Robot(name=document.name, home=home, stops=stops, **own)
        aliases = {"laps": _place_of_laps(document, place)}
        if document.turn_rate is None:
            aliases["turn_rate"] = "rules.turn_rate"
        if document.target is not None:
            aliases["stops[0].at"] = f"{place}.target"
        placed.append(_Placed(robot=robot, place=place, aliases=aliases))
    return placed


def _housed(
    placed: Sequence[_Placed], on: LoadedMap, rules: Rules, faults: Faults
) -> tuple[Sequence[_Placed], Sequence[str]]:
    """Return the robots, those without a home at parking places, and a note of who starts where."""
    found = faults.attempt("", housed, [it.robot for it in placed], on.roadmap, rules)
    if found is None:
        return (), ()
    robots, notes = found
    return [replace(it, robot=robot) for it, robot in zip(placed, robots, strict=True)], notes


def _dealt(robots: _Rows, on: LoadedMap, faults: Faults) -> list[_Placed]:
    """Return the robots on the rows of a file, or none after noting why."""
    document, placed = robots.document, list[_Placed]()
    ends = faults.attempt("robots.scen", _starts_and_goals, robots, on) or []
    speeds, works = cycle(document.speeds or [DEFAULT_SPEED]), cycle(document.work or [Fraction(0)])
    own = document.given("turn", "ends", "laps", "radius", "turn_rate")
    rate = "rules.turn_rate" if document.turn_rate is None else "robots.turn_rate"
    laps = _place_of_laps(document, "robots")
    aliases = {"turn": "robots.turn", "laps": laps, "turn_rate": rate}
    dealt = zip(ends, speeds, works, strict=False)
    for number, ((home, goal), speed, work) in enumerate(dealt, start=1):
        stops = (Stop(at=goal, work=work),)
        robot = Robot(name=f"R{number}", home=home, stops=stops, speed=speed, **own)
        placed.append(_Placed(robot=robot, place="robots.scen", aliases=aliases))
    return placed


def _starts_and_goals(robots: _Rows, on: LoadedMap) -> list[tuple[VertexId, VertexId]]:
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


def _closures(data: Any, on: LoadedMap | None) -> list[Closure]:
    """Return the closures, or raise all their faults; without a map, none."""
    from rightofway.io.scenario.shape import ClosureDocument

    if not isinstance(data, list):
        remedy = "give a list of {at or edge, from, until, radius}"
        raise InputError.at("", f"{shown(data)} is no list of closures ({remedy})")
    faults, found = Faults(), list[Closure]()
    for index, each in enumerate(data):
        document = faults.attempt(f"[{index}]", checked, ClosureDocument, each, on)
        if document is None or on is None:
            continue
        closure = Closure(
            at=document.at,
            edge=None if document.edge is None else (document.edge[0], document.edge[1]),
            **document.given("from_", "until", "radius"),
        )
        for fault in closure_faults(closure, on.roadmap):
            faults.note(f"[{index}].{fault.place}".rstrip("."), fault.message)
        found.append(closure)
    faults.stop()
    return found


def _assembled(
    roadmap: Roadmap, placed: Sequence[_Placed], others: dict[str, Any], faults: Faults
) -> Scenario | None:
    """Return the scenario, or None after noting the faults that the model finds."""
    robots = tuple(each.robot for each in placed)
    laps = others["rules"].laps
    stages = sum((len(robot.stops) + 1) * (robot.laps or laps) for robot in robots)
    try:
        if stages > MAX_STAGES:
            message = f"{stages} stops and ways home in all laps, more than {MAX_STAGES}"
            raise InputError.at("robots", f"{message} (give fewer laps)")
        scenario = Scenario(roadmap=roadmap, robots=robots, **others)
        _check_ticks(scenario)
    except InputError as error:
        for fault in error.faults:
            faults.note(*_in_document(fault, placed))
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


def _in_document(fault: InputFault, placed: Sequence[_Placed]) -> tuple[str, str]:
    """Return place and message of a fault of the model as the document has them.

    The model numbers the robots that it was given, among which those with faults are missing.
    """
    found = re.fullmatch(r"robots\[(\d+)\]\.(.*)", fault.place)
    if not found:
        return fault.place, fault.message
    it, key, message = placed[int(found[1])], found[2], fault.message
    other = re.match(r"(.*) of robots\[(\d+)\] already", message)
    if other:
        message = f"{other[1]} of {placed[int(other[2])].place} already{message[other.end() :]}"
    return it.aliases.get(key, f"{it.place}.{key}"), message


def _notes(loaded: LoadedMap, scenario: Scenario) -> Iterator[str]:
    grid = loaded.roadmap.grid
    if loaded.floor and grid:
        cells = f"{grid.columns} x {grid.rows} = {grid.columns * grid.rows}"
        yield f"floor cut into {cells} cells of {scenario.quantities.length(grid.cell_size)}"
    spaces = 0 if loaded.floor else sum(line.count(" ") for line in loaded.lines)
    if spaces:
        count = "1 space counts" if spaces == 1 else f"{spaces} spaces count"
        yield f"{count} as blocked in the grid (write . for a free cell)"
    yield from loaded.notes
    if loaded.rounding:
        unit = scenario.units.length
        yield f"{loaded.rounding} {unit}" if unit else loaded.rounding
    yield from crossing_note(scenario)
    if not scenario.problem.clock.exact:
        yield (
            f"each drive, turn and work time is rounded up to a multiple of"
            f" {scenario.quantities.duration(1)} (the shortest of them, divided by"
            f" {MAX_TICKS_OF_SHORTEST}); simpler speeds and lengths stay exact,"
            " for example 1/3 instead of 0.3333"
        )
