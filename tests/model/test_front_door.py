"""The front door: what users write in Python is kept exactly, or refused in a sentence."""

from __future__ import annotations

from collections.abc import Callable
from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from typing import Any

import networkx as nx  # type: ignore[import-untyped]
import numpy as np
import pytest

import rightofway
from rightofway import FleetBuilder, InputError, Robot, Rules, Scenario, Stop
from rightofway.planners import LnsOptions
from rightofway.site import Edge, make_grid_roadmap

DOOR = ["...", "@.@", "..."]

robot: Any = Robot
stop: Any = Stop
rules: Any = Rules
parse_scenario: Any = Scenario
solve: Any = rightofway.solve
improve: Any = rightofway.improve


def door(**changes: Any) -> FleetBuilder:
    return FleetBuilder(grid=DOOR, **changes)


def pair() -> Scenario:
    fleet = door().add_robot("R1", home="N0", target="N6", speed="1/2")
    return fleet.add_robot("R2", home=(0, 2), target="N8", work=0.5).build_scenario()


HALVES = [0.5, "0.5", "1/2", ".5", "5e-1", Decimal("0.5"), Fraction(1, 2), np.float64(0.5)]


@pytest.mark.parametrize("half", HALVES, ids=repr)
def test_a_number_is_kept_exactly_however_it_is_written(half: Any) -> None:
    made = robot(name="R1", home=0, stops=[stop(at=3, work=half)], speed=half, turn=half)
    assert (made.speed, made.turn, made.stops[0].work) == (Fraction(1, 2),) * 3
    assert rules(headway=half, turn=half).headway == Fraction(1, 2)
    assert make_grid_roadmap(DOOR, cell_size=half).lengths == (Fraction(1, 2),)
    assert Edge(tail="A", head="B", length=half).length == Fraction(1, 2)


def test_points_units_and_the_frame_are_those_of_a_file() -> None:
    fleet = door(y="up", origin=(10, "20.5"), units={"length": "m"})
    fleet.add_robot("R1", home={"x": 10.2, "y": 20.6}, stops=[({"x": 12.9, "y": 23}, 4)])
    built = fleet.build_scenario()
    shape = {"grid": DOOR, "y": "up", "origin": [10, "20.5"]}
    robots = [{"name": "R1", "home": "N6", "stops": [{"at": "N2", "work": 4}]}]
    document = {"format": "rightofway-scenario/1", "map": shape, "robots": robots}
    assert built == rightofway.io.parse_scenario({**document, "units": {"length": "m"}})


def test_edges_without_a_length_share_one_step() -> None:
    fleet = FleetBuilder(y="up").add_vertex("a", 0, 0).add_vertex("b", 1, 1).add_vertex("c", 0, 0.5)
    fleet.add_edge("a", "b").add_edge("b", "c").add_edge("a", "c")
    roadmap = fleet.build_roadmap()
    # roots of 2 and 1.25, rounded up to a millionth, because a and c are 0.5 apart
    assert [float(length) for length in roadmap.lengths] == [0.5, 1.118034, 1.414214]
    assert roadmap.get_point(1) == (Fraction(1), Fraction(1))


def test_a_float_counts_as_the_decimal_that_it_prints_as() -> None:
    assert robot(name="R1", home=0, stops=(), speed=0.1).speed == Fraction(1, 10)


def test_lists_are_kept_as_tuples_so_that_the_fleet_can_be_measured_and_written(
    tmp_path: Path,
) -> None:
    robots = [robot(name="R1", home=0, stops=[stop(at=4)])]
    plan = solve(parse_scenario(roadmap=make_grid_roadmap(DOOR), robots=robots))
    assert plan.scenario.robots == tuple(robots)
    assert rightofway.measure(plan).flowtime == plan.flowtime
    rightofway.write_plan(plan, tmp_path / "plan.json")
    assert rightofway.load_plan(tmp_path / "plan.json").tracks == plan.tracks


