"""``rightofway laps``: the cycle time of robots that repeat their round trips."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from fractions import Fraction

import click

from rightofway.cli.completion import SCENARIOS, complete_files, complete_words
from rightofway.cli.inputs import read_scenario
from rightofway.cli.options import (
    ListingCommand,
    as_json_option,
    choose_quantities,
    seed_option,
    ticks_option,
    time_limit_option,
)
from rightofway.cli.outputs import (
    make_page_option,
    plan_output_option,
    put_page,
    refuse_outputs,
    write,
)
from rightofway.cli.terminal import (
    choose_deadline,
    make_title,
    put_json,
    put_report,
    show_progress,
)

EXAMPLES = """\b
Examples:
  rightofway laps examples/door.yaml
  rightofway laps examples/crossroad.yaml --rule two-level --json
  rightofway laps examples/door.yaml --rule timetable -o plan.json
  rightofway laps examples/bay.yaml --page laps.html
"""


def _rules() -> Iterable[str]:
    from rightofway.cyclic import RULES, TIMETABLE

    return [*RULES, TIMETABLE]


def _list_rules(formatter: click.HelpFormatter) -> None:
    from rightofway.cyclic import RULES, TIMETABLE

    search = "no rule: a search for the orders of highest throughput"
    with formatter.section("Rules (which of two robots that meet goes first)"):
        formatter.write_dl([*RULES.items(), (TIMETABLE, search)])


def _read_share(_context: click.Context, _parameter: click.Parameter, given: str) -> Fraction:
    try:
        return Fraction(given)
    except (ValueError, ZeroDivisionError):
        raise click.BadParameter(f"{given!r} is not a number (for example 0.5 or 1/2)") from None


@click.command(
    cls=ListingCommand,
    listing=_list_rules,
    epilog=EXAMPLES,
    short_help="Find the cycle time of a fleet that repeats its work.",
)
@click.argument("scenario", type=click.Path(), shell_complete=complete_files(*SCENARIOS))
@click.option("--rule", metavar="RULE", default="first-come", show_default=True,
              shell_complete=complete_words(_rules),
              help="Rule that gives the right of way; see below.")  # fmt: skip
@click.option("--routes", metavar="ROUTES",
              shell_complete=complete_words(lambda: ("clear", "direct", "shortest")),
              help="Routes of the round trips. clear: avoid other robots; direct: avoid them less;"
              " shortest: do not avoid them.  [default: clear]")  # fmt: skip
@time_limit_option
@click.option("--least-fairness", metavar="SHARE", default="0", show_default=True,
              callback=_read_share,
              help="With --rule timetable: least laps of each robot, as a share (0 to 1) of the"
              " laps that it makes without the others.")  # fmt: skip
@seed_option
@plan_output_option("whole laps as a plan")
@make_page_option("the laps")
@ticks_option
@as_json_option("result")
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
    in_ticks: bool,
    as_json: bool,
) -> int:
    """Let every robot of a SCENARIO repeat its round trip until the motion is periodic.

    Prints for each group of robots that meet: the period, the mean lap of each robot, the waits
    with place and robot waited for, and the bottleneck. Exit code 1 if a group ends in a
    deadlock, 3 if time ran out for one.

    If a scenario has no unit of time, throughput_per_hour of --json is laps in 3600 time
    units.
    """
    from rightofway.cyclic import (
        RULES,
        TIMETABLE,
        find_best_timetable,
        make_excerpt,
        plan_of_laps,
        run_laps,
    )
    from rightofway.deadline import limit_work
    from rightofway.model.steady_state import keep_within
    from rightofway.report.laps import report_laps
    from rightofway.report.laps_data import make_laps_data

    refuse_outputs(scenario, output, as_json=as_json)
    if rule not in {*RULES, TIMETABLE}:
        known = ", ".join([*RULES, TIMETABLE])
        raise click.BadParameter(f"{rule!r} is not one of {known}", param_hint="--rule")
    if rule == TIMETABLE and routes:
        raise click.UsageError("--rule timetable chooses routes itself (leave out --routes)")
    deadline = choose_deadline(time_limit)
    with limit_work(deadline):
        problem = read_scenario(scenario)
    time_limit = deadline.measure_seconds_left()
    with show_progress(time_limit) as report:
        if rule == TIMETABLE:
            run = find_best_timetable(
                problem,
                least_fairness=least_fairness,
                time_limit=time_limit,
                seed=seed,
                report=report,
            )
        else:
            ways = routes or "clear"
            run = run_laps(problem, rule, routes=ways, time_limit=time_limit, report=report)
    if as_json:
        put_json(make_laps_data(run))
    elif output != "-":
        quantities = choose_quantities(problem, in_ticks=in_ticks)
        put_report(report_laps(run, quantities))
    if page:
        plan, steady = make_excerpt(run)
        put_page(plan, page, steady=steady, title=make_title(scenario))
    if output:
        plan, steady = plan_of_laps(run), make_excerpt(run)[1]
        write(replace(plan, steady=keep_within(steady, list(map(len, plan.tracks)))), output)
    ends = {group.ends for group in run.groups}
    return 1 if "deadlock" in ends else 3 if "open" in ends else 0
