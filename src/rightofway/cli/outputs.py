"""Outputs of commands: ``-o FILE`` by its ending, ``-`` for standard output, ``--page FILE``."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from rightofway.cli.options import require_writable
from rightofway.cli.terminal import complain, say, say_written
from rightofway.files import write_whole

if TYPE_CHECKING:
    from rightofway.model import Plan

PAGE_SUFFIXES = (".html", ".htm")

Decorator = Callable[[Callable[..., Any]], Callable[..., Any]]


def _write_json(plan: Plan, path: str) -> None:
    from rightofway.io import write_plan

    write_plan(plan, path)


def _write_result(plan: Plan, path: str) -> None:
    from rightofway.viz.table.result import write_result

    write_result(plan, path)


PLAN_WRITERS: dict[str, Callable[[Plan, str], None]] = {
    ".json": _write_json,
    ".xlsx": _write_result,
}
"""For each ending of -o, where the result is a plan, the function that writes it.

The functions import what they need when they are called: help and completion read this table.
"""

INSTEAD = {
    ".html": "for a page give --page {}",
    ".htm": "for a page give --page {}",
    ".png": "for a picture: rightofway show PLAN -o {}",
    ".gif": "for a film: rightofway show PLAN -o {}",
    ".csv": "for a table: rightofway table PLAN -o {}",
}
"""The remedy for an ending that -o does not accept if the result is a plan."""


def make_output_option(
    content: str, *suffixes: str, instead: dict[str, str] | None = None
) -> Decorator:
    """Return the option -o of a command; ``content`` names the content of the file."""
    return click.option(
        "-o", "--output", metavar="FILE", callback=require_writable(*suffixes, instead=instead),
        help=f"Write {content} to this file ({', '.join(suffixes)}); - for standard output.",
    )  # fmt: skip


def plan_output_option(content: str) -> Decorator:
    """Return the option -o of a command whose result is a plan."""
    return make_output_option(content, *PLAN_WRITERS, instead=INSTEAD)


def make_page_option(content: str, verb: str = "plays") -> Decorator:
    """Return the option --page of a command; ``content`` names the content of the page."""
    return click.option(
        "--page", metavar="FILE",
        callback=require_writable(*PAGE_SUFFIXES, stdout=False),
        help=f"Write a page that {verb} {content} (.html).",
    )  # fmt: skip


def put_page(plan: Plan, path: str, *, said: str | None = None, **extras: Any) -> None:
    """Write a page that plays a plan, and name the faults that it shows.

    ``said`` is the message that the page is written; ``extras`` are those of `write_page`.
    """
    from rightofway.viz import write_page

    write_page(plan, path, **extras)
    say(said or f"wrote {path}")
    complain_of_faults(plan, path)


def complain_of_faults(plan: Plan, path: str) -> None:
    """Name the faults of a plan that a page shows, if it has any."""
    from rightofway.report.judgement import summarize_report, write_fault
    from rightofway.viz.verdict import give_verdict

    verdict = give_verdict(plan)
    if not verdict.ok:
        first = write_fault(verdict.faults[0])
        complain(f"{path} shows {summarize_report(verdict)}; {first}")


def refuse_outputs(source: str, output: str | None, *, as_json: bool) -> None:
    """Refuse two documents on standard output, and an output that would replace the source."""
    if output == "-" and as_json:
        raise click.UsageError("--json and -o - both go to standard output")
    if output and output != "-" and Path(output).resolve() == Path(source).resolve():
        raise click.UsageError(f"-o {output} would replace {source} (give another name)")


def put_text(text: str, path: str) -> None:
    """Write a text to a file, or to standard output."""
    if path == "-":
        click.echo(text, nl=False)
    else:
        write_whole(path, text)
        say_written(path)


def write(plan: Plan, output: str | None) -> None:
    """Write a plan to a file, to standard output, or nowhere."""
    from rightofway.io import format_plan

    if output == "-":
        click.echo(format_plan(plan), nl=False)
    elif output:
        PLAN_WRITERS.get(Path(output).suffix.lower(), _write_json)(plan, output)
        say_written(output)
