"""Scenario documents, read: every fault at once, or a scenario that is valid by construction.

A file becomes plain data (`open_document`), the data become checked parts (`shape`), the parts a
`Scenario`. Each step notes its faults and goes on with the parts that have none.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rightofway.assign import deal_homes
from rightofway.errors import InputError, Steps, Where, find_nearest, name_file, quote
from rightofway.facts import Fact
from rightofway.io.faults import Faults, validate
from rightofway.io.formats import SCENARIO_FORMAT, check_format
from rightofway.io.movingai import ScenRow, find_beside, load_scen
from rightofway.io.scenario.crossings import note_crossings
from rightofway.io.scenario.fleet import (
    FleetRows,
    ListedFleet,
    PlacedRobot,
    place_robots,
    read_robots,
    read_robots_in_table,
    take_rows,
)
from rightofway.io.scenario.loaded_map import LoadedMap, note_on_hidden_stations, note_on_rounding
from rightofway.io.scenario.maps import map_of, map_of_file
from rightofway.io.scenario.picture import add_picture
from rightofway.io.scenario.work import ReadWork, read_jobs_in_table, read_work
from rightofway.model import PlaceActions, Rules, Scenario
from rightofway.model.actions import merge_actions
from rightofway.model.closures import Closure, find_closure_faults
from rightofway.model.units import MAX_TICKS_OF_SHORTEST
from rightofway.site import Roadmap
from rightofway.site.scale import find_odd_sizes
from rightofway.units import Units, read_start

if TYPE_CHECKING:
    from rightofway.io.tables import CellDocument

FIRST_START = Units(start=read_start("0001-01-01T00:00"))
"""Units with a start that no time of day is before."""

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
    reveal
        How many unfinished jobs are known at a time, where the file limits it: of each robot, if
        jobs are for one robot each; else of all. None for no limit.
    """

    scenario: Scenario
    notes: tuple[Fact, ...] = ()
    reveal: int | None = None


def parse_scenario(
    document: dict[str, Any], base: Path | None = None, source: str = ""
) -> Scenario:
    """Return the scenario of a document.

    Parameters
    ----------
    document
        Plain data, as a YAML or JSON file would hold. A float counts as the shortest decimal that
        represents it.
    base
        The directory that files in it are relative to; None if it may name none.
    source
        The name of the document in messages.

    Raises
    ------
    InputError
        With every independent fault, its place, value and remedy.
    """
    with name_file(source):
        return read_scenario(document, base).scenario


def read_scenario(document: Any, base: Path | None, pictures: Path | None = None) -> Loaded:
    """Return the scenario of a document with notes; the work behind `load` and `parse_scenario`.

    The picture below its map is in ``pictures``, by default in ``base``, where other files are.
    """
    from rightofway.io.scenario.shape import MapDocument, ScenarioFrame

    def loaded_map_of(data: Any) -> LoadedMap | None:
        if isinstance(data, str | list):
            raise InputError.at("", f"{quote(data)} has no key (write {_guess_map(data)})")
        drawn = validate(MapDocument, data)
        if drawn.cell_size == "adaptive":  # may take seconds: first what is quick to check
            wrong = Faults()
            place_robots(robots, None, wrong, deals=deals)
            if wrong.found:
                return None
        traits = replace(robots.traits, clearance=rules.clearance)
        loaded_map = map_of(drawn, base, units, traits)
        loaded_map = loaded_map and add_picture(loaded_map, drawn.picture, pictures or base)
        return (
            loaded_map
            if loaded_map is None or loaded_map.units.length
            else replace(loaded_map, units=units)
        )

    document = check_format(document, SCENARIO_FORMAT)
    if table := _read_table(document, base):
        key, cells = table
        with cells.locate():
            whole = read_scenario({**document, key: cells.part}, base, pictures)
        return replace(whole, notes=(*whole.notes, *cells.notes))
    faults = Faults()
    faults.attempt("", validate, ScenarioFrame, document)
    rules = faults.read_part(document, "rules", _read_rules) or Rules()
    units = _read_units_and_start(document, faults)
    read_fleet = partial(read_robots, has_jobs="jobs" in document)
    robots = faults.read_part(document, "robots", read_fleet, base) or ListedFleet()
    deals = document.get("homes") == "parking"
    loaded = faults.read_part(document, "map", loaded_map_of)
    if loaded:
        rules = replace(rules, clearance=rules.clearance + 2 * loaded.chord_error)
    if loaded and loaded.keeps_clear and rules.walls == "strict":
        remedy = "robots keep clear of what a map in pixels shows; take it out"
        faults.note(("rules", "walls"), f"'strict' is for grids and floors ({remedy})")
    placed = place_robots(robots, loaded, faults, deals=deals)
    closures = faults.read_part(document, "closures", _read_closures, loaded) or []
    actions = faults.read_part(document, "actions", _read_actions, loaded) or []
    work = read_work(document, loaded, faults)
    scenario, notes = None, list[Fact]()
    if loaded and placed and deals:
        placed = faults.attempt("", _assign_homes, placed, loaded.roadmap, rules, notes) or ()
    if loaded and placed:
        others = {"rules": rules, "units": loaded.units, "closures": tuple(closures)}
        others["actions"] = merge_actions(loaded.actions, actions)
        scenario = build_scenario(loaded.roadmap, placed, others, faults, work)
    faults.stop(document)
    assert loaded is not None, "or there was a fault"
    assert scenario is not None, "or there was a fault"
    return Loaded(scenario=scenario, notes=(*list_notes(loaded, scenario), *notes))


