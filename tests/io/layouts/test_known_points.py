"""Known points land where the source says; all numbers are worked out by hand."""

import json
import re
from dataclasses import replace
from fractions import Fraction
from math import pi
from pathlib import Path
from typing import Any

import pytest

from rightofway.errors import InputError
from rightofway.io import dump_plan, parse_plan, parse_scenario, read_layout
from rightofway.io.scenario.reader import read_scenario
from rightofway.model import Scenario
from rightofway.site import Point, Roadmap
from rightofway.site.layout import Layout, Level
from rightofway.solve import solve
from tests.builders.sentences import tell_notes

HERE = Path(__file__).parents[2] / "data" / "layouts"


def at(x: float, y: float) -> Point:
    return Fraction(x), Fraction(y)


def level_of(name: str, level: str | None = None) -> Level:
    found = read_layout(HERE / name)
    assert isinstance(found, Layout)
    return found.get_level(level)


def points(level: Level) -> dict[str, Point]:
    return {vertex.name: vertex.at for vertex in level.vertices}


def lanes(level: Level) -> dict[str, tuple[float, float | None]]:
    """Return length and speed limit of each lane."""
    return {
        f"{lane.tail} > {lane.head}": (
            float(lane.length),
            None if lane.max_speed is None else float(lane.max_speed),
        )
        for lane in level.edges
    }


def scenario_on(home: Any, target: Any, base: Path = HERE, **shape: Any) -> Scenario:
    robots = [{"name": "R1", "home": home, "target": target}]
    document = {"format": "rightofway-scenario/1", "map": shape, "robots": robots}
    return parse_scenario(document, base)


def name_of_home(**shape: Any) -> str:
    scenario = scenario_on(**shape)
    return scenario.roadmap.name(scenario.robots[0].home)


def test_lif_keeps_positions_types_limits_and_stations() -> None:
    level = level_of("hall.lif.json")
    assert points(level) == {
        "P1": at(-2.5, 1.25), "A": at(0.5, 1.25),
        "B": at(3.5, 5.25), "C": at(3.5, -2.75),
    }  # fmt: skip
    assert {lane.length for lane in level.edges} == {Fraction(3), Fraction(5)}  # 3-4-5 triangles
    assert [vertex.name for vertex in level.vertices if vertex.is_charging] == ["P1"]
    assert level.stations[0].name == "Press"
    assert level.vehicle_types == ("forklift", "tugger")


def test_the_slower_of_two_parallel_lanes_counts_for_a_vehicle_type() -> None:
    """A forklift with a load may drive 0.5 m/s, without one 1.5 m/s."""
    roadmap = scenario_on("P1", "Press", layout="hall.lif.json", vehicle_type="forklift").roadmap
    edge = roadmap.find_edge(roadmap.get_vertex("A"), roadmap.get_vertex("B"))
    assert edge is not None
    assert roadmap.get_edge_class(edge).max_speed == Fraction(1, 2)
    assert roadmap.labels == ("P1", "A", "B")  # only tuggers drive to C


@pytest.mark.parametrize(
    ("kind", "is_noted"), [("forklift", True), ("tugger", False), (None, False)]
)
def test_a_robot_on_lanes_of_another_type_than_its_own_is_noted(
    kind: str | None, is_noted: bool
) -> None:
    robot = {"name": "R1", "home": "A", "target": "B", **({"type": kind} if kind else {})}
    shape = {"layout": "hall.lif.json", "vehicle_type": "tugger"}
    document = {"format": "rightofway-scenario/1", "map": shape, "robots": [robot]}
    note = "robots of forklift drive on the lanes of vehicle type tugger, at its speed limits"
    assert (
        any(each.startswith(note) for each in tell_notes(read_scenario(document, HERE))) == is_noted
    )


