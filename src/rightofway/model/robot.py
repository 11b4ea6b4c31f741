"""One moving unit: where it lives, where it works, how fast it is."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Literal

from rightofway.errors import shown
from rightofway.model.units import VertexId
from rightofway.model.values import (
    coerced,
    number,
    optional,
    text,
    turning,
    vertex,
    whole_number,
    word_of,
)

__all__ = ["Robot", "Stop", "TripEnd", "Turn"]

Turn = Literal["cell"] | Fraction
"""Turning time at a stop: one cell's crossing time of the robot, or a time [time unit]."""

TripEnd = Literal["home", "none"]
"""Where a trip ends: at ``home``, or (``none``) at the last stop."""


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
        )

    def __repr__(self) -> str:
        stops = ", ".join(str(stop.at) for stop in self.stops)
        return f"Robot({self.name!r}, home {self.home}, stops {stops}, speed {self.speed})"


def _stops(value: object) -> tuple[Stop, ...]:
    if isinstance(value, list | tuple) and all(isinstance(stop, Stop) for stop in value):
        return tuple(value)
    raise ValueError(f"{shown(value)} are no stops (give a list of Stop(at=vertex, work=time))")
