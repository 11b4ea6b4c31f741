"""``rightofway check``: whether a plan keeps every rule."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from rightofway.cli.terminal import as_json_option, put, put_json, read_plan

if TYPE_CHECKING:
    from rightofway.check import Report
    from rightofway.model import Plan

__all__ = ["check"]


@click.command(epilog="Example:  rightofway check plan.json")
@click.argument("plan", type=click.Path())
@click.option("--limit", type=click.IntRange(0), default=1000, show_default=True, metavar="N",
              help="Faults to list; all are counted.")  # fmt: skip
@as_json_option("report")
def check(plan: str, limit: int, as_json: bool) -> int:
    """Check a PLAN; exit code 1 if it breaks a rule.

    The check shares no code with the planners. It finds jumps, drives that are too fast, work cut
    short, missed stops, wrong homes and ends, vertex and swap conflicts, headways that are too
    short and, where they are forbidden, rotations. A PLAN of - is standard input.
    """
    from rightofway.check import check as judge

    found = read_plan(plan)
    report = judge(found, limit=limit)
    if as_json:
        put_json(_data(found, report))
    elif report.ok:
        robots, visits = len(found.tracks), sum(map(len, found.tracks))
        put(f"{plan}: no fault in {robots} robots and {visits} visits")
    else:
        put(f"{plan}: {report}")
    return 0 if report.ok else 1


def _data(found: Plan, report: Report) -> dict[str, Any]:
    return {
        "ok": report.ok,
        "counts": dict(report.counts),
        "faults": [
            {
                "kind": fault.kind,
                "robots": [found.scenario.robots[robot].name for robot in fault.robots],
                "vertices": [found.scenario.roadmap.name(vertex) for vertex in fault.vertices],
                "tick": fault.tick,
                "message": fault.message,
            }
            for fault in report.faults
        ],
    }
