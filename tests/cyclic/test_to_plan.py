"""Laps as a page shows them."""

from pathlib import Path

import numpy as np

from rightofway.cyclic import make_excerpt, run_laps
from rightofway.io import load
from rightofway.model import Robot, Scenario, Stop
from rightofway.site import VertexId, make_grid_roadmap
from rightofway.viz import make_payload
from tests.builders.plans import counter

EXAMPLES = Path(__file__).parents[2] / "examples"


def test_two_robots_at_one_counter_repeat_themselves_as_by_hand() -> None:
    """The plan by hand has the same times; each robot makes a lap every 10 ticks."""
    by_hand = counter()
    plan, (steady,) = make_excerpt(run_laps(by_hand.scenario, "first-come"))
    assert (steady.robots, steady.period) == ((0, 1), 10)
    for track, known in zip(plan.tracks, by_hand.tracks, strict=True):
        assert track.enter[: len(known)].tolist() == known.enter.tolist()


def test_the_bottleneck_comes_round_in_a_period() -> None:
    """N1 is held by R1, then by R2, and nobody can be there sooner."""
    plan, (steady,) = make_excerpt(run_laps(counter().scenario, "first-come"))
    ticks = [int(plan.tracks[robot].enter[visit]) for robot, visit in steady.critical]
    places = {int(plan.tracks[robot].vertices[visit]) for robot, visit in steady.critical}
    assert {robot for robot, _ in steady.critical} == {0, 1}
    assert 1 in places
    assert max(ticks) - min(ticks) <= 2 * steady.period


def test_nobody_stays_at_home_before_the_last_period_is_over() -> None:
    plan, groups = make_excerpt(run_laps(load(EXAMPLES / "crossroad.yaml")), periods=3)
    for group in groups:
        for robot in group.robots:
            assert plan.tracks[robot].enter[-1] > group.start + 3 * group.period


def test_every_lap_is_whole() -> None:
    plan, _ = make_excerpt(run_laps(load(EXAMPLES / "door.yaml")))
    for robot, track in zip(plan.scenario.robots, plan.tracks, strict=True):
        laps = int(np.count_nonzero(track.vertices[1:] == robot.home))
        assert robot.laps == laps
        assert track.vertices[-1] == robot.home


def test_a_long_period_is_not_shown_whole() -> None:
    """A lap has 12 and 14 visits, so 60 are two or three laps each, and one more for each."""
    plan, _ = make_excerpt(run_laps(load(EXAMPLES / "crossroad.yaml")), periods=50, most_visits=60)
    assert 60 <= sum(map(len, plan.tracks)) < 60 + 2 * 14 + 2


def test_who_waits_for_ever_is_shown_waiting() -> None:
    """In fixed order R1 always goes first at the counter, and R2 never gets there."""
    plan, (steady,) = make_excerpt(run_laps(counter().scenario, "fixed-order"))
    assert steady.robots == (0,)
    assert len(plan.tracks[1]) == 1
    robots = make_payload(plan, steady=[steady])["robots"]
    assert ["stands" in robot for robot in robots] == [False, True]


def test_a_deadlock_is_shown_to_its_end() -> None:
    """Two robots meet in one lane, each where the other has to go."""
    roadmap = make_grid_roadmap(["...."])
    ends = ((0, 3), (3, 0))
    robots = tuple(
        Robot(name=f"R{index}", home=VertexId(home), stops=(Stop(at=VertexId(stop)),))
        for index, (home, stop) in enumerate(ends)
    )
    plan, steady = make_excerpt(run_laps(Scenario(roadmap=roadmap, robots=robots)))
    assert steady == ()
    assert all(robot["stands"] for robot in make_payload(plan)["robots"])
