"""A map that a document names or draws, as its roadmap and what people want to know of it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from pathlib import Path

from rightofway.phrases import Phrase, PhraseOfPieces, say_count
from rightofway.quantities import Units, format_decimal
from rightofway.site import Floor, Grid, Roadmap, VertexId
from rightofway.site.places import as_place, find_vertex_at
from rightofway.site.spacing import SplitLanes


@dataclass(frozen=True, slots=True, kw_only=True)
class FleetTraits:
    """What a map depends on of the fleet that drives there.

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
        """How far the middles of the two largest robots are apart at least; 0 for points."""
        return 2 * self.radius + self.clearance if self.radius > 0 else Fraction(0)


@dataclass(frozen=True, slots=True, kw_only=True)
class LoadedMap:
    """A roadmap, and what its document says beyond it."""

    roadmap: Roadmap
    lines: tuple[str, ...] = ()  # of a grid, as they were written
    floor: Floor | None = None  # that the grid was cut from
    file: Path | None = None  # that the grid was read from
    rounding: tuple[int, int, Fraction] | None = None  # lengths rounded up, of how many, to a step
    units: Units = field(default_factory=Units)
    chord_error: Fraction = Fraction(0)  # of curves that are cut into straight pieces
    blocked: str = ""  # what all blocked cells are; else what the grid's characters say
    keeps_clear: bool = False  # blocked cells have grown by what the largest radius is wider
    notes: tuple[Phrase, ...] = ()  # of a layout's reader

    def find(self, written: object) -> VertexId:
        """Return the vertex at a place as written; an InputError says what is there instead."""
        place = as_place(written, self.roadmap)

        def what_blocks(row: int, column: int) -> str:
            grid, floor = self.roadmap.grid, self.floor
            if floor is None or grid is None:
                sign = self.lines[row][column]
                return self.blocked or (
                    "a space, as only '.' is free" if sign == " " else repr(sign)
                )
            if self.roadmap.frame.y_up:  # a floor counts its rows from the least y on
                row = grid.rows - 1 - row
            return _obstacle(row, column, floor, grid)

        return find_vertex_at(self.roadmap, place, units=self.units, what_blocks=what_blocks)


def _obstacle(row: int, column: int, floor: Floor, grid: Grid) -> str:
    """Return what stands on a cell of a floor."""
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


def note_on_squares(noun: str, roadmap: Roadmap, cells: int, units: Units) -> Phrase:
    """Return a sentence on the squares that the smallest cells of a map have been joined to."""
    assert roadmap.sides is not None, "the cells are squares"
    least, most = min(roadmap.sides), max(roadmap.sides)
    span = units.format_length(most)
    if most > least:
        span = Phrase("{first} to {last}", first=format_decimal(least), last=span)
    return Phrase(
        "{noun} cut into {squares} squares of {span}, from {cells} free cells",
        noun=noun,
        squares=str(len(roadmap.sides)),
        span=span,
        cells=str(cells),
    )


def note_on_hidden_stations(roadmap: Roadmap) -> Iterator[Phrase]:
    """Yield a sentence on stations that have the name of another vertex, if there are any."""
    hidden = [
        Phrase("{name} (station at {vertex})", name=name, vertex=vertex)
        for name, vertex in roadmap.list_hidden_stations()
    ]
    if hidden:
        sentence = Phrase("a station has the name of another vertex, and the name means the vertex")
        yield PhraseOfPieces(sentence, hidden)


def note_on_rounding(rounded: int, lengths: int, step: Fraction, units: Units) -> Phrase:
    """Return a sentence on lengths that are rounded up."""
    return Phrase(
        "{rounded} of {lengths} lengths rounded up to {step}",
        rounded=str(rounded),
        lengths=str(lengths),
        step=" ".join(filter(None, (format_decimal(step, 6), units.length))),
    )


def note_on_chosen_pieces(split: SplitLanes, units: Units) -> Iterator[Phrase]:
    """Yield a sentence on the lanes that are split though the map does not say it, if any are."""
    if split.chosen:
        assert split.spacing is not None, "they are split into pieces"
        yield Phrase(
            "{lanes} booked in pieces of at most {length}, so that robots can follow and cross"
            " each other there (spacing: whole keeps lanes whole)",
            lanes=say_count(split.chosen, "lane is", "lanes are"),
            length=units.format_length(split.spacing),
        )


def note_on_curves(curves: int, chord_error: Fraction, units: Units) -> Iterator[Phrase]:
    """Yield a sentence on the curves that are cut into straight pieces, if there are any."""
    if curves:
        note = Phrase(
            "{curves} cut into straight pieces for robots with a size",
            curves=say_count(curves, "curve is", "curves are"),
        )
        if not chord_error:
            yield note
            return
        error, twice = (
            f"{format_decimal(factor * chord_error, 6)} {units.length or ''}".rstrip()
            for factor in (1, 2)
        )
        yield Phrase(
            "{note}, which leave the curve by at most {error}: the clearance grows by {twice}",
            note=note,
            error=error,
            twice=twice,
        )
