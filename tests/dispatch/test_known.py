"""Jobs of a shift become known by a duration, by a table, or at random times."""

from __future__ import annotations

from fractions import Fraction
from statistics import mean
from typing import Any

import pytest

from rightofway.dispatch.known import plan_arrivals
from rightofway.errors import InputError
from rightofway.model import Scenario
from tests.builders.shifts import make_scenario


def make_jobs(*jobs: dict[str, Any]) -> Scenario:
    return make_scenario(["....."], {"R1": "N0"}, jobs=list(jobs))


MANY = make_jobs(*({"name": f"J{number}", "at": "N3", "work": 2} for number in range(1000)))


def draw(given: str, seed: int = 0) -> list[Fraction]:
    scenario, times = plan_arrivals(given, MANY, seed)
    assert not times  # a job is known from its earliest
    assert [job.name for job in scenario.jobs or ()] == [job.name for job in MANY.jobs or ()]
    return [job.earliest for job in scenario.jobs or ()]


def test_the_gaps_of_a_poisson_process_have_the_given_mean() -> None:
    times = draw("poisson:1/30")
    gaps = [after - before for before, after in zip([Fraction(0), *times], times, strict=False)]
    # The mean of 1000 exponential gaps of mean 30 has a standard deviation of 30 / sqrt(1000) < 1.
    assert 27 < mean(gaps) < 33
    assert times == sorted(times)


def test_uniform_times_lie_between_0_and_the_end() -> None:
    times = draw("uniform:3600")
    assert times == sorted(times)
    assert 0 <= times[0] < 60
    assert 3540 < times[-1] <= 3600


@pytest.mark.parametrize("given", ["poisson:1/30", "uniform:3600"])
def test_times_depend_on_the_seed_alone(given: str) -> None:
    assert draw(given, 7) == draw(given, 7)
    assert draw(given, 7) != draw(given, 8)


def test_drawn_times_are_whole_ticks_of_the_same_clock() -> None:
    clock = MANY.problem.clock
    scenario, _ = plan_arrivals("poisson:1/7", MANY)
    assert scenario.problem.clock == clock
    assert all(time % clock.tick == 0 for time in draw("poisson:1/7"))


def test_a_job_that_arrives_at_random_is_moved_as_a_whole() -> None:
    scenario = make_jobs(
        {"name": "J1", "stops": [
            {"at": "N1", "earliest": 50, "load": 1},
            {"at": "N2", "latest": 90, "load": -1}], "due": 70},
        {"name": "J2", "at": "N4", "due": 3, "earliest": 10},
    )  # fmt: skip
    moved, _ = plan_arrivals("uniform:1000", scenario, 3)
    first, second = moved.jobs or ()
    assert first.earliest not in {0, 50}
    # 20 after its earliest it is due, and 40 after its earliest its second stop ends at latest.
    assert first.due == first.earliest + 20
    assert first.stops[1].latest == first.earliest + 40
    assert first.stops[1].earliest >= first.earliest
    assert second.due == second.earliest - 7


@pytest.mark.parametrize(
    "given", ["poisson", "gauss:3", "poisson:0", "uniform:-1", "uniform:x", "soon", "-3"]
)
def test_a_text_that_cannot_be_read_is_refused_with_a_remedy(given: str) -> None:
    with pytest.raises(InputError) as caught:
        plan_arrivals(given, MANY)
    remedy = "write it like 600, poisson:1/30, uniform:3600 or known.csv"
    assert str(caught.value) == f"known: {given!r} cannot be read ({remedy})"
