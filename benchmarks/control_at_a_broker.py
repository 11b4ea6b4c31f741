"""How long a control takes to answer, and how much of a processor, with many robots at a broker.

Robots are simulated in a process of their own and send a state each second, and with each event.
An answer is counted from the arrival of a message to the end of the turn that has sent, with its
commit on the disk, what follows from it.
"""

from __future__ import annotations

import argparse
import asyncio
import contextlib
import gc
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterable, Sequence
from pathlib import Path

import numpy as np

from rightofway.control.broker import Broker
from rightofway.control.driver import Driver
from rightofway.control.endpoints import Letter
from rightofway.control.identities import make_simulated_identities
from rightofway.control.journal import SqliteJournal
from rightofway.control.metrics import FleetMetrics
from rightofway.io import write_plan
from tests.builders.brokers import Command, Mosquitto, wait_for
from tests.builders.warehouses import warehouse


class _Raw(FleetMetrics):
    """Keeps each answer beside the histogram."""

    def __init__(self, names: Sequence[str]) -> None:
        super().__init__(names)
        self.answers: list[float] = []
        self.releases: list[float] = []  # of turns that have sent an order
        self.counts = Counter[str]()

    def turn(
        self,
        received: Iterable[tuple[float, Letter]],
        sent: Iterable[Letter],
        waits: Sequence[int],
    ) -> None:
        """Take in a turn."""
        now, came, sent = time.perf_counter(), list(received), list(sent)
        took = [now - at for at, _ in came]
        self.answers += took
        if any(letter.name == "order" for letter in sent):
            self.releases += took
        self.counts.update(letter.name for _, letter in came)
        self.counts.update(letter.name for letter in sent)
        self.counts["turns"] += 1
        super().turn(came, sent, waits)


def main() -> None:
    """Measure, and print a line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--robots", type=int, default=200)
    parser.add_argument("--seconds", type=float, default=60)
    given = parser.parse_args()
    plan = warehouse(given.robots)
    names = [robot.name for robot in plan.scenario.robots]
    metrics, identities = _Raw(names), make_simulated_identities(names)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        write_plan(plan, folder / "plan.json")
        broker = Mosquitto(folder)
        options = ("--broker", broker.url, "--write-identities", "robots.yaml")
        with Command(folder, "robots", "plan.json", *options).running():
            wait_for((folder / "robots.yaml").exists, 120, "robots")
            journal = SqliteJournal(folder / "plan.journal")
            driver = Driver(plan, identities, journal, report=lambda _: None, metrics=metrics)
            began, cpu = time.perf_counter(), time.process_time()

            async def drive() -> None:
                with contextlib.suppress(TimeoutError):
                    async with asyncio.timeout(given.seconds):
                        await driver.run(Broker.of(broker.url))

            gc.freeze()  # as the command does
            asyncio.run(drive())
            share = (time.process_time() - cpu) / (time.perf_counter() - began)
        broker.kill()
    for what, took in (("answers", metrics.answers), ("with a release", metrics.releases)):
        median, last = (1000 * np.percentile(took, share_) for share_ in (50, 99))
        sys.stdout.write(
            f"{len(took)} {what}: median {median:.1f} ms, 99th percentile {last:.1f} ms\n"
        )
    sys.stdout.write(f"{100 * share:.0f}% of a processor; {dict(metrics.counts)}\n")


if __name__ == "__main__":
    main()
