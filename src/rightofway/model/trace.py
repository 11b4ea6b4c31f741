"""One execution of a plan: where robots were, and how long each visit and drive took."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rightofway.errors import InputError
from rightofway.model.route import Track
from rightofway.model.units import Tick


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ExecutionTrace:
    """One execution of a plan, with delays.

    Attributes
    ----------
    tracks
        Vertices and times of each robot: its planned vertices, or the first of them if it got no
        further; other vertices if the remaining route was replanned.
    dwell
        For each robot, the real duration of work and turning in each visit [ticks]; int64, as long
        as its track.
    drive
        For each robot, the real duration of the drive into each visit, 0 for the first [ticks];
        int64, as long as its track.
    completion
        When each robot had done its work and was at its last vertex [ticks]; None for never.
    stoppages
        For each robot, its stoppages in order: first tick and length [ticks], None for a breakdown.
        Empty if no robot had one.

    Raises
    ------
    InputError
        If these are not of one length.
    """

    tracks: tuple[Track, ...]
    dwell: tuple[NDArray[np.int64], ...]
    drive: tuple[NDArray[np.int64], ...]
    completion: tuple[Tick | None, ...]
    stoppages: tuple[tuple[tuple[Tick, Tick | None], ...], ...] = ()

    def __post_init__(self) -> None:
        robots = len(self.tracks)
        for name in ("dwell", "drive", "completion", "stoppages"):
            given = getattr(self, name)
            if len(given) != robots and (given or name != "stoppages"):
                message = f"{len(given)} for {robots} tracks (give one for each)"
                raise InputError.at(name, message)
        for robot, track in enumerate(self.tracks):
            for name in ("dwell", "drive"):
                given = len(getattr(self, name)[robot])
                if given != len(track):
                    message = f"{given} for {len(track)} visits (give one for each)"
                    raise InputError.at((name, robot), message)
