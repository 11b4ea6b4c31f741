"""The bottleneck of laps in words: in reports, on the page, and the steps that the studio lists.

R1 lives in the west (N3) and works in the north (N1), R2 lives in the east (N5) and works in the
south (N7); the door (N4) is in the middle. R1 goes in and comes out, then R2.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import pytest

from rightofway.cyclic import Piece, list_pieces_of_plan, make_excerpt, run_laps
from rightofway.io import load
from rightofway.model import Rules, Scenario, Tick
from rightofway.report.circuits import describe_circuit, list_circuit_steps, summarize_circuit
from tests.builders.fleets import grid_fleet
from tests.builders.plans import counter
from tests.builders.sizes import crossing

EXAMPLES = Path(__file__).parents[2] / "examples"


def door(rules: Rules | None = None) -> Scenario:
    return grid_fleet(
        ["@.@", "...", "@.@"], [("N3", "N1"), ("N5", "N7")], rules=rules or Rules(), work=(4, 2)
    )


def pieces(scenario: Scenario, *steps: tuple[str, int, str]) -> list[Piece]:
    """Return pieces of one tick each, of kinds, robots and places: ``("way", 0, "N3 N4")``."""
    return [
        Piece(
            kind=kind,  # type: ignore[arg-type]
            robot=robot,
            places=tuple(map(scenario.roadmap.get_vertex, places.split())),
            ticks=Tick(1),
        )
        for kind, robot, places in steps
    ]


FIRST = (("way", 0, "N4 N1"), ("work", 0, "N1"), ("way", 0, "N1 N4 N3"), ("way", 0, "N3 N4"))
SECOND = (("right of way", 1, "N4"), ("way", 1, "N4 N7"), ("work", 1, "N7"), ("way", 1, "N7 N4 N5"))
BACK = (("right of way", 0, "N4"),)


def words(*steps: tuple[str, int, str], most: int = 12) -> str:
    scenario = door()
    return describe_circuit(pieces(scenario, *steps), scenario, most=most)


def test_a_bottleneck_reads_as_ways_work_and_rights_of_way() -> None:
    assert words(*FIRST[:3], *SECOND, *BACK) == (
        "R1 enters N4 once R2 has left N4, drives to N1, works at N1, drives home;"
        " R2 enters N4 once R1 has left N4, drives to N7, works at N7, drives home"
    )


def test_a_right_of_way_between_robots_with_a_size_names_the_place_that_is_left() -> None:
    text = words(*FIRST[:3], ("right of way", 1, "N4 N3"), *SECOND[1:], *BACK)
    assert "R2 enters N4 once R1 has left N3" in text


def test_a_robot_that_does_not_work_where_it_stands_turns_there() -> None:
    assert "turns at N4" in words(*FIRST[:1], ("work", 0, "N4"), *SECOND, *BACK)


def test_a_long_bottleneck_is_cut_short_and_says_so() -> None:
    assert words(*FIRST[:3], *SECOND, *BACK, most=2) == (
        "R1 enters N4 once R2 has left N4, drives to N1; and 6 more steps"
    )


def test_laps_that_a_robot_makes_without_waiting_are_counted() -> None:
    lap = (FIRST[3], *FIRST[:3])
    assert words(*FIRST[:3], *lap, *lap, *SECOND, *BACK) == (
        "R1 enters N4 once R2 has left N4, drives to N1, works at N1, drives home,"
        " makes 2 laps of its own; R2 enters N4 once R1 has left N4, drives to N7, works at N7,"
        " drives home"
    )
    scenario = door()
    steps = list_circuit_steps(pieces(scenario, *FIRST[:3], *lap, *lap, *SECOND, *BACK), scenario)
    laps = next(step for step in steps if step.kind == "laps")
    assert laps.ticks == 8
    assert [scenario.roadmap.name(at) for at in laps.places] == ["N3", "N4", "N1"]


def test_a_robot_that_waits_for_nobody_is_its_own_bottleneck() -> None:
    assert words(*FIRST) == "R1's own lap: it waits for no robot"
    scenario = door()
    assert summarize_circuit(pieces(scenario, *FIRST), scenario, Tick(44)) == (
        "Bottleneck: R1 alone, which waits for no robot, 44 time units a period"
    )


def test_robots_beyond_the_first_three_are_counted() -> None:
    scenario = grid_fleet(["....."], [(f"N{k}", f"N{k}") for k in range(5)], rules=Rules())
    steps = [("way", robot, f"N{robot} N{robot}") for robot in range(5)]
    assert summarize_circuit(pieces(scenario, *steps), scenario, Tick(9)) == (
        "Bottleneck: R1, R2, R3 and 2 more, 9 time units a period"
    )


def texts(pieces: Sequence[Piece], scenario: Scenario) -> list[tuple[int, str, str, int]]:
    return [
        (step.robot, step.kind, step.text, step.ticks)
        for step in list_circuit_steps(pieces, scenario)
    ]


def lanes() -> Scenario:
    """Return robots with a size on lanes that cross, where a right of way has two places."""
    scenario = crossing()
    return replace(scenario, robots=tuple(replace(robot, ends="home") for robot in scenario.robots))


@pytest.mark.parametrize(
    "scenario",
    [
        counter().scenario,
        lanes(),
        *(load(EXAMPLES / f"{name}.yaml") for name in ("crossroad", "door", "bay")),
    ],
    ids=["counter", "lanes", "crossroad", "door", "bay"],
)
def test_a_plan_of_laps_has_the_sentence_of_its_report(scenario: Scenario) -> None:
    """The page has only the plan and its critical visits, the report has the graph."""
    run = run_laps(scenario, "first-come")
    plan, steady = make_excerpt(run)
    repeating = [group for group in run.groups if group.pattern]
    assert len(repeating) == len(steady)
    compared = 0
    for group, state in zip(repeating, steady, strict=True):
        bottleneck = group.find_bottleneck()
        if bottleneck is None or not state.critical:
            continue
        compared += 1
        found = list_pieces_of_plan(plan, state)
        assert texts(found, scenario) == texts(bottleneck.pieces, scenario)
    assert compared
