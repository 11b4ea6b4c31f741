"""``rightofway schema``: the JSON Schema of our files."""

from __future__ import annotations

from typing import Literal

import click

from rightofway.cli.terminal import put_json

__all__ = ["schema"]


@click.command(epilog="Example:  rightofway schema scenario > scenario.schema.json")
@click.argument("kind", type=click.Choice(["scenario", "plan", "suite"]))
def schema(kind: Literal["scenario", "plan", "suite"]) -> None:
    """Print the JSON Schema of scenario, plan or suite files."""
    from rightofway.io import schema as schema_of

    put_json(schema_of(kind))
