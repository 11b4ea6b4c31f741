"""From when on a plan repeats itself, after how long, and what keeps it from repeating sooner."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from rightofway.errors import InputError
from rightofway.model.units import Tick

__all__ = ["SteadyState", "refuse_unknown_robots", "within"]


@dataclass(frozen=True, slots=True, kw_only=True)
class SteadyState:
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


def refuse_unknown_robots(
    steady: Sequence[SteadyState], names: Sequence[str], visits: Sequence[int]
) -> None:
    """Refuse groups that are not of a plan.

    Parameters
    ----------
    steady
        Groups of its robots.
    names, visits
        What each robot of the plan is called, and how many visits its track has.

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
                raise InputError.at(f"steady[{index}].robots", message)
            if robot in seen:
                message = f"{names[robot]} is there already (give each robot one period)"
                raise InputError.at(f"steady[{index}].robots", message)
            seen.add(robot)
        for place, (robot, visit) in enumerate(group.critical):
            last = visits[robot] - 1
            if not 0 <= visit <= last:
                message = f"{names[robot]} has no visit {visit} (give 0 to {last})"
                raise InputError.at(f"steady[{index}].critical[{place}]", message)


def within(steady: Sequence[SteadyState], visits: Sequence[int]) -> tuple[SteadyState, ...]:
    """Return the groups for a plan with shorter tracks: bottlenecks beyond their ends are unknown.

    Parameters
    ----------
    steady
        Groups of the robots of a plan.
    visits
        How many visits the track of each robot has.
    """
    return tuple(
        group
        if all(visit < visits[robot] for robot, visit in group.critical)
        else replace(group, critical=())
        for group in steady
    )
