"""The shape of a shift document: its keys, and the values that each may hold."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import Field

from rightofway.io.fields import (
    Amount,
    Document,
    Name,
    NotNegative,
    Share,
    TickLength,
    Ticks,
    make_optional,
)
from rightofway.io.plan.shape import UNSERVED_REASON, TourItemDocument
from rightofway.io.scenario.shape import ScenarioDocument
from rightofway.io.scenario.work_shape import JobDocument

SocPoint = Annotated[tuple[Ticks, Share], Field(strict=False)]
WaitForRobot = Annotated[tuple[Amount, Amount], Field(strict=False)]
WaitAtVertex = Annotated[tuple[str, Amount], Field(strict=False)]
REASON = "robot, way, battery, latest, after or not found"


class FactDocument(Document):
    """Something that happened, for reports to make a sentence of."""

    kind: Name = Field(description="the kind of the event")
    values: dict[str, Any] = Field(description="a mapping of numbers, names and other facts")


class TimedFactDocument(FactDocument):
    """A fact of a shift."""

    at: Ticks = Field(description="the time, a whole number of ticks")


class RobotRecordDocument(Document):
    """All that one robot has done."""

    name: Name = Field(description="the name of a robot of the scenario")
    vertices: list[str] = Field(min_length=1, description="names of the vertices that it visited")
    enter: list[Ticks] = Field(
        min_length=1, description="for each vertex when its visit began, whole numbers of ticks"
    )
    tour: list[TourItemDocument] = Field(
        description="a list of {visit, job, stop, begin, end} or {visit, charge, begin, end}"
    )
    soc: list[SocPoint] = Field(
        description="a list of [tick, state of charge], from 0 to 1; empty without a battery"
    )
    drives: Amount = Field(description="driving time, a whole number of ticks")
    turns: Amount = Field(description="time of turning on the spot, a whole number of ticks")
    waits: list[WaitForRobot] = Field(
        description="a list of [index of another robot, ticks]: how long it waited for it"
    )
    waits_at: list[WaitAtVertex] = Field(
        description="a list of [name of a vertex, ticks]: how long it waited there"
    )
    lost: Ticks | None = Field(description="since when it does not go on, a tick, or null")


class JobRecordDocument(Document):
    """The course of a job that became known."""

    job: JobDocument = Field(description="the job, as in scenario files")
    known: Ticks = Field(description="time at which it became known, a whole number of ticks")
    robot: Amount | None = Field(description="the index of the robot that has begun it, or null")
    begun: Ticks | None = Field(description="begin of its first work, a tick, or null")
    ended: Ticks | None = Field(description="end of its last work, a tick, or null")
    reason: Annotated[str, UNSERVED_REASON] | None = Field(
        description=f"why no robot does it: {REASON}; or null"
    )


class RoundDocument(Document):
    """A round of the shift."""

    begin: Ticks = Field(description="the begin, a whole number of ticks")
    takeover: Ticks = Field(description="takeover of its plan, a whole number of ticks")
    seconds: NotNegative = Field(description="computing time [s]")
    jobs: Amount = Field(description="number of jobs in the round")
    stands: bool = Field(description="true or false: did the old plan stay?")
    facts: list[FactDocument] = Field(description="a list of {kind, values}")
    reasons: list[FactDocument] = Field(description="why it began: a list of {kind, values}")


class EventDocument(Document):
    """Something that happened to a job."""

    kind: Literal[
        "job known", "job changed", "job withdrawn", "stop begun", "stop done", "job unserved"
    ] = Field(
        description="job known, job changed, job withdrawn, stop begun, stop done, or job unserved"
    )
    at: Ticks = Field(description="the time, a whole number of ticks")
    job: JobDocument = make_optional("the job, of job known and job changed")
    name: Name = make_optional("the name of the job, of all other kinds")
    robot: Amount = make_optional("the index of the robot, of stop begun and stop done")
    stop: Amount = make_optional("number of the stop, from 0, of stop begun and stop done")
    reason: Annotated[str, UNSERVED_REASON] = make_optional(f"of job unserved: {REASON}")


class ShiftFrame(Document):
    """The keys of a shift; its scenario is read by itself."""

    format: Literal["rightofway-shift/1"] = Field(description="rightofway-shift/1")
    scenario: Any = Field(description="the scenario, its map inlined")
    tick: TickLength = Field(description="length of a tick [time unit]")
    until: Ticks = Field(description="end of the shift, a whole number of ticks")
    robots: list[RobotRecordDocument] = Field(description="one for each robot of the scenario")
    jobs: list[JobRecordDocument] = Field(description="the jobs that became known, in order")
    rounds: list[RoundDocument] = Field(description="the rounds, in order")
    events: list[EventDocument] = Field(description="events of jobs, in order")
    facts: list[TimedFactDocument] = Field(description="standstills and lost robots, in order")


class ShiftDocument(ShiftFrame):
    """A shift that was simulated: what robots did, and what became of jobs."""

    scenario: ScenarioDocument = Field(description="the scenario, its map inlined")
