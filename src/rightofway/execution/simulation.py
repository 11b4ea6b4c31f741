"""Run a plan on a floor where robots are late, many times."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable

import numpy as np

from rightofway.check import check
from rightofway.errors import InputError, kernel_limits
from rightofway.execution.delays import DEFAULT, delay_model_of, read_delays
from rightofway.execution.outcome import Collisions, Outcome
from rightofway.execution.policy import ExecutionPolicy
from rightofway.execution.tally import Tally
from rightofway.model import NEVER, Plan, checked_time_limit
from rightofway.precedence import ActionDependencyGraph

__all__ = ["simulate"]

CHUNK = 1 << 20
"""Visits that are run at a time; after each time limit and Ctrl-C are looked at."""


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
    """Run a plan many times with delays: by right of way, and by the clock to compare.

    Parameters
    ----------
    plan
        A plan that keeps the rules, by any planner or by hand.
    delays
        What makes robots late: causes like ``exponential:0.2`` or ``stop:R3@12+30``, several with
        commas or in a list; see `rightofway.execution.CAUSES`. A file of them is read by
        `rightofway.io.load_delays`.
    runs
        How many runs.
    seed
        Run k of a seed meets the same delays, however many runs there are.
    switch
        Whether rights of way are switched while the plan runs, where that is expected to help.
    replan
        Whether what is left is planned anew when the fleet has fallen behind and that is expected
        to help, and when a robot breaks down for ever.
    time_limit
        When no more runs are begun [s]; one is run in any case.
    report
        Takes sentences on the progress.

    Returns
    -------
    Outcome
        Collisions, deadlocks, lateness and where it comes from, single runs.

    Raises
    ------
    InputError
        If the plan has faults, or the delays cannot be read.

    Notes
    -----
    By right of way every robot enters a vertex after all those that do so before it by the plan,
    whatever the clock says. Bookings never overlap then. Nobody waits in a circle, since in the
    plan nobody did: that holds for delays of any length. Both are counted nevertheless.
    """
    time_limit = checked_time_limit(time_limit)
    _refuse_faults(plan)
    if runs < 1:
        raise InputError.at("runs", f"{runs} is less than one run (give 1 or more)")
    causes = read_delays(delays, plan.scenario)
    floor = ActionDependencyGraph(plan.scenario, plan.tracks, delay_model_of(causes, plan.scenario))
    care = ExecutionPolicy(switch=switch, replan=replan)
    tally = Tally(floor)
    chunk = 1 if care else max(CHUNK // len(floor.vertex), 1)
    end = None if time_limit is None else time.monotonic() + time_limit
    for first in range(0, runs, chunk):
        if care:
            care.run(floor, seed, first, tally)
        else:
            tally.add(floor.runs(seed, first, min(chunk, runs - first)))
        report(f"{tally.runs} of {runs} runs")
        if end is not None and time.monotonic() > end:
            break
    stuck = np.zeros(len(plan.tracks), bool)
    stuck[floor.deadlocked()] = True
    unfinished = tally.completion == NEVER
    return Outcome(
        plan=plan,
        runs=tally.runs,
        seed=seed,
        delays=tuple(cause.text for cause in causes),
        by_right_of_way=Collisions.of(tally.by_right_of_way),
        by_clock=Collisions.of(tally.by_clock),
        deadlocks=tally.runs if stuck.any() else tally.deadlocks,
        broken=int(tally.is_broken.sum()),
        stranded=int((unfinished & ~tally.is_broken & ~stuck).sum()) - tally.cut_off,
        cut_off=tally.cut_off,
        switches=tally.switches,
        replans=tally.replans,
        won=tally.won(),
        lateness=tally.lateness(),
        completion=np.where(unfinished, -1, tally.completion),
        _actual=lambda run: care.actual(floor, seed, run),
    )


def _refuse_faults(plan: Plan) -> None:
    report = check(plan)
    if not report.ok:
        raise InputError.at("", f"the plan has {report.summary} (only one without can be run)")
