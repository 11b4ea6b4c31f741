"""Lanes that others cross far from their ends are booked in pieces by default."""

from __future__ import annotations

import random
from fractions import Fraction
from itertools import combinations
from math import dist
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rightofway import FleetBuilder, InputError, check, solve
from rightofway.cli.main import run
from rightofway.io import dump_plan, dump_scenario, load_with_notes, parse_plan, parse_scenario
from rightofway.io.text import format_json
from rightofway.site import Edge
from rightofway.site.crossings import MOST_CUTS, choose_spacing, find_crossed
from rightofway.site.nearness import Lines
from rightofway.site.spacing import split_lanes

Point = tuple[float, float]


def cross(**changes: Any) -> dict[str, Any]:
    """Return a lane of 12 that another one of 12 crosses in the middle, and a third beside both."""
    at = {"A": [0, 6], "B": [12, 6], "C": [6, 0], "D": [6, 12], "E": [0, 20], "F": [12, 20]}
    fleet = {"radius": "0.4"} | changes.pop("robot", {})
    return {
        "format": "rightofway-scenario/1",
        "map": {
            "roadmap": {"vertices": at, "edges": [["A", "B"], ["C", "D"], ["E", "F"]]},
            **changes,
        },
        "robots": [
            {"name": "R1", "home": "A", "target": "B", **fleet},
            {"name": "R2", "home": "C", "target": "D", **fleet},
        ],
        "rules": {"return": "none"},
    }


def joints(document: dict[str, Any]) -> set[str]:
    """Return the lanes that are split, by the names of the vertices between their pieces."""
    labels = parse_scenario(document).roadmap.labels
    assert labels is not None
    return {name.rpartition("/")[0] for name in labels if "/" in name}


def test_lanes_that_cross_are_split_into_pieces_of_three_distances() -> None:
    """D = 0.8, so pieces are at most 2.4 long: 12 / 2.4 = 5 of them. E to F crosses nothing."""
    document = cross()
    assert joints(document) == {"A-B", "C-D"}
    roadmap = parse_scenario(document).roadmap
    assert len(roadmap.lanes) == 4, "both directions of two lanes"
    assert {len(lane.pieces) for lane in roadmap.lanes} == {5}
    assert roadmap.n_vertices == 6 + 2 * 4


def test_robots_in_pieces_pass_a_crossing_soon_after_each_other() -> None:
    """A whole lane is booked for 12; a piece across the middle for 2.4, from 4.8 to 7.2."""
    lost = {}
    for spacing in ("auto", "whole"):
        plan = solve(parse_scenario(cross(spacing=spacing)), time_limit=5)
        assert not check(plan).faults
        time = plan.scenario.problem.clock.tick
        lost[spacing] = (plan.flowtime - plan.lower_bound) * time
    assert lost == {"auto": Fraction(12, 5), "whole": 12}


@pytest.mark.parametrize(
    ("changes", "why"),
    [
        ({"robot": {"radius": 0}}, "points do not book lanes"),
        ({"spacing": "whole"}, "the map says so"),
        ({"robot": {"radius": 2}}, "a piece would be as long as the lane"),
    ],
)
def test_lanes_stay_whole(changes: dict[str, Any], why: str) -> None:
    assert joints(cross(**changes)) == set(), why


def test_a_crossing_beside_an_end_leaves_the_lane_whole() -> None:
    """C to D crosses A to B at 0.7 from B, nearer than 0.8, and is itself met in its middle."""
    document = cross()
    document["map"]["roadmap"]["vertices"] |= {"C": [11.3, 0], "D": [11.3, 12]}
    assert joints(document) == {"C-D"}


def test_a_vertex_beside_a_lane_splits_it() -> None:
    """A robot that stands at C is 0.5 away from the middle of A to B."""
    document = cross()
    document["map"]["roadmap"]["vertices"] |= {"C": [6, 6.5], "D": [6, 12]}
    assert joints(document) == {"A-B"}