def _read_table(document: dict[str, Any], base: Path | None) -> tuple[str, CellDocument] | None:
    """Return the key of robots or jobs that are in a table, and the table; None without one."""
    robots, jobs = document.get("robots"), document.get("jobs")
    if isinstance(robots, dict) and "table" in robots:
        return "robots", read_robots_in_table(robots, base)
    if isinstance(jobs, dict) and "table" in jobs:
        return "jobs", read_jobs_in_table(jobs, base, _read_units_and_start(document, Faults()))
    return None


def _read_units_and_start(document: dict[str, Any], faults: Faults) -> Units:
    """Return the units of a document; if the start has faults, times of day have none."""
    units = faults.read_part(document, "units", _read_units) or Units()
    if "start" not in document:
        return units
    return faults.read_part(document, "start", _read_start, units) or FIRST_START


def read_classic(path: Path, count: int | None) -> Loaded:
    """Return the classic scenario of the first rows of a `.scen` file, or of all.

    No document stands between the file and the scenario, so that none of its libraries is needed.
    """
    rows = load_scen(path)
    with name_file(str(path)):
        if count is not None and count < 1:
            message = f"{quote(count)} does not fit (give the number of its rows to use, 1 or more)"
            raise InputError.at("count", message)
        fleet = FleetRows(file=path, rows=take_rows(rows, count, path))
        file = _find_map_beside(path, rows[0])
    loaded, faults = map_of_file(file), Faults()
    placed = place_robots(fleet, loaded, faults, deals=False)
    faults.stop()
    others = {"rules": CLASSIC, "units": loaded.units, "closures": ()}
    scenario = build_scenario(loaded.roadmap, placed, others, faults, ReadWork())
    faults.stop()
    assert scenario is not None, "or there was a fault"
    return Loaded(scenario=scenario, notes=tuple(list_notes(loaded, scenario)))


def _find_map_beside(path: Path, row: ScenRow) -> Path:
    """Return the map of a `.scen` file, which is beside it or in ``../maps``."""
    file = find_beside(path, row.map_name, "maps")
    if file is None:
        message = (
            f"its map {quote(row.map_name)} is neither beside it nor in ../maps (put it there)"
        )
        raise InputError.at("", message)
    return file


def _guess_map(data: str | list[Any]) -> str:
    """Return how a map is written that a document gives without saying of which kind it is."""
    if isinstance(data, list) or "\n" in data:
        return "map: {grid: …}"
    key = "file" if data.lower().endswith(".map") else "layout"
    return f"map: {{{key}: {quote(data)}}}"


def _read_rules(data: Any) -> Rules:
    from rightofway.io.scenario.shape import RulesDocument

    if data == "classic":
        return CLASSIC
    if isinstance(data, str):
        remedy = "give classic, or a mapping like {headway: 1}"
        raise InputError.at("", f"{quote(data)} is no name of rules ({remedy})")
    document = validate(RulesDocument, data)
    own = document.get_own_attributes(Rules) | document.get_given("objective", "late", "patience")
    return Rules(**own)


def _read_units(data: Any) -> Units:
    from rightofway.io.scenario.shape import UnitsDocument

    return Units(**validate(UnitsDocument, data).get_given("length", "time"))


def _read_start(data: Any, units: Units) -> Units:
    """Return the units with the instant of time 0."""
    try:
        return replace(units, start=data)
    except InputError as error:
        raise InputError.at("", error.faults[0].words) from None


