"""Speed limits of edges, and long lanes split into pieces."""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction
from itertools import pairwise
from math import ceil
from typing import Any

import networkx as nx  # type: ignore[import-untyped]
import pytest

import rightofway
from rightofway import FleetBuilder
from rightofway.errors import InputError
from rightofway.io import dump_scenario, parse_scenario
from rightofway.model import Scenario
from rightofway.planners import Feature, find_all
from rightofway.site import Edge, Roadmap
from rightofway.site.spacing import split_lanes


def limited() -> Scenario:
    """Return two robots that meet on a lane of 2 pieces; the second one is slow for all."""
    fleet = FleetBuilder()
    for name, x, y in [("A", 0, 0), ("B", 6, 0), ("C", 12, 0), ("D", 6, 3)]:
        fleet.add_vertex(name, x, y)
    fleet.add_edge("A", "B").add_edge("B", "C", max_speed="1/2").add_edge("B", "D")
    fleet.add_robot("R1", home="A", target="C", speed=2)
    return fleet.add_robot("R2", home="C", target="D", speed="1/3").build_scenario()


def test_no_robot_is_faster_than_the_limit_of_an_edge_and_none_is_slower_for_it() -> None:
    """6 long: 3 and 18 time units at 2 and 1/3; 12 and 18 where 1/2 is the limit."""
    roadmap = limited().roadmap
    assert roadmap.lengths == (Fraction(3), Fraction(6), Fraction(6))
    assert tuple(each.max_speed for each in roadmap.edge_classes) == (None, None, Fraction(1, 2))
    assert [each.compute_duration(Fraction(2)) for each in roadmap.edge_classes] == [
        Fraction(3, 2),
        Fraction(3),
        Fraction(12),
    ]
    assert [each.compute_duration(Fraction(1, 3)) for each in roadmap.edge_classes] == [
        Fraction(9),
        Fraction(18),
        Fraction(18),
    ]


@pytest.mark.parametrize("planner", sorted(find_all()))
def test_every_planner_keeps_speed_limits(planner: str) -> None:
    plan = rightofway.solve(limited(), planner, time_limit=2)
    may_swap = {"swap conflict"} if Feature.LEAVES_SWAPS in find_all()[planner].features else set()
    assert set(rightofway.check(plan).counts) <= may_swap
    assert plan.flowtime >= plan.lower_bound


def limited_by_type() -> Scenario:
    """Return three robots on a lane of 6: 1 for all, 1/2 for trucks, 3 for drones."""
    fleet = FleetBuilder(ends="none").add_vertex("A", 0, 0).add_vertex("B", 6, 0)
    for name in "CDE":
        fleet.add_vertex(name, 0, 1 + ord(name) - ord("C")).add_edge(name, "A")
    fleet.add_edge("A", "B", max_speed=1, max_speed_by_type={"truck": 0.5, "drone": 3})
    for home, kind in [("C", None), ("D", "truck"), ("E", "drone")]:
        fleet.add_robot(f"R{home}", home=home, target="A", speed=2, type=kind)
    return fleet.build_scenario()


def test_the_limit_of_a_type_holds_instead_of_the_one_for_all() -> None:
    """6 long: 6 time units at 1, 12 at 1/2, 3 at the robot's own speed of 2."""
    scenario = limited_by_type()
    edge = scenario.roadmap.find_edge(*map(scenario.roadmap.get_vertex, "AB"))
    assert edge is not None
    tick, kind = scenario.problem.clock.tick, scenario.roadmap.class_of_edge[edge]
    durations = [each.edge_ticks[kind] * tick for each in scenario.problem.itineraries]
    assert durations == [6, 12, 3]


