"""The shape of a plan document: its keys, and the values that each may hold."""

from __future__ import annotations

from typing import Annotated, Any, Literal, Self, get_args

from pydantic import Field, model_validator

from rightofway.io.fields import (
    Amount,
    Document,
    Name,
    NotNegative,
    TickLength,
    Ticks,
    make_optional,
)
from rightofway.io.scenario.shape import ScenarioDocument
from rightofway.kinds.table import make_words
from rightofway.model import UnservedReason

PairOfNames = Annotated[list[Name], Field(min_length=2, max_length=2)]
PairOfCounts = Annotated[list[Ticks | None], Field(min_length=2, max_length=2)]
UNSERVED_REASON = make_words(*get_args(UnservedReason))


class DecisionDocument(Document):
    """The right of way between two robots that would have met, with its reason."""

    tick: Ticks = Field(description="time of the avoided meeting, a whole number of ticks")
    kind: Literal["vertex", "head-on", "following", "crossing"] = Field(
        description="vertex, head-on, following, or crossing"
    )
    vertices: list[Name] = Field(description="the names of the vertex, or of the segment in order")
    robots: PairOfNames = Field(description="the names of the two robots")
    waits: Name = Field(description="the name of the one that waits")
    waits_at: Name = Field(description="the name of the vertex it waits in")
    ticks: Ticks = Field(description="delay of its leave there, a whole number of ticks")
    level: Literal["node", "robot", "settled", "priority", "only"] = Field(
        description="node, robot, settled, priority, or only"
    )
    conflicts_left: PairOfCounts = Field(
        description="two counts, or null: conflicts left if the first robot waits, or the second"
    )
    completion_sums: PairOfCounts | None = Field(
        default=None, description="two sums of completion times in ticks, or null"
    )


class ReasonDocument(Document):
    """The reason why a robot got another route."""

    kind: Name = Field(description="one of the kinds below")
    values: dict[str, Any] = Field(default={}, description="a mapping of names")


class RerouteDocument(Document):
    """A robot that was sent another way."""

    robot: Name = Field(description="the name of the robot")
    because: ReasonDocument = Field(description="{kind, values} of the reason")


class StartDocument(Document):
    """Numbers of kept routes and tracks of the plan of another scenario."""

    routes: int = Field(ge=0, description="number of robots with the same route")
    tracks: int = Field(ge=0, description="number of these robots with the same times")


class OutcomeDocument(Document):
    """The proof of a plan."""

    kind: Literal["optimal", "bounded", "best found", "no plan exists", "gave up"] = Field(
        description="optimal, bounded, best found, no plan exists, or gave up"
    )
    objective: Literal[
        "flowtime",
        "flowtime and surcharges",
        "weighted flowtime",
        "makespan",
        "makespan and flowtime",
        "service",
    ] = Field(default="flowtime", description="the objective of the planner")
    bound: Ticks | None = Field(
        default=None,
        description="no plan has a smaller one: a whole number of ticks, or null",
    )
    factor: NotNegative | None = Field(
        default=None, description="proven factor of a bounded plan above the least cost; or null"
    )


class ForcedLossDocument(Document):
    """Robots that lose time to each other in every plan."""

    robots: list[Name] = Field(
        min_length=1, description="names of two robots or more; of the makespan also of one"
    )
    ticks: Annotated[int, Field(ge=1)] = Field(
        description="their least common loss, or the tick before which not all of them can have "
        "completed; a whole number of ticks above 0"
    )
    vertex: str = Field(
        description="the name of the vertex where two of them would meet; of one robot, its last"
        " stop"
    )
    objective: Literal["flowtime", "flowtime and surcharges", "weighted flowtime", "makespan"] = (
        Field(
            default="flowtime",
            description="the measure of the loss: flowtime, flowtime and surcharges, "
            "weighted flowtime, or makespan",
        )
    )


class StatusDocument(Document):
    """The method by which a planner found the plan."""

    kind: Name = Field(description="one of the kinds below")
    counts: dict[str, Any] = Field(
        default={}, description="a mapping of counts and names, and of statuses of earlier plans"
    )


