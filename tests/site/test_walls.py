"""Robots wider than a cell keep out of the walls of a grid, where the rules say so."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import rightofway
from rightofway.errors import InputError, NoPlanExists
from rightofway.io import dump_scenario, parse_scenario
from rightofway.metrics import Site, inspect
from rightofway.model import Scenario
from rightofway.site import make_grid_roadmap
from rightofway.site.occupancy import Occupancy
from rightofway.site.walls import clear_of_walls, reaches_walls

HALL = ["......", "......", "..@...", "......", "......"]


def hall(radius: str, walls: str = "strict", home: str = "N13", target: str = "N16") -> Scenario:
    robot = {"name": "R1", "home": home, "target": target, "radius": radius}
    return parse_scenario(
        {
            "format": "rightofway-scenario/1",
            "map": {"grid": HALL},
            "robots": [robot],
            "rules": {"walls": walls},
        }
    )


def test_a_robot_reaches_where_its_disc_leaves_the_free_cells() -> None:
    """A pillar in the middle of 6 x 5 cells: 0.7 cells reach straight, not over the corner."""
    roadmap = make_grid_roadmap(HALL)
    wide = reaches_walls(roadmap, Fraction(7, 10))
    free = {roadmap.name(vertex) for vertex in range(roadmap.n_vertices) if not wide[vertex]}
    corners, right = {"N7", "N9", "N19", "N21"}, {"N10", "N16", "N22"}
    assert free == corners | right
    assert not reaches_walls(roadmap, Fraction(1, 2)).any(), "discs may touch walls"
    assert reaches_walls(roadmap, Fraction(71, 100)).sum() == 29 - len(right), "over the corner"


GRIDS = (
    st.tuples(st.integers(1, 9), st.integers(1, 9))
    .flatmap(
        lambda size: st.lists(
            st.text("..@", min_size=size[0], max_size=size[0]), min_size=size[1], max_size=size[1]
        )
    )
    .filter(lambda rows: any("." in row for row in rows))
)


@given(GRIDS, st.fractions(0, 6, max_denominator=7))
def test_walls_are_reached_as_all_blocked_cells_and_the_border_say(
    rows: list[str], radius: Fraction
) -> None:
    roadmap = make_grid_roadmap(rows)
    width, height = len(rows[0]), len(rows)
    walls = [
        (row, column)
        for row in range(-1, height + 1)
        for column in range(-1, width + 1)
        if not (0 <= row < height and 0 <= column < width and rows[row][column] == ".")
    ]
    assert roadmap.grid is not None
    for vertex, reaches in enumerate(reaches_walls(roadmap, radius)):
        at = roadmap.grid.get_cell(vertex)
        gaps = [
            [max(abs(x - y) - Fraction(1, 2), Fraction(0)) for x, y in zip(at, wall, strict=True)]
            for wall in walls
        ]
        assert reaches == any(down**2 + right**2 < radius**2 for down, right in gaps)


def test_a_robot_larger_than_the_map_reaches_its_border_at_once() -> None:
    roadmap = make_grid_roadmap(["." * 200] * 300)
    assert reaches_walls(roadmap, Fraction(10**12)).all()


def test_edges_are_barred_for_robots_that_are_too_wide() -> None:
    roadmap = make_grid_roadmap(HALL)
    clear = clear_of_walls(roadmap, [Fraction(2, 5), Fraction(7, 10)])
    into = {
        clear.name(int(clear.heads[edge]))
        for edge in range(clear.n_edges)
        if not clear.get_edge_class(edge).is_barred(None, Fraction(7, 10))
    }
    assert into == {"N7", "N9", "N19", "N21", "N10", "N16", "N22"}
    assert not any(each.is_barred(None, Fraction(2, 5)) for each in clear.edge_classes)
    assert clear_of_walls(roadmap, [Fraction(1, 2)]) is roadmap


def test_a_plan_keeps_out_of_walls_and_survives_a_file() -> None:
    """From one end of the right side to the other there is one way that is clear of walls."""
    scenario = hall("0.7", home="N9", target="N22")
    plan = rightofway.solve(scenario)
    visited = {scenario.roadmap.name(vertex) for vertex in plan.tracks[0].vertices.tolist()}
    assert visited == {"N9", "N10", "N16", "N22"}
    assert rightofway.check(plan).ok
    again = parse_scenario(dump_scenario(scenario))
    assert again.roadmap == scenario.roadmap
    assert again.rules.walls == "strict"


def test_a_drive_into_walls_is_a_fault() -> None:
    free = rightofway.solve(hall("0.7", "free", home="N9", target="N21"))
    assert rightofway.check(free).ok
    strict = hall("0.7", home="N9", target="N21")
    report = rightofway.check(replace(free, scenario=strict))
    assert {fault.kind for fault in report.faults} == {"barred"}


def test_places_beside_walls_are_refused_and_no_way_is_proven() -> None:
    with pytest.raises(InputError, match=r"robots\[0\].home: N13 is too near to a wall"):
        hall("0.7")
    with pytest.raises(NoPlanExists):
        rightofway.solve(hall("0.7", home="N7", target="N9"))


def test_strict_walls_need_a_grid() -> None:
    roadmap = {"vertices": {"A": [0, 0], "B": [3, 0]}, "edges": [["A", "B"]]}
    document = {
        "format": "rightofway-scenario/1",
        "map": {"roadmap": roadmap},
        "robots": [{"name": "R1", "home": "A", "target": "B", "radius": 1}],
        "rules": {"walls": "strict"},
    }
    with pytest.raises(InputError, match=r"rules\.walls: 'strict' needs a grid"):
        parse_scenario(document)


def test_an_inspection_says_where_robots_reach_into_walls() -> None:
    scenario = hall("0.7", walls="free")
    site = Site(roadmap=scenario.roadmap, robots=scenario.robots, rules=scenario.rules)
    found = [each for each in inspect(site).findings if "into walls" in str(each.fact)]
    assert [(each.severity, each.robots) for each in found] == [("warning", ("R1",))]
    assert "in 22 cells, for example in N0" in str(found[0].fact)
    assert "walls: strict" in str(found[0].remedy)


def make_rooms(door: int, radius: str, kind: str | None = None) -> Scenario:
    """Return two rooms of 9 x 9 cells of half a metre, with a door of some cells between them."""
    wall = ["." if 4 - door // 2 <= row < 4 - door // 2 + door else "@" for row in range(9)]
    rows = [f"{'.' * 9}{cell}{'.' * 9}" for cell in wall]
    robot = {"name": "R1", "home": [4, 4], "target": [4, 14], "radius": radius}
    return parse_scenario(
        {
            "format": "rightofway-scenario/1",
            "map": {"grid": rows, "cell_size": 0.5},
            "units": {"length": "m", "time": "s"},
            "robots": [robot | ({"type": kind} if kind else {})],
            "rules": {"walls": "strict"},
        }
    )


@pytest.mark.parametrize("kind", [None, "amr"])
@pytest.mark.parametrize(("door", "room"), [(1, "0.25"), (2, "0.25"), (3, "0.75"), (5, "1.25")])
def test_the_room_of_a_door_is_named_where_a_robot_is_too_wide_for_it(
    door: int, room: str, kind: str | None
) -> None:
    """A robot drives along the middles of cells: a door of 2 cells leaves room as one of 1."""
    assert rightofway.solve(make_rooms(door, room, kind)).flowtime > 0
    too_wide = make_rooms(door, str(Fraction(room) + Fraction(1, 100)), kind)
    with pytest.raises(NoPlanExists) as refused:
        rightofway.solve(too_wide)
    radius = f"{float(too_wide.robots[0].radius):g} m"
    assert f"its radius is {radius}, and walls leave room for {room} m at (4.75," in str(
        refused.value
    )
    assert "type" not in str(refused.value)
    site = Site(
        roadmap=too_wide.roadmap, units=too_wide.units, robots=too_wide.robots, rules=too_wide.rules
    )
    [found] = [each for each in inspect(site).findings if each.kind == "trip"]
    assert (found.severity, found.robots) == ("error", ("R1",))
    assert f"1 robot of radius {radius} cannot pass where walls leave room for {room} m" in str(
        found.fact
    )


@pytest.mark.parametrize(("key", "size"), [("cell_size", "1/2"), ("cell_size", "1")])
@pytest.mark.parametrize("radius", ["3/10", "3"])
def test_a_picture_whose_cells_are_too_small_for_a_radius_says_so(
    key: str, size: str, radius: str
) -> None:
    """Free strips of 5 pixels of 0.1 m between walls of one pixel."""
    pixels = np.zeros((60, 60), np.uint8)
    pixels[::6, :] = 100
    picture = Occupancy(pixels=pixels, resolution=Fraction(1, 10))
    with pytest.raises(InputError) as refused:
        picture.free_cells(Fraction(size), radius=Fraction(radius), key=key)
    message = str(refused.value)
    if 2 * Fraction(radius) > Fraction(size):
        assert f"{key}: no cell of {float(Fraction(size))} m has room for a radius of" in message
    else:
        assert message == f"{key}: no cell of 1.0 m is free all over (give a smaller one)"
