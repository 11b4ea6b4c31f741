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

import atexit
import gc
import os
import sys
import threading
import time
import traceback
import warnings
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from typing import Any, NoReturn, cast

import click

from rightofway import __version__
from rightofway.cli.parts import GROUPS, MODULES, load_command
from rightofway.cli.terminal import add_shared_options, complain, put_json, say, speak_utf8
from rightofway.errors import GaveUp, InputError, InvalidPlan, NoPlanExists, describe_error

MANY = 1000
"""Characters of the longest sentence of help, which is not cut."""

DONE, NO_PLAN, BAD_INPUT, GAVE_UP, DEFECT, INTERRUPTED, UNREAD = 0, 1, 2, 3, 70, 130, 141


COMPLETE = "_RIGHTOFWAY_COMPLETE"
"""The variable by which a shell asks for what can be filled in."""


@dataclass
class _Session:
    debug: bool = False
    began: float | None = None  # when the process did, on the monotonic clock [s]
    ended_by: BaseException | None = None  # holds what the work had, until the process ends


START = """\b
Start with:
  rightofway examples --copy .
  rightofway plan examples/door.yaml --page door.html
"""


@cache
def _load_command(name: str) -> click.Command:
    return cast("click.Command", add_shared_options(load_command(name)))


class _Modules(Mapping[str, click.Command]):
    """The commands by name; the module of one is imported when it is looked up."""

    def __getitem__(self, name: str) -> click.Command:
        return _load_command(name)

    def __iter__(self) -> Iterator[str]:
        return iter(MODULES)

    def __len__(self) -> int:
        return len(MODULES)


