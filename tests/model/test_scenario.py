"""Scenarios are valid by construction, and the same in ticks."""

from dataclasses import replace
from fractions import Fraction

import pytest

from rightofway.errors import InputError
from rightofway.model import Robot, Rules, Scenario, Stop
from rightofway.site import VertexId, make_grid_roadmap
from tests.builders.fleets import grid_fleet

ROW = ["....."]


def test_stages_are_the_stops_then_home_with_turning_of_one_cell() -> None:
    # Speed 1/2: 2 ticks a cell, and as many to turn; work 3.
    itinerary = grid_fleet(
        ROW, [("N0", "N4")], speeds=[Fraction(1, 2)], work=[3]
    ).problem.itineraries[0]
    assert [(stage.vertex, stage.work, stage.turn) for stage in itinerary.stages] == [
        (4, 3, 2),
        (0, 0, 2),
    ]
    assert itinerary.edge_ticks == (2,)


def test_laps_repeat_the_stages() -> None:
    scenario = grid_fleet(ROW, [("N0", "N4")], rules=Rules(laps=3))
    assert [stage.vertex for stage in scenario.problem.itineraries[0].stages] == [4, 0] * 3


def test_one_way_ends_at_the_last_stop() -> None:
    scenario = grid_fleet(ROW, [("N0", "N4")], rules=Rules(ends="none"))
    assert [stage.vertex for stage in scenario.problem.itineraries[0].stages] == [4]


def test_a_robot_may_differ_from_the_rules() -> None:
    scenario = grid_fleet(ROW, [("N0", "N4")], rules=Rules(laps=2))
    robot = replace(scenario.robots[0], turn=Fraction(0), ends="none", laps=1)
    itinerary = replace(scenario, robots=(robot,)).problem.itineraries[0]
    assert [(stage.vertex, stage.turn) for stage in itinerary.stages] == [(4, 0)]


def test_every_independent_fault_is_reported_at_once() -> None:
    roadmap = make_grid_roadmap(ROW)
    bad = Robot(name="", home=VertexId(0), stops=(Stop(at=VertexId(9)),))
    twin = Robot(name="B", home=VertexId(0), stops=())
    with pytest.raises(InputError) as caught:
        Scenario(roadmap=roadmap, robots=(bad, twin), rules=Rules(laps=2, ends="none"))
    assert [fault.place for fault in caught.value.faults] == [
        "robots[0].name",
        "robots[0].stops[0].at",
        "robots[0].laps",
        "robots[1].stops",
        "robots[1].laps",
        "robots[1].home",
    ]


def test_every_number_of_a_robot_and_of_rules_out_of_range_is_reported_at_once() -> None:
    with pytest.raises(InputError) as caught:
        Robot(
            name="A", home=VertexId(0), stops=(), speed=Fraction(-1, 2), radius=Fraction(-1), laps=0
        )
    assert [fault.place for fault in caught.value.faults] == ["speed", "radius", "laps"]
    with pytest.raises(InputError) as caught:
        Rules(headway=Fraction(-1), laps=0, late=Fraction(-1))
    assert {fault.place for fault in caught.value.faults} == {"headway", "laps", "late"}
    with pytest.raises(InputError, match="stop: work: -1 is negative"):
        Stop(at=VertexId(9), work=Fraction(-1))


@pytest.mark.parametrize("laps", [500_001, 2**31, 2**64])
@pytest.mark.parametrize("of_fleet", [True, False])
def test_stages_of_a_fleet_are_counted_before_they_are_listed(laps: int, of_fleet: bool) -> None:
    """One stop and one way home in each lap."""
    [robot] = grid_fleet(ROW, [("N0", "N4")]).robots
    rules = Rules(laps=laps if of_fleet else 1)
    robots = (robot if of_fleet else replace(robot, laps=laps),)
    with pytest.raises(InputError, match=rf"robots: {2 * laps} stops and ways home in all laps"):
        replace(grid_fleet(ROW, [("N0", "N4")]), robots=robots, rules=rules)


def test_laps_need_a_way_back() -> None:
    with pytest.raises(InputError, match=r"robots\[0\].laps: 2 laps need a way back"):
        grid_fleet(ROW, [("N0", "N4")], rules=Rules(laps=2, ends="none"))


def test_turning_by_the_cell_needs_cells() -> None:
    scenario = grid_fleet(ROW, [("N0", "N4")])
    gridless = replace(scenario.roadmap, grid=None)
    with pytest.raises(InputError, match=r"rules\.turn: 'cell' needs a grid"):
        replace(scenario, roadmap=gridless, rules=Rules(turn="cell"))


def test_off_a_grid_turning_takes_no_time_by_default() -> None:
    scenario = grid_fleet(ROW, [("N0", "N4")])
    gridless = replace(scenario, roadmap=replace(scenario.roadmap, grid=None))
    assert gridless.problem.itineraries[0].stages[0].turn == 0
