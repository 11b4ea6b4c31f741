"""Probes of robots at a real broker: simulated ones, and those of another project."""

from __future__ import annotations

import asyncio
import json
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from rightofway.control.broker import Broker
from rightofway.control.identities import VERSIONS, make_simulated_identities
from rightofway.control.plan_fit import PlanFit
from rightofway.control.probe import Probe
from rightofway.execution.probe_result import ProbeResult
from rightofway.facts import Fact
from rightofway.io import write_plan
from tests.builders.brokers import MOSQUITTO, Command, Mosquitto, wait_for
from tests.builders.foreign import NODE, NOOP, PACKAGE, virtual_agvs
from tests.builders.pages import DOCS, blocks
from tests.builders.plans import door

CHECKLIST = DOCS / "first-agv.md"

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(MOSQUITTO is None, reason="mosquitto is not installed"),
]


@pytest.fixture
def broker(tmp_path: Path) -> Iterator[Mosquitto]:
    made = Mosquitto(tmp_path)
    yield made
    made.kill()


def probe(broker: Mosquitto, manufacturer: str, serial: str, **options: Any) -> ProbeResult:
    """Return the result of a probe that may send orders."""
    talk = Probe(manufacturer, serial, ask=lambda _: True, **options)
    return asyncio.run(talk.run(Broker.of(broker.url)))


def list_kinds(result: ProbeResult, step: str) -> list[str]:
    """Return the kinds of the findings of a step."""
    return [finding.fact.kind for finding in result.findings if finding.step == step]


@pytest.mark.parametrize("version", VERSIONS)
def test_a_simulated_robot_takes_the_orders_of_a_probe(
    version: str, tmp_path: Path, broker: Mosquitto
) -> None:
    """It has no departure: it also reports that it refuses an update that does not fit."""
    write_plan(door(), tmp_path / "plan.json")
    options = ("--broker", broker.url, "--vda-version", version)
    with Command(tmp_path, "robots", "plan.json", *options).running() as robots:
        wait_for(lambda: "2 robots are at" in robots.log, 60, "robots")
        result = probe(broker, "rightofway", "robot0")
    assert result.version == version
    assert result.count("blocks") == 0
    assert [it.fact for it in result.findings if it.verdict == "departs"] == []
    refused = Fact("wrong update refused", error="orderUpdateError")
    assert refused in [it.fact for it in result.findings]
    for step in ("order", "update", "next order"):
        assert list_kinds(result, step)[0] == "order taken"
    assert list_kinds(result, "cancel") == ["cancel ended"]


@pytest.mark.skipif(NODE is None or not PACKAGE.exists(), reason="Node or vda-5050-lib missing")
def test_a_robot_of_others_is_probed(tmp_path: Path, broker: Mosquitto) -> None:
    """Virtual AGVs of vda-5050-lib refuse a wrong update, and leave out the end of a withdrawal."""
    with virtual_agvs(door(), broker.url, tmp_path, NOOP):
        result = probe(broker, "ACME", "agv0", answer=3)
    assert (result.version, result.interface, result.map_id) == ("2.0.0", "uagv", "map")
    assert list_kinds(result, "update") == [
        "order taken", "repeated update ignored", "wrong update refused",
    ]  # fmt: skip
    assert list_kinds(result, "cancel") == ["cancel without end", "error reported"]


def test_the_probe_of_a_silent_robot_names_the_others(tmp_path: Path, broker: Mosquitto) -> None:
    write_plan(door(), tmp_path / "plan.json")
    options = ("--broker", broker.url)
    with Command(tmp_path, "robots", "plan.json", *options).running() as robots:
        wait_for(lambda: "2 robots are at" in robots.log, 60, "robots")
        [found] = probe(broker, "rightofway", "robot7", silence=1).findings
    assert found.fact.kind == "nothing heard"
    names = ("rightofway/robot0", "rightofway/robot1")
    assert found.fact.values["others"].values["names"] == names
    assert "rightofway/robot0, rightofway/robot1" in str(found.fact)


def test_the_end_of_an_old_connection_decides_only_if_nothing_else_comes(
    tmp_path: Path, broker: Mosquitto
) -> None:
    """The broker keeps the last will of a robot that has changed its version."""
    write_plan(door(), tmp_path / "plan.json")
    for version in ("3.0.0", "2.1.0"):
        options = ("--broker", broker.url, "--vda-version", version)
        with Command(tmp_path, "robots", "plan.json", *options).running() as robots:
            wait_for(lambda: "2 robots are at" in robots.log, 60, "robots")
            if version == "2.1.0":
                result = probe(broker, "rightofway", "robot0", settle=0.5)
        robots.said.unlink()
    assert result.version == "2.1.0"
    assert list_kinds(result, "topics") == ["further topics"]
    result = probe(broker, "rightofway", "robot0", silence=1)
    assert list_kinds(result, "connection") == ["connection reported"]
    assert result.count("blocks") == 1


def run_command(
    broker: Mosquitto, *options: str, said: str = ""
) -> subprocess.CompletedProcess[str]:
    """Run the command on the first simulated robot."""
    identity = ("--identity", "rightofway/robot0")
    line = [
        sys.executable,
        "-m",
        "rightofway",
        "probe",
        "--broker",
        broker.url,
        *identity,
        *options,
    ]
    return subprocess.run(line, input=said, capture_output=True, text=True, timeout=90, check=False)


