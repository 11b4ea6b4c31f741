"""Plans as people and programs want them: played, compared, in files."""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from functools import lru_cache
from pathlib import Path
from typing import Any

from rightofway.cli.plan_report import summary_data
from rightofway.errors import InputError
from rightofway.io import FOREIGN_FORMATS, foreign_text, plan_of, write_plan
from rightofway.io.text import parse_json
from rightofway.model import Plan
from rightofway.studio.messages import Blobs, Emit, zipped
from rightofway.studio.tasks.documents import figures
from rightofway.viz import page_of, write_gif, write_page, write_png
from rightofway.viz.page.document import compact_json
from rightofway.viz.page.payload import payload_of
from rightofway.viz.table.result import write_result

Result = tuple[Any, ...]

WRITERS: dict[str, Callable[[Plan, Path], object]] = {
    "json": write_plan,
    "xlsx": write_result,
    "html": write_page,
    "png": write_png,
    "gif": write_gif,
}
"""For each ending of an export, what writes it."""


@lru_cache(maxsize=2)
def read(blob: bytes) -> Plan:
    """Return the plan of a blob; the latest ones are kept, because several requests ask for each.

    Parameters
    ----------
    blob
        The text of a plan file.
    """
    return plan_of(parse_json(blob.decode()))


def payload(_emit: Emit, blobs: Blobs, *, title: str, other: str = "") -> Result:
    """Return what the viewer plays: one plan, or two side by side."""
    both = (read(blobs[1]), other) if len(blobs) > 1 else None
    played = payload_of(read(blobs[0]), title=title, other=both)
    return (None, zipped(compact_json(played)))


def page(_emit: Emit, blobs: Blobs, *, title: str, other: str = "") -> Result:
    """Return the page that plays a plan, or two."""
    both = (read(blobs[1]), other) if len(blobs) > 1 else None
    return (None, zipped(page_of(read(blobs[0]), title=title, other=both)))


def exported(_emit: Emit, blobs: Blobs, *, form: str) -> Result:
    """Return a plan as a file: an ending of `WRITERS`, or a format of other programs."""
    plan = read(blobs[0])
    if form in FOREIGN_FORMATS:
        return (None, foreign_text(plan, form).encode())
    if form not in WRITERS:
        known = ", ".join([*WRITERS, *FOREIGN_FORMATS])
        raise InputError.at("form", f"{form!r} is no format (give one of: {known})")
    with tempfile.TemporaryDirectory() as scratch:
        file = Path(scratch, f"plan.{form}")
        WRITERS[form](plan, file)
        return (None, file.read_bytes())


def summary(_emit: Emit, blobs: Blobs) -> Result:
    """Return the report of `rightofway plan --json`."""
    return (summary_data(read(blobs[0])),)


def compared(_emit: Emit, blobs: Blobs) -> Result:
    """Return what plans cost, and each robot's completion time in each of them [time unit].

    Costs in ``time`` are in time units, too: the ticks of two scenarios may differ.
    """
    plans = [read(blob) for blob in blobs]
    times: dict[str, list[float | None]] = {}
    for place, plan in enumerate(plans):
        tick = plan.scenario.problem.clock.tick
        for robot, ticks in zip(plan.scenario.robots, plan.completions, strict=True):
            row = times.setdefault(robot.name, [None] * len(plans))
            row[place] = float(ticks * tick)
    robots = [{"name": name, "completion": row} for name, row in times.items()]
    costs = [{**figures(plan), "time": _times(plan)} for plan in plans]
    return ({"plans": costs, "robots": robots},)


def _times(plan: Plan) -> dict[str, float]:
    tick = plan.scenario.problem.clock.tick
    costs = {"flowtime": plan.flowtime, "makespan": plan.makespan}
    return {key: float(ticks * tick) for key, ticks in costs.items()}
