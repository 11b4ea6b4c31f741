"""``rightofway table``: where robots are, when, as tables that other programs read too."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from rightofway.cli.completion import PLANS, complete_files
from rightofway.cli.inputs import add_foreign_options, read_plan
from rightofway.cli.options import (
    Time,
    Whole,
    as_json_option,
    choose_quantities,
    require_writable,
    ticks_option,
)
from rightofway.cli.terminal import measure_width, put_json, say_written
from rightofway.errors import InputError
from rightofway.kinds.numbers import format_number
from rightofway.report.place_names import PlaceNames

if TYPE_CHECKING:
    from rightofway.model import Plan
    from rightofway.report.quantities import Quantities
    from rightofway.viz.table import Listing, TimeSpaceTable


TABLE_EXAMPLES = """\b
Examples:
  rightofway table plan.json --to 20
  rightofway table plan.json -o plan.xlsx --robots R1,R2
  rightofway table plan.json --events -o events.csv
  rightofway table plan.json --decision 1
  rightofway table plan.json --all -o result.xlsx
"""


def _add_shown_options(command: Callable[..., Any]) -> Callable[..., Any]:
    """Add the options that choose the shown part of a plan."""
    for option in (
        ticks_option,
        click.option("--robots", metavar="NAMES", help="Only these robots, with commas between."),
        click.option("--step", type=Time(), metavar="TIME",
                     help="Time from one column of the table to the next; a tick by default."),
        click.option("--to", "last", type=Time(), metavar="TIME", help="Last time shown."),
        click.option("--from", "first", type=Time(), default="0", metavar="TIME",
                     help="First time shown, in the scenario's unit, or in ticks with --ticks."),
    ):  # fmt: skip
        command = option(command)
    return command


@dataclass(frozen=True, slots=True, kw_only=True)
class _Shown:
    """The shown part of a plan, and how times are written."""

    first_tick: int
    last_tick: int | None
    robots: list[str] | None
    quantities: Quantities
    step: int


def _choose_shown(
    plan: Plan,
    *,
    first: Fraction,
    last: Fraction | None,
    robots: str | None,
    step: Fraction | None,
    in_ticks: bool,
) -> _Shown:
    from rightofway.report.quantities import format_decimal
    from rightofway.viz.table import end_of

    if step == 0:
        raise InputError.at("--step", "0 is not positive (give the time of a column)")
    quantities = choose_quantities(plan.scenario, in_ticks=in_ticks)
    names = [name.strip() for name in robots.split(",")] if robots else None
    tick = Fraction(1) if in_ticks else quantities.tick
    end = end_of(plan, names)
    if first > end * tick:
        message = f"everything has ended at {quantities.format_moment(end)} (give less)"
        raise InputError.at("--from", f"{format_decimal(first)} is too late: {message}")
    if last is not None and last < first:
        begin = format_decimal(first)
        message = f"{format_decimal(last)} is before --from, {begin} (give {begin} or more)"
        raise InputError.at("--to", message)
    return _Shown(
        first_tick=math.ceil(first / tick),
        last_tick=None if last is None else max(math.floor(last / tick), math.ceil(first / tick)),
        robots=names,
        quantities=quantities,
        step=1 if step is None else max(round(step / tick), 1),
    )


@click.command(epilog=TABLE_EXAMPLES, short_help="Print where each robot is at each time.")
@click.argument("plan", type=click.Path(), shell_complete=complete_files(*PLANS))
@add_foreign_options
@click.option("-o", "--output", metavar="FILE",
              callback=require_writable(".txt", ".csv", ".xlsx"),
              help="Write .txt, .csv or .xlsx; - writes CSV to standard output.")  # fmt: skip
@click.option("--events", is_flag=True,
              help="List each visit instead: robot, place, purpose, enter, leave,"
                   " waits for.")  # fmt: skip
@click.option("--decision", type=Whole(1), metavar="N",
              help="Show both movement groups of the planner's N-th decision.")  # fmt: skip
@click.option("--all", "everything", is_flag=True,
              help="Write everything to a workbook: summary, table, diagram, events, collisions,"
                   " decisions.")  # fmt: skip
@_add_shown_options
@as_json_option("table")
def table(
    *,
    plan: str,
    output: str | None,
    events: bool,
    decision: int | None,
    everything: bool,
    as_json: bool,
    **given: Any,
) -> None:
    """Print the time/space table of a PLAN: the vertex of each robot at each time.

    Planned rows show the routes of the plan without waits, and mark collisions. Such a route may
    have a detour that the robot would not take alone. Final rows are those of the plan. A long
    table is cut. A PLAN of - is standard input.
    """
    if events + everything + (decision is not None) > 1:
        raise click.UsageError("--all, --events and --decision are different: choose one")
    if everything and Path(output or "").suffix.lower() != ".xlsx":
        raise click.UsageError("--all is for a workbook (add -o FILE.xlsx)")
    if as_json and output == "-":
        raise click.UsageError("--json and -o - both go to standard output")
    if events and given["step"]:
        raise click.UsageError("--step is for the table, --events lists visits: choose one")
    opened = read_plan(plan)
    if everything:
        _write_all(opened, output or "", given)
        return
    if events:
        _show_events(opened, _choose_shown(opened, **given), output, as_json=as_json)
        return
    if decision is None:
        _put_table(
            _make_time_space_table(opened, _choose_shown(opened, **given)), output, as_json=as_json
        )
        return
    shown = _choose_shown(opened, **given)
    _print_groups(opened, decision, shown, output, as_json=as_json)


def _write_all(plan: Plan, path: str, given: dict[str, Any]) -> None:
    from rightofway.viz.table.result import write_result

    if any(given.values()):
        message = "--all writes everything (leave out --from, --to, --step, --robots and --ticks)"
        raise click.UsageError(message)
    write_result(plan, path)
    say_written(path)


def _make_time_space_table(plan: Plan, shown: _Shown) -> TimeSpaceTable:
    from rightofway.viz.table import make_table

    return make_table(
        plan,
        first_tick=shown.first_tick,
        last_tick=shown.last_tick,
        robots=shown.robots,
        quantities=shown.quantities,
        step=shown.step,
    )


def _put_table(
    table: TimeSpaceTable,
    output: str | None,
    *,
    as_json: bool,
    words: Sequence[str] = (),
    more: Mapping[str, Any] | None = None,
) -> None:
    """Write a table to a file by its ending, or print it between words; ``more`` is for JSON."""
    from rightofway.viz.table import as_csv, as_text, write_xlsx

    suffix = Path(output or "").suffix.lower()
    if output == "-":
        click.echo(as_csv(table), nl=False)
    elif output and suffix == ".xlsx":
        write_xlsx(table, output)
    elif output:
        _write(
            output,
            as_csv(table) if suffix == ".csv" else f"{as_text(table, measure_width(), None)}\n",
        )
    if output and output != "-":
        say_written(output)
    if as_json:
        put_json({**_make_table_data(table), **(more or {})})
    elif not output:
        texts = [*words[:1], as_text(table, measure_width()), *words[1:]]
        click.echo("\n\n".join(texts))


def _write(path: str, content: str | bytes) -> None:
    from rightofway.files import write_whole

    write_whole(path, content)


def _make_table_data(table: TimeSpaceTable) -> dict[str, Any]:
    """Return the table for programs: for each row its runs of equal cells."""
    return {
        "first_tick": table.first_tick,
        "last_tick": table.last_tick,
        **describe_clock(table.quantities),
        "rows": [
            {
                "robot": row.robot,
                "kind": row.kind,
                "runs": [
                    {"start": start, "end": end, "place": cell.place, "mark": cell.mark}
                    for start, end, cell in row.runs
                ],
            }
            for row in table.rows
        ],
    }


def describe_clock(quantities: Quantities) -> dict[str, Any]:
    """Return the unit of the times in a report for programs."""
    units = quantities.units
    return {
        "tick": format_number(quantities.tick),
        "units": units.to_document(),
    }


def _show_events(plan: Plan, shown: _Shown, output: str | None, *, as_json: bool) -> None:
    from rightofway.metrics import make_event_columns
    from rightofway.viz.table import choose_events, tabulate_events

    chosen = choose_events(
        plan, first_tick=shown.first_tick, last_tick=shown.last_tick, robots=shown.robots
    )
    listing = tabulate_events(plan, chosen, shown.quantities)
    if output:
        put_lists([listing], output)
    elif not as_json:
        click.echo(listing.as_text())
    if as_json:
        columns = make_event_columns(plan, chosen)
        exact = {"enter": "enter_tick", "leave": "leave_tick", "waits": "wait_ticks"}
        keys = [key for key in columns if key not in exact.values()]
        values = zip(*(columns[exact.get(key, key)] for key in keys), strict=True)
        rows = [dict(zip(keys, row, strict=True)) for row in values]
        put_json({**describe_clock(shown.quantities), "events": rows})


def put_lists(lists: Sequence[Listing], output: str) -> None:
    """Write lists by the ending of the file: all as sheets or text, the first one as CSV."""
    from rightofway.viz.table.workbook import make_sheets

    if output == "-":
        click.echo(lists[0].as_csv(), nl=False)
        return
    match Path(output).suffix.lower():
        case ".xlsx":
            _write(output, make_sheets(lists))
        case ".csv":
            _write(output, lists[0].as_csv())
        case _:
            _write(output, "\n\n".join(listing.as_text(None) for listing in lists) + "\n")
    say_written(output)


def _print_groups(
    plan: Plan, number: int, shown: _Shown, output: str | None, *, as_json: bool
) -> None:
    """Put the table of both movement groups of a decision, with their sums below it."""
    from rightofway.viz.table.groups import make_decision_table

    groups = make_decision_table(
        plan,
        number,
        robots=shown.robots,
        first_tick=shown.first_tick,
        last_tick=shown.last_tick,
        quantities=shown.quantities,
        step=shown.step,
    )
    decision = plan.run.decisions[number - 1]
    i, j = (plan.scenario.robots[robot].name for robot in decision.robots)
    place = PlaceNames(plan.scenario, numbered=True)(decision.vertices[0])
    moment = shown.quantities.format_moment(decision.tick)
    first = f"Decision {number}: {i} and {j} meet at {place} at {moment}."
    waits = plan.scenario.robots[decision.waits].name
    last = f"{waits} waits ({decision.level} level)."
    words = [first, "\n".join([*groups.sums, last])]
    _put_table(
        groups.table, output, as_json=as_json, words=words, more={"completions": groups.completions}
    )
