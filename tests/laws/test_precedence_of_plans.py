"""Any plan converts to the precedence graph, and its timetable is a plan that is never later."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

import rightofway
from rightofway.model import Plan, PlannerRun, Rules, Scenario, Track
from rightofway.precedence import PrecedenceGraph, graph_of
from rightofway.search import Bookings, Distances, earliest_track
from tests.builders.fleets import random_fleet


@st.composite
def fleets(draw: st.DrawFn) -> Scenario:
    rules = Rules(
        occupancy=draw(st.sampled_from(["one", "both"])),
        headway=Fraction(draw(st.integers(0, 1))),
        laps=draw(st.integers(1, 2)),
    )
    return random_fleet(draw(st.integers(0, 10_000)), size=7, robots=4, rules=rules)


def late(scenario: Scenario, delays: list[int]) -> list[Track]:
    """Return tracks found one after the other, each then started later by its delay if it can."""
    bookings = Bookings(scenario.problem)
    tracks: list[Track] = []
    for robot in range(len(scenario.robots)):
        track = earliest_track(robot, bookings, Distances(scenario.roadmap))
        if track is None:
            return []
        later = Track.of(track.vertices.tolist(), [0, *(track.enter[1:] + delays[robot]).tolist()])
        track = track if bookings.in_the_way(robot, later) else later
        bookings.add(robot, track)
        tracks.append(track)
    return tracks


@settings(max_examples=150, deadline=None, derandomize=True)
@given(fleets(), st.lists(st.integers(0, 9), min_size=4, max_size=4))
def test_the_timetable_of_a_plan_is_a_plan_and_nobody_is_later(
    scenario: Scenario, delays: list[int]
) -> None:
    tracks = late(scenario, delays)
    if not tracks or not rightofway.check(_plan(scenario, tracks)).ok:
        return  # not every order finds tracks, and a late start may bring about a swap
    retimed = graph_of(scenario, tracks).tracks()
    assert rightofway.check(_plan(scenario, retimed)).faults == ()
    for before, after in zip(tracks, retimed, strict=True):
        assert np.array_equal(before.vertices, after.vertices)
        assert (after.enter <= before.enter).all()


@settings(max_examples=100, deadline=None, derandomize=True)
@given(fleets(), st.lists(st.integers(0, 9), min_size=4, max_size=4))
def test_an_order_kept_at_once_is_the_same_as_right_of_way_given_one_by_one(
    scenario: Scenario, delays: list[int]
) -> None:
    tracks = late(scenario, delays)
    if not tracks or not rightofway.check(_plan(scenario, tracks)).ok:
        return
    at_once = graph_of(scenario, tracks)
    one_by_one = PrecedenceGraph(
        at_once.routes,
        headway=scenario.problem.headway,
        books_ahead=scenario.rules.occupancy == "both",
    )
    rights = at_once._kernel.rights_of_way().tolist()
    for first, second in rights:
        assert one_by_one.give_way(first, second)
    assert at_once.tracks() == one_by_one.tracks()
    assert at_once.conflicts_left() == one_by_one.conflicts_left()
    for first, second in rights[:3]:
        assert at_once.take_back(first, second)
        assert one_by_one.take_back(first, second)
        assert at_once.tracks() == one_by_one.tracks()
        assert at_once.conflicts_left() == one_by_one.conflicts_left()


def _plan(scenario: Scenario, tracks: list[Track]) -> Plan:
    return Plan(scenario=scenario, tracks=tuple(tracks), run=PlannerRun(name="late"))
