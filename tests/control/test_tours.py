"""Plans with jobs on the floor: stops in order, times, jobs after others, charges, batteries."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import pytest

import rightofway
from rightofway.control import FleetControl, SqliteJournal
from rightofway.control.battery_watch import BatteryWatch
from rightofway.control.demo import drive_demo
from rightofway.control.dispatcher import Dispatcher
from rightofway.control.endpoints import Letter
from rightofway.control.identities import Identity, load_identities
from rightofway.control.notices import Notices
from rightofway.control.robot_ledger import RobotLedger
from rightofway.control.routes import RouteToDrive
from rightofway.control.vda5050 import StateMessage, read
from rightofway.control.work_items import describe_item, find_charge_step, find_next_number
from rightofway.facts import Fact
from rightofway.io import parse_scenario
from rightofway.report.driving import report_drive
from rightofway.report.quantities import Quantities
from tests.builders.chaos import MemoryJournal
from tests.builders.floor_jobs import driven_actions, floor_document, floor_plan
from tests.builders.floors import Floor
from tests.builders.schemas import validator

STATE = {
    "orderId": "",
    "orderUpdateId": 0,
    "lastNodeId": "N4",
    "lastNodeSequenceId": 0,
    "nodeStates": [],
    "edgeStates": [],
    "actionStates": [],
    "driving": False,
}


def test_each_stop_of_each_job_is_done_once_and_in_its_order() -> None:
    actions, _ = driven_actions(floor_plan())
    work = [(action.node, action.item) for action in actions if "/" in action.item]
    assert sorted(work) == [
        ("N10", "J1/0"), ("N12", "J3/0"), ("N14", "J2/0"), ("N2", "J1/1"), ("N3", "J3/1"),
    ]  # fmt: skip
    items = [action.item for action in actions]
    assert items.index("J1/0") < items.index("J1/1") < items.index("J2/0")
    assert items.index("J3/0") < items.index("J3/1")


def test_work_does_not_begin_before_its_time_though_its_robot_is_there() -> None:
    """J1 is two drives from N0 and may begin at 12: R1 stands at N10 from 2 on."""
    actions, states = driven_actions(floor_plan())
    assert [action.second for action in actions if action.item == "J1/0"] == [12]
    at_place = [
        state["timestamp"][14:19]
        for state in states
        if state["serialNumber"] == "robot0" and state["lastNodeId"] == "N10"
    ]
    assert at_place[0] == "00:02"


def test_a_robot_does_nothing_before_it_is_ready() -> None:
    """R1 is ready at 20; then it gets the order to drive to J1, which might begin at 12."""
    document = floor_document()
    document["robots"][0]["start"] = {"at": "N0", "ready": 20}
    plan = rightofway.solve(parse_scenario(document), "prioritized")
    actions, states = driven_actions(plan)
    assert [action.second for action in actions if action.item == "J1/0"] == [20]
    at_home = [
        state["timestamp"][14:19]
        for state in states
        if state["serialNumber"] == "robot0" and state["lastNodeId"] == "N0" and state["driving"]
    ]
    assert at_home[0] == "00:20"


def test_a_simulated_robot_reports_where_it_heads() -> None:
    """R1 drives from N0 down to N5; y points upwards in frames of robots."""
    _, states = driven_actions(floor_plan())
    own = [state for state in states if state["serialNumber"] == "robot0"]
    at_n5 = next(state for state in own if state["lastNodeId"] == "N5")
    assert at_n5["agvPosition"]["theta"] == pytest.approx(-math.pi / 2)


def test_a_job_after_another_one_begins_when_that_is_done_however_late_it_is() -> None:
    actions, _ = driven_actions(floor_plan(), delays=("stop:R1@2+40",))
    begins = {action.item: action.second for action in actions}
    assert begins["J1/1"] > 40
    assert begins["J2/0"] > begins["J1/1"]


def test_a_charge_begins_and_ends_with_an_action_of_its_own() -> None:
    """R2 has a fifth at N4, where it may charge: it charges before it drives on."""
    actions, states = driven_actions(floor_plan())
    of_second = [(action.kind, action.node) for action in actions if action.robot == 1]
    assert of_second[:2] == [("startCharging", "N4"), ("stopCharging", "N4")]
    own = [state["batteryState"] for state in states if state["serialNumber"] == "robot1"]
    assert own[0]["batteryCharge"] == pytest.approx(20)
    charges = [battery["batteryCharge"] for battery in own]
    first = [battery["charging"] for battery in own].index(True)
    last = first + [battery["charging"] for battery in own[first:]].index(False)
    assert charges[first:last] == sorted(charges[first:last])
    assert charges[last - 1] > charges[first]
    assert charges[last:][5] < charges[last]


def test_the_report_compares_the_end_of_each_job_with_the_plan_and_with_its_due_time() -> None:
    """The order of ends is that of the noted times; the longest delay is in the first row."""
    plan = floor_plan()
    jobs = plan.scenario.jobs or ()
    planned = {
        jobs[item.job].name: item.end
        for tour in plan.tours or () for item in tour if item.job is not None
    }  # fmt: skip
    result = drive_demo(plan, "exponential:0.5", 3)
    assert {job.name: job.planned for job in result.ends} == planned
    ends = [job.ended or 0 for job in result.ends]
    assert ends == sorted(ends)
    assert 0 < ends[0] < ends[-1] <= result.now
    data = result.as_dict()
    assert [row["name"] for row in data["ends"]] == [job.name for job in result.ends]
    lines = report_drive(result, Quantities.of(plan.scenario)).splitlines()
    first = lines.index("end of each job, the latest first") + 2
    delays = {
        job.name: (job.ended or 0) - (job.due if job.due is not None else job.planned or 0)
        for job in result.ends
    }
    assert delays[lines[first].split()[0]] == max(delays.values())
    assert len(lines) == first + len(jobs)


@pytest.mark.parametrize("version", ["2.0.0", "2.1.0", "3.0.0"])
def test_charges_are_valid_by_the_official_schemas(version: str) -> None:
    schemas = {name: validator(version, name) for name in ("order", "instantActions", "state")}
    seen = set[str]()

    def look(letter: Letter) -> None:
        document = json.loads(letter.payload)
        schemas[letter.name].validate(document)
        seen.update(action["actionType"] for node in document.get("nodes", ())
                    for action in node["actions"])  # fmt: skip
        if letter.name == "state":
            key, charge = ("powerSupply", "stateOfCharge") if version == "3.0.0" else (
                "batteryState", "batteryCharge")  # fmt: skip
            assert 0 < document[key][charge] <= 100

    drive_demo(floor_plan(), version=version, watch=look)
    assert seen == {"startCharging", "stopCharging", "rightofway.job", "pick", "drop"}


@pytest.mark.parametrize(
    ("battery", "charge"),
    [
        ({"batteryState": {"batteryCharge": 40, "charging": False}}, 0.4),
        ({"powerSupply": {"stateOfCharge": 40.0, "charging": True}}, 0.4),
        ({"batteryState": {"batteryCharge": "full"}}, None),
        ({"batteryState": {"batteryCharge": 140}}, None),
        ({}, None),
    ],
)
def test_the_charge_of_a_state_is_kept_where_it_can_be_read(
    battery: dict[str, Any], charge: float | None
) -> None:
    state = read(StateMessage, {**STATE, **battery}, "state").to_robot_state()
    assert state.charge == charge


def test_identities_name_the_actions_of_charges(tmp_path: Path) -> None:
    file = tmp_path / "robots.yaml"
    file.write_text(
        "format: rightofway-identities/1\nmanufacturer: ACME\n"
        "start_charging: {action: dock, parameters: {side: left}}\n"
        "robots: {R1: {serial: A-1}, R2: {serial: A-2, stop_charging: {action: undock}}}\n"
    )
    first, second = load_identities(file, ["R1", "R2"])
    assert first.find_action("charge0").action == "dock"
    assert first.find_action("charge0").parameters == (("side", "left"),)
    assert first.find_action("charge0 end").action == "stopCharging"
    assert second.find_action("charge3 end").action == "undock"
    assert second.find_action("job3") == Identity(manufacturer="A", serial_number="1").work


def test_a_control_that_starts_again_knows_the_jobs_and_the_stops_that_are_done(
    tmp_path: Path,
) -> None:
    """Also from a snapshot, which replaces the entries before it."""
    plan, now = floor_plan(), [0]
    roadmap = plan.scenario.roadmap

    def begin(journal: Any) -> Dispatcher:
        dispatcher = Dispatcher(FleetControl(journal, roadmap=roadmap), plan)
        dispatcher.keep_time(lambda: now[0])
        return dispatcher

    journal = SqliteJournal(tmp_path / "run.journal")
    dispatcher = begin(journal)
    dispatcher.begin("run")
    floor = Floor(dispatcher)
    for now[0] in range(30):
        floor.drive(1)
        floor.send(dispatcher.follow_time())
    pool = dispatcher.ledger.pool.to_document(roadmap)
    assert pool["left"], "some jobs are done"
    assert begin(journal).ledger.pool.to_document(roadmap) == pool
    journal.begin_again(dispatcher.ledger.make_snapshot())
    assert begin(journal).ledger.pool.to_document(roadmap) == pool
    journal.close()


def test_items_of_work_have_names_for_people_and_numbers_of_their_own() -> None:
    assert describe_item("job3") == "job3"
    assert str(describe_item("a/b/1")) == "stop 2 of a/b"
    assert [find_charge_step(item) for item in ("charge2", "charge2 end", "charge/0", "job1")] == [
        "begin", "end", None, None,
    ]  # fmt: skip
    assert find_next_number(["J7/0", "job3", "charge11 end", "7"]) == 12
    assert find_next_number([]) == 0


def test_a_route_with_jobs_of_any_name_can_be_taken() -> None:
    """Names of jobs are those of their users: only single stops and charges have numbers."""
    route = RouteToDrive(places=("A", "B"), jobs=((), ("job x/0", "pallet 12/1", "job4")))
    own = RobotLedger(route)
    own.take_route(route)
    assert own.next_job == 5


def test_a_robot_that_reaches_no_charging_place_has_an_alarm_and_gets_no_more() -> None:
    """R1 at N0 may charge there. At N10, two drives away, it needs 2 (1/20 + 1/400) = 10.5 %."""
    plan = floor_plan()
    control = FleetControl(MemoryJournal(), roadmap=plan.scenario.roadmap)
    dispatcher, said = Dispatcher(control, plan), list[Fact]()
    dispatcher.keep_time(lambda: 0)
    dispatcher.begin("run")
    floor = Floor(dispatcher)
    watch = BatteryWatch(plan.scenario, control, Notices(control.ledger.names, said.append))
    floor.drive(10)
    own = control.ledger.robots[0]
    assert own.route.get_place(own.arrived) == "N10"
    seen = []
    for charge in (0.11, 0.10, 0.10, 0.2):
        state = floor.robots[0].report_state(charge=charge)
        control.receive(0, state)
        watch.look()
        seen.append((control.is_fit(0), len(said)))
    assert seen == [(True, 0), (False, 1), (False, 1), (True, 2)]
    assert str(said[0]) == (
        "R1 has 10 % of its charge, and needs 11 % to the nearest charging place:"
        " a person has to charge or move it"
    )


def test_a_robot_that_reports_no_charge_charges_as_long_as_planned() -> None:
    document = floor_document()
    plan = rightofway.solve(parse_scenario(document), "prioritized")
    now = [0]
    control = FleetControl(MemoryJournal(), roadmap=plan.scenario.roadmap)
    dispatcher = Dispatcher(control, plan)
    dispatcher.keep_time(lambda: now[0])
    dispatcher.begin("run")
    floor, ends = Floor(dispatcher), dict[str, int]()
    for now[0] in range(80):
        floor.drive(1)
        floor.send(dispatcher.follow_time())
        for item in control.ledger.robots[1].finished:
            ends.setdefault(item, now[0])
    assert plan.tours is not None
    planned = next(item for item in plan.tours[1] if item.job is None)
    assert ends["charge1 end"] - ends["charge1"] in range(
        planned.end - planned.begin, planned.end - planned.begin + 4
    )
    assert control.is_done
