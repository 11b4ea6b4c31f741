"""Parts that all commands share: options, text of 80 columns, files that are read and written."""

from __future__ import annotations

import io
import json
import math
import re
import shutil
import stat
import sys
import textwrap
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import asdict, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from rightofway.model.quantities import Value, decimal
from rightofway.model.values import written

if TYPE_CHECKING:
    from rightofway.io import Loaded
    from rightofway.model import Plan, Quantities, Scenario

Callback = Callable[[click.Context, click.Parameter, Any], Any]
"""What click calls to check the value of an option."""

COLUMNS = 80
"""Longest line of a report."""

MAX_NAME = 40
"""Columns that a robot's name may take in a table."""

QUIET = "rightofway.quiet"
"""Where a command keeps whether the user wants no messages."""

NO_BREAK = "\N{NO-BREAK SPACE}"
"""A space at which no line is broken."""

UNIT = re.compile(r"(?<=\d) (?=[a-z])|(?<=\d h) (?=\d)|(?<=\d min) (?=\d)")
"""The spaces within ``2 min 34.3 s``."""

FILES = "rightofway.files."
"""Where a command keeps the files that belong to a plan of another program."""

CLEAR = "\r\x1b[2K"
"""Empties the line that the cursor is in."""


def speak_utf8() -> None:
    """Write UTF-8 as our files are, whatever the locale; a terminal gets what it can show."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            encoding = None if stream.isatty() else "utf-8"
            stream.reconfigure(encoding=encoding, errors="backslashreplace")


def quiet() -> bool:
    """Whether the user wants neither reports nor messages, but results and errors."""
    context = click.get_current_context(silent=True)
    return context is not None and context.meta.get(QUIET, False)


def _set_quiet(context: click.Context, _parameter: click.Parameter, given: bool) -> None:
    if given:
        context.meta[QUIET] = True


def quiet_option(command: Any) -> Any:
    """Add the option -q to a command or a function."""
    return click.option("-q", "--quiet", is_flag=True, expose_value=False, callback=_set_quiet,
                        help="Print no report and no messages, only errors.")(command)  # fmt: skip


def say(message: str) -> None:
    """Write a message, not a result, to standard error."""
    if not quiet():
        complain(message)


def complain(message: str) -> None:
    """Write what is wrong to standard error, also for users who want no messages."""
    click.echo(message, err=True)


def put_report(text: str) -> None:
    """Write a report for people to standard output."""
    if not quiet():
        click.echo(text)


def put_json(value: Any) -> None:
    """Write a result for programs to standard output."""
    click.echo(json_text(value))


def json_text(value: Any) -> str:
    """Return the JSON of a report."""
    return json.dumps(value, indent=1, ensure_ascii=False)


@contextmanager
def progress(
    limit: float | None = None, since: float | None = None
) -> Iterator[Callable[[str], None]]:
    """Yield a function that shows progress in the last line of a terminal; elsewhere, nothing.

    The line begins with the time since the command began, and the time limit [s] if there is one:
    ``3.1 of 10 s, flowtime 5273``. It is brought up to date twice a second.
    """
    if quiet() or not sys.stderr.isatty():
        yield lambda _: None
        return
    began = time.monotonic() if since is None else since
    latest, ended = [""], threading.Event()
    of = "" if limit is None else f" of {decimal(limit)}"

    def show(message: str) -> None:
        latest[0] = message
        line = f"{time.monotonic() - began:.1f}{of} s, {message}".removesuffix(", ")
        click.echo(f"{CLEAR}{line[: width() - 1]}", err=True, nl=False)

    def repeat() -> None:
        while not ended.wait(0.5):
            show(latest[0])

    clock = threading.Thread(target=repeat, daemon=True)
    clock.start()
    try:
        yield show
    finally:
        ended.set()
        clock.join()
        click.echo(CLEAR, err=True, nl=False)


def width() -> int:
    """Return the columns of the terminal, 80 where there is none."""
    return shutil.get_terminal_size().columns


def wrapped(text: str, indent: str = "") -> list[str]:
    """Return the lines of a sentence; a number and its unit stay in one line."""
    return _broken(text, indent, indent + "    ").splitlines()


def row(key: str, text: str, column: int) -> str:
    """Return a row of a report: a key, and from a column on its text, on several lines if long."""
    return _broken(text, f"{key:{column}}", " " * column)


def _broken(text: str, first: str, following: str) -> str:
    joined = UNIT.sub(NO_BREAK, text)
    filled = textwrap.fill(joined, COLUMNS, initial_indent=first, subsequent_indent=following)
    return filled.replace(NO_BREAK, " ")


def short(name: str, columns: int = MAX_NAME) -> str:
    """Return a robot's name in the columns that it may take."""
    return name if len(name) <= columns else f"{name[: columns - 1]}…"


def read_scenario(path: str, count: int | None = None) -> Scenario:
    """Read a scenario, or the first robots of a .scen file, and write its reader's notes.

    ``-`` is standard input.
    """
    from rightofway.io import load_with_notes

    return _noted(load_with_notes(path, count=count), path)


def _keep_file(context: click.Context, parameter: click.Parameter, given: str | None) -> None:
    suffix = f".{parameter.name}"
    if given is not None and Path(given).suffix.lower() != suffix:
        raise click.BadParameter(f"{given!r} does not end in {suffix} (give a {suffix} file)")
    context.meta[f"{FILES}{parameter.name}"] = given


