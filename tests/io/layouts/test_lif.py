"""LIF 2.0.0: origins, several series of robots with one set of properties, new names of keys."""

from __future__ import annotations

import json
from fractions import Fraction
from pathlib import Path
from typing import Any

from rightofway.io.layouts import read_layout
from rightofway.site.layout import Layout


def properties(*series: str, **more: Any) -> dict[str, Any]:
    types = [{"manufacturer": "A", "seriesName": name} for name in series]
    return {"mobileRobotTypes": types, **more}


def node(name: str, x: float, *own: dict[str, Any]) -> dict[str, Any]:
    at = {"x": x, "y": 0.0}
    return {"nodeId": name, "nodePosition": at, "mobileRobotTypeNodeProperties": list(own)}


def edge(tail: str, head: str, *own: dict[str, Any]) -> dict[str, Any]:
    ends = {"edgeId": tail + head, "startNodeId": tail, "endNodeId": head}
    return {**ends, "mobileRobotTypeEdgeProperties": list(own)}


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
    assert found.notes == ()
