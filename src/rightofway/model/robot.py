"""A robot with its trip, and the rules that hold for the whole fleet."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Literal

from rightofway.errors import shown
from rightofway.site import VertexId
from rightofway.values import (
    coerced,
    number,
    optional,
    text,
    truth,
    turning,
    vertex,
    whole_number,
    word_of,
)

Turn = Literal["cell"] | Fraction
"""Turning time at a stop: one cell's crossing time of the robot, or a time [time unit]."""

TripEnd = Literal["home", "none"]
"""Where a trip ends: at ``home``, or (``none``) at the last stop."""

Occupancy = Literal["one", "both"]
"""What a moving robot books: the vertex it leaves (``one``), or the one it drives to as well."""


Walls = Literal["free", "strict"]
"""Whether robots wider than a cell keep out of the walls of a grid."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Stop:
    """A place to work at.

    Attributes
    ----------
    at
        The vertex.
    work
        How long the robot works there [time unit], not negative; any `Number`, kept exactly.

    Raises
    ------
    InputError
        For a vertex that is no number, or a work time that is none.
    """

    at: VertexId
    work: Fraction = Fraction(0)

    def __post_init__(self) -> None:
        coerced(self, "stop", at=vertex, work=number)


@dataclass(frozen=True, slots=True, kw_only=True)
class Robot:
    """A robot and its trip. What is None follows the rules of the scenario.

    Attributes
    ----------
    name
        Unique in its scenario.
    home
        The vertex it starts from, and returns to.
    stops
        The places to work at, in order; at least one.
    speed
        Length units per time unit, positive; any `Number`, kept exactly.
    turn
        Turning time at each stop, if it differs from the rules.
    ends
        Whether it returns home, if that differs from the rules.
    laps
        How often it makes its round trip, if that differs from the rules.
    radius
        Radius of the circle that it needs [length unit], not negative; 0 for a point.
    type
        The name of its type, by which edges and vertices may be barred; None for none.
    turn_rate
        How fast it turns on the spot [degrees per time unit], positive, if that differs from the
        rules.

    Raises
    ------
    InputError
        With every value of a wrong kind; the ranges are checked by `Scenario`.
    """

    name: str
    home: VertexId
    stops: tuple[Stop, ...]
    speed: Fraction = Fraction(1)
    turn: Turn | None = None
    ends: TripEnd | None = None
    laps: int | None = None
    radius: Fraction = Fraction(0)
    type: str | None = None
    turn_rate: Fraction | None = None

    def __post_init__(self) -> None:
        coerced(
            self,
            f"robot {shown(self.name)}",
            name=text,
            home=vertex,
            stops=_stops,
            speed=number,
            turn=optional(turning),
            ends=optional(word_of(TripEnd)),
            laps=optional(whole_number),
            radius=number,
            type=optional(text),
            turn_rate=optional(number),
        )

    def __repr__(self) -> str:
        stops = ", ".join(str(stop.at) for stop in self.stops)
        return f"Robot({self.name!r}, home {self.home}, stops {stops}, speed {self.speed})"


def _stops(value: object) -> tuple[Stop, ...]:
    if isinstance(value, list | tuple) and all(isinstance(stop, Stop) for stop in value):
        return tuple(value)
    raise ValueError(f"{shown(value)} are no stops (give a list of Stop(at=vertex, work=time))")


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
        How often each robot makes its round trip.
    rotations
        Whether three or more robots may move round a circle all at one instant.
    clearance
        Least distance between two robots of which one has a radius [length unit].
    turn_rate
        How fast robots turn on the spot [degrees per time unit], positive. None: a change of
        heading takes no time.
    walls
        ``strict``: on a grid, robots do not drive where they reach into a blocked cell or over the
        border. ``free``: robots with a radius above half a cell may.

    Raises
    ------
    InputError
        With every value of a wrong kind; the ranges are checked by `Scenario`.
    """

    occupancy: Occupancy | None = None
    headway: Fraction = Fraction(0)
    turn: Turn | None = None
    ends: TripEnd = "home"
    laps: int = 1
    rotations: bool = True
    clearance: Fraction = Fraction(0)
    turn_rate: Fraction | None = None
    walls: Walls = "free"

    def __post_init__(self) -> None:
        coerced(
            self,
            "rules",
            occupancy=optional(word_of(Occupancy)),
            headway=number,
            turn=optional(turning),
            ends=word_of(TripEnd),
            laps=whole_number,
            rotations=truth,
            clearance=number,
            turn_rate=optional(number),
            walls=word_of(Walls),
        )

    @property
    def books_ahead(self) -> bool:
        """Whether a robot books a vertex from when it starts to drive there."""
        return self.occupancy == "both"
