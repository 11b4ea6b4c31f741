"""Overdue jobs are assigned first, and no job of a well formed fleet starves."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from rightofway.model import Tick
from tests.builders.shifts import hold_shift, make_scenario


def hold_busy_shift(patience: int, **distant: Any) -> int | None:
    """Return when a distant job is begun, while near ones arrive faster than they are done."""
    near = [
        {"name": f"J{k}", "pickup": "N3", "dropoff": "N1", "earliest": 3 * k} for k in range(40)
    ]
    jobs = [{"name": "distant", "at": "N9", **distant}, *near]
    rules = {"patience": patience}
    scenario = make_scenario(["." * 10], {"R1": "N0"}, jobs=jobs, rules=rules)
    return hold_shift(scenario, until=Tick(150)).jobs["distant"].begun


def test_service_alone_leaves_a_distant_job_to_the_end() -> None:
    begun = hold_busy_shift(1000)
    assert begun is None or begun > 100


def test_a_job_past_its_patience_is_assigned_first() -> None:
    begun = hold_busy_shift(30)
    # It is overdue from 30 on. R1 ends the job that it has begun, within 4 ticks, and drives there,
    # at most 8 cells.
    assert begun is not None
    assert 30 < begun <= 30 + 4 + 8 + 1


def test_a_job_past_its_due_is_assigned_first() -> None:
    begun = hold_busy_shift(1000, due=20, weight="1/1000")
    assert begun is not None
    assert begun <= 20 + 4 + 8 + 1


def test_older_overdue_jobs_are_not_delayed_by_later_ones() -> None:
    jobs = [
        {"name": "old", "at": "N9", "due": 1},
        {"name": "young", "at": "N1", "due": 2, "work": 30, "weight": 1000},
    ]
    record = hold_shift(make_scenario(["." * 10], {"R1": "N0"}, jobs=jobs, rules={"late": 10}))
    # Both become known at 0 and are not overdue then: young first, as it weighs more.
    assert record.jobs["young"].begun == 1
    jobs = [{**job, "earliest": Fraction(0)} for job in jobs]
    scenario = make_scenario(
        ["." * 10], {"R1": {"home": "N0", "start": {"at": "N0", "ready": 5}}}, jobs=jobs
    )
    record = hold_shift(scenario, lead=5)
    # The round takes over at 5, when both are overdue: old first, 9 cells away.
    assert record.jobs["old"].begun == 5 + 9
