"""Vertices that robots only drive through, driven: a drive through them is released as a whole."""

from __future__ import annotations

import pytest

from rightofway import FleetBuilder, solve
from rightofway.control.demo import drive_demo
from rightofway.control.dispatcher import Dispatcher
from rightofway.control.fleet_control import FleetControl
from rightofway.control.operator import Operator
from rightofway.control.releases import find_last_part, is_in_base
from rightofway.control.rest import RestPlanner
from rightofway.errors import InputError
from rightofway.model import Plan
from tests.builders.chaos import MemoryJournal


def make_plan() -> Plan:
    """Return a plan of one robot that drives A P Q B C and back; it only drives through P and Q."""
    fleet = FleetBuilder()
    for name, x in [("A", 0), ("B", 6), ("C", 8)]:
        fleet.add_vertex(name, x, 0)
    for name, x in [("P", 2), ("Q", 4)]:
        fleet.add_vertex(name, x, 0, is_passed=True)
    for tail, head in [("A", "P"), ("P", "Q"), ("Q", "B"), ("B", "C")]:
        fleet.add_edge(tail, head)
    fleet.add_robot("R1", home="A", target="C", work=1)
    return solve(fleet.build_scenario(), "prioritized")


def start_control(plan: Plan) -> tuple[FleetControl, Dispatcher]:
    """Return a control that has begun a plan."""
    control = FleetControl(MemoryJournal())
    dispatcher = Dispatcher(control, plan)
    dispatcher.begin("run")
    return control, dispatcher


@pytest.mark.parametrize(("ahead", "end"), [(1, 3), (2, 3), (3, 3), (4, 4), (6, 4)])
@pytest.mark.parametrize("shut", [None, 1, 2, 3])
def test_what_is_released_ends_where_robots_may_stop(
    ahead: int, end: int, shut: int | None
) -> None:
    """P, Q and B are parts 1 to 3; C, part 4, has work. What shuts one of P to B shuts all."""
    control, _ = start_control(make_plan())
    last = find_last_part(
        control.ledger,
        0,
        ahead,
        is_in_base,
        may_enter=lambda _, part: part != shut,
        may_stop=control.may_stop,
    )
    assert last == (end if shut is None else 0)


@pytest.mark.parametrize(("arrived", "begin"), [(0, 0), (1, 0), (2, 0), (3, 3), (4, 4)])
def test_the_rest_is_planned_from_where_a_robot_might_stop(arrived: int, begin: int) -> None:
    plan = make_plan()
    control, _ = start_control(plan)
    (own,) = control.ledger.robots
    own.arrived = arrived
    assert RestPlanner(plan.scenario).begin_at_stop(own).arrived == begin


def test_a_plan_is_driven_through() -> None:
    plan = make_plan()
    assert drive_demo(plan).now == plan.makespan == 17  # 8 there, 1 at C, 8 back


def test_no_job_is_added_where_robots_only_drive_through() -> None:
    _, dispatcher = start_control(make_plan())
    with pytest.raises(InputError, match=r"P is driven through only \(name a vertex without pass"):
        Operator(dispatcher).add_job("P", 1)
