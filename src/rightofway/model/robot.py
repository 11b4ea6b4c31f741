"""A robot with its trip, and the rules that hold for the whole fleet."""

from __future__ import annotations

from dataclasses import dataclass, field
from fractions import Fraction
from typing import Literal, get_args

from rightofway.errors import quote
from rightofway.kinds.table import (
    AMOUNT,
    COUNT,
    NAME,
    NOT_NEGATIVE,
    POSITIVE,
    TEXT,
    TRUTH,
    TURNING,
    VERTEX,
    allow_none,
    coerce_fields,
    list_of,
    make_class,
    make_words,
)
from rightofway.model.actions import ACTIONS, StopAction
from rightofway.model.attributes import list_attributes, list_kinds, make_attribute
from rightofway.model.work import RobotState, WorkObjective
from rightofway.site import VertexId

Turn = Literal["cell"] | Fraction
"""Turning time at a stop: one cell's crossing time of the robot, or a time [time unit]."""

TripEnd = Literal["home", "none"]
"""The end of a trip: at ``home``, or (``none``) at the last stop."""

Occupancy = Literal["one", "both"]
"""The bookings of a moving robot: the vertex it leaves (``one``), or the next one as well."""


Walls = Literal["free", "strict"]
"""Whether robots wider than a cell keep out of the walls of a grid."""


TURN = "turning time at a stop [time unit], or cell: one cell's crossing time"
RETURN = "home, or none: robots stay at their last stop"


@dataclass(frozen=True, slots=True, kw_only=True)
class Stop:
    """A place to work at.

    Attributes
    ----------
    at
        The vertex.
    work
        The work time of the robot there [time unit], not negative; any `Number`, kept exactly.
    actions
        The actions of the robot there; empty for the actions of the place. No plan depends on it.

    Raises
    ------
    InputError
        For a vertex that is not a number, for a work time of another kind or below 0, and for
        actions of another kind.
    """

    at: VertexId
    work: Fraction = Fraction(0)
    actions: tuple[StopAction, ...] = ()

    def __post_init__(self) -> None:
        coerce_fields(self, "stop", at=VERTEX, work=NOT_NEGATIVE, actions=ACTIONS)


@dataclass(frozen=True, slots=True, kw_only=True)
class Robot:
    """A robot and its trip. Values of None follow the rules of the scenario.

    Attributes
    ----------
    name
        Unique in its scenario.
    home
        The vertex it starts from, and returns to.
    stops
        The places to work at, in order; at least one, but in a scenario with jobs none.
    speed
        Length units per time unit, positive; any `Number`, kept exactly.
    radius
        Radius of the circle that it needs [length unit], not negative; 0 for a point.
    type
        The name of its type, by which edges and vertices may be barred; None for none.
    turn
        Turning time at each stop, if it differs from the rules.
    ends
        Whether it returns home, if that differs from the rules.
    laps
        The number of its round trips, if that differs from the rules.
    turn_rate
        Its speed of turning on the spot [degrees per time unit], positive, if that differs from the
        rules.
    weight
        The weight of its completion time, compared with those of the other robots; positive.
    start
        Where it begins and the work it has done; None: at home, with no job begun. Like the next
        three only in a scenario with jobs, in which a robot has no `stops`.
    capacity
        The largest load, not negative; None for 1.
    battery
        The name of its battery; None for no limit.
    charging
        The vertices at which it may charge; None for all charging places.

    Raises
    ------
    InputError
        With every value of another kind or out of range.
    """

    name: str
    home: VertexId
    stops: tuple[Stop, ...] = ()
    speed: Fraction = field(
        default=Fraction(1),
        metadata=make_attribute(
            POSITIVE,
            "length units per time unit, above 0; 1 by default",
            measure="speed",
            always=True,
        ),
    )
    radius: Fraction = field(
        default=Fraction(0),
        metadata=make_attribute(
            NOT_NEGATIVE,
            "radius of the circle that it needs [length unit]",
            measure="length",
        ),
    )
    type: str | None = field(
        default=None,
        metadata=make_attribute(
            NAME,
            "the name of its type, for edges and vertices that are barred for types",
            unset="none",
        ),
    )
    turn: Turn | None = field(
        default=None,
        metadata=make_attribute(
            TURNING,
            TURN,
            measure="time",
        ),
    )
    ends: TripEnd | None = field(
        default=None,
        metadata=make_attribute(
            make_words(*get_args(TripEnd)),
            RETURN,
            key="return",
        ),
    )
    laps: int | None = field(
        default=None,
        metadata=make_attribute(
            COUNT,
            "the number of its round trips, 1 or more",
        ),
    )
    turn_rate: Fraction | None = field(
        default=None,
        metadata=make_attribute(
            POSITIVE,
            "the speed of turning on the spot [degrees per time unit]; by default turning takes "
            "no time",
        ),
    )
    weight: Fraction = field(
        default=Fraction(1),
        metadata=make_attribute(
            POSITIVE,
            "the weight of its completion time compared with those of others, above 0",
        ),
    )
    start: RobotState | None = None
    capacity: int | None = None
    battery: str | None = None
    charging: tuple[VertexId, ...] | None = None

    def __post_init__(self) -> None:
        coerce_fields(
            self,
            f"robot {quote(self.name)}",
            name=TEXT,
            home=VERTEX,
            stops=list_of(make_class(Stop), admits=list | tuple),
            start=allow_none(make_class(RobotState)),
            capacity=allow_none(AMOUNT),
            battery=allow_none(TEXT),
            charging=allow_none(list_of(VERTEX)),
            **list_kinds(Robot),
        )

    def __repr__(self) -> str:
        stops = ", ".join(str(stop.at) for stop in self.stops)
        return f"Robot({self.name!r}, home {self.home}, stops {stops}, speed {self.speed})"


