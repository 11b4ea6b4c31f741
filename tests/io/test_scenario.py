"""Scenario documents become scenarios: every way to write one, and what each means."""

import json
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest

from rightofway.errors import InputError
from rightofway.io import dump_scenario, load, load_with_notes, parse_scenario, write_scenario
from rightofway.io.scenario.fleet import ListedFleet, read_robots
from rightofway.io.scenario.loaded_map import FleetTraits
from rightofway.io.scenario.reader import Loaded, read_scenario
from rightofway.model import Rules, Scenario, Stop
from tests.builders.fleets import grid_fleet
from tests.builders.sentences import tell_notes

DOOR = ["...", "@.@", "..."]


def document(**parts: Any) -> dict[str, Any]:
    """Return a scenario document of the door, with parts replaced."""
    return {
        "format": "rightofway-scenario/1",
        "map": {"grid": DOOR},
        "robots": [{"name": "R1", "home": "N0", "target": "N6"}],
    } | parts


def one_robot(**keys: Any) -> dict[str, Any]:
    return document(robots=[{"name": "R1", "home": "N0", "target": "N6"} | keys])


def test_what_is_left_out_follows_the_paper() -> None:
    assert parse_scenario(document()) == grid_fleet(DOOR, [("N0", "N6")])


def test_a_place_is_a_number_or_row_and_column() -> None:
    robots = [
        {"name": "R1", "home": "N0", "target": "N6"},
        {"name": "R2", "home": [0, 2], "stops": [{"at": [2, 2], "work": 3}, {"at": "N4"}]},
    ]
    scenario = parse_scenario(document(robots=robots))
    vertex = scenario.roadmap.get_vertex
    assert scenario.robots[1].home == vertex("N2")
    assert scenario.robots[1].stops == (
        Stop(at=vertex("N8"), work=Fraction(3)),
        Stop(at=vertex("N4")),
    )


def test_target_and_work_are_short_for_one_stop() -> None:
    short = parse_scenario(one_robot(work="1/2"))
    long = [{"name": "R1", "home": "N0", "stops": [{"at": "N6", "work": 0.5}]}]
    assert parse_scenario(document(robots=long)) == short


def test_a_float_counts_as_the_decimal_that_was_written() -> None:
    assert parse_scenario(one_robot(speed=0.1)).robots[0].speed == Fraction(1, 10)


def test_decimals_of_files_are_exact(tmp_path: Path) -> None:
    for name, text in [
        ("a.yaml", json.dumps(one_robot()).replace('"N6"', '"N6", "speed": 0.1')),
        ("a.json", json.dumps(one_robot()).replace('"N6"', '"N6", "speed": 0.1')),
        ("a.txt", json.dumps(one_robot()).replace('"N6"', '"N6", "speed": 0.1')),
    ]:
        (tmp_path / name).write_text(text, encoding="utf-8")
        assert load(tmp_path / name).robots[0].speed == Fraction(1, 10)


def test_classic_rules_are_those_of_the_benchmark() -> None:
    assert parse_scenario(one_robot() | {"rules": "classic"}).rules == Rules(
        occupancy="one", turn=Fraction(0), ends="none"
    )
    with pytest.raises(InputError, match=r"rules: 'clasic' is no name of rules \(give classic, or"):
        parse_scenario(one_robot() | {"rules": "clasic"})


def test_rules_and_what_a_robot_decides_for_itself() -> None:
    rules = {"occupancy": "both", "headway": "1/2", "turn": "cell", "return": "none"}
    own = {"turn": 0, "return": "home", "laps": 2}
    scenario = parse_scenario(one_robot(**own) | {"rules": rules | {"laps": 1, "rotations": False}})
    assert scenario.rules == Rules(
        occupancy="both",
        headway=Fraction(1, 2),
        turn="cell",
        ends="none",
        laps=1,
        rotations=False,
    )
    robot = scenario.robots[0]
    assert (robot.turn, robot.ends, robot.laps) == (Fraction(0), "home", 2)


def test_a_grid_may_be_a_block_of_text() -> None:
    assert parse_scenario(document(map={"grid": "...\n@.@\n...\n"})) == parse_scenario(document())