WRONG: dict[str, tuple[Callable[[], object], str]] = {
    "speed is a word": (
        lambda: robot(name="R1", home=0, stops=(), speed="fast"),
        r"robot 'R1': speed: 'fast' is not a number \(write it like 3, 0.5 or 1/3\)",
    ),
    "speed is no number": (
        lambda: robot(name="R1", home=0, stops=(), speed=None),
        "robot 'R1': speed: nothing is not a number",
    ),
    "speed is not a number": (
        lambda: robot(name="R1", home=0, stops=(), speed=float("nan")),
        "robot 'R1': speed: nan is not a number",
    ),
    "speed divides by zero": (
        lambda: robot(name="R1", home=0, stops=(), speed="1/0"),
        "robot 'R1': speed: '1/0' divides by zero",
    ),
    "home is a name": (
        lambda: robot(name="R1", home="N0", stops=()),
        r"robot 'R1': home: 'N0' is no vertex number \(give roadmap.get_vertex\(name\), or build",
    ),
    "turn is a word": (
        lambda: robot(name="R1", home=0, stops=(), turn="x"),
        "robot 'R1': turn: 'x' is not a number .*; 'cell' is possible too",
    ),
    "laps is no whole number": (
        lambda: robot(name="R1", home=0, stops=(), laps=1.5),
        r"robot 'R1': laps: 1.5 does not fit \(give a whole number of 1 or more\)",
    ),
    "ends is unknown": (
        lambda: robot(name="R1", home=0, stops=(), ends="away"),
        r"robot 'R1': ends: 'away' is unknown \(give home or none\)",
    ),
    "name is no text": (
        lambda: robot(name=1, home=0, stops=()),
        r"robot 1: name: 1 is no text \(give text\)",
    ),
    "stops are numbers": (
        lambda: robot(name="R1", home=0, stops=[3]),
        r"robot 'R1': stops\[0\]: 3 is no Stop \(give Stop",
    ),
    "a stop is at a name": (lambda: stop(at="N6"), "stop: at: 'N6' is no vertex number"),
    "work is a word": (lambda: stop(at=3, work="long"), "stop: work: 'long' is not a number"),
    "headway is a word": (
        lambda: rules(headway="far"),
        "rules: headway: 'far' is not a number",
    ),
    "occupancy is unknown": (
        lambda: rules(occupancy="two"),
        r"rules: occupancy: 'two' is unknown \(give one or both\)",
    ),
    "rotations is a word": (
        lambda: rules(rotations="yes"),
        "rules: rotations: 'yes' is neither true nor false",
    ),
    "the roadmap is text": (
        lambda: parse_scenario(roadmap="door.map", robots=[]),
        "roadmap: 'door.map' is no Roadmap",
    ),
    "a robot is a name": (
        lambda: parse_scenario(roadmap=make_grid_roadmap(DOOR), robots=["R1"]),
        r"robots\[0\]: 'R1' is no Robot \(give a Robot\)",
    ),
    "the fleet is one robot": (
        lambda: parse_scenario(
            roadmap=make_grid_roadmap(DOOR), robots=robot(name="R1", home=0, stops=())
        ),
        "robots: .* is no list .give a list, each a Robot",
    ),
    "speed is 0": (
        lambda: door().add_robot("R1", home="N0", target="N6", speed=0),
        "robot 'R1': speed: 0 is not positive",
    ),
    "weight is 0": (
        lambda: door().add_robot("R1", home="N0", target="N6", weight=0),
        "robot 'R1': weight: 0 is not positive",
    ),
    "weights are too far apart": (
        lambda: (
            door()
            .add_robot("R1", home="N0", target="N6", weight="1/1001")
            .add_robot("R2", home="N2", target="N8", weight=1000)
            .build_scenario()
        ),
        r"robots\[1\].weight: 1000 makes weights too far apart .* it is 1001000, above 1000000",
    ),
    "the grid is ragged": (lambda: FleetBuilder(grid=["...", "."]), r"grid\[1\]: 1 cells, but"),
    "the cells have no size": (
        lambda: door(cell_size=0),
        "grid.cell_size: 0 is not positive",
    ),
    "two maps": (
        lambda: door(map_file="door.map"),
        r"grid and map_file are given \(give one map\)",
    ),
    "no map": (lambda: FleetBuilder().build_scenario(), "the fleet has no map"),
    "no map file": (lambda: FleetBuilder(map_file="no.map"), "no.map: there is no such file"),
    "no graph": (lambda: FleetBuilder(graph=[(0, 1)]), "graph: .* is no graph"),
    "a rule is unknown": (
        lambda: door(headways=1),
        r"headways: is unknown to FleetBuilder \(rules are occupancy, headway,",
    ),
    "rules by a name that is none": (
        lambda: door(rules="paper"),
        r"rules: 'paper' is no name of rules \(give \"classic\", or each rule by its name, like",
    ),
    "a rule by its name in files": (
        lambda: door(**{"return": "none"}),
        r'return: is called ends in Python \(give ends="none" or ends="home"\)',
    ),
    "a home in a wall": (
        lambda: door().add_robot("R1", home="N3", target="N6"),
        "robot 'R1': home: N3, row 1, column 0, is blocked by a wall",
    ),
    "a target outside": (
        lambda: door().add_robot("R1", home="N0", target=(3, 0)),
        r"robot 'R1': target: \[3, 0\] is outside the map \(rows are 0 to 2",
    ),
    "a stop that is no place": (
        lambda: door().add_robot("R1", home="N0", stops=["N1", 2.5]),
        r"robot 'R1': stops\[1\]: 2.5 is no place \(give N<k>, \[row, column\] or {x, y}\)",
    ),
    "nowhere to go": (
        lambda: door().add_robot("R1", home="N0").build_scenario(),
        r"robot 'R1': has nowhere to go \(give either target or stops\)",
    ),
    "a job in no form": (
        lambda: door().add_job("J1", pickup="N0"),
        r"job 'J1': has not exactly one form \(give at, or pickup and dropoff, or stops\)",
    ),
    "a stop of a job outside": (
        lambda: door().add_job("J1", stops=[{"at": "N0"}, {"at": "N9"}]),
        r"job 'J1': stops\[1\]: 'N9' is outside the map",
    ),
    "a stop of a job with another key": (
        lambda: door().add_job("J1", stops=[{"place": "N0"}]),
        r"stops\[0\]: 'place' is unknown \(give at, work, load, earliest, latest, actions\)",
    ),
    "a start in a wall": (
        lambda: door().add_robot("R1", home="N0", start={"at": "N3"}),
        "robot 'R1': start: N3, row 1, column 0, is blocked by a wall",
    ),
    "a vertex on a grid": (lambda: door().add_vertex("A", 0, 0), "vertex 'A': the map is complete"),
    "a vertex twice": (
        lambda: FleetBuilder().add_vertex("A", 0, 0).add_vertex("A", 1, 0),
        "vertex 'A': is there already",
    ),
    "a vertex at a word": (
        lambda: FleetBuilder().add_vertex("A", 0, "up"),
        "vertex 'A': 'up' is not a number",
    ),
    "an edge to nowhere": (
        lambda: FleetBuilder().add_vertex("A", 0, 0).add_edge("A", "B"),
        "edge 'A' to 'B': no vertex is named 'B'",
    ),
    "an edge of no length": (
        lambda: FleetBuilder().add_vertex("A", 0, 0).add_vertex("B", 1, 0).add_edge("A", "B", 0),
        "edge 'A' to 'B': length: 0 is not positive",
    ),
    "an edge between two vertices at one position": (
        lambda: FleetBuilder().add_vertex("A", 1, 1).add_vertex("B", 1, 1).add_edge("A", "B"),
        "edge 'A' to 'B': has no length, its ends are at one position .give a length",
    ),
    "an unknown direction of y": (
        lambda: door(y="north"),
        "y: 'north' is unknown .give down or up",
    ),
    "an origin without a grid": (
        lambda: FleetBuilder(origin=(0, 0)),
        "origin: is for a grid or a map file",
    ),
    "an origin of one number": (
        lambda: door(origin=3),
        r"origin: 3 does not fit \(give \[x",
    ),
    "an unknown unit": (
        lambda: door(units={"length": "feet"}),
        "units: length: 'feet' is no unit .give mm, cm or m",
    ),
    "units that are no mapping": (lambda: door(units="m"), "units: 'm' are no units"),
    "a point in a wall": (
        lambda: door(units={"length": "m"}).add_robot("R1", home={"x": 0.5, "y": 1.5}, target="N8"),
        "home: {x: 0.5, y: 1.5} lies in N3, .*the nearest free cell is N0 at .*, 1 m away",
    ),
    "a bare number": (
        lambda: door().add_robot("R1", home=2, target="N8"),
        "home: 2 is no place .did you mean N2",
    ),
    "a file name is solved": (
        lambda: solve("door.yaml"),
        "scenario: 'door.yaml' is no Scenario .load a file with rightofway.load",
    ),
    "a file name is improved": (lambda: improve("plan.json"), "plan: 'plan.json' is no Plan"),
    "an unknown planner": (
        lambda: solve(pair(), "two_level"),
        r"planner: 'two_level' is unknown to rightofway \(did you mean 'two-level'\?",
    ),
    "an unknown option": (
        lambda: solve(pair(), "lns", iteration=3),
        "options.iteration: 'iteration' is unknown to lns .did you mean 'iterations'",
    ),
    "an unknown option in a mapping": (
        lambda: solve(pair(), "lns", options={"swap": "leave"}),
        r"options.swap: 'swap' is unknown to lns \(known: objective, iterations\)",
    ),
    "a wrong value of an option": (
        lambda: solve(pair(), "lns", iterations=-1),
        "options.iterations: -1 does not fit .give a whole number of 0 or more",
    ),
    "options of another planner": (
        lambda: solve(pair(), options=LnsOptions()),
        r"options: LnsOptions\(objective='flowtime', iterations=0\) are no options of auto",
    ),
    "an unknown field of options": (
        lambda: LnsOptions(iteration=3),  # type: ignore[call-arg]
        "options.iteration: 'iteration' is unknown to LnsOptions .did you mean 'iterations'",
    ),
    "options given twice": (
        lambda: solve(pair(), "lns", options=LnsOptions(), iterations=3),
        "options: are given twice, with iterations beside",
    ),
    "a negative seed": (
        lambda: solve(pair(), seed=-1),
        "seed: -1 does not fit .give a whole",
    ),
    "a seed that is a word": (
        lambda: solve(pair(), seed="x"),
        "seed: 'x' does not fit .give a",
    ),
}