class _Commands(click.Group):
    """The commands, listed by purpose."""

    def format_commands(self, _ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write a section for each group; no sentence is cut."""
        width = max(map(len, self.commands))
        for title, group in GROUPS.items():
            with formatter.section(title):
                formatter.write_dl(
                    [
                        (f"{name:{width}}", self.commands[name].get_short_help_str(MANY))
                        for name in group
                    ]
                )


@click.group(
    name="rightofway",
    cls=_Commands,
    commands=_Modules(),
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 80},
    epilog=START,
    invoke_without_command=True,
    no_args_is_help=True,
    subcommand_metavar="COMMAND [ARGS]...",
)
@click.option("-V", "--version", is_flag=True, help="Show the version and exit.")
@click.option("--json", "as_json", is_flag=True, help="Print the version as JSON.")
@add_shared_options
@click.option("--debug", is_flag=True, help="Show where an unexpected error comes from.")
@click.pass_context
def commands(context: click.Context, *, version: bool, as_json: bool, debug: bool) -> None:
    """Plan fleets of mobile robots that go out, work and come home.

    Results go to standard output or to the file of -o, everything else to standard error. Exit
    codes: 0 done, 1 no plan exists or the plan has faults, 2 bad input, 3 no plan was found,
    130 interrupted.
    """
    context.ensure_object(_Session).debug = debug
    if version:
        put_json(_describe_program()) if as_json else click.echo(
            f"rightofway, version {__version__}"
        )
        context.exit()
    if as_json:
        raise click.UsageError("--json belongs to --version, or after a command.", context)
    if context.invoked_subcommand is None:
        raise click.UsageError("Missing command.", context)


def main(args: Sequence[str] | None = None) -> NoReturn:
    """Run a command and end the process with its exit code.

    Parameters
    ----------
    args
        The arguments; None for those of the process.
    """
    speak_utf8()
    _start_quickly()
    is_process = args is None  # else a program calls, and may be old
    session = _Session()
    try:
        # CPU time instead of the age of the process: a shell may have become this command by `exec`
        # after it had waited for another one, as `sh -c "pip install . && rightofway plan"` does.
        if is_process:
            session.began = time.monotonic() - time.process_time()
        code = run(args, session)
    except BrokenPipeError:  # no program reads the messages
        code = UNREAD
    if code == UNREAD:
        # Keep Python from complaining, at its exit, that no program reads its output any more.
        nowhere = os.open(os.devnull, os.O_WRONLY)
        for stream in (1, 2):
            os.dup2(nowhere, stream)
    if is_process:
        _end_quickly(code)
    sys.exit(code)


def _describe_program() -> dict[str, Any]:
    """Return the versions that a report of a defect needs."""
    import platform

    from rightofway.extras import list_plugins

    return {
        "version": __version__,
        "python": platform.python_version(),
        "platform": platform.platform(),
        "plugins": list_plugins(),
    }


def _end_quickly(code: int) -> None:
    """End the process as Python does, but free no memory: of a large map that takes a second.

    It returns where another thread runs or output is refused, because Python handles both.
    """
    if threading.active_count() == 1:
        atexit._run_exitfuncs()  # noqa: SLF001 (os._exit alone runs none of them)
        with suppress(OSError):
            sys.stdout.flush()
            sys.stderr.flush()
            os._exit(code)


def _start_quickly() -> None:
    """Spare a command, before it imports anything large, what takes CPU and serves no command.

    NumPy's linear algebra starts a thread for each core and keeps them busy for a while; products
    of matrices are not what planning spends its time on. Pydantic looks through all installed
    packages for plugins. The garbage collector looks at all modules
    again and again while they are imported; they stay.
    """
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    os.environ.setdefault("PYDANTIC_DISABLE_PLUGINS", "__all__")
    gc.set_threshold(50_000, *gc.get_threshold()[1:])


ENDINGS: dict[type[BaseException], tuple[int, str]] = {
    InputError: (BAD_INPUT, "{}"),
    NoPlanExists: (NO_PLAN, "no plan exists: {}"),
    GaveUp: (GAVE_UP, "no plan found: {}"),
    InvalidPlan: (DEFECT, "{} (a defect of rightofway; please report the scenario)"),
    KeyboardInterrupt: (INTERRUPTED, "interrupted"),
    click.Abort: (INTERRUPTED, "interrupted"),
}


def run(args: Sequence[str] | None = None, session: _Session | None = None) -> int:
    """Run a command and return its exit code; errors go to standard error.

    Time limits count from when the process of a session began; without one, from the command on.
    """
    session = session or _Session()
    try:
        if COMPLETE in os.environ:
            import_module("rightofway.cli.completion")  # makes its script for Bash known to click
        with _show_warnings():
            ended = commands.main(args, prog_name="rightofway", standalone_mode=False, obj=session)
        return int(ended or DONE)
    except click.ClickException as error:
        error.show()
        return error.exit_code
    except tuple(ENDINGS) as error:
        code, words = next(end for kind, end in ENDINGS.items() if isinstance(error, kind))
        complain("\n".join(words.format(line) for line in str(error).splitlines() or [""]))
        session.ended_by = error
        return code
    except SystemExit as end:  # click ends so when no program reads our results, or to complete
        return UNREAD if end.code else DONE
    except OSError as error:
        complain(
            f"{error.filename or 'standard output'}: {error.strerror or error} (check the path)"
        )
        return BAD_INPUT
    except Exception as error:  # noqa: BLE001 (whatever else goes wrong is a defect of ours)
        _print_confession(error, debug=session.debug)
        return DEFECT


@contextmanager
def _show_warnings() -> Iterator[None]:
    """Show warnings of ours as messages; those of other packages as Python does."""
    with warnings.catch_warnings():
        show = warnings.showwarning

        def show_or_say(message: Warning | str, *more: Any, **named: Any) -> None:
            from rightofway.extras import PluginWarning

            is_ours = isinstance(message, PluginWarning)
            say(str(message)) if is_ours else show(message, *more, **named)

        warnings.showwarning = show_or_say
        yield


def _print_confession(error: Exception, *, debug: bool) -> None:
    if debug:
        complain("".join(traceback.format_exception(error)).rstrip("\n"))
    remedy = "please report it; `rightofway --debug …` says more"
    complain(f"unexpected {describe_error(error)} ({remedy})")
