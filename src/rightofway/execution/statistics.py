"""Statistics of many runs: collisions, deadlocks, lateness and its sources."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rightofway.model import NEVER, ExecutionTrace, Plan, VertexId
from rightofway.precedence import ActionDependencyGraph, RunBatch


@dataclass(frozen=True, slots=True, kw_only=True)
class Quantiles:
    """Mean, quantiles and maximum of a quantity over many runs [ticks].

    Attributes
    ----------
    mean, median, p90, p95, max
        None if there is no value at all.
    """

    mean: float | None
    median: float | None
    p90: float | None
    p95: float | None
    max: int | None

    @classmethod
    def of(cls, values: NDArray[np.int64]) -> Quantiles:
        """Return the quantiles of values; int64[K]."""
        if not values.size:
            return cls(mean=None, median=None, p90=None, p95=None, max=None)
        median, p90, p95 = np.percentile(values, [50, 90, 95]).tolist()
        mean = round(float(values.mean()), 6)
        return cls(mean=mean, median=median, p90=p90, p95=p95, max=int(values.max()))


@dataclass(frozen=True, slots=True, kw_only=True)
class Collisions:
    """Collisions of all runs.

    Attributes
    ----------
    runs
        Number of runs with any.
    vertex, headway, swap
        Pairs of visits to one vertex that overlap, pairs that follow each other too soon, and pairs
        of robots that exchange vertices.
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
        """Number of all."""
        return self.vertex + self.headway + self.swap

    @classmethod
    def of(cls, counts: NDArray[np.int64]) -> Collisions:
        """Return the sums of the counts of each run; int64[K, 4] as in `Execution`."""
        some = counts[:, :3].sum(axis=1) > 0
        vertex, headway, swap = counts[:, :3].sum(axis=0).tolist()
        first = Quantiles.of(counts[some, 3])
        return cls(runs=int(some.sum()), vertex=vertex, headway=headway, swap=swap, first=first)


@dataclass(frozen=True, slots=True, kw_only=True)
class Source:
    """Lateness that began with one robot at one vertex.

    Attributes
    ----------
    robot
        The robot that took longer than planned.
    vertex
        Where it was, or where it drove away from.
    own, of_others
        Lateness of the robot itself, and of others that waited for it; mean per run [ticks].
    """

    robot: int
    vertex: VertexId
    own: float
    of_others: float


@dataclass(frozen=True, slots=True, kw_only=True)
class RobotLateness:
    """Lateness of one robot.

    Attributes
    ----------
    quantiles
        Completion time minus planned one, over the runs in which the robot completes [ticks].
    own
        Part of it that began with the robot itself; mean per run [ticks].
    waiting
        Part of it that began with each other robot that it waited for; mean per run [ticks].
    """

    quantiles: Quantiles
    own: float
    waiting: dict[int, float]


@dataclass(frozen=True, slots=True, kw_only=True)
class Lateness:
    """Completion times minus planned ones, of robots that complete.

    Attributes
    ----------
    all
        Over all robots and runs [ticks].
    robots
        Of each robot.
    flowtime, makespan
        Of the fleet, over the runs in which all robots complete [ticks].
    sources
        Where lateness began, the largest first.
    """

    all: Quantiles
    robots: tuple[RobotLateness, ...]
    flowtime: Quantiles
    makespan: Quantiles
    sources: tuple[Source, ...]

    @classmethod
    def of(cls, adg: ActionDependencyGraph, batch: RunBatch) -> Lateness:
        """Return the lateness of runs against the planned times of a graph."""
        ends = adg.first_visit[1:] - 1
        planned = adg.planned[ends] + adg.dwell[ends]
        completion, runs = batch.completion, len(batch.completion)
        done = completion < NEVER
        late = completion - planned
        everybody = completion[done.all(axis=1)]
        own = np.add.reduceat(batch.own, adg.first_visit[:-1]).tolist()
        waiting: list[Counter[int]] = [Counter() for _ in own]
        for robot, other, ticks in batch.between.tolist():
            waiting[robot][other] += ticks
        robots = tuple(
            RobotLateness(
                quantiles=Quantiles.of(late[done[:, robot], robot]),
                own=round(own[robot] / runs, 6),
                waiting={k: round(ticks / runs, 6) for k, ticks in waiting[robot].most_common()},
            )
            for robot in range(len(own))
        )
        return cls(
            all=Quantiles.of(late[done]),
            robots=robots,
            flowtime=Quantiles.of(everybody.sum(axis=1) - planned.sum()),
            makespan=Quantiles.of(everybody.max(axis=1, initial=0) - planned.max()),
            sources=_sources(adg, batch),
        )


