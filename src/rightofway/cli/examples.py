"""``rightofway new`` and ``rightofway examples``: files to begin with."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import click

from rightofway.cli.completion import complete_words
from rightofway.cli.options import require_writable
from rightofway.cli.terminal import say, say_written
from rightofway.errors import InputError, find_nearest
from rightofway.files import write_whole
from rightofway.report.examples import (
    SUFFIXES,
    find_examples_folder,
    list_example_names,
    read_first_sentence,
)

NEW_EXAMPLES = """\b
Examples:
  rightofway new hall.yaml
  rightofway plan hall.yaml --page hall.html
"""

EXAMPLES_EXAMPLES = """\b
Examples:
  rightofway examples
  rightofway examples door -o door.yaml
  rightofway examples --copy .
"""


def _write_commented(path: str) -> None:
    template = Path(__file__).with_name("template.yaml").read_text(encoding="utf-8")
    write_whole(path, template.replace("{file}", path))


def _write_workbook(path: str) -> None:
    from rightofway.io.workbook import write_template

    write_template(path)


TEMPLATES: dict[str, Callable[[str], None]] = {
    ".yaml": _write_commented,
    ".yml": _write_commented,
    ".xlsx": _write_workbook,
}
"""For each ending of a scenario file the function that writes its template."""


@click.command(epilog=NEW_EXAMPLES, short_help="Write a scenario with comments, to be edited.")
@click.argument("file", type=click.Path(), callback=require_writable(*TEMPLATES, stdout=False))
def new(file: str) -> None:
    """Write a small scenario to FILE, with a comment for each key, to be edited.

    A FILE that exists is left alone.
    """
    if Path(file).exists():
        raise InputError.at("", "the file exists (give another name, or remove it)", file)
    TEMPLATES[Path(file).suffix.lower()](file)
    say(f"wrote {file} (edit it, then: rightofway plan {file} --page plan.html)")


@click.command(epilog=EXAMPLES_EXAMPLES, short_help="List, print or copy the example files.")
@click.argument("name", required=False, shell_complete=complete_words(list_example_names))
@click.option("-o", "--output", metavar="FILE", callback=require_writable(),
              help="Write the example NAME to this file, with its maps in the same folder.",
              )  # fmt: skip
@click.option("--copy", "parent", metavar="FOLDER", type=click.Path(exists=True, file_okay=False),
              help="Copy all examples to FOLDER/examples.")  # fmt: skip
def examples(name: str | None, output: str | None, parent: str | None) -> None:
    """List the examples, or print the example NAME."""
    if parent is not None:
        if name or output:
            raise click.UsageError("--copy copies all examples (leave out the name and -o)")
        _copy_all(Path(parent) / "examples")
    elif name is None:
        if output:
            raise click.UsageError("-o writes one example (give its name)")
        _list()
    else:
        example = _locate_example(name)
        if output in {None, "-"}:
            click.echo(example.read_text(encoding="utf-8"), nl=False)
        else:
            _write(example, Path(output or ""))


def _locate_example(name: str) -> Path:
    stem = name.removesuffix(".yaml").removesuffix(".toml").removeprefix("examples/")
    known = list_example_names()
    within = [candidate for candidate in known if candidate.endswith(f"/{stem}")]
    if stem not in known and len(within) == 1:
        stem = within[0]
    if stem not in known:
        meant = find_nearest(stem, known)
        remedy = f"did you mean {meant}?" if meant else f"give one of: {', '.join(known)}"
        raise click.BadParameter(f"{name!r} is not an example ({remedy})", param_hint="NAME")
    beside = find_examples_folder() / stem
    return next(path for path in map(beside.with_suffix, SUFFIXES) if path.is_file())


def _list() -> None:
    rows = [(name, read_first_sentence(_locate_example(name))) for name in list_example_names()]
    formatter = click.HelpFormatter(width=80)
    formatter.write_dl(rows)
    click.echo(formatter.getvalue(), nl=False)


def _write(example: Path, target: Path) -> None:
    """Write an example, and beside it, in the same subfolders, the files that it names."""
    text = example.read_text(encoding="utf-8")
    folder = example.parent
    companions = [path for path in folder.rglob("*") if path.is_file() and path != example]
    for path in companions:
        name = path.relative_to(folder)
        if name.as_posix() not in text:
            continue
        beside = target.parent / name
        if beside.exists() and beside.read_bytes() != path.read_bytes():
            message = "another file of this name exists (choose another folder for the example)"
            raise InputError.at("", message, str(beside))
        beside.parent.mkdir(parents=True, exist_ok=True)
        write_whole(beside, path.read_bytes())
        say_written(beside)
    write_whole(target, text)
    say_written(target)


def _copy_all(target: Path) -> None:
    if target.exists():
        raise InputError.at("", "exists (give another folder, or remove it)", str(target))
    folder = find_examples_folder()
    for path in sorted(folder.rglob("*")):
        if path.is_file():
            copy = target / path.relative_to(folder)
            copy.parent.mkdir(parents=True, exist_ok=True)
            write_whole(copy, path.read_bytes())
    door = str(target / "door.yaml")
    say(f"wrote {target} (for example: rightofway plan {door})")
