"""``rightofway convert`` and ``rightofway schema``: the file formats."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Literal

import click

from rightofway.cli.terminal import put_json, read_scenario, say, writable
from rightofway.errors import InputError

if TYPE_CHECKING:
    from rightofway.model import Scenario

EXAMPLES = """\b
Examples:
  rightofway convert examples/warehouse.yaml warehouse.json
  rightofway convert maze.scen maze.yaml
  rightofway convert hall.yaml hall.scen
"""


@click.command(epilog=EXAMPLES, short_help="Write a scenario in another format.")
@click.argument("source", type=click.Path())
@click.argument("target", type=click.Path(), callback=writable(".yaml", ".yml", ".json", ".scen"))
def convert(source: str, target: str) -> None:
    """Write the scenario SOURCE as TARGET: .yaml, .json, or .scen with its .map beside it.

    A .yaml or .json holds its map, so that it needs no other file. A .scen holds no speeds, work,
    turning and ways home; the command reports which of these it left out.
    """
    from rightofway.io import write_scenario

    scenario = read_scenario(source)
    if Path(target).suffix.lower() == ".scen":
        _write_pair(scenario, Path(target))
    else:
        write_scenario(scenario, target)
        say(f"wrote {target}")


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
