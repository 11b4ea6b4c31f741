"""``rightofway simulate``: a plan executed many times by robots that are late."""

from __future__ import annotations

import click

from rightofway.cli.completion import PLANS, complete_files
from rightofway.cli.inputs import add_foreign_options, read_plan
from rightofway.cli.options import (
    ListingCommand,
    Whole,
    as_json_option,
    choose_quantities,
    delay_texts,
    list_delays,
    make_delays_option,
    seed_option,
    ticks_option,
)
from rightofway.cli.outputs import make_output_option, make_page_option, put_page, put_text
from rightofway.cli.terminal import (
    format_json,
    make_title,
    put_json,
    put_report,
    show_progress,
)

EXAMPLES = """\b
Examples:
  rightofway simulate plan.json
  rightofway simulate plan.json --delays exponential:0.1,stop:R1@5+20
  rightofway simulate plan.json --delays late.yaml --runs 100000 --json
  rightofway simulate plan.json --page late.html
"""


@click.command(
    cls=ListingCommand,
    listing=list_delays,
    epilog=EXAMPLES,
    short_help="Execute a PLAN many times with random delays.",
)
@click.argument("plan", type=click.Path(), shell_complete=complete_files(*PLANS))
@add_foreign_options
@make_delays_option("exponential:0.2")
@click.option("--runs", type=Whole(1), default=1000, show_default=True, metavar="N",
              help="Number of runs.")  # fmt: skip
@seed_option
@click.option("--switch", is_flag=True,
              help="Let an early robot go before a late one if this is expected to"
              " save time.")  # fmt: skip
@click.option("--replan", is_flag=True,
              help="Replan the remaining routes if this is expected to save time, and when a robot"
              " breaks down permanently.")  # fmt: skip
@make_output_option("the outcome", ".json")
@make_page_option("one run next to the plan")
@click.option("--run", type=Whole(0), metavar="K",
              help="Run that the page plays, from 0; by default the one of median lateness.",
              )  # fmt: skip
@ticks_option
@as_json_option("outcome")
def simulate(
    *,
    plan: str,
    delays: tuple[str, ...],
    runs: int,
    seed: int,
    switch: bool,
    replan: bool,
    output: str | None,
    page: str | None,
    run: int | None,
    in_ticks: bool,
    as_json: bool,
) -> int:
    """Execute a PLAN many times with random delays, and report the lateness.

    Two ways of execution are compared. By right of way, robots keep the order of the plan at each
    place and ignore its clock: they can neither collide nor deadlock (exit code 1 if they did). By
    the clock, each robot keeps its planned times as well as it can. A PLAN of - is standard input.
    """
    if run is not None and not 0 <= run < runs:
        raise click.UsageError(f"--run {run} is not among the {runs} runs (0 is the first)")
    from rightofway.execution import DEFAULT_DELAYS
    from rightofway.execution import simulate as execute
    from rightofway.report.execution import report
    from rightofway.report.plan_data import describe_measures

    texts = delay_texts(delays or [DEFAULT_DELAYS])
    opened = read_plan(plan)
    with show_progress() as reported:
        outcome = execute(opened, texts, runs, seed, switch=switch, replan=replan, report=reported)
    data = {**describe_measures(opened.scenario), **outcome.as_dict()}
    if as_json or output == "-":
        put_json(data)
    else:
        quantities = choose_quantities(opened.scenario, in_ticks=in_ticks)
        put_report(report(outcome, quantities))
    if output not in {None, "-"}:
        put_text(format_json(data) + "\n", str(output))
    if page:
        played = outcome.find_typical_run() if run is None else run
        trace = outcome.trace(played)
        said = f"wrote {page}: run {played} of {outcome.runs}"
        put_page(outcome.plan, page, said=said, actual=trace, title=make_title(plan))
    return 1 if outcome.collisions or outcome.deadlocks else 0
