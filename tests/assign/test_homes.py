"""Robots without a home start from the parking and charging places of a layout.

On this street, 10 m from post to post, P1, P2 and P4 are places to park and C is one to charge::

    P1 -- a -- P2 -- b -- P4 -- C
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from rightofway.errors import InputError
from rightofway.io.scenario.reader import Loaded, read_scenario

NODES = """name,x,y,parking,charging
P1,0,0,yes,no
a,10,0,no,no
P2,20,0,yes,no
b,30,0,no,no
P4,40,0,yes,no
C,41,0,no,yes
"""
EDGES = "from,to,both_ways\nP1,a,yes\na,P2,yes\nP2,b,yes\nb,P4,yes\nP4,C,yes\n"


@pytest.fixture
def street(tmp_path: Path) -> Path:
    (tmp_path / "nodes.csv").write_text(NODES, encoding="utf-8")
    (tmp_path / "edges.csv").write_text(EDGES, encoding="utf-8")
    return tmp_path


def loaded(folder: Path, *robots: dict[str, Any], **keys: Any) -> Loaded:
    return read_scenario(
        {
            "format": "rightofway-scenario/1",
            "map": {"layout": "nodes.csv"},
            "homes": "parking",
            "robots": [{"name": f"R{k}", **each} for k, each in enumerate(robots, start=1)],
            **keys,
        },
        folder,
    )


def homes(found: Loaded) -> list[str]:
    return [found.scenario.roadmap.name(robot.home) for robot in found.scenario.robots]


def message(folder: Path, *robots: dict[str, Any], **keys: Any) -> str:
    with pytest.raises(InputError) as error:
        loaded(folder, *robots, **keys)
    return str(error.value)


def test_robots_without_a_trip_start_anywhere_and_do_jobs(street: Path) -> None:
    found = loaded(street, {}, {"home": "P2"}, {}, jobs=[{"name": "J1", "at": "b"}])
    assert homes(found) == ["P1", "P2", "P4"]


def test_each_robot_starts_where_its_first_stop_is_near(street: Path) -> None:
    """R1 has 10 m from P2 and from P4, and takes the earlier one in the file."""
    found = loaded(street, {"target": "b"}, {"target": "a"}, {"target": "b"})
    assert homes(found) == ["P2", "P1", "P4"]
    assert str(found.notes[-1]) == "homes dealt out: R1 at P2, R2 at P1 and R3 at P4"


def test_written_homes_and_stops_are_nobody_elses_home(street: Path) -> None:
    found = loaded(street, {"target": "a"}, {"home": "P1", "target": "P2"})
    assert homes(found) == ["P4", "P1"]


def test_robots_with_a_size_keep_their_distance_at_home(street: Path) -> None:
    """P4 and C are 1 m apart: near enough for 0.6 m and 0.3 m, with 0.2 m between them not."""
    two: list[dict[str, Any]] = [{"target": "b", "radius": radius} for radius in (0.6, 0.3)]
    apart = [{"home": "P2", "target": "a"}, *two]
    assert homes(loaded(street, *apart)) == ["P2", "P4", "C"]
    found = loaded(street, *apart, rules={"clearance": 0.2})
    assert homes(found) == ["P2", "P4", "P1"]


def test_too_few_places_are_an_error_with_numbers(street: Path) -> None:
    assert message(street, *[{"target": "P2"}] * 5) == (
        "homes: 5 robots need a home, and the map has 4 parking and charging places,"
        " of which 1 is a stop (give the other robots homes)"
    )


def test_a_place_must_have_a_way_to_the_stop(street: Path) -> None:
    lanes = EDGES.replace("P2,b,yes", "P2,b,no").replace("b,P4,yes", "P4,b,no")
    (street / "edges.csv").write_text(lanes, encoding="utf-8")
    robots = [{"target": "b"}, {"target": "b"}, {"target": "b"}]
    assert message(street, *robots) == (
        "homes: no free parking or charging place has a way to the stops of R1 and back"
        " (give that robot a home, or join the parts of the map)"
    )
    found = loaded(street, *robots[:2], rules={"return": "none"})
    assert homes(found) == ["P2", "P4"]


def test_a_map_without_parking_places_is_an_error(street: Path) -> None:
    keys: dict[str, Any] = {"map": {"grid": ["..."]}}
    assert message(street, {"target": "N2"}, **keys) == (
        "homes: the map has no parking or charging place (give each robot a home)"
    )


def test_a_table_of_robots_may_do_without_homes(street: Path) -> None:
    (street / "robots.csv").write_text("name,target\nA,a\nB,b\n", encoding="utf-8")
    found = loaded(street, robots={"table": "robots.csv"})
    assert homes(found) == ["P1", "P2"]


def test_homes_of_another_kind_are_refused(street: Path) -> None:
    assert message(street, {"target": "a"}, homes="stations").startswith("homes: 'stations' ")


def test_homes_that_are_all_written_need_no_places(street: Path) -> None:
    keys: dict[str, Any] = {"map": {"grid": ["..."]}}
    assert homes(loaded(street, {"home": "N0", "target": "N2"}, **keys)) == ["N0"]
