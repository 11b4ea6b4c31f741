"""Plans of fleets whose stages have times keep all rules, and get better only."""

from __future__ import annotations

from copy import copy
from dataclasses import replace
from itertools import pairwise

import numpy as np
from hypothesis import strategies as st

from rightofway.check import check
from rightofway.errors import GaveUp, NoPlanExists
from rightofway.model import Plan, PlannerRun, Scenario, Track, find_stays
from rightofway.model.stays import compute_drives
from rightofway.planners.lns import lns
from rightofway.planners.prioritized import prioritized
from rightofway.repair.plan_request import PlanRequest
from tests.builders.any_fleet import any_fleet
from tests.builders.laws import law, leave
from tests.builders.timed import draw_arcs, draw_times

fleets = any_fleet(robots=(1, 4), without={"laps"})


def keeps_times(scenario: Scenario, tracks: tuple[Track, ...]) -> None:
    """Check the times of works on tracks, of which visits are long enough for them."""
    stays = find_stays(scenario, tracks)
    for itinerary, stay, track in zip(scenario.problem.itineraries, stays, tracks, strict=True):
        stages = itinerary.stages_to_serve
        assert len(stay.ends) == len(stages)
        assert track.enter[0] == 0
        assert track.vertices[0] == itinerary.home
        if not itinerary.ends_anywhere:
            assert track.vertices[-1] == itinerary.last
        if len(track) > 1:
            assert track.enter[1] - stay.drive[0] - stay.turns[0] >= itinerary.ready
        leave_by = np.append(track.enter[1:], 2**62) - stay.drive - stay.turns
        for number, (stage, visit) in enumerate(zip(stages, stay.serves, strict=True)):
            begin, end = stay.begins[number], stay.ends[number]
            assert track.vertices[visit] == stage.vertex
            assert begin >= max(int(track.enter[visit]), stage.earliest, itinerary.ready)
            assert end == begin + stage.work
            assert stage.latest is None or end <= stage.latest
            is_last = visit == len(track) - 1
            assert is_last or end + stage.turn <= leave_by[visit]
        assert all(end <= begin for end, begin in zip(stay.ends, stay.begins[1:], strict=False))
    for (robot, before), (other, after) in scenario.problem.after:
        assert stays[robot].ends[before] <= stays[other].begins[after]
    assert all((np.diff(track.enter) > 0).all() for track in tracks)
    assert (compute_drives(scenario, tracks) >= 0).all()
    assert all(first != second for track in tracks for first, second in pairwise(track.vertices))


def is_free_of_conflicts(scenario: Scenario, tracks: tuple[Track, ...]) -> bool:
    """Tell whether the judge finds no fault but those of one robot, which know no times."""
    untimed = copy(scenario)
    problem = replace(scenario.problem, work=None, after=())
    object.__setattr__(untimed, "problem", problem)
    report = check(Plan(scenario=untimed, tracks=tracks, run=PlannerRun()))
    return not {*report.counts} - OF_ONE_ROBOT


OF_ONE_ROBOT = {"wrong end", "work cut short", "stop missed", "turn cut short"}


@law(fleets.flatmap(lambda fleet: draw_times(fleet, latest=False, costs=True)), st.integers(0, 99))
def test_plans_keep_times(scenario: Scenario, seed: int) -> None:
    judge(scenario, seed)


@law(
    any_fleet(robots=(2, 4), without={"laps"})
    .flatmap(lambda fleet: draw_times(fleet, latest=False, costs=True))
    .flatmap(draw_arcs),
    st.integers(0, 99),
)
def test_plans_keep_the_order_of_stages_of_several_robots(scenario: Scenario, seed: int) -> None:
    judge(scenario, seed)


def judge(scenario: Scenario, seed: int) -> None:
    request = PlanRequest(
        scenario=scenario, options={"order": "shortest", "iterations": 50}, seed=seed
    )
    try:
        first = prioritized(request)
    except (GaveUp, NoPlanExists):
        leave("no plan was found")
    keeps_times(scenario, first.tracks)
    assert is_free_of_conflicts(scenario, first.tracks)
    better = lns(request)
    keeps_times(scenario, better.tracks)
    assert is_free_of_conflicts(scenario, better.tracks)
    assert request.measure_worth(better.tracks) <= request.measure_worth(first.tracks)
