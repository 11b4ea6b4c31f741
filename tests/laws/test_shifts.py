"""Laws of shifts: what robots have done keeps the rules of one plan, with delays and without."""

from __future__ import annotations

from itertools import pairwise
from random import Random
from typing import Any

import pytest
from hypothesis import strategies as st

from rightofway.check import check
from rightofway.dispatch import ShiftRecord, routes
from rightofway.io.scenario.reader import parse_scenario
from rightofway.model import Scenario
from tests.builders.laws import law, once
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


def list_silent(record: ShiftRecord, bound: int) -> list[tuple[int, int]]:
    """Return stretches over a bound in which a job waits, nothing moves, and no fact is told.

    This observer reads the record alone: visits, works and charges, jobs, and facts. A job waits
    from when it is known and all its times have begun, until it ends or leaves.
    """
    left = {event.name: event.at for event in record.events if event.kind == "job unserved"}
    moves = {0, record.until}
    for robot in record.robots:
        moves.update(robot.enter)
        moves.update(tick for step in robot.steps for tick in range(step.begin, step.end + 1))
    ticks = sorted(tick for tick in moves if tick <= record.until)
    told = [tick for tick, fact in record.facts if fact.kind == "nothing moves"]
    silent = list[tuple[int, int]]()
    for begin, end in pairwise(ticks):
        for name, own in record.jobs.items():
            waits_from = max([own.known, *(int(stop.earliest) for stop in own.job.stops), begin])
            gone = left.get(name, record.until) if own.ended is None else own.ended
            is_told = any(begin <= tick <= waits_from + bound for tick in told)
            if min(end, gone) - waits_from > bound and not is_told:
                silent.append((begin, end))
    return silent


@law(SEEDS, st.sampled_from([0, 3]), st.booleans())
def test_no_job_waits_in_silence(seed: int, lead: int, has_delays: bool) -> None:
    if has_delays:
        scenario = parse_scenario(draw_work_document(seed, n_robots=3, n_jobs=8))
        delays = f"stop:{scenario.robots[0].name}@{seed % 7},chance:0.1x5"
        record = hold_shift(scenario, seed=seed, lead=lead, delays=delays)
    else:
        record = draw_shift(seed, lead=lead)
    # A round, its takeover, a drive or a stoppage.
    assert list_silent(record, 3 * max(1, lead) + 10) == []


CROWDED_HALL = ["......", ".@.@@.", "......", ".@@.@.", "......"]


def draw_crowd(seed: int) -> Scenario:
    """Return a fleet on half of all cells or more, whose robots stay anywhere, and its jobs."""
    draw = Random(seed)  # noqa: S311
    grid = "".join(CROWDED_HALL)
    cells = [f"N{cell}" for cell, kind in enumerate(grid) if kind == "."]
    homes = draw.sample(cells, draw.choice([12, 16, 18]))
    return parse_scenario(
        {
            "format": "rightofway-scenario/1",
            "map": {"grid": CROWDED_HALL},
            "robots": [{"name": home, "home": home} for home in homes],
            "rules": {"turn": 0, "return": "none", "rotations": draw.choice([False, True])},
            "jobs": [
                {"name": f"J{number}", "pickup": pickup, "dropoff": dropoff}
                for number, (pickup, dropoff) in enumerate(
                    draw.sample(cells, 2) for _ in range(draw.randint(1, 20))
                )
            ],
        }
    )


@law(SEEDS, st.sampled_from([0, 2]))
@once(seed=0, lead=0)
def test_a_crowded_fleet_without_time_for_evictions_does_its_jobs_and_keeps_the_rules(
    seed: int, lead: int
) -> None:
    with pytest.MonkeyPatch.context() as changes:
        changes.setattr(routes, "SEARCHES", 0)
        record = hold_shift(draw_crowd(seed), seed=seed, lead=lead)
    report = check(record.make_plan())
    assert report.ok, str(report)
    assert all(own.ended is not None for own in record.jobs.values())


ROWS, COLUMNS = 4, 6
ACROSS = ROWS + COLUMNS
"""No way on the grid of the next law is longer, not even round some other homes [ticks]."""


def draw_well_formed(seed: int, *, has_batteries: bool) -> Scenario:
    """Return a fleet that can do its jobs one at a time, and jobs that arrive faster than done.

    Homes are in the last row with cells without homes between them, so that each robot comes home
    on a way without other homes. Jobs are in the other rows. A full battery lasts for a job.
    """
    draw = Random(seed)  # noqa: S311
    cells = [f"N{cell}" for cell in range((ROWS - 1) * COLUMNS)]
    homes = [f"N{(ROWS - 1) * COLUMNS + column}" for column in range(0, COLUMNS, 2)]
    document: dict[str, Any] = {
        "format": "rightofway-scenario/1",
        "map": {"grid": ["." * COLUMNS] * ROWS},
        "robots": [{"name": home, "home": home} for home in homes[: draw.randint(1, len(homes))]],
        "rules": {"turn": 0, "patience": draw.choice([0, 15, 40])},
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
    if has_batteries:
        document["batteries"] = {
            "tank": {
                "drive": draw.choice(["1/40", "1/60"]),
                "on": draw.choice([0, "1/1000"]),
                "charge": f"1/{CHARGE}",
                "reserve": "1/10",
            }
        }
        for robot in document["robots"]:
            robot |= {"battery": "tank", "charging": [robot["home"]]}
    return parse_scenario(document)


CHARGE = 20
"""How long a full charge takes [ticks]."""


@law(SEEDS, st.booleans())
def test_every_job_of_a_well_formed_fleet_is_begun_in_time(seed: int, has_batteries: bool) -> None:
    scenario = draw_well_formed(seed, has_batteries=has_batteries)
    record = hold_shift(scenario, seed=seed)
    patience = int(scenario.rules.patience or 0)
    # A robot alone ends a begun job, drives home and charges, if it has to, and to the next job,
    # ends it and drives home.
    longest = 5 * ACROSS + CHARGE if has_batteries else 4 * ACROSS
    for number, own in enumerate(record.jobs.values()):
        assert own.begun is not None
        older = sum(
            other.ended is None or other.ended > own.known
            for other in list(record.jobs.values())[:number]
        )
        assert own.begun <= own.known + patience + (older + 1) * longest
