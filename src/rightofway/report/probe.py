"""The report on a probe of one robot."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import groupby

from rightofway.execution.probe_result import ProbeFinding, ProbeResult
from rightofway.facts import Fact
from rightofway.report.facts import FactWriter
from rightofway.report.lines import Facts, Part, lay_out
from rightofway.report.phrases import chain_items, say_count

__all__ = ["report_probe"]

MARKS = {"ok": "ok", "note": "note", "departs": "DEPARTS", "blocks": "BLOCKS"}
"""The mark of each kind of finding."""


def report_probe(result: ProbeResult) -> str:
    """Return the findings step by step, and how many of them are departures.

    Parameters
    ----------
    result
        The result of the probe.
    """
    writer = FactWriter(None)
    column = max((len(finding.step) for finding in result.findings), default=0)
    mark = max(map(len, MARKS.values()))
    rows, last = [], ""
    for finding in _join_nulls(result.findings):
        step = "" if finding.step == last else finding.step
        last = finding.step
        key = f"{step:{column}}  {MARKS[finding.verdict]:{mark}}"
        rows.append((key, str(writer.write(finding.fact))))
    head: list[Part] = [_describe_robot(result), ""]
    return lay_out([*head, Facts(rows), "", _sum_up(result)])


def _join_nulls(findings: Sequence[ProbeFinding]) -> Iterator[ProbeFinding]:
    """Yield findings; keys that are null are one finding of a step: some robots have dozens."""
    for (step, kind), group in groupby(findings, lambda finding: (finding.step, finding.fact.kind)):
        rows = list(group)
        if kind == "key null" and len(rows) > 1:
            keys = tuple(row.fact.values["key"] for row in rows)
            yield replace(rows[0], step=step, fact=Fact("keys null", keys=keys))
        else:
            yield from rows


def _describe_robot(result: ProbeResult) -> str:
    """Return the first line: the robot, its version and how many messages it has sent."""
    name = f"{result.manufacturer}/{result.serial_number}"
    if result.version is None:
        return name
    messages = chain_items([f"{count} {topic}" for topic, count in result.messages.items()])
    return f"{name}, VDA 5050 {result.version} at {result.interface}; heard {messages}"


def _sum_up(result: ProbeResult) -> str:
    blocking = say_count(result.count("blocks"), "finding blocks", "findings block")
    departures = say_count(
        result.count("departs"), "departure from the norm", "departures from the norm"
    )
    return f"{departures}; {blocking} the control"