def test_cells_have_the_size_that_was_given() -> None:
    scenario = parse_scenario(document(map={"grid": DOOR, "cell_size": "1/2"}))
    assert scenario.roadmap.lengths == (Fraction(1, 2),)


def test_a_file_is_found_beside_the_scenario(tmp_path: Path) -> None:
    (tmp_path / "maps").mkdir()
    rows = "\n".join(DOOR)
    (tmp_path / "maps" / "door.map").write_text(
        f"type octile\nheight 3\nwidth 3\nmap\n{rows}\n", encoding="utf-8"
    )
    path = tmp_path / "door.json"
    path.write_text(json.dumps(document(map={"file": "maps/door.map"})), encoding="utf-8")
    assert load(path) == parse_scenario(document())


def test_a_document_that_is_in_no_folder_may_read_no_file() -> None:
    with pytest.raises(InputError) as caught:
        parse_scenario(document(map={"file": "/etc/hostname"}), source="page")
    assert str(caught.value) == (
        "page: map.file: '/etc/hostname' is relative to no file"
        " (write the contents into the document)"
    )


def test_a_floor_is_cut_as_small_as_the_fastest_robot_needs() -> None:
    # Speeds 1 and 2: cells of 1/2. The table covers x 1 to 2 and y 0 to 1/2: two cells of row 0.
    floor = {"size": [3, 1], "obstacles": [{"name": "table", "rect": [1, 0, 1, 0.5]}]}
    robots = [
        {"name": "R1", "home": "N0", "target": "N5", "speed": 1},
        {"name": "R2", "home": "N6", "target": "N5", "speed": 2},
    ]
    scenario = parse_scenario(document(map={"floor": floor}, robots=robots))
    assert scenario.roadmap.grid is not None
    assert scenario.roadmap.grid.as_lines() == ("..@@..", "......")
    assert scenario.roadmap.lengths == (Fraction(1, 2),)
    given = parse_scenario(document(map={"floor": floor, "cell_size": 0.5}, robots=robots))
    assert given == scenario
    named = parse_scenario(document(map={"floor": floor, "cell_size": "clustered"}, robots=robots))
    assert named == scenario


def test_a_floor_may_have_more_cells_if_it_says_so() -> None:
    # 1/10 in a floor of 200 by 51: 2000 x 510 = 1 020 000 cells, more than a million.
    floor = {"size": [200, 51]}
    robots = [{"name": "R1", "home": "N0", "target": "N5", "speed": 10}]
    with pytest.raises(InputError, match=r"map\.cell_size: .*2000 x 510 = 1020000 cells"):
        parse_scenario(document(map={"floor": floor}, robots=robots))
    scenario = parse_scenario(
        document(map={"floor": floor | {"max_cells": 1_020_000}}, robots=robots)
    )
    assert scenario.roadmap.n_vertices == 1_020_000


def test_a_roadmap_may_be_drawn() -> None:
    drawn: dict[str, Any] = {
        "vertices": {"dock": [0, 0], "shelf": [0.3, 0.4], "gate": [1, "1/2"]},
        "edges": [
            ["dock", "shelf"],
            ["shelf", "gate", 2.5],
            {"from": "gate", "to": "dock", "length": "10/3", "both_ways": False},
        ],
    }
    robots = [{"name": "R1", "home": "dock", "target": "gate"}]
    roadmap = parse_scenario(document(map={"roadmap": drawn}, robots=robots)).roadmap

    def length(tail: str, head: str) -> Fraction | None:
        edge = roadmap.find_edge(roadmap.get_vertex(tail), roadmap.get_vertex(head))
        return None if edge is None else roadmap.get_edge_class(edge).length

    assert roadmap.labels == ("dock", "shelf", "gate")
    assert roadmap.positions.tolist() == [[0, 0], [0.3, 0.4], [1, 0.5]]
    assert length("dock", "shelf") == length("shelf", "dock") == Fraction(1, 2)  # 3, 4, 5
    assert length("gate", "shelf") == Fraction(5, 2)
    assert (length("gate", "dock"), length("dock", "gate")) == (Fraction(10, 3), None)


