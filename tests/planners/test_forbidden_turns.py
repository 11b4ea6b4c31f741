"""Robots do not turn where they may not, whoever plans; an oracle looks at the drawing alone."""

from __future__ import annotations

from dataclasses import replace
from math import atan2, degrees
from typing import Any

import pytest

from rightofway import FleetBuilder, Plan, check, solve
from rightofway.errors import InputError, NoPlanExists
from rightofway.io import dump_scenario, parse_scenario
from rightofway.model import Scenario, Track
from rightofway.planners.features import Feature
from rightofway.planners.registry import find_all
from tests.builders.any_fleet import any_fleet
from tests.builders.laws import law, leave
from tests.oracles import judge

CROSS: dict[str, Any] = {
    "format": "rightofway-scenario/1",
    "map": {
        "roadmap": {
            "vertices": {
                "A": [0, 0],
                "V": {"at": [5, 0], "turning": False},
                "B": [10, 0],
                "C": [5, 5],
                "D": [5, -5],
            },
            "edges": [["A", "V"], ["V", "B"], ["V", "C"], ["V", "D"]],
        },
        "y": "up",
    },
    "robots": [
        {"name": "R1", "home": "A", "target": "B"},
        {"name": "R2", "home": "B", "target": "A"},
        {"name": "R3", "home": "C", "target": "D"},
    ],
}
"""Each robot has to make room for the other ones, and may not come back from V."""


def with_vertex(document: dict[str, Any], **own: Any) -> dict[str, Any]:
    """Return the cross with other properties of V."""
    roadmap = document["map"]["roadmap"]
    vertices = roadmap["vertices"] | {"V": roadmap["vertices"]["V"] | own}
    return document | {"map": {"roadmap": roadmap | {"vertices": vertices}, "y": "up"}}


def find_forbidden_turns(plan: Plan, fixed: set[str]) -> list[tuple[str, ...]]:
    """Return the vertices before, at and after each turn by more than 90 degrees at some vertices.

    The oracle knows names, positions and orientations only: all vertices at the place of one are
    this one.
    """
    roadmap = plan.scenario.roadmap
    turned = {
        (int(tail), int(head)): float(angle) for tail, head, angle in roadmap.drawing.orientations
    }
    places = {roadmap.get_point(roadmap.get_vertex(name)) for name in fixed}
    found = []
    for track in plan.tracks:
        vertices = list(map(roadmap.get_drawn, track.vertices.tolist()))
        points = [roadmap.get_point(vertex) for vertex in vertices]
        for k in range(1, len(points) - 1):
            came, goes = (
                degrees(atan2(to_y - y, to_x - x)) + turned.get((tail, head), 0)
                for (x, y), (to_x, to_y), tail, head in zip(
                    points[k - 1 : k + 1],
                    points[k : k + 2],
                    vertices[k - 1 : k + 1],
                    vertices[k : k + 2],
                    strict=True,
                )
            )
            bend = (goes - came) % 360
            if points[k] in places and round(min(bend, 360 - bend)) > 90:
                found.append(tuple(map(roadmap.name, vertices[k - 1 : k + 2])))
    return found


ABLE = sorted(name for name, spec in find_all().items() if Feature.SIZES in spec.features)


@pytest.mark.parametrize("radius", ["0", "0.4"])
@pytest.mark.parametrize("planner", ABLE)
def test_no_planner_turns_a_robot_where_it_may_not(planner: str, radius: str) -> None:
    robots = [robot | {"radius": radius} for robot in CROSS["robots"]]
    plan = solve(parse_scenario(CROSS | {"robots": robots}), planner=planner, time_limit=5)
    assert check(plan).ok
    assert not judge.faults(plan)
    assert not find_forbidden_turns(plan, {"V"})


def list_fixed(scenario: Scenario) -> set[str]:
    return set(map(scenario.roadmap.name, scenario.roadmap.fixed))


@law(any_fleet(always={"forbidden turns"}))
def test_plans_are_free_of_forbidden_turns(scenario: Scenario) -> None:
    try:
        plan = solve(scenario, planner="prioritized", time_limit=5)
    except NoPlanExists:
        leave("no plan")
    assert check(plan).ok
    assert not judge.faults(plan)
    assert not find_forbidden_turns(plan, list_fixed(scenario))


@law(any_fleet(always={"forbidden turns"}))
def test_a_scenario_with_forbidden_turns_is_written_and_read(scenario: Scenario) -> None:
    assert parse_scenario(dump_scenario(scenario)) == scenario


def drive(scenario: Scenario, *names: str) -> Plan:
    """Return a plan in which the first robot drives alone along some vertices, slowly."""
    alone = replace(scenario, robots=scenario.robots[:1])
    vertices = [alone.roadmap.get_vertex(name) for name in names]
    run = solve(parse_scenario(CROSS), planner="prioritized").run
    track = Track.of(vertices, [100 * k for k in range(len(vertices))])
    return Plan(scenario=alone, tracks=(track,), run=run)


def test_the_judge_names_a_forbidden_turn() -> None:
    scenario = parse_scenario(CROSS)
    wrong = drive(scenario, "A", "V", "B", "B-V/end", "B", "B-V/end", "A")
    (fault,) = check(wrong).faults
    assert fault.kind == "forbidden turn"
    assert fault.message == (
        "R1 goes from B-V/end to B, and may not turn for that (drive on, and turn where robots may"
        " turn)"
    )
    assert find_forbidden_turns(wrong, {"V"}) == [("B", "B-V/end", "B")]
    assert judge.faults(wrong)


