"""Loads and batteries of tours over time, by hand."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction

from rightofway.io import parse_scenario
from rightofway.metrics import trace_tours
from rightofway.solve import solve
from tests.builders.planned_jobs import BATTERY, make_plan
from tests.builders.work_scenarios import draw_work_document


def _percent(charges: Sequence[tuple[int, Fraction]]) -> list[tuple[int, int]]:
    assert all((100 * soc).denominator == 1 for _, soc in charges)
    return [(tick, int(100 * soc)) for tick, soc in charges]


def test_the_load_is_told_after_each_item() -> None:
    # R1 loads at the first stop, unloads at the second and charges; R2 begins with a load of J3.
    first, second = trace_tours(make_plan())
    assert first.loads == (1, 0, 0)
    assert second.loads == (0, 0)


def test_the_state_of_charge_is_told_where_its_rate_changes() -> None:
    # 10% for each drive, 1% for each tick, 2% more while R1 works at 3 to 5 and 8 to 9; it charges
    # 20% a tick at 13 to 15. It drives until 1, from 6 to 8 and from 10 to 13.
    first, second = trace_tours(make_plan())
    assert _percent(first.charges) == [
        (0, 100), (1, 89), (3, 87), (5, 81), (6, 80),
        (8, 58), (9, 55), (10, 54), (13, 21), (15, 61),
    ]  # fmt: skip
    assert first.reserve == Fraction(1, 5)
    assert (second.charges, second.reserve) == ((), None)


def test_a_full_battery_stays_full() -> None:
    plan = make_plan(batteries={"large": replace(BATTERY, charge=Fraction(1))})
    assert _percent(trace_tours(plan)[0].charges)[-3:] == [(13, 21), (14, 100), (15, 100)]


def test_no_battery_falls_below_its_reserve_in_a_judged_plan() -> None:
    for seed in range(30):
        plan = solve(parse_scenario(draw_work_document(seed)), "prioritized")
        for course in trace_tours(plan):
            assert all(soc >= course.reserve for _, soc in course.charges if course.reserve)
