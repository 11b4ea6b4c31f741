"""Why a fleet has no plan: who is blocked, where, and what would help."""

import pytest

import rightofway
from rightofway import FleetBuilder, NoPlanExists
from rightofway.errors import MAX_REASONS
from rightofway.facts import Fact
from rightofway.model import Scenario


def no_plan(scenario: Scenario) -> NoPlanExists:
    with pytest.raises(NoPlanExists) as caught:
        rightofway.solve(scenario)
    return caught.value


def test_every_robot_without_a_way_is_named_with_all_its_places() -> None:
    fleet = FleetBuilder(grid=["....", "@@@@", "...."])
    fleet.add_robot("R1", home="N0", target="N9").add_robot("R2", home="N1", target="N2")
    fleet.add_robot("R3", home="N3", stops=["N10", "N11", "N2"])
    error = no_plan(fleet.build_scenario())
    parts = "the map is in parts that no edge joins (join them, or give the robot other places)"
    assert str(error).splitlines() == [
        f"R1 has no way from N0 to N9: {parts}",
        f"R3 has no way from N3 to N10 and N11: {parts}",
    ]
    assert error.robots == ("R1", "R3")


def test_a_one_way_edge_is_named_where_it_is_the_reason() -> None:
    """R1 can drive from the bay to the dock, and not back."""
    fleet = FleetBuilder().add_vertex("bay", 0, 0).add_vertex("dock", 1, 0)
    fleet.add_edge("bay", "dock", both_ways=False).add_robot("R1", home="bay", target="dock")
    assert str(no_plan(fleet.build_scenario())) == (
        "R1 has no way from dock to bay: the edge from bay to dock is one way (let robots drive it"
        " both ways, or give the robot other places)"
    )


def test_several_one_way_edges_in_a_row_are_the_reason() -> None:
    fleet = FleetBuilder()
    for x, name in enumerate("abc"):
        fleet.add_vertex(name, x, 0)
    fleet.add_edge("a", "b", both_ways=False).add_edge("b", "c", both_ways=False)
    fleet.add_robot("R1", home="a", target="c")
    assert "one-way edges are the reason (let robots drive more" in str(
        no_plan(fleet.build_scenario())
    )


def test_shared_ends_are_reported_beside_missing_ways() -> None:
    fleet = FleetBuilder(grid=["...@."], ends="none")
    for name, home, target in (("R1", "N0", "N2"), ("R2", "N1", "N2"), ("R3", "N4", "N2")):
        fleet.add_robot(name, home=home, target=target)
    way, end = no_plan(fleet.build_scenario()).blockages
    assert way.robots == (2,)
    assert end.reason == Fact("shared end", robots=(0, 1, 2), place=2)
    assert str(end.reason) == "R1, R2 and R3 would all have to stay at N2 permanently"
    assert str(end.remedy) == "let others end elsewhere"
    assert str(end) == f"{end.reason} ({end.remedy})"


def test_two_robots_that_block_each_other_are_named_among_others() -> None:
    fleet = FleetBuilder(grid=["....", "@@@@", "...."])
    fleet.add_robot("R1", home="N8", target="N10").add_robot("R2", home="N0", target="N3")
    fleet.add_robot("R3", home="N11", target="N9").add_robot("R4", home="N3", target="N0")
    error = no_plan(fleet.build_scenario())
    assert error.robots == ("R2", "R4")
    assert error.vertices == ("N0", "N1", "N2", "N3")
    assert str(error) == (
        "R2 and R4 block each other, whatever the other robots do: both have to pass N0, N1, N2 and"
        " N3 (give more room there)"
    )


def test_a_ring_without_rotations_has_no_narrow_place() -> None:
    fleet = FleetBuilder(grid=["..", ".."], ends="none", rotations=False)
    ring = ["N0", "N1", "N3", "N2"]
    for index, home in enumerate(ring):
        fleet.add_robot(f"R{index}", home=home, target=ring[(index + 1) % 4])
    error = no_plan(fleet.build_scenario())
    assert str(error) == "R0, R1, R2 and R3 block each other (give more room, or other places)"
    assert set(error.vertices) == set(ring)


def test_a_long_list_of_reasons_is_cut_in_the_message_only() -> None:
    robots = MAX_REASONS + 3
    fleet = FleetBuilder(grid=["." * robots, "@" * robots, "." * robots])
    for index in range(robots):
        fleet.add_robot(f"R{index}", home=(0, index), target=(2, index))
    error = no_plan(fleet.build_scenario())
    assert str(error).splitlines()[-1] == "and 3 more"
    assert len(error.as_dict()["robots"]) == robots


def test_a_blocked_part_is_found_beside_a_hall_of_other_robots() -> None:
    """What the ten robots of the hall do is tried only after each part was looked at alone."""
    fleet = FleetBuilder(grid=["......@@", "@@@@@@@@", *["........"] * 5])
    fleet.add_robot("A", home="N0", target="N5").add_robot("B", home="N5", target="N0")
    for index in range(10):
        fleet.add_robot(f"R{index}", home=f"N{16 + index}", target=f"N{55 - index}")
    error = no_plan(fleet.build_scenario())
    assert error.robots == ("A", "B")
    assert error.vertices == ("N0", "N1", "N2", "N3", "N4", "N5")
