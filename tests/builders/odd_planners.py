"""Planners of another package, which misbehave: for tests of what is made of their ends."""

from __future__ import annotations

import os
import signal
import time
import uuid
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from rightofway.errors import GaveUp
from rightofway.model import Track
from rightofway.planners import Draft, PlannerSpec, PlanRequest, find

__all__ = ["NAMES", "install"]


def sleepy(request: PlanRequest) -> Draft:
    """Leave a note of each try with who asked for it, and take half a second."""
    Path(f"try-{uuid.uuid4().hex}").write_text(str(os.getppid()), encoding="utf-8")
    time.sleep(0.5)
    return settled(request)


def settled(request: PlanRequest) -> Draft:
    spec = find("two-level")
    draft = spec.load()(replace(request, options=spec.settle({})))
    return Draft(tracks=draft.tracks, status="well rested")


def chatty(request: PlanRequest) -> Draft:
    print("planning", flush=True)  # noqa: T201 (other people's planners print)
    return settled(request)


def liar(request: PlanRequest) -> Draft:
    homes = tuple(Track.of([robot.home], [0]) for robot in request.scenario.robots)
    return Draft(tracks=homes, status="nobody moves")


def suicide(_: PlanRequest) -> Draft:
    os.kill(os.getpid(), signal.SIGKILL)
    raise AssertionError


def patricide(_: PlanRequest) -> Draft:
    os.kill(os.getppid(), signal.SIGKILL)
    time.sleep(60)
    raise AssertionError


def quitter(_: PlanRequest) -> Draft:
    os.write(2, b"assertion failed: x > 0\n")
    os._exit(3)


def hungry(_: PlanRequest) -> Draft:
    raise MemoryError("no room for 1e12 bytes")


def buggy(_: PlanRequest) -> Draft:
    raise RuntimeError('two\nlines, "quoted"')


def lazy(_: PlanRequest) -> Draft:
    raise GaveUp("it is too hot")


def stuck(_: PlanRequest) -> Draft:
    Path("stuck").write_text(str(os.getpid()), encoding="utf-8")
    time.sleep(600)
    raise AssertionError


PLANNERS: tuple[Callable[[PlanRequest], Draft], ...] = (
    sleepy, chatty, liar, suicide, patricide, quitter, hungry, buggy, lazy, stuck,
)  # fmt: skip
NAMES = [planner.__name__ for planner in PLANNERS]
SPECS = {
    name: PlannerSpec(name, f"odd_planners:{name}", "Misbehaves in a way of its own.")
    for name in NAMES
}
globals().update({f"{name}_spec": spec for name, spec in SPECS.items()})


def install(directory: Path) -> None:
    """Put a package with these planners into a directory, as pip would."""
    info = directory / "odd_planners-1.dist-info"
    info.mkdir(parents=True)
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: odd-planners\nVersion: 1\n")
    points = "".join(f"{name} = odd_planners:{name}_spec\n" for name in NAMES)
    (info / "entry_points.txt").write_text(f"[rightofway.planners]\n{points}", encoding="utf-8")
    source = Path(__file__).read_text(encoding="utf-8")
    (directory / "odd_planners.py").write_text(source, encoding="utf-8")