def test_nav2_edges_are_directed_and_limits_in_metres_per_second() -> None:
    found = read_layout(HERE / "route.geojson")
    assert isinstance(found, Layout)
    level = found.get_level()
    assert points(level) == {
        "0": at(0, -1.5),
        "1": at(3, 2.5),
        "2": at(6, -1.5),
    }
    assert lanes(level) == {
        "0 > 1": (5, 0.5), "1 > 0": (5, None),
        "1 > 2": (5, None), "2 > 0": (6, None),
    }  # fmt: skip
    assert level.edges[0].shape == (at(1, 1),)
    assert any("percentage of a robot's speed" in note for note in tell_notes(found))


def test_graphml_weights_that_contradict_the_positions_are_no_lengths() -> None:
    """The weight of a > b is 1, and the line is 5 m long: that of b > c, 12.5, is none either."""
    found = read_layout(HERE / "hall.graphml")
    assert isinstance(found, Layout)
    assert points(found.get_level()) == {
        "a": at(-4, 2.5), "b": at(-1, 6.5), "c": at(-1, -1.5),
    }  # fmt: skip
    assert lanes(found.get_level()) == {
        "a > b": (5, None), "b > a": (5, None),
        "b > c": (8, None), "c > b": (8, None), "c > a": (5, None),
    }  # fmt: skip
    (note,) = tell_notes(found)
    assert note == (
        "the attribute 'weight' is no length: by it, 2 lanes are shorter than the straight line;"
        " all lanes get the straight length"
    )


def test_graphml_weights_that_agree_with_the_positions_are_lengths(tmp_path: Path) -> None:
    """A lane of 12.5 m between points 8 m apart is a curve."""
    text = (HERE / "hall.graphml").read_text("utf-8").replace(">1<", ">5<")
    (tmp_path / "hall.graphml").write_text(text, "utf-8")
    found = read_layout(tmp_path / "hall.graphml")
    assert isinstance(found, Layout)
    assert lanes(found.get_level())["b > c"] == (12.5, None)
    assert tell_notes(found) == ()


def test_lif_numbers_that_are_text_are_named_in_a_note(tmp_path: Path) -> None:
    """Also those that no plan depends on: a height, an angle, a weight of a trajectory."""
    text = (HERE / "hall.lif.json").read_text("utf-8")
    document = json.loads(text)
    before = read_layout(HERE / "hall.lif.json")
    node = document["layouts"][0]["nodes"][1]
    node["nodePosition"]["x"] = str(node["nodePosition"]["x"])
    document["layouts"][0]["stations"][0]["stationHeight"] = "0.55"
    document["layouts"][0]["stations"][0]["stationPosition"] = {"x": 1, "y": 2, "theta": "3.1"}
    (tmp_path / "hall.lif.json").write_text(json.dumps(document), "utf-8")
    found = read_layout(tmp_path / "hall.lif.json")
    assert isinstance(before, Layout)
    assert isinstance(found, Layout)
    (after,), (level,) = found.levels, before.levels
    headings = {vertex.name: vertex.heading for vertex in after.vertices if vertex.heading}
    assert headings == {"B": Fraction("177.616916")}, "3.1 rad"
    without = tuple(replace(vertex, heading=None) for vertex in after.vertices)
    assert replace(after, vertices=without) == level
    places = "layouts[0].nodes[0].nodePosition.y"  # one in the file
    assert f"a number is written as text: {places}" in tell_notes(before)
    places = ", ".join(
        f"layouts[0].{place}" for place in ("nodes[0].nodePosition.y", "nodes[1].nodePosition.x")
    )
    places += (
        ", layouts[0].stations[0].stationHeight and layouts[0].stations[0].stationPosition.theta"
    )
    assert f"4 times: a number is written as text: {places}" in tell_notes(found)


def test_opentcs_millimetres_become_metres_and_a_speed_of_zero_is_no_lane() -> None:
    level = level_of("plant.xml")
    assert points(level) == {
        "Dock": at(-1.5, 2.25), "Cross": at(2.5, 2.25), "End": at(2.5, -0.75),
    }  # fmt: skip
    assert lanes(level) == {
        "Dock > Cross": (4, 1), "Cross > Dock": (4, 0.3),
        "Cross > End": (4.5, 1), "End > Dock": (5, 0.8),
    }  # fmt: skip
    dock = level.vertices[0]
    assert (dock.is_parking, dock.is_charging) == (True, True)
    assert [station.name for station in level.stations] == ["Socket", "Saw 1"]
    assert level.zones[0].edges == (("Dock", "Cross"), ("Cross", "Dock"))


