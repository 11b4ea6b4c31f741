"""Robots that others wrote: virtual AGVs of the npm package vda-5050-lib drive our plans.

It is an independent reading of the norm (2.0): it refuses orders that are not as it has them.
"""

from __future__ import annotations

import json
import shutil
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from rightofway.control.identities import IDENTITIES_FORMAT, load_identities
from rightofway.control.order_map import OrderMap
from rightofway.io import write_plan
from rightofway.model import Plan
from tests.builders.brokers import MOSQUITTO, Command, Mosquitto, wait_for
from tests.builders.observers import Observer
from tests.builders.pages import ROOT
from tests.builders.plans import door
from tests.builders.warehouses import warehouse

NODE = shutil.which("node")
PACKAGE = ROOT / "node_modules/vda-5050-lib"

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(MOSQUITTO is None, reason="mosquitto is not installed"),
    pytest.mark.skipif(NODE is None or not PACKAGE.exists(), reason="Node or vda-5050-lib missing"),
]

PICK = {"action": "pick", "parameters": {"stationType": "floor", "loadType": "EPAL", "duration": 1}}
NOOP = {"action": "noop", "parameters": {"duration": 1}}


@contextmanager
def virtual_agvs(plan: Plan, url: str, folder: Path, work: dict[str, Any]) -> Iterator[None]:
    """Run the robots of a plan, ten times as fast as real ones, with a file of identities."""
    assert NODE is not None
    names = [robot.name for robot in plan.scenario.robots]
    document = {
        "format": IDENTITIES_FORMAT,
        "manufacturer": "ACME",
        "version": "2.0.0",
        "work": work,
        "repeats_work": False,
        "robots": {name: {"serial": f"agv{number}"} for number, name in enumerate(names)},
    }
    identities = folder / "robots.json"
    identities.write_text(json.dumps(document), encoding="utf-8")
    robots = []
    for number, identity in enumerate(load_identities(identities, names)):
        home = plan.scenario.roadmap.name(plan.scenario.robots[number].home)
        place = OrderMap(plan.scenario, number, identity).place(home)
        assert place is not None
        x, y = place.point
        robots.append(
            {
                "manufacturer": identity.manufacturer,
                "serialNumber": identity.serial_number,
                "place": home,
                "x": x,
                "y": y,
            }
        )
    fleet = {"broker": url, "timeLapse": 10, "robots": robots}
    log = folder / "agvs.log"
    with log.open("wb") as said:
        process = subprocess.Popen(
            [NODE, str(ROOT / "tests/js/virtual_agvs.js"), json.dumps(fleet)],
            cwd=ROOT,
            stdout=said,
            stderr=said,
        )
    try:
        wait_for(lambda: "up" in log.read_text(encoding="utf-8"), 60, "virtual AGVs")
        yield
    finally:
        process.kill()
        process.wait()


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
