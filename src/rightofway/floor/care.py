"""What is done about delays while a plan runs: nothing, switching rights of way, planning anew."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rightofway.floor.happened import as_planned_but_late, planned_anew
from rightofway.floor.phases import Ended, run_in_phases
from rightofway.floor.tally import Tally
from rightofway.model import Actual
from rightofway.precedence import DelayedPlan, Runs

__all__ = ["Care"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Care:
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

    def run(self, floor: DelayedPlan, seed: int, run: int, tally: Tally) -> None:
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

    def actual(self, floor: DelayedPlan, seed: int, run: int) -> Actual:
        """Return what happens in one run."""
        ended = self._ended(floor, seed, run)
        if ended.stands:
            return planned_anew(floor, floor.setbacks(seed, run), ended)
        return as_planned_but_late(ended.floor, ended.setbacks)

    def _ended(self, floor: DelayedPlan, seed: int, run: int) -> Ended:
        return run_in_phases(floor, seed, run, switch=self.switch, replan=self.replan)


def _as_runs(ended: Ended, kept: Runs) -> Runs:
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
