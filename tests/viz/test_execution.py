"""What the page is told about a plan that was run on the floor."""

import json
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from rightofway.errors import InputError
from rightofway.model import ExecutionTrace, Tick, Track
from rightofway.viz import make_payload
from tests.builders.plans import counter, counter_late, door


def told(actual: ExecutionTrace | None = None) -> Any:
    payload = make_payload(counter(), actual=actual or counter_late())
    return json.loads(json.dumps(payload))["floor"]


def test_what_happened_is_told_on_the_way_of_the_plan() -> None:
    one, two = told()["robots"]
    assert one["enter"] == [0, 1, 9, 5, 5]  # 0, 1, 10, 15, 20
    assert "vertices" not in one
    assert (one["still"], two["still"]) == ([[3, 4]], [[22, None]])
    assert (one["completion"], two["completion"]) == (None, None)


def test_the_plan_itself_is_told_as_ever() -> None:
    said = {"floor", "phrases"}  # of the execution there are more
    payload, planned = make_payload(counter(), actual=counter_late()), make_payload(counter())
    assert {key: payload[key] for key in payload.keys() - said} == {  # type: ignore[literal-required]
        key: planned[key]  # type: ignore[literal-required]
        for key in planned.keys() - said
    }


def test_standing_still_is_not_waiting() -> None:
    """R2 waits for R1 from 0 to 9 and from 16 to 19, R1 for R2 from 11 to 14.

    The rows: kind, robot, for whom, vertex first and last, towards, freed, tick, end, ticks.
    """
    rows = [
        [0, 0, 1, 0, 0, 1, 1, 11, 14, 3],
        [0, 1, 0, 2, 2, 1, 1, 0, 9, 9],
        [0, 1, 0, 2, 2, 1, 1, 16, 19, 3],
    ]
    assert [row[:-1] for row in told()["losses"]] == rows


def test_stages_take_what_they_really_took() -> None:
    """R1 needs 6 instead of 3 to work and 2 instead of 1 to turn: 8 instead of 4."""
    actual = counter_late()
    slow = replace(actual, dwell=(np.array([0, 8, 1, 4, 1]), actual.dwell[1]))
    stages = told(slow)["robots"][0]["stages"]
    assert stages[:2] == [[1, 6, 2, 1], [0, 0, 1, 2]]
    # the third lap's work was never begun
    assert stages[4] == [1, 3, 1, -1]


def test_a_run_as_planned_ends_with_the_plan() -> None:
    plan = door()
    actual = ExecutionTrace(
        tracks=plan.tracks,
        dwell=(np.array([0, 0, 0, 0, 1, 0, 0, 0, 0]),) * 2,
        drive=(np.array([0, *[1] * 8]),) * 2,
        completion=(Tick(10), Tick(9)),
    )
    payload = make_payload(plan, actual=actual)
    assert payload["floor"]["end"] == payload["end"] == 10
    assert payload["floor"]["losses"] == payload["losses"]


def test_another_way_is_told_with_its_vertices() -> None:
    """R1 of the door turns back in N7 after R2 broke down in N4, and so never works."""
    plan = door()
    actual = ExecutionTrace(
        tracks=(Track.of([0, 1, 0], [0, 1, 2]), Track.of([2, 1, 3], [0, 2, 3])),
        dwell=(np.zeros(3, np.int64), np.zeros(3, np.int64)),
        drive=(np.array([0, 1, 1]), np.array([0, 1, 1])),
        completion=(None, None),
        stoppages=((), ((Tick(3), None),)),
    )
    one, two = make_payload(plan, actual=actual)["floor"]["robots"]
    assert one["vertices"] == [0, 1, -1]
    assert [visit for *_, visit in one["stages"]] == [-1, -1]
    assert "vertices" not in two


def test_every_robot_needs_a_track() -> None:
    actual = counter_late()
    half = ExecutionTrace(
        tracks=actual.tracks[:1],
        dwell=actual.dwell[:1],
        drive=actual.drive[:1],
        completion=(None,),
    )
    with pytest.raises(InputError, match=r"actual.tracks: 1 for 2 robots \(give one for each\)"):
        make_payload(counter(), actual=half)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"dwell": ()}, r"dwell: 0 for 2 tracks \(give one for each\)"),
        ({"completion": (None,)}, "completion: 1 for 2 tracks"),
        ({"stoppages": ((),)}, "stoppages: 1 for 2 tracks"),
        ({"drive": (np.zeros(5), np.zeros(5))}, r"drive\[1\]: 5 for 4 visits"),
    ],
)
def test_what_happened_is_told_whole(change: dict[str, Any], message: str) -> None:
    with pytest.raises(InputError, match=message):
        replace(counter_late(), **change)
