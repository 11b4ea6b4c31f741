"""Conflict-based search against a search over all joint states, whatever makes it fast."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from itertools import product
from typing import Any

from hypothesis import strategies as st

from rightofway import OutcomeKind, check, solve
from rightofway.errors import GaveUp, NoPlanExists
from rightofway.metrics import (
    compute_alone_completions,
    find_forced_losses,
    find_forced_makespan,
)
from rightofway.model import (
    Objective,
    Plan,
    PlannerRun,
    Scenario,
    compute_cost,
)
from rightofway.model.outcome import choose_objective
from rightofway.model.stays import compute_costs
from rightofway.repair.bounds import prove_bound
from rightofway.repair.impossible import make_fleet_of
from rightofway.search import (
    Bookings,
    ConflictBasedSearch,
    Distances,
    compute_least_completions,
    find_earliest_track,
    find_fewest_actions,
)
from tests.builders.any_fleet import any_fleet
from tests.builders.any_plan import planned
from tests.builders.laws import law, leave, once
from tests.builders.tiny import KINDS, least_cost
from tests.oracles import joint_space

kinds, seeds = st.sampled_from(sorted(KINDS)), st.integers(0, 10**6)
switches = st.fixed_dictionaries(
    {
        "cardinal": st.booleans(),
        "bypass": st.booleans(),
        "clear": st.booleans(),
        "targets": st.booleans(),
        "disjoint": st.booleans(),
        "pairs": st.booleans(),
        "pair_nodes": st.sampled_from([0, 3, 100]),
        "joint_states": st.sampled_from([0, 100, 10_000]),
    }
)

PARTS = 1000
"""Of a tick, of which a wait or a drive counts as one."""

UNKNOWN = {"barred", "laps", "limits", "spacing", "turn rates"}
"""What the oracle does not know, or what makes trips too long for it."""

LONGEST = 24
"""Ticks for which the oracle searches all joint states."""

NODES = 300
"""Fleets without a plan may have trees without end."""


def _search(scenario: Scenario, **options: Any) -> ConflictBasedSearch:
    alone = compute_least_completions(scenario)
    if alone is None or alone.min() < 0:
        leave("a robot cannot reach its places")
    return ConflictBasedSearch(scenario.problem, **options)


def _is_optimal(plan: Plan) -> bool:
    return plan.run.outcome is not None and plan.run.outcome.kind is OutcomeKind.OPTIMAL


def _count_actions(plan: Plan) -> int:
    return len(plan.waits) + sum(len(track) - 1 for track in plan.tracks)


def _answer(scenario: Scenario, options: dict[str, Any]) -> Plan | NoPlanExists | GaveUp:
    try:
        return solve(scenario, "cbs", time_limit=None, options=options)
    except (NoPlanExists, GaveUp) as error:
        return error


@law(kinds, seeds, switches)
def test_a_tree_finds_the_optimum_and_its_bound_is_never_above_it(
    kind: str, seed: int, options: dict[str, Any]
) -> None:
    scenario = KINDS[kind](seed)
    search = _search(scenario, **options)
    least = least_cost(kind, scenario)
    search.run(nodes=NODES)
    if least is None:
        assert search.tracks is None
        return
    assert search.bound is not None
    assert search.bound <= least
    if search.tracks is not None:
        plan = Plan(scenario=scenario, tracks=search.tracks, run=PlannerRun(name="cbs"))
        assert check(plan).ok
        assert compute_cost(scenario, plan.tracks) == search.bound == least


@law(kinds, seeds)
@once(kind="closures", seed=1647)  # lanes that are closed for ever, and others that open
def test_a_search_over_joint_states_finds_the_optimum_or_proves_that_there_is_no_plan(
    kind: str, seed: int
) -> None:
    scenario = KINDS[kind](seed)
    search = _search(scenario)
    least = least_cost(kind, scenario)
    plan = search.search_together(range(len(scenario.robots)), states=10_000)
    if not plan.has_ended:
        assert least is None or (plan.bound or 0) <= least
        return
    assert plan.bound == least
    if least is not None:
        assert plan.tracks is not None
        assert check(Plan(scenario=scenario, tracks=plan.tracks, run=PlannerRun(name="joint"))).ok
        assert compute_cost(scenario, plan.tracks) == least


@law(kinds, seeds, st.integers(1, 30))
def test_a_search_that_is_continued_ends_as_one_that_is_not(
    kind: str, seed: int, nodes: int
) -> None:
    scenario = KINDS[kind](seed)
    whole, in_parts = _search(scenario), _search(scenario)
    whole.run(nodes=NODES)
    bounds = []
    while not in_parts.is_proven and in_parts.n_nodes < NODES:
        in_parts.run(nodes=min(nodes, NODES - in_parts.n_nodes))
        bounds.append(in_parts.bound or 0)
    assert in_parts.bound is None or bounds == sorted(bounds)
    if whole.is_proven and in_parts.is_proven:
        assert whole.bound == in_parts.bound
        assert (whole.tracks is None) == (in_parts.tracks is None)


@law(st.sampled_from(sorted({*KINDS} - {"turning"})), seeds)
def test_of_the_plans_of_least_cost_that_with_the_fewest_actions_is_taken(
    kind: str, seed: int
) -> None:
    scenario = KINDS[kind](seed)
    answer = _answer(scenario, {"nodes": NODES})
    if not isinstance(answer, Plan) or not _is_optimal(answer):
        leave("no optimum within the nodes")
    assert check(answer).ok
    is_proven, tracks = find_fewest_actions(scenario, answer.tracks)
    plan = Plan(scenario=scenario, tracks=tracks, run=PlannerRun(name="cbs"))
    assert _count_actions(plan) == _count_actions(answer)
    least = joint_space.least_flowtime(scenario, parts=PARTS)
    assert least is not None
    assert least // PARTS == compute_cost(scenario, answer.tracks)
    assert not is_proven or _count_actions(answer) == least % PARTS


@law(any_fleet())
def test_a_plan_with_fewer_actions_keeps_the_rules_and_costs_no_more(scenario: Scenario) -> None:
    before = planned(scenario, "lns")
    _, tracks = find_fewest_actions(scenario, before.tracks, states=300)
    after = Plan(scenario=scenario, tracks=tracks, run=PlannerRun(name="cbs"))
    assert check(after).ok
    costs = [compute_cost(scenario, plan.tracks) for plan in (before, after)]
    assert (costs[1], _count_actions(after)) <= (costs[0], _count_actions(before))


@law(kinds, seeds)
def test_among_plans_below_a_known_one_none_is_missed(kind: str, seed: int) -> None:
    scenario = KINDS[kind](seed)
    least = least_cost(kind, scenario)
    if least is None:
        leave("no plan exists")
    for above, pair_nodes in product((0, 1), (0, 100)):
        search = _search(scenario, pair_nodes=pair_nodes)
        search.run(upper=least + above, nodes=NODES)
        if search.is_proven:
            assert search.bound == least
            assert (search.tracks is not None) == (above == 1)


@law(kinds, seeds, st.sampled_from([Fraction(21, 20), Fraction(6, 5), Fraction(2)]))
def test_a_bounded_plan_keeps_its_factor(kind: str, seed: int, factor: Fraction) -> None:
    scenario = KINDS[kind](seed)
    least = least_cost(kind, scenario)
    answer = _answer(scenario, {"suboptimality": factor, "nodes": NODES})
    if isinstance(answer, NoPlanExists):
        assert least is None
        return
    if isinstance(answer, GaveUp):
        assert least is None or (answer.lower_bound or 0) <= least
        return
    plan = answer
    assert least is not None
    outcome = plan.run.outcome
    assert outcome is not None
    assert outcome.bound is not None
    cost = compute_cost(scenario, plan.tracks)
    assert outcome.bound <= least <= cost
    if outcome.kind is not OutcomeKind.BEST_FOUND:
        assert cost <= factor * least


@law(kinds, seeds, st.sampled_from([Fraction(51, 50), Fraction(6, 5), Fraction(3)]), switches)
def test_a_focal_search_finds_a_plan_within_its_factor_of_a_bound_that_holds(
    kind: str, seed: int, factor: Fraction, options: dict[str, Any]
) -> None:
    scenario = KINDS[kind](seed)
    search = _search(scenario, factor=factor, **options)
    least = least_cost(kind, scenario)
    search.run(nodes=NODES)
    if least is None:
        assert search.tracks is None
        return
    assert search.bound is not None
    assert search.bound <= least
    if search.tracks is None:
        assert not search.is_proven
        return
    plan = Plan(scenario=scenario, tracks=search.tracks, run=PlannerRun(name="cbs"))
    assert check(plan).ok
    assert least <= compute_cost(scenario, plan.tracks) <= factor * search.bound


@law(seeds)
def test_robots_count_by_their_weights(seed: int) -> None:
    fleet = KINDS["trips"](seed)
    robots = tuple(
        replace(robot, weight=Fraction(1 + (seed + 2 * k) % 5, 2))
        for k, robot in enumerate(fleet.robots)
    )
    scenario = replace(fleet, robots=robots)
    least = least_cost("trips", scenario)
    answer = _answer(scenario, {"nodes": NODES})
    if not isinstance(answer, Plan):
        leave("no plan")
    outcome = answer.run.outcome
    assert outcome is not None
    assert outcome.bound is not None
    assert least is not None
    assert outcome.bound <= least <= compute_cost(scenario, answer.tracks)
    if outcome.kind is OutcomeKind.OPTIMAL:
        assert compute_cost(scenario, answer.tracks) == least


@law(st.sampled_from(["sizes", "three", "trips", "zones"]), seeds)
def test_the_least_makespan_is_proven(kind: str, seed: int) -> None:
    scenario = KINDS[kind](seed)
    least = joint_space.least_makespan(scenario)
    answer = _answer(scenario, {"objective": "makespan", "nodes": NODES})
    if not isinstance(answer, Plan):
        assert least is None or isinstance(answer, GaveUp)
        return
    assert least is not None
    outcome = answer.run.outcome
    assert outcome is not None
    assert outcome.bound is not None
    assert outcome.objective is Objective.MAKESPAN
    assert outcome.bound <= least <= answer.makespan
    if outcome.kind is OutcomeKind.OPTIMAL:
        assert answer.makespan == least


@law(st.sampled_from(["sizes", "three", "trips", "zones"]), seeds, st.integers(0, 30))
def test_joint_states_have_the_least_cost_of_plans_that_end_by_a_tick(
    kind: str, seed: int, later: int
) -> None:
    """A state at less cost may come too late for the last tick."""
    scenario = KINDS[kind](seed)
    alone = compute_least_completions(scenario)
    assert alone is not None, "there is no time limit"
    latest = int(alone.max()) + later
    search = ConflictBasedSearch(scenario.problem, latest=latest)
    plan = search.search_together(range(len(scenario.robots)), states=10_000)
    if not plan.has_ended:
        leave("too many joint states")
    assert plan.bound == joint_space.least_flowtime(scenario, latest)


def test_a_joint_state_at_less_cost_may_come_too_late() -> None:
    problem = KINDS["three"](241440).problem
    for latest, cost in ((206, None), (210, 573), (222, 570)):
        search = ConflictBasedSearch(problem, latest=latest)
        plan = search.search_together((0, 1, 2), states=10_000)
        assert (plan.has_ended, plan.bound) == (True, cost)


@law(any_fleet())
def test_two_robots_lose_what_is_forced_in_any_plan(scenario: Scenario) -> None:
    costs = compute_costs(scenario, planned(scenario, "lns").tracks)
    bookings, distances = Bookings(scenario.problem), Distances(scenario.roadmap)
    tracks = [find_earliest_track(robot, bookings, distances) for robot in range(len(costs))]
    alone = compute_costs(scenario, [track for track in tracks if track is not None])
    weights = [itinerary.weight for itinerary in scenario.problem.itineraries]
    lost = [
        weight * (cost - least) for weight, cost, least in zip(weights, costs, alone, strict=True)
    ]
    for loss in find_forced_losses(scenario):
        assert sum(lost[robot] for robot in loss.robots) >= loss.ticks > 0


def _plan_soon(scenario: Scenario) -> Plan:
    """Return a plan that is short enough for the oracle to search all joint states as long."""
    plan = planned(scenario, "lns")
    if plan.makespan > LONGEST:
        leave("too many joint states")
    return plan


def _prove_alone(scenario: Scenario, robots: tuple[int, ...]) -> int:
    """Return the least cost of some robots alone, by all their joint states and whole weights."""
    least = joint_space.least_flowtime(make_fleet_of(scenario, robots))
    assert least is not None, "their plan in the whole fleet is one"
    whole = scenario.problem.itineraries[robots[0]].weight
    own = make_fleet_of(scenario, robots).problem.itineraries[0].weight
    return least * whole // own


@law(any_fleet(robots=(2, 3), without=UNKNOWN, joined=True, tiny=True))
def test_what_robots_lose_is_forced_by_their_joint_states_alone(scenario: Scenario) -> None:
    """By weight, where robots have weights, and with surcharges, where edges have some."""
    _plan_soon(scenario)
    for loss in find_forced_losses(scenario):
        assert loss.objective is choose_objective(scenario)
        alone = sum(_prove_alone(scenario, (robot,)) for robot in loss.robots)
        assert _prove_alone(scenario, loss.robots) - alone >= loss.ticks > 0


@law(any_fleet(robots=(2, 3), without={*UNKNOWN, "closures", "surcharges"}, joined=True, tiny=True))
def test_before_a_forced_makespan_not_all_of_its_robots_can_have_completed(
    scenario: Scenario,
) -> None:
    """Of all ticks from the last robot alone to that of a plan, those with a proof."""
    latest = _plan_soon(scenario).makespan
    first = max(compute_alone_completions(scenario))
    proofs = [find_forced_makespan(scenario, tick) for tick in range(first, latest + 2)]
    assert proofs[0] or first == 0, "the last robot alone needs as long"
    assert not proofs[-1], "there is a plan that ends before"
    for loss in [loss for losses in proofs for loss in losses][-2:]:
        assert loss.objective is Objective.MAKESPAN
        least = joint_space.least_makespan(make_fleet_of(scenario, loss.robots))
        assert least is not None
        assert least >= loss.ticks


@law(any_fleet(), st.integers(1, 30))
def test_no_plan_of_any_fleet_is_below_a_proven_bound(scenario: Scenario, nodes: int) -> None:
    plan = planned(scenario, "lns")
    proof, is_reached = prove_bound(scenario, nodes=nodes, steps=nodes)
    assert proof.objective is choose_objective(scenario)
    assert proof.bound <= proof.objective.compute_cost(scenario, plan.tracks)
    if is_reached:
        answer = _answer(scenario, {"nodes": nodes})
        assert isinstance(answer, Plan)
        assert proof.bound == compute_cost(scenario, answer.tracks)


@law(seeds)
def test_with_more_headway_the_optimum_is_no_smaller(seed: int) -> None:
    scenario = KINDS["trips"](seed)
    spaced = replace(scenario, rules=replace(scenario.rules, headway=scenario.rules.headway + 1))
    optima = []
    for fleet in (scenario, spaced):
        search = _search(fleet)
        search.run(nodes=NODES)
        if search.tracks is None:
            leave("no plan within the nodes")
        optima.append(Fraction(search.bound or 0) * fleet.problem.clock.tick)
    assert optima[0] <= optima[1]