def _read_closures(data: Any, on: LoadedMap | None) -> list[Closure]:
    """Return the closures, or raise all their faults; without a map, none."""
    from rightofway.io.scenario.shape import ClosureDocument

    if not isinstance(data, list):
        remedy = "give a list of {at or edge, from, until, radius}"
        raise InputError.at("", f"{quote(data)} is no list of closures ({remedy})")
    faults, closures = Faults(), list[Closure]()
    for index, closure_data in enumerate(data):
        document = faults.attempt(index, validate, ClosureDocument, closure_data, on)
        if document is None or on is None:
            continue
        closure = Closure(
            at=document.at,
            edge=None if document.edge is None else (document.edge[0], document.edge[1]),
            **document.get_given("from_", "until", "radius"),
        )
        for fault in find_closure_faults(closure, on.roadmap):
            faults.add([fault.nest(index)])
        closures.append(closure)
    faults.stop()
    return closures


def _read_actions(data: Any, on: LoadedMap | None) -> list[PlaceActions]:
    """Return the actions of places, or raise all their faults; without a map, none."""
    from rightofway.io.scenario.shape import PlaceActionsDocument

    if not isinstance(data, dict):
        remedy = "give for each place its name and {work, pick, drop}"
        raise InputError.at("", f"{quote(data)} is no mapping of places to actions ({remedy})")
    faults, actions = Faults(), list[PlaceActions]()
    for place, own in data.items():
        document = faults.attempt(place, validate, PlaceActionsDocument, own)
        vertex = faults.attempt(place, on.find, place) if on else None
        if document is None or vertex is None:
            continue
        if any(vertex == other.at for other in actions):
            message = "is another name of a place that has actions already (give them once)"
            faults.note(place, message)
            continue
        actions.append(PlaceActions(at=vertex, **document.get_given("work", "pick", "drop")))
    faults.stop()
    return actions


def _assign_homes(
    placed: Sequence[PlacedRobot], roadmap: Roadmap, rules: Rules, notes: list[Fact]
) -> Sequence[PlacedRobot]:
    """Return the robots, each with a home; add a note on the homes that were dealt out."""
    robots, more = deal_homes([robot.robot for robot in placed], roadmap, rules)
    notes += more
    return [
        replace(placed_robot, robot=robot)
        for placed_robot, robot in zip(placed, robots, strict=True)
    ]


def build_scenario(
    roadmap: Roadmap,
    placed: Sequence[PlacedRobot],
    others: dict[str, Any],
    faults: Faults,
    work: ReadWork,
) -> Scenario | None:
    """Return the scenario, or None after noting the faults that the model finds."""
    robots = tuple(placed_robot.robot for placed_robot in placed)
    try:
        return Scenario(
            roadmap=roadmap,
            robots=robots,
            jobs=work.jobs,
            batteries=work.batteries,
            charging=work.charging,
            **others,
        )
    except InputError as error:
        starts = dict[Steps, Where](work.starts)
        for index, placed_robot in enumerate(placed):  # the model numbers robots without faults
            starts["robots", index] = placed_robot.place
            starts |= {
                ("robots", index, *steps): place for steps, place in placed_robot.aliases.items()
            }
        wrong = [fault.relocate(starts) for fault in error.faults]
        faults.add(work.drop_followers(wrong) if faults.found else wrong)
        return None


def list_notes(loaded: LoadedMap, scenario: Scenario) -> Iterator[Fact]:
    """Yield notes on a scenario that was read on a map."""
    grid = loaded.roadmap.grid
    if loaded.floor and grid:
        yield Fact(
            "floor cut into cells",
            about=scenario,
            columns=grid.columns,
            rows=grid.rows,
            cells=grid.columns * grid.rows,
            size=grid.cell_size,
        )
    spaces = 0 if loaded.floor else sum(line.count(" ") for line in loaded.lines)
    if spaces:
        yield Fact("spaces blocked", spaces=spaces)
    yield from loaded.notes
    if loaded.rounding:
        yield note_on_rounding(*loaded.rounding, scenario.units)
    yield from note_on_hidden_stations(scenario.roadmap)
    yield from _list_type_notes(scenario)
    yield from note_crossings(scenario)
    largest = max(robot.radius for robot in scenario.robots)
    for fact, remedy in find_odd_sizes(scenario, largest):
        yield Fact("fact and remedy", scenario, fact=fact, remedy=remedy)
    if not scenario.problem.clock.exact:
        yield Fact("times rounded up", about=scenario, tick=1, parts=MAX_TICKS_OF_SHORTEST)


def _list_type_notes(scenario: Scenario) -> Iterator[Fact]:
    """Yield a note on each type of robots that nothing is barred for, where one was nearly meant.

    Types that edges and vertices are barred for are known; any other type is allowed.
    """
    known = scenario.roadmap.types
    for name in dict.fromkeys(robot.type for robot in scenario.robots):
        near = None if name is None or name in known else find_nearest(name, sorted(known))
        if near:
            yield Fact("type not barred", type=quote(name), other=repr(near))
