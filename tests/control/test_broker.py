"""Real processes at a real broker: they are killed, and nothing is lost or done twice."""

from __future__ import annotations

import asyncio
import contextlib
import json
import random
import re
import shutil
import signal
import subprocess
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import Any
from urllib.error import HTTPError
from urllib.request import urlopen

import aiomqtt
import pytest

from rightofway.control.broker import PASSWORD, Broker
from rightofway.control.driver import Driver
from rightofway.control.identities import (
    format_identities,
    load_identities,
    make_simulated_identities,
)
from rightofway.control.journal import JournalReader, SqliteJournal
from rightofway.control.robots import run_robots
from rightofway.errors import InputError
from rightofway.facts import Fact, read_fact
from rightofway.io import load_plan, write_plan
from rightofway.model import Plan
from tests.builders.brokers import MOSQUITTO, Command, Mosquitto, free_port, wait_for
from tests.builders.observers import Observer
from tests.builders.pages import ROOT, blocks
from tests.builders.plans import door
from tests.builders.warehouses import warehouse

pytestmark = pytest.mark.slow


@pytest.fixture
def broker(tmp_path: Path) -> Iterator[Mosquitto]:
    if MOSQUITTO is None:
        pytest.skip("mosquitto is not installed")
    made = Mosquitto(tmp_path)
    yield made
    made.kill()


def robots_of(
    plan: Plan, folder: Path, url: str, *options: str, **environment: str
) -> contextlib.AbstractContextManager[Command]:
    """Return simulated robots of a plan; they write their identities."""
    write_plan(plan, folder / "plan.json")
    more = ("--write-identities", "robots.yaml", "--time-scale", "20", *options)
    return Command(folder, "robots", "plan.json", "--broker", url, *more, **environment).running()


def has_heard(observer: Observer, states: int, drive: Command) -> bool:
    """Return whether enough states have come, or there is nothing to wait for."""
    return observer.counts["state"] >= states or drive.code is not None


def drive_of(
    folder: Path, url: str, **environment: str
) -> contextlib.AbstractContextManager[Command]:
    """Return the control of those robots."""
    wait_for((folder / "robots.yaml").exists, 60, "the file of identities")
    options = ("--broker", url, "--identities", "robots.yaml")
    return Command(folder, "drive", "plan.json", *options, **environment).running()


@pytest.mark.parametrize("version", ["2.0.0", "2.1.0", "3.0.0"])
def test_the_door_is_driven_by_three_commands(
    version: str, tmp_path: Path, broker: Mosquitto
) -> None:
    observer = Observer(broker.port)
    with (
        robots_of(door(), tmp_path, broker.url, "--vda-version", version),
        drive_of(tmp_path, broker.url) as drive,
    ):
        assert drive.wait(60) == 0, drive.log
    assert "R1 is at the end of its way, N0" in drive.log
    assert "all robots are at the end of their way" in drive.log
    assert len(observer.finished) == 2
    observer.close()


def test_the_end_of_a_run_is_reported_for_people_and_programs_and_as_a_page(
    tmp_path: Path, broker: Mosquitto
) -> None:
    """The report goes to standard output; robots have done a job each, and have come home."""
    with robots_of(door(), tmp_path, broker.url):
        wait_for((tmp_path / "robots.yaml").exists, 60, "the file of identities")
        options = ("plan.json", "--broker", broker.url, "--identities", "robots.yaml")
        with Command(
            tmp_path, "drive", *options, "--json", "--page", "x.html", "-q"
        ).running() as ran:
            assert ran.wait(60) == 0, ran.log
    data = json.loads(ran.log)
    assert (data["jobs"], data["tick"]) == (2, 1)
    assert [(robot["name"], robot["jobs"]) for robot in data["robots"]] == [("R1", 1), ("R2", 1)]
    assert [robot["planned"] for robot in data["robots"]] == [10, 9]
    assert all(robot["completion"] is not None for robot in data["robots"])
    assert {"order", "instantActions", "state"} <= set(data["messages"])
    assert (tmp_path / "x.html").stat().st_size > 10_000


