"""What is done about delays while a plan runs: nothing, switching rights of way, planning anew."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rightofway.floor.happened import as_planned_but_late, planned_anew
from rightofway.floor.phases import Ended, run_in_phases
from rightofway.floor.switching import switched
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
        Whether what is left is planned anew when a robot breaks down.
    """

    switch: bool
    replan: bool

    def __bool__(self) -> bool:
        return self.switch or self.replan

    def run(self, floor: DelayedPlan, seed: int, run: int, tally: Tally) -> None:
        """Run a plan once with care, and count it."""
        if self.replan:
            ended = run_in_phases(floor, seed, run, switch=self.switch)
            if ended.replans:
                tally.add(
                    _as_runs(ended, floor.runs(seed, run, 1)),
                    cut_off=int(_out_of_action(ended).sum()),
                    switches=ended.switches,
                    replans=ended.replans,
                )
                return
        switches = 0
        if self.switch:
            floor, switches = switched(floor, floor.setbacks(seed, run))
        tally.add(floor.runs(seed, run, 1), switches=switches)

    def actual(self, floor: DelayedPlan, seed: int, run: int) -> Actual:
        """Return what happens in one run."""
        setbacks = floor.setbacks(seed, run)
        if self.replan:
            ended = run_in_phases(floor, seed, run, switch=self.switch)
            if ended.replans:
                return planned_anew(floor, setbacks, ended)
        if self.switch:
            floor, _ = switched(floor, setbacks)
        return as_planned_but_late(floor, setbacks)


def _out_of_action(ended: Ended) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
    """Tell which robots were cut off, and did not break down besides."""
    cut_off = np.zeros(len(ended.completion), bool)
    cut_off[sorted(ended.cut_off - ended.broken)] = True
    return cut_off


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
