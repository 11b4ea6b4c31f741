"""What functions for callers say of arguments that are something else."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import rightofway
from rightofway import search
from rightofway.errors import InputError
from rightofway.native import bind_native

DOOR = rightofway.load(Path(__file__).parents[2] / "examples/door.yaml")
PROBLEM = DOOR.problem
FLOOR = search.Distances(PROBLEM.roadmap)
PACE = PROBLEM.itineraries[0].edge_ticks

MISUSE: list[tuple[Callable[[], Any], str]] = [
    (lambda: rightofway.measure(None), "plan: nothing is no Plan"),  # type: ignore[arg-type]
    (lambda: rightofway.check(3), "plan: 3 is no Plan"),  # type: ignore[arg-type]
    (lambda: rightofway.waits("x"), "plan: 'x' is no Plan"),  # type: ignore[arg-type]
    (lambda: rightofway.compute_lost_time([]), "is no Plan"),  # type: ignore[arg-type]
    (lambda: rightofway.simulate(None), "plan: nothing is no Plan"),  # type: ignore[arg-type]
    (lambda: rightofway.run_laps(None), "scenario: nothing is no Scenario"),  # type: ignore[arg-type]
    (lambda: rightofway.find_best_timetable(3), "scenario: 3 is no Scenario"),  # type: ignore[arg-type]
    (lambda: rightofway.plan_of_laps(3), "result: 3 is no CyclicResult"),  # type: ignore[arg-type]
    (lambda: bind_native(DOOR), "problem: .* is no problem"),  # type: ignore[arg-type]
    (lambda: search.FleetSearch(PROBLEM, seed=-1), "seed: -1 does not fit"),
    (lambda: search.FleetSearch(PROBLEM, threads=-1), "threads: -1 does not fit"),
    (
        lambda: search.FleetSearch(PROBLEM).prioritize(
            [0.5, 1.2],  # type: ignore[list-item]
            searches=9,
            time_limit=None,
        ),
        r"order\[0\]: 0.5 is none of 2",
    ),
    (lambda: search.FleetSearch(PROBLEM).start(["a"]), r"tracks\[0\]: 'a' is no track"),  # type: ignore[list-item]
    (lambda: FLOOR.compute_edge_ticks(PACE + PACE), "edge_ticks: 2 for 1 edge classes"),
    (lambda: FLOOR.find_path(-1, 0, PACE), "start: -1 is none of 7"),  # type: ignore[arg-type]
    (lambda: FLOOR.compute_cost((0, 99), PACE), r"path\[1\]: 99 is none of 7"),  # type: ignore[arg-type]
    (lambda: search.plan_by_lacam(PROBLEM, ends_anywhere=[9]), "ends_anywhere: 9 is none of 2"),
    (
        lambda: search.find_earliest_track(9, search.Bookings(PROBLEM), FLOOR),
        "robot: 9 is none of 2",
    ),
]


@pytest.mark.parametrize(("misuse", "message"), MISUSE)
def test_what_is_something_else_is_refused_by_place_and_value(
    misuse: Callable[[], Any], message: str
) -> None:
    with pytest.raises(InputError, match=message):
        misuse()
