"""Zones hold one robot: how they are given, judged and planned."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import pytest

from rightofway import FleetBuilder, check, solve
from rightofway.errors import InputError, NoPlanExists
from rightofway.io import dump_scenario, parse_scenario
from rightofway.model import Plan, PlannerRun, Track
from rightofway.planners import Feature, find_all

KNOW_ZONES = sorted(spec.name for spec in find_all().values() if Feature.SIZES in spec.features)


def document(zone: dict[str, Any] | None = None) -> dict[str, Any]:
    """Return two parallel rows A B C D and E F G H, 100 apart; R1 and R2 drive along one each."""
    vertices = {name: [k, 0] for k, name in enumerate("ABCD")}
    vertices |= {name: [k, 100] for k, name in enumerate("EFGH")}
    edges = [[tail, head] for row in ("ABCD", "EFGH") for tail, head in pairwise(row)]
    roadmap: dict[str, Any] = {"vertices": vertices, "edges": edges}
    if zone is not None:
        roadmap["zones"] = [{"name": "door", **zone}]
    return {
        "format": "rightofway-scenario/1",
        "map": {"roadmap": roadmap},
        "robots": [
            {"name": "R1", "home": "A", "target": "D"},
            {"name": "R2", "home": "E", "target": "H"},
        ],
        "rules": {"return": "none"},
    }


def judged(zone: dict[str, Any], late: int, headway: int = 0) -> dict[str, int]:
    """Return the faults of two drives through, of which R2 is that many ticks late."""
    data = document(zone)
    data["rules"]["headway"] = headway
    scenario = parse_scenario(data)
    tracks = (
        Track.of([0, 1, 2, 3], [0, 1, 2, 3]),
        Track.of([4, 5, 6, 7], [0, 1 + late, 2 + late, 3 + late]),
    )
    report = check(Plan(scenario=scenario, tracks=tracks, run=PlannerRun(name="by hand")))
    return {str(kind): count for kind, count in report.counts.items()}


@pytest.mark.parametrize(
    ("zone", "late"),
    [
        # B is booked from tick 0, when R1 starts to drive there, until it is at C, at tick 2.
        ({"vertices": ["B", "F"]}, 2),
        # The edges are driven from tick 1 to 2.
        ({"edges": [["B", "C"], ["F", "G"]]}, 1),
        # The first edge is left at tick 1, the second one entered at tick 1.
        ({"edges": [["A", "B"], ["F", "G"]]}, 0),
        # From tick 1 to 3 and from tick 1 to 2.
        ({"vertices": ["C"], "edges": [["F", "G"]]}, 2),
    ],
)
def test_a_zone_is_free_again_when_its_vertices_and_edges_are(
    zone: dict[str, Any], late: int
) -> None:
    assert judged(zone, late) == {}
    if late:
        assert judged(zone, late - 1)["zone conflict"] >= 1
    assert judged(zone, late, headway=1)["zone conflict"] >= 1
    assert judged(zone, late + 1, headway=1) == {}


def test_the_fault_names_the_zone_the_robots_and_the_time() -> None:
    scenario = parse_scenario(document({"vertices": ["B", "F"]}))
    tracks = Track.of([0, 1, 2, 3], [0, 1, 2, 3]), Track.of([4, 5, 6, 7], [0, 2, 3, 4])
    report = check(Plan(scenario=scenario, tracks=tracks, run=PlannerRun(name="by hand")))
    assert str(report.faults[0]) == (
        "time 1: zone conflict: R1 at B and R2 at F both book zone door"
        " (let one come when the other has left)"
    )


PASSED = {"vertices": ["F"], "edges": [["A", "B"], ["B", "C"]]}
"""Two edges of the zone meet at B, so that B is in it as F is."""


@pytest.mark.parametrize("end", ["B", "C"])
def test_a_vertex_at_which_two_edges_of_a_zone_meet_is_in_it_for_every_visit(end: str) -> None:
    """R1 stays at B from tick 1 to 7, or for ever; R2 books F from tick 2 to 4."""
    data = document(PASSED)
    data["robots"][0]["target"] = end
    way = ["A", "B", "C"][: "ABC".index(end) + 1]
    tracks = (
        Track.of(["ABC".index(name) for name in way], [0, 1, 7][: len(way)]),
        Track.of([4, 5, 6, 7], [0, 3, 4, 5]),
    )
    plan = Plan(scenario=parse_scenario(data), tracks=tracks, run=PlannerRun(name="by hand"))
    assert check(plan).counts == {"zone conflict": 1}


@pytest.mark.parametrize("edges", [[["A", "B"], ["C", "B"]], [["B", "A"], ["B", "C"]]])
def test_edges_that_only_enter_or_only_leave_a_vertex_meet_there_too(edges: list[Any]) -> None:
    data = document({"edges": edges})
    data["map"]["roadmap"]["edges"] = [
        {"from": tail, "to": head, "both_ways": True}
        for tail, head in data["map"]["roadmap"]["edges"]
    ]
    (zone,) = parse_scenario(data).roadmap.zones
    assert zone.vertices == (1,)  # B


def test_a_robot_whose_home_is_where_two_edges_of_a_zone_meet_starts_in_the_zone() -> None:
    data = document(PASSED)
    data["robots"][0] |= {"home": "B", "target": "D"}
    data["robots"][1] |= {"home": "F", "target": "H"}
    with pytest.raises(NoPlanExists, match="R1 at B and R2 at F would both start in zone door"):
        solve(parse_scenario(data))


@pytest.mark.parametrize("planner", KNOW_ZONES)
def test_a_robot_that_starts_inside_a_zone_leaves_before_another_one_enters(planner: str) -> None:
    """R1 leaves B at tick 1 and the edge to C then; R2 starts into F at 1 instead of 0."""
    data = document(PASSED)
    data["robots"][0] |= {"home": "B", "target": "D"}
    assert solve(parse_scenario(data), planner).flowtime == 2 + 4


def test_a_zone_with_a_lane_that_is_split_has_all_its_pieces() -> None:
    """R1 drives 3 inside; R2 may start into F only when R1 has left."""
    data = document({"vertices": ["F"], "edges": [["A", "B"]]})
    data["map"]["roadmap"]["vertices"]["A"] = [-2, 0]
    data["map"]["spacing"] = 1
    scenario = parse_scenario(data)
    name, (zone,) = scenario.roadmap.name, scenario.roadmap.zones
    edges = [(name(tail), name(head)) for tail, head in zone.edges]
    assert edges == [("A", "A-B/1"), ("A-B/1", "A-B/2"), ("A-B/2", "B")]
    assert [name(vertex) for vertex in zone.vertices] == ["F", "A-B/1", "A-B/2"]
    assert dump_scenario(scenario)["map"]["roadmap"]["zones"][0]["edges"] == [
        list(e) for e in edges
    ]
    # Both in turn: 5 for R1; R2 waits 3 for it, or R1 waits 2 while R2 drives into and out of F.
    assert solve(scenario, "auto", iterations=30).flowtime == 5 + 3 + 2


@pytest.mark.parametrize("planner", KNOW_ZONES)
@pytest.mark.parametrize(
    ("zone", "flowtime"),
    [({"vertices": ["B", "F"]}, 8), ({"edges": [["B", "C"], ["F", "G"]]}, 7), (None, 6)],
)
def test_plans_keep_zones_and_lose_no_more_than_they_must(
    planner: str, zone: dict[str, Any] | None, flowtime: int
) -> None:
    options = {"iterations": 30} if planner in {"auto", "lns"} else {}
    plan = solve(parse_scenario(document(zone)), planner, options=options)
    assert check(plan).ok
    assert plan.flowtime == flowtime


def test_planners_that_do_not_know_zones_refuse_them() -> None:
    scenario = parse_scenario(document({"vertices": ["B", "F"]}))
    for planner in set(find_all()) - set(KNOW_ZONES):
        with pytest.raises(
            InputError, match=f"planner {planner} (does not know .* zones|is for points)"
        ):
            solve(scenario, planner)


def test_two_robots_whose_homes_share_a_zone_have_no_plan() -> None:
    scenario = parse_scenario(document({"vertices": ["A", "E"]}))
    with pytest.raises(NoPlanExists, match="R1 at A and R2 at E would both start in zone door"):
        solve(scenario)


def test_zones_are_written_and_read_and_make_robots_book_ahead() -> None:
    scenario = parse_scenario(document({"vertices": ["B"], "edges": [["F", "G"]]}))
    assert scenario.rules.occupancy == "both"
    written = dump_scenario(scenario)
    assert written["map"]["roadmap"]["zones"] == [
        {"name": "door", "vertices": ["B"], "edges": [["F", "G"]]}
    ]
    assert parse_scenario(written) == scenario


@pytest.mark.parametrize(
    ("zone", "message"),
    [
        ({"vertices": ["B", "X"]}, r"zones\[0\].vertices\[1\]: no vertex is named 'X'"),
        ({"edges": [["A", "C"]]}, r"zones\[0\].edges\[0\]: no edge leads from 'A' to 'C'"),
        ({}, r"zones\[0\]: has neither vertices nor edges"),
    ],
)
def test_zones_of_nothing_are_refused(zone: dict[str, Any], message: str) -> None:
    with pytest.raises(InputError, match=message):
        parse_scenario(document(zone))


def test_fleets_in_python_have_zones() -> None:
    fleet = FleetBuilder(ends="none")
    for name, x, y in [("A", 0, 0), ("B", 1, 0), ("C", 0, 9), ("D", 1, 9)]:
        fleet.add_vertex(name, x, y)
    fleet.add_edge("A", "B").add_edge("C", "D")
    fleet.add_zone("door", vertices=["A"], edges=[("C", "D")])
    fleet.add_robot("R1", home="A", target="B").add_robot("R2", home="C", target="D")
    assert solve(fleet.build_scenario(), "prioritized").flowtime == 3


def test_robots_with_sizes_and_zones_go_together() -> None:
    data = document({"edges": [["B", "C"], ["F", "G"]]})
    for robot in data["robots"]:
        robot["radius"] = 0.3
    plan = solve(parse_scenario(data), "prioritized")
    assert check(plan).ok
    assert plan.flowtime == 7


def test_a_fleet_in_python_may_split_the_lanes_of_a_zone() -> None:
    fleet = FleetBuilder(spacing=1).add_vertex("A", 0, 0).add_vertex("B", 2, 0).add_edge("A", "B")
    (zone,) = fleet.add_zone("door", edges=[("A", "B")]).build_roadmap().zones
    assert zone.edges == ((0, 2), (2, 1))


def test_occupancy_one_is_refused_with_zones() -> None:
    data = document({"vertices": ["B"]})
    data["rules"]["occupancy"] = "one"
    with pytest.raises(InputError, match=r"rules.occupancy: 'one' does not go with zones"):
        parse_scenario(data)
