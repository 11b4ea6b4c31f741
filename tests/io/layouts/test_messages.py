"""What a user is told about layouts: what a file is, what is missing, what to write."""

import json
import re
import time
from pathlib import Path
from typing import Any

import pytest

from rightofway.errors import InputError
from rightofway.io import load, load_either, parse_scenario, read_layout
from rightofway.io.content import LIMIT
from rightofway.io.layouts.xml_tree import parse_xml
from rightofway.io.yaml_text import parse_yaml
from rightofway.site.layout import Layout
from tests.builders.sentences import tell_notes

HERE = Path(__file__).parents[2] / "data" / "layouts"


@pytest.mark.parametrize(
    ("name", "what"),
    [
        ("hall.lif.json", "this is a LIF layout with 4 vertices, 8 lanes and 1 station"),
        ("route.geojson", "this is a Nav2 route graph with 3 vertices and 4 lanes"),
        ("hall.nav.yaml", "an Open-RMF navigation graph with 2 levels, 5 vertices and 6 lanes"),
        ("hall.building.yaml", "an Open-RMF building with 2 levels, 5 vertices and 5 lanes"),
        ("plant.xml", "an openTCS plant model with 3 vertices, 4 lanes and 2 stations"),
        ("hall.graphml", "this is a GraphML graph with 3 vertices and 5 lanes"),
        ("nodes.csv", "this is a CSV pair with 3 vertices and 4 lanes"),
        ("room.yaml", "this is a ROS map of 6 x 4 pixels"),
        ("room.pgm", "this is a picture (give the YAML file beside it"),
    ],
)
@pytest.mark.parametrize("read", [load, load_either])
def test_a_layout_given_as_a_scenario_is_named(read: Any, name: str, what: str) -> None:
    with pytest.raises(InputError, match=re.escape(what)) as caught:
        read(HERE / name)
    if name != "room.pgm":
        assert f"map: {{layout: {name}}}" in str(caught.value)
        assert "rightofway convert" in str(caught.value)


def told(**shape: Any) -> str:
    robots = [{"name": "R1", "home": "A", "target": "A"}]
    document = {"format": "rightofway-scenario/1", "map": shape, "robots": robots}
    with pytest.raises(InputError) as caught:
        parse_scenario(document, HERE)
    return str(caught.value).replace(str(HERE), "")


