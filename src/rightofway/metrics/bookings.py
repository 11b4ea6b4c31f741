"""When the robots of a fleet book vertices."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rightofway.model import NEVER, Scenario, Stays, Track
from rightofway.model.sorting import order_by

__all__ = ["Bookings", "bookings_of"]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Bookings:
    """All bookings of a fleet, by vertex, then by start; each array has shape (n,).

    Attributes
    ----------
    visit
        For which visit, counted robot by robot along the tracks.
    robot, vertex
        Who books what.
    start, end
        From when to when [ticks]; int64.
    """

    visit: NDArray[np.int64]
    robot: NDArray[np.int64]
    vertex: NDArray[np.int32]
    start: NDArray[np.int64]
    end: NDArray[np.int64]


def bookings_of(scenario: Scenario, tracks: Sequence[Track], stays: Sequence[Stays]) -> Bookings:
    """Return what a fleet books under the scenario's rules."""
    lengths = [len(track) for track in tracks]
    last = np.cumsum(lengths) - 1
    enter = np.concatenate([track.enter for track in tracks])
    end = np.append(enter[1:] + scenario.problem.headway, NEVER)
    end[last] = NEVER
    vertex = np.concatenate([track.vertices for track in tracks])
    robot = np.repeat(np.arange(len(tracks)), lengths)
    start = enter - _approaches(scenario, stays)
    order = order_by(vertex, start)  # stable, so by robot where all else is equal
    return Bookings(
        visit=order, robot=robot[order], vertex=vertex[order], start=start[order], end=end[order]
    )


def _approaches(scenario: Scenario, stays: Sequence[Stays]) -> NDArray[np.int64]:
    """Return how long before each enter the robot books the vertex [ticks]."""
    approaches = np.roll(np.concatenate([stay.drive for stay in stays]), 1)  # that of the last is 0
    return approaches * scenario.rules.books_ahead
