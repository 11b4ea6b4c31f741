"""Fleet control step by step, on the paper's door: R1 waits in N0 until R2 has left N1."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import pytest

import rightofway
from rightofway.control import (
    FleetControl,
    InstantAction,
    JournalFailed,
    Message,
    Order,
    SimulatedRobot,
    StateReport,
)
from rightofway.control.dispatcher import Dispatcher
from rightofway.control.operator import OPERATIONS
from rightofway.control.routes import make_routes_to_drive
from rightofway.errors import InputError
from rightofway.io import parse_scenario
from rightofway.precedence import Arrival, Part, ReleaseGraph
from tests.builders.chaos import MemoryJournal, chaotic_plan
from tests.builders.floors import Floor
from tests.builders.plans import door


def begun(journal: MemoryJournal | None = None) -> FleetControl:
    """Return a control of the door, started, whose robots have their first orders."""
    plan = door()
    control = FleetControl(journal or MemoryJournal())
    graph = ReleaseGraph.of(plan.scenario, plan.tracks)
    control.begin("run", make_routes_to_drive(plan), graph)
    control.start()
    return control


def state(order: str, update: int, place: str, number: int, nodes: tuple[int, ...]) -> StateReport:
    """Return a state of a robot that has nodes ahead."""
    edges = tuple(node - 1 for node in nodes)
    return StateReport(
        order_id=order,
        update_id=update,
        last_place=place,
        last_sequence_id=number,
        nodes=nodes,
        edges=edges,
    )


def orders(messages: object) -> list[tuple[int, int, list[str]]]:
    """Return robot, update and places of the orders among messages."""
    return [
        (one.robot, one.update_id, [node.place for node in one.nodes])
        for one in messages  # type: ignore[attr-defined]
        if isinstance(one, Order)
    ]


def operate(control: FleetControl, command: str, robot: int) -> list[Message]:
    """Do to a robot what an operator asks for."""
    return control.note({**OPERATIONS[command], "robot": robot})


def test_the_first_order_is_the_vertex_where_the_robot_stands() -> None:
    control = begun()
    assert orders(control.remind()) == [(0, 0, ["N0"]), (1, 0, ["N2"])]


def test_a_robot_gets_as_many_parts_as_are_free_and_no_vertex_twice() -> None:
    """R2 drives N2 N1 N4 N7 N8, works there, and comes back: its base ends at its stop."""
    control = begun()
    sent = control.receive(1, state("run-1-0", 0, "N2", 0, ()))
    assert orders(sent) == [(1, 1, ["N2", "N1", "N4", "N7", "N8"])]
    assert orders(control.receive(0, state("run-0-0", 0, "N0", 0, ()))) == []  # waits for R2


def test_a_robot_waits_for_the_arrival_behind_the_vertex_not_for_its_leaving() -> None:
    control = begun()
    control.receive(0, state("run-0-0", 0, "N0", 0, ()))
    control.receive(1, state("run-1-0", 0, "N2", 0, ()))
    driving = replace(state("run-1-0", 1, "N1", 2, (4, 6, 8)), is_driving=True)
    assert orders(control.receive(1, driving)) == []
    beyond = state("run-1-0", 1, "N4", 4, (6, 8))
    assert orders(control.receive(1, beyond)) == [(0, 1, ["N0", "N1"])]


def test_a_robot_on_hold_gets_nothing_more_until_it_is_let_go() -> None:
    control = begun()
    operate(control, "hold", 1)
    assert orders(control.receive(1, state("run-1-0", 0, "N2", 0, ()))) == []
    assert orders(operate(control, "go", 1)) == [(1, 1, ["N2", "N1", "N4", "N7", "N8"])]


def test_a_robot_with_an_order_of_others_is_faulty_until_a_person_has_looked() -> None:
    told: list[tuple[int, str]] = []
    plan = door()
    control = FleetControl(
        MemoryJournal(), report=lambda robot, fact: told.append((robot, str(fact)))
    )
    graph = ReleaseGraph.of(plan.scenario, plan.tracks)
    control.begin("run", make_routes_to_drive(plan), graph)
    control.start()
    for _ in range(3):
        control.receive(1, state("another", 0, "N2", 0, ()))
    assert len(told) == 1
    assert told[0][0] == 1
    assert "is faulty" in told[0][1]
    assert orders(control.receive(1, state("run-1-0", 0, "N2", 0, ()))) == []
    assert orders(operate(control, "clear", 1)) == [(1, 1, ["N2", "N1", "N4", "N7", "N8"])]


def test_a_robot_taken_off_the_floor_is_in_nobodys_way() -> None:
    control = begun()
    control.receive(0, state("run-0-0", 0, "N0", 0, ()))
    sent = operate(control, "remove", 1)
    assert [order[:2] for order in orders(sent)] == [(0, 1)]


def test_nobody_goes_by_because_of_a_robot_that_was_taken_off_in_between() -> None:
    """At N13 the order is robot 2, robot 3, robot 0, and robot 0 waits for robot 3 only.

    A run of chaos (people, seed 5) found that it went by robot 2 when robot 3 was off the floor.
    """
    dispatcher = Dispatcher(FleetControl(MemoryJournal()), chaotic_plan(5))
    dispatcher.begin("run")
    floor = Floor(dispatcher)
    robots = dispatcher.ledger.robots
    assert robots[2].held == ("N1", "N2", "N7", "N12", "N13")
    floor.send(floor.operator.operate("remove", dispatcher.ledger.names[3]))
    assert robots[0].held == ("N18",)
    floor.drive(80)
    assert [own.is_done for own in robots] == [True, True, True, False]


def test_where_the_journal_cannot_be_written_nothing_is_sent() -> None:
    journal = MemoryJournal()
    control = begun(journal)

    def fail() -> bool:
        raise JournalFailed("the disk is full")

    journal.kill = fail
    with pytest.raises(JournalFailed):
        control.receive(1, state("run-1-0", 0, "N2", 0, ()))
    assert control.ledger.robots[1].released == 0
    journal.kill = lambda: False
    sent = control.receive(1, state("run-1-0", 0, "N2", 0, ()))
    assert orders(sent) == [(1, 1, ["N2", "N1", "N4", "N7", "N8"])]


def test_a_splice_keeps_what_is_released() -> None:
    control = begun()
    control.receive(1, state("run-1-0", 0, "N2", 0, ()))
    routes = make_routes_to_drive(door())
    other = replace(
        routes[1], places=("N2", "N1", *routes[1].places[2:4], "N6", *routes[1].places[5:])
    )
    graph = control.ledger.graph
    with pytest.raises(InputError, match=r"routes\[1\]: the route changes what is released"):
        control.splice([routes[0], other], graph)


def test_a_splice_loses_no_job() -> None:
    control = begun()
    routes = make_routes_to_drive(door())
    idle = replace(routes[0], jobs=((),) * len(routes[0].jobs))
    with pytest.raises(InputError, match=r"routes\[0\]: job0 is in no visit"):
        control.splice([idle, routes[1]], control.ledger.graph)


def test_a_splice_leads_along_no_lane_from_which_a_robot_is_barred() -> None:
    """R1 drives A B C B A; the lane from A to C is barred for it, and none leads from B to D."""
    lanes = [["A", "B"], ["B", "C"], {"from": "A", "to": "C", "barred": ["wide"]}]
    places = {"A": [0, 0], "B": [1, 1], "C": [2, 0], "D": [3, 0]}
    document = {
        "format": "rightofway-scenario/1",
        "map": {"roadmap": {"vertices": places, "edges": lanes}},
        "rules": {"rotations": False},
        "robots": [{"name": "R1", "home": "A", "target": "C", "type": "wide"}],
    }
    plan = rightofway.solve(parse_scenario(document), "prioritized")
    dispatcher = Dispatcher(FleetControl(MemoryJournal()), plan)
    dispatcher.begin("run")
    control, [route] = dispatcher.control, make_routes_to_drive(plan)
    for places_of_other, message in (
        (("A", "C", "B", "A"), r"routes\[0\]: R1 may not drive from A to C"),
        (("A", "B", "D", "A"), r"routes\[0\]: R1 may not drive from B to D"),
        (("A", "E", "A"), r"routes\[0\]: R1 may not drive from A to E"),
    ):
        jobs = ((), ("job0",), *((),) * (len(places_of_other) - 2))
        other = replace(route, places=places_of_other, jobs=jobs)
        graph = ReleaseGraph([len(places_of_other)], {})
        with pytest.raises(InputError, match=message):
            control.splice([other], graph)
    control.splice([route], control.ledger.graph)


def test_a_rotation_is_refused_with_the_way_out() -> None:
    routes = make_routes_to_drive(door())
    circle = {Part(0, 1): [Arrival(1, 1)], Part(1, 1): [Arrival(0, 1)]}
    graph = ReleaseGraph([len(route.places) for route in routes], circle)
    with pytest.raises(InputError, match=r"robot 0, robot 1 move round .* rotations: false"):
        FleetControl(MemoryJournal()).begin("run", routes, graph)


def test_a_withdrawal_that_comes_after_the_next_order_costs_one_more_order() -> None:
    """R2 is reset when it is asked to stop, gets a new order, and the request reaches it then."""
    control, robot = begun(), SimulatedRobot("N2")
    control.receive(0, state("run-0-0", 0, "N0", 0, ()))

    def take(messages: Sequence[Message]) -> list[InstantAction]:
        kept = list[InstantAction]()
        for message in messages:
            if message.robot != 1:
                continue
            if isinstance(message, Order):
                robot.take_order(message)
            elif message.kind == "cancelOrder":
                kept.append(message)  # it is under way for long
            else:
                robot.take_action(message)
        return kept

    take(control.remind())
    take(control.receive(1, robot.report_state()))
    control.receive(1, robot.report_state())
    [late] = take(operate(control, "cancel", 1))
    robot.forget()
    for _ in range(3):
        take([*control.receive(1, robot.report_state()), *control.remind()])
    assert len(control.ledger.robots[1].orders) == 2
    robot.take_action(late)
    for _ in range(40):
        take([*control.receive(1, robot.report_state()), *control.remind()])
        robot.step()
    assert robot.place == "N8"
    assert control.ledger.robots[1].finished == {"job0"}


def test_a_robot_whose_work_has_failed_goes_no_further_and_others_go_on() -> None:
    """R2 fails at N8; R1 follows it through the door and does its own work at N6."""
    told: list[tuple[int, str]] = []
    plan, robots = door(), [SimulatedRobot("N0"), SimulatedRobot("N2")]
    control = FleetControl(
        MemoryJournal(), report=lambda robot, fact: told.append((robot, str(fact)))
    )
    control.begin("run", make_routes_to_drive(plan), ReleaseGraph.of(plan.scenario, plan.tracks))
    messages = [*control.start()]
    for _ in range(60):
        for message in messages:
            if isinstance(message, Order):
                robots[message.robot].take_order(message)
        messages = []
        for number, robot in enumerate(robots):
            if not (number and robot.place == "N8"):
                robot.step()
            said = robot.report_state()
            if number and robot.place == "N8":
                said = replace(said, actions=dict.fromkeys(said.actions, "FAILED"))
            messages += control.receive(number, said)
    assert told == [(1, "has failed in job0: it goes no further")]
    assert robots[1].place == "N8"
    assert control.ledger.robots[0].finished == {"job0"}
    assert robots[0].place == "N6"  # its way back is that of R2
