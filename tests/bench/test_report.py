"""What results are summed up to, and the report on them."""

from __future__ import annotations

import base64
import re
from dataclasses import astuple
from pathlib import Path
from typing import Any

import pytest

from rightofway.bench import COLUMNS, Group, Quartiles, Row, group_by_planner, write_report
from rightofway.bench.summary import group_by_robots
from rightofway.errors import InputError


def row(number: int, **values: Any) -> Row:
    """Return a row that took as many seconds as its number and is that many tenths above 1."""
    return {
        **{column.name: None for column in COLUMNS},
        "key": str(number), "map": "hall", "fleet": "a, b", "scen": "", "planner": "one",
        "options": "", "limit": 10.0, "robots": 5, "solved": True, "valid": True,
        "status": "solved", "ratio": 1 + number / 10, "first_plan_seconds": float(number),
        "peak_memory": 10.0 * number, "version": "0.1.0", "commit": "", "cpu": "abacus",
        "cores": 2, "compiler": "GCC 12", "python": "3.11.0", **values,
    }  # fmt: skip


def failed(number: int, **values: Any) -> Row:
    nothing = {"ratio": None, "first_plan_seconds": None, "peak_memory": None}
    return row(number, solved=False, valid=None, status="gave up", **nothing, **values)


def test_a_group_has_medians_of_what_is_solved() -> None:
    group = Group.of([row(1), row(2), row(3), row(4), failed(5)])
    assert (group.cases, group.solved, group.memory) == (5, 4, 40)
    assert group.ratio is not None
    assert astuple(group.ratio) == pytest.approx((1.175, 1.25, 1.325))
    assert group.seconds == Quartiles(1.75, 2.5, 3.25)
    assert group.statuses == {"solved": 4, "gave up": 1}


def test_where_nothing_is_solved_there_is_no_median() -> None:
    group = Group.of([failed(1)])
    assert (group.ratio, group.seconds, group.memory) == (None, None, None)


def test_planners_are_named_by_what_tells_them_apart() -> None:
    plain = [row(1), row(2, planner="two", options="a=1 b=1")]
    assert list(group_by_planner(plain)) == ["one", "two"]
    with_options = [*plain, row(3, planner="two", options="a=2 b=1")]
    assert list(group_by_planner(with_options)) == ["one", "two a=1", "two a=2"]
    with_limits = [*plain, row(3, limit=0.5)]
    assert list(group_by_planner(with_limits)) == ["one (10 s)", "two (10 s)", "one (0.5 s)"]


def test_groups_by_robots_are_in_order() -> None:
    groups = group_by_robots([row(1, robots=20), row(2, robots=5), row(3, robots=20)])
    assert {robots: group.cases for robots, group in groups.items()} == {5: 1, 20: 2}
    assert list(groups) == [5, 20]


ROWS = [
    row(1), row(2), failed(3), row(4, robots=10),
    row(5, planner="<two>", map="a|b"), failed(6, planner="<two>", robots=10),
]  # fmt: skip


def test_a_page_needs_no_other_file_and_is_the_same_for_the_same_rows(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    for name in ("a.html", "b.html"):
        write_report(ROWS, tmp_path / name, "Halls & lanes")
    assert (tmp_path / "a.html").read_bytes() == (tmp_path / "b.html").read_bytes()
    page = (tmp_path / "a.html").read_text(encoding="utf-8")
    assert "<h1>Halls &amp; lanes</h1>" in page
    assert "<td>3 of 4</td><td>1.200 (1.150 to 1.300)</td>" in page
    assert "<td>&lt;two&gt;</td><td>1 of 2</td>" in page
    assert "6 cases by rightofway 0.1.0 on abacus, 2 cores, GCC 12, Python 3.11.0." in page
    assert "http" not in page
    cactus, ratio = pictures(page)
    assert "solved cases, of 4" in cactus
    assert "&lt;two&gt;" in cactus
    assert "hall, a, b" in ratio
    assert "flowtime / lower bound" in ratio


def pictures(page: str) -> list[str]:
    found = re.findall(r'src="data:image/svg\+xml;base64,([^"]*)"', page)
    return [base64.b64decode(data).decode("utf-8") for data in found]


def test_markdown_has_its_pictures_beside_it(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    write_report(ROWS, tmp_path / "halls.md", "Halls")
    text = (tmp_path / "halls.md").read_text(encoding="utf-8")
    assert "| a\\|b | a, b | 5 | <two> | 1 of 1 | 1.500 | 5 | 50 |" in text
    for name in re.findall(r"!\[[^\]]*\]\(([^)]*)\)", text):
        assert (tmp_path / name).read_bytes().startswith(b"\x89PNG")
    assert len(list(tmp_path.iterdir())) == 3


def test_a_report_can_be_made_where_nothing_is_solved(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    write_report([failed(1)], tmp_path / "r.html", "Nothing")
    assert "0 of 1" in (tmp_path / "r.html").read_text(encoding="utf-8")


def test_there_is_no_report_on_nothing(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"there is no row to report on \(run some cases\)"):
        write_report([], tmp_path / "r.html", "Nothing")
