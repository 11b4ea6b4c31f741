"""Fleets of any kind that repeat their laps: results of rules and of a chosen timetable."""

from __future__ import annotations

import random
from dataclasses import replace
from fractions import Fraction

import pytest
from hypothesis import strategies as st

import rightofway
from rightofway.check import check
from rightofway.cyclic import (
    RULES,
    CyclicResult,
    find_best_timetable,
    make_excerpt,
    plan_of_laps,
    run_laps,
)
from rightofway.cyclic.sensitivity import compute_parameter_effects
from rightofway.cyclic.to_plan import unroll_laps
from rightofway.errors import GaveUp, InputError, NoPlanExists
from rightofway.model import Closure, Plan, Scenario
from rightofway.site import VertexId
from rightofway.viz.verdict import give_verdict
from tests.builders.any_fleet import LAPS_REFUSE, any_fleet
from tests.builders.executions import judge_trace
from tests.builders.fleets import grid_fleet
from tests.builders.laws import law, leave
from tests.oracles import judge
from tests.oracles.laps import largest_mean_cycle_is, replay
from tests.oracles.periodic_space import SLOW, check_periods

LAPS = any_fleet(
    robots=(2, 4), without={*LAPS_REFUSE, "zones"}, apart=True, joined=True
) | any_fleet(robots=(2, 3), without=LAPS_REFUSE, always={"both", "zones"}, apart=True, joined=True)
"""Laps refuse closures and trips that end at the last stop (see the last tests).

The oracle knows zones by bookings of edges, which there are where robots book ahead.
"""

POINTS = any_fleet(
    robots=(2, 4), without={*LAPS_REFUSE, "passed", "sizes", "zones"}, apart=True, joined=True
)
"""Fleets of points without zones: their oracle knows orders at vertices."""

TRIES = 8
"""Places that a law tries to close."""


def run_of(scenario: Scenario, rule: str) -> CyclicResult:
    """Return the laps of a fleet by a rule, or leave the case out."""
    try:
        return run_laps(scenario, rule, time_limit=3)
    except NoPlanExists:
        leave("no laps exist")
    except InputError as refused:
        leave(without_values(refused))


def without_values(refused: InputError) -> str:
    """Return why laps are refused; a robot may work at its home, or live on others' only way."""
    return str(refused).partition(": ")[2].partition(" (")[0].lstrip("RN0123456789 ")[:60]


def stands_still(run: CyclicResult) -> bool:
    """Tell whether a robot makes no lap, so that no plan of whole laps has all robots."""
    return any(
        0 in (group.pattern.counts if group.pattern else group.count_laps()) for group in run.groups
    )


def check_plan(plan: Plan) -> None:
    """Let the judge look at unroll_schedule laps, until the first robot stays at home."""
    ends = min(int(track.enter[-1]) for track in plan.tracks)
    assert not [fault for fault in check(plan).faults if fault.tick < ends]


@law(LAPS, st.sampled_from(sorted(RULES)))
def test_laps_by_every_rule_have_no_fault(scenario: Scenario, rule: str) -> None:
    run = run_of(scenario, rule)
    check_periods(run)
    if all(group.ends != "open" for group in run.groups):
        assert give_verdict(make_excerpt(run)[0]).ok
    if stands_still(run):
        with pytest.raises(GaveUp):
            unroll_laps(run)
    else:
        check_plan(unroll_laps(run))


@law(POINTS, st.sampled_from(sorted(RULES)))
def test_what_repeats_is_the_timetable_of_its_own_orders(scenario: Scenario, rule: str) -> None:
    run = run_of(scenario, rule)
    for group in run.groups:
        timetable = group.timetable
        if timetable is None or sum(map(len, timetable.enter)) > SLOW:
            continue
        headway, books_ahead = (
            group.context.booking_rules.headway,
            scenario.problem.booking_rules.books_ahead,
        )
        times = replay(timetable, 5, headway=headway, books_ahead=books_ahead)
        for (robot, index, period), tick in times.items():
            first = int(timetable.enter[robot][index]) % timetable.period
            assert tick == first + period * timetable.period
        assert largest_mean_cycle_is(timetable, headway=headway, books_ahead=books_ahead)


