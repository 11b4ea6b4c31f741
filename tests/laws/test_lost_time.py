"""Every tick of a completion time is explained once; each wait has the cause that ticks show."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from itertools import pairwise

import numpy as np
from hypothesis import strategies as st

from rightofway.check import check
from rightofway.metrics import compute_alone_completions, compute_lost_time, waits
from rightofway.metrics.waits import find_freeing_visits
from rightofway.model import Plan, Scenario, Track, find_stays
from tests.builders.any_fleet import any_fleet
from tests.builders.any_plan import STRICT, planned
from tests.builders.laws import law
from tests.oracles import lost_time as oracle

planners = st.sampled_from(STRICT)
"""Planners of any plan."""

SEARCHES = {"auto", "lns"}
"""These search for long where their options do not end them."""


def planned_quickly(scenario: Scenario, planner: str) -> Plan:
    """Return a plan; where a planner would search for long, a plan of another one that it improves.

    Its rights of way differ from those of the other plan as much as if it had begun itself.
    """
    if planner not in SEARCHES:
        return planned(scenario, planner)
    return planned(scenario, "lns", start=planned(scenario, "prioritized"))


@law(any_fleet(), planners)
def test_alone_detours_making_room_and_waiting_sum_up_to_the_completion(
    scenario: Scenario, planner: str
) -> None:
    plan = planned_quickly(scenario, planner)
    alone = compute_alone_completions(scenario)
    for lost, activity in zip(compute_lost_time(plan), oracle.ticks_by_activity(plan), strict=True):
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
@law(any_fleet(without={"passed", "sizes", "zones", "closures", "no rotations"}), planners)
def test_joined_waits_are_for_the_robots_that_hold_the_places(
    scenario: Scenario, planner: str
) -> None:
    plan = planned_quickly(scenario, planner)
    found: Counter[tuple[int, int | None]] = Counter()
    joined = 0
    for lost in compute_lost_time(plan):
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


# Where rotations are forbidden, a tick between two bookings is no fault by itself.
@law(any_fleet(without={"no rotations"}), planners)
def test_a_wait_that_is_a_tick_shorter_breaks_the_right_of_way_that_is_its_cause(
    scenario: Scenario, planner: str
) -> None:
    """The wait before the visit that is bound is shortened; the judge names the robot it is for."""
    plan = planned_quickly(scenario, planner)
    for lost in compute_lost_time(plan):
        for loss in lost.losses:
            if loss.kind == "makes room" or loss.for_robot is None:
                continue
            track = plan.tracks[loss.robot]
            enter = track.enter.copy()
            waited = int(np.searchsorted(enter, loss.end)) - 1  # the last wait that was joined
            until = bound_visit(plan, loss.robot, waited)
            enter[waited + 1 : until + 1] -= 1
            tracks = list(plan.tracks)
            tracks[loss.robot] = Track(vertices=track.vertices, enter=enter)
            report = check(replace(plan, tracks=tuple(tracks)), limit=10**6)
            pair = {loss.robot, loss.for_robot}
            assert any(pair <= set(fault.robots) for fault in report.faults)


def bound_visit(plan: Plan, robot: int, waited: int) -> int:
    """Return the visit after a wait that cannot begin a tick earlier."""
    frees = find_freeing_visits(plan.scenario, plan.tracks, find_stays(plan.scenario, plan.tracks))
    first = sum(len(track) for track in plan.tracks[:robot])
    own = frees[first : first + len(plan.tracks[robot])]
    return waited + 1 + int(np.flatnonzero(own[waited + 1 :] >= 0)[0])
