"""On the routes of a plan nothing beats the proven optimum, and the optimum is a plan itself."""

from __future__ import annotations

from collections import defaultdict
from fractions import Fraction
from itertools import accumulate, combinations, groupby, islice, product
from math import prod
from typing import TYPE_CHECKING

import pytest
from hypothesis import strategies as st

import rightofway
from rightofway.metrics import measure
from rightofway.model import Plan, PlannerRun, Rules, Scenario, Track
from tests.builders.fleets import random_fleet
from tests.builders.laws import law, leave
from tests.builders.small import STRICT
from tests.oracles import precedence
from tests.oracles.fixed_routes import best_on, least_flowtime, routes_of
from tests.oracles.precedence import Right, System

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from rightofway.model import Route

MOST_ORDERS = 128
"""So many ways to order a system's visits are still looked at one by one."""

RULES = (
    Rules(),
    Rules(occupancy="both"),
    Rules(headway=Fraction(1)),
    Rules(occupancy="both", headway=Fraction(1, 2), ends="none"),
    Rules(rotations=False),
)


@st.composite
def routes(draw: st.DrawFn, n_robots: int) -> list[tuple[int, ...]]:
    """Robots cross a few vertices; they begin and end there too, or each at places of its own."""
    n_vertices = draw(st.integers(2, 4))
    begin, end = (draw(st.permutations(range(3 * n_vertices)))[:n_robots] for _ in range(2))
    step = st.integers(1, n_vertices - 1)
    found = []
    for home, last in zip(begin, end, strict=True):
        way = draw(st.lists(step, max_size=4))
        between = [vertex % n_vertices for vertex in accumulate(way, initial=home)][1:]
        found.append(tuple(vertex for vertex, _ in groupby([home, *between, last])))
    return found


@st.composite
def systems(draw: st.DrawFn) -> System:
    """One or both vertices booked while moving, with headway and without."""
    paths = draw(routes(draw(st.integers(2, 4))))
    n_visits = sum(map(len, paths))
    least = st.integers(1, draw(st.sampled_from([1, 4, 9])))
    approach = st.integers(0, draw(st.sampled_from([0, 0, 3])))
    return System(
        routes=tuple(paths),
        least=tuple(draw(st.lists(least, min_size=n_visits, max_size=n_visits))),
        approach=tuple(draw(approach) if k else 0 for path in paths for k in range(len(path))),
        headway=draw(st.sampled_from([0, 0, 2])),
        active=(True,) * len(paths),
    )


def choices(system: System) -> list[list[Right]]:
    """Return, for any two visits that need an order, the rights of way that there can be."""
    pairs = [
        (x, y)
        for x, y in combinations(range(len(system.vertex)), 2)
        if system.vertex[x] == system.vertex[y] and system.robot[x] != system.robot[y]
    ]
    return [
        [
            Right(a, b)
            for a, b in ((x, y), (y, x))
            if not system.is_last(a) and not system.is_first(b)
        ]
        for x, y in pairs
    ]


def flowtimes(
    system: System, orders: Sequence[Sequence[Right]], *, rotations: bool
) -> Iterator[int]:
    """Yield what each order of visits comes to that leads to no conflict."""
    for rights in product(*orders):
        enter = precedence.enters(system, rights)
        if enter is None or precedence.conflicts(system, enter):
            continue
        if rotations or not rotates(system, enter):
            yield sum(tick + system.least[x] for x, tick in enumerate(enter) if system.is_last(x))


def rotates(system: System, enter: Sequence[int]) -> bool:
    """Tell whether robots move round a circle at one tick."""
    moves: dict[int, dict[int, int]] = defaultdict(dict)
    for x, tick in enumerate(enter):
        if not system.is_first(x):
            moves[tick][system.vertex[x - 1]] = system.vertex[x]
    return any(comes_round(heads, tail) for heads in moves.values() for tail in heads)


def comes_round(heads: dict[int, int], start: int) -> bool:
    """Tell whether going on from head to head leads back to the start."""
    place = heads[start]
    for _ in heads:
        if place == start:
            return True
        place = heads.get(place, place)
    return False


@law(systems(), st.booleans())
def test_the_optimum_is_the_least_flowtime_of_all_orders(system: System, rotations: bool) -> None:
    orders = choices(system)
    if prod(map(len, orders)) > MOST_ORDERS:
        leave("too many orders")
    least = min(flowtimes(system, orders, rotations=rotations), default=None)

    found = least_flowtime(system, rotations=rotations)

    if found == "infeasible":
        assert least is None
    else:
        assert (found.flowtime, found.proven) == (least, True)


@pytest.mark.parametrize(("rotations", "expected"), [(True, 6), (False, None)])
def test_three_robots_that_change_places_all_at_once(rotations: bool, expected: int | None) -> None:
    """Each moves after one tick and then works one: 2 + 2 + 2."""
    circle = System(
        routes=((0, 1), (1, 2), (2, 0)), least=(1,) * 6, approach=(0,) * 6, active=(True,) * 3
    )
    found = least_flowtime(circle, rotations=rotations)
    assert (None if found == "infeasible" else found.flowtime) == expected


def test_two_robots_never_change_places() -> None:
    pair = System(routes=((0, 1), (1, 0)), least=(1,) * 4, approach=(0,) * 4, active=(True,) * 2)
    assert least_flowtime(pair) == "infeasible"


def make_plan(scenario: Scenario, enter: Sequence[int], routes: Sequence[Route]) -> Plan:
    """Return a timetable as a plan."""
    ticks = iter(enter)
    tracks = (Track.of(route.vertices, list(islice(ticks, len(route)))) for route in routes)
    return Plan(scenario=scenario, tracks=tuple(tracks), run=PlannerRun(name="optimum"))


@pytest.mark.parametrize("seed", range(10))
def test_the_optimum_is_a_plan_that_the_judge_passes(seed: int) -> None:
    scenario = random_fleet(seed, size=7, robots=5, rules=RULES[seed % len(RULES)])
    routes = routes_of(rightofway.solve(scenario, "two-level", time_limit=60))

    found = best_on(scenario, routes)

    assert found != "infeasible"
    assert found.proven
    plan = make_plan(scenario, found.enter, routes)
    assert rightofway.check(plan).faults == ()
    assert measure(plan).flowtime == found.flowtime


@pytest.mark.parametrize("planner", STRICT)
@pytest.mark.parametrize("seed", range(12))
def test_no_plan_is_below_the_optimum_on_its_routes(planner: str, seed: int) -> None:
    scenario = random_fleet(seed, size=7, robots=6, rules=RULES[seed % len(RULES)])
    plan = rightofway.solve(scenario, planner, time_limit=10)

    found = best_on(scenario, routes_of(plan))

    assert found != "infeasible"
    assert found.proven
    assert found.flowtime is not None
    assert measure(plan).lower_bound <= found.flowtime <= measure(plan).flowtime


@pytest.mark.parametrize("choice", ["shortest", "clear"])
@pytest.mark.parametrize("seed", range(12))
def test_local_search_is_never_worse_than_two_level(choice: str, seed: int) -> None:
    scenario = random_fleet(seed, size=7, robots=6, rules=RULES[seed % 2])
    before, after = (
        rightofway.solve(scenario, planner, time_limit=60, options={"routes": choice})
        for planner in ("two-level", "local-search")
    )
    assert measure(after).flowtime <= measure(before).flowtime
