"""When the robots of a fleet book vertices."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rightofway.metrics.stays import Stays
from rightofway.model import Scenario, Tick, Track

__all__ = ["FOREVER", "Bookings", "bookings_of"]

FOREVER = Tick(2**62)
"""When a robot's last booking ends."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Bookings:
    """All bookings of a fleet, by vertex, then by start; each array has shape (n,).

    Attributes
    ----------
    robot, vertex
        Who books what.
    start, end
        From when to when [ticks]; int64.
    """

    robot: NDArray[np.int64]
    vertex: NDArray[np.int32]
    start: NDArray[np.int64]
    end: NDArray[np.int64]


def bookings_of(scenario: Scenario, tracks: Sequence[Track], stays: Sequence[Stays]) -> Bookings:
    """Return what a fleet books under the scenario's rules."""
    leaves = [np.append(track.enter[1:] + scenario.timing.headway, FOREVER) for track in tracks]
    starts = [
        track.enter - _approaches(scenario, stay) for track, stay in zip(tracks, stays, strict=True)
    ]
    vertex, start = np.concatenate([track.vertices for track in tracks]), np.concatenate(starts)
    robot = np.repeat(np.arange(len(tracks)), [len(track) for track in tracks])
    order = np.lexsort((robot, start, vertex))
    return Bookings(
        robot=robot[order],
        vertex=vertex[order],
        start=start[order],
        end=np.concatenate(leaves)[order],
    )


def _approaches(scenario: Scenario, stay: Stays) -> NDArray[np.int64]:
    """Return how long before each enter the robot books the vertex [ticks]."""
    both = scenario.rules.occupancy == "both"
    return np.append(0, stay.drive[:-1]) * both
