"""What is done about delays while a plan runs: nothing, switching rights of way, planning anew."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rightofway.execution.run import RunResult, run_in_phases
from rightofway.execution.tally import Tally
from rightofway.execution.trace import trace_after_replanning, trace_of
from rightofway.model import ExecutionTrace
from rightofway.precedence import ActionDependencyGraph, RunBatch

__all__ = ["ExecutionPolicy"]


@dataclass(frozen=True, slots=True, kw_only=True)
class ExecutionPolicy:
    """How a floor cares for its plan.

    Attributes
    ----------
    switch
        Whether rights of way are switched where that is expected to help.
    replan
        Whether what is left is planned anew: when the fleet has fallen behind and that is expected
        to help, and when a robot breaks down.
    """

    switch: bool
    replan: bool

    def __bool__(self) -> bool:
        return self.switch or self.replan

    def run(self, floor: ActionDependencyGraph, seed: int, run: int, tally: Tally) -> None:
        """Run a plan once with care, and count it beside the same run without."""
        kept, ended = floor.runs(seed, run, 1), self._ended(floor, seed, run)
        tally.add(
            _as_runs(ended, kept) if ended.replans else ended.floor.runs(seed, run, 1),
            kept=kept.completion,
            deadlocks=bool(ended.deadlocked),
            cut_off=len(ended.cut_off - ended.broken),
            switches=ended.switches,
            replans=ended.replans,
        )

    def actual(self, floor: ActionDependencyGraph, seed: int, run: int) -> ExecutionTrace:
        """Return what happens in one run."""
        ended = self._ended(floor, seed, run)
        if ended.stands:
            return trace_after_replanning(floor, floor.delay_sample(seed, run), ended)
        return trace_of(ended.floor, ended.delay_sample)

    def _ended(self, floor: ActionDependencyGraph, seed: int, run: int) -> RunResult:
        return run_in_phases(floor, seed, run, switch=self.switch, replan=self.replan)


def _as_runs(ended: RunResult, kept: RunBatch) -> RunBatch:
    """Return a run with new plans as the kernel would; where its lateness began is not known."""
    is_broken = np.zeros((1, len(ended.completion)), np.uint8)
    is_broken[0, sorted(ended.broken)] = 1
    return kept._replace(
        completion=ended.completion[None, :],
        is_broken=is_broken,
        by_right_of_way=ended.collisions[None, :],
        own=np.zeros_like(kept.own),
        of_others=np.zeros_like(kept.of_others),
        between=np.zeros((0, 3), np.int64),
    )
