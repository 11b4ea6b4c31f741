"""``rightofway check`` and ``show``: what is in a plan."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from rightofway.cli.terminal import as_json_option, put_json, read_either, say, writable

if TYPE_CHECKING:
    from rightofway.check import Report
    from rightofway.model import Plan

SHOW_EXAMPLES = """\b
Examples:
  rightofway show plan.json -o plan.html
  rightofway show plan.json -o moment.png --tick 12
  rightofway show examples/door.yaml -o door.gif
"""


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
    from rightofway.io import load_plan

    found = load_plan(plan)
    report = judge(found, limit=limit)
    if as_json:
        put_json(_report_data(found, report))
    elif report.ok:
        robots, visits = len(found.tracks), sum(map(len, found.tracks))
        click.echo(f"{plan}: no fault in {robots} robots and {visits} visits")
    else:
        click.echo(f"{plan}: {report}")
    return 0 if report.ok else 1


def _report_data(found: Plan, report: Report) -> dict[str, Any]:
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


@click.command(epilog=SHOW_EXAMPLES)
@click.argument("plan", type=click.Path(), metavar="PLAN_OR_SCENARIO")
@click.option("-o", "--output", required=True, metavar="FILE",
              callback=writable(".html", ".png", ".gif"),
              help="File to write: a page (.html), a picture (.png) or a film (.gif).")  # fmt: skip
@click.option("--tick", type=click.IntRange(0), metavar="TICK",
              help="Tick that a picture shows; the start by default.")  # fmt: skip
@click.option("--diagram", is_flag=True, help="Draw the space-time diagram under a picture.")
def show(plan: str, output: str, tick: int | None, diagram: bool) -> None:
    """Show a plan as a page that plays it, a picture or a film.

    A scenario is planned first, as by `rightofway plan`.
    """
    from rightofway.model import Scenario
    from rightofway.solve import solve

    suffix = Path(output).suffix.lower()
    if suffix != ".png" and (diagram or tick is not None):
        raise click.UsageError("--tick and --diagram are for pictures (end the file in .png)")
    found = read_either(plan)
    if isinstance(found, Scenario):
        found = solve(found, report=say)
        say(f"{plan}: planned with {found.run.name}: {found.run.status}")
    if suffix == ".html":
        from rightofway.viz import write_page

        write_page(found, output)
    elif suffix == ".png":
        from rightofway.viz import write_png

        write_png(found, output, tick, diagram=diagram)
    else:
        from rightofway.viz import write_gif

        film = write_gif(found, output)
        say(f"{film.frames} frames, {float(film.ticks_per_frame):g} ticks apart")
    say(f"wrote {output}")
