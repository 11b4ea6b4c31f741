"""Executing a plan with delays, many times."""

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
from rightofway.planners import Deadline
from rightofway.precedence import ActionDependencyGraph, RunBatch

CHUNK = 1 << 20
"""Visits executed at a time; after each, time limit and Ctrl-C are looked at."""


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
    """Execute a plan many times with delays: by right of way, and by the clock to compare.

    Parameters
    ----------
    plan
        A plan that keeps the rules, by any planner or by hand.
    delays
        What makes robots late: causes like ``exponential:0.2`` or ``stop:R3@12+30``, several with
        commas or in a list; see `rightofway.execution.CAUSES`. A file of them is read by
        `rightofway.io.load_delays`.
    runs
        Number of runs.
    seed
        Run k of a seed meets the same delays, however many runs there are.
    switch
        Whether rights of way are switched during execution, where that is expected to help.
    replan
        Whether the rest is replanned during execution: where the fleet has fallen behind and that
        is expected to help, and where a robot breaks down.
    time_limit
        After this no more runs are begun, and no more is replanned [s]; one run is made in any
        case.
    report
        Takes sentences on the progress.

    Returns
    -------
    Outcome
        Collisions, deadlocks, lateness and its sources, single runs.

    Raises
    ------
    InputError
        If the plan has faults, the delays cannot be read, or the time limit is no duration.

    Notes
    -----
    By right of way a robot enters a vertex after all visits that come before by the plan, whatever
    the clock says. Bookings never overlap then, and no robots wait in a cycle because none did in
    the plan: that holds for delays of any length. Both are counted nevertheless.
    """
    time_limit = checked_time_limit(time_limit)
    judged = check(plan)
    if not judged.ok:
        raise InputError.at("", f"the plan has {judged.summary} (only one without can be run)")
    if runs < 1:
        raise InputError.at("runs", f"{runs} is less than one run (give 1 or more)")
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
        cut_off=cut_off,
        switches=switches,
        replans=replans,
        gain=PolicyGain.of(np.concatenate(kept), every.completion) if kept else None,
        lateness=Lateness.of(adg, every),
        completion=np.where(unfinished, -1, every.completion),
        _trace=trace,
    )
