"""Trajectories of LIF: how they are cut, and what robots with a size book along them."""

from __future__ import annotations

import json
import math
from fractions import Fraction
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rightofway import FleetBuilder, check, solve
from rightofway.io import read_layout
from rightofway.io.layouts import format_layout
from rightofway.io.layouts.nurbs import CHORD_ERROR, Nurbs
from rightofway.io.scenario.reader import Loaded, read_scenario
from rightofway.metrics import Site, inspect
from rightofway.site.layout import Layout
from tests.builders.sentences import tell_notes


def arc() -> Nurbs:
    """Return a quarter of a circle of 2 m round (0, 0), from (2, 0) to (0, 2)."""
    return Nurbs(
        degree=2,
        knots=np.array([0.0, 0, 0, 1, 1, 1]),
        points=np.array([[2.0, 0], [2, 2], [0, 2]]),
        weights=np.array([1, math.sqrt(0.5), 1]),
    )


def test_a_circle_is_a_rational_curve() -> None:
    found = arc().compute_points(np.linspace(0, 1, 50))
    assert np.hypot(*found.T) == pytest.approx(2)
    assert found[[0, -1]].tolist() == [[2, 0], [0, 2]]


def test_pieces_are_equally_long_and_near() -> None:
    """A chord of angle a is 2 m * (1 - cos(a / 2)) from its arc: of 90 degrees / 11, 5.1 mm."""
    ends = arc().cut_pieces()
    assert np.hypot(*ends.T) == pytest.approx(2, abs=1e-4)
    chords = np.hypot(*np.diff(ends, axis=0).T)
    assert chords == pytest.approx(chords[0], rel=1e-3)
    away = 2 - np.hypot(*((ends[1:] + ends[:-1]) / 2).T)
    assert 0.5 * CHORD_ERROR < away.max() <= CHORD_ERROR


def test_a_curve_driven_back_has_the_same_ends() -> None:
    assert arc().reverse().cut_pieces().tolist() == arc().cut_pieces()[::-1].tolist()


def test_a_curve_of_degree_one_is_cut_at_its_corners() -> None:
    points = np.array([[0.0, 0], [1, 2], [3, 2], [4, 0]])
    corners = Nurbs(
        degree=1, knots=np.array([0, 0, 1, 2, 3, 3.0]), points=points, weights=np.ones(4)
    )
    assert corners.cut_pieces() == pytest.approx(points)


@pytest.mark.parametrize(
    ("knots", "weights"),
    [([0, 0, 0, 1, 1], [1, 1, 1]), ([0, 0, 1, 0, 1, 1], [1, 1, 1]), ([0] * 6, [1, 1, 1]),
     ([0, 0, 0, 1, 1, 1], [1, 0, 1])],
)  # fmt: skip
def test_a_curve_whose_parts_do_not_fit_is_refused(knots: list[float], weights: list[int]) -> None:
    with pytest.raises(ValueError, match=r"fit|positive"):
        Nurbs(degree=2, knots=np.array(knots, float), points=np.zeros((3, 2)),
              weights=np.array(weights, float))  # fmt: skip


def hall(folder: Path, height: float, **changes: Any) -> Path:
    """Write a LIF: a lane from A to B, 10 m apart, over a bow, and a straight lane C to D beside.

    The middle of the bow is 3/4 of the height above the line from A to B; C to D is 3.5 m above it.
    """
    ends = {"A": (0.0, 0.0), "B": (10.0, 0.0), "C": (3.0, 3.5), "D": (7.0, 3.5)}
    bow: list[list[float]] = [[0, 0], [0, height], [10, height], [10, 0]]
    trajectory: dict[str, Any] = {"degree": 3, "knotVector": [0, 0, 0, 0, 1, 1, 1, 1]} | changes
    edges = list[dict[str, Any]]()
    for tail, head in ("AB", "BA", "CD", "DC"):
        points = bow if tail == "A" else bow[::-1]
        curve = {"controlPoints": [{"x": point[0], "y": point[1]} for point in points]} | trajectory
        own: dict[str, Any] = {"vehicleTypeId": "t", "rotationAllowed": True}
        own |= {"trajectory": curve} if tail in "AB" else {}
        edges.append({"edgeId": tail + head, "startNodeId": tail, "endNodeId": head,
                      "vehicleTypeEdgeProperties": [own]})  # fmt: skip
    nodes = [
        {"nodeId": name, "nodePosition": {"x": x, "y": y}, "vehicleTypeNodeProperties": []}
        for name, (x, y) in ends.items()
    ]
    path = folder / "hall.lif.json"
    layout = {"layoutId": "hall", "nodes": nodes, "edges": edges, "stations": []}
    path.write_text(json.dumps({"layouts": [layout]}), encoding="utf-8")
    return path


def loaded(path: Path, **robot: Any) -> Loaded:
    robots = [
        {"name": "R1", "home": "A", "target": "B", **robot},
        {"name": "R2", "home": "C", "target": "D", **robot},
    ]
    return read_scenario(
        {
            "format": "rightofway-scenario/1",
            "map": {"layout": path.name, "spacing": "whole"},  # curves are cut all the same
            "robots": robots,
        },
        path.parent,
    )


def test_a_curve_has_its_length_for_robots_without_a_size(tmp_path: Path) -> None:
    scenario = loaded(hall(tmp_path, 4)).scenario
    assert scenario.roadmap.n_vertices == 4
    assert float(max(scenario.roadmap.lengths)) == pytest.approx(bow_length(4), abs=0.02)


