"""The script on shifts: a warehouse that it draws is a scenario that is served."""

from __future__ import annotations

from pathlib import Path

from benchmarks.shifts import draw_warehouse, hold_league_shift, hold_warehouse_shift
from rightofway.io.scenario.reader import parse_scenario

LINES = ["type octile", "height 5", "width 40", "map", *["." * 40] * 5]


def test_a_drawn_warehouse_is_served(tmp_path: Path) -> None:
    (tmp_path / "hall.map").write_text("\n".join(LINES))
    document = draw_warehouse(str(tmp_path / "hall.map"), 3, 120, 1, sizes=True)
    record = hold_warehouse_shift(parse_scenario(document), 0.2, 2, 1)
    assert record.jobs
    assert all(own.ended is not None for own in record.jobs.values())


def test_a_problem_of_the_league_is_held(tmp_path: Path) -> None:
    (tmp_path / "hall.map").write_text("\n".join(LINES))
    (tmp_path / "two.agents").write_text("2\n0\n39\n")
    (tmp_path / "two.tasks").write_text("4\n5\n20\n40\n50\n")
    path = tmp_path / "problem.json"
    path.write_text(
        '{"mapFile": "hall.map", "agentFile": "two.agents", "teamSize": 2,'
        ' "taskFile": "two.tasks", "taskAssignmentStrategy": "roundrobin"}'
    )
    name, robots, steps, done, *_ = hold_league_shift(str(path), 100, 0.1, 0)
    assert (name, robots, steps, done) == ("problem", "2", "100", "4")
