"""Seeds of random cases: a few in the quick lane, the others in the slow one."""

from __future__ import annotations

from typing import Any

import pytest


def seeds(count: int, quick: int) -> list[Any]:
    """Return the parameters 0, 1, ...; those from ``quick`` on are for the slow lane."""
    return [*range(quick), *(pytest.param(n, marks=pytest.mark.slow) for n in range(quick, count))]
