"""One moving unit: where it lives, where it works, how fast it is."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Literal

from rightofway.model.units import VertexId

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
        How long the robot works there [time unit], not negative.
    """

    at: VertexId
    work: Fraction = Fraction(0)


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
        Length units per time unit, positive.
    turn
        Turning time at each stop, if it differs from the rules.
    ends
        Whether it returns home, if that differs from the rules.
    laps
        How often it makes its round trip, if that differs from the rules.
    """

    name: str
    home: VertexId
    stops: tuple[Stop, ...]
    speed: Fraction = Fraction(1)
    turn: Turn | None = None
    ends: TripEnd | None = None
    laps: int | None = None
