"""``rightofway show``: a page, a picture or a film of a plan."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from rightofway.cli.terminal import read_either, say, writable

if TYPE_CHECKING:
    from rightofway.model import Plan

__all__ = ["show"]

EXAMPLES = """\b
Examples:
  rightofway show plan.json -o plan.html
  rightofway show plan.json -o moment.png --tick 12
  rightofway show examples/door.yaml -o door.gif
"""


@click.command(epilog=EXAMPLES)
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
    suffix = Path(output).suffix.lower()
    if suffix != ".png" and (diagram or tick is not None):
        raise click.UsageError("--tick and --diagram are for pictures (end the file in .png)")
    found = _plan_of(plan)
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


def _plan_of(path: str) -> Plan:
    """Read a plan, or plan a scenario."""
    from rightofway.model import Plan
    from rightofway.solve import solve

    found = read_either(path)
    if isinstance(found, Plan):
        return found
    planned = solve(found, report=say)
    say(f"{path}: planned with {planned.run.name}: {planned.run.status}")
    return planned