def test_limits_of_types_are_written_and_read_and_kept_by_pieces_of_lanes() -> None:
    document = dump_scenario(limited_by_type())
    edges = document["map"]["roadmap"]["edges"]
    limits = [edge["max_speed_by_type"] for edge in edges if "max_speed_by_type" in edge]
    assert limits == [{"drone": 3, "truck": "1/2"}] * 2  # one for each direction
    assert parse_scenario(document) == limited_by_type()
    document["map"]["spacing"] = 2
    document["rules"]["occupancy"] = "both"
    roadmap = parse_scenario(document).roadmap
    edge = roadmap.find_edge(*map(roadmap.get_vertex, ("A-B/1", "A-B/2")))
    assert edge is not None
    assert roadmap.get_edge_class(edge).get_speed_limit("drone") == 3


@pytest.mark.parametrize(
    ("limits", "message"),
    [
        ({"truck": 0}, r"max_speed_by_type.truck: 0 is not positive"),
        ({"truck": "fast"}, r"max_speed_by_type.truck: 'fast' is not a number"),
        (["truck"], r"max_speed_by_type: \['truck'\] is not a mapping"),
    ],
)
def test_limits_of_types_that_do_not_fit_are_refused(limits: Any, message: str) -> None:
    document = dump_scenario(limited_by_type())
    document["map"]["roadmap"]["edges"][0]["max_speed_by_type"] = limits
    with pytest.raises(InputError, match=message):
        parse_scenario(document)
    fleet = FleetBuilder().add_vertex("A", 0, 0).add_vertex("B", 1, 0)
    with pytest.raises(InputError, match="max_speed_by_type"):
        fleet.add_edge("A", "B", max_speed_by_type=limits)


def test_limits_are_written_and_read() -> None:
    document = dump_scenario(limited())
    assert document["map"]["roadmap"]["edges"][2]["max_speed"] == "1/2"
    assert parse_scenario(document) == limited()


def test_a_limit_is_above_zero() -> None:
    document = dump_scenario(limited())
    document["map"]["roadmap"]["edges"][2]["max_speed"] = 0
    with pytest.raises(InputError, match=r"edges\[2\].max_speed: 0 is not positive"):
        parse_scenario(document)


def test_both_directions_of_a_lane_have_vertices_of_their_own() -> None:
    at = {"A": (Fraction(0), Fraction(0)), "B": (Fraction(4), Fraction(3))}
    edges = [
        Edge(tail="B", head="A", length=Fraction(5)),
        Edge(tail="A", head="B", length=Fraction(6)),
    ]
    positions, split, pieces, *_ = split_lanes(at, edges, Fraction(2))
    assert list(positions) == ["A", "B", "B-A/1", "B-A/2", "A-B/2", "A-B/1"]
    assert positions["B-A/1"] == positions["A-B/2"] == (Fraction(8, 3), Fraction(2))
    assert [(one.tail, one.head, one.length) for one in split[3:]] == [
        ("A", "A-B/1", Fraction(2)),
        ("A-B/1", "A-B/2", Fraction(2)),
        ("A-B/2", "B", Fraction(2)),
    ]
    assert pieces == {
        ("B", "A"): [("B", "B-A/1"), ("B-A/1", "B-A/2"), ("B-A/2", "A")],
        ("A", "B"): [("A", "A-B/1"), ("A-B/1", "A-B/2"), ("A-B/2", "B")],
    }


def split_both_ways() -> Scenario:
    """Return a robot on a lane of 3 pieces, driven both ways, and a lane of 2 pieces, one way."""
    fleet = FleetBuilder(spacing=2)
    for name, x, y in [("A", 0, 0), ("B-1", 6, 0), ("C", 6, 3)]:
        fleet.add_vertex(name, x, y)
    fleet.add_edge("B-1", "A").add_edge("B-1", "C", both_ways=False)
    return fleet.add_robot("R1", home="A", target="B-1", speed=1).build_scenario()


def names(roadmap: Roadmap, vertices: Iterable[int]) -> list[str]:
    return [roadmap.name(vertex) for vertex in vertices]


