"""``rightofway plan`` and ``rightofway improve``: a checked plan out."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from rightofway.cli.terminal import (
    ListingCommand,
    as_json_option,
    progress,
    put_json,
    read_scenario,
    say,
    seed_option,
    time_limit_option,
    width,
    writable,
)
from rightofway.planners import DEFAULT, IMPROVER, PlannerSpec, find, registered

if TYPE_CHECKING:
    from rightofway.model import Plan

SECONDS_PER_VISIT = 1.7e-6
"""The time to judge a plan, to write it and to report on it, for each visit that it has at least.
Planning ends so much earlier, so that the time limit holds for the whole command."""

PLAN_EXAMPLES = """\b
Examples:
  rightofway plan examples/door.yaml --show door.html
  rightofway plan examples/warehouse.yaml -o plan.json --log
  rightofway plan examples/paper/door-5.yaml --planner paper --log --table
"""

IMPROVE_EXAMPLES = """\b
Examples:
  rightofway improve plan.json -o better.json
  rightofway improve plan.json --planner local-search --option rounds=1000
"""


def _list_planners(specs: Iterable[PlannerSpec], formatter: click.HelpFormatter) -> None:
    lines: list[tuple[str, str]] = []
    for spec in specs:
        lines.append((spec.name, spec.summary))
        lines += [(f"  {option.name}={option.accepts}", option.summary) for option in spec.options]
    with formatter.section("Planners and their options"):
        formatter.write_dl(lines)


def _list_all(formatter: click.HelpFormatter) -> None:
    _list_planners(registered().values(), formatter)


def _list_improvers(formatter: click.HelpFormatter) -> None:
    _list_planners((spec for spec in registered().values() if spec.improves), formatter)


def _options(
    _context: click.Context, _parameter: click.Parameter, given: Sequence[str]
) -> dict[str, str]:
    pairs = [text.partition("=") for text in given]
    for name, sign, _ in pairs:
        if not (name and sign):
            raise click.BadParameter(f"{name!r} is not name=value (for example swaps=leave)")
    return {name: value for name, _, value in pairs}


def _planning_options(planner: str) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Return a decorator that adds the options of `_run` to a command."""
    options: list[Callable[[Callable[..., Any]], Callable[..., Any]]] = [
        click.option("-o", "--output", metavar="PLAN", callback=writable(),
                     help="Write the plan to this file (JSON); - for standard output."),
        click.option("--planner", default=planner, show_default=True, metavar="NAME",
                     help="Planner to use; see below."),
        click.option("--option", "options", multiple=True, metavar="NAME=VALUE", callback=_options,
                     help="Set an option of the planner; may be repeated."),
        time_limit_option,
        seed_option,
        click.option("--show", "page", metavar="PAGE", callback=writable(".html", ".htm"),
                     help="Write a page that plays the plan (HTML)."),
        click.option("--log", is_flag=True,
                     help="Print every decision: which robot waits, where and why."),
        click.option("--table", is_flag=True, help="Print the time/space table."),
        as_json_option("summary"),
    ]  # fmt: skip

    def add_to(command: Callable[..., Any]) -> Callable[..., Any]:
        for option in reversed(options):
            command = option(command)
        return command

    return add_to


@click.command(cls=ListingCommand, listing=_list_all, epilog=PLAN_EXAMPLES)
@click.argument("scenario", type=click.Path())
@_planning_options(DEFAULT)
def plan(*, scenario: str, **given: Any) -> int:
    """Plan a SCENARIO (YAML, JSON or .scen) and check the plan.

    Prints the costs of the plan, and which robots wait for which others. A SCENARIO of - is
    standard input.
    """
    from rightofway.solve import solve

    return _run(scenario, read_scenario, solve, **given)


@click.command(cls=ListingCommand, listing=_list_improvers, epilog=IMPROVE_EXAMPLES)
@click.argument("plan", type=click.Path())
@_planning_options(IMPROVER)
def improve(*, plan: str, **given: Any) -> int:
    """Improve a PLAN of any planner, and check the result.

    The result is never worse than the PLAN. A PLAN of - is standard input.
    """
    from rightofway.io import load_plan
    from rightofway.solve import improve as improved

    return _run(plan, load_plan, improved, **given)


def _run(
    source: str,
    read: Callable[[str], Any],
    search: Callable[..., Plan],
    *,
    output: str | None,
    planner: str,
    options: dict[str, str],
    time_limit: float | None,
    seed: int,
    page: str | None,
    log: bool,
    table: bool,
    as_json: bool,
) -> int:
    """Read, plan, write and report; return the exit code."""
    began = time.monotonic()
    words = "--log" if log else "--table" if table else None
    if words and output == "-":
        raise click.UsageError(f"{words} and -o - both go to standard output")
    if words and as_json:
        raise click.UsageError(f"{words} is for people, --json for programs: choose one")
    refuse_outputs(source, output, as_json=as_json)
    problem = read(source)
    if time_limit is not None:
        time_limit = max(time_limit - (time.monotonic() - began), time_limit / 2)
    with progress() as report:
        found = search(
            problem,
            planner,
            time_limit,
            seed,
            options=options,
            report=report,
            keep_best=True,
            seconds_per_visit=SECONDS_PER_VISIT,
        )
    write(found, output)
    if page:
        from rightofway.viz import write_page

        write_page(found, page)
        say(f"wrote {page} (open it in a browser)")
    if output != "-":
        _report(found, log=log, table=table, as_json=as_json)
    may_hold_swaps = find(planner).leaves_swaps or found.run.options.get("swaps") == "leave"
    if not may_hold_swaps:
        return 0
    from rightofway.check import check

    # Only swaps that the published method leaves are faults; other plans are checked already.
    judged = check(found)
    if judged.ok:
        return 0
    say(f"the plan still has {judged.summary} (--planner two-level has none)")
    return 1


def refuse_outputs(source: str, output: str | None, *, as_json: bool) -> None:
    """Refuse two documents on standard output, and an output that would replace the source."""
    if output == "-" and as_json:
        raise click.UsageError("--json and -o - both go to standard output")
    if output and output != "-" and Path(output).resolve() == Path(source).resolve():
        raise click.UsageError(f"-o {output} would replace {source} (give another name)")


def write(found: Plan, output: str | None) -> None:
    """Write a plan to a file, to standard output, or nowhere."""
    from rightofway.io import plan_text, write_plan

    if output == "-":
        click.echo(plan_text(found).rstrip("\n"))
    elif output:
        write_plan(found, output)
        say(f"wrote {output}")


def _report(found: Plan, *, log: bool, table: bool, as_json: bool) -> None:
    from rightofway.cli.plan_report import decision_log, summary, summary_data

    if as_json:
        put_json(summary_data(found))
        return
    click.echo(summary(found))
    if log:
        click.echo("\n" + decision_log(found))
    if table:
        from rightofway.viz.table import as_text, table_of

        click.echo("\n" + as_text(table_of(found), width()))
