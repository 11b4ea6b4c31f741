"""``rightofway convert`` and ``rightofway schema``: the file formats."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Literal

import click

from rightofway.cli.completion import SCENARIOS, files
from rightofway.cli.terminal import count_option, put_json, read_scenario, say, writable
from rightofway.errors import InputError

if TYPE_CHECKING:
    from rightofway.model import Scenario

EXAMPLES = """\b
Examples:
  rightofway convert examples/warehouse.yaml -o warehouse.json
  rightofway convert maze.scen -k 50 -o maze.yaml
  rightofway convert hall.yaml -o hall.scen
"""

SUFFIXES = (".yaml", ".yml", ".json", ".xlsx", ".scen")


@click.command(epilog=EXAMPLES, short_help="Write a scenario in another format.")
@click.argument("source", type=click.Path(), shell_complete=files(*SCENARIOS))
@click.argument("target", type=click.Path(), required=False, callback=writable(*SUFFIXES))
@count_option
@click.option("-o", "--output", metavar="TARGET", callback=writable(*SUFFIXES),
              help="File to write, the same as the argument TARGET; - prints YAML.")  # fmt: skip
def convert(source: str, target: str | None, count: int | None, output: str | None) -> None:
    """Write the scenario SOURCE as .yaml, .json, .xlsx, or .scen with its .map.

    A .yaml, .json or .xlsx file contains the map. A .scen file has no speeds, work times, turning
    times and ways home; the command reports which of these it left out.
    """
    from rightofway.io import scenario_text, write_scenario

    if (target is None) == (output is None):
        raise click.UsageError("give one file to write: convert SOURCE -o TARGET")
    path = target or output or ""
    scenario = read_scenario(source, count)
    if path == "-":
        click.echo(scenario_text(scenario), nl=False)
    elif Path(path).suffix.lower() == ".scen":
        _write_pair(scenario, Path(path))
    else:
        write_scenario(scenario, path)
        say(f"wrote {path}")


def _write_pair(scenario: Scenario, path: Path) -> None:
    from rightofway.io import write_map, write_scen

    map_path = path.with_suffix(".map")
    try:
        losses = write_scen(scenario, path, map_name=map_path.name)
    except InputError as error:
        raise InputError(error.faults, error.source or str(path)) from None
    write_map(scenario.roadmap, map_path)
    for loss in losses:
        say(f"{path}: {loss}")
    say(f"wrote {path} and {map_path}")


@click.command(epilog="Example:  rightofway schema scenario > scenario.schema.json")
@click.argument("kind", type=click.Choice(["scenario", "plan", "suite"]))
def schema(kind: Literal["scenario", "plan", "suite"]) -> None:
    """Print the JSON Schema of scenario, plan or suite files."""
    from rightofway.io import schema as schema_of

    put_json(schema_of(kind))
