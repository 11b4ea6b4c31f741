"""Progress: the knowledge at an instant of robots that carry out a plan.

Forecasts, switching and replanning take progress only, never the future that a simulation knows
after the instant. `derive_progress` makes it from the delays of a simulated run.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from rightofway.model import NEVER, Tick
from rightofway.precedence import ActionDependencyGraph, DelaySample, Execution

Times = NDArray[np.int64]  # a time for each visit [ticks]; shape (N,)


class Activity(Enum):
    """The activity of a robot at its last visit that has begun."""

    STAYS = "stays"  # it works or turns
    DRIVES = "drives"  # to the next vertex, which it has booked under ``occupancy: both`` only
    WAITS = "waits"  # for its right of way, and for nothing else


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Progress:
    """The progress of robots at an instant, visits numbered as in `ActionDependencyGraph`.

    Attributes
    ----------
    now
        The instant [ticks].
    enter
        When each visit began, `NEVER` if it has not yet [ticks]; int64[N]. The last visit of a
        robot with a tick is the one it has reached, and the tick is since when.
    start
        From when each visit has booked its vertex, `NEVER` if it has not yet [ticks]; int64[N]. A
        robot holds the visit that it has reached and all later ones with a tick.
    activity
        The activity of each robot.
    broken
        Robots that have broken down: nothing more is expected of them.
    delay
        For each robot by how much its stay or drive is known to last longer than planned [ticks];
        None where that is unknown. Empty: unknown for all robots.
    """

    now: Tick
    enter: Times
    start: Times
    activity: tuple[Activity, ...]
    broken: frozenset[int] = frozenset()
    delay: tuple[Tick | None, ...] = ()

    @property
    def entered(self) -> NDArray[np.bool_]:
        """Visits that have begun; bool[N]."""
        return self.enter < NEVER

    @property
    def booked(self) -> NDArray[np.bool_]:
        """Visits that have booked their vertex; bool[N]."""
        return self.start < NEVER

    def get_delay(self, robot: int) -> Tick | None:
        """Return how much longer than planned a robot's stay or drive lasts, None if unknown."""
        return self.delay[robot] if self.delay else None


def derive_progress(
    adg: ActionDependencyGraph,
    delay_sample: DelaySample,
    execution: Execution,
    now: int,
    broken: frozenset[int] = frozenset(),
) -> Progress:
    """Return the progress of a simulated run at a tick; later times are not looked at."""
    enter = np.where(execution.enter <= now, execution.enter, NEVER)
    start = np.where(execution.start <= now, execution.start, NEVER)
    progress = Progress(now=Tick(now), enter=enter, start=start, activity=(), broken=broken)
    activity = (
        _classify_activity(adg, delay_sample, progress, robot) for robot in range(len(adg.routes))
    )
    return replace(progress, activity=tuple(activity))


def _classify_activity(
    adg: ActionDependencyGraph, delay_sample: DelaySample, progress: Progress, robot: int
) -> Activity:
    """Return the activity of a robot, from its delays and its begun actions."""
    first, end = adg.first_visit[robot : robot + 2].tolist()
    visit = first + int(np.count_nonzero(progress.entered[first:end])) - 1
    books_ahead = adg.scenario.problem.booking_rules.books_ahead
    if visit == end - 1:
        return Activity.STAYS
    if books_ahead and progress.booked[visit + 1]:
        return Activity.DRIVES
    begins = int(progress.enter[visit])
    stayed = begins + int(delay_sample.dwell[visit])
    # Under ``occupancy: one`` a robot waits for its right of way after the drive, before it enters.
    ready = stayed if books_ahead else stayed + int(delay_sample.drive[visit + 1])
    stands = False
    for begin, ticks in delay_sample.list_stoppages(robot):
        if begins <= begin < ready:
            ready += ticks
        stands |= begin < progress.now < begin + ticks
    if ready <= progress.now and not stands:
        return Activity.WAITS
    return Activity.STAYS if books_ahead or stayed > progress.now else Activity.DRIVES
