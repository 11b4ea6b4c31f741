"""A chosen timetable has no conflict, round the seam neither, and is never below its rival."""

from __future__ import annotations

import math
from fractions import Fraction

import pytest
from hypothesis import strategies as st

from rightofway.cyclic import (
    BaselineComparison,
    CyclicResult,
    find_best_timetable,
    plan_of_laps,
    run_laps,
)
from rightofway.errors import GaveUp, InputError, NoPlanExists
from rightofway.model import BookingRules, Rules, Scenario
from rightofway.precedence import TimedEventGraph
from tests.builders.fleets import grid_fleet, random_fleet
from tests.builders.laws import law, leave
from tests.oracles import periodic_bookings as oracle

RULES = [Rules(), Rules(headway=Fraction(2)), Rules(occupancy="both"), Rules(rotations=False)]


def chosen(scenario: Scenario, *, rounds: int = 6) -> CyclicResult:
    """Choose where that is possible; how well is not the point here."""
    try:
        return find_best_timetable(scenario, time_limit=None, rounds=rounds, seed=3)
    except (GaveUp, InputError, NoPlanExists) as reason:
        leave(type(reason).__name__)


@st.composite
def fleets(draw: st.DrawFn, least_size: int = 4) -> Scenario:
    return random_fleet(
        draw(st.integers(0, 10**6)),
        size=draw(st.integers(least_size, 7)),
        robots=draw(st.integers(2, 4)),
        rules=draw(st.sampled_from(RULES)),
    )


def comparisons(result: CyclicResult) -> list[BaselineComparison]:
    """Return how the timetable of each group compares."""
    return [group.comparison for group in result.groups if group.comparison is not None]


@law(fleets())
def test_three_periods_of_a_chosen_timetable_have_no_fault(scenario: Scenario) -> None:
    result = chosen(scenario)
    ahead = scenario.problem.booking_rules.books_ahead
    for group, comparison in zip(result.groups, comparisons(result), strict=True):
        timetable = group.timetable
        assert timetable is not None
        headway = group.context.booking_rules.headway
        assert oracle.faults(timetable, headway=headway, books_ahead=ahead) == []
        period = timetable.period
        graph = TimedEventGraph(timetable, rules=BookingRules(headway=headway, books_ahead=ahead))
        found = graph.find_critical_circuit()
        assert found.cycle_time == period or found.cycle_time > period - 1
        assert comparison.throughput == group.compute_rate()
        assert min(timetable.counts) >= 1
        assert 0 < comparison.fairness <= 1
    robots = sorted(robot for group in result.groups for robot in group.robots)
    assert robots == list(range(len(scenario.robots)))
    places = [
        {vertex for lap in group.context.laps for vertex in lap.vertices} for group in result.groups
    ]
    assert sum(map(len, places)) == len(set().union(*places))


@law(fleets())
def test_it_is_never_below_first_come_first_served(scenario: Scenario) -> None:
    result = chosen(scenario)
    own_groups = comparisons(result)
    baseline = run_laps(scenario, "first-come", time_limit=None)
    if [group.robots for group in result.groups] != [group.robots for group in baseline.groups]:
        leave("on other routes, other robots have to do with each other")
    for own, other in zip(own_groups, baseline.groups, strict=True):
        starves = other.ends == "repeats" and not all(other.compute_mean_laps())
        assert own.baseline_ends == ("starves" if starves else other.ends)
        if other.ends == "repeats":
            means = [mean for mean in other.compute_mean_laps() if mean]
            assert own.baseline == sum((1 / mean for mean in means), Fraction(0))
            assert starves or own.throughput >= own.baseline


@law(fleets())
def test_the_same_seed_and_rounds_give_the_same_timetable(scenario: Scenario) -> None:
    one, other = chosen(scenario, rounds=3), chosen(scenario, rounds=3)
    for first, second in zip(one.groups, other.groups, strict=True):
        assert first.pattern
        assert second.pattern
        assert first.pattern.counts == second.pattern.counts
        assert [list(past) for past in first.history] == [list(past) for past in second.history]


@law(fleets(least_size=7))
def test_the_judge_passes_its_laps_as_a_plan(scenario: Scenario) -> None:
    run = chosen(scenario)
    homes = {robot.home for robot in scenario.robots}
    if any(homes.intersection(lap.vertices[1:]) for g in run.groups for lap in g.context.laps):
        leave("a home lies on a lap")
    plan = plan_of_laps(run)
    assert min(robot.laps or 0 for robot in plan.scenario.robots) >= 2


def test_nobody_starves_below_the_bound() -> None:
    scenario = random_fleet(1, size=8, robots=8)
    result = find_best_timetable(
        scenario, least_fairness=Fraction(1, 2), time_limit=None, rounds=20, seed=1
    )
    assert min(one.fairness for one in comparisons(result)) >= Fraction(1, 2)
    with pytest.raises(GaveUp, match="fair enough"):
        find_best_timetable(scenario, least_fairness=Fraction(1), time_limit=None, rounds=3)


def test_weights_shift_laps_to_who_is_worth_more() -> None:
    scenario = random_fleet(1, size=8, robots=8)
    plain = find_best_timetable(scenario, time_limit=None, rounds=20, seed=1)

    def part(result: CyclicResult, robot: int) -> Fraction:
        """How many of its laps alone a robot makes."""
        group = next(group for group in result.groups if robot in group.robots)
        place = group.robots.index(robot)
        mean = group.compute_mean_laps()[place]
        assert mean is not None
        return group.context.laps[place].duration / mean

    least = min(range(8), key=lambda robot: part(plain, robot))
    weights = [Fraction(100 if robot == least else 1) for robot in range(8)]
    heavy = find_best_timetable(scenario, weights=weights, time_limit=None, rounds=20, seed=1)
    assert part(heavy, least) > part(plain, least)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"weights": [Fraction(1)]}, "weights: 1 for 2 robots"),
        ({"weights": [Fraction(1), Fraction(0)]}, r"weights\[1\]: 0 is not positive"),
        ({"least_fairness": Fraction(2)}, "least_fairness: 2 is above 1"),
        ({"time_limit": None}, "rounds: neither they nor the time are limited"),
    ],
)
def test_what_does_not_fit_is_refused(options: dict[str, object], message: str) -> None:
    scenario = random_fleet(3, size=5, robots=2)
    with pytest.raises(InputError, match=message):
        find_best_timetable(scenario, **options)  # type: ignore[arg-type]


def test_a_proof_that_no_plan_exists_is_not_reported_as_given_up() -> None:
    """Three cells in a row: each robot would have to pass the other one."""
    scenario = grid_fleet(["..."], [("N0", "N2"), ("N2", "N0")])
    with pytest.raises(NoPlanExists):
        find_best_timetable(scenario, time_limit=None, rounds=3)


@pytest.mark.parametrize("time_limit", [-5, math.nan])
def test_a_time_limit_that_is_no_time_is_refused(time_limit: float) -> None:
    scenario = grid_fleet(["..."], [("N0", "N2")])
    for call in (run_laps, find_best_timetable):
        with pytest.raises(InputError, match=r"time_limit: (-5|nan) is no number of seconds"):
            call(scenario, time_limit=time_limit)
