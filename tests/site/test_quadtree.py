"""Squares of a quadtree: what they cover, which of them are joined, and how near drives come."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

import numpy as np
import pytest
from numpy.typing import NDArray

from rightofway.errors import InputError
from rightofway.site import Roadmap
from rightofway.site.quadtree import OBLIQUE, Squares, build_roadmap_of_squares, join_squares

RANDOM = [(seed, share) for seed in range(2) for share in (0.02, 0.1, 0.3)]


def random_floor(seed: int, share: float) -> NDArray[np.bool_]:
    """Return a floor of free cells with single blocked ones and a few boxes."""
    draw = np.random.default_rng(seed)
    rows, columns = draw.integers(3, 22, 2)
    free = draw.random((rows, columns)) >= share
    for _ in range(2):
        row, column = draw.integers(0, rows), draw.integers(0, columns)
        free[row : row + 3, column : column + 4] = False
    free[0, 0] = True
    return free


def edges_of(roadmap: Roadmap) -> Iterator[tuple[int, int, Fraction]]:
    for tail in range(roadmap.n_vertices):
        for edge in range(int(roadmap.indptr[tail]), int(roadmap.indptr[tail + 1])):
            length = roadmap.get_edge_class(edge).length
            yield tail, int(roadmap.heads[edge]), length


def cells_of(squares: Squares, square: int) -> set[tuple[int, int]]:
    row, column, side = (int(each[square]) for each in (squares.row, squares.column, squares.side))
    return {(row + down, column + right) for down in range(side) for right in range(side)}


@pytest.mark.parametrize(("seed", "share"), RANDOM)
def test_squares_cover_the_free_cells_once(seed: int, share: float) -> None:
    free = random_floor(seed, share)
    squares = join_squares(free, largest=8, near=True)
    covered = [cell for square in range(len(squares.side)) for cell in cells_of(squares, square)]
    assert sorted(covered) == sorted(map(tuple, np.argwhere(free).tolist()))
    for square in range(len(squares.side)):
        assert all(squares.at[cell] == square for cell in cells_of(squares, square))


@pytest.mark.parametrize("near", [True, False])
@pytest.mark.parametrize(("seed", "share"), RANDOM)
def test_squares_that_share_a_part_of_a_side_are_joined_and_no_others(
    seed: int, share: float, near: bool
) -> None:
    """Every two free cells beside each other that lie in two squares give an edge each way."""
    free = random_floor(seed, share)
    squares = join_squares(free, largest=8, near=near)
    beside = set()
    for row, column in np.argwhere(free).tolist():
        for down, right in ((0, 1), (1, 0)):
            if row + down < free.shape[0] and column + right < free.shape[1]:
                one, other = (
                    int(squares.at[row, column]),
                    int(squares.at[row + down, column + right]),
                )
                if other >= 0 and one != other:
                    beside |= {(one, other), (other, one)}
    radius = Fraction(0) if near else Fraction(1, 2)
    roadmap = build_roadmap_of_squares(free, Fraction(1), radius=radius)
    assert {(tail, head) for tail, head, _ in edges_of(roadmap)} == beside
    sides = squares.side
    assert all(
        max(sides[one], sides[other]) <= 2 * min(sides[one], sides[other]) for one, other in beside
    )


@pytest.mark.parametrize("radius", [Fraction(3, 10), Fraction(1, 2), Fraction(2)])
@pytest.mark.parametrize(("seed", "share"), RANDOM)
def test_no_drive_between_two_middles_comes_nearer_than_the_radius_or_half_a_smallest_cell(
    seed: int, share: float, radius: Fraction
) -> None:
    """Exact distances from corners of blocked cells; outside the floor all is blocked.

    The ends of a drive are half a cell from everything that is blocked, as middles of squares.
    """
    free = random_floor(seed, share)
    roadmap = build_roadmap_of_squares(free, Fraction(1), radius=radius)
    framed = np.pad(free, 1, constant_values=False)
    blocked = [(row - 1, column - 1) for row, column in np.argwhere(~framed).tolist()]
    least = min(radius, Fraction(1, 2)) ** 2
    for tail, head, _ in edges_of(roadmap):
        if tail < head:
            (x, y), (to_x, to_y) = roadmap.get_point(tail), roadmap.get_point(head)
            for row, column in blocked:
                near_x = min(x, to_x) - 1 <= column + 1 and column <= max(x, to_x) + 1
                near_y = min(y, to_y) - 1 <= row + 1 and row <= max(y, to_y) + 1
                if near_x and near_y:
                    corners = [(column + i, row + j) for i in (0, 1) for j in (0, 1)]
                    gap = min(squared_gap((x, y), (to_x, to_y), corner) for corner in corners)
                    assert gap >= least


def squared_gap(
    tail: tuple[Fraction, Fraction], head: tuple[Fraction, Fraction], point: tuple[int, int]
) -> Fraction:
    """Return the square of the distance of a point from a segment."""
    (x, y), (to_x, to_y) = tail, head
    right, down = to_x - x, to_y - y
    share = ((point[0] - x) * right + (point[1] - y) * down) / (right**2 + down**2)
    share = min(max(share, Fraction(0)), Fraction(1))
    return (x + share * right - point[0]) ** 2 + (y + share * down - point[1]) ** 2


def test_an_edge_is_as_long_as_the_straight_line_or_a_little_longer() -> None:
    free = random_floor(3, 0.1)
    for tail, head, length in edges_of(roadmap := build_roadmap_of_squares(free, Fraction(1, 2))):
        (x, y), (to_x, to_y) = roadmap.get_point(tail), roadmap.get_point(head)
        square = (x - to_x) ** 2 + (y - to_y) ** 2
        assert square <= length**2 <= square * OBLIQUE**2 / Fraction(5, 2)


def test_an_edge_past_a_corner_that_is_too_near_splits_the_square() -> None:
    """Beside the lower half of the square is a free cell, beside its upper half a blocked one."""
    free = np.array([[True, True, True], [True, True, False]])
    assert build_roadmap_of_squares(free, Fraction(1), radius=Fraction(3, 10)).labels == (
        "Q0-0x2",
        "Q2-0",
    )
    wide = build_roadmap_of_squares(free, Fraction(1), radius=Fraction(1, 3))
    assert wide.labels == ("Q0-0", "Q1-0", "Q2-0", "Q0-1", "Q1-1")


def test_squares_lie_where_the_frame_says() -> None:
    free = np.ones((2, 2), np.bool_)
    free[0, 0] = False
    corner = (Fraction(10), Fraction(-4))
    up = build_roadmap_of_squares(free, Fraction(1, 2), y_up=True, corner=corner, origin=corner)
    assert up.labels == ("Q1-0", "Q0-1", "Q1-1")
    assert up.get_point(0) == (Fraction("10.75"), Fraction("-3.75"))
    down = build_roadmap_of_squares(free, Fraction(1, 2), corner=corner, origin=corner)
    assert down.get_point(0) == (Fraction("10.75"), Fraction("-3.75"))
    yaw = Fraction("1.5707963267949")  # a quarter turn: x to y
    turned = build_roadmap_of_squares(
        free, Fraction(1, 2), y_up=True, corner=corner, origin=corner, yaw=yaw
    )
    x, y = turned.get_point(0)
    assert (round(x, 9), round(y, 9)) == (Fraction("9.75"), Fraction("-3.25"))


def test_limits_are_said() -> None:
    free = np.ones((4, 4), np.bool_)
    with pytest.raises(InputError, match="largest: 1/2 is below the smallest cell, 1"):
        build_roadmap_of_squares(free, Fraction(1), largest=Fraction(1, 2))
    with pytest.raises(InputError, match="smallest: 4 squares, more than 3"):
        build_roadmap_of_squares(free, Fraction(1), largest=Fraction(2), max_squares=3)
    with pytest.raises(InputError, match="no free cell in 16"):
        build_roadmap_of_squares(~free, Fraction(1))