@law(LAPS, st.sampled_from(sorted(RULES)))
def test_the_judge_passes_whole_laps_unless_a_robot_at_home_is_in_the_way(
    scenario: Scenario, rule: str
) -> None:
    run = run_of(scenario, rule)
    if stands_still(run):
        with pytest.raises(GaveUp):
            plan_of_laps(run)
        return
    try:
        plan = plan_of_laps(run)
    except GaveUp:
        homes = {robot.home for robot in scenario.robots}
        laps = [lap for group in run.groups for lap in group.context.laps]
        has_sizes = not scenario.problem.resources.are_points
        assert has_sizes or any(homes.intersection(lap.vertices[1:]) for lap in laps)
    else:
        assert check(plan).ok


@law(LAPS, st.sampled_from(sorted(RULES)))
def test_the_period_by_theory_is_that_of_the_simulation_and_waits_add_up(
    scenario: Scenario, rule: str
) -> None:
    """What is missing was waited for nobody, by a robot that could have gone."""
    check_waits(run_of(scenario, rule))


def check_waits(run: CyclicResult) -> None:
    """Check bottlenecks and waits against the pattern that repeats."""
    for group in run.groups:
        bottleneck = group.find_bottleneck()
        assert bottleneck is None or (
            group.pattern is not None and bottleneck.cycle_time == group.pattern.period
        )
        counts = group.pattern.counts if group.pattern else ()
        for robot, laps, lap in zip(group.robots, counts, group.context.laps, strict=False):
            assert group.pattern is not None
            waits = sum(wait.ticks for wait in group.waits() if wait.waits == robot)
            assert not laps or waits <= group.pattern.period - laps * lap.duration


@law(LAPS | any_fleet(robots=(2, 4), without={*LAPS_REFUSE, "zones"}, apart=True, tiny=True))
def test_a_chosen_timetable_has_no_fault_and_is_not_below_first_come_first_served(
    scenario: Scenario,
) -> None:
    try:
        run = find_best_timetable(scenario, time_limit=None, rounds=2)
    except (GaveUp, NoPlanExists) as reason:
        leave(type(reason).__name__)
    except InputError as refused:
        leave(without_values(refused))
    check_periods(run)
    check_plan(unroll_laps(run, 5))
    assert give_verdict(make_excerpt(run)[0]).ok
    for group in run.groups:
        if group.comparison is not None and group.comparison.baseline_ends == "repeats":
            assert group.comparison.throughput >= group.comparison.baseline


def planned(scenario: Scenario) -> Plan:
    try:
        return rightofway.solve(scenario, "prioritized")
    except (GaveUp, NoPlanExists):
        leave("no plan of whole laps")


@law(LAPS, st.integers(0, 99))
def test_laps_that_are_late_keep_their_rights_of_way_without_contact(
    scenario: Scenario, seed: int
) -> None:
    """By a rule for laps; by a planner where a robot that is home for good would block others."""
    try:
        plan = plan_of_laps(run_of(scenario, "first-come"), 3)
    except GaveUp:
        plan = planned(replace(scenario, rules=replace(scenario.rules, laps=3)))
    outcome = rightofway.simulate(plan, "exponential:0.5", runs=20, seed=seed)
    assert (outcome.collisions, outcome.deadlocks, outcome.stranded) == (0, 0, 0)
    assert judge_trace(plan, outcome.trace(3)) == []
    replanned = rightofway.simulate(plan, "chance:0.05x20", runs=2, seed=seed, replan=True)
    assert (replanned.collisions, replanned.deadlocks, replanned.stranded) == (0, 0, 0)


