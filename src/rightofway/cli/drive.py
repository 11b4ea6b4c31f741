"""``rightofway drive``: a plan driven by robots, by right of way."""

from __future__ import annotations

import math
import time

import click

from rightofway.cli.completion import PLANS, files
from rightofway.cli.inputs import foreign_options, read_plan
from rightofway.cli.options import (
    ListingCommand,
    as_json_option,
    delay_texts,
    delays_option,
    list_delays,
    quantities_of,
    seed_option,
    ticks_option,
)
from rightofway.cli.outputs import page_option
from rightofway.cli.terminal import file_title, put_json, put_report, say

EXAMPLES = """\b
Examples:
  rightofway drive plan.json --demo
  rightofway drive plan.json --demo --delays exponential:0.5 --time-scale 1
  rightofway drive plan.json --demo --time-scale inf --json
  rightofway drive laps.json --demo --laps inf
  rightofway drive plan.json --demo --delays stop:R1@5+20 --page driven.html
"""


def _factor(_context: click.Context, _parameter: click.Parameter, given: float) -> float:
    if not given > 0:
        raise click.BadParameter(f"{given:g} is not positive (give a factor, or inf for no pause)")
    return given


def _count(_context: click.Context, _parameter: click.Parameter, given: str | None) -> int | None:
    """Return a number of laps, 0 for laps without end, None where the plan is driven once."""
    if given is None:
        return None
    if given == "inf":
        return 0
    if not given.isdecimal() or not int(given):
        raise click.BadParameter(f"{given!r} is no number of laps (give 1 or more, or inf)")
    return int(given)


@click.command(
    cls=ListingCommand,
    listing=list_delays,
    epilog=EXAMPLES,
    short_help="Have robots drive a PLAN by right of way (VDA 5050).",
)
@click.argument("plan", type=click.Path(), shell_complete=files(*PLANS))
@foreign_options
@click.option("--demo", is_flag=True,
              help="Have simulated robots drive it, in this process and without a network.",
              )  # fmt: skip
@click.option("--time-scale", type=float, default=10, show_default=True, callback=_factor,
              metavar="FACTOR",
              help="Seconds of the plan in each second, or its time units where it has no unit;"
              " inf for no pause.")  # fmt: skip
@delays_option("none")
@seed_option
@click.option("--laps", metavar="COUNT", callback=_count,
              help="Repeat the plan until each robot has made COUNT laps; inf: until interrupted.",
              )  # fmt: skip
@page_option("what robots did beside the plan")
@ticks_option
@as_json_option("outcome")
def drive(
    *,
    plan: str,
    demo: bool,
    time_scale: float,
    delays: tuple[str, ...],
    seed: int,
    laps: int | None,
    page: str | None,
    in_ticks: bool,
    as_json: bool,
) -> int:
    """Have robots drive a PLAN by right of way, and tell what happens.

    Robots get orders of VDA 5050, whose released part grows when others have left: never by the
    clock. A late robot makes others wait; nothing collides. What happens goes to standard error,
    the report to standard output. A PLAN of - is standard input.
    """
    if laps is not None and page:
        raise click.UsageError("laps without end fill no page (leave out --page or --laps)")
    if not demo:
        raise click.UsageError("robots over a network are not there yet (give --demo)")
    from rightofway.control.demo import drive_demo
    from rightofway.control.report import report
    from rightofway.report.plan_data import measures

    opened = read_plan(plan)
    quantities = quantities_of(opened.scenario, in_ticks=in_ticks)
    clock, seconds = opened.scenario.problem.clock, opened.scenario.units.seconds
    began = time.monotonic()

    def wait_until(tick: int) -> None:
        if time_scale < math.inf:
            planned = float(clock.time(tick) * (seconds or 1)) / time_scale
            time.sleep(max(began + planned - time.monotonic(), 0))

    def narrate(tick: int, sentence: str) -> None:
        say(f"{quantities.cell(tick):>8}  {sentence}")

    outcome = drive_demo(
        opened, delay_texts(delays), seed, laps=laps, report=narrate, wait_until=wait_until
    )
    if as_json:
        put_json({**measures(opened.scenario), "seed": seed, **outcome.as_dict()})
    else:
        put_report(report(outcome, quantities))
    if page:
        from rightofway.viz import write_page

        write_page(opened, page, actual=outcome.trace, title=file_title(plan))
        say(f"wrote {page}")
    return 0
