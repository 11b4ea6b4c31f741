"""Adding up runs."""

from __future__ import annotations

from collections import defaultdict

import numpy as np
from numpy.typing import NDArray

from rightofway.execution.outcome import Lateness, PolicyGain, Quantiles, RobotLateness, Source
from rightofway.model import NEVER, VertexId
from rightofway.precedence import ActionDependencyGraph, RunBatch

__all__ = ["Tally"]


class Tally:
    """What came of the runs so far.

    Parameters
    ----------
    floor
        The plan that they are runs of.
    """

    def __init__(self, floor: ActionDependencyGraph) -> None:
        self._floor = floor
        self._parts: list[RunBatch] = []
        self._kept: list[NDArray[np.int64]] = []
        self.deadlocks = self.cut_off = self.switches = self.replans = 0
        ends = floor.first_visit[1:] - 1
        self._planned = floor.planned[ends] + floor.dwell[ends]

    def add(
        self,
        runs: RunBatch,
        *,
        kept: NDArray[np.int64] | None = None,
        deadlocks: int = 0,
        cut_off: int = 0,
        switches: int = 0,
        replans: int = 0,
    ) -> None:
        """Count more runs, and in all of them deadlocks, robots cut off, switches and new plans.

        Of runs that were cared for, also when robots would have completed otherwise.
        """
        self._parts.append(runs)
        if kept is not None:
            self._kept.append(kept)
        self.deadlocks += deadlocks
        self.cut_off += cut_off
        self.switches += switches
        self.replans += replans

    @property
    def runs(self) -> int:
        """How many there are."""
        return sum(len(part.completion) for part in self._parts)

    @property
    def completion(self) -> NDArray[np.int64]:
        """When each robot completed in each run, `NEVER` where it did not [ticks]."""
        return np.concatenate([part.completion for part in self._parts])

    @property
    def is_broken(self) -> NDArray[np.bool_]:
        """Whether each robot stands still for ever in each run."""
        return np.concatenate([part.is_broken for part in self._parts]).astype(bool)

    @property
    def by_right_of_way(self) -> NDArray[np.int64]:
        """Collisions of each run, as the kernel counts them."""
        return np.concatenate([part.by_right_of_way for part in self._parts])

    @property
    def by_clock(self) -> NDArray[np.int64]:
        """The same by the clock."""
        return np.concatenate([part.by_clock for part in self._parts])

    def won(self) -> PolicyGain | None:
        """Return how much earlier the fleet was than without care; None if there was none."""
        if not self._kept:
            return None
        cared, kept = self.completion, np.concatenate(self._kept)
        both = ((cared < NEVER) & (kept < NEVER)).all(axis=1)
        return PolicyGain.of(kept[both].sum(axis=1) - cared[both].sum(axis=1))

    def lateness(self) -> Lateness:
        """Return how late everybody was, and where that came from."""
        completion = self.completion
        done = completion < NEVER
        late = completion - self._planned
        everybody = completion[done.all(axis=1)]
        return Lateness(
            all=Quantiles.of(late[done]),
            robots=self._robots(late, done),
            flowtime=Quantiles.of(everybody.sum(axis=1) - self._planned.sum()),
            makespan=Quantiles.of(everybody.max(axis=1, initial=0) - self._planned.max()),
            sources=self._sources(),
        )

    def _robots(
        self, late: NDArray[np.int64], done: NDArray[np.bool_]
    ) -> tuple[RobotLateness, ...]:
        own = np.add.reduceat(self._sum("own"), self._floor.first_visit[:-1])
        waiting: list[dict[int, float]] = [defaultdict(float) for _ in own]
        for part in self._parts:
            for robot, other, ticks in part.between.tolist():
                waiting[robot][other] += ticks
        return tuple(
            RobotLateness(
                spread=Quantiles.of(late[done[:, robot], robot]),
                own=self._mean(int(ticks)),
                waiting={
                    other: self._mean(waiting[robot][other])
                    for other in sorted(waiting[robot], key=lambda one: -waiting[robot][one])
                },
            )
            for robot, ticks in enumerate(own)
        )

    def _sources(self) -> tuple[Source, ...]:
        own, of_others = self._sum("own"), self._sum("of_others")
        found: dict[tuple[int, int], list[int]] = defaultdict(lambda: [0, 0])
        for visit in np.flatnonzero(own + of_others).tolist():
            place = self._floor.robot_of(visit), int(self._floor.vertex[visit])
            found[place][0] += int(own[visit])
            found[place][1] += int(of_others[visit])
        return tuple(
            Source(
                robot=robot,
                vertex=VertexId(vertex),
                own=self._mean(ticks),
                of_others=self._mean(others),
            )
            for (robot, vertex), (ticks, others) in sorted(
                found.items(), key=lambda item: (-sum(item[1]), item[0])
            )
        )

    def _sum(self, name: str) -> NDArray[np.int64]:
        total: NDArray[np.int64] = sum(getattr(part, name) for part in self._parts)
        return total

    def _mean(self, ticks: float) -> float:
        return round(ticks / self.runs, 6)
