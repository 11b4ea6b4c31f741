"""The jobs of a plan in reports: who does each of them, when and how late, and who does none."""

from __future__ import annotations

from dataclasses import replace
from datetime import datetime

import pytest

from rightofway.io import parse_scenario
from rightofway.metrics import list_job_times, measure
from rightofway.model import Plan, PlannerRun, Tick, Track
from rightofway.model.scenario import assign_tours
from rightofway.model.work import TourItem
from rightofway.report.jobs import make_jobs_data
from rightofway.report.plan import summarize_plan
from rightofway.report.plan_data import make_summary_data
from rightofway.report.quantities import Quantities
from rightofway.units import Units


@pytest.fixture(scope="module")
def plan() -> Plan:
    """Return a plan in which R1 carries J1 too late, and nobody does J2."""
    scenario = parse_scenario(
        {
            "format": "rightofway-scenario/1",
            "map": {"grid": ["...."]},
            "robots": [{"name": "R1", "home": "N0"}],
            "jobs": [
                {"name": "J1", "pickup": "N1", "dropoff": "N3", "earliest": 2, "due": 4},
                {"name": "J2", "at": "N2", "types": ["fork"]},
            ],
        }
    )
    jobs = scenario.jobs or ()
    tour = tuple(
        TourItem(job=0, stop=k, vertex=jobs[0].stops[k].at, duration=Tick(0)) for k in (0, 1)
    )
    track = Track.of([0, 1, 2, 3, 2, 1, 0], [0, 1, 4, 5, 7, 8, 9])
    return Plan(
        scenario=assign_tours(scenario, [tour]),
        tracks=(track,),
        run=PlannerRun(name="by hand", options={}, seed=0),
        unserved=((1, "robot"),),
    )


def test_times_of_jobs_follow_from_tours(plan: Plan) -> None:
    """The service time counts from `earliest`, lateness from `due`."""
    (job,) = list_job_times(plan)
    assert (job.job, job.robot, job.begin, job.end) == (0, 0, 2, 5)
    assert (job.service_time, job.late) == (3, 1)
    metrics = measure(plan)
    assert (metrics.service_time, metrics.lateness, metrics.unserved) == (3, 1, 1)


def test_a_report_lists_jobs_and_says_why_others_are_not_served(plan: Plan) -> None:
    """Costs count the jobs, a table has those that are done, a sentence each of the others."""
    lines = str(summarize_plan(plan, Quantities.of(plan.scenario))).splitlines()
    assert ["jobs", "1", "of", "2", "done"] in [line.split() for line in lines]
    assert ["J1", "R1", "2", "5", "1"] in [line.split() for line in lines]
    assert "J2 is not served: no robot may do it and can carry it" in lines


def test_jobs_begin_and_end_at_times_of_day_where_the_scenario_has_a_start(plan: Plan) -> None:
    """They last, and are late, in units of time."""
    start = datetime(2026, 11, 28, 6)  # noqa: DTZ001 (without an offset)
    scenario = replace(plan.scenario, units=Units(start=start))
    clocked = replace(plan, scenario=scenario)
    lines = str(summarize_plan(clocked, Quantities.of(scenario))).splitlines()
    assert ["J1", "R1", "06:00:02", "06:00:05", "1"] in [line.split() for line in lines]
    assert make_summary_data(clocked)["units"] == {
        "length": None,
        "time": "s",
        "start": "2026-11-28T06:00",
    }


def test_a_report_compares_no_plan_of_jobs_with_a_bound_of_trips(plan: Plan) -> None:
    """A robot that is ready later has a bound above 0, which knows no tour."""
    metrics = measure(plan)
    assert metrics.gap is None
    assert "the lower bound" not in str(summarize_plan(plan, Quantities.of(plan.scenario)))
    data = make_summary_data(plan)
    assert data["metrics"]["gap"] is None


def test_programs_read_jobs_and_reasons_as_kinds(plan: Plan) -> None:
    """Names, ticks and kinds: no sentence."""
    assert make_jobs_data(plan) == {
        "jobs": [{"name": "J1", "robot": "R1", "begin": 2, "end": 5, "service_time": 3, "late": 1}],
        "unserved": [{"job": "J2", "reason": "robot"}],
    }
