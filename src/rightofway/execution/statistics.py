"""Statistics of many runs: collisions, deadlocks, lateness and its sources."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, field
from numbers import Integral
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rightofway.errors import InputError, quote
from rightofway.kinds.numbers import format_number
from rightofway.model import NEVER, ExecutionTrace, Plan
from rightofway.precedence import ActionDependencyGraph, RunBatch
from rightofway.site import VertexId


@dataclass(frozen=True, slots=True, kw_only=True)
class Quantiles:
    """Mean, quantiles and maximum of a quantity over many runs [ticks].

    Attributes
    ----------
    mean, median, p90, p95, max
        None without values.
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
        median, p90, p95 = np.percentile(values, [50, 90, 95]).round(6).tolist()
        mean = round(float(values.mean()), 6)
        return cls(mean=mean, median=median, p90=p90, p95=p95, max=int(values.max()))


@dataclass(frozen=True, slots=True, kw_only=True)
class Collisions:
    """Collisions of all runs.

    Attributes
    ----------
    runs
        Number of runs with collisions.
    vertex, headway, swap
        Pairs of visits to one vertex that overlap, pairs with less than the headway between them,
        and pairs of robots that exchange vertices.
    first
        Time of the first collision, over the runs with collisions [ticks].
    """

    runs: int
    vertex: int
    headway: int
    swap: int
    first: Quantiles

    @property
    def total(self) -> int:
        """Number of all collisions."""
        return self.vertex + self.headway + self.swap

    @classmethod
    def of(cls, counts: NDArray[np.int64]) -> Collisions:
        """Return the sums over runs of ``counts``; int64[K, 4] as in `Execution`."""
        some = counts[:, :3].sum(axis=1) > 0
        vertex, headway, swap = counts[:, :3].sum(axis=0).tolist()
        first = Quantiles.of(counts[some, 3])
        return cls(runs=int(some.sum()), vertex=vertex, headway=headway, swap=swap, first=first)


@dataclass(frozen=True, slots=True, kw_only=True)
class LatenessSource:
    """Lateness that began with one robot at one vertex.

    Attributes
    ----------
    robot
        The robot that took longer than planned.
    vertex
        The vertex where it stayed, or from which it drove.
    own, of_others
        Lateness of this robot, and of robots that waited for it; mean per run [ticks].
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
        Completion minus planned completion, over runs in which the robot completes [ticks].
    own
        Lateness that began with this robot; mean per run [ticks].
    waiting
        Lateness that began with each other robot that it waited for; mean per run [ticks].
    """

    quantiles: Quantiles
    own: float
    waiting: dict[int, float]


@dataclass(frozen=True, slots=True, kw_only=True)
class Lateness:
    """Completion times minus planned completion times, of robots that complete.

    Attributes
    ----------
    all
        Lateness over all robots and runs [ticks].
    robots
        Lateness of each robot.
    flowtime, makespan
        Lateness of the fleet, over runs in which all robots complete [ticks].
    sources
        Sources of lateness, largest first.
    """

    all: Quantiles
    robots: tuple[RobotLateness, ...]
    flowtime: Quantiles
    makespan: Quantiles
    sources: tuple[LatenessSource, ...]

    @classmethod
    def of(cls, adg: ActionDependencyGraph, batch: RunBatch) -> Lateness:
        """Return the lateness of runs against the planned times of a graph."""
        planned = adg.get_planned_completions()
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
            sources=_sum_sources(adg, batch),
        )


