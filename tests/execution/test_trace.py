"""A run as a page shows it."""

import numpy as np
import pytest

from rightofway import InputError, solve
from rightofway.execution import simulate
from tests.builders.fleets import random_fleet
from tests.builders.plans import door


def test_the_delays_of_a_run_account_for_its_times() -> None:
    """R1 stands still in N4 from 3 to 8, and R2 has to pass there behind it: 4 late."""
    outcome = simulate(door(), "stop:R1@3+5", runs=1)
    actual = outcome.trace(0)
    assert actual.tracks == outcome.trace(0).tracks
    assert actual.stoppages == (((3, 5),), ())
    assert actual.completion == (15, 13)
    one, planned = actual.tracks[0], door().tracks[0]
    assert (np.diff(one.enter) - np.diff(planned.enter)).sum() == 5
    assert actual.dwell[0].tolist() == [0, 0, 0, 0, 1, 0, 0, 0, 0]
    assert actual.drive[0].tolist() == [0, 1, 1, 1, 1, 1, 1, 1, 1]


def test_a_robot_that_breaks_down_never_completes() -> None:
    """R2 is in N7 at 3 and stays there; R1 behind it, too."""
    actual = simulate(door(), "stop:R2@3", runs=1).trace(0)
    assert actual.completion == (None, None)
    assert actual.stoppages[1] == ((3, None),)
    assert [len(drive) for drive in actual.drive] == list(map(len, actual.tracks))


def test_the_typical_run_is_in_the_middle() -> None:
    outcome = simulate(door(), "exponential:0.5", runs=11, seed=3)
    flowtimes = outcome.completion.sum(axis=1)
    assert flowtimes[outcome.find_typical_run()] == np.median(flowtimes)


def test_there_is_no_run_beyond_the_last() -> None:
    with pytest.raises(InputError, match="run 3 is not among the 3 runs"):
        simulate(door(), runs=3).trace(3)


def test_a_replanned_run_accounts_for_its_times_as_well() -> None:
    """Each visit lasts as long as it takes and the drive after it, and waiting on top."""
    plan = solve(random_fleet(2, size=12, robots=10), "two-level", None)
    outcome = simulate(plan, "slow:R10x2", runs=1, replan=True)
    assert outcome.replans > 0
    actual = outcome.trace(0)
    assert any(one != other for one, other in zip(actual.tracks, plan.tracks, strict=True))
    for track, dwell, drive in zip(actual.tracks, actual.dwell, actual.drive, strict=True):
        assert (np.diff(track.enter) >= dwell[:-1] + drive[1:]).all()
    slow = actual.drive[9][1:] / np.gcd.reduce(actual.drive[9][1:])
    assert set(slow.tolist()) == {1.0}
    assert [ticks for ticks in actual.completion if ticks is not None] == (
        outcome.completion[0].tolist()
    )
