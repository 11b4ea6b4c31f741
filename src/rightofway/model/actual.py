"""What became of a plan on the floor: the same visits at other ticks."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rightofway.errors import InputError
from rightofway.model.plan import Track
from rightofway.model.units import Tick

__all__ = ["Actual"]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Actual:
    """One run of a plan on a floor where robots are late.

    Attributes
    ----------
    tracks
        One for each robot: the vertices of its planned track, or the first of them where it never
        got further, with the ticks at which it entered them.
    held
        For each robot, how long each of its visits was held up by the robot itself, not by others
        [ticks]; int64, as long as its track.
    broken
        When each robot broke down [ticks]; None for those that did not. Empty if none did.

    Raises
    ------
    InputError
        If these are not of one length.
    """

    tracks: tuple[Track, ...]
    held: tuple[NDArray[np.int64], ...]
    broken: tuple[Tick | None, ...] = ()

    def __post_init__(self) -> None:
        robots = len(self.tracks)
        for name, given in (("held", self.held), ("broken", self.broken or self.tracks)):
            if len(given) != robots:
                message = f"{len(given)} for {robots} tracks (give one for each)"
                raise InputError.at(name, message)
        for robot, (track, held) in enumerate(zip(self.tracks, self.held, strict=True)):
            if len(held) != len(track):
                message = f"{len(held)} ticks for {len(track)} visits (give one for each)"
                raise InputError.at(f"held[{robot}]", message)
