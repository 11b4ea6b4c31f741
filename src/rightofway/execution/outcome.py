"""What came of many runs: collisions, deadlocks, lateness and where that comes from."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict, dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rightofway.model import ExecutionTrace, Plan, Track, VertexId

__all__ = [
    "Collisions",
    "Lateness",
    "Outcome",
    "PolicyGain",
    "Quantiles",
    "RobotLateness",
    "Source",
]


@dataclass(frozen=True, slots=True, kw_only=True)
class Quantiles:
    """How a quantity is spread over many runs [ticks].

    Attributes
    ----------
    mean, median, p90, p95, max
        None where there is no value at all.
    """

    mean: float | None
    median: float | None
    p90: float | None
    p95: float | None
    max: int | None

    @classmethod
    def of(cls, values: NDArray[np.int64]) -> Quantiles:
        """Return how values are spread."""
        if not values.size:
            return cls(mean=None, median=None, p90=None, p95=None, max=None)
        median, p90, p95 = np.percentile(values, [50, 90, 95]).tolist()
        mean = round(float(values.mean()), 6)
        return cls(mean=mean, median=median, p90=p90, p95=p95, max=int(values.max()))


@dataclass(frozen=True, slots=True, kw_only=True)
class Collisions:
    """What collided in all runs.

    Attributes
    ----------
    runs
        In how many runs anything did.
    vertex, headway, swap
        Pairs of visits to one vertex that overlap, that come too soon after each other, and robots
        that exchange vertices.
    first
        When the first of a run happened, over the runs with any [ticks].
    """

    runs: int
    vertex: int
    headway: int
    swap: int
    first: Quantiles

    @property
    def total(self) -> int:
        """All of them."""
        return self.vertex + self.headway + self.swap

    @classmethod
    def of(cls, counts: NDArray[np.int64]) -> Collisions:
        """Return what these counts of each run come to; shape (K, 4)."""
        some = counts[:, :3].sum(axis=1) > 0
        vertex, headway, swap = counts[:, :3].sum(axis=0).tolist()
        first = Quantiles.of(counts[some, 3])
        return cls(runs=int(some.sum()), vertex=vertex, headway=headway, swap=swap, first=first)


@dataclass(frozen=True, slots=True, kw_only=True)
class Source:
    """Where lateness began: with a robot, at a vertex.

    Attributes
    ----------
    robot
        Who took longer than planned.
    vertex
        Where, or on the way from there.
    own, of_others
        How late that made the robot itself, and others who waited for it; mean ticks a run.
    """

    robot: int
    vertex: VertexId
    own: float
    of_others: float


@dataclass(frozen=True, slots=True, kw_only=True)
class RobotLateness:
    """How late one robot is.

    Attributes
    ----------
    spread
        Its completion time less the planned one, over the runs in which it completes [ticks].
    own
        How much of it began with the robot itself; mean ticks a run.
    waiting
        How much of it began with each other robot that it waited for; mean ticks a run.
    """

    spread: Quantiles
    own: float
    waiting: dict[int, float]


@dataclass(frozen=True, slots=True, kw_only=True)
class Lateness:
    """Completion times against the plan; of those who complete.

    Attributes
    ----------
    all
        Of any robot in any run [ticks].
    robots
        Of each.
    flowtime, makespan
        Of the fleet, in the runs in which everybody completes [ticks].
    sources
        Where it began, the most first.
    """

    all: Quantiles
    robots: tuple[RobotLateness, ...]
    flowtime: Quantiles
    makespan: Quantiles
    sources: tuple[Source, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class PolicyGain:
    """How much earlier a fleet is than by the rights of way of the plan, in the same runs.

    Attributes
    ----------
    runs
        In how many runs everybody completes both ways; only these are compared.
    earlier, later
        In how many of them the fleet is earlier, and later.
    flowtime
        By how much earlier, negative where later [ticks].
    """

    runs: int
    earlier: int
    later: int
    flowtime: Quantiles

    @classmethod
    def of(cls, won: NDArray[np.int64]) -> PolicyGain:
        """Return what these runs have won."""
        earlier, later = int((won > 0).sum()), int((won < 0).sum())
        return cls(runs=len(won), earlier=earlier, later=later, flowtime=Quantiles.of(won))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Outcome:
    """What came of many runs of a plan.

    Attributes
    ----------
    plan
        What was run.
    runs, seed
        How many runs, and what their delays were drawn from.
    delays
        What made robots late, as it was written.
    by_right_of_way, by_clock
        What collided.
    deadlocks
        Runs in which robots wait for each other for ever.
    broken
        Robots that broke down for ever, over all runs.
    stranded
        Robots that wait for ever for one that broke down, over all runs.
    cut_off
        Robots that could not be brought to all their places any more, over all runs that were
        planned anew.
    switches, replans
        How often a right of way was switched, and how often what was left was planned anew.
    won
        What switching and planning anew have won; None where neither was asked for.
    lateness
        By right of way.
    completion
        When each robot completed in each run, -1 for never [ticks]; int64, shape (runs, R).
    """

    plan: Plan
    runs: int
    seed: int
    delays: tuple[str, ...]
    by_right_of_way: Collisions
    by_clock: Collisions
    deadlocks: int
    broken: int
    stranded: int
    cut_off: int = 0
    switches: int = 0
    replans: int = 0
    won: PolicyGain | None = None
    lateness: Lateness
    completion: NDArray[np.int64]
    _actual: Callable[[int], ExecutionTrace] = field(repr=False)

    @property
    def collisions(self) -> int:
        """Collisions by right of way; there must be none."""
        return self.by_right_of_way.total

    def actual(self, run: int = 0) -> tuple[Track, ...]:
        """Return what really happened in one run, by right of way.

        Returns
        -------
        tuple of Track
            For each robot where it was, when; visits that never began are left out. Without
            switching or planning anew, the vertices are those of the plan.

        Raises
        ------
        IndexError
            If there was no such run.

        Notes
        -----
        The judge reckons with planned durations: robots that are early are too fast for it, and
        where they book ahead it thinks that they book sooner than they do. Else it finds no fault.
        """
        return self.happened(run).tracks

    def happened(self, run: int = 0) -> ExecutionTrace:
        """Return the same with what took how long, as pages show it.

        Raises
        ------
        IndexError
            If there was no such run.
        """
        if not 0 <= run < self.runs:
            raise IndexError(f"run {run} is not among the {self.runs} runs (0 is the first)")
        return self._actual(run)

    def typical(self) -> int:
        """Return the run in the middle of all, by who never completed, then by flowtime."""
        never = (self.completion < 0).sum(axis=1)
        flowtime = np.where(self.completion < 0, 0, self.completion).sum(axis=1)
        return int(np.lexsort((flowtime, never))[(self.runs - 1) // 2])

    def as_dict(self) -> dict[str, Any]:
        """Return everything but the single runs, by name; times in ticks."""
        return {
            "runs": self.runs,
            "collisions": self.collisions,
            "deadlocks": self.deadlocks,
            "lateness": self._lateness(),
            "by_clock": {
                "runs_with_collisions": self.by_clock.runs,
                "share_of_runs": round(self.by_clock.runs / self.runs, 6),
                "collisions": self.by_clock.total,
                "collisions_per_run": round(self.by_clock.total / self.runs, 6),
                "vertex": self.by_clock.vertex,
                "headway": self.by_clock.headway,
                "swap": self.by_clock.swap,
                "first": asdict(self.by_clock.first),
            },
            "broken": self.broken,
            "stranded": self.stranded,
            "cut_off": self.cut_off,
            "switches": self.switches,
            "replans": self.replans,
            "won": asdict(self.won) if self.won else None,
            "seed": self.seed,
            "delays": list(self.delays),
            "tick": str(self.plan.scenario.problem.clock.tick),
        }

    def _lateness(self) -> dict[str, Any]:
        late, names = self.lateness, [robot.name for robot in self.plan.scenario.robots]
        place = self.plan.scenario.roadmap.name
        return {
            **asdict(late.all),
            "flowtime": asdict(late.flowtime),
            "makespan": asdict(late.makespan),
            "robots": [
                {
                    "name": name,
                    **asdict(robot.spread),
                    "own": robot.own,
                    "waiting": {names[other]: ticks for other, ticks in robot.waiting.items()},
                }
                for name, robot in zip(names, late.robots, strict=True)
            ],
            "sources": [
                {**asdict(source), "robot": names[source.robot], "vertex": place(source.vertex)}
                for source in late.sources
            ],
        }
