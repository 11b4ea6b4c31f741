"""``rightofway drive``: a plan driven by robots, by right of way."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

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
    read_positive,
    seed_option,
    ticks_option,
)
from rightofway.cli.outputs import make_page_option, put_page
from rightofway.cli.terminal import (
    make_title,
    say,
    say_written,
)
from rightofway.control.command_line.broker_options import (
    Login,
    add_broker_options,
    add_look_ahead_option,
)
from rightofway.control.command_line.event_log import EventLog, Level, add_log_options
from rightofway.control.command_line.output import Output
from rightofway.control.command_line.watch import WatchPage, add_page_options

if TYPE_CHECKING:
    from rightofway.control.endpoints import Letter
    from rightofway.control.identities import Identity
    from rightofway.facts import Fact

EXAMPLES = """\b
Examples:
  rightofway drive plan.json --demo
  rightofway drive plan.json --demo --delays exponential:0.5 --time-scale 1
  rightofway drive laps.json --demo --laps inf
  rightofway drive plan.json --demo --delays stop:R1@5+20 --page driven.html
  rightofway drive plan.json --broker mqtt://hub --identities robots.yaml
  rightofway drive plan.json --demo --live
  rightofway drive plan.json --replay
  rightofway drive plan.json --report
  rightofway drive plan.json --dry-run --identities robots.yaml
