"""Options and results that ``plan`` and ``improve`` share."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from rightofway.cli.terminal import (
    as_json_option,
    put,
    put_json,
    say,
    seed_option,
    time_limit_option,
    width,
    writable,
)
from rightofway.planners import PlannerSpec, registered

if TYPE_CHECKING:
    from rightofway.model import Plan

__all__ = [
    "SECONDS_PER_VISIT",
    "Asked",
    "PlanningCommand",
    "hand_over",
    "planning_options",
    "refuse_outputs",
    "write",
]

SECONDS_PER_VISIT = 0.9e-6
"""The time to judge a plan, to write it and to report on it, for each visit that it has at least.
Planning ends so much earlier, so that the time limit holds for the whole command."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Asked:
    """The values of `planning_options`, and when the command began [s]."""

    output: str | None
    planner: str
    options: dict[str, str]
    time_limit: float | None
    seed: int
    page: str | None
    log: bool
    table: bool
    as_json: bool
    began: float = field(default_factory=time.monotonic, init=False)

    @property
    def time_left(self) -> float | None:
        """What the time limit leaves for planning, after reading; at least half of it [s]."""
        if self.time_limit is None:
            return None
        return max(self.time_limit - (time.monotonic() - self.began), self.time_limit / 2)

    def refuse_outputs(self, source: str) -> None:
        """Refuse, before any work, results that would be lost or replace the source."""
        words = "--log" if self.log else "--table" if self.table else None
        if words and self.output == "-":
            raise click.UsageError(f"{words} and -o - both go to standard output")
        if words and self.as_json:
            raise click.UsageError(f"{words} is for people, --json for programs: choose one")
        refuse_outputs(source, self.output, as_json=self.as_json)


class PlanningCommand(click.Command):
    """A command whose help lists the planners that it can use."""

    def __init__(self, *args: Any, only_improvers: bool = False, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self.only_improvers = only_improvers

    def format_epilog(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the planners with their options, then the examples."""
        specs = [each for each in registered().values() if each.improves or not self.only_improvers]
        with formatter.section("Planners and their options"):
            formatter.write_dl([line for spec in specs for line in _described(spec)])
        super().format_epilog(ctx, formatter)


def _described(spec: PlannerSpec) -> list[tuple[str, str]]:
    options = [(f"  {option.name}={option.accepts}", option.summary) for option in spec.options]
    return [(spec.name, spec.summary), *options]


def _options(
    _context: click.Context, _parameter: click.Parameter, given: Sequence[str]
) -> dict[str, str]:
    pairs = [text.partition("=") for text in given]
    for name, sign, _ in pairs:
        if not (name and sign):
            raise click.BadParameter(f"{name!r} is not name=value (for example swaps=leave)")
    return {name: value for name, _, value in pairs}


def planning_options(planner: str) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Return a decorator that adds the options of `Asked` to a command.

    Parameters
    ----------
    planner
        The default planner.
    """
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


def refuse_outputs(source: str, output: str | None, *, as_json: bool) -> None:
    """Refuse two documents on standard output, and an output that would replace the source."""
    if output == "-" and as_json:
        raise click.UsageError("--json and -o - both go to standard output")
    if output and output != "-" and Path(output).resolve() == Path(source).resolve():
        raise click.UsageError(f"-o {output} would replace {source} (give another name)")


def hand_over(found: Plan, asked: Asked) -> int:
    """Write and report a plan; return the exit code."""
    write(found, asked.output)
    if asked.page:
        from rightofway.viz import write_page

        write_page(found, asked.page)
        say(f"wrote {asked.page} (open it in a browser)")
    if asked.output != "-":
        _report(found, asked)
    return _exit_code(found)


def write(found: Plan, output: str | None) -> None:
    """Write a plan to a file, to standard output, or nowhere."""
    from rightofway.io import plan_text, write_plan

    if output == "-":
        put(plan_text(found).rstrip("\n"))
    elif output:
        write_plan(found, output)
        say(f"wrote {output}")


def _report(found: Plan, asked: Asked) -> None:
    from rightofway.cli.plan_report import decision_log, summary, summary_data

    if asked.as_json:
        put_json(summary_data(found))
        return
    put(summary(found))
    if asked.log:
        put("\n" + decision_log(found))
    if asked.table:
        from rightofway.viz.table import as_text, table_of

        put("\n" + as_text(table_of(found), width()))


def _exit_code(found: Plan) -> int:
    """Return 1, and say why, where swaps were left in on request; other plans are checked."""
    from rightofway.check import check

    if found.run.options.get("swaps") != "leave":
        return 0
    report = check(found)
    if report.ok:
        return 0
    say(f"the plan still has {report.summary}; swaps=resolve takes them out")
    return 1