def foreign_options(command: Any) -> Any:
    """Add the files that a plan of another program may need; `read_plan` finds them."""
    for name, what in (("scen", "starts and goals (.scen)"), ("map", "map (.map)")):
        command = click.option(
            f"--{name}", metavar="FILE", expose_value=False, callback=_keep_file,
            help=f"The {what} of a plan of another program.",
        )(command)  # fmt: skip
    return command


def _files() -> dict[str, str | None]:
    """Return the files of `foreign_options`."""
    meta = click.get_current_context().meta
    return {"map_file": meta.get(f"{FILES}map"), "scen": meta.get(f"{FILES}scen")}


def read_plan(path: str) -> Plan:
    """Read a plan, ours or of another program; ``-`` is standard input."""
    from rightofway.io import load_plan

    return load_plan(path, **_files())


def read_either(path: str, count: int | None = None) -> Plan | Scenario:
    """Read a plan or a scenario; ``-`` is standard input."""
    from rightofway.io import Loaded, load_either

    found = load_either(path, count=count, **_files())
    return _noted(found, path) if isinstance(found, Loaded) else found


def _noted(loaded: Loaded, path: str) -> Scenario:
    for note in loaded.notes:
        say(f"{path}: {note}")
    return loaded.scenario


def writable(
    *suffixes: str, instead: dict[str, str] | None = None, stdout: bool = True
) -> Callable[[click.Context, click.Parameter, Any], Any]:
    """Return a callback that refuses, before any work, a file that could not be written after it.

    Parameters
    ----------
    suffixes
        Endings of the file, if not all are good. A device or a pipe needs none.
    instead
        For further endings, what to do to get a file of that kind.
    stdout
        Whether ``-`` is good, for standard output.
    """

    def check(_context: click.Context, _parameter: click.Parameter, path: str | None) -> str | None:
        if path is None or (path == "-" and stdout):
            return path
        fault = _unwritable(Path(path), suffixes, instead or {})
        if fault:
            raise click.BadParameter(f"{path!r} {fault}")
        return path

    return check


def _unwritable(path: Path, suffixes: tuple[str, ...], instead: dict[str, str]) -> str | None:
    if path.is_dir():
        return "is a directory (give a file name in it)"
    suffix = path.suffix.lower()
    if suffixes and suffix not in suffixes and not _is_device(path):
        *others, last = suffixes
        known = f"{', '.join(others)} or {last}" if others else last
        remedy = instead.get(suffix, "give a name that does")
        return f"does not end in {known} ({remedy.format(path)})"
    if not path.parent.is_dir():
        return f"cannot be written: there is no directory {str(path.parent)!r} (make it first)"
    return None


def _is_device(path: Path) -> bool:
    try:
        return not stat.S_ISREG(path.stat().st_mode)
    except (OSError, ValueError):
        return False


def _seconds(_context: click.Context, _parameter: click.Parameter, given: float) -> float | None:
    """Return a time limit [s]; None for no limit."""
    if not given > 0:
        raise click.BadParameter(f"{given:g} is not positive (give seconds, or inf for no limit)")
    return None if given == math.inf else given


def _seed(_context: click.Context, _parameter: click.Parameter, given: int) -> int:
    from rightofway.solve import LARGEST_SEED

    if not 0 <= given <= LARGEST_SEED:
        raise click.BadParameter(f"{given} is no seed (give a number from 0 to {LARGEST_SEED})")
    return given


time_limit_option = click.option(
    "--time-limit",
    type=float,
    default=10,
    show_default=True,
    callback=_seconds,
    metavar="SECONDS",
    help="Time limit of the whole command; inf for none.",
)

count_option = click.option(
    "-k",
    "--count",
    type=click.IntRange(1),
    metavar="K",
    help="Take the first K robots of a .scen file; all by default.",
)

seed_option = click.option(
    "--seed",
    type=int,
    default=0,
    show_default=True,
    callback=_seed,
    metavar="N",
    help="Seed of all random choices; the same seed gives the same result.",
)


ticks_option = click.option(
    "--ticks",
    "in_ticks",
    is_flag=True,
    help="Report times in ticks, as files have them.",
)


def quantities_of(scenario: Scenario, *, in_ticks: bool) -> Quantities:
    """Return how a report writes times: in the scenario's units, or in ticks on request."""
    return replace(scenario.quantities, in_ticks=in_ticks)


def counted(number: int, noun: str) -> str:
    """Return a number and its noun: ``1 more robot``, ``3 more robots``."""
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"


def further(quantities: Quantities) -> Callable[[Value], str]:
    """Return how times after the first one of a sentence are written.

    Where all times are in one unit, ``time 4`` goes on with ``13``, ``8 ticks`` with ``9``.
    """
    is_one_unit = quantities.in_ticks or not quantities.time_unit
    return quantities.cell if is_one_unit else quantities.duration


def file_title(path: str) -> str:
    """Return the name of a file as the title of its page; empty for standard input."""
    return "" if path == "-" else Path(path).name


def measures(scenario: Scenario) -> dict[str, Any]:
    """Return what the numbers of a report for programs are measured in."""
    tick = written(scenario.problem.clock.tick)
    return {"tick": tick, "units": asdict(scenario.units)}


def as_json_option(what: str) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Return the option that prints a result for programs."""
    return click.option("--json", "as_json", is_flag=True, help=f"Print the {what} as JSON.")


class ListingCommand(click.Command):
    """A command whose help lists the values of an option, then the examples."""

    def __init__(
        self, *args: Any, listing: Callable[[click.HelpFormatter], None], **kwargs: Any
    ) -> None:
        super().__init__(*args, **kwargs)
        self.listing = listing

    def format_epilog(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the list, then the examples."""
        self.listing(formatter)
        super().format_epilog(ctx, formatter)