def _sum_sources(adg: ActionDependencyGraph, batch: RunBatch) -> tuple[LatenessSource, ...]:
    """Return the sources of lateness: sums over the visits of one robot at one vertex."""
    own, of_others = Counter[tuple[int, int]](), Counter[tuple[int, int]]()
    for visit in np.flatnonzero(batch.own + batch.of_others).tolist():
        place = adg.get_robot(visit), int(adg.vertex[visit])
        own[place] += int(batch.own[visit])
        of_others[place] += int(batch.of_others[visit])
    total, runs = own + of_others, len(batch.completion)
    return tuple(
        LatenessSource(
            robot=place[0],
            vertex=VertexId(place[1]),
            own=round(own[place] / runs, 6),
            of_others=round(of_others[place] / runs, 6),
        )
        for place in sorted(total, key=lambda place: (-total[place], place))
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class PolicyGain:
    """The gain of switching and replanning compared with the unchanged plan, in the same runs.

    Attributes
    ----------
    runs
        Runs compared: all robots complete with and without changes.
    earlier, later
        Runs with a lower, and with a higher flowtime.
    flowtime
        Decrease of flowtime, negative for an increase [ticks].
    """

    runs: int
    earlier: int
    later: int
    flowtime: Quantiles

    @classmethod
    def of(cls, unchanged: NDArray[np.int64], changed: NDArray[np.int64]) -> PolicyGain:
        """Return the gain from completion times without and with changes; int64[K, R]."""
        both = ((changed < NEVER) & (unchanged < NEVER)).all(axis=1)
        gain = unchanged[both].sum(axis=1) - changed[both].sum(axis=1)
        earlier, later = int((gain > 0).sum()), int((gain < 0).sum())
        return cls(runs=len(gain), earlier=earlier, later=later, flowtime=Quantiles.of(gain))


def join_batches(batches: Sequence[RunBatch]) -> RunBatch:
    """Return the runs of several batches of one plan as one batch."""
    summed = {"own", "of_others"}
    columns = zip(RunBatch._fields, zip(*batches, strict=True), strict=True)
    return RunBatch(
        *(sum(arrays) if k in summed else np.concatenate(arrays) for k, arrays in columns)
    )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SimulationResult:
    """Result of executing a plan many times.

    Attributes
    ----------
    plan
        The plan.
    runs, seed
        Number of runs, and the seed of their delays.
    delays
        The causes of delay, in their notation.
    by_right_of_way, by_clock
        Collisions of all runs.
    deadlocks
        Runs with a deadlock.
    broken
        Robots that broke down before completion, over all runs.
    stranded
        Robots that wait permanently for a broken robot or before a closure, over all runs.
    caught
        Robots that are at a place while it is closed, over all runs.
    cut_off
        Robots that replanning did not bring to all their places, over all runs.
    switches, replans
        Number of reorderings, and of replannings.
    gain
        Gain of switching and replanning; None without both.
    lateness
        Lateness by right of way.
    completion
        Completion time per run and robot, -1 for never [ticks]; int64[K, R].
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
    caught: int = 0
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
        """Return tracks and durations of one run by right of way.

        Parameters
        ----------
        run
            The run's number, from 0.

        Raises
        ------
        InputError
            If ``run`` is out of range.

        Notes
        -----
        The judge uses planned durations: it reports early robots as too fast, and with booking
        ahead it assumes different bookings. Otherwise the tracks have no faults.
        """
        if not isinstance(run, Integral) or not 0 <= run < self.runs:
            message = f"run {quote(run)} is not among the {self.runs} runs (0 is the first)"
            raise InputError.at("run", message)
        return self._trace(int(run))

    def find_typical_run(self) -> int:
        """Return the median run, ordered by the number of robots that complete, then flowtime."""
        return int(self.rank_runs()[(self.runs - 1) // 2])

    def find_worst_run(self) -> int:
        """Return the last run in the same order."""
        return int(self.rank_runs()[-1])

    def rank_runs(self) -> NDArray[np.intp]:
        """Return the runs from the best to the worst: by robots that complete, then flowtime."""
        never = (self.completion < 0).sum(axis=1)
        flowtime = np.where(self.completion < 0, 0, self.completion).sum(axis=1)
        return np.lexsort((flowtime, never))

    def as_dict(self) -> dict[str, Any]:
        """Return all results except single runs, as plain data for JSON; times in ticks."""
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
            **({"caught": self.caught} if self.plan.scenario.closures else {}),
            "cut_off": self.cut_off,
            "switches": self.switches,
            "replans": self.replans,
            "won": asdict(self.gain) if self.gain else None,
            "seed": self.seed,
            "delays": list(self.delays),
            "tick": format_number(self.plan.scenario.problem.clock.tick),
        }
