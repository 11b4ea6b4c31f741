"""``rightofway simulate``: a plan on a floor where robots are late."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from rightofway.cli.terminal import progress, put, put_json, read_plan, say, writable

if TYPE_CHECKING:
    from rightofway.floor import Outcome

__all__ = ["simulate"]

EPILOG = """\b
Delays (times in time units; numbers may be fractions like 1/3):
  exponential:0.2      everything takes longer, on average by 0.2 of its time
  uniform:0..0.5       longer by 0 to 0.5 of its time
  normal:0.1~0.05      by 0.1 of its time, with a standard deviation of 0.05
  chance:0.01x20       a stop of 20 with chance 0.01 in each visit
  breaks:0.05          each robot breaks down for ever with chance 0.05
  stop:R3@12           R3 breaks down for ever at time 12
  stop:R3@12+30        R3 stands still for 30 from time 12
  slow:R2x1.5          everything takes R2 1.5 times as long
  early:R1x0.8         everything takes R1 0.8 of its time
Several go with commas between, or in a YAML or JSON file with a list of them.

\b
Examples:
  rightofway simulate plan.json
  rightofway simulate plan.json --delays exponential:0.1,stop:R1@5+20
  rightofway simulate plan.json --delays late.yaml --runs 100000 --json
  rightofway simulate plan.json --page late.html
"""


@click.command(epilog=EPILOG)
@click.argument("plan", type=click.Path())
@click.option(
    "--delays",
    multiple=True,
    metavar="DELAYS",
    help="What makes robots late; may be repeated.  [default: exponential:0.2]",
)
@click.option(
    "--runs",
    type=click.IntRange(1),
    default=1000,
    show_default=True,
    metavar="N",
    help="How many runs.",
)
@click.option(
    "--seed",
    type=click.IntRange(0, 2**32 - 1),
    default=0,
    show_default=True,
    metavar="N",
    help="What delays are drawn from.",
)
@click.option(
    "--switch",
    is_flag=True,
    help="Switch rights of way on the way, where that is expected to help.",
)
@click.option(
    "--replan",
    is_flag=True,
    help="Plan what is left anew when the fleet has fallen behind and that is expected to help, "
    "and when a robot breaks down for ever.",
)
@click.option(
    "--page",
    metavar="FILE",
    callback=writable(".html"),
    help="Write a page that plays one run against the plan.",
)
@click.option(
    "--run",
    type=click.IntRange(0),
    metavar="K",
    help="Which run to play, from 0; without, the one in the middle by lateness.",
)
@click.option("--json", "as_json", is_flag=True, help="Print the outcome as JSON.")  # fmt: skip
def simulate(
    *,
    plan: str,
    delays: tuple[str, ...],
    runs: int,
    seed: int,
    switch: bool,
    replan: bool,
    page: str | None,
    run: int | None,
    as_json: bool,
) -> int:
    """Run a PLAN on a floor where robots are late.

    By right of way robots keep the order of the plan at every place, and forget its clock: they
    never collide nor deadlock, and exit code 1 says if they did. By the clock, to compare, each
    robot keeps its planned times as well as it can. A PLAN of - is standard input.
    """
    if run is not None and not 0 <= run < runs:
        raise click.UsageError(f"--run {run} is not among the {runs} runs (0 is the first)")
    from rightofway.floor import DEFAULT
    from rightofway.floor import simulate as run_on_the_floor

    found = read_plan(plan)
    with progress() as told:
        outcome = run_on_the_floor(
            found, delays or DEFAULT, runs, seed, switch=switch, replan=replan, report=told
        )
    if as_json:
        put_json(outcome.as_dict())
    else:
        from rightofway.cli.lateness import report

        put(report(outcome))
    if page:
        _write_page(outcome, page, outcome.typical() if run is None else run)
    return _end(outcome)


def _write_page(outcome: Outcome, page: str, run: int) -> None:
    from rightofway.viz import write_page

    write_page(outcome.plan, page, actual=outcome.happened(run))
    say(f"wrote {page}: run {run} of {outcome.runs}")


def _end(outcome: Outcome) -> int:
    return 1 if outcome.collisions or outcome.deadlocks else 0
