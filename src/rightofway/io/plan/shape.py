"""The shape of a plan document: its keys, and the values that each may hold."""

from __future__ import annotations

from typing import Annotated, Any, Literal, get_args

from pydantic import Field

from rightofway.io.fields import (
    Amount,
    Document,
    Name,
    NotNegative,
    TickLength,
    Ticks,
    make_field,
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

    tick: Ticks = make_field("time of the avoided meeting, a whole number of ticks")
    kind: Literal["vertex", "head-on", "following", "crossing"] = make_field(
        "vertex, head-on, following, or crossing"
    )
    vertices: list[Name] = make_field("the names of the vertex, or of the segment in order")
    robots: PairOfNames = make_field("the names of the two robots")
    waits: Name = make_field("the name of the one that waits")
    waits_at: Name = make_field("the name of the vertex it waits in")
    ticks: Ticks = make_field("delay of its leave there, a whole number of ticks")
    level: Literal["node", "robot", "settled", "priority", "only"] = make_field(
        "node, robot, settled, priority, or only"
    )
    conflicts_left: PairOfCounts = make_field(
        "two counts, or null: conflicts left if the first robot waits, or the second"
    )
    completion_sums: PairOfCounts | None = make_field(
        "two sums of completion times in ticks, or null", default=None
    )


class ReasonDocument(Document):
    """The reason why a robot got another route."""

    kind: Name = make_field("one of the kinds below")
    values: dict[str, Any] = make_field("a mapping of names", default={})


class RerouteDocument(Document):
    """A robot that was sent another way."""

    robot: Name = make_field("the name of the robot")
    because: ReasonDocument = make_field("{kind, values} of the reason")


class StartDocument(Document):
    """Numbers of kept routes and tracks of the plan of another scenario."""

    routes: int = make_field("number of robots with the same route", ge=0)
    tracks: int = make_field("number of these robots with the same times", ge=0)


class OutcomeDocument(Document):
    """The proof of a plan."""

    kind: Literal["optimal", "bounded", "best found", "no plan exists", "gave up"] = make_field(
        "optimal, bounded, best found, no plan exists, or gave up"
    )
    objective: Literal[
        "flowtime",
        "flowtime and surcharges",
        "weighted flowtime",
        "makespan",
        "makespan and flowtime",
        "service",
    ] = make_field("the objective of the planner", default="flowtime")
    bound: Ticks | None = make_field(
        "no plan has a smaller one: a whole number of ticks, or null",
        default=None,
    )
    factor: NotNegative | None = make_field(
        "proven factor of a bounded plan above the least cost; or null", default=None
    )


class ForcedLossDocument(Document):
    """Robots that lose time to each other in every plan."""

    robots: list[Name] = make_field(
        "names of two robots or more; of the makespan also of one", min_length=1
    )
    ticks: Annotated[int, Field(ge=1)] = make_field(
        "their least common loss, or the tick before which not all of them can have "
        "completed; a whole number of ticks above 0"
    )
    vertex: str = make_field(
        "the name of the vertex where two of them would meet; of one robot, its last stop"
    )
    objective: Literal["flowtime", "flowtime and surcharges", "weighted flowtime", "makespan"] = (
        make_field(
            "the measure of the loss: flowtime, flowtime and surcharges, "
            "weighted flowtime, or makespan",
            default="flowtime",
        )
    )


class StatusDocument(Document):
    """The method by which a planner found the plan."""

    kind: Name = make_field("one of the kinds below")
    counts: dict[str, Any] = make_field(
        "a mapping of counts and names, and of statuses of earlier plans", default={}
    )


class PlannerDocument(Document):
    """The origin of a plan."""

    name: Name = make_field("the name of the planner")
    options: dict[str, Any] = make_field("a mapping of options to values", default={})
    seed: int = make_field("a whole number", default=0)
    status: StatusDocument | None = make_field(
        "{kind, counts} of the method, or null", default=None
    )
    seconds: NotNegative | None = make_field("computing time [s], or null", default=None)
    decisions: list[DecisionDocument] = make_field("a list of decisions", default=[])
    reroutes: list[RerouteDocument] = make_field("a list of {robot, because}", default=[])
    start: StartDocument | None = make_field(
        "{routes, tracks} kept of an old plan, or null", default=None
    )
    outcome: OutcomeDocument | None = make_field(
        "{kind, objective, bound, factor} that is proven, or null", default=None
    )
    forced_losses: list[ForcedLossDocument] = make_field(
        "a list of {robots, ticks, vertex, objective}: why no plan is better",
        default=[],
    )


class TourItemDocument(Document):
    """Work at a stop of a job, or a charge."""

    visit: Amount = make_field("the visit of the robot, from 0")
    job: Name = make_optional("the name of the job; none for a charge")
    stop: Amount = make_optional("number of the stop of the job, from 0")
    charge: Literal[True] = make_optional("true for a charge")
    begin: Ticks = make_field("the begin, a whole number of ticks")
    end: Ticks = make_field("the end, a whole number of ticks")

    def check(self) -> None:
        """Refuse a charge with a job, and work without one."""
        if self.charge and (self.job is not None or self.stop is not None):
            raise ValueError("is a charge with a job or stop (take one out)")
        if not self.charge and (self.job is None or self.stop is None):
            raise ValueError("has not both job and stop (give both, or charge: true)")


class UnservedDocument(Document):
    """A job that no robot does."""

    job: Name = make_field("the name of the job")
    reason: Annotated[str, UNSERVED_REASON] = make_field(
        "robot, way, battery, latest, after or not found"
    )


class TrackDocument(Document):
    """The visits of one robot. Each visit ends when the next one begins."""

    name: Name = make_field("the name of a robot of the scenario")
    vertices: list[str] = make_field("names of vertices, at least one", min_length=1)
    enter: list[Ticks] = make_field(
        "for each vertex when its visit begins, whole numbers of ticks", min_length=1
    )
    tour: list[TourItemDocument] = make_optional(
        "a list of {visit, job, stop, begin, end} or {visit, charge, begin, end}, for jobs"
    )


class VisitDocument(Document):
    """One visit of a robot."""

    robot: Name = make_field("the name of the robot")
    visit: int = make_field("number of its visit, from 0")


class SteadyDocument(Document):
    """A group of robots whose visits repeat with one period."""

    robots: list[Name] = make_field("the names of the robots, at least one", min_length=1)
    start: Ticks = make_field("the tick from which the visits repeat, a whole number")
    period: Ticks = make_field("the number of ticks after which they repeat, at least one")
    critical: list[VisitDocument] = make_field(
        "the bottleneck: a list of {robot, visit} that wait for each other in a circle",
        default=[],
    )


class PlanFrame(Document):
    """The keys of a plan; their values are read one by one, so that faults add up."""

    format: Literal["rightofway-plan/1", "rightofway-plan/2"] = make_field(
        "rightofway-plan/1, or rightofway-plan/2 for a scenario with jobs"
    )
    scenario: Any = make_field("a scenario, its map inlined")
    tick: TickLength = make_field("length of a tick [time unit]")
    planner: Any = make_optional("{name, options, seed, status, seconds}")
    metrics: dict[str, Any] = make_field(
        "a mapping of numbers, for readers; they are not read back", default={}
    )
    robots: Any = make_field("for each robot {name, vertices, enter}")
    unserved: Any = make_optional("a list of {job, reason}, for jobs")
    steady: Any = make_field("a list of {robots, start, period, critical}", default=[])


class PlanDocument(PlanFrame):
    """A plan: routes and times for all robots of the scenario inside it."""

    scenario: ScenarioDocument = make_field("the problem, its map inlined")
    planner: PlannerDocument = make_optional("the origin of the plan; unknown by default")
    robots: list[TrackDocument] = make_field("one for each robot of the scenario")
    unserved: list[UnservedDocument] = make_optional(
        "a list of {job, reason}: jobs that no robot does"
    )
    steady: list[SteadyDocument] = make_field(
        "robots whose visits repeat; only the page reads it", default=[]
    )
