"""A chosen timetable has no conflict, round the seam neither, and is never below its rival."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from rightofway.cyclic import GroupTimetable, best_timetable, plan_of, run_laps, run_of
from rightofway.errors import GaveUp, InputError
from rightofway.model import Rules, Scenario
from rightofway.planners import planning_headway
from rightofway.precedence import critical_circuit
from tests.builders.fleets import random_fleet
from tests.oracles import periodic_bookings as oracle

law = settings(max_examples=30, derandomize=True, deadline=None)
RULES = [Rules(), Rules(headway=Fraction(2)), Rules(occupancy="both"), Rules(rotations=False)]


def chosen(scenario: Scenario, *, rounds: int = 6) -> list[GroupTimetable]:
    """Choose where that is possible; how well is not the point here."""
    try:
        return best_timetable(scenario, time_limit=None, rounds=rounds, seed=3)
    except (GaveUp, InputError):
        assume(False)
        raise


@st.composite
def fleets(draw: st.DrawFn) -> Scenario:
    return random_fleet(
        draw(st.integers(0, 10**6)),
        size=draw(st.integers(4, 7)),
        robots=draw(st.integers(2, 4)),
        rules=draw(st.sampled_from(RULES)),
    )


@law
@given(fleets())
def test_three_periods_of_a_chosen_timetable_have_no_fault(scenario: Scenario) -> None:
    groups = chosen(scenario)
    headway, ahead = planning_headway(scenario), scenario.rules.books_ahead
    for group in groups:
        assert oracle.faults(group.timetable, headway=headway, books_ahead=ahead) == []
        period = group.timetable.period
        found = critical_circuit(group.timetable, headway=headway, books_ahead=ahead)
        assert found.cycle_time == period or found.cycle_time > period - 1
        assert group.worth == sum(group.timetable.counts)
        assert min(group.timetable.counts) >= 1
        assert 0 < group.fairness <= 1
    robots = sorted(robot for group in groups for robot in group.timetable.robots)
    assert robots == list(range(len(scenario.robots)))
    places = [
        {vertex for lap in group.timetable.laps for vertex in lap.vertices} for group in groups
    ]
    assert sum(map(len, places)) == len(set().union(*places))


@law
@given(fleets())
def test_it_is_never_below_first_come_first_served(scenario: Scenario) -> None:
    groups = chosen(scenario)
    rival = run_laps(scenario, "first-come", time_limit=None)
    for own, other in zip(groups, rival.groups, strict=True):
        starves = other.ends == "repeats" and not all(other.mean_laps())
        assert own.first_come_ends == ("starves" if starves else other.ends)
        if other.ends == "repeats":
            means = [mean for mean in other.mean_laps() if mean]
            assert own.first_come == sum((1 / mean for mean in means), Fraction(0))
            assert starves or own.throughput >= own.first_come


@settings(law, max_examples=10)
@given(fleets())
def test_the_same_seed_and_rounds_give_the_same_timetable(scenario: Scenario) -> None:
    one, other = chosen(scenario, rounds=3), chosen(scenario, rounds=3)
    for first, second in zip(one, other, strict=True):
        assert first.timetable.counts == second.timetable.counts
        assert [list(e) for e in first.timetable.enter] == [list(e) for e in second.timetable.enter]


@law
@given(fleets())
def test_the_judge_passes_its_laps_as_a_plan(scenario: Scenario) -> None:
    run = run_of(scenario, chosen(scenario))
    homes = {robot.home for robot in scenario.robots}
    assume(
        not any(
            homes.intersection(endless.lap.vertices[1:]) for g in run.groups for endless in g.group
        )
    )
    plan = plan_of(run)
    assert min(robot.laps or 0 for robot in plan.scenario.robots) >= 2


def test_nobody_starves_below_the_bound() -> None:
    scenario = random_fleet(1, size=8, robots=8)
    groups = best_timetable(
        scenario, least_fairness=Fraction(1, 2), time_limit=None, rounds=20, seed=1
    )
    assert min(group.fairness for group in groups) >= Fraction(1, 2)
    with pytest.raises(GaveUp, match="fair enough"):
        best_timetable(scenario, least_fairness=Fraction(1), time_limit=None, rounds=3)


def test_weights_shift_laps_to_who_is_worth_more() -> None:
    scenario = random_fleet(1, size=8, robots=8)
    plain = best_timetable(scenario, time_limit=None, rounds=20, seed=1)

    def part(groups: list[GroupTimetable], robot: int) -> Fraction:
        """How many of its laps alone a robot makes."""
        group = next(group for group in groups if robot in group.timetable.robots)
        table, place = group.timetable, group.timetable.robots.index(robot)
        laps = table.counts[place] * table.laps[place].duration
        return Fraction(laps, int(table.period))

    least = min(range(8), key=lambda robot: part(plain, robot))
    weights = [Fraction(100 if robot == least else 1) for robot in range(8)]
    heavy = best_timetable(scenario, weights=weights, time_limit=None, rounds=20, seed=1)
    assert part(heavy, least) > part(plain, least)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"weights": [Fraction(1)]}, "weights: 1 for 2 robots"),
        ({"weights": [Fraction(1), Fraction(0)]}, r"weights\[1\]: 0 is not above 0"),
        ({"least_fairness": Fraction(2)}, "least_fairness: 2 is not from 0 to 1"),
        ({"time_limit": None}, "rounds: neither they nor the time are limited"),
    ],
)
def test_what_does_not_fit_is_refused(options: dict[str, object], message: str) -> None:
    scenario = random_fleet(3, size=5, robots=2)
    with pytest.raises(InputError, match=message):
        best_timetable(scenario, **options)  # type: ignore[arg-type]
