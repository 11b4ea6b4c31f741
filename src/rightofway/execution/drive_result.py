"""The result of a plan that robots have driven, in this process or at a broker."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from rightofway.model import ExecutionTrace, Plan, Tick

__all__ = ["DriveResult"]


@dataclass(frozen=True, slots=True, kw_only=True)
class DriveResult:
    """The result of a drive of a plan.

    Attributes
    ----------
    plan
        The plan.
    trace
        Where simulated robots were, and how long each visit and drive took; None at a broker, of
        laps, and where people have changed the work of robots.
    completion
        When each robot came to the end of its route [ticks], None for a robot of which that is not
        known; None of laps, and where there is no trace of simulated robots.
    jobs
        How many jobs each robot has done.
    laps
        How many laps each robot has made.
    now
        When the run ended [ticks].
    waits
        How often each robot stood at the end of its released parts, until others had left.
    messages
        How many messages were sent, by the last part of their topic; at a broker since the start.
    """

    plan: Plan
    trace: ExecutionTrace | None
    completion: tuple[Tick | None, ...] | None
    jobs: tuple[int, ...]
    laps: tuple[int, ...]
    now: Tick
    waits: tuple[int, ...]
    messages: dict[str, int]

    def as_dict(self) -> dict[str, Any]:
        """Return the result as JSON has it, times in ticks."""
        names = [robot.name for robot in self.plan.scenario.robots]
        robots: list[dict[str, Any]] = [
            {"name": name, "jobs": jobs, "waits": waits}
            for name, jobs, waits in zip(names, self.jobs, self.waits, strict=True)
        ]
        if self.completion is None:
            for row, laps in zip(robots, self.laps, strict=True):
                row["laps"] = laps
        else:
            times = zip(robots, self.plan.completions, self.completion, strict=True)
            for row, planned, completion in times:
                row |= {"planned": int(planned), "completion": completion}
        totals = {"jobs": sum(self.jobs), "messages": self.messages}
        duration = {"ticks": int(self.now)} if self.completion is None else {}
        return {"robots": robots, **totals, **duration}
