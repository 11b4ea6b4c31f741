"""Graphs of networkx as layouts, and layouts in a fleet builder."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path
from typing import Any

import networkx as nx  # type: ignore[import-untyped]
import pytest

from rightofway import FleetBuilder, make_layout_of_graph, solve
from rightofway.errors import InputError
from rightofway.io.layouts import format_layout, read_layout
from rightofway.site.layout import Layout

HALL = Path(__file__).parents[2] / "data" / "layouts" / "hall.lif.json"


def graph() -> Any:
    found = nx.DiGraph()
    found.add_node("dock", x=0, y=0.5, parking=True, charging=True)
    found.add_node(7, pos=(3, 4.5))
    found.add_node((0, 9))
    found.add_edge("dock", 7, max_speed=0.5)
    found.add_edge(7, "dock", length="11/2", speed_limit=2)
    found.add_edge(7, (0, 9), weight=1)
    return found


def test_a_graph_has_places_lengths_and_limits() -> None:
    (level,) = make_layout_of_graph(graph()).levels
    assert [(each.name, *map(float, each.at)) for each in level.vertices] == [
        ("dock", 0, 0.5),
        ("7", 3, 4.5),
        ("(0, 9)", 0, 9),
    ]
    assert [each.is_parking and each.is_charging for each in level.vertices] == [True, False, False]
    assert [(each.tail, each.length, each.max_speed) for each in level.edges] == [
        ("dock", 5, Fraction(1, 2)),
        ("7", Fraction(11, 2), 2),
        ("7", Fraction(5409, 1000), None),  # the root of 29.25, rounded up to a millimetre
    ]


def test_edges_without_a_direction_are_driven_both_ways() -> None:
    (level,) = make_layout_of_graph(graph().to_undirected()).levels
    assert len(level.edges) == 4


def test_a_graph_is_the_file_that_networkx_writes(tmp_path: Path) -> None:
    plain = nx.DiGraph()
    plain.add_node("a", x=1.5, y=-2.0, charging=True)
    plain.add_node("b", x=4.5, y=2.0)
    plain.add_edge("a", "b", length=6.5, max_speed=1.25)
    nx.write_graphml(plain, tmp_path / "hall.graphml")
    found = read_layout(tmp_path / "hall.graphml")
    assert isinstance(found, Layout)
    assert found.levels == make_layout_of_graph(plain).levels


def test_every_fault_of_a_graph_is_named() -> None:
    wrong = nx.Graph()
    wrong.add_node("a")
    wrong.add_node("b", x="left", y=0)
    wrong.add_edge("a", "b", length=[1])
    with pytest.raises(InputError) as error:
        make_layout_of_graph(wrong)
    assert str(error.value).splitlines() == [
        "node 'a': has no position (give x and y, or pos=(x, y))",
        "node 'b': x: 'left' is not a number (write it like 3, 0.5 or 1/3)",
        "edge 'a' to 'b': length: [1] is not a number (write it like 3, 0.5 or 1/3)",
    ]
    with pytest.raises(InputError, match="'hall' is no graph"):
        make_layout_of_graph("hall")


def test_a_fleet_is_built_on_a_layout() -> None:
    """The way out is 5 m at 0.5 m/s, the way home 5.5 m at 1 m/s; ticks are rounded."""
    fleet = FleetBuilder(layout=make_layout_of_graph(graph())).add_robot(
        "R1", home="dock", target=7
    )
    scenario = fleet.build_scenario()
    assert (scenario.units.length, scenario.units.time) == ("m", "s")
    assert float(solve(scenario).flowtime * scenario.problem.clock.tick) == pytest.approx(
        15.5, abs=0.02
    )


def test_a_fleet_is_built_on_a_file_with_stations_and_other_units() -> None:
    found = read_layout(HALL)
    assert isinstance(found, Layout)
    station = found.levels[0].stations[0]
    type_ = found.levels[0].vehicle_types[0]
    fleet = FleetBuilder(layout=HALL, vehicle_type=type_, units={"length": "mm"})
    at = fleet.build_roadmap()
    fleet.add_robot("R1", home=at.name(0), target=station.name)
    robot = fleet.build_scenario().robots[0]
    assert at.name(robot.stops[0].at) == station.vertices[0]
    assert max(at.lengths) >= 1000


def test_a_fleet_gets_homes_from_the_parking_places_of_a_layout() -> None:
    fleet = FleetBuilder(layout=make_layout_of_graph(graph())).add_robot("R1", target=7)
    assert fleet.build_roadmap().name(fleet.build_scenario().robots[0].home) == "dock"
    with pytest.raises(InputError, match="2 robots need a home, and the map has 1 parking"):
        fleet.add_robot("R2", target=7).build_scenario()
    with pytest.raises(InputError, match="the map has no parking or charging place"):
        FleetBuilder(grid=[".."]).add_robot("R1", target="N0").build_scenario()


def test_a_layout_of_pixels_is_refused_with_the_remedy() -> None:
    with pytest.raises(InputError, match="is a map in pixels or cells"):
        FleetBuilder(layout=HALL.with_name("room.yaml"))
    with pytest.raises(InputError, match="level: is for a layout"):
        FleetBuilder(grid=["."], level="L1")


def test_a_layout_of_a_graph_is_written_for_other_programs() -> None:
    text, _ = format_layout(make_layout_of_graph(graph()), "nav2")
    assert '"startid": 0' in text
