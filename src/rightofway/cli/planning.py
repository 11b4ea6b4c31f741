"""``rightofway plan`` and ``improve``: a checked plan out; ``bound``: what no plan can beat."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from functools import partial
from typing import TYPE_CHECKING, Any

import click

from rightofway.cli.completion import (
    PLANS,
    SCENARIOS,
    complete_files,
    complete_planner_options,
    complete_planners,
)
from rightofway.cli.inputs import (
    add_foreign_options,
    count_option,
    jobs_option,
    read_plan,
    read_scenario,
)
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
    complain,
    make_title,
    measure_width,
    put_json,
    put_report,
    say,
    show_progress,
)
from rightofway.errors import NoPlanExists
from rightofway.planners import DEFAULT_PLANNER, IMPROVER, Feature, PlannerSpec, find, find_all

if TYPE_CHECKING:
    from rightofway.deadline import Deadline
    from rightofway.model import ForcedLoss, Plan, Scenario
    from rightofway.report.quantities import Quantities

SECONDS_PER_VISIT = 2.2e-6
"""The time to judge a plan, to write it and to report on it, for each visit that it has at least.
Planning ends so much earlier, so that the time limit holds for the whole command."""

SECONDS_PER_LANE = 6e-6
"""The time to write a lane into the plan file, of a map that is no grid."""

GRACE = 0.5
"""The time that the report of a plan may take after the time limit [s]."""

SHARE_OF_PAIRS = 0.2
"""The part of the time of `bound` for what pairs of robots lose to each other."""

PLAN_EXAMPLES = """\b
Examples:
  rightofway plan examples/door.yaml --page door.html
  rightofway plan examples/warehouse.yaml -o plan.json --log
  rightofway plan examples/paper/door-5.yaml --planner paper --log --table
  rightofway plan changed.yaml --start plan.json -o better.json
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
        lines += [
            (f"  {option.name}={'|'.join(option.choices) or option.default}", option.summary)
            for option in spec.options
        ]
    with formatter.section("Planners and their options, with the defaults first"):
        formatter.write_dl(lines)


def _list_all(formatter: click.HelpFormatter) -> None:
    _list_planners(find_all().values(), formatter)


def _list_improvers(formatter: click.HelpFormatter) -> None:
    _list_planners(
        (spec for spec in find_all().values() if Feature.IMPROVES in spec.features), formatter
    )


def _read_options(
    _context: click.Context, _parameter: click.Parameter, given: Sequence[str]
) -> dict[str, str]:
    pairs = [text.partition("=") for text in given]
    for name, sign, _ in pairs:
        if not (name and sign):
            raise click.BadParameter(f"{name!r} is not name=value (for example swaps=leave)")
    return {name: value for name, _, value in pairs}


