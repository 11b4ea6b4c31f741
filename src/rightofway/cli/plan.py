"""``rightofway plan``: a scenario in, a checked plan out."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import click

from rightofway.cli.terminal import put, put_json, read_scenario, say
from rightofway.planners import registered

if TYPE_CHECKING:
    from rightofway.model import Plan

__all__ = ["plan"]


def _planners() -> str:
    lines = ["\b", "Planners and their options:"]
    for spec in registered().values():
        lines.append(f"  {spec.name}")
        lines += [f"    {option.name}={'|'.join(option.choices)}" for option in spec.options]
    return "\n".join(lines)


EXAMPLE = """\b
Examples:
  rightofway plan examples/door.yaml --show door.html
  rightofway plan examples/warehouse.yaml -o plan.json --log
"""


def _options(
    _context: click.Context, _parameter: click.Parameter, given: Sequence[str]
) -> dict[str, str]:
    pairs = [text.partition("=") for text in given]
    for name, sign, _ in pairs:
        if not (name and sign):
            raise click.BadParameter(f"{name!r} is not name=value (for example swaps=leave)")
    return {name: value for name, _, value in pairs}


@click.command(epilog=f"{_planners()}\n\n{EXAMPLE}")
@click.argument("scenario", type=click.Path())
@click.option("-o", "--output", metavar="PLAN", help="Write the plan there; - for standard output.")
@click.option("--planner", default="auto", show_default=True, help="Which planner to use.")
@click.option(
    "--option", "options", multiple=True, metavar="NAME=VALUE", callback=_options,
    help="Tell the planner something; may be repeated.",
)  # fmt: skip
@click.option(
    "--time-limit", type=click.FloatRange(min=0, min_open=True), default=10, show_default=True,
    metavar="SECONDS", help="When to stop.",
)  # fmt: skip
@click.option("--seed", type=click.IntRange(0, 2**32 - 1), default=0, show_default=True,
              help="For planners that draw at random.")  # fmt: skip
@click.option("--show", "page", metavar="PAGE", help="Write a page that plays the plan (HTML).")
@click.option("--log", is_flag=True, help="Print every decision: who waits, where and why.")
@click.option("--table", is_flag=True, help="Print the time/space table.")
@click.option("--json", "as_json", is_flag=True, help="Print the summary as JSON.")
def plan(
    *,
    scenario: str,
    output: str | None,
    planner: str,
    options: dict[str, str],
    time_limit: float,
    seed: int,
    page: str | None,
    log: bool,
    table: bool,
    as_json: bool,
) -> int:
    """Plan a SCENARIO (YAML, JSON or .scen) and check the plan."""
    from rightofway.solve import solve

    found = solve(
        read_scenario(scenario), planner,
        options=options, time_limit=time_limit, seed=seed, report=say,
    )  # fmt: skip
    _write(found, output, page)
    if output != "-":
        _report(found, log=log, table=table, as_json=as_json)
    return _end(found)


def _write(found: Plan, output: str | None, page: str | None) -> None:
    from rightofway.io import plan_text, save_plan

    if output == "-":
        put(plan_text(found).rstrip("\n"))
    elif output:
        save_plan(found, output)
        say(f"wrote {output}")
    if page:
        from rightofway.viz import write_page

        write_page(found, page)
        say(f"wrote {page} (open it in a browser)")


def _report(found: Plan, *, log: bool, table: bool, as_json: bool) -> None:
    from rightofway.cli.words import decision_log, summary, summary_data

    if as_json:
        put_json(summary_data(found))
        return
    put(summary(found))
    if log:
        put("\n" + decision_log(found))
    if table:
        from rightofway.viz.table import as_text, table_of

        put("\n" + as_text(table_of(found)))


def _end(found: Plan) -> int:
    """Return 1 and say so where swaps were left in on request."""
    from rightofway.check import check

    report = check(found)
    if report.ok:
        return 0
    say(f"the plan still has {report.summary}; swaps=resolve takes them out")
    return 1
