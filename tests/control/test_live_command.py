"""The commands that serve the page of a fleet: of a demo, at a broker, of a journal."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any
from urllib.request import urlopen

import pytest

from rightofway.io import write_plan
from tests.builders.brokers import MOSQUITTO, Command, Mosquitto, wait_for
from tests.builders.pages import DOCS, blocks
from tests.builders.plans import door

pytestmark = pytest.mark.slow


def address_of(command: Command) -> str:
    """Return where a command serves its page."""
    wait_for(lambda: "watch it: " in command.log or command.code is not None, 60, "the page")
    found = re.search(r"watch it: (\S+)", command.log)
    assert found, command.log
    return found[1]


def frames_of(address: str, count: int) -> list[dict[str, Any]]:
    """Return the first frames of a page."""
    frames: list[dict[str, Any]] = []
    with urlopen(f"{address}drives/0/stream", timeout=30) as stream:  # noqa: S310 (this machine)
        for line in stream:
            if line.startswith(b"data: "):
                frames.append(json.loads(line.removeprefix(b"data: ")))
            if len(frames) == count:
                break
    return frames


def test_a_demo_is_watched_until_an_interrupt(tmp_path: Path) -> None:
    """By the command of the page *The live page*."""
    write_plan(door(), tmp_path / "plan.json")
    (block,) = [one for one in blocks(DOCS / "live.md") if one.info == ("sh", "live")]
    _, name, *arguments = block.text.split()
    with Command(tmp_path, name, *arguments, "--time-scale", "4").running() as drive:
        address = address_of(drive)
        assert address.startswith("http://127.0.0.1:")
        with urlopen(address, timeout=30) as page:  # noqa: S310 (this machine)
            assert b"<title>plan.json: 2 robots</title>" in page.read()
        first, *later = frames_of(address, 3)
        assert first["begins"]
        assert first["rows"]
        assert not any(frame["begins"] for frame in later)
        wait_for(lambda: "the page stays until Ctrl-C" in drive.log, 60, "the end of the demo")
        (whole,) = frames_of(address, 1)
        assert (whole["runs"], whole["now"]) == (False, 12)
        assert drive.interrupt() == 0
    assert "makespan  12 time units" in drive.log


def test_robots_at_a_broker_are_watched_also_from_another_process(tmp_path: Path) -> None:
    """A second of the journal is one of the plan: the clock of both pages goes on by itself."""
    if MOSQUITTO is None:
        pytest.skip("mosquitto is not installed")
    broker = Mosquitto(tmp_path)
    write_plan(door(), tmp_path / "plan.json")
    at = ("--broker", broker.url)
    with (
        Command(
            tmp_path, "robots", "plan.json", *at,
            "--write-identities", "robots.yaml", "--time-scale", "1",
        ).running(),
    ):  # fmt: skip
        wait_for((tmp_path / "robots.yaml").exists, 60, "the file of identities")
        known = ("--identities", "robots.yaml")
        with Command(tmp_path, "drive", "plan.json", *at, *known, "--live").running() as drive:
            live = address_of(drive)
            (tmp_path / "other").mkdir()
            write_plan(door(), tmp_path / "other" / "plan.json")
            replay = Command(
                tmp_path / "other", "drive", "plan.json",
                "--replay", "--journal", str(tmp_path / "plan.journal"),
            )  # fmt: skip
            with replay.running():
                for address in (live, address_of(replay)):
                    first, *_, last = frames_of(address, 5)
                    assert first["runs"]
                    assert last["now"] > first["now"]
                    names = {row[2] for row in first["rows"]}
                    assert {"route", "arrived", "says"} <= names
    broker.kill()


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (("--dry-run", "--live"), "--live goes with --broker and --demo"),
        (("--replay",), "cannot be read as a journal"),
        (("--demo", "--replay"), "give one of --broker, --demo, --dry-run, --replay and --report"),
    ],
)
def test_what_does_not_go_together_is_refused(
    tmp_path: Path, options: tuple[str, ...], message: str
) -> None:
    write_plan(door(), tmp_path / "plan.json")
    with Command(tmp_path, "drive", "plan.json", *options).running() as drive:
        assert drive.wait(60) == 2
    assert message in drive.log
