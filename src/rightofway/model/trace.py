"""What became of a plan on the floor: where robots really were, and what really took how long."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rightofway.errors import InputError
from rightofway.model.plan import Track
from rightofway.model.units import Tick

__all__ = ["ExecutionTrace"]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ExecutionTrace:
    """One run of a plan on a floor where robots are late.

    Attributes
    ----------
    tracks
        Where each robot was, when. Usually the vertices of its planned track, or the first of them
        where it never got further; another way where what was left was planned anew.
    dwell
        For each robot, how long it really worked and turned in each visit [ticks]; int64, as long
        as its track.
    drive
        For each robot, the ticks of the edge that it really drove into each visit, 0 for the first;
        int64, as long as its track.
    completion
        When each robot had done its work and was at its last vertex [ticks]; None for never.
    standstills
        For each robot, from when it stood still by itself and how long [ticks], in order; None for
        ever: it broke down. Empty if none did.

    Raises
    ------
    InputError
        If these are not of one length.
    """

    tracks: tuple[Track, ...]
    dwell: tuple[NDArray[np.int64], ...]
    drive: tuple[NDArray[np.int64], ...]
    completion: tuple[Tick | None, ...]
    standstills: tuple[tuple[tuple[Tick, Tick | None], ...], ...] = ()

    def __post_init__(self) -> None:
        robots = len(self.tracks)
        for name in ("dwell", "drive", "completion", "standstills"):
            given = getattr(self, name)
            if len(given) != robots and (given or name != "standstills"):
                message = f"{len(given)} for {robots} tracks (give one for each)"
                raise InputError.at(name, message)
        for robot, track in enumerate(self.tracks):
            for name in ("dwell", "drive"):
                given = len(getattr(self, name)[robot])
                if given != len(track):
                    message = f"{given} for {len(track)} visits (give one for each)"
                    raise InputError.at(f"{name}[{robot}]", message)
