"""Plans of the fleet search keep the rules, get better only, and depend on nothing but the seed."""

from __future__ import annotations

import random
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import strategies as st

from rightofway.check import check
from rightofway.metrics.alone import compute_alone_completions
from rightofway.model import Plan, PlannerRun, Rules, Scenario, Tick, Track, compute_completions
from rightofway.precedence import build_graph_of_plan
from rightofway.search import FleetSearch
from rightofway.site import make_grid_roadmap
from tests.builders.fleets import grid_fleet, random_fleet
from tests.builders.laws import law, once

RULES = st.builds(
    Rules,
    occupancy=st.sampled_from(["one", "both"]),
    headway=st.sampled_from([0, 1]),
    ends=st.sampled_from(["home", "none"]),
)
FLEETS = st.builds(
    random_fleet,
    st.integers(0, 10**6),
    size=st.integers(6, 12),
    robots=st.integers(1, 10),
    walls=st.sampled_from([0.0, 0.1]),
    rules=RULES,
)


def search_of(scenario: Scenario, *, seed: int = 0, threads: int = 1) -> FleetSearch:
    return FleetSearch(scenario.problem, seed=seed, threads=threads)


def judged(scenario: Scenario, tracks: tuple[Track, ...]) -> bool:
    return check(Plan(scenario=scenario, tracks=tracks, run=PlannerRun(name="any"))).ok


RETURNS_TO_ITS_END = random_fleet(
    7, size=7, robots=8, walls=0.1, rules=Rules(occupancy="one", ends="none")
)
"""R7 stands at its end for longer than its work, makes room for another robot and comes back."""


@law(FLEETS, st.integers(0, 99))
@once(scenario=RETURNS_TO_ITS_END, seed=0)
def test_plans_are_sound_better_each_time_and_the_same_on_any_number_of_threads(
    scenario: Scenario, seed: int
) -> None:
    order = range(len(scenario.robots))
    searches = [search_of(scenario, seed=seed, threads=threads) for threads in (1, 2, 3)]
    for search in searches:
        if not search.prioritize(order, searches=500, time_limit=None):
            return
    first = searches[0].list_tracks()
    assert judged(scenario, first)
    assert searches[0].cost == sum(compute_completions(scenario, first))
    for search in searches:
        before = search.cost
        search.improve(3000, patience=10**9)
        assert search.cost <= before
    better = searches[0].list_tracks()
    assert judged(scenario, better)
    assert searches[0].cost == sum(compute_completions(scenario, better))
    assert all(search.list_tracks() == better for search in searches)


@law(FLEETS, st.integers(0, 99))
def test_a_plan_beside_the_present_one_is_taken_over_only_if_it_is_better(
    scenario: Scenario, seed: int
) -> None:
    order = list(range(len(scenario.robots)))
    search, other = search_of(scenario, seed=seed), search_of(scenario, seed=seed)
    if not search.prioritize(order, searches=500, time_limit=None):
        return
    backwards = order[::-1]
    alone = other.prioritize(backwards, searches=500, time_limit=None)
    for attempt in (search.compete, search.hurry):
        before = search.cost
        attempt(backwards, searches=500, time_limit=None)
        assert search.cost <= before
        assert judged(scenario, search.list_tracks())
        assert not alone or search.cost <= other.cost