@pytest.mark.parametrize(
    ("shape", "message"),
    [
        ({"layout": "no.json"}, "map.layout: /no.json: there is no such file (check the path)"),
        (
            {"layout": "hall.lif.json"},
            (
                "map.vehicle_type: lanes differ between vehicle types"
                " (give one of forklift and tugger, or each robot a type)"
            ),
        ),
        (
            {"layout": "hall.lif.json", "vehicle_type": "forklifts"},
            "map.vehicle_type: no vehicle type is named 'forklifts' (did you mean 'forklift'?)",
        ),
        (
            {"layout": "hall.nav.yaml"},
            "map.level: the layout has 2 levels, and a plan stays on one (give one of L1 and L2)",
        ),
        (
            {"layout": "hall.nav.yaml", "level": "L3"},
            "map.level: no level is named 'L3' (give one of L1 and L2)",
        ),
        (
            {"layout": "plant.xml", "cell_size": 1},
            "map.cell_size: is given with a layout of lanes, which needs none (take it out)",
        ),
        (
            {"layout": "room.yaml", "cell_size": 9},
            "map.cell_size: a cell of 9.0 m is larger than the map (give a smaller one)",
        ),
        (
            {"layout": "plant.xml", "y": "up"},
            "map: y is given with a layout, which has its own (take it out)",
        ),
        (
            {"grid": ["."], "level": "L1"},
            "map: level is given with a grid, and is for a layout (take it out)",
        ),
    ],
)
def test_what_does_not_fit_is_told_with_place_and_remedy(
    shape: dict[str, Any], message: str
) -> None:
    assert message in told(**shape).splitlines()


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        (
            "a.json",
            '{"layouts": [{"nodes": [\n{"nodeId": "A", "nodePosition": {"x": "east", "y": 0}}]}]}',
            "a.json:2: layouts[0].nodes[0].nodePosition.x: 'east' is not a number",
        ),
        (
            "a.json",
            '{"layouts": [{"nodes": [{"nodeId": "A", "nodePosition": {"x": NaN, "y": 0}}]}]}',
            "'NaN' is not a number",
        ),
        (
            "a.json",
            (
                '{"layouts": [{"nodes": [{"nodeId": "A", "nodePosition": {"x": 0, "y": 0}}],'
                '\n"edges": [{"startNodeId": "A", "endNodeId": "B"}]}]}'
            ),
            "a.json:2: layouts[0].edges[0]: no vertex is named 'B'",
        ),
        (
            "a.xml",
            "<graphml><graph>\n<node id='a'/></graph></graphml>",
            "a.xml:2: the node 'a' has no coordinates",
        ),
        (
            "a.xml",
            '<!DOCTYPE x [\n<!ENTITY a "aaaa">]><graphml>&a;</graphml>',
            "a.xml:2: the entity 'a' is not allowed",
        ),
        (
            "a.xml",
            '<?xml version="1.0" encoding="klingon"?><graphml><graph/></graphml>',
            "the GraphML graph has no vertex",
        ),
        ("a.xml", "<graphml><graph>", "a.xml:1: this is no XML: no element found"),
        (
            "a.xml",
            "<graphml>" + "<a/>" * 30 + "<b>" + "</graphml>",
            "no XML: mismatched tag at column 135, in '<a/><a/><a/><a/><a/><b></graphml>' (check",
        ),
        (
            "a.yaml",
            "levels: {L1: {vertices: [" + "[0, 0], " * 20 + "}}",
            "did not find expected node content at column 186, in ' [0, 0], [0, 0], [0, 0], }}'",
        ),
        ("a.xml", "<" + "a><" * 200 + "a>", "its elements are more than 64 deep"),
        (
            "a.xml",
            '<model name="old"><point name="A"/></model>',
            (
                "a plant model without a version"
                " (add it; 0.0.2, 0.0.3, 0.0.4, 0.0.5, 6 and 7 are known)"
            ),
        ),
        *[
            (
                "a.xml",
                f'<model version="{version}" name="other"><point name="A"/></model>',
                (
                    f"a plant model of version '{version}'"
                    " (0.0.2, 0.0.3, 0.0.4, 0.0.5, 6 and 7 are known: update rightofway for a newer"
                    " one; save an older one with an openTCS that opens it)"
                ),
            )
            for version in ("0.0.1", "0.0.25", "8.0.0", "60.0.0", "")
        ],
        ("a.xml", '<model version="0.0.2"/>', "the openTCS plant model has no vertex"),
        ("a.xml", "<model><name>robot</name></model>", "an XML file of <model> is no layout"),
        (
            "a.yaml",
            "levels: {L1: {vertices: [[0, 0]], lanes: [[0, -1]]}}",
            "levels.L1.lanes[0][1]: -1 is no vertex (give a number from 0 to 0)",
        ),
        (
            "a.yaml",
            "levels: {L1: {vertices: [[0, 0, 0, A]], lanes: [[0, 0]]}}",
            "has no measurement, so the length of a pixel is not known",
        ),
        (
            "a.yaml",
            "coordinate_system: wgs84\nlevels: {L1: {vertices: [[0, 0, 0, A]]}}",
            "coordinates are 'wgs84' (give the building's navigation graph instead)",
        ),
        (
            "a.yaml",
            "image: no.png\nresolution: 0.1\norigin: [0, 0, 0]\nfree_thresh: 0\noccupied_thresh: 1",
            "a.yaml:1: image: there is no picture 'no.png' beside the file (put it there)",
        ),
        ("a.yaml", "image: a.pgm\nresolution: 0\norigin: [0, 0]", "0 is not positive"),
        ("a.yaml", "a: &a [1]\nb: !!python/tuple [1]", "the tag 'tag:yaml.org,2002:python/tuple'"),
        ("nodes.csv", "name,x,y\nA,0,0\n", "these are nodes without their edges"),
        ("a.txt", "once upon a time", "this is no layout"),
        (
            "a.map",
            "type octile\nheight 1000000000\nwidth 1000000000\nmap\n..",
            "a.map:2: height '1000000000' is no size",
        ),
    ],
)
def test_a_bad_layout_is_refused_with_line_and_remedy(
    tmp_path: Path, name: str, text: str, message: str
) -> None:
    (tmp_path / name).write_text(text, "utf-8")
    with pytest.raises(InputError) as caught:
        read_layout(tmp_path / name)
    assert message in str(caught.value)