def test_report_positions_of_opentcs_are_driven_through_only(tmp_path: Path) -> None:
    text = (HERE / "plant.xml").read_text("utf-8")
    (before,) = re.findall(r'<point [^>]*name="Cross"[^>]*>', text)
    after = re.sub(r'type="\w+"', 'type="REPORT_POSITION"', before)
    assert after != before
    (tmp_path / "plant.xml").write_text(text.replace(before, after), "utf-8")
    found = read_layout(tmp_path / "plant.xml")
    assert isinstance(found, Layout)
    vertices = found.get_level().vertices
    assert [vertex.name for vertex in vertices if vertex.is_passed] == ["Cross"]


def test_operations_of_locations_are_actions_at_their_points(tmp_path: Path) -> None:
    """Those of a link replace those of the type; of two of a kind, an order chooses."""
    names = ("CHARGE", "NOP", "Load cargo", "Unload cargo", "Cut", "Drill")
    operations = "".join(f'<allowedOperation name="{name}"/>' for name in names)
    link = '<link point="Cross"><allowedOperation name="Cut"/></link></location>'
    text = (HERE / "plant.xml").read_text("utf-8")
    text = text.replace('<allowedOperation name="Cut"/>', operations)
    text = text.replace('<link point="End"/></location>', f'<link point="End"/>{link}')
    (tmp_path / "plant.xml").write_text(text, "utf-8")
    found = read_layout(tmp_path / "plant.xml")
    assert isinstance(found, Layout)
    dock, cross, end = found.levels[0].vertices
    assert (dock.actions, dict(cross.actions)) == ((), {"work": '{"action": "Cut"}'})
    assert dict(end.actions) == {
        "pick": '{"action": "Load cargo"}', "drop": '{"action": "Unload cargo"}'
    }  # fmt: skip
    assert [vertex.is_charging for vertex in (dock, cross, end)] == [True, False, True]
    assert "operation Drill has no effect on plans: Saw 1" in tell_notes(found)
    scenario = scenario_on("Dock", "Saw 1", layout="plant.xml")
    assert [own.work[0].action for own in scenario.actions] == ["Cut"]


def test_old_plant_models_have_other_names_for_positions() -> None:
    assert points(level_of("plant-5.xml")) == {
        "A": at(-1.5, 2.25),
        "B": at(0.5, 2.25),
    }


@pytest.mark.parametrize("version", ["0.0.2", "0.0.3", "0.0.4", "0.0.5", "6.0.0", "6.1.0", "7.0.0"])
def test_each_version_of_a_plant_model_is_read_alike(version: str, tmp_path: Path) -> None:
    """The model has identifiers, a route and a location without `locked`: version 0.0.2 has these.

    From 6 on positions have other names.
    """
    text = (HERE / "plant-2.xml").read_text("utf-8").replace('"0.0.2"', f'"{version}"')
    if version[0] in "67":
        for axis in "xyz":
            text = text.replace(f"{axis}Position", f"position{axis.upper()}")
    (tmp_path / "plant.xml").write_text(text, "utf-8")
    found = read_layout(tmp_path / "plant.xml")
    assert isinstance(found, Layout)
    level = found.get_level()
    assert points(level) == {"A": at(-1.5, 2.25), "B": at(0.5, 2.25)}
    assert lanes(level) == {"A > B": (2, 1), "B > A": (2, 0.5)}  # the path from B to A is locked
    assert [(vertex.is_parking, vertex.is_charging) for vertex in level.vertices] == [
        (False, True), (True, False),
    ]  # fmt: skip
    assert [station.name for station in level.stations] == ["Socket"]
    assert level.zones[0].edges == (("A", "B"), ("B", "A"))