@pytest.mark.parametrize(("call", "message"), WRONG.values(), ids=WRONG)
def test_a_wrong_call_is_refused_with_its_place_value_and_remedy(
    call: Callable[[], object], message: str
) -> None:
    with pytest.raises(InputError, match=message):
        call()


def test_every_wrong_value_of_a_robot_is_reported_at_once() -> None:
    with pytest.raises(InputError) as refused:
        robot(name="R1", home="N0", stops=[], speed="x", turn="y")
    assert [fault.place for fault in refused.value.faults] == ["home", "speed", "turn"]


def test_a_fleet_from_a_grid_is_that_of_the_file() -> None:
    """`examples/door.yaml` has the same robots; a place is a name or (row, column)."""
    written = rightofway.load(Path(__file__).parents[2] / "examples" / "door.yaml")
    fleet = FleetBuilder(grid=list(written.roadmap.grid.as_lines()))  # type: ignore[union-attr]
    for each in written.robots:
        row, column = written.roadmap.grid.get_cell(each.home)  # type: ignore[union-attr]
        target, work = each.stops[0].at, each.stops[0].work
        name = written.roadmap.name(target)
        fleet.add_robot(each.name, home=(row, column), target=name, work=work, speed=each.speed)
    assert fleet.build_scenario() == written


