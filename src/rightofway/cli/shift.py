"""``rightofway shift``: a shift in simulation, in which jobs become known while robots drive."""

from __future__ import annotations

from fractions import Fraction

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
    seed_option,
    ticks_option,
)
from rightofway.cli.outputs import make_output_option, make_page_option, put_text, refuse_outputs
from rightofway.cli.terminal import (
    format_json,
    make_title,
    put_json,
    put_report,
    say_written,
    show_progress,
)

EXAMPLES = """\b
Examples:
  rightofway shift warehouse.yaml --until 28800 --page shift.html
  rightofway shift warehouse.yaml --delays exponential:0.1,breaks:0.05
  rightofway shift league.json --until 500 --lead 0
  rightofway shift warehouse.yaml --known poisson:1/30 --seed 7 --json
"""


def _read_round_time(_context: click.Context, _parameter: click.Parameter, given: str) -> float:
    return read_positive(given, "give seconds")


def _list_known_and_delays(formatter: click.HelpFormatter) -> None:
    from rightofway.dispatch.known import ARRIVALS

    rows = [
        ("600", "this long before their earliest [time unit]"),
        ("known.csv", "at the times of a CSV file with columns name and known"),
        *((arrivals.example, arrivals.meaning) for arrivals in ARRIVALS.values()),
    ]
    with formatter.section("When jobs become known"):
        formatter.write_dl(rows)
        formatter.write_paragraph()
        formatter.write_text(
            "With a distribution, jobs arrive in the order of the scenario. Their earliest is then"
            " when they become known; due and latest keep their distance from it."
        )
    list_delays(formatter)


@click.command(
    cls=ListingCommand,
    listing=_list_known_and_delays,
    epilog=EXAMPLES,
    short_help="Simulate a shift of a SCENARIO with jobs.",
)
@click.argument("scenario", type=click.Path(), shell_complete=complete_files(*SCENARIOS))
@jobs_option
@click.option("--until", type=Time(), metavar="T",
              help="End of the shift [time unit]; by default when all jobs are done.")  # fmt: skip
@click.option("--reveal", type=Whole(1), metavar="N",
              help="A job becomes known when it is among the first N unfinished jobs; jobs with a"
              " robot are counted for each robot.")  # fmt: skip
@click.option("--known", metavar="KNOWN",
              help="Times at which jobs become known, see below; by default at their"
              " earliest.")  # fmt: skip
@make_delays_option("none")
@seed_option
@click.option("--round-time", default="1", show_default=True, callback=_read_round_time,
              metavar="SECONDS", help="Time limit of the planning of a round.")  # fmt: skip
@click.option("--lead", type=Time(), metavar="T",
              help="Time that robots drive by the old plan while a round is planned [time unit]; 0:"
              " they do not move. By default the same as --round-time.")  # fmt: skip
@make_output_option("the whole shift", ".json")
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
    from rightofway.dispatch import ShiftSettings
    from rightofway.dispatch.record_file import dump_shift
    from rightofway.io import load_with_notes
    from rightofway.report.plan_data import describe_measures
    from rightofway.report.shift import make_shift_data, report_shift

    loaded = load_with_notes(scenario, jobs=jobs)
    opened = note_loaded(loaded, scenario)
    if opened.jobs is None:
        raise click.UsageError(f"{scenario} has no jobs (a shift needs jobs: [], at least)")
    settings = ShiftSettings(
        until=until,
        reveal=reveal if reveal is not None or known is not None else loaded.reveal,
        known=known,
        delays=tuple(delay_texts(delays)),
        round_time=round_time,
        lead=lead,
        seed=seed,
    )
    with show_progress() as reported:
        record = settings.simulate(opened, report=reported)
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
