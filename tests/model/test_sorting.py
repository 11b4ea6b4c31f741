"""Rows are sorted by their columns, whatever numbers stand in them."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from rightofway.model.sorting import order_by

NUMBERS = st.one_of(st.integers(-3, 3), st.integers(-(2**70), 2**70))


@given(st.lists(st.tuples(NUMBERS, st.booleans(), st.integers(0, 2**31 - 1)), max_size=20))
def test_the_order_is_that_of_sorted_tuples(rows: list[tuple[int, bool, int]]) -> None:
    """Python integers stand for times in files, which may be larger than 64 bits."""
    first = np.array([row[0] for row in rows], object)
    second = np.array([row[1] for row in rows], bool)
    third = np.array([row[2] for row in rows], np.int32)
    expected = sorted(range(len(rows)), key=lambda index: rows[index])
    assert order_by(first, second, third).tolist() == expected


def test_equal_numbers_beyond_64_bits_keep_their_order() -> None:
    """The width of the column is 0, so that all columns fit one key, but the number does not."""
    assert order_by(np.array([2**64, 2**64], object)).tolist() == [0, 1]
