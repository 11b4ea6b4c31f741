"""The key ``pass`` of vertices in all files that have vertices."""

from __future__ import annotations

from pathlib import Path

import pytest

from rightofway import load, solve
from rightofway.io import (
    dump_scenario,
    format_layout,
    load_plan,
    parse_scenario,
    read_layout,
    write_plan,
    write_scenario,
)
from rightofway.site.layout import Layout

RMF = """
building_name: pass
levels:
  L1:
    vertices:
      - [0.0, 0.0, {name: a, is_parking_spot: true}]
      - [5.0, 0.0, {name: p, is_passthrough_point: true}]
      - [10.0, 0.0, {name: b, is_parking_spot: true}]
      - [5.0, 5.0, {name: c, is_parking_spot: true}]
    lanes: [[0, 1, {}], [1, 0, {}], [1, 2, {}], [2, 1, {}], [1, 3, {}], [3, 1, {}]]
"""

NODES = "name,x,y,pass\na,0,0,\np,5,0,yes\nb,10,0,no\n"
EDGES = "from,to,both_ways\na,p,yes\np,b,yes\n"

GRAPHML = """<?xml version="1.0"?>
<graphml><key id="k" for="node" attr.name="pass" attr.type="boolean"/>
<graph edgedefault="undirected">
<node id="a"><data key="x">0</data><data key="y">0</data></node>
<node id="p"><data key="x">5</data><data key="y">0</data><data key="k">true</data></node>
<edge source="a" target="p"/></graph></graphml>
"""


def write_scenario_on(folder: Path, layout: str) -> Path:
    """Write a scenario on the Open-RMF layout; return its path."""
    (folder / layout).write_text(RMF)
    path = folder / "fleet.yaml"
    path.write_text(
        "format: rightofway-scenario/1\n"
        f"map: {{layout: {layout}}}\n"
        "robots:\n"
        "  - {name: R1, home: a, target: b, work: 5}\n"
        "  - {name: R2, home: c, target: a, work: 1}\n"
    )
    return path


def list_passed(layout: Layout) -> list[str]:
    """Return the names of vertices that are driven through only."""
    return [v.name for level in layout.levels for v in level.vertices if v.is_passed]


@pytest.mark.parametrize(
    ("files", "name"),
    [
        ({"site.nav.yaml": RMF}, "site.nav.yaml"),
        ({"nodes.csv": NODES, "edges.csv": EDGES}, "nodes.csv"),
        ({"site.graphml": GRAPHML}, "site.graphml"),
    ],
)
def test_layouts_have_it(tmp_path: Path, files: dict[str, str], name: str) -> None:
    for file, text in files.items():
        (tmp_path / file).write_text(text)
    layout = read_layout(tmp_path / name)
    assert isinstance(layout, Layout)
    assert list_passed(layout) == ["p"]


@pytest.mark.parametrize(
    ("format_", "suffix"), [("open-rmf", ".nav.yaml"), ("graphml", ".graphml")]
)
def test_it_is_written_for_other_programs(tmp_path: Path, format_: str, suffix: str) -> None:
    (tmp_path / "site.nav.yaml").write_text(RMF)
    layout = read_layout(tmp_path / "site.nav.yaml")
    assert isinstance(layout, Layout)
    text, losses = format_layout(layout, format_)
    assert not any("drive through" in str(loss) for loss in losses)
    (tmp_path / f"again{suffix}").write_text(text)
    again = read_layout(tmp_path / f"again{suffix}")
    assert isinstance(again, Layout)
    assert list_passed(again) == ["p"]


@pytest.mark.parametrize("format_", ["lif", "nav2"])
def test_formats_without_a_place_for_it_say_so(tmp_path: Path, format_: str) -> None:
    (tmp_path / "site.nav.yaml").write_text(RMF)
    layout = read_layout(tmp_path / "site.nav.yaml")
    assert isinstance(layout, Layout)
    _, (losses,) = format_layout(layout, format_)
    assert "vertices that robots only drive through (1: p)" in str(losses)


@pytest.mark.parametrize("suffix", [".yaml", ".json", ".xlsx"])
def test_a_scenario_keeps_it(tmp_path: Path, suffix: str) -> None:
    scenario = load(write_scenario_on(tmp_path, "site.nav.yaml"))
    write_scenario(scenario, tmp_path / f"again{suffix}")
    assert load(tmp_path / f"again{suffix}") == scenario
    assert parse_scenario(dump_scenario(scenario)) == scenario
    vertices = dump_scenario(scenario)["map"]["roadmap"]["vertices"]
    assert vertices["p"] == {"at": [5.0, 0.0], "pass": True}
    assert list(vertices) == ["a", "p", "b", "c"]


def test_a_plan_lists_the_vertex_as_it_is_drawn(tmp_path: Path) -> None:
    plan = solve(load(write_scenario_on(tmp_path, "site.nav.yaml")), "prioritized")
    assert plan["R1"].vertices == ("a", "p", "b", "p", "a")
    write_plan(plan, tmp_path / "plan.json")
    again = load_plan(tmp_path / "plan.json")
    assert again.tracks == plan.tracks
    assert again.scenario == plan.scenario
