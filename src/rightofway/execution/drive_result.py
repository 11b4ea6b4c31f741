"""The result of a plan that robots have driven, in this process or at a broker."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from fractions import Fraction
from typing import Any

from rightofway.model import ExecutionTrace, Plan, Tick

__all__ = ["DriveResult", "DrivenEnd", "Punctuality", "measure_punctuality", "sort_latest_first"]


@dataclass(frozen=True, slots=True, kw_only=True)
class DrivenEnd:
    """The end of a job, or of the way of a robot: as planned, and as it was or is expected.

    Attributes
    ----------
    name
        The name of the job or robot.
    robot
        Index of the robot that has done the job or is to do it; None while that is open.
    earliest, due
        When a job could begin, and until when it was wanted [ticks]; None without such a time.
    planned
        When it ends in the first plan that has it [ticks]; None before.
    ended
        When it ended [ticks]; None while it is open.
    expected
        When it is expected to end [ticks]; None where it has ended, or no plan has it.
    """

    name: str
    robot: int | None
    earliest: Tick | None = None
    due: Tick | None = None
    planned: Tick | None = None
    ended: Tick | None = None
    expected: Tick | None = None

    @property
    def end(self) -> Tick | None:
        """When it ended, or is expected to [ticks]."""
        return self.expected if self.ended is None else self.ended

    @property
    def delay(self) -> int | None:
        """How much later than planned it ends [ticks], negative for earlier; None if unknown."""
        return None if self.end is None or self.planned is None else self.end - self.planned

    @property
    def lateness(self) -> int | None:
        """How much later than due it ends, or than planned if nothing is due [ticks]."""
        wanted = self.planned if self.due is None else self.due
        return None if self.end is None or wanted is None else self.end - wanted

    @property
    def is_late(self) -> bool:
        """Whether it ends after it was due, or after its planned end if nothing is due."""
        return (self.lateness or 0) > 0


@dataclass(frozen=True, slots=True, kw_only=True)
class Punctuality:
    """How many jobs, or ways of robots, are done, open and late.

    Attributes
    ----------
    done, open, late
        How many have ended, have not, and are late or expected to be; see `DrivenEnd.is_late`.
    delay
        The mean delay of those that have ended and were planned [ticks]; None without any.
    """

    done: int
    open: int
    late: int
    delay: Fraction | None


def measure_punctuality(ends: Sequence[DrivenEnd]) -> Punctuality:
    """Return how many of some jobs are done, open and late, and their mean delay."""
    done = [end for end in ends if end.ended is not None]
    delays = [end.delay for end in done if end.delay is not None]
    return Punctuality(
        done=len(done),
        open=len(ends) - len(done),
        late=sum(end.is_late for end in ends),
        delay=Fraction(sum(delays), len(delays)) if delays else None,
    )


def sort_latest_first(ends: Sequence[DrivenEnd]) -> list[DrivenEnd]:
    """Return jobs, or ways of robots: the latest first, those of unknown lateness last."""
    return sorted(ends, key=lambda end: (end.lateness is None, -(end.lateness or 0)))


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
    ends
        The jobs of a plan with jobs, also those before the last start: those that are done in the
        order of their ends, then the open ones in the order in which they became known.
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
    ends: tuple[DrivenEnd, ...] = ()
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
            rows = [
                {**asdict(end), "robot": None if end.robot is None else names[end.robot]}
                for end in self.ends
            ]
            totals |= {"late": measure_punctuality(self.ends).late, "ends": rows}
        duration = {"ticks": int(self.now)} if self.completion is None else {}
        return {"robots": robots, **totals, **duration}
