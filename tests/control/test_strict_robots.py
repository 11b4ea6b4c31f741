"""AGVs that refuse all that is not on their own maps drive plans of unusual, legal site files."""

from __future__ import annotations

import json
import math
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import pytest

from tests.builders import strict_robots
from tests.builders.brokers import MOSQUITTO, Command, Mosquitto, WarmCommand, wait_for
from tests.builders.strict_robots import AgvMap, StrictAgv

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(MOSQUITTO is None, reason="mosquitto is not installed"),
]

PATIENT = ("--time-limit", "30")
"""Options of `plan`, for a busy machine."""

EAST, NORTH = 565123.4567, 5935123.1234
"""The origin of a hall in UTM coordinates [m]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Site:
    """A site, its AGVs and what they have to do.

    Attributes
    ----------
    files
        Contents of its files by name; ``site.yaml`` is the scenario.
    identities
        The content of the file of identities, without serial numbers.
    own_map
        The map of the AGVs.
    homes
        The node of each robot, by its name.
    done
        The nodes and action types that are to be done, in any order.
    options
        More options of `plan`.
    has_nulls
        Whether AGVs send null in optional fields.
    """

    files: dict[str, Any]
    identities: dict[str, Any]
    own_map: AgvMap
    homes: dict[str, str]
    done: list[tuple[str, str]]
    options: tuple[str, ...] = ()
    has_nulls: bool = False


def make_lif_site() -> Site:
    """Return a hall of LIF in UTM coordinates, with null in optional fields and ids for people."""
    at = {
        "1": (0, 0),
        "Tor 1": (8, 0),
        "Lager Süd": (16, 0),
        "002": (0, -6),
        "Übergabe (A)": (8, -6),
        "Neu 3": (24, 0),
    }
    ways = [
        ("1", "Tor 1"),
        ("Tor 1", "Lager Süd"),
        ("002", "Übergabe (A)"),
        ("Übergabe (A)", "Tor 1"),
        ("Lager Süd", "Neu 3"),
    ]
    pick = {
        "actionType": "pick",
        "requirementType": "CONDITIONAL",
        "blockingType": "HARD",
        "actionDescription": None,
        "actionParameters": [{"key": "Höhe", "value": 0.4}],
    }
    drop = {"actionType": "drop", "requirementType": "REQUIRED", "blockingType": "SOFT"}
    of_node = {"Lager Süd": [pick, drop], "Übergabe (A)": [drop]}
    nodes = [
        {"nodeId": name, "nodeName": None, "nodeDescription": None, "mapId": None,
         "nodePosition": {"x": EAST + x, "y": NORTH + y},
         "vehicleTypeNodeProperties": [
             {"vehicleTypeId": "Stapler Ø2", "theta": -math.pi / 2 if name == "Lager Süd" else None,
              "actions": of_node.get(name)}]}
        for name, (x, y) in at.items()
    ]  # fmt: skip
    pairs = [(f"Kante {number} →", ends) for number, ends in enumerate(ways)]
    pairs += [(f"{number}", (head, tail)) for number, (tail, head) in enumerate(ways)]
    edges = [
        {"edgeId": edge_id, "edgeName": None, "startNodeId": tail, "endNodeId": head,
         "vehicleTypeEdgeProperties": [
             {"vehicleTypeId": "Stapler Ø2", "vehicleOrientation": None, "rotationAllowed": True,
              "maxSpeed": None, "loadRestriction": None, "trajectory": None, "actions": None}]}
        for edge_id, (tail, head) in pairs
    ]  # fmt: skip
    stations = [
        {"stationId": "Regal 7/3", "interactionNodeIds": ["Lager Süd"], "stationHeight": None},
    ]
    level = {"layoutId": "Halle Süd", "layoutVersion": "1", "layoutLevelId": None,
             "nodes": nodes, "edges": edges, "stations": stations}  # fmt: skip
    jobs = [
        {"name": "Auftrag 1", "pickup": "Regal 7/3", "dropoff": "Übergabe (A)"},
        {"name": "2", "pickup": "Regal 7/3", "dropoff": "Übergabe (A)", "load_id": "Palette ß"},
    ]
    robots = [{"name": "Stapler 1", "home": "1"}, {"name": "Zwei", "home": "002"}]
    return Site(
        files={
            "Halle Süd.lif.json": {"metaInformation": {"lifVersion": "1.0.0"}, "layouts": [level]},
            "site.yaml": {
                "format": "rightofway-scenario/1",
                "map": {"layout": "Halle Süd.lif.json", "spacing": "whole"},
                "units": {"length": "m", "time": "s"},
                "robots": [{**own, "radius": 0.6, "type": "Stapler Ø2"} for own in robots],
                "jobs": jobs,
            },
        },
        identities={"manufacturer": "Förder GmbH", "map": "Halle Süd", "version": "2.1.0",
                    "frame": {"x": EAST, "y": NORTH}},
        own_map=AgvMap(
            map_id="Halle Süd",
            nodes=at,
            edges={edge_id: [ends] for edge_id, ends in pairs},
            actions={"pick": frozenset({"Höhe"}), "drop": frozenset()},
            turned={"Lager Süd": -math.pi / 2},
        ),
        homes={own["name"]: own["home"] for own in robots},
        done=[("Lager Süd", "pick"), ("Übergabe (A)", "drop")] * 2,
        has_nulls=True,
    )  # fmt: skip


def make_opentcs_site() -> Site:
    """Return a plant in millimetres far from the origin, with operations and transport orders."""
    at = {"Punkt 1": (0, 0), "Säge": (7, 0), "3": (7, -5), "Punkt--4": (0, -5)}
    ways = [("Punkt 1", "Säge"), ("Säge", "3"), ("3", "Punkt--4"), ("Punkt--4", "Punkt 1")]
    points = "".join(
        f'<point name="{name}" positionX="{round(EAST * 1000) + 1000 * x}"'
        f' positionY="{round(NORTH * 1000) + 1000 * y}" positionZ="0"'
        f' vehicleOrientationAngle="{"180.0" if name == "Säge" else "NaN"}" type="HALT_POSITION"/>'
        for name, (x, y) in at.items()
    )
    paths = "".join(
        f'<path name="{tail} --- {head}" sourcePoint="{tail}" destinationPoint="{head}" length="1"'
        ' maxVelocity="900" maxReverseVelocity="300" locked="false"/>'
        for tail, head in ways
    )
    kind = "".join(
        f'<allowedOperation name="{name}"/>' for name in ("Sägen", "Bohren", "Laden: load", "NOP")
    )
    plant = (
        '<?xml version="1.0" encoding="UTF-8"?>'
        f'<model version="6.1.0" name="Werk Ä">{points}{paths}'
        f'<locationType name="Maschine">{kind}</locationType>'
        '<locationType name="Ablage"><allowedOperation name="Unload cargo"/></locationType>'
        '<location name="Säge 1" positionX="0" positionY="0" type="Maschine"><link point="Säge"/>'
        '</location><location name="Ablage &amp; Ende" type="Ablage"><link point="3"/></location>'
        "</model>"
    )

    def go(*stops: tuple[str, str]) -> dict[str, Any]:
        return {"destinations": [{"locationName": at, "operation": what} for at, what in stops]}

    orders = {
        "TOrder-01": go(("Säge 1", "Laden: load"), ("Ablage & Ende", "Unload cargo")),
        "TOrder-02": go(("Säge 1", "Bohren")),
    }
    robots = [{"name": "Vehicle-01", "home": "Punkt 1"}, {"name": "Vehicle 2", "home": "Punkt--4"}]
    ids = {f"{tail} --- {head}": [(tail, head), (head, tail)] for tail, head in ways}
    return Site(
        files={
            "plant.xml": plant,
            "orders.json": orders,
            "site.yaml": {
                "format": "rightofway-scenario/1",
                "map": {"layout": "plant.xml", "spacing": "whole"},
                "units": {"length": "m", "time": "s"},
                "robots": [{**own, "radius": 0.5, "speed": 2} for own in robots],
            },
        },
        identities={"manufacturer": "acme", "version": "2.0.0",
                    "frame": {"x": 565123.457, "y": 5935123.123, "yaw": math.pi / 2}},
        own_map=AgvMap(
            map_id="map",
            nodes={name: (y, -x) for name, (x, y) in at.items()},
            edges=ids,
            actions={name: frozenset() for name in ("Bohren", "Laden: load", "Unload cargo")},
            turned={"Säge": math.pi / 2},
        ),
        homes={own["name"]: own["home"] for own in robots},
        done=[("Säge", "Laden: load"), ("3", "Unload cargo"), ("Säge", "Bohren")],
        options=("--jobs", "orders.json"),
    )  # fmt: skip


def make_yaml_site() -> Site:
    """Return a roadmap in millimetres whose y grows downwards, with actions of stops."""
    at = {"1": (0, 0), "2": (9, 0), "ä ö": (9, 4), "N3": (18, 0)}
    vertices = {
        name: {"at": [1_000_000 + 1000 * x, -2_000_000 + 1000 * y], "heading": 90}
        if name == "N3" else [1_000_000 + 1000 * x, -2_000_000 + 1000 * y]
        for name, (x, y) in at.items()
    }  # fmt: skip
    edges = [
        {"from": "1", "to": "2", "id": "weg/1"},
        {"from": "2", "to": "ä ö", "id": "12", "max_speed": 500},
        {"from": "2", "to": "N3"},
    ]
    scan = {"action": "scan", "parameters": {"mode": "schnell"}}
    robots: list[dict[str, Any]] = [
        {"name": "R1", "home": "1", "stops": [{"at": "N3", "work": 5, "actions": [scan, "beep"]}]},
        {"name": "R2", "home": "ä ö", "target": "2", "work": 2},
    ]
    named = {"weg/1": ("1", "2"), "12": ("2", "ä ö")}
    ends = {name: [pair, pair[::-1]] for name, pair in named.items()}
    return Site(
        files={
            "site.yaml": {
                "format": "rightofway-scenario/1",
                "map": {"roadmap": {"vertices": vertices, "edges": edges}, "spacing": "whole"},
                "units": {"length": "mm", "time": "s"},
                "robots": [{**own, "radius": 600, "speed": 1200} for own in robots],
            },
        },
        identities={"manufacturer": "A B", "version": "3.0.0", "map": "0", "work": "wash",
                    "frame": {"x": 1000, "y": 2000}},
        own_map=AgvMap(
            map_id="0",
            nodes={name: (x, -y) for name, (x, y) in at.items()},
            edges={**ends, "2-N3": [("2", "N3")], "N3-2": [("N3", "2")]},
            actions={"scan": frozenset({"mode"}), "beep": frozenset(), "wash": frozenset()},
            turned={"N3": -math.pi / 2},
        ),
        homes={own["name"]: own["home"] for own in robots},
        done=[("N3", "scan"), ("N3", "beep"), ("2", "wash")],
    )  # fmt: skip


SITES = {"lif": make_lif_site(), "opentcs": make_opentcs_site(), "yaml": make_yaml_site()}


@pytest.fixture
def broker(tmp_path: Path) -> Iterator[Mosquitto]:
    made = Mosquitto(tmp_path)
    yield made
    made.kill()


class Hall:
    """A plan of a site in a folder, and its AGVs at a broker."""

    def __init__(self, site: Site, folder: Path, broker: Mosquitto) -> None:
        self.site, self.folder, self.broker = site, folder, broker
        for name, content in site.files.items():
            text = content if isinstance(content, str) else json.dumps(content, ensure_ascii=False)
            (folder / name).write_text(text, encoding="utf-8")
        serials = {name: f"Nr. {number}" for number, name in enumerate(site.homes)}
        robots = {name: {"serial": serial} for name, serial in serials.items()}
        document = {"format": "rightofway-identities/1", **site.identities, "robots": robots}
        (folder / "agv.json").write_text(json.dumps(document), encoding="utf-8")
        planned = Command(folder, "plan", "site.yaml", *site.options, *PATIENT, "-o", "plan.json")
        assert planned.wait(60) == 0, planned.log
        self.agvs = list[StrictAgv]()
        for name, home in site.homes.items():
            self.add_agv(serials[name], home)

    def add_agv(self, serial: str, node: str) -> None:
        """Switch an AGV on at a node."""
        of_site = self.site.identities
        identity = (of_site["manufacturer"], serial, of_site["version"])
        own_map, nulls = self.site.own_map, self.site.has_nulls
        self.agvs.append(StrictAgv(self.broker.port, identity, own_map, node, has_nulls=nulls))

    def drive(self) -> WarmCommand:
        """Return a control that drives the plan."""
        options = ("--broker", self.broker.url, "--identities", "agv.json")
        return WarmCommand(self.folder, "drive", "plan.json", *options)

    def close(self) -> None:
        """Switch the AGVs off."""
        for agv in self.agvs:
            agv.close()

    @property
    def faults(self) -> list[str]:
        """What AGVs have refused."""
        return [fault for agv in self.agvs for fault in agv.faults]

    @property
    def done(self) -> Counter[tuple[str, str]]:
        """Nodes and types of the actions that AGVs have done."""
        return Counter(step for agv in self.agvs for step in agv.done)


@pytest.mark.parametrize("site", SITES.values(), ids=SITES)
def test_a_strict_agv_refuses_nothing(site: Site, tmp_path: Path, broker: Mosquitto) -> None:
    hall = Hall(site, tmp_path, broker)
    try:
        with hall.drive().running() as drive:
            assert drive.wait(60) == 0, drive.log
    finally:
        hall.close()
    assert hall.faults == [], drive.log
    assert hall.done == Counter(site.done)


@pytest.mark.parametrize("version", ["2.0.0", "2.1.0", "3.0.0"])
def test_a_strict_agv_joins_a_control_that_is_killed(
    version: str, tmp_path: Path, broker: Mosquitto, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It is killed before it reads the command, directly after it, and after the AGV has joined.

    The others drive so slowly that they are on their way until then: a drive ends with them.
    """
    monkeypatch.setattr(strict_robots, "PAUSE", 0.2)
    site = SITES["lif"]
    hall = Hall(replace(site, identities={**site.identities, "version": version}), tmp_path, broker)
    ways = ("--from", "Regal 7/3", "--to", "Übergabe (A)")

    def ask(*words: str) -> None:
        asked = Command(tmp_path, "jobs", "plan.journal", *words, "--wait", "0")
        assert asked.wait(60) in {0, 3}, asked.log
        asked.said.unlink()

    try:
        with hall.drive().running() as drive:
            wait_for(lambda: "sets out" in drive.log, 60, "robots")
            drive.kill()
            ask("join", "Dritter", "--serial", "Nr. 2", "--at", "Neu 3")
            for number in range(2):
                ask("add", f"Neu {number}", *ways, "--robot", "Dritter")
            drive.start()
            wait_for(lambda: "Dritter joins at Neu 3" in drive.log, 60, "the command")
            drive.kill()
            hall.add_agv("Nr. 2", "Neu 3")
            drive.start()
            wait_for(lambda: "Dritter has joined" in drive.log, 60, "the AGV")
            drive.kill()
            drive.start()
            assert drive.wait(90) == 0, drive.log
    finally:
        hall.close()
    assert hall.faults == [], drive.log
    assert hall.done == Counter(
        [*site.done, *(2 * [("Lager Süd", "pick"), ("Übergabe (A)", "drop")])]
    )
    assert hall.agvs[2].done == 2 * [("Lager Süd", "pick"), ("Übergabe (A)", "drop")]
