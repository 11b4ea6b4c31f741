"""Campaigns run, and say what they found."""

from __future__ import annotations

import re
import subprocess
import sys

import pytest

from rightofway import FleetBuilder
from rightofway.model import Proof, Tick
from tests.builders.brokers import MOSQUITTO
from tests.campaigns import plans


def said_by(*words: str) -> str:
    """Return what a campaign prints when it is over."""
    command = [sys.executable, "-m", *words]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


@pytest.mark.parametrize(
    ("campaign", "count"), [("judge", 2000), ("delay", 20000), ("chaos", 200), ("bound", 200)]
)
def test_plans_are_judged_by_the_hundred(campaign: str, count: int, law_seed: int) -> None:
    """Laws hold the same in this lane; `just nightly` makes a hundred times as many."""
    said = said_by("tests.campaigns.plans", campaign, str(count), "--seed", str(law_seed))
    last = said.splitlines()[-1]
    judged = re.match(rf"{campaign}: (\d+) judged, 0 findings", last)
    assert judged, last
    assert int(judged[1]) >= count


def test_a_bound_above_a_plan_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    """One tick more than is true on a line, where plans cost what the robot needs alone."""
    fleet = FleetBuilder(grid=["..."], rules="classic")
    fleet.add_robot("R1", home=[0, 0], target=[0, 2])
    into = plans.Round()
    plans.bound(fleet.build_scenario(), 0, into)
    assert into.findings == []
    false = (Proof(bound=Tick(3)), True)
    monkeypatch.setattr(plans, "prove_bound", lambda *_, **__: false)
    plans.bound(fleet.build_scenario(), 0, into)
    found = [what for what, *_ in into.findings]
    assert found == [f"bound proves 3, but {planner} has 2" for planner, _ in plans.PROVERS]


def test_a_studio_that_is_killed_loses_nothing(law_seed: int) -> None:
    said = said_by("tests.campaigns.kills", "6", "--seed", str(law_seed))
    assert re.search(r"\b6 kills\b.*; nothing lost, nothing in parts; \d+ s$", said), said


@pytest.mark.skipif(MOSQUITTO is None, reason="mosquitto is not installed")
@pytest.mark.parametrize("options", [(), ("--jobs",)])
def test_plans_are_driven_over_a_broker_that_is_killed(options: tuple[str, ...]) -> None:
    said = said_by("tests.campaigns.broker", "2", "--seed", "3", *options)
    assert re.search(r"^chaos-broker: 2 runs, 0 faults, \d+ s$", said, re.MULTILINE), said