def test_speeds_and_work_are_dealt_out_in_turn(tmp_path: Path) -> None:
    rows = [f"0\thall.map\t4\t2\t{x}\t0\t{x}\t1\t0" for x in range(4)]
    (tmp_path / "hall.scen").write_text("\n".join(["version 1", *rows]), encoding="utf-8")
    fleet = {"scen": "hall.scen", "count": 3, "speeds": [1, "1/2"], "work": [0, 5], "laps": 2}
    scenario = parse_scenario(document(map={"grid": ["....", "...."]}, robots=fleet), base=tmp_path)
    assert [
        (robot.name, robot.home, robot.speed, robot.stops, robot.laps) for robot in scenario.robots
    ] == [
        ("R1", 0, 1, (Stop(at=scenario.roadmap.get_vertex("N4")),), 2),
        (
            "R2",
            1,
            Fraction(1, 2),
            (Stop(at=scenario.roadmap.get_vertex("N5"), work=Fraction(5)),),
            2,
        ),
        ("R3", 2, 1, (Stop(at=scenario.roadmap.get_vertex("N6")),), 2),
    ]
    everyone = document(map={"grid": ["....", "...."]}, robots={"scen": "hall.scen"})
    assert len(parse_scenario(everyone, base=tmp_path).robots) == 4


def test_the_reader_says_what_a_floor_was_cut_into_and_what_is_rounded(tmp_path: Path) -> None:
    path = tmp_path / "floor.json"
    # A cell takes R1 500/999 = 1000/1998 and R2 1/2 = 999/1998: the tick is 1/1998.
    robots: list[dict[str, Any]] = [
        {"name": "R1", "home": "N0", "target": "N5", "speed": "999/1000"},
        {"name": "R2", "home": "N1", "target": "N5", "speed": 1},
    ]
    floor = document(map={"floor": {"size": [12, 8]}, "cell_size": 0.5}, robots=robots)
    path.write_text(json.dumps(floor), encoding="utf-8")
    loaded = load_with_notes(path)
    assert tell_notes(loaded) == ("floor cut into 24 x 16 = 384 cells of 0.5 length units",)
    # A cell takes R1 1000/1999 = 2000/3998 and R2 1999/3998: too many ticks to be exact.
    robots[0]["speed"] = "1999/2000"
    path.write_text(json.dumps(floor), encoding="utf-8")
    assert tell_notes(load_with_notes(path))[1] == (
        "each drive, turn and work time is rounded up to a multiple of 0.00050 time units"
        " (the shortest of them, divided by 1000); simpler speeds and lengths stay"
        " exact, for example 1/3 instead of 0.3333"
    )


def crossroads(**robot: Any) -> dict[str, Any]:
    """A-B crosses C-D and C-E. A-C only meets lanes at its ends; G lies on A-B."""
    at = {"A": [0, 2], "B": [4, 2], "C": [2, 0], "D": [2, 4], "E": [3, 4], "G": [1, 2], "H": [1, 9]}
    edges = [["A", "B"], ["C", "D"], ["C", "E"], ["A", "C"], ["G", "H"]]
    robots = [{"name": "R1", "home": "A", "target": "B", **robot}]
    return document(map={"roadmap": {"vertices": at, "edges": edges}}, robots=robots)


def test_lanes_that_cross_where_no_vertex_is_are_noted(tmp_path: Path) -> None:
    path = tmp_path / "x.json"
    path.write_text(json.dumps(crossroads()), encoding="utf-8")
    [note] = [note for note in tell_notes(load_with_notes(path)) if "cross" in note]
    assert note == (
        "the lanes A to B and C to D cross where no vertex is (1 more pair):"
        " robots without a radius may meet there (give robots a radius, or put a vertex there)"
    )
    path.write_text(json.dumps(crossroads(radius="1/10")), encoding="utf-8")
    assert not any("without a radius" in note for note in tell_notes(load_with_notes(path)))


