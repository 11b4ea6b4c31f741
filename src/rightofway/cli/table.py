"""``rightofway table``: the paper's time/space table."""

from __future__ import annotations

from pathlib import Path

import click

from rightofway.cli.terminal import put, read_plan, say
from rightofway.errors import InputError

__all__ = ["table"]

EXAMPLE = """\b
Examples:
  rightofway table plan.json --to 20
  rightofway table plan.json -o plan.xlsx --robots R1,R2
"""


@click.command(epilog=EXAMPLE)
@click.argument("plan", type=click.Path())
@click.option("-o", "--output", metavar="FILE", help="Write .csv or .xlsx instead of text.")
@click.option("--from", "first", type=click.IntRange(0), default=0, help="First tick shown.")
@click.option("--to", "last", type=click.IntRange(0), help="Last tick shown.")
@click.option("--robots", metavar="NAMES", help="Only these robots, with commas between.")
def table(plan: str, output: str | None, first: int, last: int | None, robots: str | None) -> None:
    """Show where each robot of a PLAN is at each tick.

    Planned rows are without any wait, collisions marked; final rows are as planned.
    """
    from rightofway.viz.table import as_text, table_of, write_csv, write_xlsx

    writers = {".csv": write_csv, ".xlsx": write_xlsx}
    if output and Path(output).suffix.lower() not in writers:
        raise InputError.at("-o", f"{output!r} is no .csv or .xlsx (name one of them)")
    names = [name.strip() for name in robots.split(",")] if robots else None
    found = table_of(read_plan(plan), first_tick=first, last_tick=last, robots=names)
    if output:
        writers[Path(output).suffix.lower()](found, output)
        say(f"wrote {output}")
    else:
        put(as_text(found))
