"""When visits book, in ticks: the one place that reads the headway and who books ahead."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from rightofway.model.units import Tick

Ticks = TypeVar("Ticks", int, NDArray[np.int64])
"""A number of ticks, or one for each visit."""


@dataclass(frozen=True, slots=True, kw_only=True)
class BookingRules:
    """The rules that turn visits into bookings.

    Attributes
    ----------
    headway
        Least ticks between one robot leaving a vertex and the next entering it.
    books_ahead
        Whether a robot books a vertex from when it starts to drive there (``occupancy: both``).
    rotations
        Whether three or more robots may move round a circle at one instant, where bookings allow
        it.
    """

    headway: Tick = field(default=Tick(0))
    books_ahead: bool = False
    rotations: bool = True

    @property
    def may_follow(self) -> bool:
        """Whether a robot can enter a vertex at the instant at which another one leaves it."""
        return not self.books_ahead and self.headway == 0

    @property
    def may_rotate(self) -> bool:
        """Whether bookings let robots move round a circle at one instant."""
        return self.rotations and self.may_follow

    def keep_apart(self) -> BookingRules:
        """Return stricter rules that leave no rotation, where only a rule forbids it.

        Their headway is one tick: a vertex that is never entered at the instant at which it is left
        cannot be part of a rotation. Planners need no such rules; laps take them where robots
        rotate without.
        """
        if self.rotations or not self.may_follow:
            return self
        return replace(self, headway=Tick(1))

    def start(self, enter: Ticks, drive: Ticks) -> Ticks:
        """Return from when a visit books its vertex, by its enter and the drive into it."""
        return enter - drive if self.books_ahead else enter

    def end(self, leave: Ticks) -> Ticks:
        """Return until when a visit books, by its leave."""
        return leave + int(self.headway)

    def follow(self, end: Ticks, drive: Ticks) -> Ticks:
        """Return when a visit may begin after the end of a booking, by the drive into it."""
        return end + drive if self.books_ahead else end
