"""Actions at stops: whose they are, how they are sent, when a stop is done, loads."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

import rightofway
from rightofway.control import FleetControl, Order, SimulatedRobot
from rightofway.control.demo import drive_demo
from rightofway.control.endpoints import Letter
from rightofway.control.identities import Identity, load_identities
from rightofway.control.order_map import OrderMap
from rightofway.control.routes import make_routes_to_drive
from rightofway.control.stop_actions import ActionToDo, StopActions, is_further_action
from rightofway.control.vda5050 import Header, OrderMessage, write_message
from rightofway.dispatch.pool import Pool
from rightofway.io import parse_scenario
from rightofway.model import StopAction
from rightofway.precedence import ReleaseGraph
from tests.builders.chaos import MemoryJournal
from tests.builders.floor_jobs import floor_document
from tests.builders.plans import door
from tests.builders.schemas import validator

SCAN: dict[str, Any] = {"action": "scan", "parameters": {"code": "A 7", "limits": {"near": 0.25}},
        "blocking": "single", "retriable": True, "description": "reads the label"}  # fmt: skip


def document_with_actions() -> dict[str, Any]:
    """Return the floor: J1 has actions and a load, N12 those of a place, the others none."""
    document = floor_document()
    first = document["jobs"][0]
    first |= {"load_id": "L-1", "load_type": "EPAL", "pickup_actions": [SCAN, "pick"]}
    document["actions"] = {"N12": {"pick": ["lift", "check"]}, "N10": {"pick": "never"}}
    return document


@pytest.mark.parametrize("version", ["2.0.0", "2.1.0", "3.0.0"])
def test_actions_of_stops_and_places_are_done_in_order_and_valid_by_the_schemas(
    version: str,
) -> None:
    schemas = {name: validator(version, name) for name in ("order", "instantActions", "state")}
    kinds, loads = dict[str, list[str]](), list[list[Any]]()

    def look(letter: Letter) -> None:
        message = json.loads(letter.payload)
        schemas[letter.name].validate(message)
        if letter.name == "state" and message["serialNumber"] == "robot0":
            loads.append(message["loads"])
        for node in message.get("nodes", ()):
            for action in node["actions"]:
                name = action["actionType"]
                if name not in {"startCharging", "stopCharging"}:
                    known = kinds.setdefault(node["nodeId"], [])
                    known += [name] if name not in known else []

    plan = rightofway.solve(parse_scenario(document_with_actions()), "prioritized")
    result = drive_demo(plan, version=version, watch=look)
    assert result.jobs == (1, 2)
    assert kinds == {"N10": ["scan", "pick"], "N2": ["drop"], "N12": ["lift", "check"],
                     "N3": ["drop"], "N14": ["rightofway.job"]}  # fmt: skip
    assert loads[0] == loads[-1] == []
    assert [{"loadId": "L-1", "loadType": "EPAL"}] in loads


def test_a_stop_in_a_further_direction_has_the_actions_of_the_stop() -> None:
    """Robots may not turn at V; one comes to it from the side from which fewer lanes lead on."""
    vertices = {"A": [0, 0], "V": {"at": [4, 0], "turning": False}, "B": [8, 0]}
    stops = [{"at": "V", "work": 1, "actions": ["scan"]}, {"at": "A"}]
    document = {
        "format": "rightofway-scenario/1",
        "map": {"roadmap": {"vertices": vertices, "edges": [["A", "V"], ["V", "B"]]}},
        "robots": [{"name": "R1", "home": "B", "stops": stops}],
        "rules": {"return": "none"},
    }
    done = set[tuple[str, str]]()

    def look(letter: Letter) -> None:
        for node in json.loads(letter.payload).get("nodes", ()):
            done.update((node["nodeId"], action["actionType"]) for action in node["actions"])

    plan = rightofway.solve(parse_scenario(document))
    assert "".join(map(plan.scenario.roadmap.name, plan.tracks[0].vertices)) == "BB-V/endA"
    drive_demo(plan, watch=look)
    assert ("V", "scan") in done


def test_a_stop_has_its_own_actions_else_those_of_its_place_else_the_usual_one() -> None:
    scenario = parse_scenario(document_with_actions())
    find = StopActions(scenario, Pool).find
    own = find(0, "N10", "J1/0")
    assert [task.action and task.action.action for task in own] == ["scan", "pick"]
    assert own[0].load == {"loadId": "L-1", "loadType": "EPAL"}
    assert [task.action and task.action.action for task in find(1, "N12", "J3/0")] == [
        "lift",
        "check",
    ]
    assert find(0, "N2", "J1/1") == (ActionToDo(use="drop", load=own[0].load),)
    assert find(1, "N14", "J2/0") == find(1, "N4", "charge0 end") == (ActionToDo(),)


def test_stops_of_trips_have_actions_too() -> None:
    scenario = parse_scenario(
        {
            "format": "rightofway-scenario/1",
            "map": {"grid": ["...."]},
            "actions": {"N1": {"work": "wash"}, "N3": {"work": "wax"}},
            "robots": [
                {
                    "name": "R1",
                    "home": "N0",
                    "stops": [{"at": "N1"}, {"at": "N3", "actions": "dry"}],
                }
            ],
        }
    )
    find = StopActions(scenario, Pool).find
    actions = [find(0, place, item)[0].action for place, item in (("N1", "job0"), ("N3", "job1"))]
    assert actions == [StopAction(action="wash"), StopAction(action="dry")]


def test_a_trip_that_stops_twice_at_a_place_cannot_have_different_actions() -> None:
    with pytest.raises(rightofway.InputError, match=r"N3 has other actions at an earlier stop"):
        rightofway.FleetBuilder(grid=["...."]).add_robot(
            "R1", home="N0", stops=[("N3", 1, "dry"), "N2", ("N3", 1, "wax")]
        ).build_scenario()


def send_scan(version: str) -> dict[str, Any]:
    """Return the action of an order with the task to scan, for a robot of a version."""
    identity = Identity(manufacturer="A", serial_number="1", version=version)
    order_map = OrderMap(door().scenario, 0, identity)
    order = Order.of_document(
        {
            "robot": 0,
            "order_id": "o",
            "update_id": 0,
            "nodes": [{"place": "N0", "sequence_id": 0, "actions": ["a"]}],
        }
    )
    task = ActionToDo(action=StopAction(**SCAN), load={"loadId": "L"})
    message = OrderMessage.of(order, order_map, {"a": "job0"}, {"a": task.to_document()})
    header = Header(headerId=0, timestamp="", version=version, manufacturer="A", serialNumber="1")  # type: ignore[arg-type]
    action: dict[str, Any] = write_message(message, header)["nodes"][0]["actions"][0]
    return action


def test_versions_before_3_0_have_no_retriable_actions_and_no_single_ones() -> None:
    assert send_scan("3.0.0") == {
        "actionId": "a",
        "actionType": "scan",
        "actionDescriptor": "reads the label",
        "blockingType": "SINGLE",
        "retriable": True,
        "actionParameters": [
            {"key": "code", "value": "A 7"},
            {"key": "limits", "value": {"near": 0.25}},
        ],
    }
    older = send_scan("2.1.0")
    assert older["blockingType"] == "HARD"
    assert older["actionDescription"] == "reads the label"
    assert "retriable" not in older
    oldest = send_scan("2.0.0")["actionParameters"][1]
    assert oldest == {"key": "limits", "value": '{"near": 0.25}'}


TASKS = tuple(ActionToDo(action=StopAction(action=name)) for name in ("lower", "scan", "lift"))


def control_of_door(journal: MemoryJournal) -> FleetControl:
    """Return a control of the door whose stops have three actions; it begins or goes on."""
    plan = door()
    control = FleetControl(journal)
    control.list_actions = lambda *_: TASKS
    if not control.ledger.robots:
        graph = ReleaseGraph.of(plan.scenario, plan.tracks)
        control.begin("run", make_routes_to_drive(plan), graph)
    return control


def drive(
    control: FleetControl, robots: list[SimulatedRobot], steps: int, *, fails: str = ""
) -> list[str]:
    """Have robots drive, and one fail in an action; return all ids of actions that were sent."""
    ids = list[str]()
    messages = [*control.start()]
    for _ in range(steps):
        for message in messages:
            if isinstance(message, Order):
                robots[message.robot].take_order(message)
                ids += [action for node in message.nodes for action in node.actions]
            else:
                robots[message.robot].take_action(message)
        messages = []
        for number, robot in enumerate(robots):
            if not (fails and robot.next_action == fails and robot.fail_work()):
                robot.step()
            messages += control.receive(number, robot.report_state())
    return list(dict.fromkeys(ids))


def test_a_stop_is_done_when_all_its_actions_are() -> None:
    control = control_of_door(MemoryJournal())
    robots = [SimulatedRobot("N0"), SimulatedRobot("N2")]
    ids = [name for name in drive(control, robots, 60) if name.startswith("run-1-")]
    assert ids == ["run-1-job0-1", "run-1-job0-1+1", "run-1-job0-1+2"]
    assert [robots[1].done[name] for name in ids] == [1, 1, 1]
    assert [own.finished for own in control.ledger.robots] == [{"job0"}, {"job0"}]


def test_an_action_that_fails_is_sent_again_without_those_that_are_done() -> None:
    journal = MemoryJournal()
    robots = [SimulatedRobot("N0"), SimulatedRobot("N2")]
    control = control_of_door(journal)
    drive(control, robots, 40, fails="run-1-job0-1+1")
    own = control.ledger.robots[1]
    assert (own.failed, own.finished, own.steps_done) == ({"job0"}, set(), {"job0": [0, 2]})
    # The control is killed, starts again from its journal, and a person has it done again.
    control = control_of_door(journal)
    assert control.ledger.robots[1] == own
    control.note(
        {"kind": "cancel wanted", "robot": 1}, {"kind": "again", "robot": 1, "job": "job0"}
    )
    ids = [name for name in drive(control, robots, 60) if name.startswith("run-1-job0-2")]
    assert ids == ["run-1-job0-2+1"]
    assert robots[1].done["run-1-job0-1"] == 1
    assert [own.finished for own in control.ledger.robots] == [{"job0"}, {"job0"}]


def test_identities_name_the_usual_actions_for_loads(tmp_path: Path) -> None:
    file = tmp_path / "robots.yaml"
    file.write_text(
        "format: rightofway-identities/1\nmanufacturer: ACME\nrobots:\n"
        "  R1: {serial: A-1}\n"
        "  R2: {serial: A-2, work: {action: transfer}}\n"
        "  R3: {serial: A-3, work: dock, pick: {action: lift, parameters: {lhd: 2}}}\n"
    )
    uses: list[Any] = ["work", "pick", "drop"]
    kinds = [
        [identity.find_action("J1/0", use).action for use in uses]
        for identity in load_identities(file, ["R1", "R2", "R3"])
    ]
    assert kinds == [
        ["rightofway.job", "pick", "drop"],
        ["transfer", "transfer", "transfer"],
        ["dock", "lift", "dock"],
    ]


def test_the_first_action_of_a_stop_takes_its_whole_time() -> None:
    ids = ["run-1-J1/0-1", "run-1-J1/0-1+1", "run-1-a+b/0-12+10", "other"]
    assert [is_further_action(name) for name in ids] == [False, True, True, False]
