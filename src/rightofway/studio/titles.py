"""How runs are called: titles on pages, names of files, and their command lines."""

from __future__ import annotations

import re
import shlex
from collections.abc import Sequence
from pathlib import PurePosixPath
from typing import Any

from rightofway.planners import DEFAULT_PLANNER, IMPROVER
from rightofway.studio.errors import Refused
from rightofway.studio.runs import Run

NAME_IN_FILE = 40
"""Characters of a run's name in the name of a file."""


def describe_shown(runs: Sequence[Run]) -> list[dict[str, Any]]:
    """Return the texts of a page on runs: titles, different for each of several, and seconds."""
    if len(runs) == 1:
        titles = [runs[0].name or f"{find_file(runs[0])} #{runs[0].number}".lstrip()]
    else:
        titles = [run.name or f"#{run.number}" for run in runs]
        if len(set(titles)) < len(titles):
            titles = [f"#{run.number} {run.name}".rstrip() for run in runs]
    return [
        {"title": title, "seconds": measure_seconds(run)}
        for title, run in zip(titles, runs, strict=True)
    ]


def find_file(run: Run) -> str:
    """Return the file that a run was made from; empty for a draft, whose name has no ending."""
    return run.source if PurePosixPath(run.source).suffix else ""


def make_file_name(runs: Sequence[Run], ending: str) -> str:
    """Return how a file of plans is called: ``floor-plan-3-first-try.html``."""
    stem = PurePosixPath(find_file(runs[0])).name.split(".")[0]
    numbers = "-".join(str(run.number) for run in runs)
    name = runs[0].name if len(runs) == 1 else ""
    words = (re.sub(r"[^A-Za-z0-9_]+", "-", part).strip("-") for part in (stem, name))
    first, last = words
    parts = [first, f"plan-{numbers}", last[:NAME_IN_FILE]]
    return f"{'-'.join(filter(None, parts))}.{ending}"


def measure_seconds(run: Run) -> float | None:
    """Return how long a run took; None for a plan from elsewhere."""
    if run.started is None or run.ended is None or run.ended <= run.started:
        return None
    return round(run.ended - run.started, 3)


def make_command(run: Run) -> str:
    """Return the command line of a run."""
    request, words = run.request, ["rightofway", run.kind]
    if run.kind in {"opened", "flip"}:
        raise Refused(f"run {run.number} was not made by a command (export its plan)", 404)
    unnamed = "scenario.yaml" if run.kind in {"plan", "laps"} else "plan.json"
    source = find_file(run) or unnamed
    words.append(f"./{source}" if source.startswith("-") else source)
    if run.kind in {"plan", "improve"}:
        default = DEFAULT_PLANNER if run.kind == "plan" else IMPROVER
        words += ["--planner", request.get("planner", default)]
        for name, value in request["options"].items():
            words += ["--option", f"{name}={value}"]
    if "start" in request:
        words += ["--start", f"run-{request['start']}.json"]
    for key in ("rule", "routes", "runs", "run", "seed"):
        if request.get(key) not in {None, "typical", "worst"}:
            words += [f"--{key}", str(request[key])]
    for delay in request.get("delays", ()):
        words += ["--delays", delay]
    words += [f"--{key}" for key in ("switch", "replan") if request.get(key)]
    if run.kind != "simulate":
        words += ["--time-limit", f"{request['time_limit']:g}"]
    return shlex.join(words)
