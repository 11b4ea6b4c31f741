"""Simulation of many executions of a plan with delays."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rightofway.check import check
from rightofway.errors import InputError
from rightofway.execution.delays import DEFAULT_DELAYS, Delay, delay_plan, make_delayed_graph
from rightofway.execution.monitor import ExecutionMonitor, ExecutionPolicy
from rightofway.execution.statistics import (
    Collisions,
    Lateness,
    PolicyGain,
    SimulationResult,
    join_batches,
)
from rightofway.facts import Fact
from rightofway.kinds.arguments import checks_arguments
from rightofway.kinds.table import SEED, make_whole
from rightofway.model import NEVER, ExecutionTrace, Plan, require_time_limit
from rightofway.planners import Deadline
from rightofway.precedence import ActionDependencyGraph, RunBatch
from rightofway.progress import log_progress

CHUNK = 1 << 20
"""Visits per call of the kernel; time limit and Ctrl-C are checked between calls."""

MOST_RUNS = 10**9
"""More would take years."""


@checks_arguments
def simulate(
    plan: Plan,
    delays: str | Iterable[str] = DEFAULT_DELAYS,
    runs: int = 1000,
    seed: int = 0,
    *,
    switch: bool = False,
    replan: bool = False,
    time_limit: float | None = None,
    keep_runs: bool = False,
    report: Callable[[Fact], None] = log_progress,
) -> SimulationResult:
    """Execute a plan many times with delays: by right of way, and by the clock for comparison.

    Parameters
    ----------
    plan
        A plan that keeps the rules, by any planner or by hand.
    delays
        Causes of delay, for example ``exponential:0.2`` or ``stop:R3@12+30``; several causes in
        a list or separated by commas; see `rightofway.execution.CAUSES`.
        `rightofway.io.load_delays` reads a file of causes.
    runs
        Number of runs.
    seed
        Run k of a seed has the same delays for any number of runs.
    switch
        Whether rights of way are switched during execution if this lowers the expected flowtime.
    replan
        Whether visits that have not begun are replanned during execution: if the fleet has fallen
        behind and this lowers the expected flowtime, after a breakdown, and if a robot that is late
        could not keep its route and its rights of way outside closures.
    time_limit
        After this time, no run and no replanning begins [s]; at least one run is made.
    keep_runs
        Whether an interrupt (Ctrl-C) ends the simulation with the runs that were made, if any.
    report
        Receives sentences on progress.

    Returns
    -------
    SimulationResult
        Collisions, deadlocks, lateness and its sources, single runs.

    Raises
    ------
    InputError
        If the plan has faults, the delays cannot be read, a number is out of range, or a plan with
        jobs would have to change.

    Notes
    -----
    By right of way, a robot enters a vertex after all visits that precede in the plan, at any time.
    In a plan with jobs, a robot begins work when it is there, `earliest` has come, and the jobs in
    `after` have ended; a charge lasts as long as in the plan. `latest` and batteries may be missed.

    Closures are kept by the clock: a robot starts no drive whose bookings would overlap a closure
    if all drives and stays last as planned; robots that are caught in one nevertheless are counted.

    For delays of any length, bookings never overlap, and robots never deadlock, because the plan
    has no deadlock. Collisions and deadlocks are counted nevertheless.
    """
    time_limit = require_time_limit(time_limit)
    judged = check(plan)
    if not judged.ok:
        raise InputError.at("", f"the plan has {judged.summary} (only one without can be run)")
    runs = make_whole(1, MOST_RUNS).read_at("runs", runs)
    seed = SEED.read_at("seed", seed)
    deadline = Deadline.after(time_limit)
    policy = ExecutionPolicy(switch=switch, replan=replan)
    _refuse_changes(plan, policy)
    causes, adg = delay_plan(plan, delays)
    parts: list[_Runs] = []
    traces: dict[int, ExecutionTrace] = {}
    try:
        for some in _run_batches(
            adg, policy, runs=runs, seed=seed, deadline=deadline, traces=traces
        ):
            parts.append(some)
            done = sum(len(part.batch.completion) for part in parts)
            report(Fact("runs done", done=done, runs=runs))
    except KeyboardInterrupt:
        if not (keep_runs and parts):
            raise

    every = join_batches([part.batch for part in parts])
    unchanged = [part.unchanged for part in parts if part.unchanged is not None]
    cut_off = sum(part.cut_off for part in parts)
    is_broken, unfinished = every.is_broken.astype(bool), every.completion == NEVER
    stuck = np.isin(np.arange(len(plan.tracks)), adg.list_deadlocked())
    return SimulationResult(
        plan=plan,
        runs=len(every.completion),
        seed=seed,
        delays=tuple(cause.text for cause in causes),
        by_right_of_way=Collisions.of(every.by_right_of_way),
        by_clock=Collisions.of(every.by_clock),
        deadlocks=len(every.completion) if stuck.any() else sum(part.deadlocks for part in parts),
        broken=int(is_broken.sum()),
        stranded=int((unfinished & ~is_broken & ~stuck).sum()) - cut_off,
        caught=int(every.is_caught.sum()),
        cut_off=cut_off,
        switches=sum(part.switches for part in parts),
        replans=sum(part.replans for part in parts),
        gain=PolicyGain.of(np.concatenate(unchanged), every.completion) if unchanged else None,
        lateness=Lateness.of(adg, every),
        completion=np.where(unfinished, -1, every.completion),
        _trace=_RunReader(plan, causes, policy, seed, traces),
    )


def replay(
    plan: Plan,
    delays: str | Iterable[str] = DEFAULT_DELAYS,
    run: int = 0,
    seed: int = 0,
    *,
    switch: bool = False,
    replan: bool = False,
) -> ExecutionTrace:
    """Execute one run of a simulation, without the others.

    Parameters
    ----------
    plan, delays, seed, switch, replan
        As for `simulate`.
    run
        The number of the run, from 0.

    Raises
    ------
    InputError
        If the delays cannot be read, or a plan with jobs would have to change.
    """
    policy = ExecutionPolicy(switch=switch, replan=replan)
    _refuse_changes(plan, policy)
    _, adg = delay_plan(plan, delays)
    return ExecutionMonitor(adg, policy, seed, run, Deadline()).trace()


def _refuse_changes(plan: Plan, policy: ExecutionPolicy) -> None:
    """Refuse changes during execution for a plan with jobs: forecasts do not know its times."""
    for name in ("switch", "replan"):
        if plan.tours is not None and getattr(policy, name):
            raise InputError.at(name, "is not for plans with jobs (leave it out)")


def _run_batches(
    adg: ActionDependencyGraph,
    policy: ExecutionPolicy,
    *,
    runs: int,
    seed: int,
    deadline: Deadline,
    traces: dict[int, ExecutionTrace],
) -> Iterator[_Runs]:
    """Yield runs, at least one; keep the trace of a first one that the deadline cut short."""
    chunk = 1 if any(policy) else max(CHUNK // len(adg.vertex), 1)
    for first in range(0, runs, chunk):
        batch = adg.make_runs(seed, first, min(chunk, runs - first))
        if any(policy):
            monitor = ExecutionMonitor(adg, policy, seed, first, deadline)
            if deadline.measure_seconds_left() == 0:  # replanning may have been cut short
                if first:
                    return
                traces[first] = monitor.trace()
            yield _Runs.watched(monitor, batch)
        else:
            yield _Runs(batch)
        if deadline.measure_seconds_left() == 0:
            return


class _RunReader:
    """Tracks of single runs: those that were kept, and others executed again.

    It can be pickled, as the result that holds it: the graph, an object of the native core, is
    built when it is first needed.
    """

    def __init__(
        self,
        plan: Plan,
        causes: tuple[Delay, ...],
        policy: ExecutionPolicy,
        seed: int,
        traces: dict[int, ExecutionTrace],
    ) -> None:
        self._given = (plan, causes, policy, seed, traces)

    def __reduce__(self) -> tuple[type[_RunReader], tuple[object, ...]]:
        return _RunReader, self._given

    def __call__(self, run: int) -> ExecutionTrace:
        _, _, policy, seed, traces = self._given
        return traces.get(run) or ExecutionMonitor(self._adg, policy, seed, run, Deadline()).trace()

    @cached_property
    def _adg(self) -> ActionDependencyGraph:
        plan, causes, *_ = self._given
        return make_delayed_graph(plan, causes)


class _Runs(NamedTuple):
    """Some runs, and the changes made in them during execution."""

    batch: RunBatch
    unchanged: NDArray[np.int64] | None = None  # the completion times without changes
    switches: int = 0
    replans: int = 0
    cut_off: int = 0
    deadlocks: int = 0

    @classmethod
    def watched(cls, monitor: ExecutionMonitor, batch: RunBatch) -> _Runs:
        """Return one run with changes; ``batch`` is the same run without."""
        return cls(
            batch=monitor.as_batch(batch),
            unchanged=batch.completion,
            switches=monitor.switches,
            replans=monitor.replans,
            cut_off=len(monitor.cut_off - monitor.lost),
            deadlocks=bool(monitor.adg.list_deadlocked()),
        )
