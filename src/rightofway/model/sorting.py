"""Sorting millions of rows by several columns."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

MOST_BITS = 63
"""Bits of a key; NumPy sorts one integer a row many times as fast as several."""


def order_by(*columns: NDArray[Any]) -> NDArray[np.int64]:
    """Return the indices that sort rows by the first column, then by the second, and so on.

    Returns
    -------
    ndarray
        int64, shape (n,). Rows that are equal in all columns stay in their order.

    Notes
    -----
    The columns and the index of the row are packed into one integer where they fit.
    """
    n_rows = len(columns[0])
    if n_rows == 0:
        return np.zeros(0, np.int64)
    lows = [int(column.min()) for column in columns]
    widths = [
        (int(column.max()) - low).bit_length() for column, low in zip(columns, lows, strict=True)
    ]
    index_width = n_rows.bit_length()
    if sum(widths) + index_width > MOST_BITS:
        return np.lexsort(columns[::-1])
    keys = np.zeros(n_rows, np.int64)
    for column, low, width in zip(columns, lows, widths, strict=True):
        keys <<= width
        exact = column if column.dtype == object else column.astype(np.int64)
        keys |= (exact - low).astype(np.int64)  # Python integers may be too large before this
    keys <<= index_width
    keys |= np.arange(n_rows)
    keys.sort()
    return keys & ((1 << index_width) - 1)
