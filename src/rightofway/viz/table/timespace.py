"""The table as data: for each robot the row it would drive alone, and the row of the plan."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Literal, NamedTuple

from rightofway.errors import InputError
from rightofway.model import Tick

__all__ = ["MAX_CELLS", "Cell", "Mark", "Place", "Row", "RowKind", "Run", "TimeSpaceTable"]

MAX_CELLS = 2_000_000
"""Larger tables than this are not written out."""

Mark = Literal["collision", "wait"]
"""``collision``: another robot books the place too. ``wait``: nothing but waiting to do."""

Place = int | str
"""On a grid the number of the cell, else the name of the vertex."""

RowKind = Literal["planned", "final"]
"""``planned``: nobody waits for anybody. ``final``: the plan."""


class Cell(NamedTuple):
    """What a robot holds at one tick."""

    place: Place
    mark: Mark | None


class Run(NamedTuple):
    """Equal cells in a row, from `start` to before `end` [ticks]."""

    start: Tick
    end: Tick
    cell: Cell


@dataclass(frozen=True, slots=True, kw_only=True)
class Row:
    """Where one robot is from the table's first tick on, until it is done.

    Attributes
    ----------
    robot
        Its name.
    kind
        Whether it drives alone or by the plan.
    runs
        Its cells; no gap between them, none where it is done before the first tick.
    """

    robot: str
    kind: RowKind
    runs: tuple[Run, ...]

    def cells(self, first: int, last: int) -> list[Cell]:
        """Return the cells of these ticks, both included; fewer where the row ends before."""
        return [
            run.cell
            for run in self.runs
            for _ in range(max(run.start, first), min(run.end, last + 1))
        ]

    @property
    def places(self) -> list[Place]:
        """What the robot holds, tick by tick."""
        return [run.cell.place for run in self.runs for _ in range(run.start, run.end)]


@dataclass(frozen=True, slots=True, kw_only=True)
class TimeSpaceTable:
    """Planned and final rows side by side.

    Attributes
    ----------
    first_tick, last_tick
        Its columns, both included [ticks].
    tick
        How long a tick is [time unit].
    rows
        Planned and final row of each robot in turn.
    """

    first_tick: Tick
    last_tick: Tick
    tick: Fraction
    rows: tuple[Row, ...]

    @property
    def ticks(self) -> range:
        """The ticks of its columns."""
        return range(self.first_tick, self.last_tick + 1)

    @property
    def marks(self) -> set[Mark]:
        """The marks that occur in it."""
        cells = (run.cell for row in self.rows for run in row.runs)
        return {cell.mark for cell in cells if cell.mark}

    def refuse_more_than(self, columns: int) -> None:
        """Make sure that the table can be written out.

        Raises
        ------
        InputError
            If it has more ticks than ``columns``, or more than `MAX_CELLS` cells.
        """
        ticks, rows = len(self.ticks), len(self.rows)
        if ticks > columns:
            message = (
                f"{ticks} columns, room is for {columns} (choose fewer: first_tick, last_tick)"
            )
            raise InputError.at("table", message)
        if ticks * rows > MAX_CELLS:
            message = (
                f"{rows} rows of {ticks} ticks are more than {MAX_CELLS} cells"
                " (choose fewer robots, or fewer ticks: robots, first_tick, last_tick)"
            )
            raise InputError.at("table", message)
