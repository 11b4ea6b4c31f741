"""What a closure closes, exactly, and when."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from typing import Any

import pytest

from rightofway import FleetBuilder
from rightofway.model import NEVER, Closure, Scenario


def line(*, radius: str = "0", clearance: str = "0", spacing: Any = "whole") -> Scenario:
    """Return a robot on A - B - C, 4 long each, and D 1 beside the middle of A - B."""
    fleet = FleetBuilder(clearance=clearance, ends="none", spacing=spacing)
    for name, x, y in [("A", 0, 0), ("B", 4, 0), ("C", 8, 0), ("D", 2, 1), ("E", 2, 5)]:
        fleet.add_vertex(name, x, y)
    fleet.add_edge("A", "B").add_edge("B", "C").add_edge("D", "E")
    return fleet.add_robot("R1", home="A", target="C", speed=2, radius=radius).build_scenario()


def closed(scenario: Scenario, closure: Closure) -> set[str]:
    """Return the names of what is closed, an edge as its tail and its head."""
    closures = replace(scenario, closures=(closure,)).problem.closures
    assert closures is not None
    roadmap, found = scenario.roadmap, set()
    for resource in closures.row.tolist():
        if resource < roadmap.n_vertices:
            found.add(roadmap.name(resource))
        else:
            edge = resource - roadmap.n_vertices
            tail = next(v for v in range(roadmap.n_vertices) if roadmap.indptr[v + 1] > edge)
            found.add(f"{roadmap.name(tail)}>{roadmap.name(int(roadmap.heads[edge]))}")
    return found


def at(name: str, radius: str | None = None) -> Closure:
    """Return a closure of a vertex for ever."""
    vertex = line().roadmap.get_vertex(name)
    return Closure(at=vertex, radius=None if radius is None else Fraction(radius))


def test_a_vertex_without_a_radius_is_closed_alone() -> None:
    assert closed(line(radius="2"), at("B")) == {"B"}


def test_discs_that_touch_are_open_and_all_that_is_nearer_is_closed() -> None:
    """D is 1 from the lane between A and B, and the square root of 5 from B."""
    lanes = {"A>B", "B>A"}
    assert closed(line(), at("D", "1")) == {"D", "D>E", "E>D"}
    assert closed(line(), at("D", "1.000001")) == {"D", "D>E", "E>D"} | lanes
    assert closed(line(radius="0.5", clearance="0.25"), at("D", "0.25")) == {"D", "D>E", "E>D"}
    assert closed(line(radius="0.5", clearance="0.25"), at("D", "0.26")) == {
        "D",
        "D>E",
        "E>D",
        *lanes,
    }


def test_a_radius_of_0_closes_the_edges_of_a_vertex_for_robots_with_a_size() -> None:
    assert closed(line(), at("B", "0")) == {"B"}
    assert closed(line(radius="1"), at("B", "0")) == {"B", "A>B", "B>A", "B>C", "C>B"}


def test_a_closed_edge_leaves_its_ends_and_the_edges_there_open() -> None:
    edge = line().roadmap.get_vertex("B"), line().roadmap.get_vertex("A")
    assert closed(line(), Closure(edge=edge)) == {"A>B", "B>A"}
    near = closed(line(), Closure(edge=edge, radius=Fraction(2)))
    assert near == {"A>B", "B>A", "D", "D>E", "E>D"}


def test_a_closed_lane_is_closed_with_all_its_pieces_and_the_vertices_on_it() -> None:
    scenario = line(spacing=2)
    edge = scenario.roadmap.get_vertex("B"), scenario.roadmap.get_vertex("A")
    pieces = {"A>A-B/1", "A-B/1>B", "B>B-A/1", "B-A/1>A"}
    assert closed(scenario, Closure(edge=edge)) == {"A-B/1", "B-A/1", *pieces}
    piece = scenario.roadmap.get_vertex("A"), scenario.roadmap.get_vertex("A-B/1")
    assert closed(scenario, Closure(edge=piece)) == {"A>A-B/1", "B-A/1>A"}


@pytest.mark.parametrize(
    ("begin", "until", "ticks"),
    [("0", "2", (0, 1)), ("1.9", "2.1", (0, 2)), ("2", "4", (1, 2)), ("5", None, (2, NEVER))],
)
def test_from_is_rounded_down_and_until_up(
    begin: str, until: str | None, ticks: tuple[int, int]
) -> None:
    """The only duration is 4 / 2: a tick is 2 time units."""
    scenario = line()
    assert scenario.problem.clock.tick == 2
    closure = replace(
        at("B"), from_=Fraction(begin), until=None if until is None else Fraction(until)
    )
    closures = replace(scenario, closures=(closure,)).problem.closures
    assert closures is not None
    assert (closures.start[0], closures.end[0]) == ticks


def test_closures_that_overlap_or_touch_are_one() -> None:
    scenario = line()
    one = replace(at("B"), until=Fraction(4))
    other = replace(at("B"), from_=Fraction(4), until=Fraction(8))
    closures = replace(scenario, closures=(other, one)).problem.closures
    assert closures is not None
    assert closures.list_at_vertex(0, scenario.roadmap.get_vertex("B")) == [(0, 4)]
