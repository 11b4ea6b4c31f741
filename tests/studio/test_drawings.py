"""The picture of a map in what is shown and exported of its plans."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from rightofway import load, solve
from rightofway.io import format_plan, parse_plan
from rightofway.io.json_text import parse_json
from rightofway.studio.tasks.drawings import Origin, as_drawn
from rightofway.viz.page.payload import make_payload


def test_a_plan_on_a_ros_map_is_shown_over_its_picture(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The text of the plan has the map as a grid; the document behind it knows the picture."""
    from PIL import Image

    Image.new("L", (40, 30), 254).save(tmp_path / "hall.pgm")
    (tmp_path / "hall.yaml").write_text(
        "image: hall.pgm\nresolution: 0.5\norigin: [0, 0, 0]\nnegate: 0\n"
        "occupied_thresh: 0.65\nfree_thresh: 0.196\n"
    )
    robot = {"name": "R1", "home": {"x": 1, "y": 1}, "target": {"x": 9, "y": 9}, "speed": 1}
    document: dict[str, object] = {
        "format": "rightofway-scenario/1",
        "map": {"layout": "hall.yaml", "cell_size": 1},
        "robots": [robot],
    }
    (tmp_path / "site.json").write_text(json.dumps(document))
    monkeypatch.chdir(tmp_path)
    plan = solve(load(tmp_path / "site.json"), time_limit=1)
    bare = parse_plan(parse_json(format_plan(plan)))
    assert "background" not in make_payload(bare)["map"]
    drawn = as_drawn(bare, Origin(document=document, folder="."))
    assert make_payload(drawn)["map"]["background"]["href"].startswith("data:image/png")
    assert as_drawn(bare, None) is bare
    gone = {**document, "map": {"layout": "gone.yaml"}}
    assert as_drawn(bare, Origin(document=gone, folder=".")) is bare