@pytest.mark.parametrize("laps", [(), ("--laps", "inf")], ids=["once", "laps"])
@pytest.mark.parametrize(("number", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 0)])
def test_a_run_that_is_interrupted_is_reported_and_goes_on_at_the_next_start(
    number: int, code: int, laps: tuple[str, ...], tmp_path: Path, broker: Mosquitto
) -> None:
    with robots_of(door(), tmp_path, broker.url, "--time-scale", "4"):
        wait_for((tmp_path / "robots.yaml").exists, 60, "the file of identities")
        options = ("plan.json", "--broker", broker.url, "--identities", "robots.yaml", *laps)
        with Command(tmp_path, "drive", *options).running() as drive:
            wait_for(lambda: "R2 sets out" in drive.log, 60, "the first order")
            assert drive.interrupt(number) == code, drive.log
            words = "interrupted" if code else "drive to the end of their released nodes"
            report = drive.log.partition(f"{words}\n")[2]
            assert re.match(r"jobs +[01] done\n", report), drive.log
            assert "Traceback" not in drive.log
            drive.start()
            wait_for(lambda: drive.log.count("has done its work") >= 2, 60, "the work")


def test_a_run_without_a_connection_is_reported_when_it_is_terminated(tmp_path: Path) -> None:
    write_plan(door(), tmp_path / "plan.json")
    names = [robot.name for robot in door().scenario.robots]
    text = format_identities(names, make_simulated_identities(names))
    (tmp_path / "robots.yaml").write_text(text, encoding="utf-8")
    nowhere = f"mqtt://localhost:{free_port()}"
    options = ("plan.json", "--broker", nowhere, "--identities", "robots.yaml")
    with Command(tmp_path, "drive", *options).running() as drive:
        wait_for(lambda: "no connection to" in drive.log, 60, "a try to connect")
        assert drive.interrupt(signal.SIGTERM) == 0, drive.log
        assert "the control has ended" in drive.log
        assert re.search("ended +0 of 2 robots at the end of their way", drive.log)


def test_sigterm_ends_in_order_nothing_more_is_released_and_the_journal_is_whole(
    tmp_path: Path, broker: Mosquitto
) -> None:
    """The last line of the log is in the journal, and no order comes after it."""
    observer = Observer(broker.port)
    with robots_of(warehouse(20), tmp_path, broker.url, "--time-scale", "10"):
        wait_for((tmp_path / "robots.yaml").exists, 60, "the file of identities")
        options = ("plan.json", "--broker", broker.url, "--identities", "robots.yaml")
        with Command(tmp_path, "drive", *options).running() as drive:
            wait_for(lambda: drive.log.count("sets out") > 10, 60, "drives")
            assert drive.interrupt(signal.SIGTERM) == 0, drive.log
            states = observer.counts["state"]
            wait_for(lambda: observer.counts["state"] > states + 20, 60, "what was on its way")
            orders, states = set(observer.orders), observer.counts["state"]
            journal = JournalReader(tmp_path / "plan.journal")
            last = dict(journal.read_rows()[-1].entry)
            journal.close()
            assert str(read_fact(last["fact"])).startswith("the control has ended")
            wait_for(lambda: observer.counts["state"] > states + 60, 60, "states")
            assert set(observer.orders) == orders
            drive.start()
            wait_for(lambda: set(observer.orders) != orders, 60, "orders of the next start")
    observer.close()


def test_a_broker_asks_for_the_certificate_of_its_client(tmp_path: Path) -> None:
    """A certificate that signs itself is both: of the broker and of the client."""
    key, certificate = make_certificate(tmp_path)
    lines = ["require_certificate true", "use_identity_as_username true"]
    lines += [f"{name} {certificate}" for name in ("cafile", "certfile")] + [f"keyfile {key}"]
    server = Mosquitto(tmp_path, lines)
    try:
        url = f"mqtts://localhost:{server.port}"
        trust = {"ca_file": str(certificate)}
        own = {**trust, "cert_file": str(certificate), "key_file": str(key)}
        asyncio.run(connect(Broker.of(url, **own)))
        with pytest.raises(aiomqtt.MqttError):
            asyncio.run(connect(Broker.of(url, **trust)))
    finally:
        server.kill()


