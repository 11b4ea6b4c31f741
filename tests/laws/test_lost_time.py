"""Every tick of a completion time is explained once; each wait has the cause that ticks show."""

from __future__ import annotations

from collections import Counter
from itertools import pairwise

from hypothesis import strategies as st

from rightofway.metrics import alone_completions, lost_time, waits
from rightofway.model import Scenario
from tests.builders.any_fleet import any_fleet
from tests.builders.any_plan import STRICT, planned
from tests.builders.laws import law
from tests.oracles import lost_time as oracle

planners = st.sampled_from(STRICT)


@law(any_fleet(), planners)
def test_alone_detours_making_room_and_waiting_sum_up_to_the_completion(
    scenario: Scenario, planner: str
) -> None:
    plan = planned(scenario, planner)
    alone = alone_completions(scenario)
    for lost, activity in zip(lost_time(plan), oracle.ticks_by_activity(plan), strict=True):
        assert lost.completion == plan.completions[lost.robot]
        assert lost.alone == alone[lost.robot]
        assert min(lost.detours, lost.making_room, lost.waiting) >= 0
        assert lost.waiting == activity["waits"]
        # Only a robot that leaves its last vertex again turns there before.
        turning = lost.making_room - activity["makes room"]
        assert 0 <= turning <= (activity["works"] if activity["makes room"] else 0)
        by_kind = Counter[str]()
        for loss in lost.losses:
            by_kind[loss.kind] += loss.ticks
        assert by_kind["makes room"] == lost.making_room
        assert by_kind["waits"] + by_kind["follows"] == lost.waiting


# The oracle has one holder of each vertex, and robots that hold nothing else.
# The oracle of causes does not know what waits because a rotation is forbidden.
@law(any_fleet(without={"sizes", "zones", "closures", "no rotations"}), planners)
def test_joined_waits_are_for_the_robots_that_hold_the_places(
    scenario: Scenario, planner: str
) -> None:
    plan = planned(scenario, planner)
    found: Counter[tuple[int, int | None]] = Counter()
    joined = 0
    for lost in lost_time(plan):
        for loss in lost.losses:
            if loss.kind != "makes room":
                found[loss.robot, loss.for_robot] += loss.ticks
                joined += loss.count
            if loss.kind == "follows":
                assert loss.for_robot is not None
                own, leader = (
                    set(pairwise(plan.tracks[robot].vertices.tolist()))
                    for robot in (loss.robot, loss.for_robot)
                )
                assert any(head == loss.freed for _, head in own & leader)
    assert found == oracle.causes(plan)
    assert joined == len(waits(plan))
