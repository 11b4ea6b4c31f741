"""``rightofway jobs``: jobs, closures and holds for robots that drive."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from rightofway.cli.options import Whole, as_json_option
from rightofway.cli.terminal import put_json, put_report, say
from rightofway.errors import InputError
from rightofway.units import is_clock_time

if TYPE_CHECKING:
    from rightofway.control.commands import Answer

NO_ANSWER = "no answer within {wait:g} s: it is carried out when the control runs"

ACTIONS = {
    "list": "list jobs that are not done",
    "add": "add a job: --at, or --from and --to; perhaps with a NAME, a time and --robot",
    "change": "change a job NAME that is not begun: its places and times",
    "withdraw": "take back a job NAME that is not begun",
    "again": "have a robot do a job NAME again that has failed",
    "skip": "give up a job NAME that has failed: its robot goes on without it",
    "close": "let no robot enter the vertex NAME, or the lane from NAME to --to",
    "open": "open it again",
    "hold": "release nothing more to the robot NAME, or to all",
    "stop": "hold, and have the robot NAME, or all, pause where they are (startPause)",
    "go": "release again to the robot NAME, or to all, and end their pause",
    "seen": "note that the person NAME has seen the alarms that last",
    "cancel": "take back what is released to the robot NAME, as far as it can stop before",
    "clear": "confirm that the faulty robot NAME is where the journal has it",
    "remove": "confirm that the robot NAME is off the floor",
    "place": "take the robot NAME in again where it says that it is, or at --at",
    "join": "take in the robot NAME, which no plan has: --serial and --at (plans with jobs)",
    "replan": "replan the rest as robots stand, round those that do not go on",
}

EXAMPLES = """\b
Examples:
  rightofway jobs plan.journal list
  rightofway jobs plan.journal add --at N7 --work 5
  rightofway jobs plan.journal add --at N6 --after R1/job7
  rightofway jobs plan.journal add T12 --from Dock --to Rack --due 15min
  rightofway jobs plan.journal add - < jobs.csv
  rightofway jobs plan.journal withdraw R1/job7
  rightofway jobs plan.journal close N4
  rightofway jobs plan.journal close N4 --to N7
  rightofway jobs plan.journal hold
  rightofway jobs plan.journal join R3 --serial A-003 --at N8
