"""The result of a probe of one robot: its findings, step by step."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

from rightofway.facts import Fact

__all__ = ["ProbeFinding", "ProbeResult", "Verdict"]

Verdict = Literal["ok", "note", "departs", "blocks"]
"""Kinds of findings: as the norm has it, a property, a departure from the norm, and a reason for
which the control cannot drive the robot."""


@dataclass(frozen=True, slots=True)
class ProbeFinding:
    """A finding of a probe.

    Attributes
    ----------
    step
        The step of the probe.
    verdict
        How it counts.
    fact
        The finding.
    """

    step: str
    verdict: Verdict
    fact: Fact

    def as_dict(self) -> dict[str, Any]:
        """Return the finding as JSON has it."""
        return {"step": self.step, "verdict": self.verdict, **self.fact.as_dict()}


@dataclass(frozen=True, slots=True, kw_only=True)
class ProbeResult:
    """The result of a probe.

    Attributes
    ----------
    manufacturer, serial_number
        The robot.
    interface, version
        The first part of its topics, and its version of VDA 5050; None for a silent robot.
    map_id
        The map of its position; None where it has reported none.
    messages
        How many messages of each topic were heard.
    findings
        The findings in their order.
    """

    manufacturer: str
    serial_number: str
    interface: str | None
    version: str | None
    map_id: str | None
    messages: Mapping[str, int]
    findings: tuple[ProbeFinding, ...]

    def count(self, verdict: Verdict) -> int:
        """Return the number of findings of a kind."""
        return sum(finding.verdict == verdict for finding in self.findings)

    def as_dict(self) -> dict[str, Any]:
        """Return the result as JSON has it."""
        return {
            "manufacturer": self.manufacturer,
            "serial": self.serial_number,
            "interface": self.interface,
            "version": self.version,
            "map": self.map_id,
            "messages": dict(self.messages),
            "departures": self.count("departs"),
            "blocking": self.count("blocks"),
            "findings": [finding.as_dict() for finding in self.findings],
        }