def _add_planning_options(planner: str) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Return a decorator that adds the options of `_run` to a command."""
    options: list[Callable[[Callable[..., Any]], Callable[..., Any]]] = [
        plan_output_option("the plan"),
        click.option("--planner", default=planner, show_default=True, metavar="NAME",
                     shell_complete=complete_planners(improving=planner == IMPROVER),
                     help="Planner to use; see below."),
        click.option("--option", "options", multiple=True, metavar="NAME=VALUE",
                     callback=_read_options,
                     shell_complete=complete_planner_options,
                     help="Set an option of the planner; may be repeated."),
        time_limit_option,
        seed_option,
        make_page_option("the plan"),
        click.option("--log", is_flag=True,
                     help="Print every decision: which robot waits, where and why."),
        click.option("--table", is_flag=True, help="Print the time/space table."),
        ticks_option,
        as_json_option("summary"),
    ]  # fmt: skip

    def add_to(command: Callable[..., Any]) -> Callable[..., Any]:
        for option in reversed(options):
            command = option(command)
        return command

    return add_to


@click.command(cls=ListingCommand, listing=_list_all, epilog=PLAN_EXAMPLES)
@click.argument("scenario", type=click.Path(), shell_complete=complete_files(*SCENARIOS))
@count_option
@jobs_option
@click.option("--start", type=click.Path(), metavar="PLAN", shell_complete=complete_files(*PLANS),
              help="Start from the PLAN of an earlier version of this SCENARIO.")  # fmt: skip
@_add_planning_options(DEFAULT_PLANNER)
def plan(*, scenario: str, count: int | None, jobs: str | None, **given: Any) -> int:
    """Plan a SCENARIO (YAML, JSON, .xlsx or .scen) and check the plan.

    Prints the costs of the plan and the waits with the robots waited for. A SCENARIO of - is
    standard input.
    """
    from rightofway.solve import solve

    return _run(scenario, partial(read_scenario, count=count, jobs=jobs), solve, **given)


@click.command(cls=ListingCommand, listing=_list_improvers, epilog=IMPROVE_EXAMPLES)
@click.argument("plan", type=click.Path(), shell_complete=complete_files(*PLANS))
@add_foreign_options
@_add_planning_options(IMPROVER)
def improve(*, plan: str, **given: Any) -> int:
    """Improve a PLAN of any planner, and check the result.

    The result is never worse than the PLAN. A PLAN of - is standard input.
    """
    from rightofway.solve import improve as improved

    return _run(plan, read_plan, improved, **given)


BOUND_EXAMPLES = """\b
Examples:
  rightofway bound examples/door.yaml
  rightofway bound maze.scen -k 100 --time-limit 60 --json
