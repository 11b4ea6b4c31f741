"""A fleet on the rows of a `.scen` file; speeds and work times are dealt out in turn."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import cycle, islice
from pathlib import Path
from typing import TYPE_CHECKING

from rightofway.errors import InputError
from rightofway.io.faults import Faults, blaming, under
from rightofway.io.movingai import ScenRow, read_scen
from rightofway.io.scenario.draft import DEFAULT_SPEED, DEFAULT_WORK, Draft, laps_place
from rightofway.io.scenario.ground import Ground
from rightofway.io.scenario.maps import beside
from rightofway.io.scenario.places import find_place
from rightofway.model import Robot, Stop, VertexId

if TYPE_CHECKING:
    from rightofway.io.scenario.shape import FleetDocument

__all__ = ["Dealt", "dealt_fleet"]


def dealt_fleet(document: FleetDocument, base: Path | None) -> Dealt:
    """Read the rows that a fleet stands on.

    Raises
    ------
    InputError
        If the file cannot be read, or has too few rows; with places relative to the fleet.
    """
    with under("scen"):
        file = beside(base, document.scen)
        rows = read_scen(file)
    if document.count is not None and document.count > len(rows):
        message = f"{document.count} is more than the {len(rows)} rows of {file} (give fewer)"
        raise InputError.at("count", message)
    return Dealt(document=document, file=file, rows=rows[: document.count])


@dataclass(frozen=True, slots=True, kw_only=True)
class Dealt:
    """Robots R1, R2, ..., one for each row: the first speed and work time for R1, and so on round.

    Attributes
    ----------
    document
        What the rows do not say.
    file, rows
        The `.scen` file, and those of its rows that count.
    """

    document: FleetDocument
    file: Path
    rows: Sequence[ScenRow]

    def speeds(self) -> Sequence[Fraction]:
        """Return the speeds of all robots."""
        return list(islice(cycle(self.document.speeds or [DEFAULT_SPEED]), len(self.rows)))

    def drafts(self, ground: Ground, faults: Faults) -> list[Draft]:
        """Return all robots, or none after noting why."""
        ends = faults.attempt("robots.scen", self._ends, ground) or []
        works = cycle(self.document.work or [DEFAULT_WORK])
        return [
            self._draft(f"R{number}", home, Stop(at=goal, work=work), speed)
            for number, ((home, goal), work, speed) in enumerate(
                zip(ends, works, self.speeds(), strict=False), start=1
            )
        ]

    def _draft(self, name: str, home: VertexId, stop: Stop, speed: Fraction) -> Draft:
        own = self.document.given("turn", "ends", "laps")
        robot = Robot(name=name, home=home, stops=(stop,), speed=speed, **own)
        aliases = {"turn": "robots.turn", "laps": laps_place(self.document, "robots")}
        return Draft(robot=robot, place="robots.scen", aliases=aliases)

    def _ends(self, ground: Ground) -> list[tuple[VertexId, VertexId]]:
        with blaming(str(self.file)):
            for row in self.rows:  # stops at the first: the others are for the same map
                _check_map(row, ground)
            return _starts_and_goals(self.rows, ground)


def _check_map(row: ScenRow, ground: Ground) -> None:
    grid = ground.roadmap.grid
    if grid is None:
        raise InputError.at("", "its rows need a grid (give the map as grid, file or floor)")
    place = f"line {row.line}"
    if (row.width, row.height) != (grid.columns, grid.rows):
        sizes = f"{row.width} x {row.height} cells, but the map has {grid.columns} x {grid.rows}"
        raise InputError.at(place, f"{sizes} (give the map it was made for)")
    name = re.split(r"[\\/]", row.map_name)[-1]
    if ground.file is not None and name != ground.file.name:
        message = f"is for {name!r}, but the map is {ground.file.name!r} (give the right one)"
        raise InputError.at(place, message)


def _starts_and_goals(rows: Sequence[ScenRow], ground: Ground) -> list[tuple[VertexId, VertexId]]:
    faults, ends, taken = Faults(), list[tuple[VertexId, VertexId]](), dict[VertexId, int]()
    for row in rows:
        start = faults.attempt(f"line {row.line}, start", find_place, row.start, ground)
        goal = faults.attempt(f"line {row.line}, goal", find_place, row.goal, ground)
        if start is None or goal is None:
            continue
        if taken.setdefault(start, row.line) != row.line:
            message = f"line {taken[start]} starts there already (a cell holds one robot)"
            faults.note(f"line {row.line}, start", message)
        ends.append((start, goal))
    faults.stop()
    return ends
