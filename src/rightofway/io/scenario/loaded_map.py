"""A map that a document names or draws, as its roadmap and details for people."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from pathlib import Path

from rightofway.facts import Fact, note_pieces
from rightofway.model import PlaceActions
from rightofway.site import Floor, Grid, Roadmap, VertexId
from rightofway.site.places import as_place, find_vertex_at
from rightofway.site.spacing import SplitLanes
from rightofway.units import Units


@dataclass(frozen=True, slots=True, kw_only=True)
class FleetTraits:
    """Properties of a fleet on which its map depends.

    Attributes
    ----------
    speeds
        The speeds of all robots, for node clustering [length units per time unit]; None if some
        are not known.
    radius
        The largest radius, for maps that are pictures and for curves [length unit].
    clearance
        The least distance between two robots, for pieces of lanes [length unit].
    types
        The types of all robots, for layouts whose lanes are reserved for types; None stands for a
        robot without one.
    """

    speeds: Sequence[Fraction] | None = None
    radius: Fraction = Fraction(0)
    clearance: Fraction = Fraction(0)
    types: frozenset[str | None] = frozenset()

    @property
    def distance(self) -> Fraction:
        """The least distance of the middles of the two largest robots; 0 for points."""
        return 2 * self.radius + self.clearance if self.radius > 0 else Fraction(0)


@dataclass(frozen=True, slots=True, kw_only=True)
class LoadedMap:
    """A roadmap, and the other parts of its document."""

    roadmap: Roadmap
    lines: tuple[str, ...] = ()  # of a grid, as they were written
    floor: Floor | None = None  # that the grid was cut from
    file: Path | None = None  # that the grid was read from
    rounding: tuple[int, int, Fraction] | None = None  # lengths rounded up, of how many, to a step
    units: Units = field(default_factory=Units)
    chord_error: Fraction = Fraction(0)  # of curves that are cut into straight pieces
    blocked: str = ""  # what all blocked cells are; else what the grid's characters say
    keeps_clear: bool = False  # blocked cells have grown by what the largest radius is wider
    notes: tuple[Fact, ...] = ()  # of a layout's reader
    actions: tuple[PlaceActions, ...] = ()  # of the places of a layout

    def find(self, written: object) -> VertexId:
        """Return the vertex at a place as written; an InputError names the obstacle there."""
        place = as_place(written, self.roadmap)

        def what_blocks(row: int, column: int) -> str:
            grid, floor = self.roadmap.grid, self.floor
            if floor is None or grid is None:
                if not self.lines:
                    return self.blocked or "a wall"
                sign = self.lines[row][column]
                return self.blocked or (
                    "a space, as only '.' is free" if sign == " " else repr(sign)
                )
            if self.roadmap.frame.y_up:  # a floor counts its rows from the least y on
                row = grid.rows - 1 - row
            return _describe_obstacle(row, column, floor, grid)

        return find_vertex_at(self.roadmap, place, units=self.units, what_blocks=what_blocks)


def _describe_obstacle(row: int, column: int, floor: Floor, grid: Grid) -> str:
    """Return the obstacle on a cell of a floor."""
    size = grid.cell_size
    for index, obstacle in enumerate(floor.obstacles):
        if (
            obstacle.x < (column + 1) * size
            and column * size < obstacle.x + obstacle.width
            and obstacle.y < (row + 1) * size
            and row * size < obstacle.y + obstacle.height
        ):
            return obstacle.name or f"obstacles[{index}]"
    raise AssertionError("an obstacle blocked the cell")


def note_on_squares(noun: Fact, roadmap: Roadmap, cells: int, units: Units) -> Fact:
    """Return a note on the squares that the smallest cells of a map have been joined to."""
    assert roadmap.sides is not None, "the cells are squares"
    least, most = min(roadmap.sides), max(roadmap.sides)
    several = most > least
    return Fact(
        "squares of sizes" if several else "squares",
        about=units,
        noun=noun,
        squares=len(roadmap.sides),
        span=Fact("span of lengths", first=least, last=most) if several else most,
        cells=cells,
    )


def note_on_hidden_stations(roadmap: Roadmap) -> Iterator[Fact]:
    """Yield a note on stations that have the name of another vertex, if there are any."""
    hidden = [
        Fact("station at vertex", name=name, vertex=vertex)
        for name, vertex in roadmap.list_hidden_stations()
    ]
    if hidden:
        yield note_pieces(Fact("stations hidden"), hidden)


def note_on_rounding(rounded: int, lengths: int, step: Fraction, units: Units) -> Fact:
    """Return a note on lengths that are rounded up."""
    return Fact("lengths rounded up", about=units, rounded=rounded, lengths=lengths, step=step)


def note_on_chosen_pieces(split: SplitLanes, units: Units) -> Iterator[Fact]:
    """Yield a note on the lanes that are split though the map does not say it, if any are."""
    if split.chosen:
        assert split.spacing is not None, "they are split into pieces"
        yield Fact("lanes in pieces", about=units, lanes=split.chosen, length=split.spacing)


def note_on_curves(curves: int, chord_error: Fraction, units: Units) -> Iterator[Fact]:
    """Yield a note on the curves that are cut into straight pieces, if there are any."""
    if curves:
        note = Fact("curves cut", curves=curves)
        if chord_error:
            error, twice = chord_error, 2 * chord_error
            note = Fact("curves cut with error", units, note=note, error=error, twice=twice)
        yield note
