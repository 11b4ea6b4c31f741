"""Steady state of a plan with repeated laps: its start, its period, its critical cycle."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from rightofway.errors import InputError
from rightofway.kinds.table import COUNT, WHOLE, coerce_fields, list_of, make_whole, tuple_of
from rightofway.model.units import Tick

_VISIT = tuple_of(WHOLE, "robot", "index of its visit")


@dataclass(frozen=True, slots=True, kw_only=True)
class SteadyState:
    """A group of robots whose visits repeat with one period.

    Attributes
    ----------
    robots
        Their indices; robots that never meet these have a steady state of their own.
    start
        The first tick from which on every visit repeats; the transient is before [ticks].
    period
        The time from a visit to its repetition [ticks].
    critical
        The critical cycle: visits (robot, index in its track) that wait for each other, in the
        order of the cycle, each as it is in any one period. Of a visit before one of another robot
        only the begin counts: it ends the visit that the other robot waits for. Empty if unknown.

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
        coerce_fields(
            self,
            "",
            robots=list_of(WHOLE),
            critical=list_of(_VISIT),
            start=make_whole(0),
            period=COUNT,
        )
        for index, (robot, _) in enumerate(self.critical):
            if robot not in self.robots:
                message = f"robot {robot} is not of this group (name one of its robots)"
                raise InputError.at(("critical", index), message)


def refuse_unknown_robots(
    steady: Sequence[SteadyState], names: Sequence[str], visits: Sequence[int]
) -> None:
    """Refuse groups that do not fit a plan.

    Raises
    ------
    InputError
        If a group names a robot or a visit that the plan does not have, or a robot is in two.
    """
    seen: set[int] = set()
    for index, group in enumerate(steady):
        for robot in group.robots:
            if not 0 <= robot < len(names):
                message = f"there is no robot {robot} (give 0 to {len(names) - 1})"
                raise InputError.at(("steady", index, "robots"), message)
            if robot in seen:
                message = f"{names[robot]} is there already (give each robot one period)"
                raise InputError.at(("steady", index, "robots"), message)
            seen.add(robot)
        for place, (robot, visit) in enumerate(group.critical):
            last = visits[robot] - 1
            if not 0 <= visit <= last:
                message = f"{names[robot]} has no visit {visit} (give 0 to {last})"
                raise InputError.at(("steady", index, "critical", place), message)


def keep_within(steady: Sequence[SteadyState], visits: Sequence[int]) -> tuple[SteadyState, ...]:
    """Return groups for a plan with shorter tracks, without critical cycles beyond their ends."""
    return tuple(
        group
        if all(visit < visits[robot] for robot, visit in group.critical)
        else replace(group, critical=())
        for group in steady
    )