@law(FLEETS, st.integers(1, 9))
def test_an_attempt_in_slices_ends_with_the_plan_of_one_call(
    scenario: Scenario, turns: int
) -> None:
    order = list(range(len(scenario.robots)))
    whole, sliced = search_of(scenario, threads=1), search_of(scenario, threads=1)
    for search in (whole, sliced):
        if not search.prioritize(order, searches=500, time_limit=None):
            return
    whole.compete(order[::-1], searches=500, time_limit=None)
    for turn in range(1, turns + 1):
        sliced.compete(order[::-1], searches=500 * turn // turns, time_limit=None)
        sliced.improve(3, patience=10**9)
    assert sliced.cost <= whole.cost


@law(FLEETS)
def test_the_least_completions_are_those_of_the_metrics(scenario: Scenario) -> None:
    assert tuple(search_of(scenario).compute_alone()) == compute_alone_completions(scenario)


@law(FLEETS)
def test_tracks_that_are_taken_over_come_back_as_they_are(scenario: Scenario) -> None:
    one, other = search_of(scenario), search_of(scenario)
    if one.prioritize(range(len(scenario.robots)), searches=500, time_limit=None):
        other.start(one.list_tracks())
        assert other.list_tracks() == one.list_tracks()
        assert other.cost == one.cost


@law(FLEETS, st.integers(0, 99))
def test_retiming_gives_the_timetable_of_the_precedence_graph(
    scenario: Scenario, seed: int
) -> None:
    search = search_of(scenario, seed=seed)
    if search.prioritize(range(len(scenario.robots)), searches=500, time_limit=None):
        search.improve(100, patience=10**9)
        before = search.list_tracks()
        search.retime()
        assert search.list_tracks() == tuple(
            build_graph_of_plan(scenario.problem, before).build_tracks()
        )
        assert search.cost == sum(compute_completions(scenario, search.list_tracks()))


def test_tracks_that_break_the_rules_are_not_taken_over() -> None:
    scenario = random_fleet(3, size=6, robots=2)
    search = search_of(scenario)
    stay = tuple(Track.of([itinerary.home], [0]) for itinerary in scenario.problem.itineraries)
    with pytest.raises(ValueError, match="robot: 0 has a track that breaks the rules"):
        search.start(stay)


def test_a_fleet_that_cannot_do_better_ends_at_once() -> None:
    scenario = random_fleet(3, robots=1)
    search = search_of(scenario)
    search.prioritize([0], searches=1, time_limit=None)
    assert search.cost == search.compute_alone().sum()
    assert search.improve(10**9, patience=10**9) <= 32


AISLES = [("." + "@@@@@@@@@@." * 4) if row % 2 else "." * 45 for row in range(17)]


@pytest.mark.parametrize("seed", [21, 89, 123])
def test_neighbours_do_not_take_away_each_others_tracks_for_ever(seed: int) -> None:
    """Who has to pass whose home once went unremembered in these fleets."""
    draw = random.Random(seed)  # noqa: S311 (no secret depends on it)
    roadmap = make_grid_roadmap(AISLES)
    homes, targets = (draw.sample(range(roadmap.n_vertices), 60) for _ in range(2))
    scenario = grid_fleet(
        AISLES,
        [(roadmap.name(h), roadmap.name(t)) for h, t in zip(homes, targets, strict=True)],
        rules=Rules(occupancy="both"),
        speeds=[Fraction(1, ticks) for ticks in (1, 2, 3, 5)],
    )
    search = search_of(scenario)
    order = search.compute_alone().argsort(kind="stable").tolist()
    assert search.prioritize(order, searches=20 * len(order), time_limit=None)
    assert judged(scenario, search.list_tracks())


@law(FLEETS, st.integers(0, 10**6))
def test_tracks_that_are_taken_over_never_overlap_and_serve_their_stages(
    scenario: Scenario, seed: int
) -> None:
    rng, order = random.Random(seed), range(len(scenario.robots))  # noqa: S311
    search = search_of(scenario)
    if not search.prioritize(order, searches=500, time_limit=None):
        return
    # Some robots are to be planned anew, and some have stood still so far.
    old = [
        Track.of(track.vertices[:1].tolist(), [0]) if rng.random() < 1 / 4 else track
        for track in search.list_tracks()
    ]
    chosen = [robot for robot in order if rng.random() < 1 / 2]
    left = search.take_over(old, chosen, time_limit=None)
    tracks = search.list_known_tracks()
    assert left == tuple(robot for robot in order if tracks[robot] is None)
    again = search_of(scenario)
    again.start(tracks)  # refuses tracks that miss stages or overlap
    if not left:
        assert judged(scenario, search.list_tracks())


BEHIND_HORIZON = {"stop missed", "wrong end"}
"""Faults of tracks that are cut: robots do not come to their last stops, or home."""


@law(FLEETS, st.integers(0, 99), st.integers(0, 12))
def test_tracks_cut_at_the_horizon_exclude_each_other_permanently(
    scenario: Scenario, seed: int, horizon: int
) -> None:
    search = FleetSearch(scenario.problem, seed=seed, threads=1, horizon=Tick(horizon))
    assert search.prioritize(range(len(scenario.robots)), searches=500, time_limit=None)
    search.improve(50, patience=50)
    search.retime()
    tracks = list[Track]()
    for track in search.list_tracks():
        n_visits = int(np.searchsorted(track.enter, horizon, side="right"))
        tracks.append(Track(vertices=track.vertices[:n_visits], enter=track.enter[:n_visits]))
    judged = check(Plan(scenario=scenario, tracks=tuple(tracks), run=PlannerRun(name="any")))
    assert BEHIND_HORIZON.issuperset(judged.counts), str(judged)


@law(FLEETS, st.integers(0, 12))
def test_with_a_horizon_every_robot_finds_a_track_around_the_others(
    scenario: Scenario, horizon: int
) -> None:
    # All robots stand at their homes: each one can wait there until the horizon.
    homes = [Track.of([itinerary.home], [0]) for itinerary in scenario.problem.itineraries]
    search = FleetSearch(scenario.problem, threads=1, horizon=Tick(horizon))
    assert search.take_over(homes, range(len(homes)), time_limit=None) == ()
