"""Input of commands: scenarios and plans, ours and those of other programs."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from rightofway.cli.completion import complete_files
from rightofway.cli.options import Whole
from rightofway.cli.terminal import say_of

if TYPE_CHECKING:
    from rightofway.io import Loaded
    from rightofway.model import Plan, Scenario

FILES = "rightofway.files."
"""Key of the files that belong to a plan of another program, in the context of a command."""

count_option = click.option(
    "-k",
    "--count",
    type=Whole(1),
    metavar="K",
    help="Take the first K robots of a .scen file; all by default.",
)


jobs_option = click.option(
    "--jobs",
    metavar="FILE",
    type=click.Path(),
    shell_complete=complete_files(".csv", ".yaml", ".yml", ".json", ".xml"),
    help="Take the jobs of this file: CSV, YAML or JSON, orders of openTCS or Open-RMF.",
)


def read_scenario(path: str, count: int | None = None, jobs: str | None = None) -> Scenario:
    """Read a scenario, or the first robots of a .scen file, and write its reader's notes.

    ``-`` is standard input.
    """
    from rightofway.io import load_with_notes

    return note_loaded(load_with_notes(path, count=count, jobs=jobs), path)


def _keep_file(context: click.Context, parameter: click.Parameter, given: str | None) -> None:
    suffix = f".{parameter.name}"
    if given is not None and Path(given).suffix.lower() != suffix:
        raise click.BadParameter(f"{given!r} does not end in {suffix} (give a {suffix} file)")
    context.meta[f"{FILES}{parameter.name}"] = given


def add_foreign_options(command: Any) -> Any:
    """Add the files that a plan of another program may need; `read_plan` finds them."""
    for name, content in (("scen", "starts and goals (.scen)"), ("map", "map (.map)")):
        command = click.option(
            f"--{name}", metavar="FILE", expose_value=False, callback=_keep_file,
            help=f"The {content} of a plan of another program.",
        )(command)  # fmt: skip
    return command


def _list_files() -> dict[str, str | None]:
    """Return the files of `add_foreign_options`."""
    meta = click.get_current_context().meta
    return {"map_file": meta.get(f"{FILES}map"), "scen": meta.get(f"{FILES}scen")}


def list_own(paths: Sequence[str]) -> Collection[str]:
    """Return the plans that need no files of `add_foreign_options`, as others among them do."""
    from rightofway.io import is_foreign

    if len(paths) == 1 or not any(_list_files().values()):
        return ()
    own = [path for path in paths if not is_foreign(path)]
    return own if len(own) < len(paths) else ()


def read_plan(path: str, own: Collection[str] = ()) -> Plan:
    """Read a plan, ours or of another program; ``-`` is standard input."""
    from rightofway.io import load_plan

    return load_plan(path) if path in own else load_plan(path, **_list_files())


def read_either(path: str, count: int | None = None, own: Collection[str] = ()) -> Plan | Scenario:
    """Read a plan or a scenario; ``-`` is standard input."""
    from rightofway.io import Loaded, load_either

    opened = load_either(path, count=count, **({} if path in own else _list_files()))
    return note_loaded(opened, path) if isinstance(opened, Loaded) else opened


def note_loaded(loaded: Loaded, path: str) -> Scenario:
    """Write the notes of a scenario's reader, and return the scenario."""
    from rightofway.report.facts import write_notes

    for note in write_notes(loaded.notes):
        say_of(path, note)
    return loaded.scenario
