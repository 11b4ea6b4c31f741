"""LIF 2.0.0: origins, several series of robots with one set of properties, new names of keys."""

from __future__ import annotations

import json
from fractions import Fraction
from itertools import product
from math import pi
from pathlib import Path
from typing import Any

import pytest

from rightofway import FleetBuilder
from rightofway.io import format_layout, parse_scenario
from rightofway.io.layouts import read_layout
from rightofway.model import PlaceActions, StopAction
from rightofway.site import VertexId
from rightofway.site.layout import Layout, build_roadmap_of_level
from tests.builders.sentences import tell_notes


def properties(*series: str, **more: Any) -> dict[str, Any]:
    types = [{"manufacturer": "A", "seriesName": name} for name in series]
    return {"mobileRobotTypes": types, **more}


def node(name: str, x: float, *own: dict[str, Any]) -> dict[str, Any]:
    at = {"x": x, "y": 0.0}
    return {"nodeId": name, "nodePosition": at, "mobileRobotTypeNodeProperties": list(own)}


def edge(tail: str, head: str, *own: dict[str, Any]) -> dict[str, Any]:
    ends = {"edgeId": tail + head, "startNodeId": tail, "endNodeId": head}
    return {**ends, "mobileRobotTypeEdgeProperties": list(own)}


LIMITS = ("absent", None, 0.5, 1)


def list_own(first: object, other: object) -> list[dict[str, Any]]:
    """Return what an edge has for the types A and B: a speed limit, none, or no place for it."""
    return [
        properties(name, **({} if limit is None else {"maximumSpeed": limit}))
        for name, limit in (("A", first), ("B", other))
        if limit != "absent"
    ]


def test_each_type_of_a_mixed_fleet_drives_as_a_fleet_of_this_type_does(tmp_path: Path) -> None:
    """Every pair of parallel edges with every limit of two types, each between own vertices."""
    nodes, edges = list[dict[str, Any]](), list[dict[str, Any]]()
    for k, limits in enumerate(product(LIMITS, repeat=4)):
        nodes += [node(f"N{k}", 10 * k), node(f"M{k}", 10 * k + 6)]
        for own in (limits[:2], limits[2:]):
            if own != ("absent", "absent"):  # which is free for all
                edges.append(edge(f"N{k}", f"M{k}", *list_own(*own)))
    path = tmp_path / "hall.lif.json"
    path.write_text(json.dumps({"layouts": [{"layoutId": "L", "nodes": nodes, "edges": edges}]}))
    layout = read_layout(path)
    assert isinstance(layout, Layout)
    mixed = build_roadmap_of_level(layout.get_level(), robot_types={"A", "B"}).roadmap
    for name in "AB":
        alone = build_roadmap_of_level(layout.get_level(), vehicle_type=name).roadmap
        ways = [
            {
                f"{roadmap.name(tail)} {roadmap.name(head)}": kind.compute_duration(
                    Fraction(2), name
                )
                for tail in range(roadmap.n_vertices)
                for edge in range(roadmap.indptr[tail], roadmap.indptr[tail + 1])
                for head in [int(roadmap.heads[edge])]
                for kind in [roadmap.get_edge_class(edge)]
                if not kind.is_barred(name, Fraction(0))
            }
            for roadmap in (alone, mixed)
        ]
        assert ways[0] == ways[1]
        assert len(ways[0]) == 16 * 15  # all pairs but those in which the type is absent twice


@pytest.mark.parametrize(
    ("own", "notes"),
    [
        ([[("A", 1), ("B", 0.5)]], ()),
        (
            [[("A", 1)], [("A", 0.5)]],
            ("1 parallel lane left out: the slowest of each counts: N to M",),
        ),
    ],
)
def test_a_lane_is_left_out_only_where_a_type_has_two(
    tmp_path: Path, own: list[list[tuple[str, float]]], notes: tuple[str, ...]
) -> None:
    edges = [
        edge("N", "M", *(properties(name, maximumSpeed=speed) for name, speed in each))
        for each in own
    ]
    path = tmp_path / "hall.lif.json"
    level = {"layoutId": "L", "nodes": [node("N", 0), node("M", 6)], "edges": edges}
    path.write_text(json.dumps({"layouts": [level]}))
    layout = read_layout(path)
    assert isinstance(layout, Layout)
    types = {name for each in own for name, _ in each}
    assert tell_notes(build_roadmap_of_level(layout.get_level(), robot_types=types)) == notes


