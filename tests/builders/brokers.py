"""A real broker (mosquitto), and the real commands as processes that can be killed."""

from __future__ import annotations

import contextlib
import os
import shutil
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

__all__ = ["MOSQUITTO", "Command", "Mosquitto", "free_port", "wait_for"]

MOSQUITTO = shutil.which(
    "mosquitto", path=f"{os.environ.get('PATH', '')}:/usr/sbin:/usr/local/sbin"
)
"""The broker; None where it is not installed."""


def free_port() -> int:
    """Return a port that nobody listens on."""
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        port: int = one.getsockname()[1]
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
            self._process = subprocess.Popen(
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

    def interrupt(self) -> int:
        """End it as Ctrl-C does; return its exit code."""
        self._process.send_signal(signal.SIGINT)
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
