"""What commands that plan share: how planners are named and told, what becomes of a plan."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, fields
from functools import wraps
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from rightofway.cli.terminal import put, put_json, say, width, writable
from rightofway.planners import PlannerSpec, registered

if TYPE_CHECKING:
    from rightofway.model import Plan

__all__ = [
    "SECONDS_PER_VISIT",
    "Asked",
    "PlanningCommand",
    "hand_over",
    "options_of_planning",
    "refuse_bad_outputs",
    "seconds",
    "write",
]

SECONDS_PER_VISIT = 1e-6
"""The time to judge a plan, to write it and to report on it, for each visit that it has at least.
Planning ends so much earlier, so that the time limit holds for the whole command."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Asked:
    """What the options of a command that plans say, and when it was called [s]."""

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


class PlanningCommand(click.Command):
    """A command whose help lists the planners that it can use."""

    def format_epilog(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the planners, then what else there is."""
        with formatter.section("Planners and their options"):
            formatter.write_dl(list(_planners(self.can_use)))
        super().format_epilog(ctx, formatter)

    def can_use(self, _spec: PlannerSpec) -> bool:
        """Tell whether a planner is of use here."""
        return True


def _planners(can_use: Callable[[PlannerSpec], bool]) -> Iterator[tuple[str, str]]:
    for spec in filter(can_use, registered().values()):
        yield spec.name, spec.summary
        for option in spec.options:
            yield f"  {option.name}={option.accepts}", option.summary


def _options(
    _context: click.Context, _parameter: click.Parameter, given: Sequence[str]
) -> dict[str, str]:
    pairs = [text.partition("=") for text in given]
    for name, sign, _ in pairs:
        if not (name and sign):
            raise click.BadParameter(f"{name!r} is not name=value (for example swaps=leave)")
    return {name: value for name, _, value in pairs}


def seconds(_context: click.Context, _parameter: click.Parameter, given: float) -> float | None:
    """Take a time limit; None for no limit."""
    if not given > 0:
        raise click.BadParameter(f"{given:g} is not positive (give seconds, or inf for no limit)")
    return None if given == math.inf else given


def options_of_planning(planner: str) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Return a decorator that adds the options of a command that plans; it gets them as ``asked``.

    Parameters
    ----------
    planner
        The one used where none is named.
    """
    options = [
        click.option("-o", "--output", metavar="PLAN", callback=writable(),
                     help="Write the plan there; - for standard output."),
        click.option("--planner", default=planner, show_default=True, metavar="NAME",
                     help="Which planner to use."),
        click.option("--option", "options", multiple=True, metavar="NAME=VALUE", callback=_options,
                     help="Tell the planner something; may be repeated."),
        click.option("--time-limit", type=float, default=10, show_default=True, callback=seconds,
                     metavar="SECONDS", help="When to stop; inf for never."),
        click.option("--seed", type=click.IntRange(0, 2**32 - 1), default=0, show_default=True,
                     metavar="N", help="For planners that draw at random."),
        click.option("--show", "page", metavar="PAGE", callback=writable(".html", ".htm"),
                     help="Write a page that plays the plan (HTML)."),
        click.option("--log", is_flag=True,
                     help="Print every decision: who waits, where and why."),
        click.option("--table", is_flag=True, help="Print the time/space table."),
        click.option("--json", "as_json", is_flag=True, help="Print the summary as JSON."),
    ]  # fmt: skip

    def add_to(command: Callable[..., Any]) -> Callable[..., Any]:
        @wraps(command)
        def with_options(**given: Any) -> Any:
            said = [option.name for option in fields(Asked) if option.init]
            asked = Asked(**{name: given.pop(name) for name in said})
            return command(asked=asked, **given)

        for option in reversed(options):
            with_options = option(with_options)
        return with_options

    return add_to


def refuse_bad_outputs(
    source: str, output: str | None, *, log: bool, table: bool, as_json: bool
) -> None:
    """Refuse, before any work, results that would be lost or replace the source."""
    _refuse_two_results(output, log=log, table=table, as_json=as_json)
    if output and output != "-" and Path(output).resolve() == Path(source).resolve():
        raise click.UsageError(f"-o {output} would replace {source} (give another name)")


def hand_over(found: Plan, asked: Asked) -> int:
    """Write and report a plan; return the exit code."""
    write(found, asked.output, asked.page)
    if asked.output != "-":
        _report(found, asked)
    return _end(found)


def _refuse_two_results(output: str | None, *, log: bool, table: bool, as_json: bool) -> None:
    """Make sure that what programs read from standard output is one document."""
    words = "--log" if log else "--table" if table else None
    if output == "-" and (words or as_json):
        raise click.UsageError(f"{words or '--json'} and -o - both go to standard output")
    if as_json and words:
        raise click.UsageError(f"{words} is for people, --json for programs: choose one")


def write(found: Plan, output: str | None, page: str | None = None) -> None:
    """Write a plan, and a page that plays it, where they are asked for."""
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


def _report(found: Plan, asked: Asked) -> None:
    from rightofway.cli.log import decision_log
    from rightofway.cli.summary import summary, summary_data

    if asked.as_json:
        put_json(summary_data(found))
        return
    put(summary(found))
    if asked.log:
        put("\n" + decision_log(found))
    if asked.table:
        from rightofway.viz.table import as_text, table_of

        put("\n" + as_text(table_of(found), width()))


def _end(found: Plan) -> int:
    """Return 1 and say so where swaps were left in on request; the judge has passed all others."""
    from rightofway.check import check

    if found.run.options.get("swaps") != "leave":
        return 0
    report = check(found)
    if report.ok:
        return 0
    say(f"the plan still has {report.summary}; swaps=resolve takes them out")
    return 1
