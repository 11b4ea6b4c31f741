"""Numbers as the page reads them."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from rightofway.metrics import Wait

__all__ = ["differences", "wait_row"]


def differences(numbers: Iterable[int]) -> list[int]:
    """Return first differences: ``[3, 4, 6]`` is ``[3, 1, 2]``."""
    found: list[int] = np.diff(np.fromiter(numbers, np.int64), prepend=0).tolist()
    return found


def wait_row(wait: Wait) -> list[int | None]:
    """Return a wait as a row without names."""
    return [wait.robot, wait.vertex, wait.tick, wait.ticks, wait.towards, wait.for_robot]
