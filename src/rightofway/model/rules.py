"""What holds for the whole fleet: occupancy, headway, turning, the way back, laps, rotations."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Literal

from rightofway.model.robot import TripEnd, Turn
from rightofway.model.values import (
    coerced,
    number,
    optional,
    truth,
    turning,
    whole_number,
    word_of,
)

__all__ = ["Occupancy", "Rules"]

Occupancy = Literal["one", "both"]
"""What a moving robot books: the vertex it leaves (``one``), or the one it drives to as well."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Rules:
    """The rules of a scenario; the defaults are those of the paper.

    Attributes
    ----------
    occupancy
        ``one``: a robot books a vertex from when it enters. ``both``: from when it starts to drive
        there, as real fleets do.
    headway
        Least time between one robot leaving a vertex and the next entering it [time unit].
    turn
        Turning time at each stop. None means ``cell`` on a grid and 0 on other roadmaps.
    ends
        Whether robots return home.
    laps
        How often each robot makes its round trip.
    rotations
        Whether three or more robots may move round a circle all at one instant.

    Raises
    ------
    InputError
        With every value of a wrong kind; the ranges are checked by `Scenario`.
    """

    occupancy: Occupancy = "one"
    headway: Fraction = Fraction(0)
    turn: Turn | None = None
    ends: TripEnd = "home"
    laps: int = 1
    rotations: bool = True

    def __post_init__(self) -> None:
        coerced(
            self,
            "rules",
            occupancy=word_of(Occupancy),
            headway=number,
            turn=optional(turning),
            ends=word_of(TripEnd),
            laps=whole_number,
            rotations=truth,
        )

    @property
    def books_ahead(self) -> bool:
        """Whether a robot books a vertex from when it starts to drive there."""
        return self.occupancy == "both"
