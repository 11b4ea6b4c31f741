"""Help of commands, the manual page of all of them, and scripts for completion in a shell."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import reduce
from importlib import import_module
from inspect import cleandoc
from typing import cast

import click
from click.shell_completion import ShellComplete, get_completion_class

from rightofway import __version__

SHELLS = ("bash", "zsh", "fish")

HELP_EXAMPLES = """\b
Examples:
  rightofway help plan
  rightofway help --man | man -l -
"""

COMPLETION_EXAMPLES = """\b
Examples:
  eval "$(rightofway completion bash)"
  rightofway completion fish > ~/.config/fish/completions/rightofway.fish
"""


@click.command(epilog=HELP_EXAMPLES, short_help="Show the help of a command, or a manual page.")
@click.argument("words", nargs=-1, metavar="[COMMAND]...")
@click.option("--man", is_flag=True, help="Print a manual page of the command and those below it.")
@click.pass_context
def help(context: click.Context, words: Sequence[str], *, man: bool) -> None:  # noqa: A001
    """Show the help of a COMMAND as its --help does, or of the program."""
    command = reduce(_enter_command, words, context.find_root())
    click.echo("\n".join(_write_manual(command)) if man else command.get_help())


@click.command(
    epilog=COMPLETION_EXAMPLES, short_help="Print the script that completes commands in a shell."
)
@click.argument("shell", type=click.Choice(SHELLS))
@click.pass_context
def completion(context: click.Context, shell: str) -> None:
    """Print the script with which a SHELL completes commands, options and files."""
    import_module("rightofway.cli.completion")  # its class for Bash replaces the one of click
    script_of = cast("type[ShellComplete]", get_completion_class(shell))
    root = context.find_root()
    click.echo(script_of(root.command, {}, "rightofway", "_RIGHTOFWAY_COMPLETE").source())


def _enter_command(context: click.Context, word: str) -> click.Context:
    """Return the context of a command of a group."""
    group = context.command
    command = group.get_command(context, word) if isinstance(group, click.Group) else None
    if command is None:
        path = context.command_path
        message = f"{path} has no command {word!r} (`{path} --help` shows what there is)."
        raise click.UsageError(message, context)
    return click.Context(command, parent=context, info_name=word, color=context.color)


def _write_manual(context: click.Context) -> Iterator[str]:
    """Yield the lines of a manual page in roff, of a command and all commands below it."""
    path = context.command_path
    yield f'.TH "{path.replace(" ", "-").upper()}" "1" "" "rightofway {__version__}"'
    summary = context.command.get_short_help_str(limit=1000).rstrip(".")
    yield from [".SH NAME", f"{_escape(path)} \\- {_escape(summary)}"]
    yield ".SH SYNOPSIS"
    pieces = " ".join(context.command.collect_usage_pieces(context))
    yield f"\\fB{_escape(path)}\\fR {_escape(pieces)}"
    yield ".SH DESCRIPTION"
    yield from _write_paragraphs(context.command.help)
    yield from _write_options(context)
    commands = _list_below(context)
    if commands:
        yield ".SH COMMANDS"
    for below in commands:
        pieces = " ".join(below.command.collect_usage_pieces(below))
        yield f'.SS "{_escape(below.command_path)} {_escape(pieces)}"'
        yield from _write_paragraphs(below.command.help)
        yield from _write_options(below)
        yield from _write_paragraphs(below.command.epilog)


def _list_below(context: click.Context) -> list[click.Context]:
    """Return the contexts of all commands below a group, each group before its commands."""
    group = context.command
    if not isinstance(group, click.Group):
        return []
    commands = [_enter_command(context, word) for word in group.list_commands(context)]
    return [below for entered in commands for below in (entered, *_list_below(entered))]


def _write_options(context: click.Context) -> Iterator[str]:
    """Yield each option with its help."""
    for parameter in context.command.get_params(context):
        record = parameter.get_help_record(context)
        if record is not None and record[1]:
            yield from [".TP", f"\\fB{_escape(record[0])}\\fR", _escape(record[1])]


def _write_paragraphs(text: str | None) -> Iterator[str]:
    """Yield paragraphs; those with the mark of click for it keep their lines."""
    for paragraph in cleandoc(text or "").partition("\f")[0].split("\n\n"):
        lines = [line for line in paragraph.splitlines() if line.strip() != "\b"]
        as_written = "\b" in paragraph
        yield ".PP"
        yield from [".nf"] * as_written
        yield from map(_escape, lines)
        yield from [".fi"] * as_written


def _escape(text: str) -> str:
    """Return text as roff prints it: none of its characters is a sign of roff."""
    plain = text.replace("\\", "\\e").replace("-", "\\-").replace("\b", "")
    escaped = "".join(sign if sign.isascii() else f"\\[u{ord(sign):04X}]" for sign in plain)
    return f"\\&{escaped}" if escaped.startswith((".", "'")) else escaped
