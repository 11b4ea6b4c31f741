"""Input of `rightofway inspect`: layouts with all their levels, maps and scenarios, as sites."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import Any

from rightofway.errors import InputError, name_file
from rightofway.facts import Fact, note_pieces
from rightofway.io.content import read_text
from rightofway.io.faults import validate
from rightofway.io.formats import SCENARIO_FORMAT
from rightofway.io.layouts import describe_layout, is_layout, read_layout
from rightofway.io.locations import open_document
from rightofway.io.readers import load_with_notes
from rightofway.io.scenario.loaded_map import note_on_hidden_stations
from rightofway.io.scenario.maps import map_of
from rightofway.io.scenario.reader import read_scenario
from rightofway.metrics import Site
from rightofway.model import Scenario
from rightofway.site.layout import Layout, Level, build_roadmap_of_level
from rightofway.units import Units

METRES = Units(length="m", time="s")


@dataclass(frozen=True, slots=True, kw_only=True)
class Sites:
    """The sites of a file.

    Attributes
    ----------
    description
        Kind and size of the file; empty for a map whose robots have faults.
    notes
        Pieces that its reader mended or left out, and warnings.
    sites
        The name of each level, empty where there is only one, and the site.
    """

    description: Fact | str
    notes: tuple[Fact, ...]
    sites: tuple[tuple[str, Site], ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Choice:
    """Which part of a layout is wanted: keys of a scenario's map; None for the usual one."""

    level: str | None = None
    vehicle_type: str | None = None
    cell_size: Fraction | None = None

    def list_keys(self) -> dict[str, Any]:
        """Return the keys that are given."""
        level_of = {
            "level": self.level,
            "vehicle_type": self.vehicle_type,
            "cell_size": self.cell_size,
        }
        return {key: value for key, value in level_of.items() if value is not None}


def read_sites(
    path: Path | str,
    choice: Choice,
    robots: Path | str | None = None,
    jobs: Path | str | None = None,
) -> Sites:
    """Return the sites of a layout, a map or a scenario, with the jobs of a file if one is given.

    Raises
    ------
    InputError
        With every fault, its place, value and remedy.
    """
    path = Path(path)
    if str(path) == "-" or not is_layout(path):
        if given := choice.list_keys():
            message = f"{next(iter(given))} is for layouts, and this is none (leave it out)"
            raise InputError.at("", message, str(path))
        return _read_scenario_site(path, robots, jobs)
    layout = read_layout(path)
    if robots is None and jobs is not None:
        raise InputError.at("jobs", "has no robots to do them (give --robots, too)", str(path))
    if robots is not None:
        keys = choice.list_keys()
        if isinstance(layout, Layout):
            level = _choose_level(path, layout, choice)
            keys["spacing"] = "whole"  # what is drawn is inspected, not pieces of it
            if choice.vehicle_type is None and (name := _find_usual_type(level)):
                keys["vehicle_type"] = name
        drawn = {"layout": str(path.resolve()), **keys}
        loaded = _add_fleet(drawn, Path(), Path(robots), jobs)
        return Sites(description=describe_layout(layout), notes=loaded.notes, sites=loaded.sites)
    if isinstance(layout, Layout):
        return _read_layout(path, layout, choice)
    return _read_cells(path, layout, choice)


def _choose_level(path: Path, layout: Layout, choice: Choice) -> Level:
    """Return the level that is wanted, with lanes of the vehicle type that is wanted."""
    with name_file(str(path)):
        if choice.cell_size is not None:
            message = "is given with a layout of lanes, which has no cells (take it out)"
            raise InputError.at("cell_size", message)
        level = layout.get_level(choice.level)
        if choice.vehicle_type is not None:
            level.list_lanes(choice.vehicle_type)
    return level


def _read_layout(path: Path, layout: Layout, choice: Choice) -> Sites:
    levels = layout.levels if choice == Choice() else (_choose_level(path, layout, choice),)
    sites, notes = list[tuple[str, Site]](), list(layout.notes)
    for level in levels:
        if not level.vertices:
            notes.append(Fact("level empty", level=level.name))
            continue
        name = choice.vehicle_type or _find_usual_type(level)
        level_map = build_roadmap_of_level(level, vehicle_type=name)
        roadmap = level_map.roadmap
        lacks = (*level_map.notes, *note_on_hidden_stations(roadmap))
        if name and choice.vehicle_type is None:
            others = len(level.vehicle_types) - 1
            usual = Fact("usual vehicle type", type=name, others=others)
            lacks = (usual, *lacks)
        if len(levels) > 1:
            lacks = tuple(_name_level(level.name, lack) for lack in lacks)
        notes += lacks
        drawn = roadmap.drawing
        assert drawn, "the roadmap of a level has its places"
        site = Site(
            roadmap=roadmap,
            units=METRES,
            stations=dict(drawn.stations),
            parking={
                roadmap.name(vertex): vertex for vertex in sorted({*drawn.parking, *drawn.charging})
            },
        )
        sites.append((level.name if len(levels) > 1 else "", site))
    return Sites(description=describe_layout(layout), notes=tuple(notes), sites=tuple(sites))