def test_rmf_navigation_graphs_are_in_metres() -> None:
    level = level_of("hall.nav.yaml", "L1")
    assert points(level) == {
        "dock": at(10.5, -3.25), "v1": at(14.5, -3.25), "shelf": at(14.5, -6.25),
    }  # fmt: skip
    assert lanes(level)["dock > v1"] == (4, 0.5)
    assert lanes(level)["v1 > dock"] == (4, None)  # a limit of 0 is none
    assert level.zones[0].vertices == ("shelf",)
    assert len(level_of("hall.nav.yaml", "L2").edges) == 2


def test_rmf_buildings_are_scaled_by_their_measurements_and_turned_upside_down() -> None:
    """100 pixels are 5 m; the second level is turned by 90 degrees and half as large.

    Its west (50, 10) and east (50, 60) lie on (0, 0) and (100, 0) of the first, so that one pixel
    down is two to the right, and one to the left two down: (40, 10) lies on (0, 20), 1 m down.
    """
    assert points(level_of("hall.building.yaml", "L1")) == {
        "dock": at(5, -2), "v1": at(10, -2), "shelf": at(10, -5),
    }  # fmt: skip
    assert points(level_of("hall.building.yaml", "L2")) == {
        "stairs": at(0, 0), "top": at(0, -1),
    }  # fmt: skip
    assert lanes(level_of("hall.building.yaml", "L1")) == {
        "dock > v1": (5, None), "v1 > dock": (5, None), "v1 > shelf": (3, 0.5),
    }  # fmt: skip


def test_levels_of_a_building_lie_where_the_generator_of_rmf_lays_them(tmp_path: Path) -> None:
    """Fiducials that do not fit exactly: each pair of them counts once, as in ``transform.py``.

    100 pixels are 5 m. To the right in L1, fiducials lie at 0, 300 and 600; downwards in L2 at 50,
    350 and 950. Distances in L2 are 1, 2 and 1.5 times those in L1, in the mean 1.5: one pixel of
    L2 is 2/3 of one in L1, or 1/30 m. (Least squares give 9/14.) Down in L2 is to the right, so
    right in L2 is up. The means of the fiducials, 300 and 450 * 2/3, leave no shift: pixel (x, y)
    of L2 lies at (y/30, x/30) m.
    """
    path = tmp_path / "two.building.yaml"
    path.write_text(
        """
levels:
  L1:
    fiducials: [[0, 0, a], [300, 0, b], [600, 0, c]]
    measurements: [[0, 1, {distance: [3, 5]}]]
    vertices: [[0, 0, 0, one], [100, 0, 0, two]]
    lanes: [[0, 1, {}]]
  L2:
    fiducials: [[0, 50, a], [0, 350, b], [0, 950, c]]
    vertices: [[30, 60, 0, near], [90, 450, 0, far]]
    lanes: [[0, 1, {}]]
""",
        "utf-8",
    )
    found = read_layout(path)
    assert isinstance(found, Layout)
    assert points(found.get_level("L2")) == {"near": at(2, 1), "far": at(15, 3)}


@pytest.mark.parametrize("file", ["nodes.csv", "edges.csv"])
def test_either_file_of_a_csv_pair_names_both(file: str) -> None:
    level = level_of(file)
    assert points(level) == {
        "dock": at(-2.5, 0), "cross": at(0, 0), "shelf": at(0, -3.25),
    }  # fmt: skip
    assert lanes(level) == {
        "dock > cross": (2.5, 0.5), "cross > dock": (2.5, 0.5),
        "cross > shelf": (4, None), "shelf > cross": (4, None),
    }  # fmt: skip
    assert [vertex.name for vertex in level.vertices if vertex.is_parking] == ["dock"]


def test_a_ros_map_is_cut_from_its_origin_on() -> None:
    """The lower left pixel of 0.5 m has its corner at (-1, 2), so its centre at (-0.75, 2.25)."""
    on: dict[str, Any] = {"layout": "room.yaml", "cell_size": 0.5}
    roadmap = scenario_on({"x": -0.75, "y": 2.25}, {"x": -0.75, "y": 2.75}, **on).roadmap
    assert roadmap.grid is not None
    assert roadmap.grid.as_lines() == ("@@@@@@", "......", "..@...", ".....@")
    assert roadmap.get_point(roadmap.get_vertex("N18")) == at(-0.75, 2.25)
    assert roadmap.get_point(roadmap.get_vertex("N11")) == at(1.75, 3.25)