@dataclass(frozen=True, slots=True, kw_only=True)
class Rules:
    """The rules of a scenario; the defaults are those of the paper.

    Attributes
    ----------
    occupancy
        ``one``: a robot books a vertex from when it enters. ``both``: from when it starts to drive
        there, as real fleets do. None means ``both`` where a robot has a radius, else ``one``.
    headway
        Least time between one robot leaving a vertex and the next entering it [time unit].
    turn
        Turning time at each stop. None means ``cell`` on a grid, and 0 on other roadmaps and for
        robots with a turn rate.
    ends
        Whether robots return home.
    laps
        The number of round trips of each robot.
    rotations
        Whether three or more robots may move round a circle all at one instant.
    clearance
        Least distance between two robots of which one has a radius [length unit].
    walls
        ``strict``: on a grid, robots do not drive where they reach into a blocked cell or over the
        border. ``free``: robots with a radius above half a cell may.
    turn_rate
        The speed of turning on the spot [degrees per time unit], positive. None: a change of
        heading takes no time.
    objective
        The objective after the weight of unserved jobs; None for ``service``. Like `late`
        only in a scenario with jobs.
    late
        The cost of a time unit of a job after its `due`, compared with one of service time, not
        negative; None for 10.
    patience
        In a shift, jobs without `due` are overdue so long after their `earliest` [time unit], and
        are then assigned before others; not negative, None for 1800. Plans do not depend on it.

    Raises
    ------
    InputError
        With every value of another kind or out of range.
    """

    occupancy: Occupancy | None = field(
        default=None,
        metadata=make_attribute(
            make_words(*get_args(Occupancy)),
            "one, or both: a robot books the next place before it starts to drive there",
            always=True,
        ),
    )
    headway: Fraction = field(
        default=Fraction(0),
        metadata=make_attribute(
            NOT_NEGATIVE,
            "least time between two robots at a vertex [time unit]",
            measure="time",
            always=True,
        ),
    )
    turn: Turn | None = field(
        default=None, metadata=make_attribute(TURNING, TURN, measure="time", unset="as usual")
    )
    ends: TripEnd = field(
        default="home",
        metadata=make_attribute(make_words(*get_args(TripEnd)), RETURN, key="return", always=True),
    )
    laps: int = field(
        default=1,
        metadata=make_attribute(
            COUNT, "the number of round trips of each robot, 1 or more", always=True
        ),
    )
    rotations: bool = field(
        default=True,
        metadata=make_attribute(
            TRUTH, "true or false: may a ring of robots move on at one instant?", always=True
        ),
    )
    clearance: Fraction = field(
        default=Fraction(0),
        metadata=make_attribute(
            NOT_NEGATIVE,
            "least distance between two robots of which one has a radius [length unit]",
            measure="length",
        ),
    )
    walls: Walls = field(
        default="free",
        metadata=make_attribute(
            make_words(*get_args(Walls)),
            "free, or strict: robots wider than a cell keep out of walls of a grid",
        ),
    )
    turn_rate: Fraction | None = field(
        default=None,
        metadata=make_attribute(
            POSITIVE,
            "the speed of turning on the spot [degrees per time unit]; by default turning takes "
            "no time",
            unset="none",
        ),
    )
    objective: WorkObjective | None = None
    late: Fraction | None = None
    patience: Fraction | None = None

    def __post_init__(self) -> None:
        coerce_fields(
            self,
            "rules",
            objective=allow_none(make_words(*get_args(WorkObjective))),
            late=allow_none(NOT_NEGATIVE),
            patience=allow_none(NOT_NEGATIVE),
            **list_kinds(Rules),
        )


ROBOT_ATTRIBUTES = list_attributes(Robot)
"""Attributes of a robot other than its name and its trip."""

RULE_ATTRIBUTES = list_attributes(Rules)
"""Rules of the whole fleet."""
