"""What a layout's reader mended, left out or has no use for is named, piece by piece."""

from __future__ import annotations

import copy
import json
import pickle
from collections.abc import Callable
from pathlib import Path
from typing import Any

import networkx as nx  # type: ignore[import-untyped]
import pytest

from rightofway.errors import InputError
from rightofway.facts import Fact, note_pieces
from rightofway.io import read_layout
from rightofway.io.layouts import make_layout_of_graph
from rightofway.report.facts import write_note
from rightofway.report.phrases import to_parts
from rightofway.site.layout import Layout, build_roadmap_of_level
from tests.builders.languages import say
from tests.builders.sentences import tell_notes

HERE = Path(__file__).parents[2] / "data" / "layouts"

Document = dict[str, Any]


def list_notes(text: str, path: Path) -> tuple[str, ...]:
    path.write_text(text, encoding="utf-8")
    found = read_layout(path)
    assert isinstance(found, Layout)
    return tell_notes(found)


def in_lif(change: Callable[[Document], None]) -> str:
    """Return a layout of two nodes, an edge and a station, changed by a function of its level."""
    level: Document = {
        "layoutId": "hall",
        "nodes": [
            {
                "nodeId": name,
                "nodePosition": {"x": x, "y": 0},
                "vehicleTypeNodeProperties": [{"vehicleTypeId": "tugger"}],
            }
            for name, x in (("A", 0), ("B", 5))
        ],
        "edges": [
            {
                "edgeId": "AB",
                "startNodeId": "A",
                "endNodeId": "B",
                "vehicleTypeEdgeProperties": [{"vehicleTypeId": "tugger", "rotationAllowed": True}],
            }
        ],
        "stations": [{"stationId": "Press", "interactionNodeIds": ["B"]}],
    }
    change(level)
    return json.dumps({"layouts": [level]})


def in_nav2(change: Callable[[Document], None]) -> str:
    """Return a route graph of two nodes and an edge, whose properties are changed by id."""
    points: list[Document] = [
        {"properties": {"id": number}, "geometry": {"type": "Point", "coordinates": [number, 0]}}
        for number in (0, 1)
    ]
    line = {"properties": {"id": 9, "startid": 0, "endid": 1}, "geometry": {"type": "LineString"}}
    change({feature["properties"]["id"]: feature["properties"] for feature in (*points, line)})
    return json.dumps({"type": "FeatureCollection", "features": [*points, line]})


def put(*path: Any, **more: Any) -> Callable[[Document], None]:
    """Return a function that adds keys to a part of a document."""

    def change(document: Document) -> None:
        part: Any = document
        for step in path:
            part = part[step]
        part.update(more)

    return change


NODE = ("nodes", 0, "vehicleTypeNodeProperties", 0)
EDGE = ("edges", 0, "vehicleTypeEdgeProperties", 0)
STOP = {"stop": {"type": "stop", "trigger": "NODE"}}
RMF = (
    "levels: {{L1: {{vertices: [[0, 0, {{name: a{0}}}], [5, 0, {{name: b}}]],"
    " lanes: [[0, 1, {{{1}}}]]}}}}"
)
PLANT = (
    '<model version="0.0.2"><point name="A" xPosition="0" yPosition="0" {0}>{1}</point>'
    '<point name="B" xPosition="1000" yPosition="0"/><path name="A --- B" sourcePoint="A"'
    ' destinationPoint="B" maxVelocity="1000" maxReverseVelocity="0" {2}>{3}</path>{4}</model>'
)
GRAPHML = (
    '<graphml><key id="k" attr.name="colour"/><graph><node id="a"><data key="x">0</data>'
    '<data key="y">0</data>{0}</node><node id="b"><data key="x">5</data><data key="y">0</data>'
    '</node><edge source="a" target="b">{1}</edge></graph></graphml>'
)


ARC = {
    "knotVector": [0, 0, 1, 1],
    "controlPoints": [{"x": 0, "y": 0}, {"x": 5, "y": 0}],
    "degree": 1,
}


