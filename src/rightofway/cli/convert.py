"""``rightofway convert``: one file format into another."""

from __future__ import annotations

from pathlib import Path

import click

from rightofway.cli.terminal import read_scenario, say
from rightofway.errors import InputError

__all__ = ["convert"]

EXAMPLE = """\b
Examples:
  rightofway convert examples/warehouse.yaml warehouse.json
  rightofway convert maze.scen maze.yaml
  rightofway convert hall.yaml hall.scen
"""


@click.command(epilog=EXAMPLE)
@click.argument("source", type=click.Path())
@click.argument("target", type=click.Path())
def convert(source: str, target: str) -> None:
    """Write the scenario SOURCE as TARGET: .yaml, .json, or .scen with its .map beside it.

    The map goes into a .yaml or .json, so that it needs no other file. What a .scen cannot say
    (speeds, work, turning, ways home) is named.
    """
    from rightofway.io import save_scenario, write_map, write_scen

    suffix = Path(target).suffix.lower()
    if suffix not in {".yaml", ".yml", ".json", ".scen"}:
        raise InputError.at("TARGET", f"{target!r} is no .yaml, .json or .scen (name one of them)")
    scenario = read_scenario(source)
    if suffix != ".scen":
        save_scenario(scenario, target)
        say(f"wrote {target}")
        return
    map_path = Path(target).with_suffix(".map")
    for loss in write_scen(scenario, target, map_name=map_path.name):
        say(loss)
    write_map(scenario.roadmap, map_path)
    say(f"wrote {target} and {map_path}")
