"""What planners minimize when they are asked to: against all joint states of tiny fleets."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from typing import Literal

from hypothesis import strategies as st

from rightofway import OutcomeKind, Plan, check, improve, solve
from rightofway.errors import GaveUp, InputError, NoPlanExists
from rightofway.model import Objective, Scenario
from tests.builders.any_fleet import any_fleet
from tests.builders.any_plan import planned
from tests.builders.laws import law, leave
from tests.builders.tiny import KINDS
from tests.oracles import joint_space

Name = Literal["makespan", "both"]

OF = {"makespan": Objective.MAKESPAN, "both": Objective.BOTH}
LIMITS = {
    "auto": {"iterations": 50, "nodes": 300},
    "cbs": {"nodes": 300},
    "lns": {"iterations": 50},
    "local-search": {"rounds": 5},
    "priority-search": {"rounds": 5},
    "random-priority": {"restarts": 5},
    "two-level": {},
}

names = st.sampled_from(sorted(OF))
planners = st.sampled_from(sorted(LIMITS))
kinds, seeds = st.sampled_from(["sizes", "three", "trips", "zones"]), st.integers(0, 10**6)


def _plan(scenario: Scenario, planner: str, name: str) -> Plan | NoPlanExists | None:
    """Return the plan of a planner, its proof that there is none, or nothing if it gave up."""
    options = {"objective": name, **LIMITS[planner]}
    try:
        return solve(scenario, planner, options=options, time_limit=None)
    except NoPlanExists as error:
        return error
    except GaveUp:
        return None


def _weighted(scenario: Scenario, seed: int) -> Scenario:
    """Return a fleet in which, for every other seed, ticks of robots count differently."""
    if seed % 2:
        return scenario
    robots = (
        replace(robot, weight=Fraction(1 + (seed // 2 + 2 * k) % 3))
        for k, robot in enumerate(scenario.robots)
    )
    return replace(scenario, robots=tuple(robots))


@law(kinds, seeds, planners, names)
def test_a_bound_of_an_objective_is_not_above_its_optimum_and_an_optimum_is_one(
    kind: str, seed: int, planner: str, name: str
) -> None:
    scenario = _weighted(KINDS[kind](seed), seed)
    answer = _plan(scenario, planner, name)
    least = joint_space.least_value(OF[name], scenario)
    if not isinstance(answer, Plan):
        assert answer is None or least is None
        return
    assert check(answer).ok
    outcome, value = answer.run.outcome, OF[name].compute_cost(scenario, answer.tracks)
    assert least is not None
    assert outcome is not None
    assert outcome.objective is OF[name]
    assert outcome.bound is not None
    assert outcome.bound <= least <= value
    if outcome.kind is OutcomeKind.OPTIMAL:
        assert value == least


@law(st.sampled_from(["three", "trips"]), seeds, st.sampled_from(["auto", "cbs"]), names)
def test_planners_that_prove_plans_find_the_optimum_of_any_objective(
    kind: str, seed: int, planner: str, name: str
) -> None:
    answer = _plan(KINDS[kind](seed), planner, name)
    if not isinstance(answer, Plan):
        leave("no plan")
    assert answer.run.outcome is not None
    if answer.run.outcome.kind is not OutcomeKind.OPTIMAL:
        leave("the trees have more nodes than the planner expands")
    least = joint_space.least_value(OF[name], answer.scenario)
    assert OF[name].compute_cost(answer.scenario, answer.tracks) == least


@law(any_fleet(), st.sampled_from(["auto", "lns", "local-search"]), names, st.integers(0, 3))
def test_a_plan_does_not_get_worse_by_the_objective_of_its_improvement(
    scenario: Scenario, planner: str, name: str, seed: int
) -> None:
    plan = planned(scenario, "prioritized")
    options = {"objective": name, **LIMITS[planner]}
    options |= {"nodes": 30} if planner == "auto" else {}  # steps of prices, too
    try:
        better = improve(plan, planner, options=options, time_limit=None, seed=seed)
    except InputError:
        assert scenario.roadmap.has_surcharges
        return
    assert check(better).ok
    value, before = (OF[name].compute_cost(scenario, each.tracks) for each in (better, plan))
    assert value <= before
    outcome = better.run.outcome
    assert outcome is not None
    assert outcome.objective is OF[name]
    assert (outcome.bound or 0) <= value
