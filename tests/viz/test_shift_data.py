"""A shift as its page gets it."""

from __future__ import annotations

from dataclasses import replace

from rightofway.facts import Fact
from rightofway.viz.page.document import as_compact_json
from rightofway.viz.page.shift_data import make_shift_page, make_shift_payload
from tests.builders.payloads import template_in
from tests.builders.shifts import make_shift


def test_the_times_of_robots_add_up_to_the_shift() -> None:
    record = make_shift()
    shift = make_shift_payload(record)["shift"]
    assert [sum(row[1:]) for row in shift["robots"]] == [record.until, record.until]
    assert sum(row[0] for row in shift["robots"]) == shift["done"] == 3


def test_slices_add_up_to_all_jobs_done_and_late() -> None:
    # J3 is known at 30 and due at 31.
    shift = make_shift_payload(make_shift())["shift"]
    assert sum(row[1] for row in shift["slices"]) == 3
    assert sum(row[2] for row in shift["slices"]) == shift["late"] == 1
    assert shift["slices"][-1][0] == shift["until"]


def test_jobs_come_in_the_order_in_which_they_became_known() -> None:
    payload = make_shift_payload(make_shift())
    assert payload["shift"]["known"] == [0, 0, 4, 30]
    assert [job["name"] for job in payload["work"]["jobs"]] == ["J1", "J4", "J2", "J3"]


def test_a_job_that_is_not_done_has_its_reason_and_no_times() -> None:
    payload = make_shift_payload(make_shift())
    left = payload["work"]["jobs"][1]
    assert template_in(payload, left["reason"]) == "unserved latest"
    assert not {"robot", "times"} & left.keys()
    ((reason, count),) = payload["shift"]["unserved"]
    assert (template_in(payload, reason), count) == ("unserved latest", 1)


def test_a_job_under_way_at_the_end_has_its_robot_and_no_times() -> None:
    payload = make_shift_payload(make_shift(until=8))
    job = payload["work"]["jobs"][0]
    assert "robot" in job
    assert not {"times", "reason"} & job.keys()
    assert payload["shift"]["underWay"] == 1
    assert payload["end"] == 8


def test_nothing_is_told_that_only_a_planner_may_tell() -> None:
    payload = make_shift_payload(make_shift())
    assert payload["planner"] == {"name": "", "method": ""}
    assert not payload["decisions"]
    assert not payload["losses"]
    assert payload["faults"]["count"] == 0
    assert not any("costs" in job for job in payload["work"]["jobs"])


def test_rounds_have_their_times_and_facts() -> None:
    record = make_shift()
    first = replace(record.rounds[0], seconds=0.25, stands=True)
    payload = make_shift_payload(replace(record, rounds=(first, *record.rounds[1:])))
    assert payload["shift"]["rounds"][0] == (0, 0, 250, 2, 1)
    assert len(payload["shift"]["rounds"]) == len(record.rounds)


def test_rounds_tell_why_they_began_before_their_facts() -> None:
    record = make_shift()
    reasons, facts = (Fact("jobs became known", jobs=2),), (Fact("old plan stands", reason="x"),)
    first = replace(record.rounds[0], reasons=reasons, facts=facts)
    payload = make_shift_payload(replace(record, rounds=(first,)))
    told = [(index, template_in(payload, text)) for index, text in payload["shift"]["told"]]
    assert told == [(0, "jobs became known"), (0, "old plan stands")]


def test_batteries_are_those_that_were_measured() -> None:
    record = make_shift()
    tours = make_shift_payload(record)["work"]["tours"]
    assert [tour["charges"][0] for tour in tours] == [(0, 1.0), (0, 1.0)]
    assert tours[0]["charges"][-1][0] == record.robots[0].soc[-1][0]


def test_a_robot_that_stops_for_good_is_an_event() -> None:
    record = make_shift()
    record.robots[1].lost = 7
    payload = make_shift_payload(record)
    ((tick, text),) = payload["shift"]["happened"]
    assert (tick, template_in(payload, text)) == (7, "robot does not go on")


def test_only_the_page_of_a_shift_has_what_shows_it() -> None:
    page = make_shift_page(make_shift(), title="hall")
    assert "class ShiftChart" in page
    assert "<title>hall: a shift of 2 robots</title>" in page


def test_a_shift_without_a_job_done_is_shown() -> None:
    payload = make_shift_payload(make_shift(until=1))
    assert payload["shift"]["done"] == 0
    assert "service" not in payload["shift"]
    assert as_compact_json(payload)