def test_the_command_asks_before_it_sends_an_order(tmp_path: Path, broker: Mosquitto) -> None:
    write_plan(door(), tmp_path / "plan.json")
    with Command(tmp_path, "robots", "plan.json", "--broker", broker.url).running() as robots:
        wait_for(lambda: "2 robots are at" in robots.log, 60, "robots")
        refused = run_command(broker, said="n\n")
        assert "Send orders of the node N0 alone" in refused.stderr
        assert refused.returncode == 0
        assert "no order was sent" in refused.stdout
        assert max(map(len, refused.stdout.splitlines())) <= 80
        given = run_command(broker, "--order", "N0", "--json")
    assert "Send orders" not in given.stderr
    answer = json.loads(given.stdout)
    assert given.returncode == 0
    assert (answer["departures"], answer["blocking"]) == (0, 0)
    assert answer["findings"][0] == {
        "step": "connection",
        "verdict": "ok",
        "kind": "connection reported",
        "values": {"state": "ONLINE"},
    }


def test_a_broker_that_is_not_there_is_named(broker: Mosquitto) -> None:
    broker.kill()
    answer = run_command(broker)
    assert answer.returncode == 2
    assert "cannot be reached" in answer.stderr


def read_lines(name: str, url: str) -> list[str]:
    """Return the commands of a block of the checklist, at another broker."""
    [block] = [one for one in blocks(CHECKLIST) if one.info == ("sh", name)]
    return [line.replace("mqtt://localhost", url) for line in block.text.splitlines()]


def follow(folder: Path, line: str, said: str = "") -> subprocess.CompletedProcess[str]:
    """Run a command of the page to its end."""
    words = [sys.executable, "-m", *line.split()]
    options: Any = {"capture_output": True, "text": True, "timeout": 90}
    return subprocess.run(words, input=said, cwd=folder, check=False, **options)


def test_the_checklist_is_followed_word_for_word(tmp_path: Path, broker: Mosquitto) -> None:
    """All but mosquitto itself; `test_examples` runs the blocks that need no broker."""
    for block in blocks(CHECKLIST):
        if block.file_name is not None:
            (tmp_path / block.file_name).write_text(block.text, encoding="utf-8")
    assert follow(tmp_path, "rightofway plan site.yaml -o site.json").returncode == 0
    _, robots = (line.split()[1:] for line in read_lines("rehearsal", broker.url))
    with Command(tmp_path, *robots).running() as running:
        wait_for(lambda: "2 robots are at" in running.log, 60, "robots")
        for name in ("probe", "fit"):
            [line] = read_lines(name, broker.url)
            answer = follow(tmp_path, line, said="y\n")
            assert "0 findings block the control" in answer.stdout, answer.stdout + answer.stderr
            if name == "fit":
                assert "the plan begins at Home" in answer.stdout
                assert "orders name 4 nodes: Home, Gate, Rack and Dock" in answer.stdout
                assert "the braking distance of" in answer.stdout
        drive, go_one, hold, go = read_lines("drive", broker.url)
        with Command(tmp_path, *drive.split()[1:]).running() as driving:
            wait_for(lambda: "all robots: on hold" in driving.log, 60, "the hold")
            for line in (go_one, hold, go):
                assert follow(tmp_path, line).returncode == 0
            wait_for(lambda: "A2 sets out from Park" in driving.log, 60, "the first drive")
            assert "A1 sets out" not in driving.log.partition("A2: released")[0]


@pytest.mark.parametrize(
    ("look_ahead", "parts", "kind"),
    [(1, 1.0, "brakes before end"), (2, 2.0, "base longer than braking")],
)
def test_the_base_of_a_longer_look_ahead_is_longer_than_the_braking_distance(
    look_ahead: int, parts: float, kind: str
) -> None:
    """At 1 m/s and 1/3 m/s², the braking distance is 1.5 m; each edge has 1 m."""
    names = [robot.name for robot in door().scenario.robots]
    fleet = make_simulated_identities(names)
    fit = PlanFit(plan=door(), identities=fleet, robot=1, look_ahead=look_ahead)
    sheet = {"physicalParameters": {"decelerationMax": 1 / 3}}
    found = {it.fact.kind: it.fact.values for it in fit.compare({}, sheet)}
    assert (found["length of base"]["parts"], found["length of base"]["least"]) == (
        look_ahead,
        parts,
    )
    assert kind in found


def test_a_robot_that_is_not_at_its_home_is_a_finding(tmp_path: Path, broker: Mosquitto) -> None:
    """The fit is against the second robot, which begins at N2; the first one is at N0."""
    write_plan(door(), tmp_path / "plan.json")
    names = [robot.name for robot in door().scenario.robots]
    fit = PlanFit(plan=door(), identities=make_simulated_identities(names), robot=1)
    options = ("--broker", broker.url)
    with Command(tmp_path, "robots", "plan.json", *options).running() as robots:
        wait_for(lambda: "2 robots are at" in robots.log, 60, "robots")
        result = probe(broker, "rightofway", "robot0", fit=fit, settle=0.5)
    [found] = [it for it in result.findings if it.verdict == "blocks"]
    assert (found.step, found.fact) == ("plan", Fact("not at home", node="N0", home="N2"))
    assert list_kinds(result, "plan") == [
        "not at home", "fits into plan", "nodes to know", "length of base",
        "base longer than braking", "actions of plan", "actions of plan not listed",
    ]  # fmt: skip
