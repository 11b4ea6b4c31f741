"""Parts that all commands share: options, text of 80 columns, files that are read and written."""

from __future__ import annotations

import io
import json
import math
import shutil
import sys
import textwrap
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from rightofway.io import Loaded
    from rightofway.model import Plan, Scenario

COLUMNS = 80
"""Longest line of a report."""

MAX_NAME = 40
"""Columns that a robot's name may take in a table."""

CLEAR = "\r\x1b[2K"
"""Empties the line that the cursor is in."""


def speak_utf8() -> None:
    """Write UTF-8 as our files are, whatever the locale; a terminal gets what it can show."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            encoding = None if stream.isatty() else "utf-8"
            stream.reconfigure(encoding=encoding, errors="backslashreplace")


def say(message: str) -> None:
    """Write a message, not a result, to standard error."""
    click.echo(message, err=True)


@contextmanager
def progress() -> Iterator[Callable[[str], None]]:
    """Yield a function that shows progress in the last line of a terminal; elsewhere, nothing."""
    if not sys.stderr.isatty():
        yield lambda _: None
        return
    try:
        yield lambda message: click.echo(f"{CLEAR}{message[: width() - 1]}", err=True, nl=False)
    finally:
        click.echo(CLEAR, err=True, nl=False)


def put_json(value: Any) -> None:
    """Write a result for programs to standard output."""
    click.echo(json.dumps(value, indent=1, ensure_ascii=False))


def width() -> int:
    """Return the columns of the terminal, 80 where there is none."""
    return shutil.get_terminal_size().columns


def wrapped(text: str, indent: str = "") -> list[str]:
    """Return the lines of a sentence."""
    return textwrap.wrap(text, COLUMNS, initial_indent=indent, subsequent_indent=indent + "    ")


def row(key: str, text: str, column: int) -> str:
    """Return a row of a report: a key, and from a column on its text, on several lines if long."""
    return textwrap.fill(
        text, COLUMNS, initial_indent=f"{key:{column}}", subsequent_indent=" " * column
    )


def short(name: str) -> str:
    """Return a robot's name in the columns that it may take."""
    return name if len(name) <= MAX_NAME else f"{name[: MAX_NAME - 1]}…"


def read_scenario(path: str) -> Scenario:
    """Read a scenario and write its reader's notes; ``-`` is standard input."""
    from rightofway.io import load_with_notes

    return _noted(load_with_notes(path), path)


def read_either(path: str) -> Plan | Scenario:
    """Read a plan or a scenario; ``-`` is standard input."""
    from rightofway.io import Loaded, load_either

    found = load_either(path)
    return _noted(found, path) if isinstance(found, Loaded) else found


def _noted(loaded: Loaded, path: str) -> Scenario:
    for note in loaded.notes:
        say(f"{path}: {note}")
    return loaded.scenario


def writable(*suffixes: str) -> Callable[[click.Context, click.Parameter, Any], Any]:
    """Return a callback that refuses, before any work, a file that could not be written after it.

    Its name must end in one of the suffixes, if there are any.
    """

    def check(_context: click.Context, _parameter: click.Parameter, path: str | None) -> str | None:
        is_file = path is not None and (path != "-" or bool(suffixes))
        fault = _unwritable(Path(path or ""), suffixes) if is_file else None
        if fault:
            raise click.BadParameter(f"{path!r} {fault}")
        return path

    return check


def _unwritable(path: Path, suffixes: tuple[str, ...]) -> str | None:
    if suffixes and path.suffix.lower() not in suffixes:
        *others, last = suffixes
        known = f"{', '.join(others)} or {last}" if others else last
        return f"does not end in {known} (give a name that does)"
    if path.is_dir():
        return "is a directory (give a file name in it)"
    if not path.parent.is_dir():
        return f"cannot be written: there is no directory {str(path.parent)!r} (make it first)"
    return None


def _seconds(_context: click.Context, _parameter: click.Parameter, given: float) -> float | None:
    """Return a time limit [s]; None for no limit."""
    if not given > 0:
        raise click.BadParameter(f"{given:g} is not positive (give seconds, or inf for no limit)")
    return None if given == math.inf else given


time_limit_option = click.option(
    "--time-limit",
    type=float,
    default=10,
    show_default=True,
    callback=_seconds,
    metavar="SECONDS",
    help="Limit of the whole computation; inf for none.",
)

seed_option = click.option(
    "--seed",
    type=click.IntRange(0, 2**32 - 1),
    default=0,
    show_default=True,
    metavar="N",
    help="Seed of all random choices.",
)


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
