"""Points, frames and floors of scenario documents."""

from typing import Any

import pytest

from rightofway.errors import InputError
from rightofway.io import Loaded, dump_scenario, parse_scenario
from rightofway.io.scenario.reader import read_scenario
from tests.builders.sentences import tell_notes

TABLE = {"name": "table", "rect": [1, 0, 1, 1]}


def loaded(shape: dict[str, Any], **robot: Any) -> Loaded:
    robots = [{"name": "R1", "speed": 1, **robot}]
    document = {"format": "rightofway-scenario/1", "map": shape, "robots": robots}
    return read_scenario({**document, "units": {"length": "m"}}, None)


def floor(**keys: Any) -> dict[str, Any]:
    return {"floor": {"size": [3, 2.5], "obstacles": [TABLE]}, **keys}


@pytest.mark.parametrize("speed", [1, 2, 3, "7/3"])
def test_a_home_on_a_floor_does_not_depend_on_the_speed(speed: Any) -> None:
    home = {"x": 2.6, "y": 1.4}
    scenario = loaded(floor(), home=home, target={"x": 0, "y": 0}, speed=speed).scenario
    x, y = scenario.roadmap.get_point(scenario.robots[0].home)
    size = scenario.roadmap.lengths[0]
    assert abs(float(x) - 2.6) <= size / 2
    assert abs(float(y) - 1.4) <= size / 2


def test_a_floor_is_cut_from_the_corner_that_coordinates_begin_at() -> None:
    """2.5 m hold two cells of 1 m: what is left lies below, and above where y grows upwards."""
    trip = {"home": {"x": 0, "y": 0}, "target": {"x": 2, "y": 1}}
    downwards = loaded(floor(), **trip).scenario.roadmap
    upwards = loaded(floor(y="up"), **trip).scenario.roadmap
    assert downwards.grid is not None
    assert upwards.grid is not None
    assert downwards.grid.as_lines() == (".@.", "...")
    assert upwards.grid.as_lines() == ("...", ".@.")
    assert downwards.get_point(0) == upwards.get_point(upwards.get_vertex("N3"))


@pytest.mark.parametrize("y", ["up", "down"])
def test_an_origin_moves_places_and_obstacles_alike(y: str) -> None:
    """The lower left corner of the floor is at (-10, 5); its least y is 2.5 where y points down."""
    low = 5 if y == "up" else 2.5
    table = {**TABLE, "rect": [-9, low, 1, 1]}
    shape = {"floor": {"size": [3, 2.5], "obstacles": [table]}, "y": y, "origin": [-10, 5]}
    there = {"home": {"x": -9.9, "y": low + 0.1}, "target": {"x": -7.1, "y": low + 1.9}}
    here = {"home": {"x": 0.1, "y": 0.1}, "target": {"x": 2.9, "y": 1.9}}
    moved, plain = loaded(shape, **there).scenario, loaded(floor(y=y), **here).scenario
    assert moved.robots == plain.robots
    assert moved.roadmap != plain.roadmap
    assert parse_scenario(dump_scenario(moved)) == moved


def test_names_of_obstacles_stay_with_the_grid_that_a_floor_is_cut_into() -> None:
    nameless = {"rect": [0, 1, 1, 1]}
    shape = {"floor": {"size": [3, 2.5], "obstacles": [TABLE, nameless]}}
    trip = {"home": {"x": 0, "y": 0}, "target": {"x": 2, "y": 1}}
    scenario = loaded(shape, **trip).scenario
    document = dump_scenario(scenario)
    assert document["map"]["obstacles"] == [TABLE]
    assert dump_scenario(parse_scenario(document)) == document
    without = loaded({"floor": {"size": [3, 2.5], "obstacles": [nameless]}}, **trip).scenario
    assert "obstacles" not in dump_scenario(without)["map"]


def test_the_document_of_a_floor_without_units_is_the_one_of_its_grid() -> None:
    trip = {"name": "R1", "home": "N0", "target": "N2", "speed": 1}
    document = {"format": "rightofway-scenario/1", "map": floor(), "robots": [trip]}
    assert set(dump_scenario(parse_scenario(document))["map"]) == {"grid", "cell_size"}


@pytest.mark.parametrize("beside", ["floor", "roadmap"])
def test_only_a_grid_has_obstacles_beside_it(beside: str) -> None:
    shape = {"floor": {"size": [3, 2]}, "roadmap": {"vertices": {"A": [0, 0]}, "edges": []}}
    with pytest.raises(InputError, match=f"obstacles are given beside a {beside}"):
        loaded({beside: shape[beside], "obstacles": [TABLE]}, home={"x": 0, "y": 0})


def test_what_blocks_a_point_on_a_floor_is_named() -> None:
    with pytest.raises(InputError) as caught:
        loaded(floor(y="up"), home={"x": 1.5, "y": 0.5}, target="N0")
    assert str(caught.value) == (
        "robots[0].home: {x: 1.5, y: 0.5} lies in N4, row 1, column 1, which is blocked by table"
        " (the nearest free cell is N1 at {x: 1.5, y: 1.5}, 1 m away)"
    )


def test_a_roadmap_has_no_origin() -> None:
    shape = {"roadmap": {"vertices": {"a": [0, 0]}, "edges": []}, "origin": [1, 1]}
    with pytest.raises(InputError, match="origin is given with a roadmap, whose vertices have"):
        loaded(shape, home="a", target="a")


def test_lengths_that_are_no_fractions_are_rounded_up_with_a_note() -> None:
    vertices = {"a": [0, 0], "b": [1.1, 1.3], "c": [3, 4]}
    edges = [["a", "b"], ["a", "c"], ["b", "c", 7]]
    found = loaded({"roadmap": {"vertices": vertices, "edges": edges}}, home="a", target="c")
    assert tell_notes(found)[0] == "1 of 3 lengths rounded up to 0.001 m"
    assert [str(length) for length in found.scenario.roadmap.lengths] == ["1703/1000", "5", "7"]


def test_spaces_that_count_as_blocked_are_noted() -> None:
    shape = {"grid": ["....", ".  ."]}
    assert tell_notes(loaded(shape, home="N0", target="N3")) == (
        "2 spaces count as blocked in the grid (write . for a free cell)",
    )