async def connect(broker: Broker) -> None:
    """Connect to a broker, and take the subscription for the proof."""
    async with broker.open_client("test") as client:
        await client.subscribe("nothing")


def test_the_log_has_levels_and_lines_for_programs(tmp_path: Path, broker: Mosquitto) -> None:
    with robots_of(door(), tmp_path, broker.url):
        wait_for((tmp_path / "robots.yaml").exists, 60, "the file of identities")
        options = ("plan.json", "--broker", broker.url, "--identities", "robots.yaml")
        form = ("--log", "json", "--log-level", "debug")
        with Command(tmp_path, "drive", *options, *form).running() as drive:
            assert drive.wait(60) == 0, drive.log
    lines = [json.loads(line) for line in drive.log.splitlines() if line.startswith("{")]
    assert {line["level"] for line in lines} == {"debug", "info"}
    [ended] = [line for line in lines if line.get("kind") == "all at end"]
    assert ended["text"] == "all robots are at the end of their way"
    waits = next(line for line in lines if line.get("kind") == "waits")
    assert (waits["level"], waits["values"]["robot"]) == ("info", "R1")
    sent = {line["topic"] for line in lines if line.get("direction") == "sent"}
    assert "uagv/v2/rightofway/robot0/order" in sent
    received = next(line for line in lines if line.get("direction") == "received")
    assert json.loads(received["message"])["manufacturer"] == "rightofway"


def test_at_the_level_warning_the_log_has_trouble_only(tmp_path: Path, broker: Mosquitto) -> None:
    with robots_of(door(), tmp_path, broker.url, "--trouble", "error:1"):
        wait_for((tmp_path / "robots.yaml").exists, 60, "the file of identities")
        options = ("plan.json", "--broker", broker.url, "--identities", "robots.yaml")
        with Command(tmp_path, "drive", *options, "--log-level", "warning").running() as drive:
            assert drive.wait(120) == 0, drive.log
    log = drive.log.partition("jobs  ")[0]
    assert "reports" in log
    assert "sets out" not in log
    assert "at the end of their way" not in log


def test_twenty_robots_in_a_warehouse_with_trouble(tmp_path: Path, broker: Mosquitto) -> None:
    """Late, stopped, in error, offline, without their orders: all come home, each job done once."""
    observer = Observer(broker.port)
    trouble = ("late:0.5", "stop:0.02", "error:0.02", "offline:0.02", "reset:0.01")
    options = [word for kind in trouble for word in ("--trouble", kind)]
    with (
        robots_of(warehouse(20), tmp_path, broker.url, *options),
        drive_of(tmp_path, broker.url) as drive,
    ):
        assert drive.wait(240) == 0, drive.log
    assert len(observer.finished) == 20
    assert "is not connected" in drive.log
    observer.close()


def test_control_and_broker_are_killed_and_everything_goes_on(
    tmp_path: Path, broker: Mosquitto
) -> None:
    observer = Observer(broker.port)
    draw = random.Random(1)  # noqa: S311
    with (
        robots_of(warehouse(8), tmp_path, broker.url, "--trouble", "late:0.5"),
        drive_of(tmp_path, broker.url) as drive,
    ):
        for number in range(6):
            due = observer.counts["state"] + draw.randrange(5, 60)
            wait_for(partial(has_heard, observer, due, drive), 60, "states")
            if drive.code is not None:
                break
            if number % 3 == 2:
                broker.kill()
                broker.start()
            else:
                drive.kill()
                drive.start()
        assert drive.wait(120) == 0, drive.log
    assert len(observer.finished) == 8
    runs = {order_id.rsplit("-", 2)[0] for _, order_id, _ in observer.orders}
    assert len(runs) == 1  # one journal, one run
    observer.close()