@law(
    any_fleet(robots=(1, 2), without=LAPS_REFUSE, joined=True, apart=True),
    st.integers(0, 2**32 - 1),
)
def test_laps_keep_out_of_places_that_are_closed_for_ever(scenario: Scenario, chance: int) -> None:
    """The judge knows the closure, whatever laps make of it."""
    used = {place for one in scenario.robots for place in (one.home, *(at.at for at in one.stops))}
    roadmap = scenario.roadmap
    closures = [Closure(at=VertexId(v)) for v in range(roadmap.n_vertices) if v not in used]
    closures += [
        Closure(edge=(VertexId(tail), VertexId(int(head))))
        for tail in range(roadmap.n_vertices)
        for head in roadmap.heads[roadmap.indptr[tail] : roadmap.indptr[tail + 1]]
    ]
    random.Random(chance).shuffle(closures)  # noqa: S311
    for closure in closures[:TRIES]:
        try:
            result = run_laps(replace(scenario, closures=(closure,)), time_limit=3)
            plan = plan_of_laps(result, 2)
        except (GaveUp, NoPlanExists):
            continue  # no way is left, or a robot at home after its laps blocks others
        except InputError as refused:
            leave(without_values(refused))
        as_closed = replace(plan.scenario, roadmap=scenario.roadmap, closures=(closure,))
        assert check(replace(plan, scenario=as_closed)).ok
        assert judge.faults(replace(plan, scenario=as_closed)) == set()
        return
    leave("no place can be closed")


def test_a_place_that_is_closed_for_ever_is_driven_round_in_each_lap() -> None:
    """From N0 to N2 round N1: 4 edges there and 4 back, and a turn of a cell at both ends."""
    scenario = grid_fleet(["...", "..."], [("N0", "N2")])
    closed = replace(scenario, closures=(Closure(at=VertexId(1)),))
    for result in (run_laps(closed), find_best_timetable(closed, time_limit=1)):
        (group,) = result.groups
        assert group.pattern is not None
        assert group.pattern.period == 10
        assert all(1 not in lap.vertices for lap in group.context.laps)


def test_a_robot_with_a_turn_rate_turns_in_each_visit_of_its_lap_and_at_home_between_two() -> None:
    """From N0 round the corner N2 to N5 and back: turns of 90, 180, 90 degrees, 180 at home."""
    scenario = grid_fleet(["...", "@@."], [("N0", "N5")])
    scenario = replace(scenario, rules=replace(scenario.rules, turn=None, turn_rate=Fraction(45)))
    for result in (run_laps(scenario), find_best_timetable(scenario, time_limit=1)):
        (group,) = result.groups
        assert group.pattern is not None
        assert group.context.laps[0].dwell == (4, 0, 2, 4, 2, 0)
        assert group.pattern.period == 6 + 12
        plan = plan_of_laps(result, 2)
        assert check(plan).ok
        assert judge.faults(plan) == set()
        graph = group.build_graph()
        assert graph is not None
        turning = {one.kind: one.effect for one in compute_parameter_effects(scenario, graph)}[
            "turn"
        ]
        assert turning.gain == 12  # ticks of the period that turning takes
    first = run_laps(scenario).groups[0].pattern
    assert first is not None
    assert first.enter(0, 6) == 6 + 8  # it does not turn before its first lap


def test_laps_refuse_closures_at_one_time_and_trips_that_do_not_come_home() -> None:
    scenario = grid_fleet(["...."], [("N0", "N3")])
    closed = replace(scenario, closures=(Closure(at=VertexId(1), from_=Fraction(2)),))
    with pytest.raises(InputError, match=r"closures\[0\]: is at one time, and laps come again"):
        run_laps(closed)
    wide = replace(scenario.robots[0], radius=Fraction(1, 4))
    large = replace(wide, name="R2", home=VertexId(2), radius=Fraction(2, 5))
    near = Closure(at=VertexId(1), radius=Fraction(7, 10))
    rules = replace(scenario.rules, occupancy="both")
    unlike = replace(scenario, robots=(wide, large), closures=(near,), rules=rules)
    with pytest.raises(InputError, match="close different places to robots of different sizes"):
        run_laps(unlike)
    with pytest.raises(InputError, match=r"rules\.return"):
        run_laps(replace(scenario, rules=replace(scenario.rules, ends="none")))
