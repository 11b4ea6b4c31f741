"""One moving unit: where it lives, where it works, how fast it is."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from numbers import Integral
from typing import Any, Literal, get_args

from rightofway.errors import InputError, InputFault, shown
from rightofway.model.units import VertexId, exact

__all__ = ["Robot", "Stop", "TripEnd", "Turn", "coerced"]

Turn = Literal["cell"] | Fraction
"""Turning time at a stop: one cell's crossing time of the robot, or a time [time unit]."""

TripEnd = Literal["home", "none"]
"""Where a trip ends: at ``home``, or (``none``) at the last stop."""


def coerced(value: Any, source: str, **readers: Any) -> None:
    """Replace fields of a frozen value by what their readers make of them.

    Parameters
    ----------
    value
        A frozen dataclass that is being made.
    source
        The name of the value in messages.
    readers
        For each field a function that returns the value to keep; a ``ValueError`` of the function
        is the fault. None stays None where that is the default.

    Raises
    ------
    InputError
        With every field that its reader refuses.
    """
    faults = []
    for name, read in readers.items():
        given = getattr(value, name)
        try:
            object.__setattr__(value, name, read(given))
        except InputError as error:
            faults += [fault.within(name) for fault in error.faults]
        except ValueError as error:
            faults.append(InputFault(name, str(error)))
    if faults:
        raise InputError(faults, source)


def optional(read: Any) -> Any:
    """Return a reader that also takes None."""
    return lambda value: None if value is None else read(value)


def vertex(value: object) -> VertexId:
    """Return a vertex; a name is refused."""
    if isinstance(value, Integral) and not isinstance(value, bool):
        return VertexId(int(value))
    raise ValueError(
        f"{shown(value)} is no vertex number"
        " (give roadmap.vertex(name), or build the fleet with FleetBuilder, which takes names)"
    )


def number(value: object) -> Fraction:
    """Return an exact number; one that is exact already may have any number of digits."""
    return value if type(value) is Fraction else exact(value)


def turning(value: object) -> Turn:
    """Return a turning time."""
    if value == "cell":
        return "cell"
    try:
        return number(value)
    except ValueError as error:
        raise ValueError(f"{error}; 'cell' is possible too") from None


def count(value: object) -> int:
    """Return a whole number."""
    if isinstance(value, Integral) and not isinstance(value, bool):
        return int(value)
    raise ValueError(f"{shown(value)} is no whole number (give 1 or more)")


def word_of(kind: Any) -> Any:
    """Return a reader of one of the words of a ``Literal``."""

    def read(value: object) -> object:
        if value in get_args(kind):
            return value
        raise ValueError(f"{shown(value)} is unknown (give {' or '.join(get_args(kind))})")

    return read


def text(value: object) -> str:
    """Return a name."""
    if isinstance(value, str):
        return value
    raise ValueError(f"{shown(value)} is no name (give text)")


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
            laps=optional(count),
        )

    def __repr__(self) -> str:
        stops = ", ".join(str(stop.at) for stop in self.stops)
        return f"Robot({self.name!r}, home {self.home}, stops {stops}, speed {self.speed})"


def _stops(value: object) -> tuple[Stop, ...]:
    if isinstance(value, list | tuple) and all(isinstance(stop, Stop) for stop in value):
        return tuple(value)
    raise ValueError(f"{shown(value)} are no stops (give a list of Stop(at=vertex, work=time))")