def test_withdrawals_over_the_broker_lose_nothing(tmp_path: Path, broker: Mosquitto) -> None:
    """Withdrawals come at any time, late ones too; robots get the rest again."""
    plan, said = warehouse(5), list[str]()
    names = [robot.name for robot in plan.scenario.robots]
    identities = make_simulated_identities(names)
    observer = Observer(broker.port)
    journal = SqliteJournal(tmp_path / "plan.journal")
    address = Broker.of(broker.url)
    draw = random.Random(2)  # noqa: S311

    def take_note(fact: Fact) -> None:
        """Withdraw an order at every third fact of the story."""
        said.append(str(fact))
        if len(said) % 3 == 0 and len(said) < 60:
            loop = asyncio.get_running_loop()
            name = draw.choice(names)
            loop.call_soon(lambda: driver.send(driver.operator.operate("cancel", name)))

    driver = Driver(plan, identities, journal, report=take_note)

    async def everything() -> None:
        robots = asyncio.create_task(run_robots(plan, identities, address, time_scale=10))
        async with asyncio.timeout(120):
            await driver.run(address)
        robots.cancel()
        with contextlib.suppress(asyncio.CancelledError):
            await robots

    asyncio.run(everything())
    assert driver.control.is_done, said
    assert any(own.cancels for own in driver.control.ledger.robots)
    assert len(observer.finished) == 5
    journal.close()
    observer.close()


def test_robots_say_that_there_is_no_broker_and_when_all_are_there(broker: Mosquitto) -> None:
    plan = warehouse(5)
    identities = make_simulated_identities([robot.name for robot in plan.scenario.robots])
    nowhere = Broker.of("mqtt://127.0.0.1:1")

    async def begin(at: Broker) -> str:
        said = asyncio.get_running_loop().create_future()
        robots = asyncio.create_task(
            run_robots(
                plan,
                identities,
                at,
                is_up=lambda: said.set_result("all are there"),
                on_failure=lambda error: said.set_result(str(error)),
            )
        )
        async with asyncio.timeout(60):
            text = await said
        robots.cancel()
        with contextlib.suppress(asyncio.CancelledError):
            await robots
        return str(text)

    assert "refused" in asyncio.run(begin(nowhere))
    assert asyncio.run(begin(Broker.of(broker.url))) == "all are there"


