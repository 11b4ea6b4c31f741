"""Progress of robots at an instant, written by hand: what a forecast makes of it."""

from __future__ import annotations

import numpy as np

from rightofway.execution.forecast import Forecast
from rightofway.execution.progress import Activity, Progress
from rightofway.model import NEVER, Tick
from rightofway.precedence import ActionDependencyGraph, DelayModel
from tests.builders.plans import door


def expected(activity: Activity, delay: tuple[Tick | None, ...] = ()) -> list[list[int]]:
    """Return the expected enters at tick 3: R2 drives since tick 1 into N4, its third visit."""
    plan = door()
    adg = ActionDependencyGraph(plan.scenario, plan.tracks, DelayModel.none(2))
    enter = np.full(18, NEVER)
    enter[0], enter[9:11] = 0, [0, 1]
    progress = Progress(
        now=Tick(3), enter=enter, start=enter, activity=(Activity.WAITS, activity), delay=delay
    )
    return [times.tolist() for times in np.split(Forecast(adg, progress).compute_times(), [9])]


def test_an_overdue_drive_is_expected_to_last_as_long_again_and_others_wait_for_it() -> None:
    """A drive of one tick is one tick overdue, and takes two more; R1 enters N1 at that tick."""
    first, second = expected(Activity.DRIVES)
    assert second[:4] == [0, 1, 5, 6]
    assert first[:3] == [0, 5, 6]


def test_a_known_delay_says_how_long_a_drive_lasts() -> None:
    """One tick as planned and six more: R2 arrives at tick 8."""
    first, second = expected(Activity.DRIVES, (None, Tick(6)))
    assert second[:4] == [0, 1, 8, 9]
    assert first[:3] == [0, 8, 9]


def test_a_robot_that_waits_for_its_right_of_way_only_goes_now() -> None:
    first, second = expected(Activity.WAITS)
    assert second[:4] == [0, 1, 3, 4]
    assert first[:3] == [0, 3, 4]
