"""From when on a plan repeats itself, after how long, and what keeps it from repeating sooner."""

from __future__ import annotations

from dataclasses import dataclass

from rightofway.errors import InputError
from rightofway.model.units import Tick

__all__ = ["Steady"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Steady:
    """Robots that repeat themselves together.

    Attributes
    ----------
    robots
        Who, by index; robots that never meet these have a steady period of their own.
    start
        From when on everything comes again [ticks]. What is before is the transient.
    period
        After how many ticks.
    critical
        The bottleneck: visits (robot, index in its track) that wait for each other in a circle, in
        the order of that circle, each as it is in any one period. Of a visit before one of another
        robot only the beginning counts: by it, the vertex is left that the other waits for. None
        where that is not known.

    Raises
    ------
    InputError
        If the period is not positive, the start is negative, or a visit is of another robot.
    """

    robots: tuple[int, ...]
    start: Tick
    period: Tick
    critical: tuple[tuple[int, int], ...] = ()

    def __post_init__(self) -> None:
        if self.period < 1:
            raise InputError.at("period", f"{self.period} is not positive (give 1 tick or more)")
        if self.start < 0:
            raise InputError.at("start", f"{self.start} is negative (give 0 or more)")
        for index, (robot, _) in enumerate(self.critical):
            if robot not in self.robots:
                message = f"robot {robot} is not of this group (name one of its robots)"
                raise InputError.at(f"critical[{index}]", message)
