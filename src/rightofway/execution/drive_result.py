"""The result of a plan that robots have driven, in this process or at a broker."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

from rightofway.model import ExecutionTrace, Plan, Tick

__all__ = ["DriveResult"]


@dataclass(frozen=True, slots=True, kw_only=True)
class DrivenJob:
    """A job that is done.

    Attributes
    ----------
    name
        Its name.
    robot
        Index of the robot that has done it.
    earliest, due
        When it could begin, and until when it was wanted [ticks]; due is None without one.
    planned
        When it ends in the plan [ticks]; None for a job that came later.
    ended
        When it ended [ticks].
    """

    name: str
    robot: int
    earliest: Tick
    due: Tick | None
    planned: Tick | None
    ended: Tick

    @property
    def is_late(self) -> bool:
        """Whether it ended after it was due."""
        return self.due is not None and self.ended > self.due


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
    ended
        The jobs of a plan with jobs that are done, in the order of their ends, also those before
        the last start.
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
    ended: tuple[DrivenJob, ...] = ()
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
        if self.plan.scenario.jobs is not None:
            ended = [{**asdict(job), "robot": names[job.robot]} for job in self.ended]
            totals |= {"late": sum(job.is_late for job in self.ended), "ended": ended}
        duration = {"ticks": int(self.now)} if self.completion is None else {}
        return {"robots": robots, **totals, **duration}
