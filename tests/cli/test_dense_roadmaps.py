"""A roadmap on which very many lanes cross: what excludes each other takes long to find."""

from __future__ import annotations

import json
import math
import random
import time
from fractions import Fraction
from itertools import groupby
from pathlib import Path

import pytest

from rightofway import check, solve
from rightofway.cli import planning
from rightofway.cli.main import run
from rightofway.deadline import (
    DERIVING,
    READING,
    Deadline,
    check_work,
    limit_loop,
    limit_work,
)
from rightofway.errors import GaveUp
from rightofway.facts import Fact
from rightofway.io import load
from rightofway.model.resources import bind_resources
from rightofway.native import bind_lists
from rightofway.site import Edge, make_roadmap
from rightofway.site.spacing import SPLITTING
from tests.cli.conftest import EXAMPLES


@pytest.fixture(scope="module")
def dense(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a file of 120 vertices, each joined to about 40; tens of thousands of lanes cross.

    Positions have twelve decimals, so that their products do not fit 64 bits. All lanes are as long
    as the longest, so that the file is read soon.
    """
    draw = random.Random(1)  # noqa: S311 (no secret depends on it)
    count, side = 120, 30
    reach = side * math.sqrt(46 / (math.pi * count))
    at = [(draw.random() * side, draw.random() * side) for _ in range(count)]
    by_x = sorted(range(count), key=at.__getitem__)
    lanes = []
    for k, one in enumerate(by_x):
        for other in by_x[k + 1 :]:
            if at[other][0] - at[one][0] > reach:
                break
            if math.dist(at[one], at[other]) <= reach:
                lanes.append({"from": f"v{one}", "to": f"v{other}", "length": math.ceil(reach)})
    vertices = {f"v{k}": [round(x, 12), round(y, 12)] for k, (x, y) in enumerate(at)}
    ends = [(by_x[k], by_x[-1 - k]) for k in range(0, 40, 10)]
    robots = [
        {"name": f"R{k}", "home": f"v{one}", "target": f"v{other}", "radius": "0.3"}
        for k, (one, other) in enumerate(ends)
    ]
    path = tmp_path_factory.mktemp("dense") / "dense.json"
    fleet = {"map": {"roadmap": {"vertices": vertices, "edges": lanes}}, "robots": robots}
    path.write_text(json.dumps({"format": "rightofway-scenario/1", **fleet}))
    return path


class Counted(Deadline):
    """A deadline that comes when it has been asked a number of times."""

    def __init__(self, most: int) -> None:
        super().__init__()
        object.__setattr__(self, "asked", list[Fact | str]())
        object.__setattr__(self, "most", most)

    asked: list[Fact | str]
    most: int

    def check(self, doing: Fact | str) -> None:
        self.asked.append(doing)
        if len(self.asked) > self.most:
            raise GaveUp(Fact("time over", doing=doing))


def graphml_of(dense: Path) -> Path:
    """Return a scenario whose map is the same roadmap as GraphML."""
    document = json.loads(dense.read_text())
    roadmap = document["map"].pop("roadmap")
    nodes = (
        f'<node id="{name}"><data key="x">{x}</data><data key="y">{y}</data></node>'
        for name, (x, y) in roadmap["vertices"].items()
    )
    edges = (f'<edge source="{it["from"]}" target="{it["to"]}"/>' for it in roadmap["edges"])
    text = "\n".join(['<graphml><graph edgedefault="undirected">', *nodes, *edges])
    dense.with_name("lanes.graphml").write_text(f"{text}</graph></graphml>")
    path = dense.with_name("lanes.json")
    path.write_text(json.dumps(document | {"map": {"layout": "lanes.graphml"}}))
    return path


@pytest.mark.slow
@pytest.mark.parametrize(
    ("kind", "stages"),
    [
        ("roadmap", [READING, SPLITTING, DERIVING]),
        ("GraphML", [READING, SPLITTING, DERIVING]),
    ],
)
def test_each_stage_asks_for_the_time_and_ends_when_it_is_over(
    dense: Path, kind: str, stages: list[Fact]
) -> None:
    """No stage is longer than some hundred lanes between two questions."""
    path = dense if kind == "roadmap" else graphml_of(dense)
    whole = Counted(10**9)
    with limit_work(whole):
        load(path)
    assert [doing for doing, _ in groupby(whole.asked)] == stages
    assert len(whole.asked) > 20 * len(stages)
    begins = [len(list(same)) for _, same in groupby(whole.asked)]
    for k in range(len(begins)):
        over = Counted(sum(begins[:k]))
        with limit_work(over), pytest.raises(GaveUp, match=f"while {stages[k]}"):
            load(path)


@pytest.mark.parametrize("command", [["plan"], ["laps"], ["laps", "--rule", "timetable"]])
def test_a_command_gives_up_in_time_and_says_what_took_it(
    dense: Path, command: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    """The limit holds from the beginning on: nothing of the file has been read."""
    assert run([*command, str(dense), "--time-limit", "0.001"]) == 3
    assert "time ran out while reading the map" in capsys.readouterr().err


def test_planning_leaves_time_to_write_each_lane(
    dense: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A grid is written row by row, whatever lanes it has."""
    monkeypatch.setattr(planning, "SECONDS_PER_LANE", 0.1)
    lanes = load(dense).roadmap.n_edges
    for scenario, left in ((load(dense), lanes * 0.9), (load(EXAMPLES / "door.yaml"), lanes)):
        ends = planning._reserve_time_to_write(Deadline.after(lanes), scenario)
        assert ends.measure_seconds_left() == pytest.approx(left, abs=5)


def test_a_fleet_finds_the_rows_that_it_books_and_no_others(dense: Path) -> None:
    """Four robots on 5 000 lanes that cross: they use few of the pieces."""
    scenario = load(dense)
    plan = solve(scenario, "prioritized", time_limit=None)
    assert not check(plan).faults
    lists = bind_lists(scenario.problem.resources)
    assert lists is not None
    assert 0 < lists.n_found < lists.n_rows / 20


def test_a_place_more_costs_no_look_at_all_others() -> None:
    """20 000 places in a row: a look at all of them for each one took 10 s."""
    positions = {f"v{k}": (float(k), 0.0) for k in range(20_000)}
    lanes = [
        Edge(tail=f"v{k}", head=f"v{k + 1}", length=Fraction(1)) for k in range(len(positions) - 1)
    ]
    roadmap = make_roadmap(positions, lanes)
    resources = bind_resources(roadmap, [Fraction("0.3")], Fraction(0))
    began = time.process_time()
    assert bind_lists(resources) is not None
    assert time.process_time() - began < 3


TESTING = Fact("giving right of way")


def test_work_is_limited_inside_and_nowhere_else() -> None:
    with limit_work(Deadline.after(0)), pytest.raises(GaveUp, match="while giving right of way"):
        check_work(TESTING)
    with limit_work(Deadline.after(60)):
        check_work(TESTING)
    check_work(TESTING)  # no limit
    with limit_work(Counted(0)), pytest.raises(GaveUp):
        list(limit_loop(range(9), TESTING))
    counted = Counted(9)
    with limit_work(counted):
        assert list(limit_loop(range(600), TESTING)) == list(range(600))
    assert len(counted.asked) == 3, "before items 0, 256 and 512"
