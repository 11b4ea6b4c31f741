"""Messages of the norm: all that is sent is valid by the official schemas, and states are read."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from fractions import Fraction
from typing import Any, Literal

import pytest

from rightofway import FleetBuilder
from rightofway.control import (
    Condition,
    FleetControl,
    InstantAction,
    Message,
    Order,
    OrderNode,
    RobotError,
    SimulatedRobot,
    StateReport,
)
from rightofway.control.endpoints import LetterWriter, RobotEnd
from rightofway.control.identities import VERSIONS, Identity
from rightofway.control.operator import OPERATIONS
from rightofway.control.order_map import OrderMap, make_order_maps
from rightofway.control.routes import make_routes_to_drive
from rightofway.control.vda5050 import (
    ConnectionMessage,
    Header,
    InstantActions,
    OrderMessage,
    StateMessage,
    read,
    write_message,
)
from rightofway.errors import InputError
from rightofway.io import dump_scenario, parse_scenario
from rightofway.model import Robot, Scenario, Stop
from rightofway.model.turning import find_heading_on_site, list_headings
from rightofway.precedence import ReleaseGraph
from rightofway.site.geometry import Frame
from tests.builders.chaos import MemoryJournal
from tests.builders.plans import door
from tests.builders.schemas import validator


def header(version: str) -> Header:
    """Return the head of a message."""
    return Header(
        headerId=1,
        timestamp="2026-01-31T12:00:00.000Z",
        version=version,  # type: ignore[arg-type]
        manufacturer="maker",
        serialNumber="R1",
    )


def map_of(scenario: Scenario, **identity: Any) -> OrderMap:
    """Return the map of the first robot."""
    return OrderMap(scenario, 0, Identity(manufacturer="maker", serial_number="R1", **identity))


def test_robots_that_share_what_they_have_looked_up_see_their_own_frames_and_speeds() -> None:
    """Of four robots the first and the last see the site alike."""
    one = door().scenario
    stop = Stop(at=one.roadmap.get_vertex("N4"))
    robots = [
        Robot(name=home, home=one.roadmap.get_vertex(home), stops=(stop,), speed=Fraction(speed))
        for home, speed in (("N0", 1), ("N2", 2), ("N6", 1), ("N8", 1))
    ]
    scenario = replace(one, robots=tuple(robots))
    identities = [
        Identity(manufacturer="maker", serial_number=robot.name, frame=Frame(x=Fraction(x)))
        for robot, x in zip(robots, (0, 0, 5, 0), strict=True)
    ]
    names = [scenario.roadmap.name(vertex) for vertex in range(scenario.roadmap.n_vertices)]
    for order_map in make_order_maps(scenario, identities):
        alone = OrderMap(scenario, order_map.robot, order_map.identity)
        for tail in names:
            assert order_map.get_place(tail) == alone.get_place(tail)
            for head in names:
                assert order_map.find_lane(tail, head) == alone.find_lane(tail, head)


def order_over(*places: str) -> Order:
    """Return a new order over places."""
    nodes = tuple(OrderNode(place=p, sequence_id=2 * k) for k, p in enumerate(places))
    return Order(robot=0, order_id="run-0-0", update_id=0, nodes=nodes)


def all_sent() -> list[Message]:
    """Return all that is sent to the robots of the door, with a withdrawal on the way."""
    plan = door()
    control, sent = FleetControl(MemoryJournal()), list[Message]()
    control.begin("run", make_routes_to_drive(plan), ReleaseGraph.of(plan.scenario, plan.tracks))
    robots = [SimulatedRobot(route.places[0]) for route in make_routes_to_drive(plan)]
    fresh = control.start()
    for number in range(300):
        sent += fresh
        for message in fresh:
            robot = robots[message.robot]
            if isinstance(message, Order):
                robot.take_order(message)
            else:
                robot.take_action(message)
        cancel = {**OPERATIONS["cancel"], "robot": 1}
        fresh = control.note(cancel) if number == 5 else control.remind()
        for k, robot in enumerate(robots):
            robot.step()
            fresh += control.receive(k, robot.report_state())
    assert [robot.place for robot in robots] == ["N0", "N2"]
    return sent


@pytest.mark.parametrize("version", VERSIONS)
def test_every_message_is_valid_by_the_official_schemas(version: str) -> None:
    orders, actions = validator(version, "order"), validator(version, "instantActions")
    sent, order_map = all_sent(), map_of(door().scenario, deviation=0.1)
    assert {type(message) for message in sent} == {Order, InstantAction}
    for message in sent:
        if isinstance(message, Order):
            orders.validate(write_message(OrderMessage.of(message, order_map), header(version)))
        else:
            actions.validate(write_message(InstantActions.of(message), header(version)))


def test_work_at_a_stop_is_an_action_that_nothing_else_happens_beside() -> None:
    order_map = map_of(door().scenario)
    document = next(
        write_message(OrderMessage.of(message, order_map), header("2.1.0"))
        for message in all_sent()
        if isinstance(message, Order) and message.nodes[-1].actions
    )
    action = document["nodes"][-1]["actions"][0]
    assert action["blockingType"] == "HARD"
    edges = [(edge["sequenceId"], edge["released"]) for edge in document["edges"]]
    assert edges == [(node["sequenceId"] - 1, True) for node in document["nodes"][1:]]


@pytest.mark.parametrize("repeats_work", [True, False])
def test_an_update_may_leave_out_work_that_is_finished(*, repeats_work: bool) -> None:
    """Some robots would do it twice; a first order has all work that is to be done."""
    order_map = map_of(door().scenario, repeats_work=repeats_work)
    nodes = tuple(
        OrderNode(place=place, sequence_id=2 * k, actions=(f"work{k}",))
        for k, place in enumerate(("N0", "N1"))
    )
    for update in (0, 1):
        order = Order(robot=0, order_id="run-0-0", update_id=update, nodes=nodes)
        document = write_message(OrderMessage.of(order, order_map), header("2.1.0"))
        counts = [len(node["actions"]) for node in document["nodes"]]
        assert counts == [int(repeats_work or update == 0), 1]


def site(**extra: Any) -> Scenario:
    """Return a site in centimetres, with a bend, a split lane and a slow lane; y upwards."""
    return parse_scenario(
        {
            "format": "rightofway-scenario/1",
            "units": {"length": "cm", "time": "s"},
            "map": {
                "roadmap": {
                    "vertices": {"A": [100, 200], "B": [300, 200], "C": [300, 600]},
                    "edges": [
                        {"from": "A", "to": "B", "max_speed": 50, "both_ways": True},
                        {"from": "B", "to": "C", "both_ways": True},
                    ],
                },
                "y": "up",
                **extra,
            },
            "robots": [{"name": "R1", "home": "A", "target": "C", "speed": 100}],
        }
    )


@pytest.mark.parametrize("version", VERSIONS)
def test_nodes_have_their_position_in_the_frame_of_the_robot(version: str) -> None:
    """The origin of the robot's map is at (1, 2) m of the site and turned to the left: A is its
    origin; B, 2 m to the east, lies 2 m to its right."""
    frame = Frame(x=Fraction(1), y=Fraction(2), yaw=Fraction(math.pi / 2))
    order_map = map_of(site(), frame=frame, map_id="hall", deviation=0.05)
    document = write_message(OrderMessage.of(order_over("A", "B"), order_map), header(version))
    validator(version, "order").validate(document)
    first, second = (node["nodePosition"] for node in document["nodes"])
    assert (first["x"], first["y"], first["mapId"]) == (0, 0, "hall")
    assert (second["x"], second["y"]) == pytest.approx((0, -2))
    deviations: dict[str, dict[str, Any]] = {
        "2.0.0": {"allowedDeviationXy": 0.05},
        "2.1.0": {"allowedDeviationXY": 0.05},
        "3.0.0": {"allowedDeviationXY": {"a": 0.05, "b": 0.05, "theta": 0.0}},
    }
    assert deviations[version].items() <= first.items()
    speed = "maximumSpeed" if version == "3.0.0" else "maxSpeed"
    assert (document["edges"][0][speed], document["edges"][0]["length"]) == (0.5, 2.0)


@pytest.mark.parametrize("version", VERSIONS)
def test_orders_name_nodes_of_the_site_where_robots_may_not_turn(version: str) -> None:
    """A robot comes back through B in another direction; 3.0 has no `rotationAllowed`."""
    vertices = {"A": [100, 200], "B": {"at": [300, 200], "turning": False}, "C": [500, 200]}
    edges = [{"from": "A", "to": "B", "turning": False}, ["B", "C"]]
    order_map = map_of(site(roadmap={"vertices": vertices, "edges": edges}))
    order = order_over("C", "C-B/end", "A")
    document = write_message(OrderMessage.of(order, order_map), header(version))
    validator(version, "order").validate(document)
    assert [node["nodeId"] for node in document["nodes"]] == ["C", "B", "A"]
    assert [edge["edgeId"] for edge in document["edges"]] == ["C-B", "B-A"]
    allowed = [edge.get("rotationAllowed") for edge in document["edges"]]
    assert allowed == [None, None if version >= "3" else False]
    assert order_map.list_vertices("B") == ["B", "C-B/end"]


@pytest.mark.parametrize("version", VERSIONS)
def test_headings_and_edge_ids_of_a_layout_are_sent(version: str) -> None:
    """The map of the robot is turned left by a right angle: north on the site is 0 there.

    A robot that passes C, without work there, need not turn. Pieces of a lane have ids of their
    own.
    """
    vertices = {"A": [100, 200], "B": [300, 200], "C": {"at": [300, 600], "heading": 90}}
    back = {"from": "B", "to": "C", "orientation": 180, "both_ways": False, "id": "e2"}
    edges = [{"from": "A", "to": "B", "id": "Gang 1 / ä"}, back]
    scenario = site(roadmap={"vertices": vertices, "edges": edges}, spacing=200)
    assert parse_scenario(dump_scenario(scenario)).roadmap.drawing == scenario.roadmap.drawing
    fleet = FleetBuilder(spacing=200, y="up").add_vertex("A", 100, 200).add_vertex("B", 300, 200)
    fleet.add_vertex("C", 300, 600, heading=90)
    fleet.add_edge("A", "B", edge_id="Gang 1 / ä")
    fleet.add_edge("B", "C", orientation=180, both_ways=False, edge_id="e2")
    assert fleet.build_roadmap().drawing == scenario.roadmap.drawing
    order_map = map_of(scenario, frame=Frame(yaw=Fraction(math.pi / 2)))
    order = order_over("A", "B", "B-C/1", "C")
    passing = write_message(OrderMessage.of(order, order_map), header(version))
    nodes = (*order.nodes[:-1], replace(order.nodes[-1], actions=("work",)))
    works = write_message(OrderMessage.of(replace(order, nodes=nodes), order_map), header(version))
    for document in (passing, works):
        validator(version, "order").validate(document)
        first, *others = document["edges"]
        ids = [edge["edgeId"] for edge in document["edges"]]
        assert ids == ["Gang 1 / ä", "B-B-C/1", "B-C/1-C"]
        assert "orientation" not in first
        assert [edge["orientation"] for edge in others] == pytest.approx([math.pi, math.pi])
    assert not any("theta" in node["nodePosition"] for node in passing["nodes"])
    *before, last = works["nodes"]
    assert not any("theta" in node["nodePosition"] for node in before)
    assert last["nodePosition"]["theta"] == pytest.approx(0)


def test_a_simulated_robot_reports_the_heading_of_its_orders() -> None:
    """It drives east, backwards: it heads west until it works at B in the heading north."""
    vertices = {"A": [100, 200], "B": {"at": [300, 200], "heading": 90}, "C": [300, 600]}
    edges = [{"from": "A", "to": "B", "orientation": 180}, ["B", "C"]]
    order_map = map_of(site(roadmap={"vertices": vertices, "edges": edges}))
    identity, thetas = order_map.identity, []
    for actions in ((), ("work",)):
        end = RobotEnd(SimulatedRobot("A"), 0, identity, lambda: "2026-01-31T12:00:00.000Z")
        order = order_over("A", "B")
        order = replace(order, nodes=(order.nodes[0], replace(order.nodes[1], actions=actions)))
        writer = LetterWriter(lambda: "2026-01-31T12:00:00.000Z")
        end.receive(writer.make_letter(identity, "order", OrderMessage.of(order, order_map)))
        end.report_state()
        while end.robot.step():
            pass
        state = json.loads(end.report_state().payload)
        thetas.append(abs(state["agvPosition"]["theta"]))
    assert thetas == pytest.approx([math.pi, math.pi / 2])


def test_a_site_whose_y_grows_downwards_is_mirrored() -> None:
    """N4 of the door is the middle cell: its centre is 1.5 to the right and 1.5 down."""
    place = map_of(door().scenario).get_place("N4")
    assert place is not None
    assert place.point == (1.5, -1.5)


def test_the_deviation_is_half_the_clearance() -> None:
    """Two robots that are both off by that much towards each other do not touch."""
    assert map_of(door().scenario).deviation is None
    scenario = door().scenario
    robots = tuple(replace(robot, radius=Fraction(1, 4)) for robot in scenario.robots)
    rules = replace(scenario.rules, clearance=Fraction(1, 5), occupancy="both")
    assert map_of(replace(scenario, robots=robots, rules=rules)).deviation == 0.1


@pytest.mark.parametrize("version", VERSIONS)
def test_pieces_of_a_lane_keep_to_its_way(version: str) -> None:
    """A piece is a straight line of degree 1; a whole straight lane leaves its way to the robot."""
    order_map = map_of(site(spacing=200))
    document = write_message(
        OrderMessage.of(order_over("A", "B", "B-C/1"), order_map), header(version)
    )
    validator(version, "order").validate(document)
    whole, piece = document["edges"]
    assert "trajectory" not in whole
    points = [(point["x"], point["y"]) for point in piece["trajectory"]["controlPoints"]]
    assert points == [(3.0, 2.0), (3.0, 4.0)]
    assert piece["trajectory"]["degree"] == 1
    assert piece["trajectory"]["knotVector"] == [0, 0, 1, 1]


def test_a_curve_is_sent_as_it_is_drawn() -> None:
    """A Bézier curve with two control points between its ends is a NURBS of degree 3."""
    scenario = parse_scenario(
        {
            "format": "rightofway-scenario/1",
            "map": {
                "roadmap": {
                    "vertices": {"A": [0, 0], "B": [4, 4]},
                    "edges": [
                        {"from": "A", "to": "B", "length": 7, "curve": [[4, 0], [4, 1]]},
                    ],
                }
            },
            "rules": {"return": "none"},
            "robots": [{"name": "R1", "home": "A", "target": "B"}],
        }
    )
    document = write_message(
        OrderMessage.of(order_over("A", "B"), map_of(scenario)), header("2.1.0")
    )
    trajectory = document["edges"][0]["trajectory"]
    assert trajectory["degree"] == 3
    assert trajectory["knotVector"] == [0, 0, 0, 0, 1, 1, 1, 1]
    points = [(point["x"], point["y"]) for point in trajectory["controlPoints"]]
    assert points == [(0, 0), (4, 0), (4, -1), (4, -4)]


STATE: dict[str, Any] = {
    "orderId": "run-0-0",
    "orderUpdateId": 1,
    "lastNodeId": "N0",
    "lastNodeSequenceId": 0,
    "nodeStates": [{"nodeId": "N1", "sequenceId": 2, "released": True}],
    "edgeStates": [{"edgeId": "N0-N1", "sequenceId": 1, "released": True}],
    "actionStates": [{"actionId": "a", "actionStatus": "RUNNING"}],
    "instantActionStates": [{"actionId": "token", "actionStatus": "FINISHED"}],
    "driving": True,
    "batteryState": {"batteryCharge": 80, "charging": False},
}


def test_a_state_is_read_with_its_instant_actions() -> None:
    """Version 3.0 has instant actions in a list of their own."""
    state = read(StateMessage, STATE, "state").to_robot_state()
    assert (state.order_id, state.update_id, state.last_place) == ("run-0-0", 1, "N0")
    assert (state.nodes, state.edges, state.is_driving) == ((2,), (1,), True)
    assert state.actions == {"a": "RUNNING", "token": "FINISHED"}


@pytest.mark.parametrize(
    ("key", "value", "place"),
    [
        ("orderUpdateId", -1, "state.orderUpdateId"),
        ("lastNodeSequenceId", "2", "state.lastNodeSequenceId"),
        ("nodeStates", [{"nodeId": "N1"}], r"state.nodeStates\[0\].sequenceId"),
        ("driving", None, "state.driving"),
    ],
)
def test_a_broken_state_is_refused_with_its_place(key: str, value: object, place: str) -> None:
    with pytest.raises(InputError, match=place):
        read(StateMessage, {**STATE, key: value}, "state")


CONDITION = Condition(
    mode="MANUAL",
    is_paused=True,
    emergency_stop="REMOTE",
    errors=(RobotError(kind="laser", level="FATAL", description="dirty"),),
    wants_more=True,
)


@pytest.mark.parametrize("version", VERSIONS)
def test_the_condition_of_a_robot_comes_back_as_it_was_sent(version: str) -> None:
    sent = StateReport(
        order_id="run-0-0",
        update_id=0,
        last_place="N0",
        last_sequence_id=0,
        nodes=(2,),
        edges=(1,),
        actions={"a": "WAITING", "b": "FINISHED"},
        is_driving=True,
        condition=CONDITION,
        charge=0.5,
    )
    document = write_message(
        StateMessage.of(sent, ["N1"], frozenset("b"), lanes={}), header(version)
    )
    validator(version, "state").validate(document)
    assert read(StateMessage, document, "state").to_robot_state() == sent


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize("state", ["ONLINE", "OFFLINE", "CONNECTION_BROKEN"])
def test_connections_are_written_and_read(version: str, state: str) -> None:
    document = write_message(ConnectionMessage(connectionState=state), header(version))
    validator(version, "connection").validate(document)
    assert read(ConnectionMessage, document, "connection").is_online == (state == "ONLINE")


@pytest.mark.parametrize("y", ["down", "up"])
@pytest.mark.parametrize("yaw", [Fraction(0), Fraction(1, 2), Fraction(-2)])
def test_theta_of_a_robot_along_a_lane_is_the_heading_of_the_lane(
    yaw: Fraction, y: Literal["down", "up"]
) -> None:
    """Frames of robots are turned, sites have y upwards or downwards."""
    fleet = FleetBuilder(y=y)
    for name, (x, at_y) in {"a": (0, 0), "b": (3, 4), "c": (-2, 1)}.items():
        fleet.add_vertex(name, x=x, y=at_y)
    fleet.add_edge("a", "b")
    fleet.add_edge("b", "c")
    fleet.add_robot("R1", home="a", target="b")
    scenario = fleet.build_scenario()
    roadmap = scenario.roadmap
    order_map = map_of(scenario, frame=Frame(x=Fraction(1), y=Fraction(2), yaw=yaw))
    for edge, heading in enumerate(list_headings(roadmap)):
        head = int(roadmap.heads[edge])
        tail = next(k for k in range(3) if edge < roadmap.indptr[k + 1])
        ends = [order_map.get_place(roadmap.name(vertex)) for vertex in (tail, head)]
        assert ends[0] is not None
        assert ends[1] is not None
        begin, end = ends[0].point, ends[1].point
        theta = math.atan2(end[1] - begin[1], end[0] - begin[0])
        on_site = find_heading_on_site(heading, roadmap)
        assert on_site is not None
        apart = abs(float(order_map.find_heading(theta) - on_site)) % 360
        assert min(apart, 360 - apart) < 1e-5
