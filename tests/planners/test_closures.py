"""What planners say of closures, barred edges and surcharges: refusals, proofs, costs."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from typing import Any

import pytest

from rightofway import FleetBuilder, check, improve, solve
from rightofway.errors import InputError, NoPlanExists
from rightofway.model import Closure, Scenario, compute_cost
from rightofway.planners import find_all


def corridor(**closure: Any) -> Scenario:
    """Return two robots that exchange the ends of N0 - N1 - N2 - N3, with a bay N5 below N1."""
    fleet = FleetBuilder(grid=["....", "@.@@"], ends="none", turn=0)
    fleet = fleet.add_robot("R1", home="N0", target="N3").add_robot("R2", home="N3", target="N0")
    return fleet.add_closure(**closure).build_scenario() if closure else fleet.build_scenario()


@pytest.mark.parametrize(
    ("closure", "reason"),
    [
        ({"at": "N3", "until": 3}, "N3 is closed from time 0 to time 3"),
        ({"at": "N0", "from_": 5}, "N0 is closed from time 5 on"),
        ({"edge": ("N1", "N2"), "from_": 1}, "N1 to N2 is closed from time 1 on"),
    ],
)
def test_a_robot_that_closures_stop_even_alone_is_named_with_them(
    closure: dict[str, Any], reason: str
) -> None:
    """R2 starts at N3; it ends at N0; and the only way is between N1 and N2."""
    with pytest.raises(NoPlanExists, match="R2 cannot make its trip, even alone") as proven:
        solve(corridor(**closure))
    assert reason in str(proven.value)


def test_only_closures_that_block_are_named() -> None:
    scenario = corridor(at="N5", until=2)
    at = scenario.roadmap.get_vertex("N0")
    late = replace(scenario, closures=(*scenario.closures, Closure(at=at, from_=Fraction(9))))
    with pytest.raises(NoPlanExists) as proven:
        solve(late)
    assert "N0 is closed from time 9 on" in str(proven.value)
    assert "N5" not in str(proven.value)


def test_robots_that_have_no_room_at_the_times_left_are_proven_to_have_no_plan() -> None:
    """With the bay closed for ever, the two cannot pass each other."""
    with pytest.raises(NoPlanExists, match="R1 and R2 have no room to pass each other"):
        solve(corridor(at="N5"))


def test_robots_use_the_bay_once_it_is_open() -> None:
    """Until 6, R2 can wait at N3 and R1 at N0; R1 enters the bay at 6 or later."""
    plan = solve(corridor(at="N5", until=6))
    assert check(plan).ok
    assert "N5" in {name for robot in ("R1", "R2") for name in plan[robot].vertices}
    assert plan.flowtime > solve(corridor()).flowtime


@pytest.mark.parametrize("planner", ["paper", "lacam"])
def test_planners_without_closures_refuse_them_and_name_others(planner: str) -> None:
    with pytest.raises(InputError, match=f"planner {planner} does not know closures .choose auto"):
        solve(corridor(at="N5", until=6), planner)


@pytest.mark.parametrize("planner", ["auto", "two-level"])
def test_the_published_method_refuses_closures(planner: str) -> None:
    with pytest.raises(InputError, match="swaps=leave does not know closures"):
        solve(corridor(at="N5", until=6), planner, swaps="leave")


def two_ways(*, kind: str | None = None, surcharge: str = "0") -> Scenario:
    """Return a robot from A to C: 2 long by B, which heavy robots may not use; 3 long by D."""
    fleet = FleetBuilder(ends="none").add_vertex("A", 0, 0).add_vertex("B", 1, 0)
    fleet = fleet.add_vertex("C", 2, 0).add_vertex("D", 1, 1)
    fleet = fleet.add_edge("A", "B", 1, barred=["heavy"], surcharge=surcharge)
    fleet = fleet.add_edge("B", "C", 1).add_edge("A", "D", "3/2").add_edge("D", "C", "3/2")
    return fleet.add_robot("R1", home="A", target="C", type=kind).build_scenario()


@pytest.mark.parametrize("planner", [name for name in find_all() if name != "lacam"])
def test_every_planner_keeps_types_off_barred_edges(planner: str) -> None:
    heavy, light = (
        solve(two_ways(kind=name), planner, time_limit=2, options=_few(planner))
        for name in ("heavy", "light")
    )
    assert heavy["R1"].vertices == ("A", "D", "C")
    assert light["R1"].vertices == ("A", "B", "C")
    assert heavy.lower_bound == heavy.flowtime


@pytest.mark.parametrize("planner", [name for name in find_all() if name != "lacam"])
def test_every_planner_takes_the_way_of_least_time_and_surcharge(planner: str) -> None:
    """The bound stays that of the quickest way."""
    cheap, costly = (
        solve(two_ways(surcharge=more), planner, time_limit=2, options=_few(planner))
        for more in ("0.9", "1.1")
    )
    assert cheap["R1"].vertices == ("A", "B", "C")
    assert costly["R1"].vertices == ("A", "D", "C")
    assert cheap.flowtime == cheap.lower_bound == costly.lower_bound < costly.flowtime
    assert compute_cost(cheap.scenario, cheap.tracks) > cheap.flowtime


def test_improving_never_raises_flowtime_and_surcharges_together() -> None:
    first = solve(two_ways(surcharge="1.1"), "two-level")
    better = improve(first, time_limit=1, iterations=20)
    assert compute_cost(better.scenario, better.tracks) <= compute_cost(
        first.scenario, first.tracks
    )


def _few(planner: str) -> dict[str, int] | None:
    return {"iterations": 20} if planner in {"auto", "lns"} else None


def test_a_robot_without_a_way_for_its_type_is_named() -> None:
    fleet = FleetBuilder(ends="none").add_vertex("A", 0, 0).add_vertex("B", 1, 0)
    fleet = fleet.add_edge("A", "B", barred=["heavy"])
    scenario = fleet.add_robot("R1", home="A", target="B", type="heavy").build_scenario()
    with pytest.raises(NoPlanExists) as proven:
        solve(scenario)
    assert str(proven.value) == (
        "R1 has no way from A to B: edges are barred for robots of type heavy"
        " (open one, or give the robot other places)"
    )


def test_a_robot_that_passes_its_stop_before_a_closure_has_not_worked_there() -> None:
    """R1 cannot work at N1 before it closes; R2 moves while R1 stands there."""
    fleet = FleetBuilder(grid=["....", "...."], occupancy="both", ends="none", turn=0)
    fleet = fleet.add_robot("R1", home="N0", target="N1", work=6)
    fleet = fleet.add_robot("R2", home="N7", stops=[("N5", 0), ("N7", 0)])
    plan = solve(
        fleet.add_closure(at="N1", from_=4, until=9).build_scenario(), "lns", iterations=20
    )
    assert check(plan).ok
    assert plan["R1"].completion == 16
