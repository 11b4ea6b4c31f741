"""The tours of a plan: when each robot works at stops of jobs, and when it charges."""

from __future__ import annotations

from dataclasses import dataclass

from rightofway.kinds.table import WHOLE, allow_none, coerce_fields
from rightofway.model.units import Tick


@dataclass(frozen=True, slots=True, kw_only=True)
class PlannedItem:
    """Work at a stop of a job, or a charge, in a visit of a robot.

    Attributes
    ----------
    visit
        The visit of the robot, from 0.
    begin, end
        When it begins and ends [ticks].
    job, stop
        Index of the job, and of the stop among all its stops; None and None for a charge.

    Raises
    ------
    InputError
        With every value that is not a whole number.
    """

    visit: int
    begin: Tick
    end: Tick
    job: int | None = None
    stop: int | None = None

    def __post_init__(self) -> None:
        coerce_fields(
            self,
            "",
            visit=WHOLE,
            begin=WHOLE,
            end=WHOLE,
            job=allow_none(WHOLE),
            stop=allow_none(WHOLE),
        )


PlannedTour = tuple[PlannedItem, ...]
"""The items of a robot, in order."""