"""


@click.command(epilog=BOUND_EXAMPLES, short_help="Print the lower bounds of all plans.")
@click.argument("scenario", type=click.Path(), shell_complete=complete_files(*SCENARIOS))
@count_option
@ticks_option
@as_json_option("bounds")
@click.option(
    "--time-limit",
    type=click.FloatRange(min=0),
    metavar="SECONDS",
    help="Raise the bound of the flowtime by search until this time limit of the whole command.",
)
def bound(
    *, scenario: str, count: int | None, in_ticks: bool, as_json: bool, time_limit: float | None
) -> None:
    """Print lower bounds of the flowtime and makespan of all plans of a SCENARIO.

    Both follow from the completion times of the robots if each drove alone. With a time limit,
    conflict-based search and prices of places raise the bound of the flowtime. The report then
    lists robots that lose time to each other in every plan. A SCENARIO of - is standard input.
    """
    from rightofway.deadline import limit_work
    from rightofway.io.plan.writer import make_forced_losses
    from rightofway.metrics import compute_alone_completions, find_forced_losses
    from rightofway.repair.bounds import prove_bound
    from rightofway.report.plan import report_bounds
    from rightofway.report.plan_data import describe_measures

    deadline = choose_deadline(time_limit)
    with limit_work(deadline):
        problem = read_scenario(scenario, count)
    alone, names = compute_alone_completions(problem), [robot.name for robot in problem.robots]
    proof, is_reached = None, False
    losses: tuple[ForcedLoss, ...] = ()
    if time_limit is not None and not problem.problem.has_other_directions:
        share = deadline.shorten(SHARE_OF_PAIRS).measure_seconds_left()
        losses = find_forced_losses(problem, time_limit=share)
        proof, is_reached = prove_bound(problem, time_limit=deadline.measure_seconds_left())
    if as_json:
        robots = [{"name": name, "alone": ticks} for name, ticks in zip(names, alone, strict=True)]
        bounds = {"flowtime": sum(alone), "makespan": max(alone)}
        if proof is not None:
            bounds[proof.objective.value] = proof.bound
        forced: dict[str, Any] = {}
        if proof is not None:
            forced = {"forced_losses": [], **make_forced_losses(losses, problem)}
        put_json({**describe_measures(problem), "lower_bound": bounds, "robots": robots, **forced})
        return
    quantities = choose_quantities(problem, in_ticks=in_ticks)
    put_report(report_bounds(problem, quantities, proof, is_reached=is_reached, losses=losses))


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
    in_ticks: bool,
    as_json: bool,
    start: str | None = None,
) -> int:
    """Read, plan, write and report; return the exit code."""
    from rightofway.deadline import limit_work

    began = time.monotonic()
    words = "--log" if log else "--table" if table else None
    if words and output == "-":
        raise click.UsageError(f"{words} and -o - both go to standard output")
    if words and as_json:
        raise click.UsageError(f"{words} is for people, --json for programs: choose one")
    refuse_outputs(source, output, as_json=as_json)
    if start == source == "-":
        raise click.UsageError("SCENARIO and --start are both standard input: give one as a file")
    deadline = choose_deadline(time_limit)
    with limit_work(deadline):
        problem = read(source)
        if start is not None:
            search = partial(search, start=read_plan(start))
    blocked = write_no_plan(problem, page, make_title(source), as_json=as_json)
    with blocked, show_progress(time_limit, began) as report:
        plan = search(
            problem,
            planner,
            _reserve_time_to_write(deadline, problem).measure_seconds_left(),
            seed,
            options=options,
            report=report,
            keep_best=True,
            seconds_per_visit=SECONDS_PER_VISIT,
        )
    write(plan, output)
    if page:
        said = f"wrote {page} (open it in a browser)"
        put_page(plan, page, said=said, title=make_title(source))
    if output != "-":
        quantities = choose_quantities(plan.scenario, in_ticks=in_ticks)
        in_time = _has_time_for_lost_time(plan, deadline)
        _report(plan, quantities, log=log, table=table, as_json=as_json, with_lost_time=in_time)
    may_hold_swaps = (
        Feature.LEAVES_SWAPS in find(planner).features or plan.run.options.get("swaps") == "leave"
    )
    if not may_hold_swaps:
        return 0
    from rightofway.check import check
    from rightofway.report.judgement import summarize_report

    # Only swaps that the published method leaves are faults; other plans are checked already.
    judged = check(plan)
    if judged.ok:
        return 0
    complain(f"the plan still has {summarize_report(judged)} (--planner two-level has none)")
    return 1


def _reserve_time_to_write(deadline: Deadline, problem: Any) -> Deadline:
    """Return when planning must end, so that the map of a scenario or a plan is written in time."""
    scenario: Scenario = getattr(problem, "scenario", problem)
    lanes = scenario.roadmap.n_edges if scenario.roadmap.grid is None else 0
    return deadline.bring_forward(SECONDS_PER_LANE * lanes)


@contextmanager
def write_no_plan(problem: Any, page: str | None, title: str, *, as_json: bool) -> Iterator[None]:
    """Write why there is no plan as JSON and as a page of the blocked map, where asked for."""
    try:
        yield
    except NoPlanExists as error:
        if as_json:
            from rightofway.report.plan_data import make_no_plan_data

            put_json({"no_plan": error.as_dict(), "outcome": make_no_plan_data(error)})
        if page:
            from rightofway.repair.impossible import put_fleet_at_home
            from rightofway.viz import write_page

            write_page(put_fleet_at_home(problem), page, no_plan=error, title=title)
            say(f"wrote {page} (it shows where robots are blocked)")
        raise


def _has_time_for_lost_time(plan: Plan, deadline: Deadline) -> bool:
    """Return whether lost time can be computed before the time limit, or hardly later."""
    left = deadline.measure_seconds_left()
    return left is None or SECONDS_PER_VISIT * sum(map(len, plan.tracks)) <= left + GRACE


def _report(
    plan: Plan,
    quantities: Quantities,
    *,
    log: bool,
    table: bool,
    as_json: bool,
    with_lost_time: bool,
) -> None:
    from rightofway.report.plan import report_decisions, summarize_plan
    from rightofway.report.plan_data import make_summary_data

    if as_json:
        put_json(make_summary_data(plan))
        return
    text = summarize_plan(plan, quantities, with_lost_time=with_lost_time)
    put_report(text)
    if log:
        put_report("\n" + report_decisions(plan, quantities))
    if table:
        from rightofway.viz.table import as_text, make_table

        put_report("\n" + as_text(make_table(plan), measure_width()))