@pytest.mark.parametrize(
    ("levels", "lifts", "note"),
    [
        ("L1", "Lift1", "the lift Lift1 is not used, a plan stays on one level"),
        (
            "L1 L2",
            "Lift1 Lift2",
            (
                "the lifts Lift1 and Lift2 are not used, a plan stays on one level:"
                " plan each of L1 and L2 by itself, with level"
            ),
        ),
    ],
)
def test_lifts_of_a_building_are_said_to_be_unused(
    tmp_path: Path, levels: str, lifts: str, note: str
) -> None:
    path = tmp_path / "0.yaml"
    graph = "{vertices: [[0, 0, {}], [1, 0, {}]], lanes: [[0, 1, {}]]}"
    path.write_text(
        "levels:\n"
        + "".join(f"  {name}: {graph}\n" for name in levels.split())
        + "lifts:\n"
        + "".join(f"  {name}: {{position: [0, 0, 0]}}\n" for name in lifts.split()),
        encoding="utf-8",
    )
    found = read_layout(path)
    assert isinstance(found, Layout)
    assert tell_notes(found) == (note,)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("image: room.pgm\norigin: [0, 0, 0]\n", ":1: resolution: is missing (add it)"),
        ('{"metaInformation": {}}', ":1: layouts: is missing (add it)"),
    ],
)
def test_an_incomplete_layout_is_no_scenario_without_a_format(
    tmp_path: Path, text: str, message: str
) -> None:
    file = tmp_path / "hall.yaml"
    file.write_text(text)
    with pytest.raises(InputError, match=re.escape(message)):
        read_layout(file)


def test_a_document_of_another_kind_is_not_told_to_be_a_scenario(tmp_path: Path) -> None:
    file = tmp_path / "order.json"
    file.write_text('{"title": "order"}')
    with pytest.raises(InputError, match="this is no scenario and no known layout"):
        load(file)


def test_a_lane_to_a_vertex_with_a_fault_is_no_further_fault(tmp_path: Path) -> None:
    text = (HERE / "route.geojson").read_text().replace("[0.0", '["here"', 1)
    file = tmp_path / "route.geojson"
    file.write_text(text)
    with pytest.raises(InputError) as caught:
        read_layout(file)
    assert [fault.message for fault in caught.value.faults] == [
        "'here' is not a number (write it like 3, 0.5 or 1/3)"
    ]


AT = {"type": "Point", "coordinates": [0, 0]}
LINE = {"type": "LineString"}


def nav2(*features: tuple[dict[str, Any], dict[str, Any]]) -> str:
    return json.dumps(
        {"features": [{"properties": own, "geometry": geometry} for own, geometry in features]}
    )


def lif(nodes: Any, edges: Any) -> str:
    return json.dumps({"layouts": [{"nodes": nodes, "edges": edges, "stations": []}]})


@pytest.mark.parametrize(
    ("name", "text", "faults"),
    [
        (
            "route.geojson",
            nav2(
                ({"id": 0}, AT),
                ({"id": 0}, AT),
                ({"id": 1}, {"type": "Point", "coordinates": ["east", "north"]}),
                ({"id": 8, "startid": 0, "endid": 1}, LINE),
                ({"id": 9, "startid": 7, "endid": 8}, LINE),
                ({"id": 10, "startid": 0}, LINE),
            ),
            {
                "features[1]": ["a vertex is named '0' already"],
                "features[2].geometry.coordinates[0]": ["'east' is not a number"],
                "features[2].geometry.coordinates[1]": ["'north' is not a number"],
                "features[4]": ["no vertex is named '7'", "no vertex is named '8'"],
                "features[5].properties.endid": ["is missing"],
            },
        ),
        (
            "hall.lif.json",
            lif(
                [
                    {"nodeId": "A", "nodePosition": {"x": 0, "y": 0}},
                    {"nodeId": "A", "nodePosition": {"x": 1, "y": 0}},
                    {"nodeId": "B", "nodePosition": {}},
                ],
                [
                    {"startNodeId": "A", "endNodeId": "B"},
                    {"startNodeId": "Y", "endNodeId": "Z"},
                    {},
                ],
            ),
            {
                "layouts[0].nodes[1]": ["a vertex is named 'A' already"],
                "layouts[0].nodes[2].nodePosition.x": ["is missing"],
                "layouts[0].nodes[2].nodePosition.y": ["is missing"],
                "layouts[0].edges[1]": ["no vertex is named 'Y'", "no vertex is named 'Z'"],
                "layouts[0].edges[2].startNodeId": ["is missing"],
                "layouts[0].edges[2].endNodeId": ["is missing"],
            },
        ),
        (
            "hall.lif.json",
            lif("none", {"A": "B"}),
            {
                "layouts[0].nodes": ["'none' is not a list"],
                "layouts[0].edges": ["a mapping of 1 is not a list"],
            },
        ),
        (
            "hall.lif.json",
            lif([{"nodePosition": {"x": 0, "y": 0}}], [{"startNodeId": "A", "endNodeId": "B"}]),
            {"layouts[0].nodes[0].nodeId": ["is missing"]},  # which may be A or B
        ),
        (
            "0.yaml",
            (
                "levels:\n  L1: {vertices: [[0, x], [a, b]], lanes: [[0, 7], [8, 9]]}\n"
                "  L2: {vertices: 3}"
            ),
            {
                "levels.L1.vertices[0][1]": ["'x' is not a number"],
                "levels.L1.vertices[1][0]": ["'a' is not a number"],
                "levels.L1.vertices[1][1]": ["'b' is not a number"],
                "levels.L1.lanes[0][1]": ["7 is no vertex"],
                "levels.L1.lanes[1][0]": ["8 is no vertex"],
                "levels.L1.lanes[1][1]": ["9 is no vertex"],
                "levels.L2.vertices": ["3 is not a list"],
            },
        ),
    ],
)  # fmt: skip
def test_all_faults_of_a_layout_are_told(
    name: str, text: str, faults: dict[str, list[str]], tmp_path: Path
) -> None:
    (tmp_path / name).write_text(text, "utf-8")
    with pytest.raises(InputError) as caught:
        read_layout(tmp_path / name)
    told = [(fault.place, fault.message.partition(" (")[0]) for fault in caught.value.faults]
    assert sorted(told) == sorted((at, what) for at, each in faults.items() for what in each)


