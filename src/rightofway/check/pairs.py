"""All pairs of a great many ranges, a bounded number of them in memory at a time."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

__all__ = ["Indices", "pairs"]

Indices = NDArray[np.int64]

CHUNK = 2**20
"""About how many pairs are made together."""


def pairs(first: Indices, after: Indices) -> Iterator[tuple[Indices, Indices]]:
    """Yield all (i, j) with ``first[i] <= j < after[i]``, some at a time."""
    counts = np.maximum(after - first, 0)
    totals = np.cumsum(counts)
    begin = 0
    while begin < len(counts):
        before = totals[begin] - counts[begin]
        end = max(int(np.searchsorted(totals, before + CHUNK)), begin + 1)
        here = counts[begin:end]
        i = np.repeat(np.arange(begin, end), here)
        rank = np.arange(len(i)) - np.repeat(totals[begin:end] - here - before, here)
        yield i, first[i] + rank
        begin = end
