"""``rightofway table``: the paper's time/space table."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from rightofway.cli.terminal import as_json_option, put, put_json, read_plan, say, width, writable

if TYPE_CHECKING:
    from rightofway.viz.table import TimeSpaceTable

__all__ = ["table"]

EXAMPLES = """\b
Examples:
  rightofway table plan.json --to 20
  rightofway table plan.json -o plan.xlsx --robots R1,R2
"""


@click.command(epilog=EXAMPLES, short_help="Print the vertex of each robot at each tick.")
@click.argument("plan", type=click.Path())
@click.option("-o", "--output", metavar="FILE", callback=writable(".csv", ".xlsx"),
              help="Write .csv or .xlsx instead of text.")  # fmt: skip
@click.option("--from", "first", type=click.IntRange(0), default=0, metavar="TICK",
              help="First tick shown.")  # fmt: skip
@click.option("--to", "last", type=click.IntRange(0), metavar="TICK", help="Last tick shown.")
@click.option("--robots", metavar="NAMES", help="Only these robots, with commas between.")
@as_json_option("table")
def table(
    *,
    plan: str,
    output: str | None,
    first: int,
    last: int | None,
    robots: str | None,
    as_json: bool,
) -> None:
    """Print the time/space table of a PLAN: the vertex of each robot at each tick.

    Planned rows are those of robots that never wait, with their collisions marked; final rows are
    those of the plan. A PLAN of - is standard input.
    """
    from rightofway.viz.table import as_text, table_of

    names = [name.strip() for name in robots.split(",")] if robots else None
    found = table_of(read_plan(plan), first_tick=first, last_tick=last, robots=names)
    if output:
        _write(found, output)
    if as_json:
        put_json(_data(found))
    elif not output:
        put(as_text(found, width()))


def _write(found: TimeSpaceTable, path: str) -> None:
    from rightofway.viz.table import write_csv, write_xlsx

    writers = {".csv": write_csv, ".xlsx": write_xlsx}
    writers[Path(path).suffix.lower()](found, path)
    say(f"wrote {path}")


def _data(found: TimeSpaceTable) -> dict[str, Any]:
    """Return the table for programs: for each row its runs of equal cells."""
    return {
        "first_tick": found.first_tick,
        "last_tick": found.last_tick,
        "tick": str(found.tick),
        "rows": [
            {
                "robot": row.robot,
                "kind": row.kind,
                "runs": [
                    {"start": start, "end": end, "place": cell.place, "mark": cell.mark}
                    for start, end, cell in row.runs
                ],
            }
            for row in found.rows
        ],
    }