"""


def _read_factor(_context: click.Context, _parameter: click.Parameter, given: str) -> float:
    remedy = "give a factor, or inf for no pause"
    return read_positive(given, remedy)


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
@click.argument("plan", type=click.Path(), shell_complete=complete_files(*PLANS))
@add_foreign_options
@click.option("--demo", is_flag=True,
              help="Drive simulated robots in this process, without a network.",
              )  # fmt: skip
@add_broker_options
@click.option("--journal", metavar="FILE",
              help="File with all events of the run: a start with the same journal continues it. By"
              " default the name of the plan with .journal.")  # fmt: skip
@click.option("--dry-run", is_flag=True,
              help="Open no connection: print the messages to robots that follow their orders, a"
              " topic and a message in each line.")  # fmt: skip
@click.option("--replay", is_flag=True,
              help="Drive no robots: serve the page of the journal of the plan, also while a"
              " control writes it; with --page, write the page to a file.")  # fmt: skip
@click.option("--report", is_flag=True,
              help="Drive no robots: print the report of the journal of the plan, also while a"
              " control writes it.")  # fmt: skip
@click.option("--live", is_flag=True,
              help="Serve a page that shows the robots and can hold them; after the drive it stays"
              " until Ctrl-C.")  # fmt: skip
@add_page_options
@click.option("--metrics", type=Whole(1, 65535), metavar="PORT",
              help="Serve metrics for Prometheus, and health for a supervisor, at this port of"
              " --host.")  # fmt: skip
@click.option("--stay", is_flag=True,
              help="Keep running when all robots are at the end of their routes.")  # fmt: skip
@click.option("--hold", is_flag=True,
              help="At a broker, begin a new journal with all robots on hold; `rightofway jobs` and"
              " the page release them.")  # fmt: skip
@click.option("--off", multiple=True, metavar="ROBOT",
              help="At a broker, begin a new journal without this robot of the plan, until it is"
              " placed. May be repeated.")  # fmt: skip
@add_look_ahead_option
@add_log_options
@click.option("--time-scale", default="10", show_default=True, callback=_read_factor,
              metavar="FACTOR",
              help="With --demo: seconds of the plan (time units, if it has no unit) that pass in"
              " one second; inf for no pause.")  # fmt: skip
@make_delays_option("none")
@seed_option
@click.option("--laps", metavar="COUNT", callback=_count,
              help="Repeat the laps of the plan until each robot has made COUNT; inf: until"
              " interrupted.")  # fmt: skip
@click.option("--switch", is_flag=True,
              help="Exchange rights of way when another order shortens the remaining drive of the"
              " fleet.")  # fmt: skip
@make_page_option(
    "the drive of a demo, or with --broker and --replay that of a journal, next to the plan"
)
@ticks_option
@as_json_option("outcome")
def drive(
    *,
    plan: str,
    demo: bool,
    login: Login,
    identities: str | None,
    journal: str | None,
    dry_run: bool,
    replay: bool,
    report: bool,
    live: bool,
    host: str,
    port: int | None,
    metrics: int | None,
    stay: bool,
    hold: bool,
    off: tuple[str, ...],
    look_ahead: int,
    log: str,
    log_level: Level,
    time_scale: float,
    delays: tuple[str, ...],
    seed: int,
    laps: int | None,
    switch: bool,
    page: str | None,
    in_ticks: bool,
    as_json: bool,
) -> int:
    """Drive robots along a PLAN by right of way, and report events.

    Robots get orders of VDA 5050. A further part of an order is released when the robots that go
    first have left it, never by the clock. A late robot makes others wait; nothing collides.
    Events go to standard error, the report to standard output. A PLAN of - is standard input.
    """
    if [demo, login.broker is not None, dry_run, replay, report].count(True) != 1:
        raise click.UsageError("give one of --broker, --demo, --dry-run, --replay and --report")
    if laps is not None and page:
        raise click.UsageError("laps without end fill no page (leave out --page or --laps)")
    _refuse_combinations(
        drives_robots=demo or login.broker is not None,
        has_broker=login.broker is not None,
        is_live=live,
        has_identities=identities is not None,
        begins_otherwise=hold or bool(off),
        has_journal_name=journal is not None
        or plan != "-"
        or not (replay or report or login.broker is not None),
    )
    from rightofway.control.identities import load_identities
    from rightofway.control.names import find_robot

    opened = read_plan(plan)
    names = [robot.name for robot in opened.scenario.robots]
    known = load_identities(identities, names) if identities else []
    for name in off:
        find_robot(names, name)  # or refuse it now
    journal_file = Path(journal) if journal else Path(plan).with_suffix(".journal")

    shown = WatchPage(plan=opened, title=make_title(plan), host=host, port=port)
    output = Output(
        page=page,
        shown=shown,
        is_live=live,
        quantities=choose_quantities(opened.scenario, in_ticks=in_ticks),
        as_json=as_json,
    )
    if replay:
        return _write_replay(journal_file, output)
    if report:
        return _report_journal(journal_file, output)
    if login.broker is not None:
        from rightofway.control.command_line.service import Service

        return Service(
            broker=login.make_broker(),
            identities=known,
            journal=journal_file,
            output=output,
            log=EventLog(scenario=opened.scenario, level=log_level, as_json=log == "json"),
            metrics=metrics,
            host=host,
            off=off,
            holds=hold,
            look_ahead=look_ahead,
        ).drive(laps=laps, switch=switch, stays=stay)
    if dry_run:
        from rightofway.control.demo import drive_demo

        drive_demo(opened, identities=known, watch=_show, look_ahead=look_ahead)
        return 0
    _drive_demo(
        known, journal, output, time_scale,
        delays=delay_texts(delays), seed=seed, laps=laps, switch=switch, stays=stay,
        look_ahead=look_ahead,
    )  # fmt: skip
    return 0


def _write_replay(journal: Path, output: Output) -> int:
    """Write the page of a journal, or serve it until Ctrl-C."""
    if output.page:
        output.shown.write(journal, output.page)
        say_written(output.page)
        return 0
    with output.shown.serve(journal, takes_orders=False):
        output.shown.wait_for_interrupt()
    return 0


def _report_journal(journal: Path, output: Output) -> int:
    """Print the report of a journal."""
    from rightofway.control.journal import JournalReader
    from rightofway.control.recording import Recording

    with closing(JournalReader(journal)) as reader:
        recording = Recording(output.shown.plan, reader)
        recording.read_on()
    output.report(recording.result)
    return 0


def _drive_demo(
    identities: list[Identity],
    journal: str | None,
    output: Output,
    time_scale: float,
    **options: Any,
) -> None:
    """Drive a plan with simulated robots; the options are those of `drive_demo`."""
    from rightofway.control.demo import drive_demo, make_pause
    from rightofway.report.facts import FactWriter

    shown, quantities = output.shown, output.quantities

    writer = FactWriter(shown.plan.scenario)

    def narrate(tick: int, fact: Fact) -> None:
        time = f"{quantities.format_point(tick):>8}"
        say(f"{time}  {writer.write(fact)}")

    with _keep_demo(shown if output.is_live else None, journal) as file:
        outcome = drive_demo(
            shown.plan,
            identities=identities,
            report=narrate,
            wait_until=make_pause(shown.plan, time_scale),
            journal=file,
            pace=None if math.isinf(time_scale) else time_scale,
            **options,
        )
        output.report(outcome, seed=options["seed"])
        if output.page:
            put_page(shown.plan, output.page, actual=outcome.trace, title=shown.title)
        if output.is_live:
            shown.wait_for_interrupt()


def _refuse_combinations(
    *,
    drives_robots: bool,
    has_broker: bool,
    is_live: bool,
    has_identities: bool,
    begins_otherwise: bool,
    has_journal_name: bool,
) -> None:
    """Refuse options that do not go together."""
    if is_live and not drives_robots:
        raise click.UsageError("--live goes with --broker and --demo (--replay is a page already)")
    if begins_otherwise and not has_broker:
        raise click.UsageError("--hold and --off go with --broker")
    if has_broker and not has_identities:
        raise click.UsageError("robots at a broker have identities (give --identities)")
    if not has_journal_name:
        raise click.UsageError("a plan from standard input has no name (give --journal)")


@contextmanager
def _keep_demo(page: WatchPage | None, journal: str | None) -> Iterator[Path | None]:
    """Yield the journal of a demo, if it has one; serve its page, if that is wanted."""
    if page is None:
        yield Path(journal) if journal else None
        return
    from rightofway.control.journal import SqliteJournal

    with TemporaryDirectory(prefix="rightofway-demo-") as folder:
        file = Path(journal or Path(folder) / "demo.journal")
        SqliteJournal(file).close()  # a page reads what is there
        with page.serve(file, takes_orders=True):
            yield file


def _show(letter: Letter) -> None:
    """Print a message that robots would be sent."""
    if letter.name in {"order", "instantActions"}:
        click.echo(f"{letter.topic} {letter.payload.decode()}")