def test_a_task_that_is_cancelled_ends_though_its_connection_fails_as_it_is_closed(
    broker: Mosquitto, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A loop that connects again after each failure of a connection would else never end."""
    closes = aiomqtt.Client.__aexit__

    async def fails(client: aiomqtt.Client, *error: Any) -> None:
        await closes(client, *error)
        raise aiomqtt.MqttError("Operation timed out")

    monkeypatch.setattr(aiomqtt.Client, "__aexit__", fails)
    plan = door()
    identities = make_simulated_identities([robot.name for robot in plan.scenario.robots])

    async def everything() -> None:
        up = asyncio.Event()
        task = asyncio.create_task(
            run_robots(plan, identities, Broker.of(broker.url), is_up=up.set)
        )
        await asyncio.wait_for(up.wait(), 60)
        task.cancel()
        _, left = await asyncio.wait([task], timeout=60)
        assert not left

    asyncio.run(everything())


def test_a_password_comes_from_the_environment(tmp_path: Path) -> None:
    passwords = tmp_path / "passwords"
    program = shutil.which("mosquitto_passwd")
    if program is None or MOSQUITTO is None:
        pytest.skip("mosquitto is not installed")
    subprocess.run([program, "-b", "-c", str(passwords), "fleet", "secret"], check=True)
    passwords.chmod(0o644)
    own = Mosquitto(tmp_path, ["allow_anonymous false", f"password_file {passwords}"])
    url = f"mqtt://fleet@localhost:{own.port}"
    try:
        with robots_of(door(), tmp_path, url, **{PASSWORD: "secret"}):
            with drive_of(tmp_path, url, **{PASSWORD: "wrong"}) as refused:
                wait_for(lambda: "no connection to" in refused.log, 30, "a refusal")
                assert refused.interrupt() == 130
            with drive_of(tmp_path, url, **{PASSWORD: "secret"}) as drive:
                assert drive.wait(60) == 0, drive.log
        assert "secret" not in drive.log + refused.log
    finally:
        own.kill()


def make_certificate(folder: Path) -> tuple[Path, Path]:
    """Return the files of a key and of its certificate for localhost, signed by itself."""
    program = shutil.which("openssl")
    if program is None or MOSQUITTO is None:
        pytest.skip("openssl or mosquitto is not installed")
    key, certificate = folder / "key.pem", folder / "certificate.pem"
    made = [program, "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-days", "2"]
    made += ["-keyout", str(key), "-out", str(certificate), "-subj", "/CN=localhost"]
    made += ["-addext", "subjectAltName=DNS:localhost"]
    subprocess.run(made, check=True, capture_output=True)
    key.chmod(0o644)
    return key, certificate


def test_a_connection_may_be_encrypted(tmp_path: Path) -> None:
    """The broker has a certificate for localhost; who does not trust it does not connect."""
    key, certificate = make_certificate(tmp_path)
    lines = ["allow_anonymous true", f"certfile {certificate}", f"keyfile {key}"]
    own = Mosquitto(tmp_path, lines)
    url = own.url.replace("mqtt:", "mqtts:")
    try:
        with robots_of(door(), tmp_path, url, "--ca-file", str(certificate)):
            with drive_of(tmp_path, url) as refused:
                wait_for(lambda: "no connection to" in refused.log, 30, "a refusal")
            options = ("--broker", url, "--identities", "robots.yaml")
            trusting = (*options, "--ca-file", str(certificate))
            with Command(tmp_path, "drive", "plan.json", *trusting).running() as drive:
                assert drive.wait(60) == 0, drive.log
    finally:
        own.kill()


def test_a_journal_of_another_plan_is_refused(tmp_path: Path) -> None:
    plan, other = door(), warehouse(2)
    names = [robot.name for robot in plan.scenario.robots]
    journal = SqliteJournal(tmp_path / "plan.journal")
    Driver(plan, make_simulated_identities(names), journal, report=print)
    for changed, version in ((other, "2.1.0"), (plan, "3.0.0")):
        with pytest.raises(InputError, match="is of another plan, or of other identities"):
            Driver(changed, make_simulated_identities(names, version), journal, report=print)
    Driver(plan, make_simulated_identities(names), journal, report=print)
    journal.close()


def test_a_written_file_of_identities_is_read(tmp_path: Path) -> None:
    names = ["R1", "R2"]
    own, path = make_simulated_identities(names, "3.0.0"), tmp_path / "robots.yaml"
    path.write_text(format_identities(names, own), encoding="utf-8")
    assert load_identities(path, names) == own


@pytest.mark.parametrize("name", ["README.md", "docs/control.md"])
def test_the_commands_of_a_page_drive_a_fleet(name: str, tmp_path: Path, broker: Mosquitto) -> None:
    """All but mosquitto itself, which a test starts at a port of its own."""
    shutil.copytree(ROOT / "examples", tmp_path / "examples")
    write_plan(door(), tmp_path / "plan.json")
    [block] = [block for block in blocks(ROOT / name) if block.info == ("sh", "robots")]
    text = block.text.replace("mqtt://localhost", broker.url)
    *before, robots, drive = [line.split()[1:] for line in text.splitlines()]
    for arguments in before:
        if arguments[0] == "plan":
            with Command(tmp_path, *arguments).running() as planning:
                assert planning.wait(60) == 0, planning.log
    with Command(tmp_path, *robots).running():
        wait_for((tmp_path / "robots.yaml").exists, 60, "the file of identities")
        with Command(tmp_path, *drive).running() as driving:
            assert driving.wait(120) == 0, driving.log


def test_the_commands_of_the_page_change_the_work_of_robots_that_drive(
    tmp_path: Path, broker: Mosquitto
) -> None:
    """The job of the page has the name that the control gives it; all robots come home."""
    [block] = [one for one in blocks(ROOT / "docs/live-jobs.md") if one.info == ("sh", "jobs")]
    name = "R1/job1"
    with robots_of(door(), tmp_path, broker.url, "--time-scale", "1"):
        wait_for((tmp_path / "robots.yaml").exists, 60, "the file of identities")
        options = ("--broker", broker.url, "--identities", "robots.yaml", "--stay")
        with Command(tmp_path, "drive", "plan.json", *options).running() as driving:
            wait_for(lambda: "sets out" in driving.log, 60, "the first order")
            for line in block.text.splitlines():
                words = [word.replace("R1/job1", name) for word in line.split()[1:]]
                with Command(tmp_path, *words).running() as asking:
                    code = asking.wait(60)
                    added = re.search(r"(R\d/job\d+) at N7 is added", asking.log)
                name = added[1] if added else name
                assert code in {0, 1}, asking.log
                assert code == 0 or "refused: " in asking.log
            wait_for(lambda: driving.log.count("is at the end of its way") >= 2, 120, "the ends")
            assert f"{name} at N7 is added" in driving.log
            assert "R1: on hold" in driving.log


def test_the_commands_of_the_page_take_in_a_robot_that_comes_later(
    tmp_path: Path, broker: Mosquitto
) -> None:
    """R1 drives home alone; then R2 is placed, works and is removed. A restart removes nobody."""
    [block] = [one for one in blocks(ROOT / "docs/service.md") if one.info == ("sh", "reserve")]
    drive, place, remove = block.text.replace("mqtt://localhost", broker.url).splitlines()
    with robots_of(door(), tmp_path, broker.url):
        wait_for((tmp_path / "robots.yaml").exists, 60, "the file of identities")
        with Command(tmp_path, *drive.split()[1:]).running() as driving:
            wait_for(lambda: "R1 is at the end of its way" in driving.log, 60, "R1")
            assert "R2 sets out" not in driving.log
            with Command(tmp_path, *place.split()[1:]).running() as asking:
                assert asking.wait(30) == 0, asking.log
            driving.kill()
            driving.start()
            wait_for(lambda: "R2 is at the end of its way" in driving.log, 60, "R2")
            with Command(tmp_path, *remove.split()[1:]).running() as asking:
                assert asking.wait(30) == 0, asking.log


def test_all_robots_stop_at_once_where_they_are_and_go_on(
    tmp_path: Path, broker: Mosquitto
) -> None:
    """Their factsheets list startPause. A control that was killed meanwhile ends the pause."""
    observer = Observer(broker.port)
    with robots_of(warehouse(20), tmp_path, broker.url, "--time-scale", "2"):
        wait_for((tmp_path / "robots.yaml").exists, 60, "the file of identities")
        options = ("plan.json", "--broker", broker.url, "--identities", "robots.yaml")
        with Command(tmp_path, "drive", *options).running() as drive:
            wait_for(lambda: drive.log.count("sets out") > 10, 60, "drives")
            with Command(tmp_path, "jobs", "plan.journal", "stop").running() as asking:
                assert asking.wait(30) == 0, asking.log
            wait_for(
                lambda: drive.log.count("is paused: no further nodes") == 20, 30, "pauses of all"
            )
            orders = set(observer.orders)
            drive.kill()
            drive.start()
            wait_for(
                lambda: drive.log.count("is paused: no further nodes") == 40, 30, "pauses again"
            )
            assert set(observer.orders) == orders
            with Command(tmp_path, "jobs", "plan.journal", "go").running() as asking:
                assert asking.wait(30) == 0, asking.log
            wait_for(lambda: drive.log.count("is paused no longer") == 20, 30, "the ends")
            wait_for(lambda: set(observer.orders) != orders, 60, "further orders")
    observer.close()


def test_the_drawing_of_the_page_becomes_robots_that_drive(
    tmp_path: Path, broker: Mosquitto
) -> None:
    """From the LIF file and the scenario of the page to simulated robots at a broker."""
    for block in blocks(ROOT / "docs/recipes/lif-robots.md"):
        if block.file_name in {"plant.lif.json", "plant.yaml"}:
            (tmp_path / block.file_name).write_text(block.text, encoding="utf-8")
    observer = Observer(broker.port)
    with Command(tmp_path, "plan", "plant.yaml", "-o", "plant.json").running() as planning:
        assert planning.wait(60) == 0, planning.log
    plan = load_plan(tmp_path / "plant.json")
    with (
        robots_of(plan, tmp_path, broker.url),
        drive_of(tmp_path, broker.url) as drive,
    ):
        assert drive.wait(60) == 0, drive.log
    assert "Ada has done its work at P (1 of 1)" in drive.log
    assert len(observer.finished) == 2
    trajectories = [edge["trajectory"] for _, edges in observer.orders.values() for edge in edges]
    assert all(len(each["controlPoints"]) == 2 for each in trajectories)
    observer.close()


def test_the_file_of_identities_of_the_page_is_read(tmp_path: Path) -> None:
    [block] = [block for block in blocks(ROOT / "docs/robots.md") if block.file_name == "acme.yaml"]
    path = tmp_path / "acme.yaml"
    path.write_text(block.text, encoding="utf-8")
    first, second = load_identities(path, ["R1", "R2"])
    assert first.get_topic("state") == "uagv/v2/ACME/A-001/state"
    assert second.get_topic("state") == "vda5050/v3/ACME/A-002/state"
    assert first.work.action == "scan"
    assert dict(first.work.parameters) == {"mode": "fast"}
    picks = [None if own.pick is None else own.pick.action for own in (first, second)]
    assert picks == ["pick", "lift"]
    assert (first.deviation, first.map_id) == (0.05, "hall-1")


FAULTS = {
    "robots.R3: the plan has no robot of this name": {"R3": {"serial": "c"}},
    "R2 is missing": {"R1": {"serial": "a"}},
    "is the serial number of R1, too": {"R1": {"serial": "a"}, "R2": {"serial": "a"}},
    "'a/b' cannot be part of a topic": {"R1": {"serial": "a/b"}},
    "robots.R1.serial: is missing": {"R1": {}},
}


@pytest.mark.parametrize("fault", FAULTS)
def test_identities_with_faults_are_refused_with_their_place(fault: str, tmp_path: Path) -> None:
    path = tmp_path / "robots.json"
    document = {"format": "rightofway-identities/1", "manufacturer": "m", "robots": FAULTS[fault]}
    path.write_text(json.dumps(document), encoding="utf-8")
    with pytest.raises(InputError, match=re.escape(fault)):
        load_identities(path, ["R1", "R2"])


@pytest.mark.parametrize(
    ("url", "fault"),
    [
        ("http://localhost", "is no address of a broker"),
        ("mqtt://localhost:99999", "is no address of a broker"),
        ("mqtt://me:secret@localhost", "a password is in the address"),
        ("mqtt://", "is no address of a broker"),
    ],
)
def test_addresses_with_faults_are_refused(url: str, fault: str) -> None:
    with pytest.raises(InputError, match=fault):
        Broker.of(url)


def test_metrics_are_served_for_prometheus(tmp_path: Path, broker: Mosquitto) -> None:
    port = free_port()
    with robots_of(door(), tmp_path, broker.url):
        wait_for((tmp_path / "robots.yaml").exists, 60, "the file of identities")
        options = ("--broker", broker.url, "--identities", "robots.yaml", "--stay")
        more = ("--metrics", str(port))
        with Command(tmp_path, "drive", "plan.json", *options, *more).running() as drive:
            wait_for(lambda: "R1 is at the end of its way" in drive.log, 60, "R1")
            address = f"http://127.0.0.1:{port}/metrics"
            wait_for(lambda: "rightofway_jobs_done 2.0" in text_at(address), 20, "metrics")
            text = text_at(address)
            health = json.loads(text_at(f"http://127.0.0.1:{port}/healthz"))
            assert {health[key] for key in ("alive", "ready", "broker", "journal")} == {True}
            assert health["seconds"] < 5
            broker.kill()
            wait_for(lambda: status_at(port, "readyz") == 503, 20, "the loss of the broker")
            assert status_at(port, "healthz") == 200
    assert 'rightofway_messages_received_total{topic="state"}' in text
    assert 'rightofway_messages_sent_total{topic="order"}' in text
    assert 'rightofway_waits_total{robot="R1"} 2.0' in text
    assert "rightofway_answer_seconds_bucket" in text
    assert "rightofway_robots_unfit 0.0" in text


def status_at(port: int, name: str) -> int:
    """Return the status of a page of health."""
    try:
        text_at(f"http://127.0.0.1:{port}/{name}")
    except HTTPError as error:
        return error.code
    return 200


def text_at(address: str) -> str:
    """Return what is served at an address of this machine."""
    with urlopen(address, timeout=5) as answer:  # noqa: S310
        text: str = answer.read().decode()
        return text
