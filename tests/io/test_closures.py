"""Closures, barred edges and surcharges in files: what they mean, and what is wrong with them."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest

import rightofway
from rightofway.errors import InputError
from rightofway.io.movingai import write_scen
from rightofway.io.scenario.reader import parse_scenario, read_scenario
from rightofway.io.scenario.writer import dump_scenario, write_scenario
from tests.builders.sentences import tell_notes

DOCUMENT: dict[str, Any] = {
    "format": "rightofway-scenario/1",
    "map": {
        "roadmap": {
            "vertices": {
                "A": [0, 0],
                "B": {"at": [4, 0], "surcharge": 3},
                "C": [8, 0],
                "D": {"at": [4, 3], "barred": ["heavy"]},
            },
            "edges": [
                ["A", "B"],
                ["B", "C"],
                {"from": "A", "to": "D", "barred": ["1"]},
                ["D", "C"],
            ],
        },
        "spacing": 2,
    },
    "robots": [{"name": "R1", "home": "A", "target": "C", "type": "heavy"}],
    "rules": {"return": "none"},
    "closures": [{"edge": ["B", "A"], "from": "1/3", "until": 5}, {"at": "D", "radius": "1/2"}],
}


@pytest.mark.parametrize("ending", ["yaml", "json", "xlsx"])
def test_a_scenario_comes_back_from_a_file_as_it_was(tmp_path: Path, ending: str) -> None:
    scenario = parse_scenario(DOCUMENT)
    write_scenario(scenario, tmp_path / f"closed.{ending}")
    assert rightofway.load(tmp_path / f"closed.{ending}") == scenario
    assert parse_scenario(dump_scenario(scenario)) == scenario


def test_a_robot_goes_another_way_only_where_it_is_not_barred() -> None:
    """Below, R1 pays 3 for B and waits for the closure; above, heavy robots are barred from D."""
    heavy = parse_scenario(DOCUMENT)
    light = parse_scenario(
        {**DOCUMENT, "robots": [{**DOCUMENT["robots"][0], "type": "light"}], "closures": []}
    )
    assert "D" not in rightofway.solve(heavy)["R1"].vertices
    assert "D" in rightofway.solve(light)["R1"].vertices
    assert rightofway.solve(light).flowtime > rightofway.solve(light).lower_bound


def test_a_lane_in_pieces_shares_its_surcharge() -> None:
    document = {**DOCUMENT, "closures": []}
    edges = [{"from": "A", "to": "C", "length": 8, "surcharge": 3}]
    document["map"] = {
        "roadmap": {"vertices": {"A": [0, 0], "C": [8, 0]}, "edges": edges},
        "spacing": 2,
    }
    assert {each.surcharge for each in parse_scenario(document).roadmap.edge_classes} == {
        Fraction(3, 4)
    }


@pytest.mark.parametrize(
    ("closure", "message"),
    [
        (7, "closures[0]: 7 is not a mapping of keys to values"),
        ({}, "closures[0]: closes nothing (give at, or edge)"),
        ({"at": "A", "edge": ["A", "B"]}, "closures[0]: has both at and edge (give at, or edge)"),
        ({"at": "Q"}, "closures[0].at: no vertex is named 'Q'"),
        ({"edge": ["A", "C"]}, "closures[0].edge: no edge joins A and C"),
        ({"edge": ["A"]}, "closures[0].edge: ['A'] does not fit (give [A, B] instead of at"),
        ({"at": "A", "from": 3, "until": 2}, "closures[0].until: 2 is not after from, 3"),
        ({"at": "A", "until": 0}, "closures[0].until: 0 is not positive"),
        ({"at": "A", "from": -1}, "closures[0].from: -1 is negative"),
        ({"at": "A", "radius": -1}, "closures[0].radius: -1 is negative"),
        ({"at": "A", "untill": 2}, "closures[0].untill: unknown key (did you mean until?)"),
    ],
)
def test_a_closure_that_does_not_fit_is_named_with_place_and_remedy(
    closure: Any, message: str
) -> None:
    with pytest.raises(InputError) as refused:
        parse_scenario({**DOCUMENT, "closures": [closure]})
    assert str(refused.value).startswith(message)
    assert str(refused.value).endswith(")")


@pytest.mark.parametrize(
    ("key", "where"), [("home", "robots[0].home"), ("target", "robots[0].target")]
)
def test_a_place_that_is_barred_for_a_robot_is_named(key: str, where: str) -> None:
    robot = {**DOCUMENT["robots"][0], key: "D"}
    with pytest.raises(InputError) as refused:
        parse_scenario({**DOCUMENT, "robots": [robot]})
    assert str(refused.value) == (
        f"{where}: D is barred for robots of type heavy"
        " (give the robot another place, or another type)"
    )


def test_the_builder_makes_the_same_scenario() -> None:
    fleet = rightofway.FleetBuilder(ends="none", spacing=2).add_vertex("A", 0, 0)
    fleet = fleet.add_vertex("B", 4, 0, surcharge=3).add_vertex("C", 8, 0)
    fleet = fleet.add_vertex("D", 4, 3, barred=["heavy"]).add_edge("A", "B").add_edge("B", "C")
    fleet = fleet.add_edge("A", "D", barred=["1"]).add_edge("D", "C")
    fleet = fleet.add_robot("R1", home="A", target="C", type="heavy")
    fleet = fleet.add_closure(edge=("B", "A"), from_="1/3", until=5)
    fleet = fleet.add_closure(at="D", radius="1/2")
    assert fleet.build_scenario() == parse_scenario(DOCUMENT)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        ({"at": "Q"}, "closure 0: at: no vertex is named 'Q'"),
        ({"edge": ("A", "C")}, "closure 0: edge: no edge joins A and C"),
        ({"at": "A", "until": "x"}, "closure 0: until: 'x' is not a number"),
        ({}, "closure 0: closes not exactly one of a vertex and an edge"),
    ],
)
def test_the_builder_names_what_is_wrong(call: dict[str, Any], message: str) -> None:
    fleet = rightofway.FleetBuilder().add_vertex("A", 0, 0).add_vertex("B", 1, 0)
    fleet = fleet.add_vertex("C", 2, 0).add_edge("A", "B").add_edge("B", "C")
    with pytest.raises(InputError) as refused:
        fleet.add_closure(**call)
    assert str(refused.value).startswith(message)


def test_a_type_that_is_nearly_one_of_the_map_is_noted() -> None:
    robot = {**DOCUMENT["robots"][0], "type": "heavvy"}
    loaded = read_scenario({**DOCUMENT, "robots": [robot]}, None)
    note = "nothing is barred for robots of type 'heavvy' (did you mean 'heavy'?)"
    assert note in tell_notes(loaded)
    assert not any("barred" in note for note in tell_notes(read_scenario(DOCUMENT, None)))


def test_conversion_to_scen_says_that_closures_are_left_out(tmp_path: Path) -> None:
    fleet = rightofway.FleetBuilder(grid=["..."]).add_robot("R1", home="N0", target="N2")
    scenario = fleet.add_closure(at="N1", until=1).build_scenario()
    notes = write_scen(scenario, tmp_path / "a.scen", map_name="a.map")
    assert "closures are left out" in notes


def test_two_lanes_that_are_barred_alike_say_it_each(tmp_path: Path) -> None:
    """YAML of ours has no aliases, which readers may refuse."""
    fleet = rightofway.FleetBuilder(ends="none").add_vertex("A", 0, 0).add_vertex("B", 4, 0)
    fleet = fleet.add_edge("A", "B", barred=["heavy"]).add_robot("R1", home="A", target="B")
    write_scenario(fleet.build_scenario(), tmp_path / "a.yaml")
    text = (tmp_path / "a.yaml").read_text(encoding="utf-8")
    assert text.count("barred: [heavy]") == 2
    assert not {"&", "*"} & set(text)
