"""Long lanes are booked in pieces by default, where robots have a size."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rightofway import FleetBuilder, InputError, check, solve
from rightofway.cli.main import run
from rightofway.io import dump_plan, dump_scenario, load_with_notes, parse_plan, parse_scenario
from rightofway.io.json_text import format_json
from rightofway.site import Edge
from rightofway.site.spacing import MOST_CUTS, choose_spacing, split_lanes
from tests.builders.sentences import tell_notes


def cross(**changes: Any) -> dict[str, Any]:
    """Return a lane of 12 that another one of 12 crosses in the middle, and a short one beside."""
    at = {"A": [0, 6], "B": [12, 6], "C": [6, 0], "D": [6, 12], "E": [0, 20], "F": ["2.4", 20]}
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
    """Return the lanes that are split, by the names of the vertices between their pieces.

    Of both directions of a lane, only the one with the lower name is returned.
    """
    labels = parse_scenario(document).roadmap.labels
    assert labels is not None
    lanes = {name.rpartition("/")[0] for name in labels if "/" in name}
    return {min(lane, "-".join(reversed(lane.split("-")))) for lane in lanes}


def test_lanes_are_split_into_pieces_of_three_distances() -> None:
    """D = 0.8, so pieces are at most 2.4 long: 12 / 2.4 = 5 of them. E to F is as long as that."""
    document = cross()
    assert joints(document) == {"A-B", "C-D"}
    roadmap = parse_scenario(document).roadmap
    assert len(roadmap.lanes) == 4, "both directions of two lanes"
    assert {len(lane.pieces) for lane in roadmap.lanes} == {5}
    assert roadmap.n_vertices == 6 + 4 * 4, "each direction has its own"


def test_robots_in_pieces_pass_a_crossing_soon_after_each_other() -> None:
    """A whole lane is booked for 12; a piece across the middle for 2.4, from 4.8 to 7.2."""
    lost = {}
    for spacing in ("auto", "whole"):
        plan = solve(parse_scenario(cross(spacing=spacing)), time_limit=5)
        assert not check(plan).faults
        time = plan.scenario.problem.clock.tick
        lost[spacing] = (plan.flowtime - plan.lower_bound) * time
    assert lost == {"auto": Fraction(12, 5), "whole": 12}


def test_robots_in_pieces_follow_each_other_along_an_aisle() -> None:
    """Both have 14 to go on one lane of 12; the second one starts 2 behind, and waits for a piece.

    A whole lane is booked until the first robot has left it.
    """
    at = {"A": [0, 0], "B": [2, 0], "C": [14, 0], "D": [16, 0]}
    document = cross()
    document["map"]["roadmap"] = {"vertices": at, "edges": [["A", "B"], ["B", "C"], ["C", "D"]]}
    first, second = document["robots"]
    first |= {"home": "B", "target": "D"}
    second |= {"home": "A", "target": "C"}
    lost = {}
    for spacing in ("auto", "whole"):
        document["map"]["spacing"] = spacing
        plan = solve(parse_scenario(document), time_limit=5)
        assert not check(plan).faults
        lost[spacing] = (plan.flowtime - plan.lower_bound) * plan.scenario.problem.clock.tick
    assert lost["whole"] == 12
    assert lost["auto"] < 5


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


def test_the_reader_reports_what_is_split(tmp_path: Path) -> None:
    path = tmp_path / "cross.json"
    path.write_text(format_json(cross() | {"units": {"length": "m", "time": "s"}}))
    (note,) = tell_notes(load_with_notes(path))
    assert note == (
        "2 lanes are booked in pieces of at most 2.4 m, so that robots can follow and cross each"
        " other there (spacing: whole keeps lanes whole)"
    )


def test_a_name_that_is_taken_leaves_the_lane_whole() -> None:
    """Only who asks for pieces has to rename a vertex."""
    document = cross()
    document["map"]["roadmap"]["vertices"]["A-B/1"] = [0, 22]
    document["map"]["roadmap"]["edges"].append(["A-B/1", "E"])
    assert len(parse_scenario(document).roadmap.lanes) == 2, "both directions of C to D"
    document["map"]["spacing"] = 3
    with pytest.raises(InputError, match="'A-B/1' is the name of a piece of a lane"):
        parse_scenario(document)


def test_no_lane_has_more_than_eight_pieces() -> None:
    """D = 0.2: pieces of 0.6 would be 20; E to F is 2.4 long."""
    roadmap = parse_scenario(cross(robot={"radius": "0.1"})).roadmap
    assert {len(lane.pieces) for lane in roadmap.lanes} == {4, 8}


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
    lengths = np.full(MOST_CUTS // 5 + 1, 15.0)
    assert choose_spacing(lengths[1:], Fraction(1)) == 3
    assert choose_spacing(lengths, Fraction(1)) == 6


def test_a_winding_lane_and_a_graph_without_positions_stay_whole() -> None:
    at = {"A": (0, 0), "B": (10, 0), "C": (5, -5), "D": (5, 5)}
    positions = {name: (Fraction(x), Fraction(y)) for name, (x, y) in at.items()}
    edges = [
        Edge(tail="A", head="B", length=Fraction(101)),
        Edge(tail="C", head="D", length=Fraction(10)),
    ]
    split = split_lanes(positions, edges, None, distance=Fraction(1))
    assert (split.chosen, list(split.pieces)) == (1, [("C", "D")])
    split = split_lanes(positions, edges, None, distance=Fraction(1), is_drawn=False)
    assert (split.chosen, split.pieces) == (0, {})


def test_inspect_reports_what_is_split(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "cross.json"
    path.write_text(format_json(cross()))
    assert run(["inspect", str(path)]) == 0
    assert "2 lanes are booked in pieces of at most 2.4" in capsys.readouterr().out
