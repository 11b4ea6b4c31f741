"""The files of `deploy/`: each command in them is one of ours, and the services run together."""

from __future__ import annotations

import json
import re
import shlex
import shutil
import signal
import subprocess
from contextlib import ExitStack
from pathlib import Path
from typing import Any
from urllib.error import URLError
from urllib.request import urlopen

import pytest
import yaml

from rightofway.cli.main import commands
from tests.builders.brokers import MOSQUITTO, Command, Mosquitto, free_port, wait_for
from tests.builders.pages import ROOT

DEPLOY = ROOT / "deploy"


def read_services() -> dict[str, Any]:
    """Return the services of the compose file."""
    services: dict[str, Any] = yaml.safe_load((DEPLOY / "compose.yaml").read_text())["services"]
    return services


def read_unit() -> list[str]:
    """Return the command of the unit for systemd."""
    text = (DEPLOY / "rightofway.service").read_text().replace("\\\n", " ")
    [line] = re.findall(r"^ExecStart=(.*)$", text, re.MULTILINE)
    program, *words = shlex.split(line)
    assert Path(program).name == "rightofway"
    return words


COMMANDS = {
    "unit": read_unit(),
    **{
        name: shlex.split(service["command"])
        for name, service in read_services().items()
        if service["image"] == "rightofway"
    },
}


@pytest.mark.parametrize("name", COMMANDS)
def test_each_command_is_one_of_ours(name: str) -> None:
    """Its options are parsed as the command line does."""
    command, *words = COMMANDS[name]
    found = commands.commands[command]
    assert found.make_context(command, list(words)).params


def test_the_unit_is_one_of_systemd(tmp_path: Path) -> None:
    program = shutil.which("systemd-analyze")
    if program is None:
        pytest.skip("systemd is not installed")
    text = (DEPLOY / "rightofway.service").read_text()
    unit = tmp_path / "rightofway.service"
    unit.write_text(text.replace("/opt/rightofway/bin/rightofway", "/bin/true"))
    done = subprocess.run(
        [program, "verify", "--man=no", str(unit)], capture_output=True, text=True, check=False
    )
    assert "rightofway.service" not in done.stdout + done.stderr


def test_the_image_has_the_extras_that_its_commands_need() -> None:
    text = (DEPLOY / "Containerfile").read_text()
    assert "'rightofway[control,studio]'" in text
    assert "'.[control,studio]'" in (ROOT / "justfile").read_text()


@pytest.mark.slow
@pytest.mark.skipif(MOSQUITTO is None, reason="mosquitto is not installed")
def test_the_services_of_the_compose_file_run_together(tmp_path: Path) -> None:
    """Without containers: their commands as processes, at other ports, in a copy of the site."""
    shutil.copytree(DEPLOY / "site", tmp_path, dirs_exist_ok=True)
    with Command(
        tmp_path, "plan", str(ROOT / "examples/floor.yaml"), "-o", "plan.json"
    ).running() as plan:
        assert plan.wait(60) == 0, plan.log
    broker, live, health = Mosquitto(tmp_path), free_port(), free_port()
    ports = {
        "mqtt://broker": broker.url,
        "8450": str(live),
        "9100": str(health),
        "0.0.0.0": "127.0.0.1",  # noqa: S104 (this machine alone)
    }
    try:
        with ExitStack() as stack:
            running = {}
            for name in ("robots", "control"):
                words = [ports.get(word, word) for word in COMMANDS[name]]
                if name == "robots":
                    words += ["--time-scale", "20"]
                running[name] = stack.enter_context(Command(tmp_path, *words).running())
            control = running["control"]
            wait_for(lambda: "sets out" in control.log, 60, "the first drive")
            assert is_healthy(health)
            assert control.interrupt(signal.SIGTERM) == 0, control.log
    finally:
        broker.kill()


def is_healthy(port: int) -> bool:
    """Return the answer of the check of health."""
    try:
        with urlopen(f"http://127.0.0.1:{port}/healthz", timeout=5) as answer:
            return bool(json.load(answer)["alive"])
    except URLError:
        return False
