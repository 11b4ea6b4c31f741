"""The record of a shift: what robots have done, what has become of jobs, and all rounds."""

from __future__ import annotations

from array import array
from collections import Counter
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import NamedTuple

from rightofway.dispatch.pool import PoolEvent
from rightofway.facts import Fact
from rightofway.model import (
    Job,
    Plan,
    PlannedItem,
    PlannerRun,
    Scenario,
    Tick,
    Track,
    UnservedReason,
)

__all__ = ["DoneStep", "JobRecord", "RobotRecord", "RoundRecord", "ShiftRecord"]


class DoneStep(NamedTuple):
    """Work that a robot has done, or a charge.

    ``visit`` is the number of the visit, ``job`` is empty for a charge. Times are ticks.
    """

    visit: int
    begin: int
    end: int
    job: str = ""
    stop: int = 0


@dataclass(slots=True, kw_only=True)
class RobotRecord:
    """The record of one robot.

    Attributes
    ----------
    vertices, enter
        Its visits [ticks].
    steps
        Its work and charges, in order.
    soc
        Pairs of a tick and the state of charge then: at the begin, and where charges begin and end.
    drives, turns
        How long it has driven, and turned on the spot [ticks].
    waits
        How long it has waited for each other robot, by index [ticks].
    waits_at
        How long it has waited at each vertex [ticks].
    lost
        Since when it does not go on any more [ticks]; None if it does.
    """

    vertices: array[int] = field(default_factory=lambda: array("i"))
    enter: array[int] = field(default_factory=lambda: array("q"))
    steps: list[DoneStep] = field(default_factory=list)
    soc: list[tuple[int, Fraction]] = field(default_factory=list)
    drives: int = 0
    turns: int = 0
    waits: Counter[int] = field(default_factory=Counter)
    waits_at: Counter[int] = field(default_factory=Counter)
    lost: int | None = None

    @property
    def track(self) -> Track:
        """Its visits as a track."""
        return Track.of(self.vertices.tolist(), self.enter.tolist())


@dataclass(slots=True, kw_only=True)
class JobRecord:
    """The record of a job.

    Attributes
    ----------
    job
        The job.
    known
        When it became known [ticks].
    robot
        Index of the robot that has begun it; None before.
    begun, ended
        When its first work has begun, and when its last has ended [ticks]; None before.
    reason
        Why no robot does it for good, or why the last round did not assign it; None else.
    """

    job: Job
    known: Tick
    robot: int | None = None
    begun: Tick | None = None
    ended: Tick | None = None
    reason: UnservedReason | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class RoundRecord:
    """A round of a shift.

    Attributes
    ----------
    begin, takeover
        When it began, and when its plan took over, or would have at the end of a shift [ticks].
    seconds
        How long it took [s].
    jobs
        How many jobs it was given.
    stands
        Whether the old plan stood.
    facts
        Its facts.
    reasons
        Why it began: facts of `rightofway.dispatch.triggers`.
    """

    begin: Tick
    takeover: Tick
    seconds: float
    jobs: int
    stands: bool = False
    facts: tuple[Fact, ...] = ()
    reasons: tuple[Fact, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class ShiftRecord:
    """A simulated shift.

    Attributes
    ----------
    scenario
        The scenario, with all jobs.
    until
        When the shift ended [ticks].
    robots
        One for each robot.
    jobs
        The jobs that became known, by name, in the order in which they did.
    rounds
        The rounds, in order.
    events
        What has happened to jobs, in the order in which it was noted.
    facts
        The facts of the shift, with the tick: standstills, and robots that do not go on.
    """

    scenario: Scenario
    until: Tick
    robots: tuple[RobotRecord, ...]
    jobs: dict[str, JobRecord]
    rounds: tuple[RoundRecord, ...] = ()
    events: tuple[PoolEvent, ...] = ()
    facts: tuple[tuple[Tick, Fact], ...] = ()

    def make_plan(self) -> Plan:
        """Return all that robots have done as one plan of the jobs that became known.

        Without delays it keeps the rules, once all begun jobs have ended. With delays work lasts
        longer than planned, and may end too late.
        """
        jobs = tuple(own.job for own in self.jobs.values())
        scenario = replace(self.scenario, jobs=jobs, clock=self.scenario.problem.clock, tours=None)
        number = {job.name: index for index, job in enumerate(jobs)}
        ended = {name for name, own in self.jobs.items() if own.ended is not None}
        return Plan(
            scenario=scenario,
            tracks=tuple(own.track for own in self.robots),
            run=PlannerRun(),
            tours=tuple(
                tuple(
                    PlannedItem(
                        visit=step.visit,
                        begin=Tick(step.begin),
                        end=Tick(step.end),
                        job=number[step.job] if step.job else None,
                        stop=step.stop if step.job else None,
                    )
                    for step in own.steps
                )
                for own in self.robots
            ),
            unserved=tuple(
                (number[name], own.reason or "not found")
                for name, own in self.jobs.items()
                if name not in ended
            ),
        )