def bow_length(height: float) -> float:
    """Return the sum of a hundred thousand chords."""
    t = np.linspace(0, 1, 100_001)
    x = 10 * (3 * t**2 - 2 * t**3)
    y = height * 3 * (t - t**2)
    return float(np.hypot(np.diff(x), np.diff(y)).sum())


def test_a_bow_towards_a_lane_excludes_it_and_a_bow_away_does_not(tmp_path: Path) -> None:
    """The bow of 4 m comes to 3 m, 0.5 m from the lane: robots of 0.3 m need 0.6 m there."""
    towards = loaded(hall(tmp_path, 4), radius=0.3)
    plan = solve(towards.scenario)
    assert not check(plan).faults
    assert plan.flowtime > plan.lower_bound
    away = solve(loaded(hall(tmp_path, -4), radius=0.3).scenario)
    assert away.flowtime == away.lower_bound
    assert any("1 curve" not in note and "curves are cut" in note for note in tell_notes(towards))


def test_both_directions_have_pieces_of_their_own_and_the_clearance_grows(tmp_path: Path) -> None:
    found = loaded(hall(tmp_path, 4), radius=0.3)
    roadmap, rules = found.scenario.roadmap, found.scenario.rules
    inside = [name for name in roadmap.labels or () if "/" in name]
    assert {name.partition("/")[0] for name in inside} == {"A-B", "B-A"}
    assert roadmap.n_edges == len(inside) + 2 + 2
    assert rules.clearance == 2 * Fraction(repr(CHORD_ERROR))
    assert tell_notes(found)[-1] == (
        "2 curves are cut into straight pieces for robots with a size, which leave the curve by at"
        " most 0.005 m: the clearance grows by 0.01 m"
    )


def test_a_builder_cuts_curves_for_robots_with_a_size_only(tmp_path: Path) -> None:
    fleet = FleetBuilder(layout=hall(tmp_path, 4)).add_robot("R1", home="A", target="B")
    assert fleet.build_scenario().roadmap.n_vertices == 4
    cut = fleet.add_robot("R2", home="C", target="D", radius=0.3).build_scenario()
    assert cut.roadmap.n_vertices > 20
    assert cut.rules.clearance == 2 * Fraction(repr(CHORD_ERROR))
    assert [cut.roadmap.name(robot.home) for robot in cut.robots] == ["A", "C"]


def test_pieces_are_near_the_curve_and_have_its_length(tmp_path: Path) -> None:
    roadmap = loaded(hall(tmp_path, 4), radius=0.3).scenario.roadmap
    inside = [name for name in roadmap.labels or () if name.startswith("A-B/")]
    way = ["A", *sorted(inside, key=lambda name: int(name[4:])), "B"]
    t = np.linspace(0, 1, 20_001)
    curve = np.column_stack((10 * (3 * t**2 - 2 * t**3), 12 * (t - t**2)))
    for tail, head in pairwise(map(roadmap.get_vertex, way)):
        ends = roadmap.get_point(tail), roadmap.get_point(head)
        middle = [float(sum(axis)) / 2 for axis in zip(*ends, strict=True)]
        assert np.hypot(*(curve - middle).T).min() <= CHORD_ERROR
    edges = [roadmap.find_edge(*ends) for ends in pairwise(map(roadmap.get_vertex, way))]
    total = sum(float(roadmap.get_edge_class(edge).length) for edge in edges if edge is not None)
    assert total == pytest.approx(bow_length(4), abs=0.05)


@pytest.mark.parametrize(
    ("changes", "repair"),
    [
        ({"degree": 7}, "2 times: a trajectory that cannot be read: its edge counts as straight"),
        ({"knotVector": [0, "a"]},
         "2 times: a trajectory that cannot be read: its edge counts as straight"),
        ({"controlPoints": [{"x": x, "y": 0} for x in (0, 1, 2, 3.6)]},
         "2 times: a trajectory that does not lead from start to end counts as straight"),
    ],
)  # fmt: skip
def test_a_trajectory_that_cannot_be_is_mended(
    tmp_path: Path, changes: dict[str, Any], repair: str
) -> None:
    found = read_layout(hall(tmp_path, 4, **changes))
    assert isinstance(found, Layout)
    assert any(note.startswith(f"{repair}: ") for note in tell_notes(found))
    assert all(edge.length in (10, 4) for edge in found.levels[0].edges)


def test_an_inspection_names_what_the_bow_comes_near_and_not_its_own_pieces(tmp_path: Path) -> None:
    scenario = loaded(hall(tmp_path, 4), radius=0.3).scenario
    site = Site(roadmap=scenario.roadmap, robots=scenario.robots, rules=scenario.rules)
    near = [str(each.fact) for each in inspect(site).findings if each.kind == "too near"]
    assert any("is too near to the lane C to D" in fact for fact in near)
    assert not any("A-B/" in fact for fact in near)


def test_a_curve_is_written_as_a_trajectory(tmp_path: Path) -> None:
    found = read_layout(hall(tmp_path, 4))
    assert isinstance(found, Layout)
    text, losses = format_layout(found, "lif")
    (tmp_path / "again.lif.json").write_text(text, encoding="utf-8")
    again = read_layout(tmp_path / "again.lif.json")
    assert isinstance(again, Layout)
    assert losses == ()
    assert [edge.shape for edge in again.levels[0].edges] == [
        edge.shape for edge in found.levels[0].edges
    ]
    _, losses = format_layout(found, "graphml")
    assert "curves that robots drive along (2: A to B and B to A)" in str(losses[0])
