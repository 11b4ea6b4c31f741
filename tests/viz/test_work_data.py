"""Jobs and tours as the page gets them."""

from __future__ import annotations

from typing import Any

from rightofway.model import Plan
from rightofway.viz.motion import Phase, end_of, make_trips
from rightofway.viz.page.document import make_page
from rightofway.viz.page.payload import make_payload
from rightofway.viz.page.schema import WorkData
from tests.builders.payloads import template_in
from tests.builders.planned_jobs import make_plan
from tests.builders.plans import door


def _make_work(plan: Plan) -> WorkData:
    return make_payload(plan)["work"]


def test_a_job_has_its_stops_its_robot_and_its_times() -> None:
    # J1 loads at 1 from 3 to 5, and unloads at 3 from 8 to 9; it may begin at 3.
    job = _make_work(make_plan())["jobs"][0]
    assert job["name"] == "J1"
    assert job["robot"] == 0
    assert job["stops"] == [(1, 1, 3, 5), (3, -1, 8, 9)]
    assert job["times"] == (3, 9, 6, 0)
    assert "reason" not in job


def test_the_part_of_a_begun_job_that_is_done_has_no_time() -> None:
    job = _make_work(make_plan())["jobs"][2]
    assert job["stops"] == [(8, 1, -1, -1), (7, -1, 4, 4)]


def test_an_unserved_job_has_its_reason_and_no_robot() -> None:
    payload = make_payload(make_plan())
    job = payload["work"]["jobs"][3]
    assert template_in(payload, job["reason"]) == "unserved not found"
    assert not {"robot", "times"} & job.keys()


def test_robots_are_compared_for_a_job_those_of_least_cost_first() -> None:
    # J4 is at 2, and may begin where J1 ends, at 9: R1 is at 3 then, R2 on its way to J2.
    costs = _make_work(make_plan())["jobs"][3]["costs"]
    assert [robot for robot, _ in costs] == [0, 1]


def test_a_tour_has_its_items_with_the_load_after_each_and_the_battery() -> None:
    # The last item is a charge at 0.
    tour = _make_work(make_plan())["tours"][0]
    assert tour["items"] == [(0, 0, 1, 3, 5, 1), (0, 1, 3, 8, 9, 0), (-1, -1, 0, 13, 15, 0)]
    assert tour["reserve"] == 0.2
    assert tour["charges"][:2] == [(0, 1.0), (1, 0.89)]
    assert "charges" not in _make_work(make_plan())["tours"][1]


def test_a_robot_waits_until_the_work_of_its_job_begins() -> None:
    # R1 comes to 1 at 1; the work begins at 3.
    trip = make_trips(make_plan())[0]
    assert list(trip.trace_phases(1)) == [
        (1, 3, Phase.WAIT),
        (3, 5, Phase.WORK),
        (5, 6, Phase.TURN),
        (6, 7, Phase.DRIVE),
    ]
    assert end_of(make_trips(make_plan())) == 15


def test_robots_of_a_plan_with_jobs_that_rest_are_done() -> None:
    payload = make_payload(make_plan())
    assert not any("stands" in robot for robot in payload["robots"])
    assert payload["robots"][0]["begins"] == [3, 8, 13, 0]


def test_charging_places_of_a_scenario_are_on_the_map() -> None:
    assert make_payload(make_plan())["map"]["charging"] == [0, 1]


def test_other_plans_that_are_compared_have_no_jobs() -> None:
    payload = make_payload(make_plan(), title="A", others=[(make_plan(), "B")])
    assert "work" not in payload["others"][0]


def test_only_a_page_with_jobs_has_what_shows_them() -> None:
    """Scripts, labels and style of jobs."""
    marks: tuple[Any, ...] = ("class JobCards", "Why this robot", ".soc-curve")
    with_jobs, without = make_page(make_plan()), make_page(door())
    assert all(mark in with_jobs for mark in marks)
    assert not any(mark in without for mark in marks)