@pytest.mark.parametrize(
    ("end", "crosses"), [(["1/3", "1/7"], False), (["1/3", "1000000000001/7000000000000"], True)]
)
def test_a_lane_that_ends_on_another_one_does_not_cross_it(
    end: list[str], crosses: bool, tmp_path: Path
) -> None:
    """The lane from A to B goes through (1/3, 1/7), and the one from C comes from below."""
    at = {"A": [0, 0], "B": [1, "3/7"], "C": ["1/3", -2], "D": end}
    roadmap = {"vertices": at, "edges": [["A", "B"], ["C", "D"]]}
    robots = [{"name": "R1", "home": "A", "target": "B"}]
    path = tmp_path / "x.json"
    path.write_text(json.dumps(document(map={"roadmap": roadmap}, robots=robots)), "utf-8")
    assert any("cross" in note for note in tell_notes(load_with_notes(path))) == crosses


def test_at_most_fifty_problems_are_told() -> None:
    robots = [{"name": "R", "home": "N0", "target": "N6", "speed": 0}] * 60
    with pytest.raises(InputError) as caught:
        parse_scenario(document(robots=robots))
    told = str(caught.value).splitlines()
    assert len(told) == 51
    assert told[-1] == "and 10 more (mend these first)"


def test_durations_too_far_apart_for_64_bits_are_refused() -> None:
    robots = [
        {"name": "R1", "home": "N0", "target": "N6", "speed": 1e9},
        {"name": "R2", "home": "N2", "target": "N6", "work": 1e9},
    ]
    with pytest.raises(InputError, match=r"robots\[1\]: work, turning and a drive takes \d+ ticks"):
        parse_scenario(document(robots=robots))


def test_names_that_are_like_messages_do_not_confuse_them() -> None:
    name = "R of robots[7] already"
    robots = [
        {"name": name, "home": "N0", "target": "N6"},
        {"name": name, "home": "N2", "target": "N6"},
    ]
    with pytest.raises(InputError) as caught:
        parse_scenario(document(robots=robots))
    assert str(caught.value) == (
        f"robots[1].name: {name} is the name of robots[0] already (give each its own)"
    )


def fleet_of_all_kinds() -> Scenario:
    robots = [
        {"name": "R1", "home": "N0", "target": "N6", "speed": "1/3", "turn": "cell"},
        {"name": "R2", "home": "N2", "stops": [{"at": "N8", "work": 2}, {"at": "N4"}], "laps": 2},
    ]
    return parse_scenario(document(robots=robots, rules={"headway": "1/2"}))


YAML = """\
format: rightofway-scenario/1
map:
  grid: |
    ...
    @.@
    ...
  cell_size: 1
robots:
- {name: R1, home: N0, target: N6, work: 0, speed: 1/3, turn: cell}
- name: R2
  home: N2
  stops:
  - {at: N8, work: 2}
  - {at: N4, work: 0}
  speed: 1
  laps: 2
rules: {occupancy: one, headway: 1/2, return: home, laps: 1, rotations: true}
"""


def test_yaml_is_written_as_people_would(tmp_path: Path) -> None:
    scenario = fleet_of_all_kinds()
    write_scenario(scenario, tmp_path / "a.yaml")
    assert (tmp_path / "a.yaml").read_text(encoding="utf-8") == YAML
    assert load(tmp_path / "a.yaml") == scenario


def test_json_has_a_row_or_a_robot_on_a_line(tmp_path: Path) -> None:
    scenario = fleet_of_all_kinds()
    write_scenario(scenario, tmp_path / "a.json")
    text = (tmp_path / "a.json").read_text(encoding="utf-8")
    assert '\n      "@.@",\n' in text
    assert '\n    {"name": "R1", "home": "N0", "target": "N6", "work": 0, "speed": "1/3", ' in text
    assert text.endswith('"rotations": true}\n}\n')
    assert json.loads(text) == dump_scenario(scenario)
    assert load(tmp_path / "a.json") == scenario


def test_another_suffix_is_no_scenario(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"the suffix '\.txt' is no scenario's"):
        write_scenario(fleet_of_all_kinds(), tmp_path / "a.txt")