@pytest.mark.parametrize(
    ("text", "named"),
    [
        (in_lif(put(*NODE, theta=90)), "theta: A"),
        (in_lif(put(*NODE, actions=[{"actionType": "beep"}])), "action beep: A"),
        (in_lif(put("nodes", 1, region="wet")), "region: B"),
        (in_lif(put(*EDGE, rotationAllowed="no")), "rotationAllowed: AB"),
        (in_lif(put(*EDGE, vehicleOrientation=180)), "vehicleOrientation: AB"),
        (
            in_lif(put(*EDGE, vehicleOrientation=0, orientationType="GLOBAL", trajectory=ARC)),
            "vehicleOrientation: AB",
        ),
        (
            in_lif(put(*EDGE, rotationAtStartNodeAllowed="CCW")),
            "rotationAtStartNodeAllowed: AB",
        ),
        (
            in_lif(put(*EDGE, loadRestriction={"unloaded": True, "loaded": False})),
            "loadRestriction: AB",
        ),
        (in_lif(put(*EDGE, maxHeight=2)), "maxHeight: AB"),
        (in_lif(put("stations", 0, stationHeight=1)), "stationHeight: Press"),
        (
            in_lif(put("stations", 0, stationPosition={"x": 5, "y": 1, "theta": 90})),
            "stationPosition.theta: Press",
        ),
        (in_nav2(put(9, operations=STOP)), "operations: 9"),
        (in_nav2(put(0, operations=STOP)), "operations: 0"),
        (in_nav2(put(9, cost=10.0)), "cost: 9"),
        (in_nav2(put(9, metadata={"penalty": 3})), "penalty: 9"),
        (in_nav2(put(1, region="wet")), "region: 1"),
        (RMF.format(", dock_name: d", ""), "dock_name: a"),
        (RMF.format(", is_holding_point: true", ""), "is_holding_point: a"),
        (RMF.format("", "dock_name: d"), "dock_name: a to b"),
        (RMF.format("", "door_name: d"), "door_name: a to b"),
        (
            RMF.format("", "orientation_constraint: forward"),
            "orientation_constraint: a to b",
        ),
        (RMF.format("", "") + "\ndoors: {gate: {map: L1}}", "door: gate"),
        (PLANT.format("", "<property/>", "", "", ""), "property: A"),
        (PLANT.format("", "", 'routingCost="5"', "", ""), "routingCost: A --- B"),
        (
            PLANT.format("", "", "", "<typeMaxVelocity/>", ""),
            "typeMaxVelocity: A --- B",
        ),
        (
            PLANT.format("", "", "", "", '<vehicle name="V1"/>'),
            "vehicle: V1",
        ),
        (GRAPHML.format('<data key="k">red</data>', ""), "colour: a"),
        (GRAPHML.format("", '<data key="k">red</data>'), "colour: a to b"),
    ],
)  # fmt: skip
def test_what_has_no_effect_on_plans_is_named_with_its_piece(
    text: str, named: str, tmp_path: Path
) -> None:
    key, _, piece = named.partition(": ")
    notes = list_notes(text, tmp_path / "layout")
    assert f"{key} has no effect on plans: {piece}" in notes


def test_a_member_of_a_block_that_is_not_there_is_named(tmp_path: Path) -> None:
    block = '<block name="Aisle"><member name="A"/><member name="Z"/></block>'
    (note,) = list_notes(PLANT.format("", "", "", "", block), tmp_path / "plant.xml")
    assert note == "a member of a block is no point and no path, and is left out: Z (Aisle)"