def _sources(adg: ActionDependencyGraph, batch: RunBatch) -> tuple[Source, ...]:
    """Return the sources of lateness: sums over the visits of one robot at one vertex."""
    own, of_others = Counter[tuple[int, int]](), Counter[tuple[int, int]]()
    for visit in np.flatnonzero(batch.own + batch.of_others).tolist():
        place = adg.robot_of(visit), int(adg.vertex[visit])
        own[place] += int(batch.own[visit])
        of_others[place] += int(batch.of_others[visit])
    total, runs = own + of_others, len(batch.completion)
    return tuple(
        Source(
            robot=place[0],
            vertex=VertexId(place[1]),
            own=round(own[place] / runs, 6),
            of_others=round(of_others[place] / runs, 6),
        )
        for place in sorted(total, key=lambda place: (-total[place], place))
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class PolicyGain:
    """How much earlier a fleet is than with the rights of way of the plan, in the same runs.

    Attributes
    ----------
    runs
        Runs in which all robots complete both ways; only these are compared.
    earlier, later
        Runs in which the fleet is earlier, and later.
    flowtime
        By how much earlier, negative where later [ticks].
    """

    runs: int
    earlier: int
    later: int
    flowtime: Quantiles

    @classmethod
    def of(cls, kept: NDArray[np.int64], changed: NDArray[np.int64]) -> PolicyGain:
        """Return the gain from completion times without and with changes; int64[K, R]."""
        both = ((changed < NEVER) & (kept < NEVER)).all(axis=1)
        gain = kept[both].sum(axis=1) - changed[both].sum(axis=1)
        earlier, later = int((gain > 0).sum()), int((gain < 0).sum())
        return cls(runs=len(gain), earlier=earlier, later=later, flowtime=Quantiles.of(gain))


def joined(batches: Sequence[RunBatch]) -> RunBatch:
    """Return the runs of several batches of one plan as one batch."""
    summed = {"own", "of_others"}
    columns = zip(RunBatch._fields, zip(*batches, strict=True), strict=True)
    return RunBatch(*(sum(each) if k in summed else np.concatenate(each) for k, each in columns))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Outcome:
    """Result of executing a plan many times.

    Attributes
    ----------
    plan
        The plan.
    runs, seed
        Number of runs, and the seed of their delays.
    delays
        The causes of delay, as they were written.
    by_right_of_way, by_clock
        Collisions.
    deadlocks
        Runs in which robots wait for each other for ever.
    broken
        Robots that broke down before they completed, over all runs.
    stranded
        Robots that wait for ever for a broken one, over all runs.
    cut_off
        Robots that replanning did not bring to all their places, over all runs.
    switches, replans
        How often rights of way were switched, and how often the rest was replanned.
    gain
        What switching and replanning gained; None where neither was asked for.
    lateness
        By right of way.
    completion
        When each robot completed in each run, -1 for never [ticks]; int64[K, R].
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
    gain: PolicyGain | None = None
    lateness: Lateness
    completion: NDArray[np.int64]
    _trace: Callable[[int], ExecutionTrace] = field(repr=False)

    @property
    def collisions(self) -> int:
        """Collisions by right of way; there must be none."""
        return self.by_right_of_way.total

    def trace(self, run: int = 0) -> ExecutionTrace:
        """Return where robots were in one run by right of way, and how long everything took.

        Parameters
        ----------
        run
            Its number, from 0.

        Raises
        ------
        IndexError
            If there is no such run.

        Notes
        -----
        The judge computes with planned durations: robots that are early are too fast for it, and
        where robots book ahead it assumes other bookings. Else it finds no fault in the tracks.
        """
        if not 0 <= run < self.runs:
            raise IndexError(f"run {run} is not among the {self.runs} runs (0 is the first)")
        return self._trace(run)

    def typical(self) -> int:
        """Return the median run, ordered by the number of robots that complete, then flowtime."""
        never = (self.completion < 0).sum(axis=1)
        flowtime = np.where(self.completion < 0, 0, self.completion).sum(axis=1)
        return int(np.lexsort((flowtime, never))[(self.runs - 1) // 2])

    def as_dict(self) -> dict[str, Any]:
        """Return everything but the single runs, as plain data for JSON; times in ticks."""
        late, names = self.lateness, [robot.name for robot in self.plan.scenario.robots]
        place = self.plan.scenario.roadmap.name
        return {
            "runs": self.runs,
            "collisions": self.collisions,
            "deadlocks": self.deadlocks,
            "lateness": {
                **asdict(late.all),
                "flowtime": asdict(late.flowtime),
                "makespan": asdict(late.makespan),
                "robots": [
                    {
                        "name": name,
                        **asdict(robot.quantiles),
                        "own": robot.own,
                        "waiting": {names[other]: ticks for other, ticks in robot.waiting.items()},
                    }
                    for name, robot in zip(names, late.robots, strict=True)
                ],
                "sources": [
                    {**asdict(source), "robot": names[source.robot], "vertex": place(source.vertex)}
                    for source in late.sources
                ],
            },
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
            "won": asdict(self.gain) if self.gain else None,
            "seed": self.seed,
            "delays": list(self.delays),
            "tick": str(self.plan.scenario.problem.clock.tick),
        }
