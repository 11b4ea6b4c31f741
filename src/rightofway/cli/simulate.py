"""``rightofway simulate``: a plan on a floor where robots are late."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from rightofway.cli.terminal import progress, put, put_json, read_plan, say, writable

if TYPE_CHECKING:
    from rightofway.execution import Outcome

__all__ = ["simulate"]

EXAMPLES = """\b
Examples:
  rightofway simulate plan.json
  rightofway simulate plan.json --delays exponential:0.1,stop:R1@5+20
  rightofway simulate plan.json --delays late.yaml --runs 100000 --json
  rightofway simulate plan.json --page late.html
"""


class _SimulateCommand(click.Command):
    """A command whose help lists what makes robots late."""

    def format_epilog(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the delays, then what else there is."""
        from rightofway.execution import CAUSES

        with formatter.section("Delays (times in time units; numbers may be fractions like 1/3)"):
            formatter.write_dl([one for cause in CAUSES.values() for one in cause.examples])
            formatter.write_paragraph()
            formatter.write_text("Several go with commas between, or in a YAML or JSON list.")
        super().format_epilog(ctx, formatter)


@click.command(cls=_SimulateCommand, epilog=EXAMPLES)
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
    from rightofway.execution import DEFAULT
    from rightofway.execution import simulate as run_on_the_floor

    texts = [text for one in delays or [DEFAULT] for text in _texts(one)]
    found = read_plan(plan)
    with progress() as told:
        outcome = run_on_the_floor(
            found, texts, runs, seed, switch=switch, replan=replan, report=told
        )
    if as_json:
        put_json(outcome.as_dict())
    else:
        from rightofway.cli.lateness import report

        put(report(outcome))
    if page:
        _write_page(outcome, page, outcome.typical() if run is None else run)
    return _end(outcome)


def _texts(delays: str) -> tuple[str, ...]:
    """Return delays as they were written, or those of a file that was named."""
    from rightofway.io import DELAY_FILES, load_delays

    return load_delays(delays) if delays.lower().endswith(DELAY_FILES) else (delays,)


def _write_page(outcome: Outcome, page: str, run: int) -> None:
    from rightofway.viz import write_page

    write_page(outcome.plan, page, actual=outcome.trace(run))
    say(f"wrote {page}: run {run} of {outcome.runs}")


def _end(outcome: Outcome) -> int:
    return 1 if outcome.collisions or outcome.deadlocks else 0
