"""Cost metrics of plans, and the lower bound of the flowtime."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

from rightofway.kinds.arguments import checks_arguments
from rightofway.metrics.alone import compute_alone_completions
from rightofway.metrics.jobs import list_job_times
from rightofway.model import Objective, Outcome, OutcomeKind, Plan, Proof, Tick
from rightofway.model.outcome import classify_cost

WITHOUT_PLAN = {OutcomeKind.NO_PLAN_EXISTS, OutcomeKind.GAVE_UP}
"""Outcomes of a run whose tracks are no plan."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Metrics:
    """Costs of a plan, and their lower bound.

    Attributes
    ----------
    flowtime
        Sum of the completion times [ticks].
    makespan
        The latest completion time [ticks].
    lower_bound
        No plan has a smaller flowtime [ticks]: the sum of ``alone``, or the bound of the planner
        if that is more.
    waiting
        The sum of all waits [ticks].
    moves
        The number of driven edges.
    completions
        Completion time of each robot [ticks].
    alone
        Its shortest completion time without the others [ticks]; with jobs, that of its tour.
    service_time
        With jobs: the sum over the served ones of completion - `earliest` [ticks]; else None.
    lateness
        With jobs: the sum over the served ones of the time after `due` [ticks]; else None.
    unserved
        With jobs: the number of those that no robot does; else None.
    """

    flowtime: Tick
    makespan: Tick
    lower_bound: Tick
    waiting: Tick
    moves: int
    completions: tuple[Tick, ...]
    alone: tuple[Tick, ...]
    service_time: Tick | None = None
    lateness: Tick | None = None
    unserved: int | None = None

    @property
    def gap(self) -> float | None:
        """By which part the flowtime exceeds the lower bound: 0.1 is a tenth more.

        None with jobs, whose tours have no bound, and above a lower bound of 0.
        """
        if self.service_time is not None:
            return None
        if self.flowtime == self.lower_bound:
            return 0.0
        return self.flowtime / self.lower_bound - 1 if self.lower_bound else None

    @property
    def detours(self) -> Tick:
        """The excess of the routes over the shortest ones, without waiting [ticks]."""
        return Tick(self.flowtime - self.flowtime_alone - self.waiting)

    @property
    def flowtime_alone(self) -> Tick:
        """The sum of the completion times of robots that drive alone [ticks]."""
        return Tick(sum(self.alone))

    def as_dict(self) -> dict[str, Any]:
        """Return the attributes by name, as files keep them: integers and lists of integers."""
        return {
            name: list(value) if isinstance(value, tuple) else value
            for name, value in asdict(self).items()
            if value is not None
        }


@checks_arguments
def measure(plan: Plan) -> Metrics:
    """Measure a plan.

    Parameters
    ----------
    plan
        A plan that keeps the rules; of others, the numbers are claims of the tracks.

    Raises
    ------
    NoPlanExists
        If no way leads from one place of a robot's trip to the next, so that there is no bound.
    """
    return plan.compute_once("metrics", lambda: _measure_plan(plan))


def get_own_outcome(plan: Plan) -> Outcome | None:
    """Return the proof of the planner of a plan; None where the plan itself refutes it.

    Files can be changed: a plan below the bound of its outcome refutes it.
    """
    outcome = plan.run.outcome
    if outcome is None or outcome.bound is None or outcome.kind in WITHOUT_PLAN:
        return None
    if outcome.objective is Objective.SERVICE and plan.tours is None:
        return None
    cost = plan.compute_value(outcome.objective)
    proof = Proof(bound=outcome.bound, objective=outcome.objective, factor=outcome.factor)
    # A plan with swaps proves nothing, so it may be called best found where it is at its bound.
    is_careful = outcome.kind is OutcomeKind.BEST_FOUND
    is_true = cost >= outcome.bound and (is_careful or classify_cost(cost, proof) == outcome)
    return outcome if is_true else None


def _measure_plan(plan: Plan) -> Metrics:
    stays = plan.stays
    completions = tuple(stay.completion for stay in stays)
    alone = plan.run.alone or compute_alone_completions(plan.scenario)
    outcome, bound, work = get_own_outcome(plan), Tick(sum(alone)), plan.scenario.problem.work
    if work is not None:  # in another plan, other robots have the tours
        bound = Tick(sum(robot.ready for robot in work.robots))
    if outcome and outcome.objective is Objective.FLOWTIME and outcome.bound is not None:
        bound = max(bound, outcome.bound)
    return Metrics(
        flowtime=Tick(sum(completions)),
        makespan=max(completions),
        lower_bound=bound,
        waiting=Tick(sum(int(stay.waits.sum()) for stay in stays)),
        moves=sum(len(track) - 1 for track in plan.tracks),
        completions=completions,
        alone=alone,
        **measure_service(plan),
    )


def measure_service(plan: Plan) -> dict[str, Any]:
    """Return the figures of the jobs of a plan by name; empty without jobs."""
    if plan.tours is None:
        return {}
    jobs = list_job_times(plan)
    return {
        "service_time": Tick(sum(job.service_time for job in jobs)),
        "lateness": Tick(sum(job.late for job in jobs)),
        "unserved": len({job for job, _ in plan.unserved}),
    }
