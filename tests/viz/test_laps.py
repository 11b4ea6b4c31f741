"""What the page is told about robots that repeat themselves."""

import json
from dataclasses import replace
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from rightofway.cyclic import make_excerpt, run_laps
from rightofway.errors import InputError
from rightofway.model import Status, SteadyState, Tick
from rightofway.viz import make_page, make_payload
from tests.builders.fleets import grid_fleet
from tests.builders.languages import read_entry
from tests.builders.payloads import template_in
from tests.builders.plans import counter, counter_steady, door


def test_what_a_plan_says_itself_is_told() -> None:
    group = counter_steady()
    plan = replace(counter(4), steady=(group,))
    assert make_payload(plan) == make_payload(counter(4), steady=[group])


def told(*groups: SteadyState, laps: int = 4) -> Any:
    return json.loads(json.dumps(make_payload(counter(laps), steady=groups)))


def test_a_group_is_told_with_its_circuit() -> None:
    payload = told(counter_steady())
    (group,) = payload["steady"]
    short, at_length = (read_entry(payload["phrases"], text) for text in group.pop("bottleneck"))
    assert group == {
        "robots": [0, 1],
        "start": 6,
        "period": 10,
        "until": 36,
        "critical": [[0, 3], [0, 2], [1, 1], [1, 2]],
    }
    assert short == "Bottleneck: R1 and R2, 10 time units a period"
    assert at_length == (
        "R1 enters N1 once R2 has left N1, works at N1, drives home;"
        " R2 enters N1 once R1 has left N1, works at N1, drives home"
    )


def test_the_repetition_ends_with_the_last_lap() -> None:
    """R1 comes home at 6, 16, 26, 36 and then stays; R2 5 ticks later."""
    one, two = (SteadyState(robots=(robot,), start=Tick(6), period=Tick(10)) for robot in (0, 1))
    assert [group["until"] for group in told(one, two)["steady"]] == [36, 41]


def test_a_wrong_period_repeats_nothing() -> None:
    """R1 enters N1 at 11, but not at 20."""
    wrong = replace(counter_steady(), period=Tick(9))
    assert told(wrong)["steady"][0]["until"] < 6 + 9


def test_a_plan_that_ends_before_the_start_repeats_nothing() -> None:
    late = replace(counter_steady(), start=Tick(100), critical=())
    assert told(late)["steady"][0]["until"] == 100


def test_home_at_tick_0_is_not_the_first_of_a_period() -> None:
    """R1 is home from 6 for turning, waiting and the drive, but at 0 it need not turn."""
    group = SteadyState(robots=(0,), start=Tick(0), period=Tick(10))
    assert told(group)["steady"][0]["until"] == 36


def test_laps_are_told_and_the_page_ends_with_them() -> None:
    payload = told(counter_steady())
    assert (payload["laps"], payload["end"]) == ([4, 4], 36)


def test_a_page_without_them_is_told_nothing() -> None:
    assert make_payload(counter()).keys() == make_payload(door()).keys()
    assert {"steady", "laps", "floor"}.isdisjoint(make_payload(counter()))
    assert make_page(door()) == make_page(door(), steady=(), actual=None)


@pytest.mark.parametrize(
    ("group", "message"),
    [
        (
            SteadyState(robots=(0, 2), start=Tick(0), period=Tick(10)),
            r"steady\[0\].robots: there is no robot 2 \(give 0 to 1\)",
        ),
        (
            replace(counter_steady(), critical=((1, 9),)),
            r"steady\[0\].critical\[0\]: R2 has no visit 9 \(give 0 to 8\)",
        ),
    ],
)
def test_strangers_are_refused(group: SteadyState, message: str) -> None:
    with pytest.raises(InputError, match=message):
        make_payload(counter(), steady=[group])


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"period": Tick(0)}, "period: 0 does not fit"),
        ({"start": Tick(-1)}, "start: -1 does not fit"),
        ({"robots": (0,)}, r"critical\[2\]: robot 1 is not of this group"),
    ],
)
def test_a_steady_period_makes_sense(change: dict[str, Any], message: str) -> None:
    with pytest.raises(InputError, match=message):
        replace(counter_steady(), **change)


def test_ticks_may_come_from_arrays() -> None:
    group = replace(counter_steady(), start=Tick(int(np.int64(6))))
    assert told(group)["steady"][0]["start"] == 6


def test_an_excerpt_of_laps_has_no_faults_and_a_plan_of_whole_laps_has() -> None:
    """R2 of the second door of the paper never gets the right of way: it is stuck, not faulty."""
    trips = [("N0", "N6"), ("N2", "N8")]
    scenario = grid_fleet(["...", "@.@", "..."], trips, speeds=[Fraction(1, 2), Fraction(1, 3)])
    plan, steady = make_excerpt(run_laps(scenario, "fixed-order", routes="shortest"))
    assert make_payload(plan, steady=steady)["faults"]["count"] == 0
    whole = replace(plan, run=replace(plan.run, status=Status("whole laps")))
    payload = make_payload(whole, steady=steady)
    [(kind, count)] = payload["faults"]["kinds"]
    assert (template_in(payload, kind), count) == ("stop missed: name", 1)


@pytest.mark.parametrize("robot", [0, 1])
def test_a_page_of_laps_lists_the_faults_of_its_laps(robot: int) -> None:
    """A robot that never waits drives through the other one, in some lap."""
    trips = [("N0", "N6"), ("N2", "N8")]
    scenario = grid_fleet(["...", "@.@", "..."], trips, speeds=[Fraction(1, 2), Fraction(1, 3)])
    plan, steady = make_excerpt(run_laps(scenario, "first-come"))
    assert make_payload(plan, steady=steady)["faults"]["count"] == 0
    tracks = list(plan.tracks)
    route = run_laps(scenario, "first-come").groups[0].context.routes[robot]
    enter = route.compute_undelayed(range(len(tracks[robot])))
    tracks[robot] = replace(tracks[robot], enter=enter)
    broken = make_payload(replace(plan, tracks=tuple(tracks)), steady=steady)["faults"]
    ends = min(int(track.enter[-1]) for track in tracks)
    assert broken["count"] == len(broken["listed"]) > 0
    assert max(fault["tick"] for fault in broken["listed"]) < ends
