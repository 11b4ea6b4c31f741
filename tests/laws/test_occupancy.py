"""Cells of maps in pixels, against the plain definition."""

from fractions import Fraction
from math import ceil, floor

import numpy as np
from hypothesis import strategies as st
from numpy.typing import NDArray

from rightofway.errors import InputError
from rightofway.site.occupancy import FREE, OCCUPIED, UNKNOWN, Occupancy, widen_blocked
from tests.builders.laws import law, leave

maps = st.integers(1, 7).flatmap(
    lambda width: st.lists(
        st.lists(st.sampled_from([FREE] * 6 + [UNKNOWN, OCCUPIED]), min_size=width, max_size=width),
        min_size=1,
        max_size=7,
    )
)
distances = st.fractions(0, 5, max_denominator=8)


def gap(one: int, other: int) -> int:
    """Return how many pixels lie between two in one direction."""
    return max(abs(one - other) - 1, 0)


@law(drawn=maps, by=distances, outside=st.booleans())
def test_pixels_nearer_than_the_distance_are_blocked(
    drawn: list[list[int]], by: Fraction, outside: bool
) -> None:
    blocked: NDArray[np.bool_] = np.array(drawn) != FREE
    rows, columns = blocked.shape
    around = [
        (row, column)
        for row in range(-1, rows + 1)
        for column in range(-1, columns + 1)
        if (blocked[row, column] if 0 <= row < rows and 0 <= column < columns else outside)
    ]
    found = widen_blocked(blocked, by, outside=outside)
    for row in range(rows):
        for column in range(columns):
            nearest = min(
                (gap(row, other) ** 2 + gap(column, another) ** 2 for other, another in around),
                default=None,
            )
            is_near = nearest is not None and nearest < by**2
            assert found[row, column] == (blocked[row, column] or is_near)


@law(drawn=maps, size=st.fractions(1, 3, max_denominator=4))
def test_a_cell_is_free_if_all_pixels_that_it_touches_are(
    drawn: list[list[int]], size: Fraction
) -> None:
    pixels = np.array(drawn, np.uint8)
    height, width = pixels.shape
    rows, columns = floor(height / size), floor(width / size)
    if not rows or not columns:
        leave("no cell has room")
    occupancy = Occupancy(pixels=pixels, resolution=Fraction(1))
    try:
        lines = occupancy.cut_cells(size)
    except InputError:  # no cell is free, as the message says
        lines = ("@" * columns,) * rows
    for up in range(rows):
        for right in range(columns):
            touched = [
                pixels[height - 1 - y, x]
                for y in range(floor(up * size), ceil((up + 1) * size))
                for x in range(floor(right * size), ceil((right + 1) * size))
            ]
            is_free = all(pixel == FREE for pixel in touched)
            assert (lines[rows - 1 - up][right] == ".") == is_free