def test_a_roadmap_keeps_the_pieces_of_each_lane_that_it_split() -> None:
    roadmap = split_both_ways().roadmap
    assert [names(roadmap, lane.vertices) for lane in roadmap.lanes] == [
        ["A", "A-B-1/1", "A-B-1/2", "B-1"],
        ["B-1", "B-1-A/1", "B-1-A/2", "A"],
        ["B-1", "B-1-C/1", "C"],
    ]
    back = roadmap.lanes[0]
    assert names(roadmap, back.ends) == ["A", "B-1"]
    assert names(roadmap, back.joints) == ["A-B-1/1", "A-B-1/2"]
    assert all(
        roadmap.find_edge(*piece) is not None for lane in roadmap.lanes for piece in lane.pieces
    )


def test_a_file_keeps_the_pieces_of_lanes_by_their_names() -> None:
    """The ends of a lane are found although one of them has a dash in its name."""
    scenario = split_both_ways()
    read = parse_scenario(dump_scenario(scenario))
    assert read == scenario
    assert read.roadmap.lanes == scenario.roadmap.lanes != ()


def test_pieces_of_a_file_that_are_split_again_are_pieces_of_the_whole_lane() -> None:
    document = dump_scenario(split_both_ways())
    document["map"]["spacing"] = 1
    roadmap = parse_scenario(document).roadmap
    pieces = {tuple(names(roadmap, lane.ends)): len(lane.pieces) for lane in roadmap.lanes}
    assert pieces["A", "B-1"] == pieces["B-1", "A"] == 6
    assert pieces["B-1", "C"] == 4


def test_the_ways_along_the_ends_of_a_lane_are_its_drawings() -> None:
    roadmap = split_both_ways().roadmap
    a, b, joint = map(roadmap.get_vertex, ("A", "B-1", "B-1-A/1"))
    assert [names(roadmap, way) for way in roadmap.find_ways_along((b, a))] == [
        ["A", "A-B-1/1", "A-B-1/2", "B-1"],
        ["B-1", "B-1-A/1", "B-1-A/2", "A"],
    ]
    back = roadmap.get_vertex("A-B-1/2")
    assert roadmap.find_ways_along((joint, b)) == [(joint, b), (back, b)]
    assert roadmap.find_ways_along((a, roadmap.get_vertex("C"))) == []


@pytest.mark.parametrize(
    ("vertices", "is_along"),
    [
        (["A", "B-1-A/1"], True),
        (["B-1-A/1", "B-1-A/2"], True),
        (["B-1", "B-1-C/1", "C"], True),
        (["A", "B-1"], False),
        (["B-1-A/1", "C"], False),
        (["B-1-A/1", "B-1-C/1"], False),
    ],
)
def test_vertices_are_along_one_lane_if_one_of_them_is_between_its_pieces(
    vertices: list[str], is_along: bool
) -> None:
    roadmap = split_both_ways().roadmap
    assert roadmap.is_along_one_lane([roadmap.get_vertex(name) for name in vertices]) is is_along


def test_a_lane_that_is_short_enough_stays_whole() -> None:
    at = {"A": (Fraction(0), Fraction(0)), "B": (Fraction(2), Fraction(0))}
    edges = [Edge(tail="A", head="B", length=Fraction(2))]
    split = split_lanes(at, edges, Fraction(2))
    assert (split.positions, list(split.edges), split.pieces) == (at, edges, {})


def test_the_name_of_a_piece_may_not_be_taken() -> None:
    fleet = FleetBuilder(spacing=1)
    fleet.add_vertex("A", 0, 0).add_vertex("B", 2, 0).add_vertex("A-B/1", 5, 5).add_edge("A", "B")
    with pytest.raises(InputError, match="'A-B/1' is the name of a piece of a lane"):
        fleet.build_roadmap()


