"""Counts every fault, words only the earliest: a bad plan of a large fleet has millions."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rightofway.check.report import Fault, FaultKind, Report

__all__ = ["Sieve"]


class Sieve:
    """Takes faults in any order and keeps the earliest.

    Parameters
    ----------
    limit
        How many to keep.
    """

    def __init__(self, limit: int) -> None:
        self._limit = limit
        self._counts: Counter[FaultKind] = Counter()
        self._kept: list[Fault] = []

    def add(self, fault: Fault) -> None:
        """Take one fault."""
        self._counts[fault.kind] += 1
        self._kept.append(fault)

    def add_all(
        self,
        kind: FaultKind,
        ticks: NDArray[Any],
        robots: tuple[NDArray[Any], ...],
        word: Callable[[int], Fault],
    ) -> None:
        """Take many faults of a kind.

        Parameters
        ----------
        kind
            Their kind.
        ticks
            When they begin [ticks]; shape (n,).
        robots
            Their robots, as in `Fault`, one array of shape (n,) for each place in the tuple.
        word
            Makes the fault of a position in these arrays; called for few.
        """
        if len(ticks):
            self._counts[kind] += len(ticks)
            earliest = np.lexsort((*reversed(robots), ticks))[: self._limit]
            self._kept.extend(word(int(position)) for position in earliest)

    def report(self) -> Report:
        """Return the judgement on everything taken so far."""
        self._kept.sort(key=lambda fault: (fault.tick, fault.robots, fault.kind, fault.vertices))
        return Report(
            faults=tuple(self._kept[: self._limit]), counts=dict(sorted(self._counts.items()))
        )
