"""Lanes that cross without a vertex: named where two robots can meet there, and only there."""

from __future__ import annotations

from collections.abc import Collection
from fractions import Fraction
from itertools import product

import numpy as np
from hypothesis import strategies as st

from rightofway.io.scenario.crossings import note_crossings
from rightofway.metrics import Site, inspect
from rightofway.model import Robot, Rules, Scenario, Stop
from rightofway.native import list_excluded
from rightofway.site import Edge, make_roadmap
from rightofway.site.spacing import split_lanes
from rightofway.site.zones import NamedZone
from tests.builders.laws import law

AT = {"A": (0, 0), "B": (4, 0), "C": (2, -2), "D": (2, 2), "E": (0, 9), "F": (4, 9)}
"""A-B and C-D cross at (2, 0); E and F are aside, and R1 drives from one to the other."""

Members = tuple[Collection[str], Collection[str]]


def make_crossing(edges: Collection[str], zones: Collection[Members], pieces: int) -> Scenario:
    """Return lanes that cross, each in a number of pieces, and zones of vertices and edges."""
    points = {name: (Fraction(x), Fraction(y)) for name, (x, y) in AT.items()}
    lanes = [Edge(tail=lane[0], head=lane[1], length=Fraction(4)) for lane in [*edges, "EF", "FE"]]
    split = split_lanes(points, lanes, Fraction(4, pieces))
    roadmap = make_roadmap(
        {name: (float(x), float(y)) for name, (x, y) in split.positions.items()},
        split.edges,
        pieces=split.pieces,
        zones=[
            NamedZone(
                name=f"Z{number}",
                vertices=tuple(sorted(vertices)),
                edges=tuple((lane[0], lane[1]) for lane in sorted({*of_edges} & {*edges})),
            )
            for number, (vertices, of_edges) in enumerate(zones)
            if vertices or {*of_edges} & {*edges}
        ],
    )
    home, stop = map(roadmap.get_vertex, "EF")
    robots = (Robot(name="R1", home=home, stops=(Stop(at=stop),)),)
    return Scenario(roadmap=roadmap, robots=robots, rules=Rules())


def list_bookings(scenario: Scenario, axis: int) -> list[set[int]]:
    """List the rows that a drive across (2, 0) books, for each edge along an axis."""
    roadmap, resources = scenario.roadmap, scenario.problem.resources
    crossing, bookings = (2.0, 0.0), []
    for edge, tail in enumerate(np.repeat(range(roadmap.n_vertices), np.diff(roadmap.indptr))):
        ends = [int(tail), int(roadmap.heads[edge])]
        along, across = roadmap.positions[ends][:, [axis, 1 - axis]].T.tolist()
        if across == [crossing[1 - axis]] * 2 and min(along) <= crossing[axis] <= max(along):
            rows = {resources.get_vertex_row(0, end) for end in ends}
            bookings.append(rows | {resources.get_edge_row(0, edge)})
    return bookings


def can_meet(scenario: Scenario) -> bool:
    """Return whether a drive along A-B and one along C-D can both be at the crossing at once."""
    return any(
        not any(others.intersection(list_excluded(scenario.problem.resources, row)) for row in rows)
        for rows, others in product(list_bookings(scenario, 0), list_bookings(scenario, 1))
    )


EDGES = st.tuples(
    st.sampled_from([("AB",), ("BA",), ("AB", "BA")]),
    st.sampled_from([("CD",), ("DC",), ("CD", "DC")]),
).map(lambda lanes: [*lanes[0], *lanes[1]])
ZONES = st.lists(
    st.tuples(
        st.frozensets(st.sampled_from("ABCD"), max_size=2),
        st.frozensets(st.sampled_from(["AB", "BA", "CD", "DC"]), max_size=4),
    ),
    max_size=3,
)


@law(EDGES, ZONES, st.integers(1, 3))
def test_a_crossing_is_named_exactly_where_two_robots_can_meet_there(
    edges: list[str], zones: list[Members], pieces: int
) -> None:
    scenario = make_crossing(edges, zones, pieces)
    roadmap, rules = scenario.roadmap, scenario.rules
    findings = inspect(Site(roadmap=roadmap, robots=scenario.robots, rules=rules)).findings
    named = [finding.vertices for finding in findings if finding.kind == "crossing"]
    assert bool(named) == can_meet(scenario), named
    if pieces != 2:  # two pieces have joints at the crossing, and no edges that cross
        assert any(note_crossings(scenario)) == bool(named)
