"""What the planners on the fleet search do beyond what every planner owes."""

from __future__ import annotations

import time
from dataclasses import replace
from fractions import Fraction

import pytest

import rightofway
from rightofway.errors import GaveUp
from rightofway.facts import Fact
from rightofway.metrics import measure
from rightofway.model import Plan, PlannerRun, Rules, Scenario, Status, Track, compute_cost
from rightofway.planners import Deadline, PlanRequest, PrioritizedOptions, rivals
from rightofway.planners.lacam import plan_fleet
from rightofway.planners.lns import lns
from rightofway.planners.prioritized import prioritized
from rightofway.search import FleetSearch
from tests.builders.fleets import grid_fleet, random_fleet

CROWDED = random_fleet(5, size=10, robots=30, rules=Rules(occupancy="both"))


def test_a_given_plan_is_where_it_starts_and_what_comes_out_is_no_worse() -> None:
    given = rightofway.solve(CROWDED, "two-level")
    request = PlanRequest(scenario=CROWDED, options={"iterations": 40}, start=given.tracks)
    draft = lns(request)
    better = Plan(scenario=CROWDED, tracks=draft.tracks, run=PlannerRun(name="lns"))
    assert rightofway.check(better).ok
    assert measure(better).flowtime < measure(given).flowtime
    assert draft.status == Status("improved", neighbourhoods=40, status=Status("given"))


