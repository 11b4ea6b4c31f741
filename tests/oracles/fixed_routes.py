"""The least flowtime on fixed routes over all orders of visits, proven by OR-Tools CP-SAT.

A job shop with blocking: visits are operations, vertices machines, and a machine is free only when
the robot enters the next one. The model says what `docs/model.md` says and no more; the search is
left to the solver.
"""

from __future__ import annotations

from itertools import combinations
from typing import TYPE_CHECKING, Literal, NamedTuple

from ortools.sat.python import cp_model

from rightofway.model import make_route
from tests.oracles.precedence import System

if TYPE_CHECKING:
    from collections.abc import Sequence

    from rightofway.model import Plan, Route, Scenario

EFFORT = 60.0
"""How long the solver may try, in its own units: about seconds, but the same on every machine."""

Orders = dict[tuple[int, int], cp_model.LiteralT]
"""For each two visits that need an order, both ways, whether the first of them goes first."""


class Optimum(NamedTuple):
    """The best that was found.

    ``flowtime`` is None, and ``enter`` empty, if no timetable was found. ``enter`` has a tick for
    each visit of the system. ``proven`` tells whether nothing can be better.
    """

    flowtime: int | None
    proven: bool
    enter: tuple[int, ...] = ()


def best_on(
    scenario: Scenario, routes: Sequence[Route], *, effort: float = EFFORT
) -> Optimum | Literal["infeasible"]:
    """Find the best timetable on these routes that keeps the rules of the scenario."""
    system = system_of(scenario, routes)
    return least_flowtime(system, rotations=scenario.rules.rotations, effort=effort)


def routes_of(plan: Plan) -> list[Route]:
    """Return the routes of a plan, without its times."""
    scenario = plan.scenario
    pairs = zip(scenario.problem.itineraries, plan.tracks, strict=True)
    return [make_route(scenario.roadmap, itinerary, track) for itinerary, track in pairs]


def system_of(scenario: Scenario, routes: Sequence[Route]) -> System:
    """Return what routes and the rules of a scenario come to."""
    ahead = scenario.problem.booking_rules.books_ahead
    return System(
        routes=tuple(route.vertices for route in routes),
        least=tuple(route.compute_least(visit) for route in routes for visit in range(len(route))),
        approach=tuple(int(drive) if ahead else 0 for route in routes for drive in route.drive),
        headway=scenario.problem.booking_rules.headway,
        active=(True,) * len(routes),
    )


def least_flowtime(
    system: System, *, rotations: bool = True, effort: float = EFFORT
) -> Optimum | Literal["infeasible"]:
    """Find the best timetable over all orders of visits at all vertices.

    All robots take part, and swaps are forbidden. The completion of a robot is the enter of its
    last visit plus the least of it, which is what it works there.
    """
    model = cp_model.CpModel()
    enter = _enters(model, system)
    orders = _orders(model, system)
    for (x, y), goes_first in orders.items():
        if system.is_last(x) or system.is_first(y):
            model.add(goes_first == 0)
        else:
            gap = system.headway + system.approach[y]
            model.add(enter[y] >= enter[x + 1] + gap).only_enforce_if(goes_first)
    _forbid_swaps(model, system, orders)
    if not rotations:
        _forbid_rotations(model, system, orders)
    lasts = [x for x in range(len(enter)) if system.is_last(x)]
    model.minimize(sum(enter[x] + system.least[x] for x in lasts))
    return _solved(model, enter, effort)


def _enters(model: cp_model.CpModel, system: System) -> list[cp_model.IntVar]:
    """Say that a visit lasts its least, and that a robot is at its first vertex from tick 0."""
    horizon = _horizon(system)
    visits = range(len(system.vertex))
    enter = [model.new_int_var(0, 0 if system.is_first(x) else horizon, "") for x in visits]
    for x in visits:
        if not system.is_last(x):
            model.add(enter[x + 1] >= enter[x] + system.least[x])
    return enter


def _horizon(system: System) -> int:
    """Return a tick that no visit need begin after.

    A longest path in a precedence graph comes to each visit once, from the visit before it or from
    one that another robot begins.
    """
    waits = [system.headway + approach for approach in system.approach]
    return sum(system.least) + sum(waits)


def _orders(model: cp_model.CpModel, system: System) -> Orders:
    """Say that of two visits of different robots to one vertex, one goes first."""
    orders: Orders = {}
    for x, y in combinations(range(len(system.vertex)), 2):
        if system.vertex[x] == system.vertex[y] and system.robot[x] != system.robot[y]:
            x_first = model.new_bool_var("")
            orders[x, y], orders[y, x] = x_first, ~x_first
    return orders


def _forbid_swaps(model: cp_model.CpModel, system: System, orders: Orders) -> None:
    """Say that of two robots on one edge, each does not enter what the other leaves.

    One drives from visit x to x + 1, the other from y to y + 1, the other way. If x went before
    y + 1, and y before x + 1, then x + 1 and y + 1 would have to begin at one tick.
    """
    for (x, after_y), goes_first in orders.items():
        opposite = orders.get((after_y - 1, x + 1))
        if opposite is not None and not system.is_last(x) and not system.is_first(after_y):
            model.add_bool_or(~goes_first, ~opposite)


def _forbid_rotations(model: cp_model.CpModel, system: System, orders: Orders) -> None:
    """Say that whatever begins at one tick can still begin one after the other."""
    visits = range(len(system.vertex))
    turn = [model.new_int_var(0, len(visits), "") for _ in visits]
    for (x, y), goes_first in orders.items():
        if not system.is_last(x):
            model.add(turn[y] > turn[x + 1]).only_enforce_if(goes_first)


def _solved(
    model: cp_model.CpModel, enter: list[cp_model.IntVar], effort: float
) -> Optimum | Literal["infeasible"]:
    solver = cp_model.CpSolver()
    solver.parameters.num_workers = 1
    solver.parameters.random_seed = 0
    solver.parameters.max_deterministic_time = effort
    status = solver.solve(model)
    if status == cp_model.INFEASIBLE:
        return "infeasible"
    if status == cp_model.UNKNOWN:
        return Optimum(None, proven=False)
    assert status in {cp_model.OPTIMAL, cp_model.FEASIBLE}, solver.status_name(status)
    ticks = tuple(solver.value(each) for each in enter)
    return Optimum(round(solver.objective_value), status == cp_model.OPTIMAL, ticks)