def test_stations_and_parking_places_of_vertices_that_are_not_there_are_all_reported() -> None:
    shape = {
        "vertices": {"A": [0, 0], "B": [2, 0]}, "edges": [["A", "B"]],
        "stations": {"Press": "C"}, "parking": ["A", "D"], "charging": ["AA"],
    }  # fmt: skip
    document = {
        "format": "rightofway-scenario/1",
        "map": {"roadmap": shape},
        "robots": [{"name": "R1", "home": "A", "target": "B"}],
    }
    with pytest.raises(InputError) as caught:
        parse_scenario(document)
    assert {(fault.place, fault.message) for fault in caught.value.faults} == {
        ("map.roadmap.stations.Press", "no vertex is named 'C' (add it to vertices)"),
        ("map.roadmap.parking[1]", "no vertex is named 'D' (add it to vertices)"),
        ("map.roadmap.charging[0]", "no vertex is named 'AA' (did you mean 'A'?)"),
    }


def hidden_station(target: str) -> Loaded:
    """Return a robot on a roadmap whose station B is at vertex C, not at vertex B."""
    shape = {"vertices": {"A": [0, 0], "B": [1, 0], "C": [2, 0]}, "edges": [["A", "B"], ["B", "C"]]}
    document = {
        "format": "rightofway-scenario/1",
        "map": {"roadmap": {**shape, "stations": {"B": "C", "A": "A"}}},
        "robots": [{"name": "R1", "home": "A", "target": target}],
    }
    return read_scenario(document, None)


@pytest.mark.parametrize("target", ["B", "C"])
def test_a_station_with_the_name_of_another_vertex_is_named_and_the_vertex_counts(
    target: str,
) -> None:
    """Station A is at the vertex of its name, so nothing is to be said of it."""
    loaded = hidden_station(target)
    roadmap = loaded.scenario.roadmap
    assert roadmap.name(loaded.scenario.robots[0].stops[0].at) == target
    assert tell_notes(loaded) == (
        "a station has the name of another vertex, and the name means the vertex: B (station at C)",
    )


def test_an_unknown_place_is_compared_with_names_of_stations_too() -> None:
    shape = {"vertices": {"A": [0, 0], "B": [1, 0]}, "edges": [["A", "B"]]}
    document = {
        "format": "rightofway-scenario/1",
        "map": {"roadmap": {**shape, "stations": {"Press 17": "B"}}},
        "robots": [{"name": "R1", "home": "A", "target": "Pres 17"}],
    }
    with pytest.raises(InputError, match=r"'Pres 17' \(did you mean 'Press 17'\?\)"):
        parse_scenario(document)


def test_a_robot_may_name_a_station_of_a_roadmap() -> None:
    shape = {"vertices": {"A": [0, 0], "B": [2, 0]}, "edges": [["A", "B"]]}
    document = {
        "format": "rightofway-scenario/1",
        "map": {"roadmap": {**shape, "stations": {"Press": "B"}}},
        "robots": [{"name": "R1", "home": "A", "target": "Press"}],
    }
    scenario = parse_scenario(document)
    assert scenario.roadmap.name(scenario.robots[0].stops[0].at) == "B"
    assert dump_scenario(scenario)["map"]["roadmap"]["stations"] == {"Press": "B"}


def test_robots_are_read_before_the_map_with_places_as_written() -> None:
    """A robot with a fault still has the attributes that a map depends on."""
    listed = [
        {"name": "R1", "home": "N0", "target": [0, 2], "speed": "1/2", "size": [6, 8]},
        {"name": "R2", "home": "N1", "target": "N4", "laps": 0, "radius": 7, "type": "wide"},
    ]
    fleet = read_robots(listed, None)
    assert isinstance(fleet, ListedFleet)
    first, second = fleet.robots
    assert first.document is not None
    places: tuple[Any, Any] = (first.document.home, first.document.target)
    assert places == ("N0", [0, 2])
    assert second.document is None
    assert [fault.place for fault in second.faults] == ["laps"]
    # The circle round 6 x 8 has radius 5; the speed of R2 is the usual one.
    assert first.own["radius"] == 5
    assert fleet.traits == FleetTraits(
        speeds=[Fraction(1, 2), Fraction(1)], radius=Fraction(7), types=frozenset([None, "wide"])
    )
