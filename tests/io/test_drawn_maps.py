"""What a scenario draws beyond the graph: curves of lanes, the picture below a map."""

from __future__ import annotations

import json
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest
from PIL import Image

from rightofway import InputError, Scenario, load, solve, write_page, write_plan, write_scenario
from rightofway.io import format_plan, load_plan, load_with_notes
from rightofway.io.scenario.curves import ERROR, make_lane_curve
from rightofway.io.scenario.reader import parse_scenario
from tests.builders.sentences import tell_notes

A, B = (Fraction(0), Fraction(0)), (Fraction(8), Fraction(0))


def bent(**changes: Any) -> dict[str, Any]:
    """Return a scenario of one curved lane from A to B and a straight one to C."""
    curve = {"from": "A", "to": "B", "curve": [[4, 6]]}
    return {
        "format": "rightofway-scenario/1",
        "map": {
            "roadmap": {
                "vertices": {"A": [0, 0], "B": [8, 0], "C": [8, 4]},
                "edges": [curve, ["B", "C"]],
            },
            "y": "up",
        },
        "robots": [{"name": "R1", "home": "A", "target": "C", **changes}],
    }


def edge_length(scenario: Scenario, tail: str, head: str) -> Fraction:
    roadmap = scenario.roadmap
    edge = roadmap.find_edge(roadmap.get_vertex(tail), roadmap.get_vertex(head))
    assert edge is not None
    length: Fraction = roadmap.get_edge_class(edge).length
    return length


def test_a_curve_is_one_edge_of_its_own_length() -> None:
    """The parabola with control point (4, 6) over a chord of 8 has its apex at 3.

    Its length is sqrt(16 + 36) + 16/6 asinh(6/4) = 10.398 (half each side of the apex).
    """
    scenario = parse_scenario(bent())
    assert scenario.roadmap.n_vertices == 3
    length = edge_length(scenario, "A", "B")
    assert float(length) == pytest.approx(10.398, abs=0.04)
    assert edge_length(scenario, "B", "A") == length
    tail, head, points = scenario.roadmap.drawing.curves[0]
    assert (scenario.roadmap.name(tail), scenario.roadmap.name(head)) == ("A", "B")
    assert max(y for _, y in points) == pytest.approx(3, abs=0.01)


def test_robots_with_a_size_drive_along_the_pieces_and_keep_further_apart() -> None:
    scenario = parse_scenario(bent(radius=0.25))
    assert scenario.roadmap.n_vertices > 10
    assert not scenario.roadmap.drawing.curves
    error = make_lane_curve(A, [(Fraction(4), Fraction(6))], B).error
    assert scenario.rules.clearance == 2 * error
    assert float(error) == pytest.approx(float(ERROR) * 2 * 52**0.5, rel=1e-3)


def test_a_curve_is_as_long_with_a_size_as_without() -> None:
    plans = [solve(parse_scenario(bent(**more)), time_limit=1) for more in ({}, {"radius": 0.25})]
    spans = [float(plan.makespan * plan.scenario.problem.clock.tick) for plan in plans]
    assert spans[0] == pytest.approx(spans[1], rel=0.002)


def test_a_curve_that_is_split_by_spacing_has_its_vertices_on_it() -> None:
    document = bent()
    document["map"]["spacing"] = 3
    roadmap = parse_scenario(document).roadmap
    middle = roadmap.positions[roadmap.get_vertex("A-B/2")]
    assert middle.tolist() == pytest.approx([4, -3], abs=0.01)  # four pieces; y is drawn downwards


@pytest.mark.parametrize("suffix", [".yaml", ".json", ".xlsx"])
def test_files_keep_curves_and_the_picture(tmp_path: Path, suffix: str) -> None:
    document = bent()
    document["map"]["picture"] = {"file": "hall.png", "scale": "1/20", "origin": [0, -1]}
    Image.new("L", (40, 30), 200).save(tmp_path / "hall.png")
    written = tmp_path / f"floor{suffix}"
    write_scenario(parse_scenario(document, tmp_path), written)
    drawing = load(written).roadmap.drawing
    assert [points for _, _, points in drawing.controls] == [((Fraction(4), Fraction(6)),)] * 2
    assert drawing.picture is not None
    assert drawing.picture.file == tmp_path / "hall.png"
    assert (drawing.picture.pixel, drawing.picture.origin) == (
        Fraction(1, 20),
        (Fraction(0), Fraction(-1)),
    )


def test_a_plan_file_names_the_picture_and_the_page_shows_it(tmp_path: Path) -> None:
    document = bent()
    document["map"]["picture"] = {"file": "hall.png", "opacity": 0.25}
    Image.new("L", (40, 30), 200).save(tmp_path / "hall.png")
    (tmp_path / "floor.yaml").write_text(json.dumps(document))
    write_plan(solve(load(tmp_path / "floor.yaml"), time_limit=1), tmp_path / "plan.json")
    plan = load_plan(tmp_path / "plan.json")
    write_page(plan, tmp_path / "plan.html")
    page = (tmp_path / "plan.html").read_text()
    assert '"opacity":0.25' in page
    assert "data:image/png" in page
    (tmp_path / "hall.png").unlink()
    write_page(load_plan(tmp_path / "plan.json"), tmp_path / "plan.html")
    assert '"opacity":0.25' not in (tmp_path / "plan.html").read_text()


def test_a_plan_file_without_the_keys_has_none_of_them() -> None:
    document = bent()
    document["map"]["roadmap"]["edges"][0] = ["A", "B"]
    text = format_plan(solve(parse_scenario(document), time_limit=1))
    assert "curve" not in text
    assert "picture" not in text


def test_a_picture_that_is_missing_is_a_note(tmp_path: Path) -> None:
    document = bent()
    document["map"]["picture"] = {"file": "hall.png"}
    (tmp_path / "floor.yaml").write_text(json.dumps(document))
    loaded = load_with_notes(tmp_path / "floor.yaml")
    assert "there is no picture 'hall.png'; the map is shown without it" in tell_notes(loaded)


@pytest.mark.parametrize(
    ("picture", "fault"),
    [
        ({"file": "text.png"}, "map.picture.file: 'text.png' is no picture that can be read"),
        ({"file": "huge.png"}, "map.picture.file: 'huge.png' has more than 50000000 pixels"),
        ({"file": "hall.png", "scale": 0}, "map.picture.scale: 0 is not positive"),
        ({"file": "hall.png", "opacity": 2}, "map.picture.opacity: 2 is above 1"),
        ({"file": "hall.png", "size": 2}, "map.picture.size: unknown key"),
        ({"file": "."}, "map.picture.file: '.' is no picture that can be read"),
    ],
)
def test_pictures_that_do_not_fit_are_refused(
    tmp_path: Path, picture: dict[str, Any], fault: str
) -> None:
    (tmp_path / "text.png").write_text("no picture")
    Image.new("L", (40, 30), 200).save(tmp_path / "hall.png")
    Image.new("1", (7200, 7200)).save(tmp_path / "huge.png")
    document = bent()
    document["map"]["picture"] = picture
    with pytest.raises(InputError, match=f"^{fault[:20]}") as error:
        parse_scenario(document, tmp_path)
    assert fault in str(error.value)


@pytest.mark.parametrize("curve", [[], [[1, 2], [3, 4], [5, 6]], [[1]], "round"])
def test_curves_that_do_not_fit_are_refused(curve: Any) -> None:
    document = bent()
    document["map"]["roadmap"]["edges"][0]["curve"] = curve
    with pytest.raises(InputError, match=r"edges\[0\].curve"):
        parse_scenario(document)
