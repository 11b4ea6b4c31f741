"""Seeds of random cases: a few in the quick lane, more in the slow one, all where that is asked."""

from __future__ import annotations

import os
from typing import Any

import pytest

MOST_IN_LANE = 4
"""Cases of a test in the slow lane, at most; `just all-seeds` runs all."""


def seeds(count: int, quick: int) -> list[Any]:
    """Return the parameters 0, 1, ...; those from ``quick`` on are for the slow lane."""
    if "ALL_SEEDS" not in os.environ:
        count = max(quick, min(count, MOST_IN_LANE))
    return [*range(quick), *(pytest.param(n, marks=pytest.mark.slow) for n in range(quick, count))]