def test_all_vertices_of_a_place_hold_one_robot() -> None:
    """R1 drives from A to B and R3 from C to D at once: both are at V after the first drive."""
    scenario = parse_scenario(CROSS)
    assert scenario.rules.occupancy == "both"
    roadmap = scenario.roadmap
    ways = [("A", "V", "B"), ("B", "B"), ("C", "C-V/end", "D")]
    tracks = [
        Track.of([roadmap.get_vertex(name) for name in dict.fromkeys(way)],
                 [100 * k for k in range(len({*way}))])
        for way in ways
    ]  # fmt: skip
    run = solve(scenario, planner="prioritized").run
    plan = Plan(scenario=scenario, tracks=tuple(tracks), run=run)
    assert "vertex conflict" in check(plan).counts


@pytest.mark.parametrize(
    ("heading", "way"),
    [
        (0, ("A", "V", "B", "B-V/end", "A")),
        (180, ("A", "A-V/end", "B", "V", "A")),
        (90, ("A", "A-V/end", "D", "V", "A")),
    ],
)
def test_a_stop_is_reached_in_its_heading(heading: int, way: tuple[str, ...]) -> None:
    """Robots turn at A, B, C and D; at V they are in the heading in which they come."""
    document = with_vertex(CROSS, heading=heading)
    robots = [{"name": "R1", "home": "A", "target": "V"}]
    plan = solve(parse_scenario(document | {"robots": robots}))
    assert plan["R1"].vertices == way


def test_a_heading_in_which_no_lane_ends_is_refused() -> None:
    document = with_vertex(CROSS, heading=45)
    robots = [{"name": "R1", "home": "A", "target": "V"}]
    with pytest.raises(InputError) as error:
        parse_scenario(document | {"robots": robots})
    assert str(error.value) == (
        "robots[0].target: robots may not turn at V, where they work in heading 45, and lanes end"
        " there in 0, 90, 180 and 270 (let them turn there, give another heading, or draw a lane"
        " that ends in it)"
    )
    assert parse_scenario(document), "robots may drive through"


def build_dead_end(**back: Any) -> Scenario:
    fleet = FleetBuilder(ends="home").add_vertex("A", 0, 0).add_vertex("V", 5, 0, turning=False)
    fleet.add_edge("A", "V", both_ways=False).add_edge("V", "A", both_ways=False, **back)
    return fleet.add_robot("R1", home="A", target="V").build_scenario()


@pytest.mark.parametrize("back", [{"orientation": 180}, {"turning": True}])
def test_robots_leave_a_dead_end_backwards_or_turn_along_the_lane(back: dict[str, Any]) -> None:
    plan = solve(build_dead_end(**back))
    assert plan["R1"].vertices == ("A", "V", "A")


def test_a_dead_end_without_a_turn_has_no_way_out() -> None:
    with pytest.raises(NoPlanExists, match="robots may not turn at places on the way"):
        solve(build_dead_end())


@pytest.mark.parametrize(("y", "way"), [("4.999", 3), ("5.1", 3), ("5.5", None)])
def test_bends_are_followed_up_to_90_degrees_after_rounding(y: str, way: int | None) -> None:
    """The lane from V to B goes back by 0.1 or 0.5 on 5: by 1.1 or 5.7 degrees more than 90."""
    fleet = FleetBuilder(ends="none").add_vertex("A", 0, 0).add_vertex("V", 5, 0, turning=False)
    x = {"4.999": "5.01", "5.1": "4.96", "5.5": "4.5"}[y]
    fleet.add_vertex("B", x, 5).add_edge("A", "V").add_edge("V", "B")
    fleet.add_robot("R1", home="A", target="B")
    if way is None:
        with pytest.raises(NoPlanExists):
            solve(fleet.build_scenario())
    else:
        assert len(solve(fleet.build_scenario())["R1"].vertices) == way


@pytest.mark.parametrize(
    ("heading", "turns"),
    [
        (None, 2),  # 180 degrees at V
        (0, 2),  # as it comes, then 180 degrees
        (90, 2),  # 90 degrees twice, in either sense
        (45, 2),  # 45 and 135 degrees
    ],
)
def test_a_robot_turns_into_the_heading_of_a_stop(heading: int | None, turns: int) -> None:
    """On a spur, a turn into any heading and out again is one turn back: it takes no more time."""
    fleet = FleetBuilder(ends="home", turn_rate=18).add_vertex("A", 0, 0)
    fleet.add_vertex("V", 5, 0, heading=heading).add_edge("A", "V")
    plan = solve(fleet.add_robot("R1", home="A", target="V").build_scenario())
    assert plan["R1"].completion == 1 + turns + 1, "a tick is 5"


@pytest.mark.parametrize(("heading", "turns"), [(None, 0), (0, 0), (180, 4), (90, 2), (-90, 2)])
def test_a_robot_turns_into_the_heading_of_a_stop_on_the_way(
    heading: int | None, turns: int
) -> None:
    """It comes from A in heading 0, and drives on to B in heading 0; the site has y downwards."""
    fleet = FleetBuilder(ends="none", turn_rate=18)
    fleet.add_vertex("A", 0, 0).add_vertex("V", 5, 0, heading=heading).add_vertex("B", 10, 0)
    fleet.add_edge("A", "V", both_ways=False).add_edge("V", "B", both_ways=False)
    fleet.add_robot("R1", home="A", stops=["V", "B"])
    plan = solve(fleet.build_scenario())
    assert plan["R1"].completion == 2 + turns, "a tick is 5"
    assert check(plan).ok
