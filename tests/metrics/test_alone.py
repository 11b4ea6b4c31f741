"""The shortest completion of a robot that has the floor to itself."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

import pytest
from hypothesis import strategies as st

from rightofway.errors import NoPlanExists
from rightofway.metrics import compute_alone_completions
from rightofway.model import Robot, Rules, Scenario, Stop, make_route
from rightofway.search import Bookings, Distances, compute_least_completions, find_earliest_track
from rightofway.site import Edge, Roadmap, VertexId, make_grid_roadmap, make_roadmap
from tests.builders.any_fleet import any_fleet
from tests.builders.laws import law, leave
from tests.oracles.alone import alone_completions as by_python

GRID = ["....", "@@@.", "...."]
"""From N0 to N8 it is 3 cells east, 2 south and 3 west: 8 edges."""


def alone(
    roadmap: Roadmap,
    stops: Sequence[tuple[str, int]],
    *,
    home: str = "N0",
    speed: Fraction = Fraction(1),
    rules: Rules | None = None,
) -> int:
    """Return the shortest completion of R1 with stops of (place, work)."""
    robot = Robot(
        name="R1",
        home=roadmap.get_vertex(home),
        stops=tuple(Stop(at=roadmap.get_vertex(at), work=Fraction(work)) for at, work in stops),
        speed=speed,
    )
    scenario = Scenario(roadmap=roadmap, robots=(robot,), rules=rules or Rules())
    return compute_alone_completions(scenario)[0]


def on_grid(stops: Sequence[tuple[str, int]], rules: Rules | None = None) -> int:
    return alone(make_grid_roadmap(GRID), stops, rules=rules)


def test_a_round_trip_is_there_work_turning_and_back() -> None:
    assert on_grid([("N8", 5)]) == 8 + 5 + 1 + 8


def test_one_way_nobody_turns() -> None:
    assert on_grid([("N8", 5)], Rules(ends="none")) == 8 + 5


def test_stops_are_visited_in_their_order() -> None:
    # N3 is 3 away, N8 5 further, N11 3 back from there, home 5 from there; three stops to turn at.
    assert on_grid([("N3", 1), ("N8", 2), ("N11", 4)]) == 3 + 5 + 3 + 5 + (1 + 2 + 4) + 3


def test_stops_at_one_vertex_share_a_visit() -> None:
    assert on_grid([("N1", 2), ("N1", 3)]) == 1 + (2 + 3 + 1) + 1
    assert on_grid([("N1", 2), ("N1", 3)], Rules(ends="none")) == 1 + 2 + 3


def test_work_at_home_before_leaving_counts() -> None:
    assert on_grid([("N0", 4), ("N1", 0)]) == (4 + 1) + 1 + 1 + 1


def test_work_at_home_alone_needs_no_turning() -> None:
    assert on_grid([("N0", 4)]) == 4


def test_between_laps_a_robot_turns_at_home() -> None:
    # Three laps of 1 there, 1 turning, 1 back, and 2 turnings at home between them.
    assert on_grid([("N1", 0)], Rules(laps=3)) == 3 * 3 + 2


SHORTCUT = [("A", "B", 1), ("B", "C", 1), ("A", "C", 5), ("C", "A", 7)]
"""Two short edges beat a long one; the way back is one edge."""


def shortcut() -> Roadmap:
    edges = [Edge(tail=tail, head=head, length=Fraction(length)) for tail, head, length in SHORTCUT]
    return make_roadmap(dict.fromkeys("ABC", (0.0, 0.0)), edges)


def test_the_shortest_way_is_the_quickest_not_the_one_of_fewest_edges() -> None:
    assert alone(shortcut(), [("C", 0)], home="A") == (1 + 1) + 7


def test_ways_differ_there_and_back() -> None:
    assert alone(shortcut(), [("C", 0)], home="A", rules=Rules(ends="none")) == 1 + 1


@pytest.mark.parametrize("length", [1, 2])
def test_a_place_without_a_way_back_is_named(length: int) -> None:
    """Once with all edges equally long, once not: the two are searched differently."""
    edges = [
        Edge(tail="dock", head="shelf", length=Fraction(1)),
        Edge(tail="shelf", head="cellar", length=Fraction(length)),
    ]
    roadmap = make_roadmap(dict.fromkeys(("dock", "shelf", "cellar"), (0.0, 0.0)), edges)
    with pytest.raises(NoPlanExists) as raised:
        alone(roadmap, [("shelf", 0)], home="dock")
    assert str(raised.value) == (
        "R1 has no way from shelf to dock: the edge from dock to shelf is one way (let robots drive"
        " it both ways, or give the robot other places)"
    )


def test_every_robot_without_a_way_is_named() -> None:
    """N2 is on the right; R0 and R3 live on the left of the wall, R2 on the right."""
    robots = tuple(
        Robot(name=f"R{home}", home=VertexId(home), stops=(Stop(at=VertexId(1)),))
        for home in (0, 2, 3)
    )
    scenario = Scenario(roadmap=make_grid_roadmap([".@..", ".@.."]), robots=robots)
    with pytest.raises(NoPlanExists) as raised:
        compute_alone_completions(scenario)
    assert raised.value.robots == ("R0", "R3")


@st.composite
def fleets(draw: st.DrawFn) -> tuple[Scenario, Scenario]:
    """Draw a fleet on one-way edges of equal length; then with an edge apart, of another length."""
    n_vertices = draw(st.integers(2, 12))
    names = [f"P{k}" for k in range(n_vertices)]
    ring = [(k, (k + 1) % n_vertices) for k in range(n_vertices)]  # so that each place is reached
    place = st.integers(0, n_vertices - 1)
    more = draw(st.lists(st.tuples(place, place), max_size=20))
    ends = dict.fromkeys((tail, head) for tail, head in ring + more if tail != head)
    edges = [Edge(tail=names[a], head=names[b], length=Fraction(2)) for a, b in ends]
    apart = Edge(tail="here", head="there", length=Fraction(1))
    targets = draw(st.lists(place, min_size=n_vertices, max_size=n_vertices))
    robots = tuple(
        Robot(name=name, home=VertexId(k), stops=(Stop(at=VertexId(targets[k])),))
        for k, name in enumerate(names)
    )
    # On a line the ring leads straight on; where positions are drawn, some ways are straight.
    somewhere = st.tuples(*[st.integers(0, 3).map(float)] * 2)
    drawn = draw(st.none() | st.lists(somewhere, min_size=n_vertices, max_size=n_vertices))
    on_a_line = [(float(k), 0.0) for k in range(n_vertices)]
    positions = dict(zip(names, drawn or on_a_line, strict=True))
    apart_too = positions | {"here": (0.0, 9.0), "there": (1.0, 9.0)}
    return (
        Scenario(roadmap=make_roadmap(positions, edges), robots=robots),
        Scenario(roadmap=make_roadmap(apart_too, [*edges, apart]), robots=robots),
    )


@law(fleets())
def test_counting_edges_for_all_at_once_agrees_with_dijkstra(
    pair: tuple[Scenario, Scenario],
) -> None:
    """An edge of length 2 is one tick, or two of the shorter ticks that an edge of 1 asks for."""
    equal, unequal = map(compute_alone_completions, pair)
    assert unequal == tuple(2 * ticks for ticks in equal)


def test_more_robots_than_bits_of_a_block_are_counted_right() -> None:
    """From the cells of a row, each round the end of a wall, to the cells behind it."""
    roadmap = make_grid_roadmap(["." * 280, "." + "@" * 279, "." * 280])
    robots = tuple(
        Robot(name=f"R{k}", home=VertexId(k), stops=(Stop(at=VertexId(281 + k)),))
        for k in range(280)
    )
    scenario = Scenario(roadmap=roadmap, robots=robots, rules=Rules(ends="none"))
    assert compute_alone_completions(scenario) == tuple(2 * k + 2 for k in range(280))


@law(any_fleet(without={"closures"}))
def test_the_bound_of_a_robot_alone_is_what_it_reaches_alone(scenario: Scenario) -> None:
    """By the native core, by a program in Python, and by the search; alone heeds no closures.

    The search prefers a longer way without a surcharge.
    """
    native = compute_least_completions(scenario)
    assert native is not None
    assert native.tolist() == list(by_python(scenario))
    if (native < 0).any():
        leave("a robot has no way")
    for robot, least in enumerate(native.tolist()):
        track = find_earliest_track(robot, Bookings(scenario.problem), Distances(scenario.roadmap))
        assert track is not None
        work = make_route(scenario.roadmap, scenario.problem.itineraries[robot], track).dwell[-1]
        completion = int(track.enter[-1]) + work
        assert completion >= least if scenario.roadmap.has_surcharges else completion == least
