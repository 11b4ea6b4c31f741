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
    make_field,
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

    kind: Name = make_field("the kind of the event")
    values: dict[str, Any] = make_field("a mapping of numbers, names and other facts")


class TimedFactDocument(FactDocument):
    """A fact of a shift."""

    at: Ticks = make_field("the time, a whole number of ticks")


class RobotRecordDocument(Document):
    """All that one robot has done."""

    name: Name = make_field("the name of a robot of the scenario")
    vertices: list[str] = make_field("names of the vertices that it visited", min_length=1)
    enter: list[Ticks] = make_field(
        "for each vertex when its visit began, whole numbers of ticks", min_length=1
    )
    tour: list[TourItemDocument] = make_field(
        "a list of {visit, job, stop, begin, end} or {visit, charge, begin, end}"
    )
    soc: list[SocPoint] = make_field(
        "a list of [tick, state of charge], from 0 to 1; empty without a battery"
    )
    drives: Amount = make_field("driving time, a whole number of ticks")
    turns: Amount = make_field("time of turning on the spot, a whole number of ticks")
    waits: list[WaitForRobot] = make_field(
        "a list of [index of another robot, ticks]: how long it waited for it"
    )
    waits_at: list[WaitAtVertex] = make_field(
        "a list of [name of a vertex, ticks]: how long it waited there"
    )
    lost: Ticks | None = make_field("since when it does not go on, a tick, or null")


class JobRecordDocument(Document):
    """The course of a job that became known."""

    job: JobDocument = make_field("the job, as in scenario files")
    known: Ticks = make_field("time at which it became known, a whole number of ticks")
    robot: Amount | None = make_field("the index of the robot that has begun it, or null")
    begun: Ticks | None = make_field("begin of its first work, a tick, or null")
    ended: Ticks | None = make_field("end of its last work, a tick, or null")
    reason: Annotated[str, UNSERVED_REASON] | None = make_field(
        f"why no robot does it: {REASON}; or null"
    )


class RoundDocument(Document):
    """A round of the shift."""

    begin: Ticks = make_field("the begin, a whole number of ticks")
    takeover: Ticks = make_field("takeover of its plan, a whole number of ticks")
    seconds: NotNegative = make_field("computing time [s]")
    jobs: Amount = make_field("number of jobs in the round")
    stands: bool = make_field("true or false: did the old plan stay?")
    facts: list[FactDocument] = make_field("a list of {kind, values}")
    reasons: list[FactDocument] = make_field("why it began: a list of {kind, values}")


class EventDocument(Document):
    """Something that happened to a job."""

    kind: Literal[
        "job known", "job changed", "job withdrawn", "stop begun", "stop done", "job unserved"
    ] = make_field("job known, job changed, job withdrawn, stop begun, stop done, or job unserved")
    at: Ticks = make_field("the time, a whole number of ticks")
    job: JobDocument = make_optional("the job, of job known and job changed")
    name: Name = make_optional("the name of the job, of all other kinds")
    robot: Amount = make_optional("the index of the robot, of stop begun and stop done")
    stop: Amount = make_optional("number of the stop, from 0, of stop begun and stop done")
    reason: Annotated[str, UNSERVED_REASON] = make_optional(f"of job unserved: {REASON}")


class ShiftFrame(Document):
    """The keys of a shift; its scenario is read by itself."""

    format: Literal["rightofway-shift/1"] = make_field("rightofway-shift/1")
    scenario: Any = make_field("the scenario, its map inlined")
    tick: TickLength = make_field("length of a tick [time unit]")
    until: Ticks = make_field("end of the shift, a whole number of ticks")
    robots: list[RobotRecordDocument] = make_field("one for each robot of the scenario")
    jobs: list[JobRecordDocument] = make_field("the jobs that became known, in order")
    rounds: list[RoundDocument] = make_field("the rounds, in order")
    events: list[EventDocument] = make_field("events of jobs, in order")
    facts: list[TimedFactDocument] = make_field("standstills and lost robots, in order")


class ShiftDocument(ShiftFrame):
    """A shift that was simulated: what robots did, and what became of jobs."""

    scenario: ScenarioDocument = make_field("the scenario, its map inlined")