@pytest.mark.parametrize(
    "text",
    [
        in_lif(put()),
        in_lif(put(*EDGE, vehicleOrientation=0, orientationType="TANGENTIAL")),
        in_lif(put(*EDGE, vehicleOrientation=3.1416)),
        in_lif(put(*EDGE, vehicleOrientation=1.5, orientationType="GLOBAL")),
        in_lif(put(*EDGE, rotationAllowed=False, rotationAtEndNodeAllowed="NONE")),
        in_lif(put(*NODE, theta=-1.57)),
        in_lif(put("stations", 0, stationPosition={"x": 5, "y": 1, "theta": 1.5})),
        PLANT.format('vehicleOrientationAngle="90.0"', "", "", "", ""),
        in_lif(put(*EDGE, rotationAtStartNodeAllowed="BOTH", reentryAllowed=True)),
        in_lif(put(*EDGE, loadRestriction={"loaded": True, "unloaded": True})),
        in_nav2(put()),
        in_nav2(put(9, cost=0.0, operations={}, overridable=True)),
        RMF.format("", "speed_limit: 0, dock_name: ''"),
        PLANT.format('vehicleOrientationAngle="NaN" zPosition="0"', "<outgoingPath/>", "", "", ""),
        GRAPHML.format("", ""),
    ],
)
def test_what_asks_for_nothing_is_not_named(text: str, tmp_path: Path) -> None:
    assert list_notes(text, tmp_path / "layout") == ()


def test_columns_and_attributes_without_effect_are_named(tmp_path: Path) -> None:
    (tmp_path / "edges.csv").write_text("from,to,colour\nA,B,red\n")
    notes = list_notes("name,x,y,owner\nA,0,0,me\nB,5,0,\n", tmp_path / "nodes.csv")
    assert notes == (
        "owner has no effect on plans: A",
        "colour has no effect on plans: A to B",
    )
    graph = nx.DiGraph()
    graph.add_node("A", x=0, y=0, owner="me")
    assert tell_notes(make_layout_of_graph(graph)) == ("owner has no effect on plans: A",)


@pytest.mark.parametrize(
    "text",
    [
        in_nav2(put(0, metadata=[1])),
        in_nav2(put(0, metadata="wet")),
        in_lif(put("stations", 0, stationPosition="here")),
        in_lif(put("stations", 0, stationPosition={"theta": "north"})),
        in_lif(put(*NODE, theta="north", actions=[1])),
        RMF.format("", "") + "\ndoors: [gate]",
        RMF.format("", "").replace("lanes:", "doors: {a: b}, lanes:"),
        RMF.format("", "").replace("lanes:", "doors: [gate, [0, 1], [0, 1, {name: 7}]], lanes:"),
    ],
)
def test_what_has_no_effect_may_have_any_shape(text: str, tmp_path: Path) -> None:
    list_notes(text, tmp_path / "layout")


@pytest.mark.parametrize("key", ["nodes", "edges"])
def test_properties_that_are_no_mapping_are_a_fault(key: str, tmp_path: Path) -> None:
    kind = "vehicleTypeNodeProperties" if key == "nodes" else "vehicleTypeEdgeProperties"
    with pytest.raises(InputError, match="5 is not a mapping of keys to values"):
        list_notes(in_lif(put(key, 0, **{kind: [5]})), tmp_path / "layout")


def test_doors_of_a_building_are_named(tmp_path: Path) -> None:
    text = (HERE / "hall.building.yaml").read_text("utf-8")
    door = "doors: [[0, 1, {name: [1, gate], type: [1, hinged]}]]"
    text = text.replace("    lanes:", f"    {door}\n    lanes:", 1)
    notes = list_notes(text, tmp_path / "hall.building.yaml")
    assert "door has no effect on plans: gate" in notes


@pytest.mark.parametrize(
    ("theta", "is_odd"), [(3.14, False), (-3.1416, False), (4, True), (90, True)]
)
def test_an_angle_that_is_not_in_radians_is_named(
    theta: float, is_odd: bool, tmp_path: Path
) -> None:
    note = f"theta is not from -pi to pi (it is in radians): A ({theta})"
    assert (note in list_notes(in_lif(put(*NODE, theta=theta)), tmp_path / "a")) == is_odd
    at = {"x": 0, "y": 0, "theta": theta}
    notes = list_notes(in_lif(put("stations", 0, stationPosition=at)), tmp_path / "a")
    assert (note.replace("A (", "Press (") in notes) == is_odd
    notes = list_notes(in_lif(put(*EDGE, vehicleOrientation=theta)), tmp_path / "a")
    edge = f"vehicleOrientation is not from -pi to pi (it is in radians): AB ({theta})"
    assert (edge in notes) == is_odd


