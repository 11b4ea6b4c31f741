"""Departures of messages from VDA 5050, as a probe finds them."""

from __future__ import annotations

import json
from datetime import UTC, datetime, timedelta
from typing import Any

import pytest

from rightofway.control.conformance import MessageAudit, choose_version, find_schema
from rightofway.control.endpoints import RobotEnd, format_timestamp
from rightofway.control.identities import VERSIONS, Identity
from rightofway.control.simulated_robot import SimulatedRobot
from rightofway.control.vda5050 import StateMessage, read
from rightofway.execution.probe_result import ProbeFinding
from rightofway.facts import Fact

NOW = datetime(2026, 1, 31, 12, tzinfo=UTC)


def make_end(version: str) -> RobotEnd:
    """Return the end of a simulated robot."""
    identity = Identity(manufacturer="ACME", serial_number="A-001", version=version)
    return RobotEnd(SimulatedRobot("N0"), 0, identity, lambda: format_timestamp(NOW))


def make_state(version: str = "2.1.0") -> dict[str, Any]:
    """Return a state of a simulated robot."""
    state: dict[str, Any] = json.loads(make_end(version).report_state().payload)
    return state


def audit(*documents: Any, topic: str = "state", version: str = "2.1.0") -> list[ProbeFinding]:
    """Return the findings in messages of one topic."""
    made = MessageAudit("ACME", "A-001", version)
    for document in documents:
        made.take(topic, json.dumps(document).encode(), now=NOW)
    return list(made.findings)


@pytest.mark.parametrize("version", VERSIONS)
def test_messages_of_simulated_robots_have_no_departure(version: str) -> None:
    made, end = MessageAudit("ACME", "A-001", version), make_end(version)
    for letter in (
        end.report_connection("ONLINE"),
        end.report_state(),
        end.report_state(),
        end.report_factsheet(),
    ):
        made.take(letter.name, letter.payload, now=NOW)
    assert [finding for finding in made.findings if finding.verdict != "note"] == []
    assert made.counts == {"connection": 1, "state": 2, "factsheet": 1}


@pytest.mark.parametrize("version", VERSIONS)
def test_each_null_is_a_departure_and_the_control_reads_the_state(version: str) -> None:
    """Some robots send null in each optional field; none of these counts for a release."""
    schema = find_schema(version, "state")
    assert schema is not None
    document: Any = schema.schema
    properties, required = document["properties"], document["required"]
    optional = sorted(set(properties) - set(required))
    assert len(optional) > 3
    state = {**make_state(version), **dict.fromkeys(optional)}
    findings = audit(state, version=version)
    assert {finding.fact for finding in findings} == {Fact("key null", key=key) for key in optional}
    assert {finding.verdict for finding in findings} == {"departs"}
    assert read(StateMessage, state, "state").to_robot_state().last_place == "N0"


def test_a_departure_counts_once_and_items_of_lists_have_no_number() -> None:
    state = make_state()
    state["nodeStates"] = [
        {"nodeId": f"N{number}", "sequenceId": 2 * number} for number in range(9)
    ]
    facts = [finding.fact for finding in audit(state)]
    assert facts == [Fact("key missing", key="nodeStates[].released")]


def test_header_ids_have_to_count() -> None:
    first, second, third = ({**make_state(), "headerId": number} for number in (7, 8, 8))
    assert audit(first, second) == []
    assert audit(second, third) == [
        ProbeFinding("state", "departs", Fact("header id does not count"))
    ]
    gap = {**make_state(), "headerId": 12}
    assert audit(first, gap) == [ProbeFinding("state", "note", Fact("header id has gaps"))]


@pytest.mark.parametrize(
    "given", ["2026-01-31 12:00:00", "31.01.2026 12:00", "2026-01-31T12:00:00+01:00"]
)
def test_timestamps_of_another_form_are_one_departure(given: str) -> None:
    states = [{**make_state(), "headerId": number, "timestamp": given} for number in (1, 2)]
    found = [it.fact.kind for it in audit(*states) if it.fact.kind.startswith("timestamp")]
    assert found == ["timestamp of other form"]


def test_a_clock_that_is_an_hour_off_is_a_note() -> None:
    late = format_timestamp(NOW - timedelta(hours=1, seconds=3))
    [found] = audit({**make_state(), "timestamp": late})
    assert found == ProbeFinding("state", "note", Fact("clock differs", seconds=3600))


def test_a_header_of_another_robot_blocks() -> None:
    [found] = audit({**make_state(), "serialNumber": "A-002"})
    expected = Fact("header contradicts topic", key="serialNumber", given="'A-002'", wanted="A-001")
    assert found == ProbeFinding("state", "blocks", expected)


def test_a_state_that_the_control_cannot_use_blocks() -> None:
    state = make_state()
    del state["lastNodeId"]
    departs, blocks = audit(state)
    assert departs.fact == Fact("key missing", key="lastNodeId")
    assert blocks.verdict == "blocks"
    assert "lastNodeId" in blocks.fact.values["error"]


@pytest.mark.parametrize("payload", [b"", b"[]", b"\xff", b"{"])
def test_what_is_no_object_blocks(payload: bytes) -> None:
    made = MessageAudit("ACME", "A-001", "2.1.0")
    assert made.take("state", payload, now=NOW) is None
    assert [finding.verdict for finding in made.findings] == ["blocks"]


def test_a_retained_state_is_a_departure() -> None:
    made = MessageAudit("ACME", "A-001", "2.1.0")
    made.take("state", json.dumps(make_state()).encode(), now=NOW, is_retained=True)
    assert [finding.fact.kind for finding in made.findings] == ["state is retained"]


@pytest.mark.parametrize(
    ("given", "major", "chosen"),
    [
        ("2.0.0", "v2", "2.0.0"),
        ("2.0", "v2", "2.0.0"),
        ("3.0", "v3", "3.0.0"),
        ("1.1.0", "v1", "2.1.0"),
        (None, "v3", "3.0.0"),
        (2.1, "v2", "2.1.0"),
    ],
)
def test_the_nearest_version_is_taken(given: object, major: str, chosen: str) -> None:
    assert choose_version(given, major) == chosen