def test_time_that_ends_while_a_rival_is_prepared_leaves_the_first_plan(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def run_out_of_time(_: Scenario) -> Scenario:
        raise GaveUp(Fact("time over", doing=Fact("planning in turn")))

    monkeypatch.setattr(rivals, "make_paced", run_out_of_time)
    monkeypatch.setattr(FleetSearch, "compete", lambda *_, **__: False)
    plan = rightofway.solve(CROWDED, "lns", time_limit=60)
    assert rightofway.check(plan).faults == ()


def test_more_iterations_are_never_worse() -> None:
    flowtimes = [
        measure(rightofway.solve(CROWDED, "lns", options={"iterations": n})).flowtime
        for n in (1, 30, 300)
    ]
    assert flowtimes == sorted(flowtimes, reverse=True)
    assert flowtimes[0] > flowtimes[-1]


def test_it_stops_where_nothing_can_be_better_and_says_so() -> None:
    """Two robots on rows of their own: both are as fast as alone."""
    fleet = grid_fleet(["...", "..."], [("N0", "N2"), ("N3", "N5")], rules=Rules(ends="none"))
    began = time.perf_counter()
    plan = rightofway.solve(fleet, "lns", time_limit=None)
    assert plan.run.status is not None
    assert plan.run.status.kind == "as fast as alone"
    assert time.perf_counter() - began < 5


@pytest.mark.parametrize("weight", ["1/5", "5"])
@pytest.mark.parametrize("planner", ["lns", "auto"])
def test_the_robot_with_the_larger_weight_goes_first(planner: str, weight: str) -> None:
    """Two robots cross at a vertex at one tick, so either may wait."""
    weights = {"R1": Fraction(1), "R2": Fraction(weight)}
    trips = [("N1", "N7"), ("N3", "N5")]
    fleet = grid_fleet(["@.@", "...", "@.@"], trips, rules=Rules(ends="none"))
    robots = tuple(replace(robot, weight=weights[robot.name]) for robot in fleet.robots)
    plan = rightofway.solve(replace(fleet, robots=robots), planner, options={"iterations": 50})
    first = max(weights, key=lambda name: weights[name])
    late = min(weights, key=lambda name: weights[name])
    assert (plan[first].completion, plan[late].completion) == (2, 3)


def test_weights_of_one_ratio_give_one_plan() -> None:
    def planned(*weights: Fraction) -> list[list[int]]:
        robots = [replace(robot, weight=weights[k % 2]) for k, robot in enumerate(CROWDED.robots)]
        fleet = replace(CROWDED, robots=tuple(robots))
        plan = rightofway.solve(fleet, "lns", options={"iterations": 30})
        return [track.enter.tolist() for track in plan.tracks]

    assert planned(Fraction(1), Fraction(3)) == planned(Fraction(1, 3), Fraction(1))
    assert planned(Fraction(7), Fraction(7)) == planned(Fraction(1), Fraction(1))


def test_the_search_sums_costs_by_weights() -> None:
    """The cost that the native core keeps up to date is the cost of its tracks."""
    robots = tuple(
        replace(robot, weight=Fraction(1 + k % 3)) for k, robot in enumerate(CROWDED.robots)
    )
    fleet = replace(CROWDED, robots=robots)
    search = FleetSearch(fleet.problem)
    assert search.prioritize(range(len(robots)), searches=10_000, time_limit=None)
    before = search.cost
    assert before == compute_cost(fleet, search.list_tracks())
    search.improve(40, patience=1000)
    assert search.cost == compute_cost(fleet, search.list_tracks()) < before


def test_progress_tells_flowtime_gap_and_rate() -> None:
    told: list[Fact | str] = []
    rightofway.solve(CROWDED, "lns", options={"iterations": 20}, report=told.append)
    begin, *facts, judged = [fact for fact in told if isinstance(fact, Fact)]
    assert (begin.kind, judged.kind) == ("planning begins", "plan judged")
    assert len(facts) + 2 == len(told) > 2
    assert {fact.kind for fact in facts} == {"value and gap reached"}
    assert all(fact.values["objective"] == "flowtime" for fact in facts)
    assert all(fact.values["gap"] >= 0 and fact.values["rate"] > 0 for fact in facts)


def test_it_stops_when_time_is_up() -> None:
    began = time.perf_counter()
    rightofway.solve(random_fleet(2, size=30, robots=150), "lns", time_limit=1.5)
    assert time.perf_counter() - began < 5


@pytest.mark.parametrize("order", PrioritizedOptions.described()[0].choices)
def test_every_order_gives_a_sound_plan(order: str) -> None:
    plan = rightofway.solve(CROWDED, "prioritized", options={"order": order})
    assert rightofway.check(plan).ok


def test_robots_that_find_no_way_at_their_own_speeds_find_one_at_one_pace(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """At own speeds it gives up at once; the order of visits at one pace is as good for all."""
    monkeypatch.setattr("rightofway.planners.prioritized.SEARCHES", 0)
    for occupancy in ("one", "both"):
        rules = Rules(occupancy=occupancy, headway=Fraction(1, 2))
        fleet = random_fleet(8, size=9, robots=14, rules=rules)
        draft = prioritized(PlanRequest(scenario=fleet, options={"order": "shortest"}))
        plan = Plan(scenario=fleet, tracks=draft.tracks, run=PlannerRun(name="prioritized"))
        assert rightofway.check(plan).ok
        assert draft.status == Status("in turn at one pace")


def test_an_order_found_at_one_pace_is_kept_where_planning_in_turn_fails(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Planning in turn at own speeds may search for no robot; 30 robots fill a third of a grid."""
    monkeypatch.setattr("rightofway.planners.rivals.SEARCHES", 0)
    request = PlanRequest(scenario=CROWDED, options={"iterations": 0})
    together = plan_fleet(request)
    drafts = [lns(request) for _ in range(2)]
    assert drafts[0].tracks == drafts[1].tracks
    assert str(drafts[0].status).endswith(
        "(first plan: one after another at one pace, each then at its own)"
    )
    assert compute_cost(CROWDED, drafts[0].tracks) < compute_cost(CROWDED, together.tracks)
    plan = Plan(scenario=CROWDED, tracks=drafts[0].tracks, run=PlannerRun(name="lns"))
    assert rightofway.check(plan).ok


def test_without_time_it_gives_up() -> None:
    many = random_fleet(1, size=64, robots=300)
    deadline = Deadline.after(0.0)
    with pytest.raises(GaveUp):
        lns(PlanRequest(scenario=many, options={"iterations": 0}, deadline=deadline))


def test_robots_that_may_stay_at_home_are_sent_back_there() -> None:
    """Both have no way to go, so the lower bound is 0, and the plan given leads them round."""
    fleet = grid_fleet(["..", ".."], [("N0", "N0"), ("N3", "N3")])
    scenario = Scenario(
        roadmap=fleet.roadmap, robots=fleet.robots, rules=Rules(turn=Fraction(0), ends="none")
    )
    tracks = (Track.of([0, 1, 0], [0, 1, 2]), Track.of([3, 2, 3], [0, 1, 2]))
    plan = Plan(scenario=scenario, tracks=tracks, run=PlannerRun())
    assert rightofway.improve(plan).flowtime == 0
