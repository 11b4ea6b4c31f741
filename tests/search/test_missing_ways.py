"""Facts on robots that have no way to a place of their trip."""

from __future__ import annotations

from rightofway import FleetBuilder
from rightofway.errors import Blockage
from rightofway.facts import Fact
from rightofway.search.missing_ways import find_missing_ways


def find_blockages(fleet: FleetBuilder) -> list[Blockage]:
    return list(find_missing_ways(fleet.build_scenario(), [0]))


def test_places_in_other_parts_of_the_map_are_one_fact() -> None:
    """Cells are named by their place in the file, and numbered without the walls."""
    fleet = FleetBuilder(grid=["..@..", "..@.."])
    fleet.add_robot("R1", home="N0", stops=["N3", "N1", "N9"])
    (blockage,) = find_blockages(fleet)
    assert blockage.reason == Fact("map in parts", robot=0, tail=0, head=(2, 7))
    assert blockage.remedy == Fact("join the parts")
    assert (blockage.robots, blockage.vertices) == ((0,), (0, 2, 7))


def test_an_edge_that_opens_the_way_is_part_of_the_fact() -> None:
    fleet = FleetBuilder().add_vertex("bay", 0, 0).add_vertex("dock", 1, 0)
    fleet.add_edge("bay", "dock", both_ways=False).add_robot("R1", home="bay", target="dock")
    (blockage,) = find_blockages(fleet)
    edge = Fact("one-way edge", first=0, last=1)
    assert blockage.reason == Fact("no way of robot", robot=0, tail=1, head=0, why=edge)
    assert blockage.remedy == Fact("drive both ways")


def test_several_one_way_edges_are_not_listed() -> None:
    fleet = FleetBuilder()
    for x, name in enumerate("abc"):
        fleet.add_vertex(name, x, 0)
    fleet.add_edge("a", "b", both_ways=False).add_edge("b", "c", both_ways=False)
    fleet.add_robot("R1", home="a", target="c")
    (blockage,) = find_blockages(fleet)
    why = Fact("one-way edges")
    assert blockage.reason == Fact("no way of robot", robot=0, tail=2, head=0, why=why)
    assert blockage.remedy == Fact("drive more both ways")
