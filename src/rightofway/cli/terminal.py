"""What all commands share: where words go, the files they read, the files they will write."""

from __future__ import annotations

import io
import json
import shutil
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from rightofway.io import Loaded
    from rightofway.model import Plan, Scenario

__all__ = [
    "progress",
    "put",
    "put_json",
    "read_either",
    "read_plan",
    "read_scenario",
    "say",
    "speak_utf8",
    "width",
    "writable",
]


CLEAR = "\r\x1b[2K"
"""Empties the line that the cursor is in."""


def speak_utf8() -> None:
    """Write UTF-8 as our files are, whatever the locale; a terminal gets what it can show."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            encoding = None if stream.isatty() else "utf-8"
            stream.reconfigure(encoding=encoding, errors="backslashreplace")


def say(message: str) -> None:
    """Tell the user something that is not the result."""
    click.echo(message, err=True)


@contextmanager
def progress() -> Iterator[Callable[[str], None]]:
    """Yield what shows a passing sentence in the last line of a terminal; elsewhere, nothing."""
    if not sys.stderr.isatty():
        yield lambda _: None
        return
    try:
        yield lambda message: click.echo(f"{CLEAR}{message[: width() - 1]}", err=True, nl=False)
    finally:
        click.echo(CLEAR, err=True, nl=False)


def put(text: str) -> None:
    """Give out a result."""
    click.echo(text)


def put_json(value: Any) -> None:
    """Give out a result for programs."""
    click.echo(json.dumps(value, indent=1, ensure_ascii=False))


def width() -> int:
    """Return the columns of the terminal, 80 where there is none."""
    return shutil.get_terminal_size().columns


def read_scenario(path: str) -> Scenario:
    """Read a scenario and pass on what its reader has to say; ``-`` is standard input."""
    from rightofway.io import load_with_notes

    return _noted(load_with_notes(path), path)


def read_plan(path: str) -> Plan:
    """Read a plan; ``-`` is standard input."""
    from rightofway.io import load_plan

    return load_plan(path)


def read_either(path: str) -> Plan | Scenario:
    """Read a plan or a scenario, whichever it is; ``-`` is standard input."""
    from rightofway.io import Loaded, load_either

    found = load_either(path)
    return _noted(found, path) if isinstance(found, Loaded) else found


def _noted(loaded: Loaded, path: str) -> Scenario:
    for note in loaded.notes:
        say(f"{path}: {note}")
    return loaded.scenario


def writable(*suffixes: str) -> Callable[[click.Context, click.Parameter, Any], Any]:
    """Return a callback that refuses, before any work, a file that could not be written after it.

    Parameters
    ----------
    suffixes
        What its name may end in; anything if there are none.
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
        return f"is no {', '.join(others)} or {last} (name one of them)"
    if path.is_dir():
        return "is a directory (give a file name in it)"
    if not path.parent.is_dir():
        return f"cannot be written: there is no directory {str(path.parent)!r} (make it first)"
    return None