def test_unknown_pixels_are_free_where_the_scenario_says_so() -> None:
    on: dict[str, Any] = {"layout": "room.yaml", "cell_size": 0.5, "unknown": "free"}
    roadmap = scenario_on({"x": -0.75, "y": 2.25}, {"x": 1.75, "y": 2.25}, **on).roadmap
    assert roadmap.grid is not None
    assert roadmap.grid.as_lines()[3] == "......"


def test_a_map_with_yaw_is_turned_about_its_origin(tmp_path: Path) -> None:
    """A quarter turn leads the centre (0.25, 0.25) of the lower left cell to (-0.25, 0.25)."""
    yaml = (HERE / "room.yaml").read_text("utf-8").replace("0.0]", "1.5707963267948966]")
    (tmp_path / "turned.yaml").write_text(yaml, "utf-8")
    (tmp_path / "room.pgm").write_bytes((HERE / "room.pgm").read_bytes())
    corner, next_to_it = {"x": -1.25, "y": 2.25}, {"x": -1.25, "y": 2.75}
    scenario = scenario_on(corner, next_to_it, tmp_path, layout="turned.yaml", cell_size=0.5)
    roadmap = scenario.roadmap
    assert roadmap.name(scenario.robots[0].home) == "N18"
    assert roadmap.name(scenario.robots[0].stops[0].at) == "N19"  # x of the map is y of the site
    x, y = roadmap.get_point(roadmap.get_vertex("N18"))
    assert abs(x + Fraction(5, 4)) < Fraction(1, 10**9)
    assert abs(y - Fraction(9, 4)) < Fraction(1, 10**9)
    assert parse_plan(dump_plan(solve(scenario))).scenario.roadmap == roadmap


def test_obstacles_keep_their_distance_from_large_robots() -> None:
    """A radius of 0.5 m is 0.25 m more than half a cell: no cell beside an obstacle is free."""
    robots = [{"name": "R1", "home": [2, 0], "target": [2, 0], "radius": 0.5}]
    shape = {"layout": "room.yaml", "cell_size": 0.5}
    document = {"format": "rightofway-scenario/1", "map": shape, "robots": robots}
    with pytest.raises(
        InputError, match=r"map\.cell_size: no cell of 0\.5 m has room for a radius of 0\.5 m"
    ):
        parse_scenario(document, HERE)


def test_places_are_vertices_or_stations() -> None:
    on: dict[str, Any] = {"layout": "plant.xml"}
    assert name_of_home(home="Saw 1", target="Dock", **on) == "End"
    assert name_of_home(home={"x": 2.5, "y": -0.75}, target="Dock", **on) == "End"


def test_a_scenario_on_a_layout_is_in_metres_and_seconds_unless_it_names_units() -> None:
    scenario = scenario_on("Dock", "End", layout="plant.xml")
    assert (scenario.units.length, scenario.units.time) == ("m", "s")
    robots = [{"name": "R1", "home": "Dock", "target": "End", "speed": 60_000}]
    document = {
        "format": "rightofway-scenario/1", "map": {"layout": "plant.xml"},
        "units": {"length": "mm", "time": "min"}, "robots": robots,
    }  # fmt: skip
    roadmap: Roadmap = parse_scenario(document, HERE).roadmap
    edge = roadmap.find_edge(roadmap.get_vertex("Cross"), roadmap.get_vertex("Dock"))
    assert edge is not None
    assert roadmap.get_edge_class(edge).length == 4000  # [mm]
    assert roadmap.get_edge_class(edge).max_speed == 18_000  # [mm/min]


