"""A roadmap on which very many lanes cross: what excludes each other takes long to find."""

from __future__ import annotations

import json
import math
import random
import resource
import time
from pathlib import Path

import pytest

from rightofway.cli.main import run
from rightofway.errors import GaveUp
from rightofway.io import load
from rightofway.model.deadline import WorkLimit, check_work, limited_work


@pytest.fixture(scope="module")
def dense(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a file of 1200 vertices, each joined to about 46; a million pairs of lanes cross.

    Positions have twelve decimals, so that their products do not fit 64 bits. All lanes are as long
    as the longest, so that the file is read soon.
    """
    draw = random.Random(1)  # noqa: S311 (no secret depends on it)
    count, side = 1200, 100
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
    ends = [(by_x[k], by_x[-1 - k]) for k in range(0, 500, 50)]
    robots = [
        {"name": f"R{k}", "home": f"v{one}", "target": f"v{other}", "radius": "0.05"}
        for k, (one, other) in enumerate(ends)
    ]
    path = tmp_path_factory.mktemp("dense") / "dense.json"
    fleet = {"map": {"roadmap": {"vertices": vertices, "edges": lanes}}, "robots": robots}
    path.write_text(json.dumps({"format": "rightofway-scenario/1", **fleet}))
    return path


@pytest.fixture(scope="module")
def reading(dense: Path) -> float:
    """Return how long the file is read, without what excludes each other [s]."""
    began = time.process_time()
    with pytest.raises(GaveUp), limited_work(WorkLimit(0)):
        load(dense)
    return time.process_time() - began


@pytest.mark.parametrize("command", [["plan"], ["laps"], ["laps", "--rule", "timetable"]])
def test_a_command_gives_up_in_time_and_says_what_took_it(
    dense: Path, reading: float, command: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    began = time.process_time()
    assert run([*command, str(dense), "--time-limit", "0.5"]) == 3
    assert time.process_time() - began < 1.5 * reading + 0.5 + 0.5
    took_it = "time ran out while finding vertices and lanes that two robots may not book at once"
    assert took_it in capsys.readouterr().err
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 200_000  # kB


def test_the_clock_of_derived_work_starts_with_its_first_piece() -> None:
    limit = WorkLimit(60)
    with limited_work(limit):
        assert limit.deadline is None  # reading a file is not limited
        before = time.monotonic()
        check_work("testing")
        assert limit.deadline is not None
        assert limit.deadline.at is not None
        assert before + 60 <= limit.deadline.at <= time.monotonic() + 60
    with limited_work(WorkLimit(0)), pytest.raises(GaveUp, match="while testing"):
        check_work("testing")
    check_work("testing")  # no limit
