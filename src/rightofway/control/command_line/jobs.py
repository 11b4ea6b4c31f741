"""``rightofway jobs``: jobs, closures and holds for robots that drive."""

from __future__ import annotations

from pathlib import Path

import click

from rightofway.cli.options import as_json_option
from rightofway.cli.terminal import put_json, put_report, say
from rightofway.errors import InputError

ACTIONS = {
    "list": "list jobs that are not done",
    "add": "give a robot a job: --at, perhaps --work, --robot and --after",
    "change": "change a job NAME that is not released: --at, --work",
    "withdraw": "take back a job NAME that is not released",
    "again": "have a robot do a job NAME again that has failed",
    "skip": "give up a job NAME that has failed: its robot goes on without it",
    "close": "let no robot enter the vertex NAME, or the lane from NAME to --to",
    "open": "open it again",
    "hold": "release nothing more to the robot NAME, or to all",
    "go": "release again to the robot NAME, or to all",
    "cancel": "take back what is released to the robot NAME, as far as it can stop before",
    "clear": "confirm that the faulty robot NAME is where the journal has it",
    "remove": "confirm that the robot NAME is off the floor",
    "place": "take the robot NAME in again where it says that it is, or at --at",
    "replan": "replan the rest as robots stand, round those that do not go on",
}

EXAMPLES = """\b
Examples:
  rightofway jobs plan.journal list
  rightofway jobs plan.journal add --at N7 --work 5
  rightofway jobs plan.journal add --at N6 --after R1/job7
  rightofway jobs plan.journal withdraw R1/job7
  rightofway jobs plan.journal close N4
  rightofway jobs plan.journal close N4 --to N7
  rightofway jobs plan.journal hold
"""


def _read_time(
    _context: click.Context, _parameter: click.Parameter, given: str | None
) -> str | None:
    from rightofway.control.commands import read_time

    if given is not None:
        try:
            read_time(given)
        except InputError as error:
            raise click.BadParameter(error.faults[0].message) from None
    return given


@click.command(epilog=EXAMPLES, short_help="Change the work of robots that drive.")
@click.argument("journal", type=click.Path())
@click.argument("action", type=click.Choice(list(ACTIONS)))
@click.argument("name", required=False)
@click.option(
    "--at", metavar="PLACE", help="Where the job is, or the robot: a vertex or a station."
)
@click.option("--work", metavar="TIME", callback=_read_time, help="How long it lasts [time unit].")
@click.option("--to", metavar="VERTEX", help="The other end of a lane, to close or open it.")
@click.option("--robot", metavar="ROBOT",
              help="Whose job it is; by default that of the robot which drives least more.",
              )  # fmt: skip
@click.option("--after", metavar="JOB",
              help="A job that its robot does directly before it, as R1/job2; by default it comes"
              " where it is the least detour.")  # fmt: skip
@click.option("--wait", metavar="SECONDS", type=click.FloatRange(min=0), default=10,
              show_default=True, help="How long to wait for the answer.")  # fmt: skip
@as_json_option("answer")
def jobs(
    *,
    journal: str,
    action: str,
    name: str | None,
    at: str | None,
    to: str | None,
    work: str | None,
    robot: str | None,
    after: str | None,
    wait: float,
    as_json: bool,
) -> int:
    """Ask the control that drives with a JOURNAL for an ACTION.

    Released parts stay, the rest is replanned and judged before it counts. Where no plan is
    found, the old one stands and the command is refused: exit code 1. A control that does not run
    carries the command out at its next start.
    """
    if not Path(journal).exists():
        raise InputError.at(journal, "there is no such file (name the journal of rightofway drive)")
    if action == "add" and at is None:
        raise click.UsageError("a job is somewhere (give --at)")
    from rightofway.control.commands import NAMED, Commands
    from rightofway.control.journal import JournalReader
    from rightofway.facts import read_fact
    from rightofway.report.facts import FactWriter

    if action in NAMED and not name:
        raise click.UsageError(f"{action} needs a NAME")
    JournalReader(Path(journal)).close()
    commands = Commands(Path(journal))
    values = {"name": name, "at": at, "to": to, "work": work, "robot": robot, "after": after}
    given = {key: value for key, value in values.items() if value is not None}
    number = commands.ask({"kind": action, **given})
    answer = commands.wait_for(number, wait)
    commands.close()
    if answer is None:
        say(f"no answer within {wait:g} s: it is carried out when the control runs")
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