@pytest.mark.parametrize(
    ("spacing", "radius", "home", "apart"),
    [
        (2, "0.5", 2, 4),
        (2, "1", 2, 4),  # discs may touch: one piece is as long as both radii
        (2, "1.01", 4, 6),
        (2, "2.5", 6, 8),
        (1, "0.5", 1, 2),
        (1, "1.6", 4, 5),
        (3, "0.5", 2, Fraction(40, 7)),  # 14 pieces of 20/7
        (40, "0.5", 40, 80),
    ],
)
@pytest.mark.parametrize("planner", ["prioritized", "lacam", "two-level", "auto"])
def test_a_convoy_on_a_lane_of_40_drives_as_close_as_its_pieces_allow(
    planner: str, spacing: int, radius: str, home: int, apart: Fraction
) -> None:
    """Ten robots stand in a row behind A; they drive 1 + max(1, ceil(D / piece)) pieces apart."""
    ends = {f"G{k}": 40 * (11 - k) for k in range(10)}
    at = {**{f"H{k}": -home * (k + 1) for k in range(10)}, "A": 0, "B": 40, **ends}
    row = sorted(at, key=at.__getitem__)
    document = {
        "format": "rightofway-scenario/1",
        "map": {
            "spacing": spacing,
            "roadmap": {
                "vertices": {name: [at[name], 0] for name in row},
                "edges": [{"from": u, "to": v, "both_ways": False} for u, v in pairwise(row)],
            },
        },
        "robots": [
            {"name": f"R{k}", "home": f"H{k}", "target": f"G{k}", "radius": radius}
            for k in range(10)
        ],
        "rules": {"return": "none"},
    }
    scenario = parse_scenario(document)
    pieces = ceil(Fraction(40) / spacing)
    lane = [label for label in scenario.roadmap.labels or () if label.startswith("A-B/")]
    assert len(lane) == pieces - 1
    given: dict[str, Any] = {
        "prioritized": {"order": "file"},
        "auto": {"iterations": 9, "nodes": 9},
    }
    plan = rightofway.solve(scenario, planner, options=given.get(planner))
    tick, at_b = scenario.problem.clock.tick, scenario.roadmap.get_vertex("B")
    passing = [
        tick * int(track.enter[track.vertices.tolist().index(at_b)]) for track in plan.tracks
    ]
    assert {later - earlier for earlier, later in pairwise(passing)} == {apart}
    assert apart == (1 + max(1, ceil(2 * Fraction(radius) * pieces / 40))) * Fraction(40, pieces)


def test_a_lane_is_not_split_without_end() -> None:
    lane = {"vertices": {"A": [0, 0], "B": [1e9, 0]}, "edges": [["A", "B"]]}
    robots = [{"name": "R1", "home": "A", "target": "B"}]
    drawn = {"roadmap": lane, "spacing": 0.001}
    document = {"format": "rightofway-scenario/1", "map": drawn, "robots": robots}
    with pytest.raises(InputError, match="makes 1000000000000 pieces, more than 100000"):
        parse_scenario(document)


def test_a_lane_far_longer_than_its_drawing_is_not_split() -> None:
    """A length of 21 474 m in a table would set places 0.15 mm apart on a lane of 3.25 m."""
    at = {"A": (Fraction(0), Fraction(0)), "B": (Fraction(13, 4), Fraction(0))}
    wrong = [Edge(tail="A", head="B", length=Fraction(21_474))]
    with pytest.raises(InputError) as caught:
        split_lanes(at, wrong, Fraction(1))
    assert str(caught.value) == (
        "the lane from 'A' to 'B' is 21474 long, but 3.25 in the drawing: a spacing of 1 sets"
        " places 0.00015 apart (correct its length or its ends, draw its way as a curve, or give a"
        " larger spacing)"
    )
    winding = [Edge(tail="A", head="B", length=Fraction(65, 2))]  # 10 times: just possible
    assert len(split_lanes(at, winding, Fraction(1)).edges) == 33
    assert len(split_lanes(at, wrong, Fraction(21_474)).edges) == 1  # whole lanes stay as they are


def test_lanes_of_a_graph_without_positions_are_split_by_their_lengths_alone() -> None:
    graph = nx.Graph()
    graph.add_edge("A", "B", length=40)
    roadmap = FleetBuilder(graph=graph, spacing=2).build_roadmap()
    assert roadmap.n_vertices == 2 + 2 * 19