"""


def _read_duration(
    _context: click.Context, _parameter: click.Parameter, given: str | None
) -> str | None:
    from rightofway.control.commands import read_duration

    if given is not None:
        try:
            read_duration(given, Fraction(1))
        except InputError as error:
            raise click.BadParameter(error.faults[0].message) from None
    return given


def _read_moment(
    context: click.Context, parameter: click.Parameter, given: str | None
) -> str | None:
    """Return a time from now on, or a time of day, which the control reads."""
    if is_clock_time(given):
        return given
    return _read_duration(context, parameter, given)


def _read_keys(
    _context: click.Context, _parameter: click.Parameter, given: tuple[str, ...]
) -> dict[str, Any]:
    """Return keys with their values, which are written as in YAML."""
    from rightofway.io.documents import parse_document

    keys = dict[str, Any]()
    for text in given:
        key, is_key, value = text.partition("=")
        if not is_key or not value:
            raise click.BadParameter(f"{text!r} has no value (give KEY=VALUE, like speed=1.4)")
        try:
            keys[key] = parse_document(value, Path("value.yaml"))
        except InputError as error:
            raise click.BadParameter(f"{text!r}: {error.faults[0].message}") from None
    return keys


def _add_job_options(command: Any) -> Any:
    """Add the options that describe a job."""
    for option in reversed(
        (
            click.option("--at", metavar="PLACE",
                         help="Place of the job or of the robot: a vertex or a station."),
            click.option("--from", "pickup", metavar="PLACE",
                         help="Place where a load is picked up (plans with jobs)."),
            click.option("--to", metavar="PLACE",
                         help="Place where the load is dropped off; with close and open, the other"
                         " end of a lane."),
            click.option("--load", type=Whole(1), metavar="NUMBER",
                         help="Size of the load; 1 by default."),
            click.option("--load-id", metavar="NAME",
                         help="The name of the load, for the actions that pick and drop it."),
            click.option("--load-type", metavar="NAME",
                         help="The type of the load, for the same actions."),
            click.option("--work", metavar="TIME", callback=_read_duration,
                         help="Work time at each place of the job [time unit, or with s, min or"
                         " h]."),
            click.option("--earliest", metavar="TIME", callback=_read_moment,
                         help="Earliest begin of the job: a time from now on, or a time of day like"
                         " 10:30."),
            click.option("--due", metavar="TIME", callback=_read_moment,
                         help="Time by which the job should end, in the same form; a later end"
                         " costs more."),
            click.option("--latest", metavar="TIME", callback=_read_moment,
                         help="Latest end of the job, in the same form. If no robot can do it by"
                         " then, the job is not done."),
            click.option("--urgent", is_flag=True,
                         help="Due immediately: the job is assigned before others."),
            click.option("--weight", metavar="FACTOR",
                         help="Weight of the job compared with other jobs; 1 by default."),
            click.option("--robot", metavar="ROBOT",
                         help="The robot of the job; by default the one with the shortest detour."),
            click.option("--after", metavar="JOB", multiple=True,
                         help="A job that ends before this one begins; may be repeated. In a plan"
                         " without jobs, the job that its robot does directly before this one,"
                         " like R1/job2."),
            click.option("--serial", metavar="SERIAL",
                         help="With join: the serial number of the robot, as its topics have it."),
            click.option("--like", metavar="ROBOT",
                         help="With join: the robot of the plan whose attributes and identity it"
                         " has; needed if robots of the plan differ."),
            click.option("--set", "given", metavar="KEY=VALUE", multiple=True, callback=_read_keys,
                         help="With join: another value of a key of robots, of scenario files or"
                         " of the file of identities, like home=Dock3, speed=1.4 or version=3.0.0;"
                         " may be repeated."),
        )
    ):  # fmt: skip
        command = option(command)
    return command


@click.command(epilog=EXAMPLES, short_help="Change the work of robots that drive.")
@click.argument("journal", type=click.Path())
@click.argument("action", type=click.Choice(list(ACTIONS)))
@click.argument("name", required=False)
@_add_job_options
@click.option("--wait", metavar="SECONDS", type=click.FloatRange(min=0), default=10,
              show_default=True, help="Time to wait for the answer.")  # fmt: skip
@as_json_option("answer")
def jobs(
    *,
    journal: str,
    action: str,
    name: str | None,
    wait: float,
    as_json: bool,
    **options: Any,
) -> int:
    """Send an ACTION to the control that has the JOURNAL open.

    Released parts do not change. The remaining routes are replanned, and the judge checks the new
    plan before it is used. If no plan is found, the old plan stays valid and the command is
    refused (exit code 1). If the control does not run, it executes the command at its next start.

    In a plan with jobs, NAME identifies a job: a job that is added twice is one job. The next
    round plans it. With - as NAME, jobs come from standard input: a CSV table, or a JSON object a
    line.
    """
    if not Path(journal).exists():
        raise InputError.at(journal, "there is no such file (name the journal of rightofway drive)")
    given = _list_given(name, options, is_lane=action in {"close", "open"})
    if action == "add" and not {"at", "pickup"} & given.keys() and name != "-":
        raise click.UsageError("a job is somewhere (give --at, or --from and --to)")
    if action == "join" and not {"at", "serial"} <= given.keys():
        raise click.UsageError("join needs --serial and --at")
    from rightofway.control.commands import NAMED, Commands
    from rightofway.control.journal import JournalReader
    from rightofway.facts import read_fact
    from rightofway.report.facts import FactWriter

    if action in NAMED and not name:
        raise click.UsageError(f"{action} needs a NAME")
    JournalReader(Path(journal)).close()
    commands = Commands(Path(journal))
    if name == "-":
        from rightofway.control.command_line.job_input import read_jobs

        numbers = [commands.ask({**job, "kind": action}) for job in read_jobs()]
        answers = [commands.wait_for(number, wait) for number in numbers]
        commands.close()
        return _report_answers(answers, wait, as_json=as_json)
    number = commands.ask({"kind": action, **given})
    answer = commands.wait_for(number, wait)
    commands.close()
    if answer is None:
        say(NO_ANSWER.format(wait=wait))
        return 3
    if as_json:
        put_json(dict(answer))
    elif action == "list" and answer["done"]:
        rows = (map(job.get, ("name", "at", "state")) for job in answer["jobs"])
        put_report("\n".join("  ".join(f"{cell:12}" for cell in row).rstrip() for row in rows))
    else:
        sentence = FactWriter(None).write(read_fact(answer["fact"]))
        (put_report if answer["done"] else say)(sentence)
    return 0 if answer["done"] else 1


def _list_given(name: str | None, options: Mapping[str, Any], *, is_lane: bool) -> dict[str, Any]:
    """Return the values of a command, with the keys of jobs in scenario files."""
    values = {"name": name, **options, "after": [*options["after"]] or None}
    values["set"] = values.pop("given") or None
    values["urgent"] = options["urgent"] or None
    if values["pickup"] is not None and not is_lane:
        values["dropoff"] = values.pop("to")
        values["pickup_work"] = values["dropoff_work"] = values.pop("work")
    return {key: value for key, value in values.items() if value is not None}


def _report_answers(answers: Sequence[Answer | None], wait: float, *, as_json: bool) -> int:
    """Report the answers to commands on several jobs; return the exit code."""
    from rightofway.facts import read_fact
    from rightofway.report.facts import FactWriter

    known = [dict(answer) for answer in answers if answer is not None]
    if as_json:
        put_json(known)
    else:
        for answer in known:
            sentence = FactWriter(None).write(read_fact(answer["fact"]))
            (put_report if answer["done"] else say)(sentence)
    if len(known) < len(answers):
        say(NO_ANSWER.format(wait=wait))
        return 3
    return 0 if all(answer["done"] for answer in known) else 1
