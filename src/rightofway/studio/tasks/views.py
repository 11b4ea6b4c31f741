"""Plans as people and programs want them: played, compared, in files."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import lru_cache
from pathlib import Path
from typing import Any, NotRequired

from typing_extensions import TypedDict

from rightofway.errors import InputError
from rightofway.io import FOREIGN_FORMATS, format_foreign, parse_plan, write_plan
from rightofway.io.json_text import parse_json
from rightofway.io.scenario.reader import read_scenario
from rightofway.metrics import compare, find_changes
from rightofway.model import Plan
from rightofway.report.comparison import describe_change
from rightofway.report.plan_data import make_summary_data
from rightofway.studio.messages import Blobs, Emit, zip_text
from rightofway.studio.tasks.documents import compute_figures
from rightofway.studio.tasks.drawings import Origin, as_drawn
from rightofway.viz import make_page, write_gif, write_page, write_png
from rightofway.viz.page.document import as_compact_json
from rightofway.viz.page.payload import make_payload
from rightofway.viz.verdict import make_comparison_data

Result = tuple[Any, ...]


class Shown(TypedDict):
    """Properties of a plan on a page that its file does not have."""

    title: str
    seconds: float | None
    origin: NotRequired[Origin | None]


TIMES = ("flowtime", "makespan")
"""Costs that are compared in time units."""


def _write_result(plan: Plan, path: Path) -> None:
    from rightofway.viz.table.result import write_result

    write_result(plan, path)


WRITERS: dict[str, Callable[[Plan, Path], object]] = {
    "json": write_plan,
    "xlsx": _write_result,
    "html": write_page,
    "png": write_png,
    "gif": write_gif,
}
"""For each ending of an export, what writes it."""


PICTURES = {"png", "gif"}
"""Endings of exports that show the map."""


@lru_cache(maxsize=2)
def read(blob: bytes) -> Plan:
    """Return the plan of a blob; the latest ones are kept, because several requests ask for each.

    Parameters
    ----------
    blob
        The text of a plan file.
    """
    return parse_plan(parse_json(blob.decode()))


def make_plan_payload(_emit: Emit, blobs: Blobs, *, shown: Sequence[Shown]) -> Result:
    """Return the playback of the viewer: one plan, or several side by side."""
    plan, *others = _list_titled(blobs, shown)
    played = make_payload(plan[0], title=plan[1], others=others)
    return (None, zip_text(as_compact_json(played)))


def make_plan_page(_emit: Emit, blobs: Blobs, *, shown: Sequence[Shown]) -> Result:
    """Return the page that plays a plan, or several."""
    plan, *others = _list_titled(blobs, shown)
    return (None, zip_text(make_page(plan[0], title=plan[1], others=others)))


def _list_titled(blobs: Blobs, shown: Sequence[Shown]) -> list[tuple[Plan, str]]:
    """Return plans with their titles, and with the seconds and drawings that files do not keep."""
    payloads = []
    for blob, titles in zip(blobs, shown, strict=True):
        plan = as_drawn(read(blob), titles.get("origin"))
        timed = replace(plan, run=replace(plan.run, seconds=titles["seconds"]))
        payloads.append((timed, titles["title"]))
    return payloads


def export_plan(_emit: Emit, blobs: Blobs, *, form: str, origin: Origin | None = None) -> Result:
    """Return a plan as a file: an ending of `WRITERS`, or a format of other programs."""
    plan = as_drawn(read(blobs[0]), origin if form in PICTURES else None)
    if form in FOREIGN_FORMATS:
        return (None, format_foreign(plan, form).encode())
    if form not in WRITERS:
        known = ", ".join([*WRITERS, *FOREIGN_FORMATS])
        raise InputError.at("form", f"{form!r} is no format (give one of: {known})")
    with tempfile.TemporaryDirectory() as scratch:
        file = Path(scratch, f"plan.{form}")
        WRITERS[form](plan, file)
        return (None, file.read_bytes())


def summarize_plan(_emit: Emit, blobs: Blobs) -> Result:
    """Return the report of `rightofway plan --json`."""
    return (make_summary_data(read(blobs[0])),)


def compare_plans(_emit: Emit, blobs: Blobs, *, shown: Sequence[Shown]) -> Result:
    """Return the costs of plans, and each robot's completion time in each of them [time unit].

    Costs in ``time`` are in time units, too: the ticks of two scenarios may differ. ``comparison``
    is the content of the page of the plans: figures, changes of the scenarios, times in one tick.
    """
    titled = _list_titled(blobs, shown)
    plans, titles = [plan for plan, _ in titled], [title for _, title in titled]
    comparison = compare(plans, titles)
    data = make_comparison_data(comparison)
    robots = [
        {
            "name": robot["name"],
            "completion": [
                None if ticks is None else float(ticks * comparison.tick)
                for ticks in robot["completion"]
            ],
        }
        for robot in data["robots"]
    ]
    costs = [
        {
            **compute_figures(plan),
            "time": {key: float(compared[key] * comparison.tick) for key in TIMES},
        }
        for plan, compared in zip(plans, data["plans"], strict=True)
    ]
    return ({"plans": costs, "robots": robots, "titles": titles, "comparison": data},)


def list_changes(_emit: Emit, blobs: Blobs) -> Result:
    """Return the differences of the scenario of a plan from that of the plan before."""
    before, after = (read_scenario(parse_json(blob.decode())["scenario"], None) for blob in blobs)
    differences = find_changes(before.scenario, after.scenario)
    return ({"changes": list(map(describe_change, differences))},)
