"""Right of way by priority: who goes first, and how orders are tried."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import Any

import pytest

import rightofway
from rightofway.errors import GaveUp
from rightofway.model import Plan, Rules, Scenario, Status, Track
from rightofway.planners import Draft
from rightofway.repair.routing import clear_routes, find_shortest_routes
from rightofway.search import Distances
from tests.builders.fleets import grid_fleet, random_fleet

DOOR = grid_fleet(["...", "@.@", "..."], [("N0", "N6"), ("N2", "N8")])
SEARCHES = ["random-priority", "priority-search"]


def planned(scenario: Scenario, planner: str, *, seed: int = 0, **options: Any) -> Plan:
    return rightofway.solve(scenario, planner, time_limit=60, seed=seed, options=options)


def flowtime(*args: Any, **options: Any) -> int:
    return rightofway.measure(planned(*args, **options)).flowtime


def ends(plan: Plan) -> list[int]:
    return [int(track.enter[-1]) for track in plan.tracks]


def crowd(seed: int) -> Scenario:
    return random_fleet(seed, size=10, robots=10)


@pytest.mark.parametrize("waits", [0, 1])
def test_the_robot_of_higher_priority_goes_first(waits: int) -> None:
    """The door, alone 9 ticks each; both come to N1 at tick 1, and one of them follows."""
    scenario = grid_fleet(["...", "@.@", "..."], [("N0", "N6"), ("N2", "N8")][:: 1 - 2 * waits])
    plan = planned(scenario, "fixed-priority")
    assert ends(plan) == [9, 10]
    first = plan.run.decisions[0]
    assert (first.tick, first.kind, first.waits, first.ticks) == (1, "following", 1, 1)
    assert (first.level, first.conflicts_left, first.completion_sums) == (
        "priority", (None, None), None,
    )  # fmt: skip


def test_priority_counts_more_than_work_achieved_sooner() -> None:
    """Both work at N7, behind the door; R1 for ten ticks, and whoever is second waits outside."""
    scenario = grid_fleet(["...", "@.@", "@.@"], [("N0", "N7"), ("N2", "N7")], work=[10, 0])
    # Alone 17 and 7 ticks. Who leaves N1 at tick t lets the other one in: 6 ticks more, and work.
    assert ends(planned(scenario, "fixed-priority")) == [17, 23]
    assert ends(planned(scenario, "two-level")) == [23, 7]


def test_where_the_higher_one_cannot_go_first_the_other_one_does() -> None:
    """R2 stands at N1, in front of R1, from the start; a cell takes it two ticks."""
    scenario = grid_fleet(
        ["...."],
        [("N0", "N2"), ("N1", "N3")],
        speeds=[Fraction(1), Fraction(1, 2)],
        rules=Rules(ends="none"),
    )
    plan = planned(scenario, "fixed-priority")
    assert [track.enter.tolist() for track in plan.tracks] == [[0, 2, 4], [0, 2, 4]]
    assert [(one.level, one.waits) for one in plan.run.decisions] == [("only", 0)]


def test_where_no_waiting_helps_one_is_sent_another_way() -> None:
    """R1 works where R2 lives, in a corridor with a bay."""
    plan = planned(grid_fleet([".....", "@@@.@"], [("N0", "N4"), ("N4", "N2")]), "fixed-priority")
    assert plan.run.status == Status("re-routed", robots=["R2"])


def test_routes_keep_clear_of_others_or_are_the_shortest() -> None:
    scenario = random_fleet(1, size=16, robots=10)
    distances = Distances(scenario.roadmap)
    routes = {"clear": clear_routes, "shortest": find_shortest_routes}
    driven = {}
    for name, choose in routes.items():
        plan = planned(scenario, "fixed-priority", routes=name)
        assert plan.run.status == Status("waits only")
        driven[name] = [tuple(track.vertices.tolist()) for track in plan.tracks]
        assert driven[name] == [route.vertices for route in choose(scenario, distances)]
    assert driven["clear"] != driven["shortest"]


@pytest.mark.parametrize("planner", SEARCHES)
def test_more_orders_are_never_worse_and_sometimes_better(planner: str) -> None:
    option = {"random-priority": "restarts", "priority-search": "rounds"}[planner]
    few = [flowtime(crowd(seed), planner, **{option: 1}) for seed in range(4)]
    many = [flowtime(crowd(seed), planner, **{option: 9}) for seed in range(4)]
    assert all(more <= less for less, more in zip(few, many, strict=True))
    assert sum(many) < sum(few)


def test_the_search_is_never_worse_than_the_order_that_it_starts_from() -> None:
    for seed in range(4):
        fixed = flowtime(crowd(seed), "fixed-priority")
        assert flowtime(crowd(seed), "priority-search", rounds=1, restarts=1) == fixed
        assert flowtime(crowd(seed), "priority-search") <= fixed


def test_another_seed_draws_other_orders() -> None:
    assert len({flowtime(crowd(0), "random-priority", seed=s, restarts=1) for s in range(4)}) > 1


@pytest.mark.parametrize(
    ("planner", "options", "tried"),
    [
        ("random-priority", {"restarts": 3}, 3),
        ("random-priority", {"restarts": 1}, 1),
        ("priority-search", {"restarts": 3, "rounds": 4}, 12),
    ],
)
def test_the_status_says_how_many_orders_were_tried(
    planner: str, options: dict[str, int], tried: int
) -> None:
    status = planned(DOOR, planner, **options).run.status
    assert status == Status("best of orders", number=tried, status=Status("waits only"))


class Costs:
    """Stands in for planning: each order gets the next cost, until time is over."""

    def __init__(self, costs: Sequence[int]) -> None:
        self.left = list(costs)
        self.orders: list[Sequence[int]] = []

    def rule_of(self, order: Sequence[int]) -> Sequence[int]:
        self.orders.append(order)
        return order

    def plan(self, request: rightofway.planners.PlanRequest, *_: object) -> Draft:
        if not self.left:
            raise GaveUp("time ran out")
        cost = self.left.pop(0)
        tracks = [Track.of([0], [0]) for _ in request.scenario.robots[1:]]
        return Draft(tracks=(Track.of([0], [cost]), *tracks), status=f"cost {cost}")


Pretend = Callable[[Sequence[int]], Costs]


@pytest.fixture
def pretend(monkeypatch: pytest.MonkeyPatch) -> Pretend:
    def make(costs: Sequence[int]) -> Costs:
        stand_in = Costs(costs)
        monkeypatch.setattr("rightofway.planners.priorities.plan_by_priority", stand_in.rule_of)
        monkeypatch.setattr("rightofway.planners.priorities.plan_by_rule", stand_in.plan)
        return stand_in

    return make


def drafted(planner: str, **options: int) -> Draft:
    spec = rightofway.planners.find(planner)
    request = rightofway.planners.PlanRequest(
        scenario=random_fleet(0), options=spec.settle(options)
    )
    return spec.load()(request)


def moved(one: Sequence[int], other: Sequence[int]) -> int:
    """Return how many robots have another place in the second order."""
    assert sorted(one) == sorted(other) == list(range(8))
    return sum(a != b for a, b in zip(one, other, strict=True))


@pytest.mark.parametrize(
    ("costs", "start"),
    [([5, 5, 9], 1), ([5, 4, 9], 1), ([5, 6, 9], 0)],
    ids=["as good", "better", "worse"],
)
def test_the_climb_goes_on_from_what_is_not_worse(
    pretend: Pretend, costs: list[int], start: int
) -> None:
    orders = pretend(costs)
    drafted("priority-search", restarts=1, rounds=3)
    assert list(orders.orders[0]) == list(range(8))
    assert moved(orders.orders[0], orders.orders[1]) == 2
    assert moved(orders.orders[start], orders.orders[2]) == 2


def test_a_climb_ends_and_another_one_starts_anywhere(pretend: Pretend) -> None:
    orders = pretend([5, 4, 7, 6])
    assert drafted("priority-search", restarts=2, rounds=2).status == Status(
        "best of orders", number=4, status="cost 4"
    )
    assert moved(orders.orders[1], orders.orders[2]) > 2
    assert moved(orders.orders[2], orders.orders[3]) == 2


@pytest.mark.parametrize("planner", SEARCHES)
def test_when_time_is_over_the_best_so_far_is_handed_out(pretend: Pretend, planner: str) -> None:
    pretend([7, 5, 6])
    assert drafted(planner).status == Status("best of orders", number=3, status="cost 5")


@pytest.mark.parametrize("planner", SEARCHES)
def test_without_a_plan_when_time_is_over_it_gives_up(pretend: Pretend, planner: str) -> None:
    pretend([])
    with pytest.raises(GaveUp):
        drafted(planner)


@pytest.mark.parametrize("planner", SEARCHES)
def test_a_search_without_end_is_ended_by_the_time_limit(planner: str) -> None:
    scenario = random_fleet(3, size=16, robots=20)
    plan = rightofway.solve(scenario, planner, 0.5, options={"restarts": 10**6})
    assert rightofway.check(plan).ok
    assert plan.run.seconds is not None
    assert plan.run.seconds < 5
