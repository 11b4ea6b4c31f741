"""What an inspection finds on small sites, each with a known fault."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rightofway.metrics import Finding, Site, inspect
from rightofway.model import Robot, Stop
from rightofway.site import Edge, Roadmap, VertexId, make_grid_roadmap, make_roadmap
from rightofway.site.spacing import split_lanes
from rightofway.units import Units

METRES = Units(length="m", time="s")


def drawn(at: Mapping[str, tuple[float, float]], lanes: str) -> Roadmap:
    """Return a roadmap of lanes like ``A-B`` (both ways) and ``A>B``, as long as they are drawn."""
    edges = []
    for lane in lanes.split():
        tail, head = lane.replace(">", "-").split("-")
        (x, y), (u, v) = at[tail], at[head]
        length = Fraction(repr(((x - u) ** 2 + (y - v) ** 2) ** 0.5)).limit_denominator(1000)
        edges.append(Edge(tail=tail, head=head, length=length))
        if ">" not in lane:
            edges.append(Edge(tail=head, head=tail, length=length))
    return make_roadmap(at, edges)


def robot(name: str, home: int, stop: int, radius: str = "0", **more: str) -> Robot:
    stops = (Stop(at=VertexId(stop)),)
    return Robot(name=name, home=VertexId(home), stops=stops, radius=Fraction(radius), **more)  # type: ignore[arg-type]


def found(site: Site, kind: str) -> list[Finding]:
    return [each for each in inspect(site).findings if each.kind == kind]


SQUARE = {"A": (0.0, 0.0), "B": (4.0, 0.0), "C": (4.0, 4.0), "D": (0.0, 4.0)}


def test_a_site_without_faults_has_no_finding() -> None:
    """A ring of four, driven both ways; two places at opposite corners."""
    site = Site(roadmap=drawn(SQUARE, "A-B B-C C-D D-A"), parking={"A": 0}, stations={"C": 2})
    result = inspect(site)
    assert (result.findings, result.parts, result.one_way, result.places) == ((), (4,), 0, 2)


@pytest.mark.parametrize(
    ("lanes", "kind", "sentence"),
    [
        (
            "A-B B-C C>D",
            "trap",
            "D (station Press) can be entered and not left again (add a lane back, or take it out)",
        ),
        (
            "A-B B-C D>C",
            "unreachable",
            "D (station Press) can be left and not reached (add a lane to it, or take it out)",
        ),
        (
            "A-B B-C",
            "cut off",
            "No lane joins D (station Press) to the largest part (add lanes, or take it out)",
        ),
    ],
)
def test_a_place_outside_of_the_largest_part_is_an_error(
    lanes: str, kind: str, sentence: str
) -> None:
    site = Site(roadmap=drawn(SQUARE, lanes), stations={"Press": 3})
    (finding,) = found(site, kind)
    assert (str(finding), finding.severity, finding.vertices) == (sentence, "error", ("D",))
    assert inspect(site).parts == (3, 1)


def test_vertices_without_a_place_outside_of_the_largest_part_are_one_finding_each_piece() -> None:
    at = SQUARE | {"E": (8.0, 0.0), "F": (8.0, 4.0)}
    (finding,) = found(Site(roadmap=drawn(at, "A-B B-C C-D D-A C>F F>E")), "trap")
    assert (finding.severity, finding.vertices) == ("warning", ("E", "F"))


def test_lanes_that_cross_without_a_vertex_are_found() -> None:
    site = Site(roadmap=drawn(SQUARE, "A-C B-D A-B"))
    (finding,) = found(site, "crossing")
    assert str(finding.fact) == "The lanes A to C and B to D cross without a vertex"
    assert finding.severity == "warning"


def test_a_vertex_on_a_lane_that_does_not_end_there_is_found() -> None:
    at = SQUARE | {"M": (2.0, 0.0)}
    (finding,) = found(Site(roadmap=drawn(at, "A-B B-C C-D D-M")), "too near")
    assert str(finding.fact) == "M lies on the lane A to B and is no end of it"


def test_vertices_nearer_than_the_robots_are_wide_are_found_exactly() -> None:
    """0.9 m are enough for two robots of radius 0.45 m, 0.4 m are not."""
    at = {"P1": (0.0, 0.0), "P2": (0.9, 0.0), "P3": (5.0, 0.0), "P4": (5.4, 0.0)}
    roadmap = drawn(at, "P1-P2 P2-P3 P3-P4")
    robots = (robot("R1", 0, 2, "0.45"), robot("R2", 1, 3, "0.45"))
    (finding,) = found(Site(roadmap=roadmap, units=METRES, robots=robots), "too near")
    assert str(finding) == (
        "P3 (stop of R1) and P4 (stop of R2) are 0.4 m apart; robots of radius 0.45 m need 0.9 m"
        " (move one, or use smaller robots)"
    )
    assert finding.severity == "warning"


def split(at: Mapping[str, tuple[int, int]], lanes: str, length: int, distance: int) -> Roadmap:
    """Return a roadmap of lanes like ``drawn``, all of one length, with the long ones in pieces."""
    positions = {name: (Fraction(x), Fraction(y)) for name, (x, y) in at.items()}
    both = [
        lane for lane in lanes.split() for lane in ([lane, lane[::-1]] if "-" in lane else [lane])
    ]
    edges = [Edge(tail=lane[0], head=lane[-1], length=Fraction(length)) for lane in both]
    pieces = split_lanes(positions, edges, None, distance=Fraction(distance))
    floats = {name: (float(x), float(y)) for name, (x, y) in pieces.positions.items()}
    return make_roadmap(floats, pieces.edges, pieces=pieces.pieces)


def test_lanes_in_pieces_that_cross_are_named_as_they_are_drawn() -> None:
    """Each lane of 8 m is two pieces, which meet in its middle, where the other one is, too."""
    at = {"A": (0, 0), "B": (8, 0), "C": (4, -4), "D": (4, 4)}
    robots = (robot("R1", 0, 1, "1"), robot("R2", 2, 3, "1"))
    site = Site(roadmap=split(at, "A>B C>D", 8, 2), units=METRES, robots=robots)
    (finding,) = found(site, "crossing")
    assert str(finding.fact) == "The lanes A to B and C to D cross without a vertex"
    assert (finding.severity, finding.vertices) == ("note", ("A", "B", "C", "D"))
    assert "wait for each other" in str(finding)
    assert found(site, "too near") == []


@pytest.mark.parametrize(("y", "is_near"), [(1, True), (2, False)])
def test_a_vertex_beside_a_joint_is_beside_the_lane(y: int, is_near: bool) -> None:
    """Robots of radius 1 need 2 m; the lane has joints every 6 m, and M is beside the second."""
    at = {"A": (0, 0), "B": (24, 0), "M": (12, y), "P": (12, 24)}
    roadmap = split(at, "A-B M-P", 24, 2)
    assert roadmap.name(4) == "A-B/1"
    site = Site(roadmap=roadmap, units=METRES, robots=(robot("R1", 0, 1, "1"),))
    facts = [str(finding.fact) for finding in found(site, "too near")]
    fact = "M is too near to the lane A to B; robots of radius 1 m need 2 m"
    assert facts == ([fact] if is_near else [])


def test_a_lane_in_pieces_is_one_edge_and_no_corridor() -> None:
    """A ring of two-way lanes and one that leads one way, all of four pieces."""
    at = {"A": (0, 0), "B": (24, 0), "C": (24, 24), "D": (0, 24)}
    roadmap = split(at, "A-B B-C C-D D>A", 24, 2)
    assert roadmap.n_vertices == 4 + 3 * 2 * 3 + 3, "a vertex for each direction between pieces"
    fleet = (robot("R1", 0, 2, "1"), robot("R2", 3, 1, "1"))
    result = inspect(Site(roadmap=roadmap, units=METRES, robots=fleet))
    assert (result.vertices, result.edges, result.one_way, result.parts) == (4, 7, 1, (4,))
    joints = [name for finding in result.findings for name in finding.vertices if "/" in name]
    assert joints == []


def test_a_corridor_of_lanes_in_pieces_is_as_long_as_they_are() -> None:
    """Between A and D all is one corridor, by way of B and C; its joints are not named."""
    at = {"A": (0, 0), "B": (24, 0), "C": (48, 0), "D": (72, 0)}
    roadmap = split(at, "A-B B-C C-D", 24, 2)
    fleet = (robot("R1", 0, 3, "1"), robot("R2", 3, 0, "1"))
    (finding,) = found(Site(roadmap=roadmap, units=METRES, robots=fleet), "corridor")
    assert str(finding.fact).startswith("B to C is a corridor of 72 m without a passing place")
    assert finding.vertices == ("A", "B", "C", "D")


def test_a_joint_stays_a_vertex_where_a_robot_lives_or_another_lane_ends() -> None:
    at = {"A": (0, 0), "B": (24, 0)}
    roadmap = split(at, "A-B", 24, 2)
    middle = roadmap.get_vertex("A-B/2")
    assert inspect(Site(roadmap=roadmap)).vertices == 2
    lived_at = inspect(Site(roadmap=roadmap, robots=(robot("R1", middle, 1, "1"),)))
    assert (lived_at.vertices, lived_at.edges) == (3, 3), "from A to B by the middle, and back"
    at_names = {
        name: (float(x), float(y))
        for name in ("A", "B", "A-B/1", "A-B/2", "A-B/3")
        for x, y in [roadmap.get_point(roadmap.get_vertex(name))]
    }
    places = at_names | {"Bay": (12.0, 9.0)}
    ends = [
        (f"A-B/{k}" if 0 < k < 4 else "AB"[k > 0], f"A-B/{k + 1}" if k < 3 else "B")
        for k in range(4)
    ]
    both = [*ends, *((head, tail) for tail, head in ends), ("A-B/3", "Bay"), ("Bay", "A-B/3")]
    edges = [Edge(tail=tail, head=head, length=Fraction(9)) for tail, head in both]
    backwards = [(head, tail) for tail, head in reversed(ends)]
    pieces = {("A", "B"): ends, ("B", "A"): backwards}
    joined = inspect(Site(roadmap=make_roadmap(places, edges, pieces=pieces)))
    assert (joined.vertices, joined.edges) == (4, 6), "A, A-B/3, B and Bay"


def test_homes_that_are_too_near_are_an_error() -> None:
    at = {"P1": (0.0, 0.0), "P2": (0.5, 0.0), "P3": (5.0, 0.0)}
    robots = (robot("R1", 0, 2, "0.45"), robot("R2", 1, 2, "0.45"))
    site = Site(roadmap=drawn(at, "P1-P2 P2-P3"), robots=robots)
    (finding,) = found(site, "too near")
    assert (finding.severity, finding.vertices) == ("error", ("P1", "P2"))


def test_homes_are_judged_by_the_robots_that_live_there() -> None:
    """The homes are 0.5 m apart: enough for 0.1 and 0.4 m; a larger robot lives elsewhere."""
    at = {"P1": (0.0, 0.0), "P2": (0.5, 0.0), "P3": (5.0, 0.0), "P4": (9.0, 0.0)}
    robots = (robot("R1", 0, 2, "0.1"), robot("R2", 1, 2, "0.4"), robot("R3", 3, 2, "0.45"))
    site = Site(roadmap=drawn(at, "P1-P2 P2-P3 P3-P4"), units=METRES, robots=robots)
    (finding,) = found(site, "too near")
    assert finding.severity == "warning"
    assert "robots of radius 0.45 m and 0.4 m need 0.85 m" in str(finding.fact)


def test_a_lane_beside_a_vertex_is_too_near() -> None:
    at = SQUARE | {"M": (2.0, 0.3)}
    site = Site(
        roadmap=drawn(at, "A-B B-C C-D D-A D-M"), units=METRES, robots=(robot("R1", 3, 1, "0.2"),)
    )
    (finding,) = found(site, "too near")
    assert str(finding.fact) == (
        "M is too near to the lane A to B; robots of radius 0.2 m need 0.4 m"
    )


def test_cells_smaller_than_the_robots_are_one_finding() -> None:
    site = Site(roadmap=make_grid_roadmap(["....."]), robots=(robot("R1", 0, 4, "0.6"),))
    _walls, finding = found(site, "too near")
    assert str(finding.fact).startswith("The middles of cells are 1 length unit apart; robots of")


def test_a_home_on_the_only_way_gets_a_parking_place_that_no_route_needs() -> None:
    """A row of four cells with a bay below the second; R2 lives in the row, the bay is free."""
    roadmap = make_grid_roadmap([".....", "@@.@@"])
    robots = (robot("R1", 0, 4), robot("R2", 1, 3))
    (home,) = [
        each
        for each in found(Site(roadmap=roadmap, robots=robots), "through way")
        if each.severity == "warning"
    ]
    assert str(home) == (
        "N1 (home of R2) lies on the only way between N0 (home of R1) and 2 other places"
        " (park at N7, 1.41 length units away, which no route needs, or add a way round)"
    )


def test_a_home_that_shortest_routes_pass_gets_a_parking_place_too() -> None:
    """R2 lives in the middle of the direct way; the way round is longer, and the bay is free."""
    at = SQUARE | {"M": (2.0, 0.0), "Bay": (4.0, -1.0)}
    roadmap = drawn(at, "A-M M-B B-C C-D D-A B-Bay")
    site = Site(roadmap=roadmap, units=METRES, robots=(robot("R1", 0, 1), robot("R2", 4, 2)))
    (finding,) = [each for each in found(site, "through way") if each.severity == "warning"]
    assert str(finding.fact).startswith("M (home of R2) is on 50 % of the shortest routes, and")
    assert str(finding.remedy).startswith("park at Bay, 2.24 m away, which no route needs")


def test_a_home_beside_the_way_is_not_on_it() -> None:
    roadmap = make_grid_roadmap([".....", "@@.@@"])
    site = Site(roadmap=roadmap, robots=(robot("R1", 0, 4), robot("R2", 5, 4)))
    assert [each.vertices[0] for each in found(site, "through way")] == []


def test_a_one_way_ring_makes_every_place_a_through_way() -> None:
    """No articulation point, but each vertex has to be passed all the same."""
    site = Site(roadmap=drawn(SQUARE, "A>B B>C C>D D>A"), stations={"A": 0, "B": 1, "C": 2, "D": 3})
    assert {each.vertices[0] for each in found(site, "through way")} == {"A", "B", "C", "D"}


def test_a_corridor_counts_the_robots_that_must_pass_it() -> None:
    """Two halls joined by three cells: R1 and R2 cross, R3 stays in its hall."""
    roadmap = make_grid_roadmap(["..@@@..", "......."])
    robots = (robot("R1", 0, 3), robot("R2", 2, 1), robot("R3", 4, 1))
    (finding,) = found(Site(roadmap=roadmap, units=METRES, robots=robots), "corridor")
    assert str(finding) == (
        "(2.5, 1.5) to (4.5, 1.5) is a corridor of 4 m without a passing place; 2 of 3 robots must"
        " use it, and no way leads round it (add a passing place in the middle, or make it one-way"
        " with a way back)"
    )
    assert (finding.severity, finding.robots) == ("warning", ("R1", "R2"))


def test_a_corridor_that_one_robot_uses_is_no_finding() -> None:
    """R2 works in the corridor, so that it counts; alone, R1 meets nobody there."""
    roadmap = make_grid_roadmap(["..@@@..", "......."])
    alone = (robot("R1", 0, 3), robot("R2", 1, 4))
    assert found(Site(roadmap=roadmap, robots=alone), "corridor") == []
    (finding,) = found(Site(roadmap=roadmap, robots=(alone[0], robot("R2", 1, 7))), "corridor")
    assert finding.robots == ("R1", "R2")


def test_a_corridor_with_a_way_round_is_a_note() -> None:
    roadmap = make_grid_roadmap(["..@@@..", ".......", "..@@@..", "......."])
    site = Site(roadmap=roadmap, robots=(robot("R1", 4, 10),))
    assert {each.severity for each in found(site, "corridor")} == {"note"}


def test_a_corridor_that_few_routes_take_is_no_finding_where_there_is_a_way_round() -> None:
    """Twelve homes drive straight on at the left; the thirteenth may take the three cells."""
    rows = ["............", "............", "@@@@....@@@.", "@@@@...@...."]
    roadmap = make_grid_roadmap(rows)
    straight = [robot(f"R{at}", at, at + 12) for at in range(12)]
    site = Site(roadmap=roadmap, robots=(*straight, robot("R", 32, 31)))
    assert found(site, "corridor") == []


def test_a_corridor_that_nobody_uses_is_no_finding() -> None:
    roadmap = make_grid_roadmap(["..@@@..", "......."])
    assert found(Site(roadmap=roadmap, robots=(robot("R1", 0, 1),)), "corridor") == []


def test_the_busiest_vertex_is_a_bottleneck_with_its_share() -> None:
    """A star: all six routes between its three ends lead through the middle."""
    at = {"M": (0.0, 0.0), "A": (4.0, 0.0), "B": (0.0, 4.0), "C": (-4.0, 0.0)}
    site = Site(roadmap=drawn(at, "M-A M-B M-C"), stations={"A": 1, "B": 2, "C": 3})
    (finding,) = found(site, "bottleneck")
    assert str(finding.fact) == "M is on 100 % of the shortest routes between places"
    assert inspect(site).sampled is None


def test_an_open_floor_without_places_has_no_bottleneck_and_one_with_a_door_has() -> None:
    open_floor = ["." * 24] * 16
    assert inspect(Site(roadmap=make_grid_roadmap(open_floor), units=METRES)).findings == ()
    walled = ["." * 14 + "@" + "." * 9] * 16
    walled[7] = "." * 24
    (finding,) = inspect(Site(roadmap=make_grid_roadmap(walled), units=METRES)).findings
    assert str(finding.fact).startswith("(13.5, 7.5) is on")  # the cell before the door


def test_a_stop_that_cannot_be_reached_is_an_error_of_its_robot() -> None:
    robots = (robot("R1", 0, 1), robot("R2", 2, 3))
    site = Site(roadmap=drawn(SQUARE, "A-B B-C C>D"), robots=robots)
    (finding,) = found(site, "trip")
    assert (str(finding.fact), finding.robots) == (
        "R2 cannot drive from D (stop of R2) to C (home of R2)",
        ("R2",),
    )
    one_way = (robots[0], robot("R2", 2, 3, ends="none"))
    assert found(Site(roadmap=site.roadmap, robots=one_way), "trip") == []


def test_errors_come_before_warnings_and_notes() -> None:
    at = SQUARE | {"E": (8.0, 8.0)}
    site = Site(roadmap=drawn(at, "A-C B-D A-B"), stations={"Press": 4, "Oven": 0})
    severities = [each.severity for each in inspect(site).findings]
    assert severities == sorted(severities, key=["error", "warning", "note"].index)
    assert severities[0] == "error"


def test_a_large_site_without_places_says_how_it_was_sampled() -> None:
    result = inspect(Site(roadmap=make_grid_roadmap(["." * 20] * 20)))
    assert result.sampled == (16, 400)


ROOM = make_grid_roadmap(["...", "...", "..."])
HOMES = st.permutations(range(9))


@given(HOMES, HOMES, st.sampled_from(["0", "2/5"]), st.sampled_from(["0", "2/5"]))
def test_sites_of_one_gist_have_the_same_findings(
    one: list[int], other: list[int], thin: str, wide: str
) -> None:
    """One fleet at two speeds, and a fleet with other homes, stops or radii."""

    def site(places: list[int], radius: str, speed: str) -> Site:
        fleet = [robot(f"R{k}", places[k], places[k + 3], radius, speed=speed) for k in range(3)]
        return Site(roadmap=ROOM, robots=fleet)

    first, faster, second = site(one, thin, "1"), site(one, thin, "2"), site(other, wide, "1")
    assert first.gist == faster.gist
    assert inspect(first) == inspect(faster)
    assert (first.gist == second.gist) == (one[:6] == other[:6] and thin == wide)
