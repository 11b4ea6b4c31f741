"""Vertices that robots only drive through, as the judge sees them: faults that are planted."""

from __future__ import annotations

from typing import Any

import pytest

from rightofway import check
from rightofway.errors import InputError
from rightofway.io import parse_scenario
from rightofway.model import Plan, PlannerRun, Track

VERTICES = {"A": [0, 0], "B": [6, 0], "C": [2, 3], "D": [2, -2], "E": [7, 0],
            "P": [2, 0], "Q": [4, 0]}  # fmt: skip
"""Robots drive through P and Q; A to B is a drive of 6 ticks by both, C to D one of 5 by P."""

EDGES = [["A", "P"], ["P", "Q"], ["Q", "B"], ["C", "P"], ["P", "D"], ["B", "E"]]


def document(robots: dict[str, str], **more: Any) -> dict[str, Any]:
    """Return robots that drive from homes to targets, and keys of the roadmap or the scenario."""
    passed = {name: {"at": VERTICES[name], "pass": True} for name in "PQ"}
    roadmap: dict[str, Any] = {"vertices": VERTICES | passed, "edges": EDGES}
    roadmap |= {key: more.pop(key) for key in ("zones",) if key in more}
    return {
        "format": "rightofway-scenario/1",
        "map": {"roadmap": roadmap},
        "robots": [
            {"name": f"R{k}", "home": home, "target": target}
            for k, (home, target) in enumerate(robots.items(), 1)
        ],
        "rules": {"return": "none", **more.pop("rules", {})},
        **more,
    }


def count_faults(data: dict[str, Any], *tracks: tuple[str, list[int]]) -> dict[str, int]:
    """Return the faults of tracks, each the letters of its vertices and when they are entered."""
    scenario = parse_scenario(data)
    vertex = scenario.roadmap.get_vertex
    made = tuple(Track.of([vertex(name) for name in names], enter) for names, enter in tracks)
    plan = Plan(scenario=scenario, tracks=made, run=PlannerRun(name="by hand"))
    return {str(kind): count for kind, count in check(plan).counts.items()}


ALONG = "APQB", [0, 2, 4, 6]
"""The drive from A to B, from tick 0 to 6."""


@pytest.mark.parametrize(
    ("across", "faults"),
    [
        # C to D is booked from its begin at tick 6 on, when the other drive has ended.
        ([0, 9, 11], {}),
        # R1 has left P at tick 4, but its drive lasts until tick 6.
        ([0, 8, 10], {"vertex conflict": 1}),
    ],
)
def test_a_drive_through_passed_vertices_is_booked_to_its_end(
    across: list[int], faults: dict[str, int]
) -> None:
    data = document({"A": "B", "C": "D"})
    assert count_faults(data, ALONG, ("CPD", across)) == faults


@pytest.mark.parametrize(
    ("leaves", "faults"),
    [
        # R2 leaves B at tick 0 only if R1 departs then or later: R1 waits until tick 1.
        (1, {}),
        # It leaves B at tick 2, one tick after R1 has departed for it, and long before R1 comes.
        (2, {"vertex conflict": 1}),
    ],
)
def test_the_end_of_a_drive_is_booked_before_it_begins(leaves: int, faults: dict[str, int]) -> None:
    data = document({"A": "B", "B": "E"})
    late = [0, 3, 5, 7]
    assert count_faults(data, ("APQB", late), ("BE", [0, leaves])) == faults


@pytest.mark.parametrize(("enters", "faults"), [(11, {}), (10, {"vertex conflict": 2})])
def test_the_begin_of_a_drive_stays_booked_until_its_end(
    enters: int, faults: dict[str, int]
) -> None:
    # R2 drives 5 ticks from C to A, 3 and 2: with the drive it books P and A, which R1 has left.
    data = document({"A": "B", "C": "A"})
    assert count_faults(data, ALONG, ("CPA", [0, enters - 2, enters])) == faults


@pytest.mark.parametrize(
    ("enter", "faults"),
    [
        ([0, 2, 4, 6], {}),
        ([0, 7, 9, 11], {}),  # it waits at A
        ([0, 2, 5, 7], {"stop at pass": 1}),
        ([0, 2, 5, 8], {"stop at pass": 2}),
        ([0, 2, 3, 5], {"too fast": 1}),
    ],
)
def test_a_visit_to_a_passed_vertex_lasts_as_long_as_its_drive(
    enter: list[int], faults: dict[str, int]
) -> None:
    assert count_faults(document({"A": "B"}), ("APQB", enter)) == faults


@pytest.mark.parametrize(
    ("enter", "faults"),
    [
        ([0, 3, 7], {}),  # 2 for the turn by 90 degrees at P, 2 for the drive to D or A
        ([0, 3, 6], {"turn cut short": 1}),
        ([0, 3, 8], {"stop at pass": 1}),
    ],
)
def test_a_turn_is_no_stop(enter: list[int], faults: dict[str, int]) -> None:
    data = document({"C": "A"}, rules={"turn_rate": 45})
    assert count_faults(data, ("CPA", enter)) == faults


def test_a_way_back_through_one_vertex_is_no_drive() -> None:
    data = document({"A": "A"}, rules={"return": "none"})
    assert count_faults(data, ("APA", [0, 2, 4])) == {"jump": 2}
    assert count_faults(document({"A": "B"}), ("AP", [0, 2])) == {"jump": 1, "wrong end": 1}


@pytest.mark.parametrize(
    ("closure", "faults"),
    [
        ({"at": "P", "from": 6, "until": 9}, 0),
        ({"at": "P", "from": 5, "until": 9}, 1),  # R1 has left P at tick 4
        ({"at": "B", "from": 0, "until": 1}, 1),
        ({"edge": ["P", "Q"], "from": 5, "until": 9}, 1),  # driven from tick 2 to 4
        ({"edge": ["C", "P"], "from": 0, "until": 9}, 0),
        ({"at": "D", "from": 0, "until": 9}, 0),
    ],
)
def test_a_closure_of_any_part_closes_the_drive(closure: dict[str, Any], faults: int) -> None:
    counts = count_faults(document({"A": "B"}, closures=[closure]), ALONG)
    assert counts == ({"closed": counts["closed"]} if faults else {})


def test_a_zone_with_a_part_of_a_drive_is_booked_with_it() -> None:
    zone = {"name": "Z", "edges": [["P", "Q"]], "vertices": ["E"]}
    data = document({"A": "B", "B": "E"}, zones=[zone])
    # R2 drives from B to E; Z is booked by R1 for its whole drive, from tick 2 to 8.
    late = ("APQB", [0, 4, 6, 8])
    assert count_faults(data, late, ("BE", [0, 2]))["zone conflict"] == 1
    only = {**data, "robots": data["robots"][:1]}
    assert count_faults(only, late) == {}


@pytest.mark.parametrize(
    ("robots", "message"),
    [
        ({"P": "B"}, r"robots\[0\].home: P is driven through only \(give the robot"),
        ({"A": "Q"}, r"robots\[0\].target: Q is driven through only \(give the robot"),
    ],
)
def test_a_passed_vertex_is_no_home_and_no_stop(robots: dict[str, str], message: str) -> None:
    with pytest.raises(InputError, match=message):
        parse_scenario(document(robots))


def test_robots_book_ahead_where_they_only_drive_through() -> None:
    assert parse_scenario(document({"A": "B"})).rules.occupancy == "both"
    with pytest.raises(InputError, match="occupancy: 'one' does not go with vertices that have"):
        parse_scenario(document({"A": "B"}, rules={"occupancy": "one"}))
