"""``rightofway laps``: what happens when everybody does it again."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from typing import TYPE_CHECKING

import click

from rightofway.cli.planning import refuse_bad_outputs, seconds, write
from rightofway.cli.terminal import progress, put, put_json, read_scenario, say, writable
from rightofway.cyclic.rules import RULES, TIMETABLE

if TYPE_CHECKING:
    from rightofway.cyclic import CyclicResult

__all__ = ["laps"]

EXAMPLE = """\b
Examples:
  rightofway laps examples/door.yaml
  rightofway laps examples/crossroad.yaml --rule two-level --json
  rightofway laps examples/door.yaml --rule timetable -o plan.json
  rightofway laps examples/bay.yaml --page laps.html
"""


def part(_context: click.Context, _parameter: click.Parameter, given: str) -> Fraction:
    """Take a part of a whole: 0.5, 1/2."""
    try:
        return Fraction(given)
    except (ValueError, ZeroDivisionError):
        raise click.BadParameter(f"{given!r} is not a number (for example 0.5 or 1/2)") from None


@click.command(epilog=EXAMPLE)
@click.argument("scenario", type=click.Path())
@click.option("--rule", type=click.Choice([*RULES, TIMETABLE]), default="first-come",
              show_default=True,
              help="Who goes first where two robots meet; timetable: most laps.")  # fmt: skip
@click.option("--routes", type=click.Choice(["clear", "direct", "shortest"]),
              help="How round trips are chosen.  [default: clear]")  # fmt: skip
@click.option("--time-limit", type=float, default=10, show_default=True, callback=seconds,
              metavar="SECONDS", help="When to stop; inf for never.")  # fmt: skip
@click.option(
    "--least-fairness",
    metavar="PART",
    default="0",
    show_default=True,
    callback=part,
    help="With timetable: the part of its laps alone that each robot makes at least.",
)
@click.option("--seed", type=int, default=0, show_default=True,
              help="With timetable: for what is drawn at random.")  # fmt: skip
@click.option("-o", "--output", metavar="PLAN", callback=writable(),
              help="Write the run as a plan of whole laps; - for standard output.")  # fmt: skip
@click.option("--page", metavar="FILE", callback=writable(".html"),
              help="Write a page that plays the laps.")  # fmt: skip
@click.option("--json", "as_json", is_flag=True, help="Print the result as JSON.")
def laps(
    *,
    scenario: str,
    rule: str,
    routes: str | None,
    time_limit: float | None,
    least_fairness: Fraction,
    seed: int,
    output: str | None,
    page: str | None,
    as_json: bool,
) -> int:
    """Let every robot of a SCENARIO repeat its round trip until the pattern repeats.

    Prints, for each group of robots that have to do with each other, how long it takes until the
    pattern repeats, its period, the mean lap of each robot, and who waits for whom, where and when.
    Exit code 1 if a group comes to a standstill, 3 if time ran out for one.

    Scenarios name no unit of time: throughput_per_hour of --json is laps in 3600 of it, so it is
    per hour where the unit is a second.
    """
    from rightofway.cli.laps_report import laps_data, laps_report
    from rightofway.cyclic import best_timetable, excerpt, plan_of, run_laps
    from rightofway.model.steady_state import within

    refuse_bad_outputs(scenario, output, log=False, table=False, as_json=as_json)
    if rule == TIMETABLE and routes:
        raise click.UsageError("--rule timetable chooses routes itself (leave out --routes)")
    problem = read_scenario(scenario)
    with progress() as report:
        if rule == TIMETABLE:
            run = best_timetable(
                problem,
                least_fairness=least_fairness,
                time_limit=time_limit,
                seed=seed,
                report=report,
            )
        else:
            ways = routes or "clear"
            run = run_laps(problem, rule, routes=ways, time_limit=time_limit, report=report)
    if output != "-":
        if as_json:
            put_json(laps_data(run))
        else:
            put(laps_report(run))
    if page:
        _write_page(run, page)
    if output:
        plan, steady = plan_of(run), excerpt(run)[1]
        write(replace(plan, steady=within(steady, list(map(len, plan.tracks)))), output)
    ends = {group.ends for group in run.groups}
    return 1 if "deadlock" in ends else 3 if "open" in ends else 0


def _write_page(run: CyclicResult, page: str) -> None:
    from rightofway.cyclic import excerpt
    from rightofway.viz import write_page

    plan, steady = excerpt(run)
    write_page(plan, page, steady=steady)
    say(f"wrote {page}")
