"""Which commands there are, and which exit code each ending has.

=====  ===================================================================
0      done
1      no plan exists, or the checked plan has faults
2      bad input or usage
3      no plan was found: time ran out, or the planner gave up
70     a defect of ours
130    interrupted
141    the program that read the output has ended
=====  ===================================================================
"""

from __future__ import annotations

import os
import sys
import traceback
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import chain
from typing import NoReturn

import click

from rightofway import __version__
from rightofway.cli.bench import bench
from rightofway.cli.collisions import collisions
from rightofway.cli.examples import examples, new
from rightofway.cli.formats import convert, schema
from rightofway.cli.inspect import inspect
from rightofway.cli.laps import laps
from rightofway.cli.paper import paper
from rightofway.cli.planning import bound, improve, plan
from rightofway.cli.simulate import simulate
from rightofway.cli.studio import studio
from rightofway.cli.tables import table
from rightofway.cli.terminal import complain, quiet_option, speak_utf8
from rightofway.cli.views import check, show
from rightofway.errors import GaveUp, InputError, InvalidPlan, NoPlanExists

MANY = 1000
"""Characters of the longest sentence of help, which is not cut."""

DONE, NO_PLAN, BAD_INPUT, GAVE_UP, DEFECT, INTERRUPTED, UNREAD = 0, 1, 2, 3, 70, 130, 141


@dataclass
class _Session:
    debug: bool = False


START = """\b
Start with:
  rightofway examples --copy .
  rightofway plan examples/door.yaml --page door.html
"""

GROUPS: dict[str, tuple[click.Command, ...]] = {
    "Begin": (new, examples, inspect, studio),
    "Plan": (plan, improve, bound),
    "Look at plans": (check, show, table, collisions),
    "Repeated work and delays": (laps, simulate),
    "Compare": (bench, paper),
    "Formats": (convert, schema),
}
"""The commands, by what they are for, in the order of help."""


class _Commands(click.Group):
    """The commands, listed by what they are for."""

    def format_commands(self, _ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write a section for each group; no sentence is cut."""
        width = max(map(len, self.commands))
        for title, group in GROUPS.items():
            with formatter.section(title):
                formatter.write_dl(
                    [
                        (f"{command.name:{width}}", command.get_short_help_str(MANY))
                        for command in group
                    ]
                )


@click.group(
    name="rightofway",
    cls=_Commands,
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 80},
    epilog=START,
)
@click.version_option(__version__, "-V", "--version", prog_name="rightofway")
@quiet_option
@click.option("--debug", is_flag=True, help="Show where an unexpected error comes from.")
@click.pass_context
def commands(context: click.Context, *, debug: bool) -> None:
    """Plan fleets of mobile robots that go out, work and come home.

    Results go to standard output or to the file of -o, everything else to standard error. Exit
    codes: 0 done, 1 no plan exists or the plan has faults, 2 bad input, 3 no plan was found,
    130 interrupted.
    """
    context.ensure_object(_Session).debug = debug


for command in chain.from_iterable(GROUPS.values()):
    commands.add_command(quiet_option(command))


def main(args: Sequence[str] | None = None) -> NoReturn:
    """Run a command and end the process with its exit code.

    Parameters
    ----------
    args
        The arguments; None for those of the process.
    """
    speak_utf8()
    try:
        code = run(args)
    except BrokenPipeError:  # no program reads the messages
        code = UNREAD
    if code == UNREAD:
        # Keep Python from complaining, at its exit, that no program reads its output any more.
        nowhere = os.open(os.devnull, os.O_WRONLY)
        for stream in (1, 2):
            os.dup2(nowhere, stream)
    sys.exit(code)


ENDINGS: dict[type[BaseException], tuple[int, str]] = {
    InputError: (BAD_INPUT, "{}"),
    NoPlanExists: (NO_PLAN, "no plan exists: {}"),
    GaveUp: (GAVE_UP, "no plan found: {}"),
    InvalidPlan: (DEFECT, "{} (a defect of rightofway; please report the scenario)"),
    KeyboardInterrupt: (INTERRUPTED, "interrupted"),
    click.Abort: (INTERRUPTED, "interrupted"),
}


def run(args: Sequence[str] | None = None) -> int:
    """Run a command and return its exit code; what went wrong is said on standard error."""
    session = _Session()
    try:
        ended = commands.main(args, prog_name="rightofway", standalone_mode=False, obj=session)
        return int(ended or DONE)
    except click.ClickException as error:
        error.show()
        return error.exit_code
    except tuple(ENDINGS) as error:
        code, words = next(end for kind, end in ENDINGS.items() if isinstance(error, kind))
        complain("\n".join(words.format(line) for line in str(error).splitlines() or [""]))
        return code
    except SystemExit as end:  # click ends so when no program reads our results, or to complete
        return UNREAD if end.code else DONE
    except OSError as error:
        complain(
            f"{error.filename or 'standard output'}: {error.strerror or error} (check the path)"
        )
        return BAD_INPUT
    except Exception as error:  # noqa: BLE001 (whatever else goes wrong is a defect of ours)
        _confess(error, debug=session.debug)
        return DEFECT


def _confess(error: Exception, *, debug: bool) -> None:
    if debug:
        complain("".join(traceback.format_exception(error)).rstrip("\n"))
    what = " ".join([f"{type(error).__name__}:", *str(error).split()])
    complain(f"unexpected {what} (please report it; `rightofway --debug …` says more)")