@pytest.mark.parametrize(("thetas", "is_noted"), [((1.57, -1.57), True), ((1.57, 1.57), False)])
def test_stations_at_one_node_with_different_angles_are_named(
    thetas: tuple[float, float], is_noted: bool, tmp_path: Path
) -> None:
    stations = [
        {
            "stationId": name,
            "interactionNodeIds": ["B"],
            "stationPosition": {"x": 5, "y": 1, "theta": theta},
        }
        for name, theta in zip(("left", "right"), thetas, strict=True)
    ]
    note = "stations at one node differ in theta, and are one place for plans: left and right"
    assert (note in list_notes(in_lif(put(stations=stations)), tmp_path / "a")) == is_noted


def test_vertices_of_one_name_are_named(tmp_path: Path) -> None:
    text = "levels: {L1: {vertices: [[0, 0, {name: d}], [5, 0, {name: d}]], lanes: [[0, 1]]}}"
    (note,) = list_notes(text, tmp_path / "0.yaml")
    assert note == "a vertex has the name of an earlier one, and gets its number: d (v1)"


def test_nodes_of_stations_that_are_not_there_are_named(tmp_path: Path) -> None:
    stations = [
        {"stationId": "Press", "interactionNodeIds": ["B", "Z"]},
        {"stationId": "Saw", "interactionNodeIds": ["Z"]},
        {"stationId": "Press", "interactionNodeIds": ["A"]},
    ]
    assert list_notes(in_lif(put(stations=stations)), tmp_path / "a") == (
        "a vertex of a station or a zone is not on its level and is left out: Z (Press)",
        "a station without a vertex on its level is left out: Saw",
        "a second station of one name is left out: Press",
    )


def test_lanes_to_other_levels_are_named(tmp_path: Path) -> None:
    nodes = [{"nodeId": name, "nodePosition": {"x": x, "y": 0}} for x, name in enumerate("AB")]
    edges = [{"startNodeId": "A", "endNodeId": "B"}]
    layouts = [{"layoutId": "low", "nodes": nodes[:1], "edges": edges, "stations": []},
               {"layoutId": "high", "nodes": nodes[1:], "edges": [], "stations": []}]  # fmt: skip
    path = tmp_path / "hall.lif.json"
    path.write_text(json.dumps({"layouts": layouts}))
    found = read_layout(path)
    assert isinstance(found, Layout)
    (note,) = tell_notes(build_roadmap_of_level(found.get_level("low")))
    assert note == "1 lane to other levels left out: plans stay on one level: A to B"


def test_a_note_shows_five_pieces_and_keeps_all(tmp_path: Path) -> None:
    nodes = [
        {"nodeId": f"N{k}", "nodePosition": {"x": k, "y": 0}, "region": "wet"} for k in range(40)
    ]
    path = tmp_path / "hall.lif.json"
    path.write_text(json.dumps({"layouts": [{"nodes": nodes, "edges": [], "stations": []}]}))
    found = read_layout(path)
    assert isinstance(found, Layout)
    (note,) = found.notes
    assert str(note) == "40 times: region has no effect on plans: N0, N1, N2, N3, N4 and 35 more"
    assert note.kind == "note on pieces"
    assert note.values["names"] == tuple(f"N{k}" for k in range(40))


def test_a_file_of_very_many_unknown_keys_has_a_note_for_each_of_the_first(tmp_path: Path) -> None:
    change = put("nodes", 0, **{f"k{number}": 1 for number in range(200)})
    notes = list_notes(in_lif(change), tmp_path / "a")
    assert len(notes) == 51
    assert notes[-1].startswith("150 times: a further key has no effect on plans: A: 'k50', A:")


def test_a_note_on_pieces_is_copied_and_translated() -> None:
    note = note_pieces(Fact("zone left out"), ["Aisle", "Dock"])
    for again in (copy.deepcopy(note), pickle.loads(pickle.dumps(note))):  # noqa: S301 (our own)
        assert again == note
    sentence = write_note(note)
    left_out = "a zone without vertices and lanes, or with a name twice, is left out"
    assert say(to_parts(sentence)) == sentence == f"{left_out}: Aisle and Dock"