def test_a_map_file_gives_the_same_map_as_its_rows(tmp_path: Path) -> None:
    file = tmp_path / "door.map"
    file.write_text("type octile\nheight 3\nwidth 3\nmap\n" + "\n".join(DOOR) + "\n")
    assert FleetBuilder(map_file=file).build_roadmap() == make_grid_roadmap(DOOR)


def test_stops_have_work_times_of_their_own() -> None:
    fleet = door().add_robot("R1", home="N0", stops=["N6", ((2, 2), "1/2"), (1, 1)])
    stops = fleet.build_scenario().robots[0].stops
    assert [stop.at for stop in stops] == [4, 6, 3]
    assert [stop.work for stop in stops] == [0, Fraction(1, 2), 0]


def test_rules_are_given_by_name() -> None:
    fleet = door(headway="1/4", occupancy="both").add_robot("R1", home="N0", target="N6")
    assert fleet.build_scenario().rules == rules(headway="1/4", occupancy="both")


def test_edges_have_their_straight_length_and_lead_both_ways_unless_told_otherwise() -> None:
    """A 3-4-5 triangle: the diagonal is 5 long, the one-way is as long as it says."""
    fleet = FleetBuilder().add_vertex("dock", 0, 0).add_vertex("press", 3, 4)
    fleet.add_vertex("store", 3, 0)
    fleet.add_edge("dock", "press").add_edge("press", "store", "9/2", both_ways=False)
    roadmap = fleet.build_roadmap()
    dock, press, store = map(roadmap.get_vertex, ("dock", "press", "store"))
    assert roadmap.lengths == (Fraction(9, 2), Fraction(5))
    assert roadmap.find_edge(dock, press) is not None
    assert roadmap.find_edge(press, dock) is not None
    assert roadmap.find_edge(press, store) is not None
    assert roadmap.find_edge(store, press) is None