def test_the_reader_reports_what_is_split(tmp_path: Path) -> None:
    path = tmp_path / "cross.json"
    path.write_text(format_json(cross() | {"units": {"length": "m", "time": "s"}}))
    (note,) = load_with_notes(path).notes
    assert note == (
        "2 lanes are booked in pieces of at most 2.4 m, because others cross far from the ends"
        " (spacing: whole keeps lanes whole)"
    )


def test_a_name_that_is_taken_leaves_the_lane_whole() -> None:
    """Only who asks for pieces has to rename a vertex."""
    document = cross()
    document["map"]["roadmap"]["vertices"]["A-B/1"] = [0, 30]
    document["map"]["roadmap"]["edges"].append(["A-B/1", "E"])
    assert len(parse_scenario(document).roadmap.lanes) == 2, "both directions of C to D"
    document["map"]["spacing"] = 3
    with pytest.raises(InputError, match="'A-B/1' is the name of a piece of a lane"):
        parse_scenario(document)


def test_no_lane_has_more_than_eight_pieces() -> None:
    """D = 0.2: pieces of 0.6 would be 20."""
    roadmap = parse_scenario(cross(robot={"radius": "0.1"})).roadmap
    assert {len(lane.pieces) for lane in roadmap.lanes} == {8}


def test_a_scenario_that_is_written_keeps_its_lanes_as_they_are() -> None:
    """Smaller robots would cut lanes more often; what is written is read as it was."""
    scenario = parse_scenario(cross())
    document = dump_scenario(scenario)
    assert document["map"]["spacing"] == "whole"
    assert parse_scenario(document) == scenario
    assert "spacing" not in dump_scenario(parse_scenario(cross(robot={"radius": 0})))["map"]


def test_a_plan_of_an_earlier_version_keeps_whole_lanes() -> None:
    """It names no spacing, and its robots drive from A to B in one go."""
    document = dump_plan(solve(parse_scenario(cross(spacing="whole")), time_limit=5))
    del document["scenario"]["map"]["spacing"]
    plan = parse_plan(document)
    assert not plan.scenario.roadmap.lanes
    assert not check(plan).faults


def test_a_fleet_that_is_built_is_split_as_one_that_is_read() -> None:
    spacings: tuple[Any, ...] = ("auto", "whole", 4)
    for spacing in spacings:
        fleet = FleetBuilder(ends="none", spacing=spacing)
        for name, (x, y) in cross()["map"]["roadmap"]["vertices"].items():
            fleet.add_vertex(name, x, y)
        fleet.add_edge("A", "B").add_edge("C", "D").add_edge("E", "F")
        fleet.add_robot("R1", home="A", target="B", radius="0.4")
        fleet.add_robot("R2", home="C", target="D", radius="0.4")
        read = parse_scenario(cross(spacing=spacing))
        assert fleet.build_scenario().roadmap == read.roadmap, spacing