class PlannerDocument(Document):
    """The origin of a plan."""

    name: Name = Field(description="the name of the planner")
    options: dict[str, Any] = Field(default={}, description="a mapping of options to values")
    seed: int = Field(default=0, description="a whole number")
    status: StatusDocument | None = Field(
        default=None, description="{kind, counts} of the method, or null"
    )
    seconds: NotNegative | None = Field(default=None, description="computing time [s], or null")
    decisions: list[DecisionDocument] = Field(default=[], description="a list of decisions")
    reroutes: list[RerouteDocument] = Field(default=[], description="a list of {robot, because}")
    start: StartDocument | None = Field(
        default=None, description="{routes, tracks} kept of an old plan, or null"
    )
    outcome: OutcomeDocument | None = Field(
        default=None, description="{kind, objective, bound, factor} that is proven, or null"
    )
    forced_losses: list[ForcedLossDocument] = Field(
        default=[],
        description="a list of {robots, ticks, vertex, objective}: why no plan is better",
    )


class TourItemDocument(Document):
    """Work at a stop of a job, or a charge."""

    visit: Amount = Field(description="the visit of the robot, from 0")
    job: Name = make_optional("the name of the job; none for a charge")
    stop: Amount = make_optional("number of the stop of the job, from 0")
    charge: Literal[True] = make_optional("true for a charge")
    begin: Ticks = Field(description="the begin, a whole number of ticks")
    end: Ticks = Field(description="the end, a whole number of ticks")

    @model_validator(mode="after")
    def _check_kind(self) -> Self:
        if self.charge and (self.job is not None or self.stop is not None):
            raise ValueError("is a charge with a job or stop (take one out)")
        if not self.charge and (self.job is None or self.stop is None):
            raise ValueError("has not both job and stop (give both, or charge: true)")
        return self


class UnservedDocument(Document):
    """A job that no robot does."""

    job: Name = Field(description="the name of the job")
    reason: Annotated[str, UNSERVED_REASON] = Field(
        description="robot, way, battery, latest, after or not found"
    )


class TrackDocument(Document):
    """The visits of one robot. Each visit ends when the next one begins."""

    name: Name = Field(description="the name of a robot of the scenario")
    vertices: list[str] = Field(min_length=1, description="names of vertices, at least one")
    enter: list[Ticks] = Field(
        min_length=1, description="for each vertex when its visit begins, whole numbers of ticks"
    )
    tour: list[TourItemDocument] = make_optional(
        "a list of {visit, job, stop, begin, end} or {visit, charge, begin, end}, for jobs"
    )


class VisitDocument(Document):
    """One visit of a robot."""

    robot: Name = Field(description="the name of the robot")
    visit: int = Field(description="number of its visit, from 0")


class SteadyDocument(Document):
    """A group of robots whose visits repeat with one period."""

    robots: list[Name] = Field(min_length=1, description="the names of the robots, at least one")
    start: Ticks = Field(description="the tick from which the visits repeat, a whole number")
    period: Ticks = Field(description="the number of ticks after which they repeat, at least one")
    critical: list[VisitDocument] = Field(
        default=[],
        description="the bottleneck: a list of {robot, visit} that wait for each other in a circle",
    )


class PlanFrame(Document):
    """The keys of a plan; their values are read one by one, so that faults add up."""

    format: Literal["rightofway-plan/1", "rightofway-plan/2"] = Field(
        description="rightofway-plan/1, or rightofway-plan/2 for a scenario with jobs"
    )
    scenario: Any = Field(description="a scenario, its map inlined")
    tick: TickLength = Field(description="length of a tick [time unit]")
    planner: Any = make_optional("{name, options, seed, status, seconds}")
    metrics: dict[str, Any] = Field(
        default={}, description="a mapping of numbers, for readers; they are not read back"
    )
    robots: Any = Field(description="for each robot {name, vertices, enter}")
    unserved: Any = make_optional("a list of {job, reason}, for jobs")
    steady: Any = Field(default=[], description="a list of {robots, start, period, critical}")


class PlanDocument(PlanFrame):
    """A plan: routes and times for all robots of the scenario inside it."""

    scenario: ScenarioDocument = Field(description="the problem, its map inlined")
    planner: PlannerDocument = make_optional("the origin of the plan; unknown by default")
    robots: list[TrackDocument] = Field(description="one for each robot of the scenario")
    unserved: list[UnservedDocument] = make_optional(
        "a list of {job, reason}: jobs that no robot does"
    )
    steady: list[SteadyDocument] = Field(
        default=[], description="robots whose visits repeat; only the page reads it"
    )
