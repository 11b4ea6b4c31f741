"""``rightofway shift``: a shift in simulation, in which jobs become known while robots drive."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING

import click

from rightofway.cli.completion import SCENARIOS, complete_files
from rightofway.cli.inputs import jobs_option, note_loaded
from rightofway.cli.options import (
    ListingCommand,
    Time,
    Whole,
    as_json_option,
    choose_quantities,
    delay_texts,
    list_delays,
    make_delays_option,
    read_positive,
    require_writable,
    seed_option,
    ticks_option,
)
from rightofway.cli.outputs import make_page_option, put_text, refuse_outputs
from rightofway.cli.terminal import (
    format_json,
    make_title,
    put_json,
    put_report,
    say_written,
    show_progress,
)

if TYPE_CHECKING:
    from rightofway.model import Scenario

EXAMPLES = """\b
Examples:
  rightofway shift warehouse.yaml --until 28800 --page shift.html
  rightofway shift warehouse.yaml --delays exponential:0.1,breaks:0.05
  rightofway shift league.json --until 500 --lead 0
  rightofway shift warehouse.yaml --known 600 --json
"""


def _read_round_time(_context: click.Context, _parameter: click.Parameter, given: str) -> float:
    return read_positive(given, "give seconds")


@click.command(
    cls=ListingCommand,
    listing=list_delays,
    epilog=EXAMPLES,
    short_help="Simulate a shift of a SCENARIO with jobs.",
)
@click.argument("scenario", type=click.Path(), shell_complete=complete_files(*SCENARIOS))
@jobs_option
@click.option("--until", type=Time(), metavar="T",
              help="End of the shift [time unit]; by default when all jobs are done.")  # fmt: skip
@click.option("--reveal", type=Whole(1), metavar="N",
              help="Jobs become known when they are among the first N unfinished ones; those with"
              " a robot are counted for each robot.")  # fmt: skip
@click.option("--known", metavar="FILE|T",
              help="When jobs become known: a CSV file with columns name and known, or how long"
              " before their earliest [time unit]; by default at their earliest.")  # fmt: skip
@make_delays_option("none")
@seed_option
@click.option("--round-time", default="1", show_default=True, callback=_read_round_time,
              metavar="SECONDS", help="How long the planning of a round may take.")  # fmt: skip
@click.option("--lead", type=Time(), metavar="T",
              help="How long robots drive while a round is planned [time unit]; 0: robots stand"
              " still meanwhile. By default as long as --round-time.")  # fmt: skip
@click.option("-o", "--output", metavar="FILE", callback=require_writable(".json"),
              help="Write the whole shift to this file (.json); - for standard output.",
              )  # fmt: skip
@make_page_option("the shift")
@ticks_option
@as_json_option("figures")
def shift(
    *,
    scenario: str,
    jobs: str | None,
    until: Fraction | None,
    reveal: int | None,
    known: str | None,
    delays: tuple[str, ...],
    seed: int,
    round_time: float,
    lead: Fraction | None,
    output: str | None,
    page: str | None,
    in_ticks: bool,
    as_json: bool,
) -> int:
    """Simulate a shift of a SCENARIO with jobs that become known while robots drive.

    Rounds plan the jobs that are known. Robots drive by right of way, perhaps with delays, and
    charge their batteries. A SCENARIO of - is standard input.
    """
    refuse_outputs(scenario, output, as_json=as_json)
    if reveal is not None and known is not None:
        raise click.UsageError("--reveal and --known both say when jobs become known (give one)")
    from rightofway.dispatch import Reveal, ShiftRules, run_shift
    from rightofway.dispatch.record_file import dump_shift
    from rightofway.execution.delays import delay_model_of, read_delays
    from rightofway.io import load_with_notes
    from rightofway.report.plan_data import describe_measures
    from rightofway.report.shift import make_shift_data, report_shift

    loaded = load_with_notes(scenario, jobs=jobs)
    opened = note_loaded(loaded, scenario)
    if opened.jobs is None:
        raise click.UsageError(f"{scenario} has no jobs (a shift needs jobs: [], at least)")
    clock = opened.problem.clock
    first = reveal if reveal is not None or known is not None else loaded.reveal
    causes = read_delays(delay_texts(delays), opened)
    rules = ShiftRules(
        until=None if until is None else clock.count_ticks(until),
        step=clock.count_ticks(max(Fraction(1), lead or Fraction(0))),
        lead=clock.count_ticks(_choose_lead(opened, round_time) if lead is None else lead),
        time_limit=round_time,
        seed=seed,
    )
    times = None if known is None else _read_known(known, opened)
    with show_progress() as reported:
        record = run_shift(
            opened,
            Reveal(opened.jobs, clock, known=times, first=first),
            rules,
            delays=delay_model_of(causes, opened) if causes else None,
            report=reported,
        )
    if as_json:
        put_json({**describe_measures(opened), **make_shift_data(record)})
    elif output != "-":
        put_report(report_shift(record, choose_quantities(opened, in_ticks=in_ticks)))
    if output:
        put_text(format_json(dump_shift(record)) + "\n", output)
    if page:
        from rightofway.viz import write_shift_page

        write_shift_page(record, page, title=make_title(scenario))
        say_written(page)
    return 0


def _choose_lead(scenario: Scenario, round_time: float) -> Fraction:
    """Return the time of a round in time units; a unit that is not known counts as a second."""
    seconds = scenario.units.seconds or Fraction(1)
    return Fraction(str(round_time)) / seconds


def _read_known(given: str, scenario: Scenario) -> Mapping[str, Fraction]:
    """Return when jobs become known [time unit], by their names."""
    from rightofway.kinds.table import NOT_NEGATIVE

    if given.lower().endswith(".csv"):
        return _read_known_times(Path(given), [job.name for job in scenario.jobs or ()])
    before = NOT_NEGATIVE.read_at("known", given)
    return {job.name: max(job.earliest - before, Fraction(0)) for job in scenario.jobs or ()}


def _read_known_times(path: Path, names: Sequence[str]) -> Mapping[str, Fraction]:
    from rightofway.errors import InputError, quote
    from rightofway.io.tables import read_csv
    from rightofway.kinds.table import NOT_NEGATIVE

    rows, locate = read_csv(path, ("known",))
    columns = {text.lower(): column for column, text in next(rows, (1, {}))[1].items()}
    if set(columns) != {"name", "known"}:
        raise InputError.at("known", f"{path} has not the headings name and known (give both)")
    times = {}
    for number, row in rows:
        name = row.get(columns["name"], "")
        if name not in names:
            message = f"{quote(name)} is no job of the scenario (take the row out)"
            raise InputError.at(locate(number, columns["name"]), message)
        at = locate(number, columns["known"])
        times[name] = NOT_NEGATIVE.read_at(at, row.get(columns["known"], ""))
    return times