def test_version_2_is_read(tmp_path: Path) -> None:
    charge = properties("S1", feasibleActions=[{"actionType": "startCharging"}])
    ground = {
        "layoutId": "ground",
        "nodes": [node("N1", 0, charge), node("N2", 5), node("N3", 9)],
        "edges": [
            edge("N1", "N2", properties("S1", "S2", maximumSpeed=1.5)),
            edge("N2", "N3", properties("S2")),
        ],
        "stations": [{"stationId": "Dock", "interactionNodeIds": ["N3"]}],
    }
    upper = {"layoutId": "upper", "nodes": [node("U1", 0)], "edges": [], "stations": []}
    path = tmp_path / "hall.lif.json"
    origins = [{"originId": "O1", "layouts": [ground]}, {"originId": "O2", "layouts": [upper]}]
    path.write_text(json.dumps({"origins": origins}), encoding="utf-8")
    found = read_layout(path)
    assert isinstance(found, Layout)
    assert [level.name for level in found.levels] == ["ground", "upper"]
    level = found.levels[0]
    assert [vertex.is_charging for vertex in level.vertices] == [True, False, False]
    assert [sorted(lane.types or ()) for lane in level.edges] == [["S1", "S2"], ["S2"]]
    assert [lane.max_speed for lane in level.edges] == [Fraction(3, 2), None]
    assert [station.name for station in level.stations] == ["Dock"]
    assert tell_notes(found) == ()


def test_headings_and_orientations_are_read_and_written(tmp_path: Path) -> None:
    """Those of nodes count before those of stations; types of robots may differ in one."""

    def node(name: str, x: float, *thetas: float) -> dict[str, Any]:
        own = [{"vehicleTypeId": str(k), "theta": theta} for k, theta in enumerate(thetas)]
        place = {"nodeId": name, "nodePosition": {"x": x, "y": 0}}
        return place | {"vehicleTypeNodeProperties": own or [{"vehicleTypeId": "0"}]}

    def edge(tail: str, head: str, **own: Any) -> dict[str, Any]:
        properties = [{"vehicleTypeId": name, "rotationAllowed": True} | own for name in "01"]
        ends = {"edgeId": tail + head, "startNodeId": tail, "endNodeId": head}
        return ends | {"vehicleTypeEdgeProperties": properties}

    layout = {
        "layoutId": "hall",
        "nodes": [node("A", 0, pi / 2, pi / 2), node("B", 5), node("C", 9, 0, pi)],
        "edges": [
            edge("A", "B", vehicleOrientation=0.0),
            edge("B", "A", vehicleOrientation=pi),
            edge("B", "C", vehicleOrientation=1.0, orientationType="GLOBAL"),
        ],
        "stations": [
            {
                "stationId": "Press",
                "interactionNodeIds": ["A", "B"],
                "stationPosition": {"x": 5, "y": 1, "theta": -pi / 2},
            }
        ],
    }
    path = tmp_path / "hall.lif.json"
    path.write_text(json.dumps({"layouts": [layout]}), "utf-8")
    found = read_layout(path)
    assert isinstance(found, Layout)
    (level,) = found.levels
    assert {vertex.name: vertex.heading for vertex in level.vertices} == {
        "A": 90,
        "B": -90,
        "C": None,
    }
    relative = {ends: round(float(angle), 3) for ends, angle in level.orientations.items()}
    assert relative == {("A", "B"): 0, ("B", "A"): 180, ("B", "C"): 57.296}, "C lies to the east"
    notes = tell_notes(found)
    assert "theta has no effect on plans: C" in notes
    assert len(notes) == 1
    text, left_out = format_layout(found, "lif")
    assert not left_out
    path.write_text(text, "utf-8")
    again = read_layout(path)
    assert isinstance(again, Layout)
    assert again.levels[0].orientations == level.orientations
    assert again.levels[0].vertices == level.vertices


PICK = {
    "actionType": "pick",
    "requirementType": "CONDITIONAL",
    "blockingType": "SOFT",
    "actionDescription": "from the belt",
    "actionParameters": [{"key": "height", "value": 0.4}, {"key": "side", "value": "left"}],
}


