"""Robots that others wrote: virtual AGVs of the npm package vda-5050-lib drive our plans.

It is an independent reading of the norm (2.0): it refuses orders that are not as it has them.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from rightofway.io import write_plan
from rightofway.model import Plan
from tests.builders.brokers import MOSQUITTO, Command, Mosquitto
from tests.builders.foreign import NODE, NOOP, PACKAGE, PICK, drive_laps, virtual_agvs
from tests.builders.observers import Observer
from tests.builders.plans import door
from tests.builders.warehouses import warehouse

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(MOSQUITTO is None, reason="mosquitto is not installed"),
    pytest.mark.skipif(NODE is None or not PACKAGE.exists(), reason="Node or vda-5050-lib missing"),
]


@pytest.mark.parametrize(
    ("plan", "work"), [(door(), PICK), (warehouse(20), NOOP)], ids=["door", "warehouse"]
)
def test_robots_of_others_drive_a_plan(plan: Plan, work: dict[str, Any], tmp_path: Path) -> None:
    """All come home with their work done, and nobody holds what another one has."""
    broker = Mosquitto(tmp_path)
    observer = Observer(broker.port, validates=False)  # what the others send is theirs
    try:
        with virtual_agvs(plan, broker.url, tmp_path, work):
            write_plan(plan, tmp_path / "plan.json")
            options = ("--broker", broker.url, "--identities", "robots.json")
            with Command(tmp_path, "drive", "plan.json", *options).running() as drive:
                assert drive.wait(240) == 0, drive.log
        assert len(observer.finished) == len(plan.scenario.robots)
        assert "is faulty" not in drive.log
        assert "reports" not in drive.log  # no order was refused
        observer.close()
    finally:
        broker.kill()


@pytest.mark.parametrize("kills", [0, 4])
def test_robots_of_others_make_laps(kills: int, tmp_path: Path) -> None:
    """Some minutes of robot time; `just foreign-laps 30` makes half an hour of it.

    Who is not there when something is finished does not see it: an observer of which the broker
    was killed.
    """
    finished = drive_laps(door(), 12, tmp_path, kills=kills)
    assert len(finished) >= 2 * 12 * (0.5 if kills else 1)
