"""Triggers of rounds: each alone, and those that a simulated shift finds in its forecast."""

from __future__ import annotations

from typing import Any

import pytest

from rightofway.dispatch import ShiftRecord
from rightofway.dispatch.triggers import Outlook, Situation, list_triggers
from rightofway.facts import Fact
from tests.builders.shifts import hold_shift, make_scenario

TRIGGERS: list[tuple[dict[str, Any], dict[str, Any], Fact]] = [
    ({"counts": {"job known": 2}}, {"counts": {"job known": 5}}, Fact("jobs became known", jobs=3)),
    ({}, {"counts": {"job changed": 1}}, Fact("jobs changed", jobs=1)),
    ({}, {"counts": {"job withdrawn": 1}}, Fact("jobs were withdrawn", jobs=1)),
    ({}, {"waiting": {"J1"}, "free": {2, 1}}, Fact("robots are free", robots=(1, 2))),
    ({}, {"ending": {3}}, Fact("routes end", robots=(3,))),
    ({"unable": {1}}, {"unable": {1, 2}}, Fact("robots stop", robots=(2,))),
    ({"unable": {1, 2}}, {"unable": {1}}, Fact("robots are back", robots=(2,))),
    ({"closed": {"A", "B"}}, {"closed": {"A"}}, Fact("closures change", closures=1)),
]

AHEAD: list[tuple[dict[str, Any], dict[str, Any], Fact]] = [
    ({}, {"too_late": {"J1"}}, Fact("too late ahead", jobs=("J1",))),
    ({"short": {1}}, {"short": {1, 2}}, Fact("below reserve ahead", robots=(2,))),
    ({}, {"shut_out": {1}}, Fact("shut out ahead", robots=(1,))),
    (
        {"planned": 100, "expected": 102},
        {"planned": 100, "expected": 107},
        Fact("fallen behind", expected=107, planned=100),
    ),
]


def freeze(values: dict[str, Any]) -> dict[str, Any]:
    return {key: frozenset(own) if isinstance(own, set) else own for key, own in values.items()}


def make_situation(values: dict[str, Any]) -> Situation:
    return Situation(**freeze(values))


def look_ahead(values: dict[str, Any]) -> Situation:
    return Situation(outlook=Outlook(**freeze(values)))


@pytest.mark.parametrize(("before", "now", "trigger"), TRIGGERS)
def test_a_change_begins_a_round(
    before: dict[str, Any], now: dict[str, Any], trigger: Fact
) -> None:
    assert list(list_triggers(make_situation(before), make_situation(now))) == [trigger]


@pytest.mark.parametrize(("before", "now", "trigger"), AHEAD)
def test_a_worse_forecast_begins_a_round(
    before: dict[str, Any], now: dict[str, Any], trigger: Fact
) -> None:
    assert list(list_triggers(look_ahead(before), look_ahead(now))) == [trigger]


def test_nothing_begins_a_round_while_nothing_changes() -> None:
    situations = [
        *(make_situation(now) for _, now, _ in TRIGGERS if "ending" not in now),
        *(look_ahead(now) for _, now, _ in AHEAD),
    ]
    for situation in situations:
        assert list(list_triggers(situation, situation)) == []


def test_a_fleet_has_fallen_behind_from_a_twentieth_of_its_plan() -> None:
    base = {"planned": 100, "expected": 100}
    late = look_ahead(base | {"expected": 104})
    assert list(list_triggers(look_ahead(base), late)) == []


def test_waiting_jobs_begin_no_round_while_all_robots_have_tours() -> None:
    assert list(list_triggers(Situation(), make_situation({"waiting": {"J1"}}))) == []


def test_the_first_round_begins_in_any_case() -> None:
    assert list(list_triggers(None, Situation())) == [Fact("dispatch begins")]


def list_reasons(record: ShiftRecord) -> list[tuple[int, str]]:
    """Return when each round began, with the kinds of its reasons."""
    return [(own.begin, fact.kind) for own in record.rounds for fact in own.reasons]


def test_a_round_begins_when_a_closure_begins_and_when_it_ends() -> None:
    scenario = make_scenario(
        ["....."], {"R1": "N0"}, jobs=[{"name": "J1", "at": "N1", "earliest": 40}],
        closures=[{"at": "N4", "from": 5, "until": 20}],
    )  # fmt: skip
    assert list_reasons(hold_shift(scenario)) == [
        (0, "dispatch begins"),
        (5, "closures change"),
        (20, "closures change"),
        (40, "jobs became known"),
    ]


def test_a_round_begins_when_the_fleet_has_fallen_behind_its_plan() -> None:
    # R1 should be at N20 at tick 20, and at N2 at tick 2. At tick 3 it is overdue, and expected at
    # N2 at tick 5: a twentieth of its plan is lost.
    scenario = make_scenario(
        ["." * 21], {"R1": "N0"}, jobs=[{"name": "J1", "at": "N20"}], rules={"return": "none"}
    )
    assert list_reasons(hold_shift(scenario)) == [(0, "dispatch begins")]
    late = hold_shift(scenario, delays="stop:R1@1+5")
    assert list_reasons(late)[:2] == [(0, "dispatch begins"), (3, "fallen behind")]


def test_a_round_begins_when_a_job_would_miss_its_end() -> None:
    # R1 should be at N4 at tick 4. At tick 3 it is expected there at tick 7. R2 ends J2 at tick 3
    # and can be there at tick 6.
    jobs = [{"name": "J1", "at": "N4", "latest": 6}, {"name": "J2", "at": "N7", "work": 2}]
    scenario = make_scenario(["." * 9], {"R1": "N0", "R2": "N8"}, jobs=jobs)
    late = hold_shift(scenario, delays="stop:R1@1+9")
    kinds = [kind for _, kind in list_reasons(late)]
    assert "too late ahead" in kinds
    assert late.jobs["J1"].robot == 1


def test_a_round_begins_when_a_battery_would_fall_below_its_reserve() -> None:
    # Eight drives take 40 %, and a tick on the way 2 %: in time R1 comes home with 44 %.
    batteries = {"tank": {"drive": "1/20", "on": "1/50", "charge": "1/5", "reserve": "1/10"}}
    scenario = make_scenario(
        ["....."], {"R1": {"home": "N0", "battery": "tank"}}, batteries=batteries,
        charging=["N0"], jobs=[{"name": "J1", "at": "N4"}],
    )  # fmt: skip
    late = hold_shift(scenario, delays="stop:R1@1+30")
    assert "below reserve ahead" in [kind for _, kind in list_reasons(late)]