def _name_level(level: str, note: Fact) -> Fact:
    """Return a note with the level that it is about."""
    if note.kind == "note on pieces":
        return note_pieces(_name_level(level, note.values["sentence"]), note.values["names"])
    return Fact("note on level", note.about, level=level, lack=note)


def _find_usual_type(level: Level) -> str | None:
    """Return the vehicle type that most lanes are open to, or None where lanes do not differ."""
    types = Counter(name for edge in level.edges for name in edge.types or ())
    return min(types, key=lambda name: (-types[name], name)) if len(types) > 1 else None


def _read_cells(path: Path, cells: Any, choice: Choice) -> Sites:
    from rightofway.io.scenario.shape import MapDocument

    document = validate(MapDocument, {"layout": str(path.resolve()), **choice.list_keys()})
    loaded = map_of(document, Path(), Units())
    assert loaded, "only a floor needs speeds"
    site = Site(roadmap=loaded.roadmap, units=loaded.units)
    return Sites(description=describe_layout(cells), notes=loaded.notes, sites=(("", site),))


def _read_scenario_site(path: Path, robots: Path | str | None, jobs: Path | str | None) -> Sites:
    if robots is None:
        loaded = load_with_notes(path, jobs=jobs)
        return make_sites(loaded.scenario, loaded.notes)
    if path.suffix.lower() in {".xlsx", ".xlsm", ".scen"}:
        message = (
            "has robots of its own (give --robots with a layout, or a scenario as YAML or JSON)"
        )
        raise InputError.at("", message, str(path))
    with open_document(path) as document:
        drawn = document.get("map") if isinstance(document, dict) else None
        if drawn is None:
            raise InputError.at("", "this is neither a layout nor a scenario with a map")
    return _add_fleet(drawn, path.parent, Path(robots), jobs)


OF_FLEET = ("homes", "robots", "rules", "units", "jobs", "batteries", "charging", "closures")
"""The keys of a scenario that are about its fleet."""


def _add_fleet(drawn: Any, base: Path, robots: Path, jobs: Path | str | None) -> Sites:
    """Return the site of a map document with the fleet of another file."""
    document: dict[str, Any] = {"format": SCENARIO_FORMAT, "map": drawn}
    of_jobs = {} if jobs is None else {"jobs": {"table": str(Path(jobs).resolve())}}
    if robots.suffix.lower() == ".csv":
        document["robots"] = {"table": str(robots.resolve())}
        loaded = read_scenario({**document, **of_jobs}, base)
        return make_sites(loaded.scenario, loaded.notes)
    with open_document(robots, read_text(robots)) as robots_document:
        fleet = (
            {"robots": robots_document} if isinstance(robots_document, list) else robots_document
        )
        if not isinstance(fleet, dict) or "robots" not in fleet:
            raise InputError.at("", "no robots are in it (give robots: [{name: R1, home: …}, …])")
        parts = {key: fleet[key] for key in OF_FLEET if key in fleet}
        loaded = read_scenario({**document, **parts, **of_jobs}, base)
    return make_sites(loaded.scenario, loaded.notes)


def make_sites(scenario: Scenario, notes: tuple[Fact, ...]) -> Sites:
    """Return a scenario as the one site that it is about."""
    site = Site(
        roadmap=scenario.roadmap,
        units=scenario.units,
        robots=scenario.robots,
        rules=scenario.rules,
        scenario=None if scenario.jobs is None else scenario,
    )
    grid = scenario.roadmap.grid
    ground = (
        Fact("ground of cells", columns=grid.columns, rows=grid.rows)
        if grid
        else Fact("ground of vertices", vertices=scenario.roadmap.n_vertices)
    )
    description = Fact("scenario", robots=len(scenario.robots), ground=ground)
    return Sites(description=description, notes=notes, sites=(("", site),))
