"""Robots of another project: virtual AGVs of the npm package vda-5050-lib, and runs with them."""

from __future__ import annotations

import json
import random
import shutil
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import Any

from rightofway.control.identities import IDENTITIES_FORMAT, load_identities
from rightofway.control.order_map import OrderMap
from rightofway.io import write_plan
from rightofway.model import Plan
from tests.builders.brokers import Command, Mosquitto, wait_for
from tests.builders.observers import Observer
from tests.builders.pages import ROOT

__all__ = ["NODE", "NOOP", "PACKAGE", "PICK", "drive_laps", "virtual_agvs"]

NODE = shutil.which("node")
PACKAGE = ROOT / "node_modules/vda-5050-lib"

PICK = {"action": "pick", "parameters": {"stationType": "floor", "loadType": "EPAL", "duration": 1}}
NOOP = {"action": "noop", "parameters": {"duration": 1}}

FASTER = 10
"""Seconds of robot time in a second."""


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
        place = OrderMap(plan.scenario, number, identity).get_place(home)
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
    fleet = {"broker": url, "timeLapse": FASTER, "robots": robots}
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


def _has_heard(observer: Observer, states: int) -> bool:
    """Return whether enough states have come."""
    return observer.counts["state"] >= states


def drive_laps(plan: Plan, laps: int, folder: Path, *, kills: int, seed: int = 1) -> set[Any]:
    """Have virtual AGVs make laps, while control and broker are killed; return what was done.

    Parameters
    ----------
    plan
        A plan of robots that return home.
    laps
        How many each robot makes.
    folder
        For the files of the run.
    kills
        How often control or broker is killed: of four kills one is of the broker.
    seed
        Of the moments.

    Raises
    ------
    AssertionError
        If two robots hold one place, an order has two contents, a robot is faulty or refuses an
        order, or the laps do not end.
    """
    draw = random.Random(seed)  # noqa: S311
    broker = Mosquitto(folder)
    observer = Observer(broker.port, validates=False)  # what the others send is theirs
    try:
        with virtual_agvs(plan, broker.url, folder, NOOP):
            write_plan(plan, folder / "plan.json")
            options = ("--broker", broker.url, "--identities", "robots.json", "--laps", str(laps))
            with Command(folder, "drive", "plan.json", *options).running() as drive:
                for number in range(kills):
                    due = observer.counts["state"] + draw.randrange(20, 200)
                    wait_for(partial(_has_heard, observer, due), 120, "states")
                    assert drive.code is None, "the laps ended before all kills"
                    if number % 4 == 3:
                        broker.kill()
                        broker.start()
                    else:
                        drive.kill()
                        drive.start()
                longest = plan.scenario.problem.clock.convert_to_time(max(plan.completions)) * laps
                assert drive.wait(120 + 3 * float(longest) / FASTER) == 0, drive.log[-3000:]
        assert "is faulty" not in drive.log, drive.log[-3000:]
        observer.close()
        return observer.finished
    finally:
        broker.kill()
