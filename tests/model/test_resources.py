"""What robots with a size exclude each other from."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from functools import cache, partial
from itertools import permutations, product

import numpy as np
import pytest

from rightofway.errors import InputError
from rightofway.io import parse_scenario
from rightofway.model import Resources, Rules, Scenario
from rightofway.model.resources import bind_resources, circumscribe, close_pairs
from rightofway.native import bind_lists, find_clashes, find_vertices_near, list_excluded
from rightofway.site import Edge, Roadmap, make_grid_roadmap, make_roadmap
from rightofway.site.zones import NamedZone
from tests.builders.any_fleet import any_fleet
from tests.builders.fleets import grid_fleet
from tests.builders.laws import law, leave, once
from tests.builders.sizes import crossing
from tests.oracles.space import incompatible


def lists(resources: Resources) -> list[list[int]]:
    assert not resources.are_points
    return [list_excluded(resources, row) for row in range(resources.n_rows)]


def test_a_point_excludes_others_from_its_vertex_and_needs_no_lists() -> None:
    """Three vertices, then four edges."""
    trips = [("N0", "N2"), ("N2", "N0")]
    resources = grid_fleet(["..."], trips).problem.resources
    assert bind_lists(resources) is None
    excluded = [list_excluded(resources, row) for row in range(7)]
    assert excluded == [[0], [1], [2], [], [], [], []]
    assert list(find_clashes(resources, [1, 2])) == []
    assert find_vertices_near(resources, 0, 2) == [2]


def test_crossing_lanes_exclude_each_other_in_both_directions() -> None:
    """Edges of A, B, C, D are rows 4 to 7; 4 and 5 cross 6 and 7."""
    assert lists(crossing().problem.resources) == [
        [0],
        [1],
        [2],
        [3],
        [6, 7],
        [6, 7],
        [4, 5],
        [4, 5],
    ]


@pytest.mark.parametrize(
    ("radius", "near"), [("0.49", 1), ("0.5", 1), ("0.51", 5), ("0.7", 5), ("0.71", 9), ("1", 9)]
)
def test_on_a_grid_discs_that_touch_are_apart(radius: str, near: int) -> None:
    """The centre of a 5 x 5 grid has itself, 4 cells at distance 1, 4 at 1.414…, 4 at 2."""
    roadmap = make_grid_roadmap(["....."] * 5)
    resources = bind_resources(roadmap, [Fraction(radius)], Fraction(0))
    assert len(list_excluded(resources, 12)) == near
    assert not any(len(list_excluded(resources, row)) for row in range(25, 25 + roadmap.n_edges))


@pytest.mark.parametrize("shift", [(0, 0), (1_000_000, -7_000_000), (0.3, 1e-7)])
def test_moving_a_layout_changes_nothing(shift: tuple[float, float]) -> None:
    """Gaps of exactly 0.3, which binary floating-point numbers do not hold."""

    def row_of_vertices(dx: Fraction, dy: Fraction) -> Roadmap:
        at = {f"V{k}": (float(Fraction(k, 10) + dx), float(dy)) for k in range(12)}
        edges = [
            Edge(tail=f"V{k}", head=f"V{k + 1}", length=Fraction(1, 10)) for k in range(len(at) - 1)
        ]
        return make_roadmap(at, edges)

    here, there = (
        bind_resources(
            row_of_vertices(*map(Fraction, map(str, by))), [Fraction("0.15")], Fraction(0)
        )
        for by in ((0, 0), shift)
    )
    assert lists(here) == lists(there)
    assert lists(here)[5] == [3, 4, 5, 6, 7]


def _star(*radii: str) -> Scenario:
    """Six lanes from a vertex that robots only drive through, two robots."""
    ends = [(2, 0), (1, 2), (-1, 2), (-2, 0), (-1, -2), (1, -2)]
    vertices = {"M": {"at": [0, 0], "pass": True}}
    lanes = [{"from": "M", "to": f"v{k}", "length": 3, "both_ways": True} for k in range(6)]
    robots = [
        {"name": f"R{k}", "home": f"v{k}", "target": f"v{k + 3}", "radius": radius}
        for k, radius in enumerate(radii)
    ]
    drawn = {**vertices, **{f"v{k}": list(at) for k, at in enumerate(ends)}}
    return parse_scenario(
        {
            "format": "rightofway-scenario/1",
            "map": {"roadmap": {"vertices": drawn, "edges": lanes}},
            "robots": robots,
        }
    )


# All pairs of a large site take seconds; zones are rows of their own. Each vertex of a chain has
# all parts of the chain, which a star of lanes around one vertex tries with 30 chains.
@law(any_fleet(robots=(2, 3), always={"sizes"}, without={"zones", "spacing"}, tiny=True))
@once(scenario=_star("0", "0"))
@once(scenario=_star("0.3", "0.7"))
def test_rows_exclude_what_the_definition_does_unless_the_ends_of_edges_do(
    scenario: Scenario,
) -> None:
    """For all pairs of vertices and edges, with the sizes of all pairs of robots."""
    roadmap, resources = scenario.roadmap, scenario.problem.resources
    if resources.are_points:
        leave("all radii are 0")
    tails = np.repeat(np.arange(roadmap.n_vertices), np.diff(roadmap.indptr)).tolist()
    edges = list(zip(tails, roadmap.heads.tolist(), strict=True))
    shapes = [*((vertex,) for vertex in range(roadmap.n_vertices)), *edges]

    def with_ends(shape: tuple[int, ...]) -> list[tuple[int, ...]]:
        return [shape] if len(shape) == 1 else [shape, *((end,) for end in shape)]

    excludes = cache(partial(incompatible, scenario))
    for i, j in permutations(range(len(scenario.robots)), 2):
        for x, one in enumerate(shapes):
            found = set(list_excluded(resources, resources.get_vertex_row(i, x)))
            for y, other in enumerate(shapes):
                if resources.get_vertex_row(j, y) in found:
                    assert excludes(i, one, j, other)
                elif excludes(i, one, j, other):
                    ends = product(with_ends(one), with_ends(other))
                    assert any(excludes(i, p, j, q) for p, q in ends if (p, q) != (one, other))


def test_the_circle_around_a_robot_is_rounded_up() -> None:
    assert circumscribe(Fraction("0.6"), Fraction("0.8")) == Fraction(1, 2)
    radius = circumscribe(Fraction(1), Fraction(1))
    assert radius == Fraction("0.707107")
    assert (radius - Fraction(1, 10**6)) ** 2 < Fraction(1, 2) < radius**2


def test_a_robot_with_a_size_makes_the_fleet_book_ahead() -> None:
    assert crossing().rules.occupancy == "both"
    points = tuple(replace(robot, radius=Fraction(0)) for robot in crossing().robots)
    assert replace(crossing(), robots=points, rules=Rules()).rules.occupancy == "one"


def test_rules_that_do_not_fit_to_sizes_are_refused() -> None:
    with pytest.raises(InputError, match=r"rules.occupancy: 'one' is for robots without a size"):
        replace(crossing(), rules=Rules(occupancy="one"))
    with pytest.raises(InputError, match="rules: clearance: -1 is negative"):
        Rules(clearance=Fraction(-1))


def test_clearance_without_sizes_is_refused() -> None:
    with pytest.raises(InputError, match=r"rules.clearance: 1 is for robots with a size"):
        grid_fleet(["..."], [("N0", "N2")], rules=Rules(clearance=Fraction(1)))


def test_an_edge_shorter_than_straight_is_refused() -> None:
    scenario = crossing()
    short = replace(scenario.roadmap.edge_classes[0], length=Fraction("3.9"))
    roadmap = replace(scenario.roadmap, edge_classes=(short,))
    with pytest.raises(InputError, match=r"edge from A to B is 3.9 long, but its ends are 4 apart"):
        replace(scenario, roadmap=roadmap)


def test_close_pairs_are_decided_exactly_and_lanes_that_meet_do_not_cross() -> None:
    """0.3 apart is not nearer than 0.3; A-C and B-D cross, A-C and C-B meet at C."""
    at = {"A": (0.0, 0.0), "B": (4.0, 0.0), "C": (4.0, 4.0), "D": (0.0, 4.0), "M": (0.3, 0.0)}
    lanes = [("A", "C"), ("C", "A"), ("B", "D"), ("C", "B"), ("A", "B")]
    edges = [Edge(tail=tail, head=head, length=Fraction(6)) for tail, head in lanes]
    roadmap = make_roadmap(at, edges)
    found = close_pairs(roadmap, Fraction("0.3"))
    assert (found.vertices, found.crossings) == ([], [((0, 2), (1, 3))])
    assert found.beside == [(4, (0, 1)), (4, (0, 2))]  # M lies on A-B, and 0.21 from A-C
    nearer = close_pairs(roadmap, Fraction("0.300001"))
    assert (nearer.vertices, nearer.beside) == ([(0, 4)], [])  # A, an end of both, is as near


def test_a_zone_of_too_many_lanes_is_refused_by_name() -> None:
    """2 001 vertices make 2 001 * 2 000 / 2 = 2 001 000 pairs."""
    names = [f"v{k}" for k in range(2_001)]
    positions = {name: (float(k), 0.0) for k, name in enumerate(names)}
    hall = NamedZone(name="hall", vertices=tuple(names))
    roadmap = make_roadmap(
        positions, [Edge(tail="v0", head="v1", length=Fraction(1))], zones=[hall]
    )
    with pytest.raises(
        InputError, match=r"^map\.zones: zone 'hall' holds 2001 vertices and lanes, "
    ):
        bind_resources(roadmap, [Fraction(0)], Fraction(0))
