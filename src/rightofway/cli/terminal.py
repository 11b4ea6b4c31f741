"""What all commands share: where words go, and the files they read."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from rightofway.io import Loaded
    from rightofway.model import Plan, Scenario

__all__ = ["put", "put_json", "read_either", "read_plan", "read_scenario", "say"]


def say(message: str) -> None:
    """Tell the user something that is not the result."""
    click.echo(message, err=True)


def put(text: str) -> None:
    """Give out a result."""
    click.echo(text)


def put_json(value: Any) -> None:
    """Give out a result for programs."""
    click.echo(json.dumps(value, indent=1, ensure_ascii=False))


def read_scenario(path: str) -> Scenario:
    """Read a scenario and pass on what its reader has to say; ``-`` is standard input."""
    from rightofway.io import read

    return _noted(read(_source(path)), path)


def read_plan(path: str) -> Plan:
    """Read a plan; ``-`` is standard input."""
    from rightofway.io import load_plan

    return load_plan(_source(path))


def read_either(path: str) -> Plan | Scenario:
    """Read a plan or a scenario, whichever it is; ``-`` is standard input."""
    from rightofway.io import Loaded, read_either

    found = read_either(_source(path))
    return _noted(found, path) if isinstance(found, Loaded) else found


def _noted(loaded: Loaded, path: str) -> Scenario:
    for note in loaded.notes:
        say(f"{path}: {note}")
    return loaded.scenario


def _source(path: str) -> str:
    return "/dev/stdin" if path == "-" else path
