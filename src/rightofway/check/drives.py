"""One robot from one visit to the next: along an edge, no faster than it can, forward in time."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from rightofway.check.report import Fault, FaultKind
from rightofway.check.sieve import Sieve
from rightofway.check.visits import Visits
from rightofway.check.words import Words, ticks
from rightofway.model import Tick, VertexId

__all__ = ["judge_drives"]


def judge_drives(visits: Visits, words: Words, sieve: Sieve) -> None:
    """Find unknown vertices, jumps, drives that are too fast and times that go backwards."""
    stay = visits.leave - visits.enter
    moves = ~visits.last
    joined = visits.edge >= 0
    both_known = visits.known & np.roll(visits.known, -1)
    judgement = _Drives(visits, words, sieve)
    judgement.take("unknown vertex", ~visits.known, judgement.unknown)
    judgement.take("backwards", moves & (stay < 0), judgement.backwards)
    judgement.take("jump", moves & both_known & ~joined, judgement.jump)
    judgement.take("too fast", joined & (stay >= 0) & (stay < visits.drive), judgement.too_fast)


class _Drives:
    """Words what is wrong with a visit or the move that ends it."""

    def __init__(self, visits: Visits, words: Words, sieve: Sieve) -> None:
        self._visits, self._words, self._sieve = visits, words, sieve

    def take(self, kind: FaultKind, broken: NDArray[np.bool_], word: Callable[[int], str]) -> None:
        visits, where = self._visits, np.flatnonzero(broken)
        # An unknown vertex is wrong as soon as it is entered, a move at the instant it is made.
        times, ends = (visits.enter, 1) if kind == "unknown vertex" else (visits.leave, 2)

        def fault(position: int) -> Fault:
            visit = int(where[position])
            return Fault(
                kind=kind,
                robots=(int(visits.robot[visit]),),
                vertices=tuple(map(VertexId, visits.vertex[visit : visit + ends].tolist())),
                tick=Tick(int(times[visit])),
                message=word(visit),
            )

        self._sieve.add_all(kind, times[where], (visits.robot[where],), fault)

    def unknown(self, visit: int) -> str:
        n_vertices = self._words.scenario.roadmap.n_vertices
        return (
            f"{self._robot(visit)} enters {self._vertex(visit)}, which is not on the roadmap"
            f" (its vertices are 0 to {n_vertices - 1})"
        )

    def backwards(self, visit: int) -> str:
        enter = self._visits.enter[visit]
        return (
            f"{self._robot(visit)} enters {self._vertex(visit)} at tick {enter}, but"
            f" {self._vertex(visit + 1)} after it at tick {self._visits.leave[visit]}"
            f" (later visits have later ticks)"
        )

    def jump(self, visit: int) -> str:
        tail, head = self._vertex(visit), self._vertex(visit + 1)
        if tail == head:
            return f"{self._robot(visit)} enters {tail} twice in a row (make it one visit)"
        return f"{self._robot(visit)} goes from {tail} to {head}, no edge leads there (use edges)"

    def too_fast(self, visit: int) -> str:
        visits = self._visits
        stay, drive = visits.leave[visit] - visits.enter[visit], visits.drive[visit]
        return (
            f"{self._robot(visit)} drives from {self._vertex(visit)} to {self._vertex(visit + 1)}"
            f" in {ticks(stay)}, it needs {drive} (enter at tick {visits.enter[visit] + drive}"
            f" or later)"
        )

    def _robot(self, visit: int) -> str:
        return self._words.robot(int(self._visits.robot[visit]))

    def _vertex(self, visit: int) -> str:
        return self._words.vertex(int(self._visits.vertex[visit]))
