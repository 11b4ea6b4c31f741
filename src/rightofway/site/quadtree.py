"""Cells that fit: a floor cut into squares of a quadtree, small where it is narrow.

Smallest cells that are all free are joined four by four, as long as the tree stays balanced: the
sides of two squares that touch differ by a factor of two at most. Vertices are the centres of
squares, and squares that share a part of a side are joined by two edges.

References
----------
Samet, *The quadtree and related hierarchical data structures*, ACM Computing Surveys, 1984.
Kambhampati & Davis, *Multiresolution path planning for mobile robots*, IEEE Journal on Robotics
and Automation, 1986. It searches trees that are not balanced; ours are, so that no drive between
two centres comes near a third square.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from rightofway.errors import InputError
from rightofway.site.clustering import MAX_CELLS
from rightofway.site.geometry import Frame, Point, find_fractions
from rightofway.site.roadmap import EdgeClass, Roadmap

MAX_SMALLEST = 32_000_000
"""The most smallest cells, free and blocked."""

LARGEST = 4
"""Default width of the largest square in smallest cells."""

OBLIQUE = Fraction(19, 12)
"""Length of an edge between two squares of different size, in sides of the smaller one.

The distance of their centres is sqrt(5/2) = 1.5811, this is 0.14 % more. Of all edges of a map the
lengths are then multiples of a twelfth of the smallest cell, and the tick stays long.
"""

CLEARANCE = Fraction(1, 10)
"""Square of the distance between such an edge and the corner of the two squares that it passes
[sides of the smaller square]: 1/sqrt(10) squared."""

EAST, SOUTH, WEST, NORTH = range(4)

Cell = TypeVar("Cell", np.bool_, np.int32)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Squares:
    """The squares of a floor, in rows from the least y on and from the least x on in each.

    Attributes
    ----------
    column, row
        The smallest cell in the corner that has the least x and y; int32, shape (V,).
    side
        How many smallest cells a square is wide; int32, shape (V,).
    at
        The square of each smallest cell, -1 where it is blocked; int32, shape (rows, columns).
    """

    column: NDArray[np.int32]
    row: NDArray[np.int32]
    side: NDArray[np.int32]
    at: NDArray[np.int32]

    def name_squares(self) -> Iterator[str]:
        """Yield the name of each square: ``Q<column>-<row>``, and ``x<side>`` above 1."""
        of = (values.tolist() for values in (self.column, self.row, self.side))
        for column, row, side in zip(*of, strict=True):
            yield f"Q{column}-{row}x{side}" if side > 1 else f"Q{column}-{row}"


def join_squares(
    free: NDArray[np.bool_], *, largest: int, near: bool, max_squares: int = MAX_CELLS
) -> Squares:
    """Join free cells to the largest squares of a balanced quadtree.

    Raises
    ------
    InputError
        If there are more squares.

    Notes
    -----
    Squares are connected as the smallest cells are: no edge has to be left out.
    """
    rows, columns = free.shape
    levels = max(min(largest, rows, columns), 1).bit_length() - 1
    block = 1 << levels
    padded = np.pad(free, ((0, -rows % block), (0, -columns % block)))
    joined = _join_blocks(padded, levels, near=near)
    counts = [int(whole.sum()) for whole in joined]
    count = sum(counts) - 4 * sum(counts[1:])  # each block but the smallest has four in it
    if count > max_squares:
        message = f"{count} squares, more than {max_squares} (give a larger one)"
        raise InputError.at("smallest", message)
    squares: list[tuple[NDArray[np.int64], NDArray[np.int64], int]] = []
    for level, whole in enumerate(joined):
        alone = whole & ~_split_into_four(joined[level + 1]) if level < levels else whole
        row, column = np.nonzero(alone)
        squares.append((row << level, column << level, 1 << level))
    row = np.concatenate([square[0] for square in squares])
    column = np.concatenate([square[1] for square in squares])
    side = np.concatenate([np.full(len(square[0]), square[2]) for square in squares])
    order = np.lexsort((column, row))
    row, column, side = row[order], column[order], side[order]
    at = np.full((1, 1), -1, np.int32)
    for level in range(levels, -1, -1):
        at = np.full(joined[level].shape, -1, np.int32) if level == levels else _split_into_four(at)
        of_level = np.flatnonzero(side == 1 << level)
        at[row[of_level] >> level, column[of_level] >> level] = of_level
    return Squares(
        column=column.astype(np.int32),
        row=row.astype(np.int32),
        side=side.astype(np.int32),
        at=at[:rows, :columns],
    )


def _join_blocks(free: NDArray[np.bool_], levels: int, *, near: bool) -> list[NDArray[np.bool_]]:
    """Return for each level which blocks of 2**level cells may be in one square.

    A block may if its four parts may, and if no square beside it can be smaller than they are.
    """
    pieces = [free]
    sides = [free] * 4  # whether a block has a free cell at its low x, high x, low y, high y
    for level in range(levels):
        part = pieces[-1]
        whole = _mark_all_of_four(part)
        if level or not near:
            join = np.logical_or if level else np.logical_xor
            low_x, high_x, low_y, high_y = [~part & side for side in sides] if level else sides
            whole[:, 1:] &= ~join(high_x[0::2, 1:-1:2], high_x[1::2, 1:-1:2])
            whole[:, :-1] &= ~join(low_x[0::2, 2::2], low_x[1::2, 2::2])
            whole[1:] &= ~join(high_y[1:-1:2, 0::2], high_y[1:-1:2, 1::2])
            whole[:-1] &= ~join(low_y[2::2, 0::2], low_y[2::2, 1::2])
        low_x, high_x, low_y, high_y = sides
        sides = [
            low_x[0::2, 0::2] | low_x[1::2, 0::2],
            high_x[0::2, 1::2] | high_x[1::2, 1::2],
            low_y[0::2, 0::2] | low_y[0::2, 1::2],
            high_y[1::2, 0::2] | high_y[1::2, 1::2],
        ]
        pieces.append(whole)
    return pieces


def _mark_all_of_four(part: NDArray[np.bool_]) -> NDArray[np.bool_]:
    result: NDArray[np.bool_] = part[0::2, 0::2] & part[1::2, 0::2]
    result &= part[0::2, 1::2]
    result &= part[1::2, 1::2]
    return result


def _split_into_four(blocks: NDArray[Cell]) -> NDArray[Cell]:
    """Return blocks cut into four each."""
    return blocks.repeat(2, axis=0).repeat(2, axis=1)


def build_roadmap_of_squares(
    free: NDArray[np.bool_],
    smallest: Fraction,
    *,
    largest: Fraction | None = None,
    radius: Fraction = Fraction(0),
    y_up: bool = False,
    corner: Point = (Fraction(0), Fraction(0)),
    origin: Point = (Fraction(0), Fraction(0)),
    yaw: Fraction = Fraction(0),
    max_squares: int = MAX_CELLS,
) -> Roadmap:
    """Make the roadmap of a floor whose cells are squares of a quadtree.

    Raises
    ------
    InputError
        If no cell is free, the largest square is below the smallest, or there are too many.
    """
    if largest is None:
        largest = LARGEST * smallest
    if largest < smallest:
        message = f"{largest} is below the smallest cell, {smallest} (give at least that)"
        raise InputError.at("largest", message)
    if not free.any():
        raise InputError.at("", f"no free cell in {free.size} (give a smaller one)")
    least = min(radius, smallest / 2)
    near = least**2 <= CLEARANCE * smallest**2
    squares = join_squares(
        free, largest=int(largest // smallest), near=near, max_squares=max_squares
    )
    count = len(squares.side)
    tails, heads, lengths = _list_edges(squares, y_up=y_up)
    known, class_of_edge = np.unique(lengths, return_inverse=True)
    left, low = (corner[0] - origin[0], corner[1] - origin[1]) if yaw else corner
    half = smallest / 2
    multiples = {int(side): int(side) * smallest for side in np.unique(squares.side)}
    middles = [2 * along + squares.side for along in (squares.column, squares.row)]
    halves = range(2 * max(free.shape) + 1)
    exact_x, exact_y = ([start + step * half for step in halves] for start in (left, low))
    x, y = (
        np.array([float(coordinate) for coordinate in coordinates])[middle]
        for coordinates, middle in zip((exact_x, exact_y), middles, strict=True)
    )
    fractions: dict[int, Point] = {}
    if find_fractions(zip(exact_x, exact_y, strict=True)):
        along, down = (middle.tolist() for middle in middles)
        up = -1 if y_up else 1
        fractions = find_fractions(
            (exact_x[column], up * exact_y[row]) for column, row in zip(along, down, strict=True)
        )
    turned = {"x": origin[0], "y": origin[1], "yaw": yaw} if yaw else {}
    return Roadmap(
        indptr=np.concatenate(([0], np.cumsum(np.bincount(tails, minlength=count)))).astype(
            np.int32
        ),
        heads=heads.astype(np.int32),
        class_of_edge=class_of_edge.astype(np.int32),
        edge_classes=tuple(
            EdgeClass(length=Fraction(int(twelfths), 12) * smallest) for twelfths in known
        ),
        positions=np.column_stack((x, -y if y_up else y)),
        fractions=fractions,
        labels=tuple(squares.name_squares()),
        frame=Frame(y_up=y_up, **turned),
        sides=tuple(map(multiples.__getitem__, squares.side.tolist())),
    )


def _list_edges(
    squares: Squares, *, y_up: bool
) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]:
    """Return tails, heads and lengths of all edges [twelfths of a smallest cell], by tail.

    East comes first, then south, west and north, as on a grid.
    """
    rows, columns = squares.at.shape
    side, heads_of_ways = squares.side, list[NDArray[np.int64]]()
    for direction in (EAST, SOUTH, WEST, NORTH):
        downwards = (direction == SOUTH) != y_up  # to larger y
        for share in (side * 0, side // 2):  # of two smaller neighbours, a cell of each
            if direction in {EAST, WEST}:
                row = squares.row + share
                column = squares.column + (side if direction == EAST else -1)
            else:
                column = squares.column + share
                row = squares.row + (side if downwards else -1)
            inside = (row >= 0) & (row < rows) & (column >= 0) & (column < columns)
            tails = np.flatnonzero(inside)
            heads = squares.at[row[inside], column[inside]].astype(np.int64)
            has_neighbour = heads >= 0
            heads_of_ways.append(
                (tails[has_neighbour] * 4 + direction) * len(side) + heads[has_neighbour]
            )
    tails, heads = np.divmod(np.unique(np.concatenate(heads_of_ways)), len(side))
    tails //= 4
    small, large = np.minimum(side[tails], side[heads]), np.maximum(side[tails], side[heads])
    lengths = small.astype(np.int64) * np.where(small == large, 12, int(12 * OBLIQUE))
    return tails, heads, lengths
