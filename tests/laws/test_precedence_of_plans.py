"""Any plan converts to the precedence graph, and its timetable is a plan that is never later."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from hypothesis import strategies as st

import rightofway
from rightofway.model import Plan, Scenario, Track
from rightofway.precedence import PrecedenceGraph, build_graph_of_plan
from tests.builders.any_fleet import any_fleet
from tests.builders.any_plan import STRICT, by_both_judges, planned
from tests.builders.laws import law

planners = st.sampled_from(STRICT)
delays = st.lists(st.integers(0, 9), min_size=4, max_size=4)


def late(plan: Plan, delays: list[int]) -> Plan:
    """Return a plan in which robots start later, each by its delay where the others let it."""
    for robot, (track, ticks) in enumerate(zip(plan.tracks, delays, strict=False)):
        later = Track.of(track.vertices.tolist(), [0, *(track.enter[1:] + ticks).tolist()])
        tracks = (*plan.tracks[:robot], later, *plan.tracks[robot + 1 :])
        changed = replace(plan, tracks=tracks)
        plan = changed if rightofway.check(changed).ok else plan
    return plan


@law(any_fleet(), planners, delays)
def test_the_timetable_of_a_plan_is_a_plan_and_nobody_is_later(
    fleet: Scenario, planner: str, delays: list[int]
) -> None:
    plan = late(planned(fleet, planner), delays)
    retimed = build_graph_of_plan(fleet.problem, plan.tracks).build_tracks()
    assert by_both_judges(replace(plan, tracks=tuple(retimed))) == (set(), set())
    for before, after in zip(plan.tracks, retimed, strict=True):
        assert np.array_equal(before.vertices, after.vertices)
        assert (after.enter <= before.enter).all()


# A graph of routes alone knows neither resources nor closures; `build_graph` gives it both.
@law(any_fleet(without={"passed", "sizes", "zones", "closures"}), planners, delays)
def test_an_order_kept_at_once_is_the_same_as_right_of_way_given_one_by_one(
    fleet: Scenario, planner: str, delays: list[int]
) -> None:
    at_once = build_graph_of_plan(fleet.problem, late(planned(fleet, planner), delays).tracks)
    one_by_one = PrecedenceGraph(at_once.routes, rules=fleet.problem.booking_rules)
    rights = at_once._kernel.rights_of_way().tolist()
    for first, second in rights:
        assert one_by_one.give_way(first, second)
    assert at_once.build_tracks() == one_by_one.build_tracks()
    assert at_once.count_conflicts() == one_by_one.count_conflicts()
    for first, second in rights[:3]:
        assert at_once.take_back(first, second)
        assert one_by_one.take_back(first, second)
        assert at_once.build_tracks() == one_by_one.build_tracks()
        assert at_once.count_conflicts() == one_by_one.count_conflicts()
