"""Where the fleets of a suite drive: map files with their rows, random grids, whole scenarios."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rightofway.bench.fleets import largest_part, random_grid
from rightofway.errors import InputError, InputFault
from rightofway.io import dump_scenario, load, scenario_of
from rightofway.io.faults import Faults, under
from rightofway.io.formats import SCENARIO_FORMAT
from rightofway.model import Grid, Scenario

if TYPE_CHECKING:
    from rightofway.io.suite import MapCasesDocument, RandomGridDocument

__all__ = ["Ground", "Source", "ground_of"]

Cell = tuple[int, int]


@dataclass(frozen=True, slots=True, kw_only=True)
class Source:
    """Where the scenarios of cases come from; needs no files any more.

    Attributes
    ----------
    scen
        The file that has the homes and targets, if any.
    map
        ``{"random": …}``, ``{"grid": …}`` or ``{"scenario": …}``, as plain data.
    ends
        Home and target of each row; empty where they are drawn, or the scenario has them.
    """

    scen: str = ""
    map: Mapping[str, Any]
    ends: tuple[tuple[Cell, Cell], ...] = ()

    def fault(self, robots: int) -> dict[str, Any]:
        """Return the map with the ends of so many robots."""
        return {**self.map, "ends": self.ends[:robots]} if self.ends else dict(self.map)


@dataclass(frozen=True, slots=True, kw_only=True)
class Ground:
    """One map of a suite.

    Attributes
    ----------
    name
        In results.
    counts
        How many robots drive there, in one case each.
    sources
        One for each `.scen` file; else one.
    has_fleet
        Whether it is a whole scenario.
    """

    name: str
    counts: tuple[int, ...]
    sources: tuple[Source, ...]
    has_fleet: bool = False


def ground_of(document: MapCasesDocument, counts: Sequence[int] | None, base: Path) -> Ground:
    """Read a map of a suite, and its files.

    Parameters
    ----------
    document
        The map.
    counts
        How many robots, where the map does not say.
    base
        The directory that files are relative to.

    Raises
    ------
    InputError
        With places relative to the map.
    """
    if document.scenario is not None:
        ground = _whole_scenario(document.scenario, base)
    else:
        counts = document.counts or counts
        if counts is None:
            raise InputError.at("counts", "is missing (give it here, or for the whole suite)")
        if document.random is not None:
            ground = _random(document.random, tuple(counts))
        else:
            ground = _from_files(document, tuple(counts), base)
    return replace(ground, name=document.name) if document.name else ground


def _whole_scenario(file: str, base: Path) -> Ground:
    with under("scenario"):
        scenario = load(base / file)
    source = Source(map={"scenario": dump_scenario(scenario)})
    return Ground(
        name=Path(file).stem, counts=(len(scenario.robots),), sources=(source,), has_fleet=True
    )


def _random(document: RandomGridDocument, counts: tuple[int, ...]) -> Ground:
    width, height = document.size
    recipe: dict[str, Any] = {
        "width": width,
        "height": height,
        "walls": document.walls,
        "seed": document.seed,
    }
    room = len(largest_part(random_grid(**recipe)))
    if max(counts) > room:
        message = f"{max(counts)} is more than the {room} cells that hang together (give fewer)"
        raise InputError.at("counts", message)
    name = f"random-{width}-{height}-{document.walls * 100:g}"
    return Ground(name=name, counts=counts, sources=(Source(map={"random": recipe}),))


def _from_files(document: MapCasesDocument, counts: tuple[int, ...], base: Path) -> Ground:
    faults = Faults()
    sources = [
        faults.attempt("", _rows_of, document, index, max(counts), base)
        for index in range(len(document.scens))
    ]
    faults.stop()
    return Ground(
        name=Path(document.file).stem,
        counts=counts,
        sources=tuple(source for source in sources if source),
    )


def _rows_of(document: MapCasesDocument, index: int, robots: int, base: Path) -> Source:
    """Read a map and rows as the scenario that they are, so that its reader finds the faults."""
    scen = document.scens[index]
    whole = {
        "format": SCENARIO_FORMAT,
        "map": {"file": document.file},
        "robots": {"scen": scen, "count": robots},
    }
    try:
        scenario = scenario_of(whole, base)
    except InputError as error:
        keys = {"map.file": "file", "robots.scen": f"scens[{index}]", "robots.count": "counts"}
        raise InputError(
            InputFault(keys.get(fault.place, fault.place), fault.message) for fault in error.faults
        ) from None
    grid = scenario.roadmap.grid
    assert grid is not None, "or its reader would have refused the rows"
    return Source(
        scen=Path(scen).name, map={"grid": grid.lines()}, ends=tuple(_ends(scenario, grid))
    )


def _ends(scenario: Scenario, grid: Grid) -> list[tuple[Cell, Cell]]:
    return [(grid.cell(robot.home), grid.cell(robot.stops[0].at)) for robot in scenario.robots]
