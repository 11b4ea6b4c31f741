"""Laws of shifts: what robots have done keeps the rules of one plan, with delays and without."""

from __future__ import annotations

from random import Random

from hypothesis import strategies as st

from rightofway.check import check
from rightofway.io.scenario.reader import parse_scenario
from tests.builders.laws import law
from tests.builders.shifts import LONG, draw_shift, hold_shift
from tests.builders.work_scenarios import draw_work_document

OF_DELAYS = {"wrong duration", "too late"}
"""Faults that a plan of delayed work has: it lasts longer, and may end too late."""

SEEDS = st.integers(0, 100)


@law(SEEDS)
def test_a_shift_without_delays_is_one_plan_that_keeps_the_rules(seed: int) -> None:
    record = draw_shift(seed, windows=False)
    report = check(record.make_plan())
    assert report.ok, str(report)


@law(SEEDS)
def test_without_delays_only_jobs_that_are_begun_may_end_too_late(seed: int) -> None:
    record = draw_shift(seed)
    report = check(record.make_plan())
    assert {"too late"}.issuperset(report.counts), str(report)
    for fault in report.faults:
        job = record.jobs[fault.numbers["item"].values["job"]]
        assert job.begun is not None
        assert fault.numbers["item"].values["number"] == len(job.job.stops) > 1


@law(SEEDS)
def test_a_shift_whose_rounds_take_time_is_one_plan_that_keeps_the_rules(seed: int) -> None:
    record = draw_shift(seed, windows=False, lead=3)
    report = check(record.make_plan())
    assert report.ok, str(report)


@law(SEEDS)
def test_delays_do_no_more_than_make_work_longer_and_later(seed: int) -> None:
    scenario = parse_scenario(draw_work_document(seed, n_robots=3, n_jobs=8))
    delays = "exponential:0.5,chance:0.1x5"
    record = hold_shift(scenario, seed=seed, lead=2 * (seed % 2), delays=delays)
    report = check(record.make_plan())
    assert OF_DELAYS.issuperset(report.counts), str(report)


@law(SEEDS)
def test_all_jobs_without_windows_are_done_or_have_a_reason(seed: int) -> None:
    record = draw_shift(seed, windows=False)
    assert record.until < LONG  # it is over once no job can be done any more
    for own in record.jobs.values():
        assert (own.ended is None) == (own.reason is not None)


ROWS, COLUMNS = 4, 6


@law(SEEDS)
def test_every_job_of_a_well_formed_fleet_is_begun_in_time(seed: int) -> None:
    # Homes are in the last row with cells without homes between them, so that each robot comes
    # home on a way without other homes. Jobs are in the other rows, and arrive faster than done.
    draw = Random(seed)  # noqa: S311
    cells = [f"N{cell}" for cell in range((ROWS - 1) * COLUMNS)]
    homes = [f"N{(ROWS - 1) * COLUMNS + column}" for column in range(0, COLUMNS, 2)]
    patience = draw.choice([0, 15, 40])
    scenario = parse_scenario(
        {
            "format": "rightofway-scenario/1",
            "map": {"grid": ["." * COLUMNS] * ROWS},
            "robots": [
                {"name": home, "home": home} for home in homes[: draw.randint(1, len(homes))]
            ],
            "rules": {"turn": 0, "patience": patience},
            "jobs": [
                {
                    "name": f"J{number}",
                    "pickup": draw.choice(cells),
                    "dropoff": draw.choice(cells),
                    "weight": draw.choice([1, 1, 20]),
                    "earliest": 2 * number,
                }
                for number in range(14)
            ],
        }
    )
    record = hold_shift(scenario, seed=seed)
    # A robot alone ends a begun job, drives to the next one, ends it and drives home.
    longest = 4 * (ROWS + COLUMNS)
    for number, own in enumerate(record.jobs.values()):
        assert own.begun is not None
        older = sum(
            other.ended is None or other.ended > own.known
            for other in list(record.jobs.values())[:number]
        )
        assert own.begun <= own.known + patience + (older + 1) * longest