def test_picks_and_drops_of_nodes_are_actions_of_places_that_a_scenario_replaces(
    tmp_path: Path,
) -> None:
    drop = {"actionType": "drop", "blockingType": "HARD"}
    other = {"actionType": "drop", "blockingType": "NONE"}
    types = [properties("A", actions=[PICK, drop]), properties("B", actions=[PICK, other])]
    nodes = [node("N", 0, *types), node("M", 6, properties("A", actions=[drop]))]
    level = {"layoutId": "L", "nodes": nodes, "edges": [edge("N", "M"), edge("M", "N")]}
    path = tmp_path / "hall.lif.json"
    path.write_text(json.dumps({"layouts": [level]}))
    layout = read_layout(path)
    assert isinstance(layout, Layout)
    assert "action drop has no effect on plans: N" in tell_notes(layout)
    pick = StopAction(
        action="pick",
        parameters={"height": 0.4, "side": "left"},  # type: ignore[arg-type]
        blocking="soft",
        description="from the belt",
    )
    usual = StopAction(action="drop")
    fleet = FleetBuilder(layout=layout).add_robot("R1", home="N")
    fleet.add_job("J1", pickup="N", dropoff="M")
    assert fleet.build_scenario().actions == (
        PlaceActions(at=VertexId(0), pick=(pick,), drop=(usual,)),
        PlaceActions(at=VertexId(1), drop=(usual,)),
    )
    document = {
        "format": "rightofway-scenario/1",
        "map": {"layout": path.name},
        "robots": [{"name": "R1", "home": "N"}],
        "actions": {"N": {"drop": "lower"}},
        "jobs": [{"name": "J1", "pickup": "N", "dropoff": "M"}],
    }
    first = PlaceActions(at=VertexId(0), pick=(pick,), drop="lower")  # type: ignore[arg-type]
    assert parse_scenario(document, tmp_path).actions[0] == first
    text, _ = format_layout(layout, "lif")
    path.write_text(text)
    again = read_layout(path)
    assert isinstance(again, Layout)
    assert [vertex.actions for vertex in again.levels[0].vertices] == [
        vertex.actions for vertex in layout.levels[0].vertices
    ]


def test_rotations_at_nodes_that_are_forbidden_are_read_and_written(tmp_path: Path) -> None:
    """B is a corner of 90 degrees without rotation: robots drive round it, and do not come back."""

    def edge(tail: str, head: str, **own: Any) -> dict[str, Any]:
        properties = [{"vehicleTypeId": "agv", "rotationAllowed": False} | own]
        ends = {"edgeId": tail + head, "startNodeId": tail, "endNodeId": head}
        return ends | {"vehicleTypeEdgeProperties": properties}

    into, out = "rotationAtEndNodeAllowed", "rotationAtStartNodeAllowed"
    nodes = [
        {"nodeId": name, "nodePosition": {"x": x, "y": y}}
        for name, x, y in (("A", 0, 0), ("B", 5, 0), ("C", 5, 5))
    ]
    lanes = [
        edge("A", "B", **{into: "NONE"}),
        edge("B", "A", **{out: "NONE"}),
        edge("B", "C", **{out: "NONE"}),
        edge("C", "B", **{into: "NONE"}),
    ]
    path = tmp_path / "corner.lif.json"
    path.write_text(json.dumps({"layouts": [{"nodes": nodes, "edges": lanes}]}), "utf-8")
    layout = read_layout(path)
    assert isinstance(layout, Layout)
    roadmap = build_roadmap_of_level(layout.levels[0]).roadmap
    edges = {
        (roadmap.name(tail), roadmap.name(int(roadmap.heads[edge])))
        for tail in range(roadmap.n_vertices)
        for edge in range(int(roadmap.indptr[tail]), int(roadmap.indptr[tail + 1]))
    }
    assert edges == {("A", "B"), ("B", "C"), ("C", "C-B/end"), ("C-B/end", "A")}
    text, left_out = format_layout(layout, "lif")
    assert not left_out
    path.write_text(text, "utf-8")
    again = read_layout(path)
    assert isinstance(again, Layout)
    assert again.levels[0].turns == layout.levels[0].turns
