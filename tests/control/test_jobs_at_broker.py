"""Jobs that arrive while processes drive robots at a real broker; the control is killed."""

from __future__ import annotations

from pathlib import Path

import pytest

from rightofway.io import write_plan
from tests.builders.brokers import MOSQUITTO, Command, Mosquitto, wait_for
from tests.builders.floor_jobs import count_finished, floor_plan, read_pool

pytestmark = pytest.mark.slow

PATIENCE = 90
"""Seconds in which a run ends that takes some five of them."""


@pytest.mark.skipif(MOSQUITTO is None, reason="mosquitto is not installed")
def test_jobs_that_arrive_are_done_once_though_the_control_is_killed(tmp_path: Path) -> None:
    """A round is planned in a process; robots answer, and the control answers them, meanwhile."""
    broker, plan = Mosquitto(tmp_path), tmp_path / "plan.json"
    write_plan(floor_plan(), plan)
    simulated = ("robots", "plan.json", "--broker", broker.url, "--time-scale", "5")
    options = ("--broker", broker.url, "--identities", "robots.yaml", "--stay")
    journal = tmp_path / "plan.journal"
    with Command(tmp_path, *simulated, "--write-identities", "robots.yaml").running():
        wait_for((tmp_path / "robots.yaml").exists, 60, "the file of identities")
        with Command(tmp_path, "drive", "plan.json", *options).running() as drive:
            wait_for(lambda: "sets out" in drive.log, PATIENCE, "robots")
            for name in ("A1", "A1", "A2"):
                add = ("jobs", "plan.journal", "add", name, "--from", "N12", "--to", "N0")
                with Command(tmp_path, *add).running() as command:
                    assert command.wait(60) == 0, command.log
            drive.kill()
        with Command(tmp_path, "drive", "plan.json", *options).running() as drive:
            wait_for(
                lambda: len(read_pool(journal)) == 5 or drive.code is not None,
                PATIENCE,
                "the ends of jobs",
            )
            assert drive.code is None, drive.log
    assert dict.fromkeys(read_pool(journal).values()) == {"done": None}
    assert {*count_finished(journal).values()} == {1}
    assert len(count_finished(journal)) == 9
    broker.kill()
