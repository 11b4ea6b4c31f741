"""Robots that turn on the spot: the page shows turns where robots turn, not waits."""

from __future__ import annotations

import rightofway
from rightofway.model import Plan
from tests.viewer.conftest import Opener

PHASES = """(({ begin, activity, visit }) =>
  Array.from(begin, (tick, i) => [tick, activity[i], visit[i]])
)"""

DRIVE, WORK, TURN, DONE = 0, 2, 3, 4


def corner() -> Plan:
    """Return the plan of a robot that goes round a corner, works for 3 and comes back."""
    fleet = rightofway.FleetBuilder(grid=["...", "@@."], turn_rate=45)
    return rightofway.solve(fleet.add_robot("R1", home="N0", target="N5", work=3).scenario())


def test_the_page_shows_turns_at_corners_and_at_stops(show: Opener) -> None:
    """At 45 degrees per time unit: 2 for a corner, 4 to come back."""
    viewer = show(corner())
    assert viewer.ask(f"{PHASES}(plan.robots[0].phases)") == [
        [0, DRIVE, 0],
        [1, DRIVE, 1],
        [2, TURN, 2],
        [4, DRIVE, 2],
        [5, WORK, 3],
        [8, TURN, 3],
        [12, DRIVE, 3],
        [13, TURN, 4],
        [15, DRIVE, 4],
        [16, DRIVE, 5],
        [17, DONE, 6],
    ]
    assert viewer.complaints == []


def test_turns_of_a_late_robot_take_their_share_of_its_stay(show: Opener) -> None:
    """R1 takes twice as long for all: its turn at the first corner lasts 4, from 4 to 8."""
    plan = corner()
    trace = rightofway.simulate(plan, "slow:R1x2", runs=1).trace(0)
    viewer = show(plan, actual=trace)
    assert viewer.ask(f"{PHASES}(plan.happened[0].phases)")[:7] == [
        [0, DRIVE, 0],
        [2, DRIVE, 1],
        [4, TURN, 2],
        [8, DRIVE, 2],
        [10, WORK, 3],
        [16, TURN, 3],
        [24, DRIVE, 3],
    ]
