"""Robots with a size do not turn back between pieces of a lane, whoever plans."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from rightofway import FleetBuilder, Plan, check, solve
from rightofway.cyclic import find_best_timetable, plan_of_laps
from rightofway.io import dump_scenario, parse_scenario
from rightofway.model import Closure, Scenario, Track
from rightofway.planners.features import Feature
from rightofway.planners.registry import find_all
from rightofway.site import Roadmap
from tests.builders.any_fleet import any_fleet
from tests.builders.laws import law
from tests.oracles import judge

PLUS: dict[str, Any] = {
    "format": "rightofway-scenario/1",
    "map": {
        "roadmap": {
            "vertices": {"A": [0, 0], "B": [12, 0], "C": [24, 0], "D": [12, 6], "E": [12, -12]},
            "edges": [["A", "B"], ["B", "C"], ["B", "D"], ["B", "E"]],
        }
    },
    "robots": [
        {"name": "R1", "home": "A", "target": "C", "radius": 0.4},
        {"name": "R2", "home": "C", "target": "A", "radius": 0.4},
        {"name": "R3", "home": "E", "target": "D", "radius": 0.4},
    ],
    "rules": {"return": "home"},
}
"""Each robot has to leave the lane of another one, which has no vertex but B to do so."""


def list_joints(roadmap: Roadmap) -> set[int]:
    return {int(joint) for lane in roadmap.lanes for joint in lane.joints}


def turns_back(plan: Plan) -> bool:
    """Tell whether a robot leaves a vertex between pieces to where it came from."""
    roadmap = plan.scenario.roadmap
    joints, places = list_joints(roadmap), roadmap.positions.tolist()
    return any(
        at in joints and places[before] == places[after]
        for track in plan.tracks
        for before, at, after in zip(
            track.vertices[:-2].tolist(),
            track.vertices[1:-1].tolist(),
            track.vertices[2:].tolist(),
            strict=True,
        )
    )


ABLE = sorted(name for name, spec in find_all().items() if Feature.SIZES in spec.features)


@pytest.mark.parametrize("planner", ABLE)
def test_no_planner_turns_a_robot_back_in_a_lane(planner: str) -> None:
    plan = solve(parse_scenario(PLUS), planner=planner, time_limit=5)
    assert check(plan).ok
    assert not turns_back(plan)


@law(any_fleet(always={"sizes", "spacing"}, without={"passed"}))
def test_no_edge_leads_back_from_between_pieces(scenario: Scenario) -> None:
    roadmap = scenario.roadmap
    if not any(robot.radius for robot in scenario.robots):
        return
    for at in list_joints(roadmap):
        onward = roadmap.heads[int(roadmap.indptr[at]) : int(roadmap.indptr[at + 1])].tolist()
        before = [tail for tail in range(roadmap.n_vertices)
                  if roadmap.find_edge(tail, at) is not None]  # fmt: skip
        # A node where robots may not turn is several vertices at one place.
        (ahead,) = set(map(roadmap.get_point, onward))
        (behind,) = set(map(roadmap.get_point, before))
        assert ahead != behind


def test_the_judge_refuses_a_plan_that_turns_back() -> None:
    """R3 makes room in the lane to D and comes back from its second place."""
    scenario = parse_scenario(PLUS)
    plan = solve(scenario, time_limit=5)
    vertex = scenario.roadmap.get_vertex
    names = ["E", *(f"E-B/{k}" for k in range(1, 5)), "B", "B-D/1", "B"]
    track = Track.of([vertex(name) for name in names], [100 * k for k in range(len(names))])
    wrong = replace(plan, tracks=(*plan.tracks[:2], track))
    assert ("forbidden turn", ("B-D/1", "B")) in [
        (fault.kind, tuple(map(scenario.roadmap.name, fault.vertices)))
        for fault in check(wrong).faults
    ]
    assert judge.faults(wrong)


def on_one_lane(radius: str) -> Scenario:
    """Return two robots that want to pass each other on one lane."""
    lane = {"vertices": {"A": [0, 0], "B": [12, 0]}, "edges": [["A", "B"]]}
    robots = [
        {"name": "R1", "home": "A", "target": "B"},
        {"name": "R2", "home": "B", "target": "A"},
    ]
    document = PLUS | {
        "map": {"roadmap": lane},
        "robots": [robot | {"radius": radius} for robot in robots],
        "rules": {"return": "none"},
    }
    return parse_scenario(document)


@pytest.mark.parametrize("radius", ["0.4", "0"])
def test_both_directions_of_a_lane_are_one_place(radius: str) -> None:
    """Both robots drive at once, and meet in the middle; also points on lanes for robots."""
    document = dump_scenario(on_one_lane("0.4"))
    for robot in document["robots"]:
        robot["radius"] = radius
    scenario = parse_scenario(document)
    assert scenario.rules.occupancy == "both"
    itineraries, roadmap = scenario.problem.itineraries, scenario.roadmap
    tracks = []
    for itinerary, lane in zip(itineraries, roadmap.lanes, strict=True):
        assert lane.vertices[0] == itinerary.home
        drive = max(itinerary.edge_ticks)
        tracks.append(Track.of(lane.vertices, [drive * k for k in range(len(lane.vertices))]))
    plan = Plan(scenario=scenario, tracks=tuple(tracks), run=solve_run(scenario))
    kinds = {fault.kind for fault in check(plan).faults}
    assert kinds & {"vertex conflict", "space conflict"}
    assert ("booking", (0, 1)) in judge.faults(plan)


def solve_run(scenario: Scenario) -> Any:
    """Return how a plan of the first robot alone was made."""
    return solve(replace(scenario, robots=scenario.robots[:1]), time_limit=5).run


def test_a_closed_place_is_closed_in_both_directions() -> None:
    scenario = on_one_lane("0.4")
    roadmap = scenario.roadmap
    for name in ("A-B/1", "B-A/1"):
        closed = replace(scenario, closures=(Closure(at=roadmap.get_vertex(name)),))
        closures = closed.problem.closures
        assert closures is not None
        shut = {roadmap.get_point(row) for row in closures.row.tolist() if row < roadmap.n_vertices}
        rows = [row for row in closures.row.tolist() if row < roadmap.n_vertices]
        assert len(rows) == 2
        assert shut == {roadmap.get_point(roadmap.get_vertex(name))}


def test_a_robot_that_begins_between_pieces_drives_on() -> None:
    """Its home has the direction from A to B, so it comes home by A."""
    fleet = FleetBuilder(ends="home", spacing=3)
    fleet.add_vertex("A", 0, 0).add_vertex("B", 12, 0).add_edge("A", "B")
    fleet.add_robot("R1", home="A-B/2", target="A", radius="0.4")
    plan = solve(fleet.build_scenario(), time_limit=5)
    assert plan["R1"].vertices == (
        *("A-B/2", "A-B/3", "B", "B-A/1", "B-A/2", "B-A/3", "A"),
        *("A-B/1", "A-B/2"),
    )


def test_robots_drive_on_in_laps() -> None:
    plan = plan_of_laps(find_best_timetable(parse_scenario(PLUS), rounds=2))
    assert check(plan).ok
    assert not turns_back(plan)
