"""The numbers that plans are compared by."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass
from typing import Any

from rightofway.metrics.alone import compute_alone_completions
from rightofway.model import Plan, Tick
from rightofway.model.given import require_plan


@dataclass(frozen=True, slots=True, kw_only=True)
class Metrics:
    """What a plan costs, and what it must cost at least.

    Attributes
    ----------
    flowtime
        Sum of the completion times [ticks].
    makespan
        The latest completion time [ticks].
    lower_bound
        Sum of the shortest completion times alone: no plan has a smaller flowtime [ticks].
    waiting
        The sum of all times that robots stand still without work [ticks].
    moves
        How many edges are driven.
    completions
        Completion time of each robot [ticks].
    alone
        Its shortest completion time without the others [ticks].
    """

    flowtime: Tick
    makespan: Tick
    lower_bound: Tick
    waiting: Tick
    moves: int
    completions: tuple[Tick, ...]
    alone: tuple[Tick, ...]

    @property
    def gap(self) -> float:
        """By which part the flowtime exceeds the lower bound: 0.1 is a tenth more."""
        if self.flowtime == self.lower_bound:
            return 0.0
        return self.flowtime / self.lower_bound - 1 if self.lower_bound else math.inf

    @property
    def detours(self) -> Tick:
        """How much longer the routes are than the shortest, without waiting [ticks]."""
        return Tick(self.flowtime - self.lower_bound - self.waiting)

    def as_dict(self) -> dict[str, Any]:
        """Return the attributes by name, as files keep them: integers and lists of integers."""
        return {
            name: list(value) if isinstance(value, tuple) else value
            for name, value in asdict(self).items()
        }


def measure(plan: Plan) -> Metrics:
    """Measure a plan.

    Parameters
    ----------
    plan
        A plan that keeps the rules; of others, the numbers are what the tracks claim.

    Raises
    ------
    NoPlanExists
        If no way leads from one place of a robot's trip to the next, so that there is no bound.
    """
    return require_plan(plan).compute_once("metrics", lambda: _measured(plan))


def _measured(plan: Plan) -> Metrics:
    stays = plan.stays
    completions = tuple(stay.completion for stay in stays)
    alone = plan.run.alone or compute_alone_completions(plan.scenario)
    return Metrics(
        flowtime=Tick(sum(completions)),
        makespan=max(completions),
        lower_bound=Tick(sum(alone)),
        waiting=Tick(sum(int(stay.waits.sum()) for stay in stays)),
        moves=sum(len(track) - 1 for track in plan.tracks),
        completions=completions,
        alone=alone,
    )