def test_more_pieces_than_allowed_are_made_longer() -> None:
    """A lane of 15 makes 5 pieces of 3; one lane too many, and pieces are 6 long."""
    lengths = [Fraction(15)] * (MOST_CUTS // 5)
    assert choose_spacing(lengths, Fraction(1)) == 3
    assert choose_spacing([*lengths, Fraction(15)], Fraction(1)) == 6


def test_lanes_are_met_as_an_oracle_says() -> None:
    """Random lines: each crossing and each near point, one by one."""
    draw = random.Random(5)  # noqa: S311 (no secret depends on it)
    for _ in range(30):
        points = [(draw.uniform(0, 9), draw.uniform(0, 9)) for _ in range(draw.randint(4, 14))]
        lines = [pair for pair in combinations(points, 2) if draw.random() < 0.3]
        if not lines:
            continue
        distance = draw.uniform(0.1, 2)
        wanted = np.array([draw.random() < 0.8 for _ in lines])
        begin, end = np.array(lines).swapaxes(0, 1)
        found = find_crossed(begin, end, np.array(points), wanted, distance)
        expected = [
            bool(want) and is_met(line, lines, points, distance)
            for line, want in zip(lines, wanted, strict=True)
        ]
        assert found.tolist() == expected


def test_of_thousands_of_crossings_few_are_looked_at(monkeypatch: pytest.MonkeyPatch) -> None:
    """3000 lanes of about 8 on 30 by 30, each crossed by a hundred: one crossing is enough."""
    draw = random.Random(1)  # noqa: S311 (no secret depends on it)
    begin = np.array([[draw.uniform(0, 30) for _ in "xy"] for _ in range(3000)])
    end = begin + [[draw.uniform(-10, 10) for _ in "xy"] for _ in begin]
    far = np.array([[1000.0, 1000.0]])
    wanted = np.hypot(*(end - begin).T) > 3
    looked_at: list[int] = []
    find_crossing = Lines.find_crossing

    def count_pairs(*arguments: Any) -> tuple[Any, Any]:
        pairs = find_crossing(*arguments)
        looked_at.append(len(pairs[0]))
        return pairs

    monkeypatch.setattr(Lines, "find_crossing", count_pairs)
    found = find_crossed(begin, end, far, wanted, 0.1)
    few = sum(looked_at)
    looked_at.clear()
    monkeypatch.setattr("rightofway.site.crossings.PARTS", (1,))
    assert find_crossed(begin, end, far, wanted, 0.1).tolist() == found.tolist()
    assert found.sum() > 0.9 * wanted.sum()
    assert 5 * few < sum(looked_at)


def is_met(
    line: tuple[Point, Point],
    lines: list[tuple[Point, Point]],
    points: list[Point],
    distance: float,
) -> bool:
    begin, end = line
    length = dist(begin, end)

    def is_far(share: float) -> bool:
        return distance < share * length < length - distance

    for other in lines:
        share = crossing(line, other)
        if share is not None and crossing(other, line) is not None and is_far(share):
            return True
    for x, y in points:
        share = (
            (x - begin[0]) * (end[0] - begin[0]) + (y - begin[1]) * (end[1] - begin[1])
        ) / length**2
        foot = (
            begin[0] + share * (end[0] - begin[0]),
            begin[1] + share * (end[1] - begin[1]),
        )
        if is_far(share) and dist(foot, (x, y)) < distance:
            return True
    return False


def crossing(line: tuple[Point, Point], other: tuple[Point, Point]) -> float | None:
    """Return where along a line another one crosses it, between 0 and 1, or None."""
    (ax, ay), (bx, by) = line
    (cx, cy), (dx, dy) = other
    turn = (bx - ax) * (dy - cy) - (by - ay) * (dx - cx)
    if turn == 0:
        return None
    share = ((cx - ax) * (dy - cy) - (cy - ay) * (dx - cx)) / turn
    return share if 0 < share < 1 else None


def test_a_drawing_that_is_moved_is_split_alike() -> None:
    """A crossing at exactly the distance from an end is near, however positions are rounded."""
    for left, low in ((0, 0), (1000, 700), ("1000.1", "-0.3")):
        document = cross()
        at = document["map"]["roadmap"]["vertices"]
        at |= {"C": [Fraction("11.2"), 0], "D": [Fraction("11.2"), 12]}
        for name, (x, y) in at.items():
            at[name] = [str(Fraction(x) + Fraction(left)), str(Fraction(y) + Fraction(low))]
        assert joints(document) == {"C-D"}


def test_a_winding_lane_and_a_graph_without_positions_stay_whole() -> None:
    at = {"A": (0, 0), "B": (10, 0), "C": (5, -5), "D": (5, 5)}
    positions = {name: (Fraction(x), Fraction(y)) for name, (x, y) in at.items()}
    edges = [
        Edge(tail="A", head="B", length=Fraction(101)),
        Edge(tail="C", head="D", length=Fraction(10)),
    ]
    split = split_lanes(positions, edges, None, distance=Fraction(1))
    assert (split.crossed, list(split.pieces)) == (1, [("C", "D")])
    split = split_lanes(positions, edges, None, distance=Fraction(1), is_drawn=False)
    assert (split.crossed, split.pieces) == (0, {})


def test_inspect_reports_what_is_split(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "cross.json"
    path.write_text(format_json(cross()))
    assert run(["inspect", str(path)]) == 0
    assert "2 lanes are booked in pieces of at most 2.4" in capsys.readouterr().out
