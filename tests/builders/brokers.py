"""A real broker (mosquitto), and the real commands as processes that can be killed."""

from __future__ import annotations

import contextlib
import multiprocessing
import os
import random
import shutil
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Protocol

from rightofway.cli import main

__all__ = ["MOSQUITTO", "Command", "Mosquitto", "WarmCommand", "free_port", "wait_for"]

MOSQUITTO = shutil.which(
    "mosquitto", path=f"{os.environ.get('PATH', '')}:/usr/sbin:/usr/local/sbin"
)
"""The broker; None where it is not installed."""


def free_port() -> int:
    """Return a port that nobody listens on, none of those that the system gives to connections.

    A broker that is killed gets its port again, however many connections others make meanwhile.
    """
    while True:
        port = random.SystemRandom().randrange(10_000, 32_768)
        with socket.socket() as one, contextlib.suppress(OSError):
            one.bind(("127.0.0.1", port))
            return port


def wait_for(condition: Callable[[], bool], seconds: float, what: str) -> None:
    """Wait until a condition holds."""
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            raise AssertionError(f"waited {seconds:g} s for {what}")
        time.sleep(0.02)


class Mosquitto:
    """A broker on this machine; `lines` are put into its configuration."""

    def __init__(self, folder: Path, lines: Sequence[str] = ("allow_anonymous true",)) -> None:
        self.port = free_port()
        self._file = folder / "mosquitto.conf"
        # As root it would read the files of a test as a user of its own, who may not.
        own = [f"listener {self.port} 127.0.0.1", "persistence false", "user root", *lines]
        self._file.write_text("\n".join(own) + "\n", encoding="utf-8")
        self._process: subprocess.Popen[bytes] | None = None
        self.start()

    @property
    def url(self) -> str:
        """Where it is."""
        return f"mqtt://localhost:{self.port}"

    def start(self) -> None:
        """Start it, and wait until it listens."""
        assert MOSQUITTO is not None
        self._process = subprocess.Popen(
            [MOSQUITTO, "-c", str(self._file)],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        wait_for(self._listens, 20, "mosquitto")

    def _listens(self) -> bool:
        with contextlib.suppress(OSError), socket.create_connection(("127.0.0.1", self.port), 0.2):
            return True
        return False

    def kill(self) -> None:
        """Kill it: what it had kept is gone."""
        if self._process is not None:
            self._process.kill()
            self._process.wait()
            self._process = None


class Process(Protocol):
    """A process of a command."""

    def kill(self) -> None:
        """End it at once."""

    def wait(self, timeout: float | None = None) -> int:
        """Wait until it ends; return its exit code."""

    def poll(self) -> int | None:
        """Return its exit code, None as long as it runs."""

    def send_signal(self, number: int) -> None:
        """Send it a signal."""


class Command:
    """A command of the package in a process of its own; what it says goes to a file."""

    def __init__(self, folder: Path, name: str, *arguments: str, **environment: str) -> None:
        self.said = folder / f"{name}.log"
        self._arguments = [sys.executable, "-m", "rightofway", name, *arguments]
        self._environment = {**os.environ, **environment}
        self._folder = folder
        self.start()

    def start(self) -> None:
        """Start it, again if it was killed; what it says comes after what it has said."""
        with self.said.open("ab") as log:
            self._process: Process = subprocess.Popen(
                self._arguments,
                cwd=self._folder,
                env=self._environment,
                stdout=log,
                stderr=log,
            )

    def kill(self) -> None:
        """End it at once, as a power cut would."""
        self._process.kill()
        self._process.wait()

    def interrupt(self, number: int = signal.SIGINT) -> int:
        """End it as Ctrl-C does, or by another signal; return its exit code."""
        self._process.send_signal(number)
        return self._process.wait(20)

    @property
    def code(self) -> int | None:
        """Its exit code, None as long as it runs."""
        return self._process.poll()

    def wait(self, seconds: float) -> int:
        """Wait until it ends; return its exit code."""
        try:
            return self._process.wait(seconds)
        except subprocess.TimeoutExpired as error:
            raise AssertionError(f"did not end: {self.log[-3000:]}") from error

    @property
    def log(self) -> str:
        """All that it has said."""
        return self.said.read_text(encoding="utf-8")

    @contextlib.contextmanager
    def running(self) -> Iterator[Command]:
        """End it in the end."""
        try:
            yield self
        finally:
            self.kill()


class WarmCommand(Command):
    """A command that is started as users do, and again by forks of a process with all imports.

    What runs, and is killed, is the whole command in a process of its own. Half a second of the
    processor is saved with each start.
    """

    def start(self) -> None:
        """Start it, again if it was killed."""
        if self.said.exists():
            self._process = _Fork([str(self._folder), str(self.said), *self._arguments[3:]])
        else:
            super().start()


IMPORTS = (
    "aiomqtt",
    "rightofway.control.command_line.drive",
    "rightofway.control.commands",
    "rightofway.control.driver",
    "rightofway.control.identities",
    "rightofway.io.plan.shape",
    "tests.builders.observers",
)
"""What `rightofway drive` imports, and the programs that start it."""


class _Fork:
    """A process that is a fork of one which has imported the package and has no threads."""

    def __init__(self, arguments: Sequence[str]) -> None:
        forks = multiprocessing.get_context("forkserver")
        forks.set_forkserver_preload(list(IMPORTS))  # what the first fork finds counts
        self._process = forks.Process(target=_run_command, args=arguments)
        self._process.start()

    def kill(self) -> None:
        self._process.kill()

    def wait(self, timeout: float | None = None) -> int:
        self._process.join(timeout)
        code = self._process.exitcode
        if code is None:
            raise subprocess.TimeoutExpired("rightofway", timeout or 0)
        return code

    def poll(self) -> int | None:
        return self._process.exitcode

    def send_signal(self, number: int) -> None:
        assert self._process.pid is not None
        os.kill(self._process.pid, number)


def _run_command(folder: str, said: str, *arguments: str) -> None:
    """Be the command from now on."""
    os.chdir(folder)
    with Path(said).open("ab") as log:
        for number in (1, 2):
            os.dup2(log.fileno(), number)
    sys.argv = ["rightofway", *arguments]
    main()
