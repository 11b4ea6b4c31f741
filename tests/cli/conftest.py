"""Running the command line in the test's own process, in a directory of its own."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import pytest

from rightofway.cli.main import run
from tests.builders.odd_planners import install

EXAMPLES = Path(__file__).parents[2] / "examples"

SWAP = """format: rightofway-scenario/1
map: {grid: ["...", "@.@", "..."]}
robots:
  - {name: R1, home: N0, target: N6}
  - {name: R2, home: N2, target: N8, speed: 1/2, work: 3}
"""
"""Two robots that exchange their places if `two-level` leaves swaps."""


@dataclass(frozen=True)
class RunResult:
    """How a command ended: its exit code, standard output and standard error."""

    code: int
    out: str
    err: str


Cli = Callable[..., RunResult]


@pytest.fixture
def cli(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Cli:
    """Return a function that runs a command in an empty directory."""
    monkeypatch.chdir(tmp_path)

    def call(*args: object) -> RunResult:
        code = run([str(arg) for arg in args])
        captured = capsys.readouterr()
        return RunResult(code, captured.out, captured.err)

    return call


@pytest.fixture
def door() -> Path:
    """Return the paper's door."""
    return EXAMPLES / "door.yaml"


@pytest.fixture
def others(tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch) -> None:
    """Install the planners that misbehave, for this process and those that it starts."""
    directory = tmp_path_factory.mktemp("site")
    install(directory)
    monkeypatch.syspath_prepend(directory)
    monkeypatch.setenv("PYTHONPATH", str(directory))
