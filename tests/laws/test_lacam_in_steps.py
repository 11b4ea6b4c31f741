"""Where a fleet moves in steps, LaCAM finds steps wherever there are any, and else proves it."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import strategies as st
from numpy.typing import NDArray

import rightofway
from rightofway.errors import NoPlanExists
from rightofway.io import parse_scenario
from rightofway.model import Plan, PlannerRun, Rules, Scenario, Track
from rightofway.precedence import build_timetable
from rightofway.search import plan_by_lacam
from tests.builders.fleets import grid_fleet
from tests.builders.laws import law
from tests.oracles.all_steps import can_get_through, is_step

GRIDS = (["...", "@.@"], ["..", ".."], [".....", "@@.@@"], ["...", ".@.", "..."], ["...."])


@st.composite
def fleets(draw: st.DrawFn) -> Scenario:
    """Draw up to four robots on a grid that is nearly full."""
    grid = draw(st.sampled_from(GRIDS))
    free = [f"N{k}" for k, cell in enumerate("".join(grid)) if cell == "."]
    homes = draw(st.lists(st.sampled_from(free), min_size=1, max_size=4, unique=True))
    targets = draw(st.permutations(free))[: len(homes)]
    rules = Rules(
        ends=draw(st.sampled_from(["home", "none"])),
        occupancy=draw(st.sampled_from(["one", "both"])),
    )
    return grid_fleet(grid, list(zip(homes, targets, strict=True)), rules=rules)


def places_after_each_step(tracks: list[Track] | None) -> NDArray[np.int32]:
    """Return where all robots are after each step, the start included; shape (T, R)."""
    assert tracks is not None, "the search was not limited"
    ticks = np.arange(max(track.enter[-1] for track in tracks) + 1)
    at = [track.vertices[np.searchsorted(track.enter, ticks, "right") - 1] for track in tracks]
    return np.stack(at, axis=1)


def test_a_robot_goes_round_an_edge_that_is_barred_for_its_type() -> None:
    """Two edges instead of one for R1."""
    scenario = parse_scenario(
        {
            "format": "rightofway-scenario/1",
            "map": {
                "roadmap": {
                    "vertices": {"a": [0, 0], "b": [1, 1], "c": [2, 0]},
                    "edges": [
                        {"from": "a", "to": "c", "length": 2, "barred": ["wide"]},
                        {"from": "a", "to": "b", "length": 2},
                        {"from": "b", "to": "c", "length": 2},
                    ],
                }
            },
            "robots": [
                {"name": "R1", "home": "a", "target": "c", "type": "wide", "return": "none"},
            ],
        }
    )
    for seed in range(20):
        tracks = plan_by_lacam(scenario.problem.as_steps(), seed=seed, spreads=False)
        assert tracks is not None
        names = [scenario.roadmap.name(vertex) for vertex in tracks[0].vertices.tolist()]
        assert names == ["a", "b", "c"]


@pytest.mark.parametrize("barred", [["wide"], []])
def test_a_robot_is_not_pushed_along_an_edge_that_is_barred_for_its_type(barred: list[str]) -> None:
    """R1 wants the place of R2, which can only make room at c."""
    scenario = parse_scenario(
        {
            "format": "rightofway-scenario/1",
            "map": {
                "roadmap": {
                    "vertices": {"a": [0, 0], "b": [2, 0], "c": [4, 0]},
                    "edges": [
                        {"from": "a", "to": "b", "length": 2},
                        {"from": "b", "to": "c", "length": 2, "barred": barred},
                    ],
                }
            },
            "robots": [
                {"name": "R1", "home": "a", "target": "b", "return": "none"},
                {"name": "R2", "home": "b", "target": "a", "type": "wide", "return": "none"},
            ],
        }
    )
    problem = scenario.problem.as_steps()
    if barred:
        with pytest.raises(NoPlanExists):
            plan_by_lacam(problem, spreads=False, ends_anywhere={1})
        return
    tracks = plan_by_lacam(problem, spreads=False, ends_anywhere={1})
    assert tracks is not None
    assert [scenario.roadmap.name(int(track.vertices[-1])) for track in tracks] == ["b", "c"]


@law(fleets(), st.integers(0, 3), st.booleans())
def test_steps_are_found_exactly_where_there_are_any(
    scenario: Scenario, seed: int, spreads: bool
) -> None:
    may_rotate = scenario.rules.occupancy == "one"
    try:
        tracks = plan_by_lacam(scenario.problem.as_steps(), seed=seed, spreads=spreads)
    except NoPlanExists:
        assert not can_get_through(scenario, may_rotate=may_rotate)
        return
    assert can_get_through(scenario, may_rotate=may_rotate)
    steps = places_after_each_step(tracks)
    for at, after in zip(steps[:-1].tolist(), steps[1:].tolist(), strict=True):
        assert is_step(scenario, at, after, may_rotate=may_rotate)


@law(fleets())
def test_the_timetable_of_steps_is_a_plan_without_fault(scenario: Scenario) -> None:
    try:
        in_steps = plan_by_lacam(scenario.problem.as_steps(), spreads=False)
    except NoPlanExists:
        return
    assert in_steps is not None
    tracks = build_timetable(scenario.problem, in_steps)
    assert tracks is not None
    plan = Plan(scenario=scenario, tracks=tuple(tracks), run=PlannerRun(name="joint"))
    assert rightofway.check(plan).faults == ()


@law(fleets(), st.integers(0, 3))
def test_robots_that_may_end_anywhere_only_make_it_easier(scenario: Scenario, robot: int) -> None:
    """One robot need not end at its last stage; the others do, and it passes its other stages."""
    free = robot % len(scenario.robots)
    stages = [one.stages for one in scenario.problem.itineraries]
    try:
        tracks = plan_by_lacam(scenario.problem.as_steps(), spreads=False, ends_anywhere={free})
    except NoPlanExists:
        assert not can_get_through(scenario, may_rotate=scenario.rules.occupancy == "one")
        return
    steps = places_after_each_step(tracks)
    ends = steps[-1].tolist()
    assert all(ends[k] == own[-1].vertex for k, own in enumerate(stages) if k != free)
    seen = steps[:, free].tolist()
    assert all(stage.vertex in seen for stage in stages[free][:-1])


def test_a_robot_that_may_end_anywhere_gets_out_of_the_way() -> None:
    """R1 and R2 cannot change places in a corridor; R2 can make room for R1 at its end, N3."""
    trips = [("N0", "N2"), ("N2", "N0")]
    problem = grid_fleet(["...."], trips, rules=Rules(ends="none")).problem.as_steps()
    with pytest.raises(NoPlanExists):
        plan_by_lacam(problem)
    tracks = plan_by_lacam(problem, ends_anywhere={1})
    assert tracks is not None
    assert [int(track.vertices[-1]) for track in tracks] == [2, 3]


def test_a_search_that_ends_after_some_steps_proves_nothing() -> None:
    """Two robots change places in a corridor: impossible, but not proven before all is tried."""
    scenario = grid_fleet(["." * 40], [("N0", "N39"), ("N39", "N0")])
    with pytest.raises(NoPlanExists):
        plan_by_lacam(scenario.problem.as_steps())
    assert plan_by_lacam(scenario.problem.as_steps(), most_effort=1) is None
