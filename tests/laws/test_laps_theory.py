"""The period by theory is the period that the simulation finds, to the tick, under every rule."""

from __future__ import annotations

from fractions import Fraction

import pytest

from rightofway.cyclic import CyclicResult, run_laps
from rightofway.errors import InputError
from rightofway.model import Rules
from rightofway.planners import planning_headway
from rightofway.precedence import TimedEventGraph
from tests.builders.fleets import random_fleet

FLEETS = 40
RULES = [Rules(), Rules(headway=Fraction(1)), Rules(occupancy="both"), Rules(rotations=False)]


@pytest.mark.parametrize("rules", RULES, ids=["one", "headway", "both", "no rotations"])
@pytest.mark.parametrize("rule", ["first-come", "fixed-order", "two-level"])
def test_the_period_by_theory_is_the_period_of_the_simulation(rule: str, rules: Rules) -> None:
    repeats = 0
    for seed in range(FLEETS):
        scenario = random_fleet(seed, size=4 + seed % 4, robots=2 + seed % 4, rules=rules)
        try:
            run = run_laps(scenario, rule, time_limit=2)
        except InputError:
            continue  # a robot that works where it lives
        repeats += agrees(run)
    assert repeats > FLEETS // 4


def agrees(run: CyclicResult) -> int:
    """Return how many groups repeat; fail if theory says another period of one of them."""
    ahead, repeats = run.scenario.rules.books_ahead, 0
    for group in run.groups:
        if group.timetable is None or len(group.robots) == 1:
            continue
        headway = planning_headway(run.scenario)
        graph = TimedEventGraph(group.timetable, headway=headway, books_ahead=ahead)
        assert graph.critical_circuit().cycle_time == group.timetable.period
        assert graph.slack().min() >= 0
        repeats += 1
    return repeats
