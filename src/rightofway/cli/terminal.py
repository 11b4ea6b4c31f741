"""Output of commands: reports of 80 columns, messages, progress."""

from __future__ import annotations

import io
import json
import sys
import threading
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from rightofway.deadline import Deadline
from rightofway.errors import escape_text
from rightofway.facts import Fact

if TYPE_CHECKING:
    from rightofway.report.lines import Part

QUIET, VERBOSE = "rightofway.quiet", "rightofway.verbose"
"""Keys of the options for no messages and for those on each step, in the context of a command."""

CLEAR = "\r\x1b[2K"
"""Empties the line that the cursor is in."""


def speak_utf8() -> None:
    """Write UTF-8 whatever the locale; a terminal gets the characters that it can show."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            encoding = None if stream.isatty() else "utf-8"
            stream.reconfigure(encoding=encoding, errors="backslashreplace")


def choose_deadline(seconds: float | None) -> Deadline:
    """Return when a command has to end: the limit counts from the beginning of its process."""
    began = getattr(click.get_current_context().find_root().obj, "began", None)
    if seconds is None or began is None:
        return Deadline.after(seconds)
    return Deadline(began + seconds)


def is_quiet() -> bool:
    """Whether the user wants neither reports nor messages, but results and errors."""
    return _is_set(QUIET)


def _is_set(wish: str) -> bool:
    context = click.get_current_context(silent=True)
    return context is not None and context.meta.get(wish, False)


def _add_wish(name: str, wish: str, explanation: str) -> Callable[[Any], Any]:
    """Return a decorator that adds a flag, which counts before and after the command's name."""

    def keep(context: click.Context, _parameter: click.Parameter, given: bool) -> None:
        if given:
            context.meta[wish] = True

    return click.option(
        *(f"-{name[0]}", f"--{name}"),
        is_flag=True,
        expose_value=False,
        callback=keep,
        help=explanation,
    )


def add_shared_options(command: Any) -> Any:
    """Add the options -v and -q to a command or a function."""
    verbose = _add_wish("verbose", VERBOSE, "Print each step of the work with its time.")
    quiet = _add_wish("quiet", QUIET, "Print no report and no messages, only errors.")
    return verbose(quiet(command))


def say(message: str) -> None:
    """Write a message, not a result, to standard error."""
    if not is_quiet():
        complain(message)


def say_of(path: object, text: str) -> None:
    """Say something about a file."""
    say(f"{path}: {text}")


def say_written(path: object) -> None:
    """Say that a file is written."""
    say(f"wrote {path}")


def complain(message: str) -> None:
    """Write an error to standard error, also for users who want no messages."""
    click.echo("\n".join(map(escape_text, message.split("\n"))), err=True)


def put_report(report: str | Iterable[Part]) -> None:
    """Write a report for people to standard output."""
    from rightofway.report.lines import Line, lay_out

    if not is_quiet():
        parts = [Line(report)] if isinstance(report, str) else report
        click.echo(lay_out(parts))


def put_json(value: Any) -> None:
    """Write a result for programs to standard output."""
    click.echo(format_json(value))


def format_json(value: Any) -> str:
    """Return the JSON of a report."""
    return json.dumps(value, indent=1, ensure_ascii=False)


@contextmanager
def show_progress(
    limit: float | None = None, since: float | None = None
) -> Iterator[Callable[[Fact | str], None]]:
    """Yield a function that shows progress in the last line of a terminal; elsewhere, nothing.

    With -v, it prints each step as a line of its own instead, in any output.

    The line begins with the time since the command began, and the time limit [s] if there is one:
    ``3.1 of 10 s, flowtime 5273``. It is brought up to date twice a second. Of a line that is too
    long for the terminal, the text after the last commas is left out.
    """
    began = time.monotonic() if since is None else since
    if _is_set(VERBOSE):
        yield lambda step: say(f"{time.monotonic() - began:8.2f} s  {step}")
        return
    if is_quiet() or not sys.stderr.isatty():
        yield lambda _: None
        return
    latest, ended = [""], threading.Event()
    from rightofway.report.quantities import format_decimal

    def show(message: Fact | str) -> None:
        latest[0] = str(message)
        passed = f"{time.monotonic() - began:.1f}"
        seconds = f"{passed} s"
        if limit is not None:
            seconds = f"{passed} of {format_decimal(limit)} s"
        line = ", ".join(filter(None, [seconds, latest[0]]))
        while len(line) >= measure_width() and ", " in line:
            line = line.rpartition(", ")[0]
        click.echo(f"{CLEAR}{line[: measure_width() - 1]}", err=True, nl=False)

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


def measure_width() -> int:
    """Return the columns of the terminal, 80 where there is none."""
    import shutil

    return shutil.get_terminal_size().columns


def make_title(path: str) -> str:
    """Return the name of a file as the title of its page; empty for standard input."""
    return "" if path == "-" else Path(path).name