@pytest.mark.parametrize(
    ("home", "shape"),
    [
        ("P1", {"layout": "hall.lif.json", "vehicle_type": "tugger"}),
        ("dock", {"layout": "hall.nav.yaml", "level": "L1"}),
        ("Dock", {"layout": "plant.xml"}),
        ("a", {"layout": "hall.graphml", "spacing": 1}),
        ("a", {"layout": "hall.graphml"}),
        ("0", {"layout": "route.geojson"}),
        ("dock", {"layout": "nodes.csv"}),
        ("N0", {"layout": "two-rooms.map"}),
        ("N11", {"layout": "room.yaml", "cell_size": "1/2"}),
    ],
)
def test_a_plan_file_needs_no_layout(home: str, shape: dict[str, Any]) -> None:
    scenario = scenario_on(home, home, **shape)
    plan = solve(scenario)
    assert parse_plan(dump_plan(plan)).scenario.roadmap == scenario.roadmap


def test_blocks_and_mutex_groups_are_zones_of_the_roadmap() -> None:
    """The lane of the plant's block is driven both ways: two edges meet at both of its ends."""
    roadmap = scenario_on("Dock", "Saw 1", layout="plant.xml").roadmap
    (zone,) = roadmap.zones
    assert [roadmap.name(vertex) for vertex in zone.vertices] == ["Dock", "Cross"]
    assert len(zone.edges) == 2
    aisle = scenario_on("dock", "shelf", layout="hall.nav.yaml", level="L1").roadmap.zones[0]
    assert aisle.name == "aisle"


def test_a_reference_level_that_is_no_name_counts_as_the_first_level(tmp_path: Path) -> None:
    text = (HERE / "hall.building.yaml").read_text("utf-8")
    path = tmp_path / "hall.yaml"
    path.write_text(text.replace("reference_level_name: L1", "reference_level_name: [L2]"), "utf-8")
    assert read_layout(path) == read_layout(HERE / "hall.building.yaml")


def test_stations_and_parking_places_stay_with_the_plan_of_a_layout() -> None:
    plan = solve(scenario_on("Dock", "Saw 1", layout="plant.xml"))
    again = parse_plan(dump_plan(plan))
    for each in (plan, again):
        roadmap = each.scenario.roadmap
        drawing = roadmap.drawing
        assert [(name, roadmap.name(at)) for name, at in drawing.stations] == [
            ("Socket", "Dock"), ("Saw 1", "End"),
        ]  # fmt: skip
        assert [*map(roadmap.name, drawing.parking)] == ["Dock"]
        assert [*map(roadmap.name, drawing.charging)] == ["Dock"]


def test_a_building_names_its_picture_or_says_that_it_is_missing(tmp_path: Path) -> None:
    """100 pixels are 5 m; the second level is turned by 90 degrees and half as large."""
    text = (HERE / "hall.building.yaml").read_text(encoding="utf-8")
    text = text.replace("  L2:\n", "  L2:\n    drawing: {filename: hall.png}\n")
    path = tmp_path / "hall.building.yaml"
    path.write_text(text, encoding="utf-8")
    missing = read_layout(path)
    assert isinstance(missing, Layout)
    assert missing.get_level("L1").picture is None
    assert "the picture 'hall.png' is missing next to the file" in " ".join(tell_notes(missing))
    (tmp_path.parent / "hall.png").write_bytes(b"")
    path.write_text(text.replace("hall.png", "../hall.png"), encoding="utf-8")
    outside = read_layout(path)
    assert isinstance(outside, Layout)
    assert outside.get_level("L1").picture is None
    path.write_text(text, encoding="utf-8")
    (tmp_path / "hall.png").write_bytes(b"")  # only its name counts here
    found = read_layout(path)
    assert isinstance(found, Layout)
    one, two = (found.get_level(name).picture for name in ("L1", "L2"))
    assert one is not None
    assert two is not None
    assert (one.pixel, one.corner, one.yaw) == (Fraction(1, 20), at(0, 0), Fraction(0))
    # its pixel (50, 10) lies on (0, 0); two to the right in L1 are one down in L2
    assert two.pixel is not None
    assert two.corner is not None
    assert (float(two.pixel), float(two.yaw)) == pytest.approx((0.1, pi / 2))
    assert [float(it) for it in two.corner] == pytest.approx([-1.0, -5.0])
