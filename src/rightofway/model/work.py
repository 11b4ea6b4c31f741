"""Jobs, batteries and states of robots, as users write them and in ticks; tours of robots."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Literal

from rightofway.errors import quote
from rightofway.kinds.table import (
    NAME,
    NOT_NEGATIVE,
    NUMBER,
    POSITIVE,
    SHARE,
    TEXT,
    VERTEX,
    WHOLE,
    allow_none,
    coerce_fields,
    list_of,
    make_class,
    mapping_of,
)
from rightofway.model.actions import ACTIONS, StopAction
from rightofway.model.units import Tick
from rightofway.site import VertexId

WorkObjective = Literal["service", "flowtime", "makespan", "both"]
"""The objective after the weight of unserved jobs: the service times of jobs, or the
completion times of robots."""

OBJECTIVE: WorkObjective = "service"
"""The objective by default."""

LATE = Fraction(10)
"""Default cost of a time unit after `Job.due`, compared with one of service time."""

PATIENCE = Fraction(1800)
"""Default time from `Job.earliest` until a job without `Job.due` is overdue [time unit]."""

CAPACITY = 1
"""The largest load of a robot by default."""

LARGEST_BATTERY = 10**15
"""The largest common denominator of the shares of a battery, so that sums fit 64 bits."""


_BEGUN = mapping_of(WHOLE)


@dataclass(frozen=True, slots=True, kw_only=True)
class JobStop:
    """A place where a robot works for a job.

    Attributes
    ----------
    at
        The vertex.
    work
        How long the robot works there [time unit], not negative.
    load
        By how much the load of the robot changes at the end of the work.
    earliest
        The work begins then or later [time unit].
    latest
        The work ends then or before [time unit]; None for no limit.
    actions
        The actions of the robot there; empty for the actions of the place. No plan depends on it.

    Raises
    ------
    InputError
        With every value of another kind or out of range.
    """

    at: VertexId
    work: Fraction = Fraction(0)
    load: int = 0
    earliest: Fraction = Fraction(0)
    latest: Fraction | None = None
    actions: tuple[StopAction, ...] = ()

    def __post_init__(self) -> None:
        coerce_fields(
            self,
            "stop",
            at=VERTEX,
            work=NOT_NEGATIVE,
            load=WHOLE,
            earliest=NOT_NEGATIVE,
            latest=allow_none(NUMBER),
            actions=ACTIONS,
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class Job:
    """Work of one robot: stops in a fixed order.

    Attributes
    ----------
    name
        Unique in its scenario.
    stops
        At least one. Their loads sum to 0, and no first part of them to less.
    weight
        The weight of the job, compared with other jobs, positive.
    due
        Completion after this time costs more [time unit]; None for no such time.
    types
        Types of the robots that may do the job; empty for all types.
    robot
        The only robot that may do the job; None for all robots.
    after
        Names of the jobs that end before this one begins.
    load_id, load_type
        The load that the job carries, for actions that pick and drop it; None where it is unknown.

    Raises
    ------
    InputError
        With every value of another kind or out of range.
    """

    name: str
    stops: tuple[JobStop, ...]
    weight: Fraction = Fraction(1)
    due: Fraction | None = None
    types: tuple[str, ...] = ()
    robot: str | None = None
    after: tuple[str, ...] = ()
    load_id: str | None = None
    load_type: str | None = None

    def __post_init__(self) -> None:
        coerce_fields(
            self,
            f"job {quote(self.name)}",
            name=TEXT,
            stops=list_of(make_class(JobStop)),
            weight=POSITIVE,
            due=allow_none(NOT_NEGATIVE),
            types=list_of(TEXT),
            robot=allow_none(TEXT),
            after=list_of(TEXT),
            load_id=allow_none(NAME),
            load_type=allow_none(NAME),
        )

    @property
    def earliest(self) -> Fraction:
        """When the work of the first stop may begin [time unit]."""
        return self.stops[0].earliest


@dataclass(frozen=True, slots=True, kw_only=True)
class Battery:
    """How robots use and charge a battery; all shares are of a full one.

    Attributes
    ----------
    drive
        Share for each length unit of a drive.
    on
        Share for each time unit until the robot rests.
    work
        Share for each time unit of work.
    charge
        Share gained in each time unit of a charge, net.
    reserve
        The least state of charge, from 0 to 1.

    Raises
    ------
    InputError
        With every value of another kind or out of range.
    """

    drive: Fraction = Fraction(0)
    on: Fraction = Fraction(0)
    work: Fraction = Fraction(0)
    charge: Fraction = Fraction(0)
    reserve: Fraction = Fraction(0)

    def __post_init__(self) -> None:
        rates = dict.fromkeys(("drive", "on", "work", "charge"), NOT_NEGATIVE)
        coerce_fields(self, "battery", reserve=SHARE, **rates)


@dataclass(frozen=True, slots=True, kw_only=True)
class RobotState:
    """The place where a robot begins, and the work it has done.

    Attributes
    ----------
    at
        The vertex at which it stays from tick 0 until it drives.
    ready
        Until then it does nothing and consumes nothing [time unit].
    heading
        Angle from the site's x axis to its y axis [degrees]; None where it is unknown.
    soc
        State of charge at `ready`, from 0 to 1; 1 is full.
    begun
        Names of jobs with the number of their first stops that are done.

    Raises
    ------
    InputError
        With every value of another kind or out of range.
    """

    at: VertexId
    ready: Fraction = Fraction(0)
    heading: Fraction | None = None
    soc: Fraction = Fraction(1)
    begun: tuple[tuple[str, int], ...] = ()

    def __post_init__(self) -> None:
        coerce_fields(
            self,
            "start",
            at=VERTEX,
            ready=NOT_NEGATIVE,
            heading=allow_none(NUMBER),
            soc=SHARE,
            begun=_BEGUN,
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class TourItem:
    """One item of a tour: the work of a stop, a charge, or the rest at its end.

    Attributes
    ----------
    job, stop
        Index of the job, and of the stop among all its stops; None and None for a charge. A last
        item without job and duration is the vertex where a robot that does not return home rests;
        without that item it rests at its last stop or charge.
    vertex
        Where.
    duration
        How long the robot works or charges there [ticks].
    """

    job: int | None
    stop: int | None
    vertex: VertexId
    duration: Tick


Tour = tuple[TourItem, ...]
"""Stops and charges of one robot, in order."""

UnservedReason = Literal["robot", "way", "battery", "latest", "after", "not found"]
"""Why no robot does a job: none may or can carry it; no way leads to its stops; no battery lasts;
it would end too late; it follows an unserved job; the search found no place for it."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Assignment:
    """The jobs of each robot, in order.

    Attributes
    ----------
    tours
        One for each robot.
    unserved
        Indices of the jobs that no robot does, each with the reason.
    """

    tours: tuple[Tour, ...]
    unserved: tuple[tuple[int, UnservedReason], ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class BoundStop:
    """A stop of a job in ticks, rounded as the clock rounds.

    Attributes
    ----------
    vertex
        Where.
    work
        The work time of the robot there [ticks].
    load
        By how much the load changes at the end of the work.
    earliest
        The work begins then or later [ticks], rounded up.
    latest
        The work ends then or before [ticks], rounded down; None for no limit.
    """

    vertex: VertexId
    work: Tick
    load: int
    earliest: Tick
    latest: Tick | None


@dataclass(frozen=True, slots=True, kw_only=True)
class BoundJob:
    """A job in ticks; of a begun job only the remaining stops.

    Attributes
    ----------
    stops
        The stops that are left, in order; those of a begun job have no `latest`.
    first
        The number of finished stops: the index of ``stops[0]`` among all stops of the job.
    weight
        The cost of a tick of its completion; whole numbers in the ratio of the weights of jobs.
    due
        Completion after this tick costs more, rounded down; None for never.
    robots
        Indices of the robots that may do the job, by name, type and what is begun, and can: their
        capacity holds its load, and none of its stops is barred for them.
    after
        Indices of the jobs that end before it begins; empty for a begun job.
    begun_by
        Index of the robot that has begun it, or None.
    earliest
        From when on its service time counts: `earliest` of its first stop; 0 for a begun job.
    """

    stops: tuple[BoundStop, ...]
    first: int
    weight: int
    due: Tick | None
    robots: tuple[int, ...]
    after: tuple[int, ...]
    begun_by: int | None
    earliest: Tick


@dataclass(frozen=True, slots=True, kw_only=True)
class BoundBattery:
    """The battery of a robot in whole numbers, of which `full` are a full battery.

    Attributes
    ----------
    full
        The least number of which all shares are whole parts, at most `LARGEST_BATTERY`.
    drive
        The charge that a drive along an edge of each class takes; 0 where it is barred.
    on, work
        The charge that a tick takes before the robot rests, and a tick of work.
    charge
        The net gain of a tick of a charge.
    reserve
        The least state of charge.
    soc
        The state of charge when the robot is ready.

    Notes
    -----
    A change of more than a full battery is ``full + 1``.
    """

    full: int
    drive: tuple[int, ...]
    on: int
    work: int
    charge: int
    reserve: int
    soc: int


@dataclass(frozen=True, slots=True, kw_only=True)
class BoundRobot:
    """The state of a robot in ticks, and its properties that a tour depends on.

    Attributes
    ----------
    start
        Its vertex from tick 0.
    ready
        Until then it stays there [ticks], rounded up.
    heading
        As `Itinerary.heading`.
    home
        Where it rests; None for a robot that does not return home.
    turn
        How long it turns at a stop before it drives on [ticks].
    capacity
        The largest load.
    load
        The load on board when it is ready.
    battery
        Its battery, or None for no limit.
    charging
        The vertices at which it may charge, sorted.
    """

    start: VertexId
    ready: Tick
    heading: Fraction | None
    home: VertexId | None
    turn: Tick
    capacity: int
    load: int
    battery: BoundBattery | None
    charging: tuple[VertexId, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Work:
    """The work of a fleet in ticks, computed once.

    Attributes
    ----------
    jobs
        In the order of the scenario.
    robots
        One for each robot.
    objective
        The objective after the weight of unserved jobs.
    late
        How much a tick of a job after `BoundJob.due` costs, compared with one of service time.
    """

    jobs: tuple[BoundJob, ...]
    robots: tuple[BoundRobot, ...]
    objective: WorkObjective
    late: Fraction


BATTERIES = mapping_of(make_class(Battery))