def test_all_faults_of_an_xml_file_are_told(tmp_path: Path) -> None:
    path = tmp_path / "plant.xml"
    path.write_text(
        """<model version="7.0.0">
<point name="A" positionX="0" positionY="0"/>
<point name="A" positionX="1" positionY="0"/>
<point name="B" positionX="east" positionY="north"/>
<path name="p" maxVelocity="1" maxReverseVelocity="0"/>
<path name="q" sourcePoint="B" destinationPoint="Z" maxVelocity="1" maxReverseVelocity="0"/>
<locationType><allowedOperation/></locationType>
</model>"""
    )
    with pytest.raises(InputError) as caught:
        read_layout(path)
    told = [(fault.line, fault.message.partition(" (")[0]) for fault in caught.value.faults]
    assert told == [
        (3, "a vertex is named 'A' already"),
        (4, "'east' is not a number"),
        (4, "'north' is not a number"),
        (5, "is missing"),
        (5, "is missing"),
        (6, "no vertex is named 'Z'"),
    ]


def test_a_building_whose_vertices_are_on_no_lane_says_so(tmp_path: Path) -> None:
    text = (HERE / "hall.building.yaml").read_text("utf-8")
    building = parse_yaml(text, number_keys=True)
    path = tmp_path / "hall.building.yaml"
    for level in building["levels"].values():
        level["lanes"] = []
    count = sum(len(level["vertices"]) for level in building["levels"].values())
    path.write_text(json.dumps(building, default=str), "utf-8")
    message = f"the Open-RMF building has {count} vertices, and none is on a lane"
    with pytest.raises(InputError, match=f"{message} \\(add lanes between them\\)"):
        read_layout(path)


def test_a_layout_that_is_too_long_says_which_variable_lets_it_be_read(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    path = HERE / "hall.graphml"
    length = len(path.read_text(encoding="utf-8"))
    monkeypatch.setenv(LIMIT, str(length - 1))
    with pytest.raises(InputError, match=f"{length} characters.*set {LIMIT}={length} "):
        read_layout(path)
    monkeypatch.setenv(LIMIT, str(length))
    layout = read_layout(path)
    assert isinstance(layout, Layout)
    assert len(layout.levels[0].vertices) == 3
    monkeypatch.setenv(LIMIT, "much")
    with pytest.raises(InputError, match=f"{LIMIT} is 'much' .give a number"):
        read_layout(path)


def test_an_xml_file_of_very_many_elements_says_so_too(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(LIMIT, "400")
    assert len(parse_xml(f"<g>{'<a/>' * 9}</g>").children) == 9
    with pytest.raises(InputError, match=f"more than 10 elements .set {LIMIT}=800 "):
        parse_xml(f"<g>{'<a/>' * 10}</g>")


def test_space_between_elements_costs_no_copy_of_all_that_was_before() -> None:
    """4 MB of it between 20 000 elements: copies took 10 s."""
    began = time.process_time()
    root = parse_xml("<g>" + f"\n{' ' * 200}<a>b<c/>d</a>" * 20_000 + "</g>")
    assert time.process_time() - began < 3
    assert (root.content, root.children[-1].content) == ("", "bd")
