"""Simulation of many executions of a plan with delays."""

from __future__ import annotations

from collections.abc import Callable, Iterable

import numpy as np
from numpy.typing import NDArray

from rightofway.check import check
from rightofway.errors import InputError, kernel_limits
from rightofway.execution.delays import DEFAULT, delay_model_of, read_delays
from rightofway.execution.monitor import ExecutionMonitor, ExecutionPolicy
from rightofway.execution.statistics import Collisions, Lateness, Outcome, PolicyGain, joined
from rightofway.model import NEVER, ExecutionTrace, Plan, checked_time_limit
from rightofway.model.problem import refuse_closures
from rightofway.planners import Deadline
from rightofway.precedence import ActionDependencyGraph, RunBatch

CHUNK = 1 << 20
"""Visits per call of the kernel; time limit and Ctrl-C are checked between calls."""


@kernel_limits()
def simulate(
    plan: Plan,
    delays: str | Iterable[str] = DEFAULT,
    runs: int = 1000,
    seed: int = 0,
    *,
    switch: bool = False,
    replan: bool = False,
    time_limit: float | None = None,
    report: Callable[[str], None] = lambda _: None,
) -> Outcome:
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
        behind and this lowers the expected flowtime, and after a breakdown.
    time_limit
        After this time, no run and no replanning begins [s]; at least one run is made.
    report
        Receives sentences on progress.

    Returns
    -------
    Outcome
        Collisions, deadlocks, lateness and its sources, single runs.

    Raises
    ------
    InputError
        If the plan has faults, the delays cannot be read, or a number is out of range.

    Notes
    -----
    By right of way, a robot enters a vertex after all visits that precede in the plan, at any time.
    Closures are kept by the clock: a robot starts no drive whose bookings would overlap a closure
    if all goes on as planned; robots that are caught in one all the same are counted.

    For delays of any length, bookings never overlap, and robots never deadlock, because the plan
    has no deadlock. Collisions and deadlocks are counted nevertheless.
    """
    time_limit = checked_time_limit(time_limit)
    judged = check(plan)
    if not judged.ok:
        raise InputError.at("", f"the plan has {judged.summary} (only one without can be run)")
    if runs < 1:
        raise InputError.at("runs", f"{runs} is less than one run (give 1 or more)")
    if switch or replan:
        what = "replanning during execution" if replan else "switching rights of way"
        remedy = f"simulate without {'replanning' if replan else 'switching'}"
        refuse_closures(plan.scenario.problem, what, remedy)
    deadline = Deadline.after(time_limit)
    causes = read_delays(delays, plan.scenario)
    adg = ActionDependencyGraph(plan.scenario, plan.tracks, delay_model_of(causes, plan.scenario))
    policy = ExecutionPolicy(switch=switch, replan=replan)
    batches: list[RunBatch] = []
    kept: list[NDArray[np.int64]] = []
    switches = replans = cut_off = deadlocks = 0
    traces: dict[int, ExecutionTrace] = {}
    chunk = 1 if any(policy) else max(CHUNK // len(adg.vertex), 1)
    for first in range(0, runs, chunk):
        batch = adg.runs(seed, first, min(chunk, runs - first))
        if any(policy):
            monitor = ExecutionMonitor(adg, policy, seed, first, deadline)
            if deadline.seconds_left() == 0:  # replanning may have been cut short
                if first:
                    break
                traces[first] = monitor.trace()
            kept.append(batch.completion)
            batch = monitor.batch(batch)
            switches += monitor.switches
            replans += monitor.replans
            cut_off += len(monitor.cut_off - monitor.lost)
            deadlocks += bool(monitor.adg.deadlocked())
        batches.append(batch)
        report(f"{min(first + chunk, runs)} of {runs} runs")
        if deadline.seconds_left() == 0:
            break

    def trace(run: int) -> ExecutionTrace:
        return traces.get(run) or ExecutionMonitor(adg, policy, seed, run, Deadline()).trace()

    every = joined(batches)
    is_broken, unfinished = every.is_broken.astype(bool), every.completion == NEVER
    stuck = np.isin(np.arange(len(plan.tracks)), adg.deadlocked())
    return Outcome(
        plan=plan,
        runs=len(every.completion),
        seed=seed,
        delays=tuple(cause.text for cause in causes),
        by_right_of_way=Collisions.of(every.by_right_of_way),
        by_clock=Collisions.of(every.by_clock),
        deadlocks=len(every.completion) if stuck.any() else deadlocks,
        broken=int(is_broken.sum()),
        stranded=int((unfinished & ~is_broken & ~stuck).sum()) - cut_off,
        caught=int(every.is_caught.sum()),
        cut_off=cut_off,
        switches=switches,
        replans=replans,
        gain=PolicyGain.of(np.concatenate(kept), every.completion) if kept else None,
        lateness=Lateness.of(adg, every),
        completion=np.where(unfinished, -1, every.completion),
        _trace=trace,
    )
