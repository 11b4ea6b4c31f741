"""The report on a probe of one robot."""

from __future__ import annotations

from rightofway.execution.probe_result import ProbeFinding, ProbeResult
from rightofway.facts import Fact
from rightofway.report.probe import report_probe


def test_keys_that_are_null_are_one_finding_of_the_report() -> None:
    keys = ["loads", "paused", "velocity"]
    findings = [
        ProbeFinding(step="state", verdict="departs", fact=Fact("key null", key=key))
        for key in keys
    ]
    others = [
        ProbeFinding(step="state", verdict="departs", fact=Fact("key missing", key="driving")),
        ProbeFinding(step="factsheet", verdict="departs", fact=Fact("key null", key="loadSets")),
    ]
    result = ProbeResult(
        manufacturer="ACME", serial_number="1", version="2.1.0", interface="uagv", map_id=None,
        messages={"state": 3}, findings=(*findings, *others),
    )  # fmt: skip
    text = " ".join(report_probe(result).split())
    assert "state DEPARTS loads, paused, velocity are null; keys without a value have to" in text
    assert "factsheet DEPARTS loadSets is null; a key without a value has to be left out" in text
    assert "5 departures from the norm" in text