def test_a_graph_of_networkx_is_a_map_and_its_nodes_are_places() -> None:
    fleet = FleetBuilder(graph=nx.grid_2d_graph(3, 3))
    scenario = fleet.add_robot("R1", home=(0, 0), target=(2, 2)).build_scenario()
    assert scenario.roadmap.n_vertices == 9
    assert scenario.roadmap.n_edges == 24
    assert scenario.roadmap.name(scenario.robots[0].stops[0].at) == "(2, 2)"
    assert solve(scenario).makespan == 8  # four edges of length 1 there, four back


def test_a_directed_graph_keeps_its_directions_and_lengths() -> None:
    """Lengths come from `length`, then `weight`; without positions an edge is 1 long."""
    graph = nx.DiGraph()
    graph.add_edge("A", "B", length="1/3")
    graph.add_edge("B", "C", weight=2)
    graph.add_edge("C", "A")
    roadmap = FleetBuilder(graph=graph).build_roadmap()
    assert roadmap.n_edges == 3
    assert roadmap.lengths == (Fraction(1, 3), Fraction(1), Fraction(2))


def test_positions_of_a_graph_give_the_lengths_of_its_edges() -> None:
    graph = nx.Graph()
    graph.add_node("A", pos=(0, 0))
    graph.add_node("B", x=0.3, y=0.4)
    graph.add_edge("A", "B")
    assert FleetBuilder(graph=graph).build_roadmap().lengths == (Fraction(1, 2),)


def test_classic_rules_go_by_their_name_as_in_files() -> None:
    def rules_with(**given: Any) -> Rules:
        return door(**given).add_robot("R1", home="N0", target="N6").build_scenario().rules

    classic = rules_with(rules="classic", headway=1)
    assert classic == Rules(turn=Fraction(0), ends="none", headway=Fraction(1), occupancy="one")
