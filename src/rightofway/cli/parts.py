"""Parts of the command line by name: every command, and the server of the live page.

Parts may belong to rooms above `cli`, which import its options and its output. A part is imported
when it is used, so a command loads no other command.
"""

from __future__ import annotations

from importlib import import_module
from typing import Any, cast

import click

GROUPS: dict[str, dict[str, str]] = {
    "Begin": {
        "new": "cli.examples",
        "examples": "cli.examples",
        "inspect": "cli.inspect",
        "studio": "studio.command_line",
    },
    "Plan": {"plan": "cli.planning", "improve": "cli.planning", "bound": "cli.planning"},
    "Look at plans": {
        "check": "cli.views",
        "show": "cli.views",
        "table": "cli.tables",
        "collisions": "cli.collisions",
    },
    "Repeated work, delays and shifts": {
        "laps": "cli.laps",
        "simulate": "cli.simulate",
        "shift": "cli.shift",
    },
    "Drive": {
        "drive": "control.command_line.drive",
        "jobs": "control.command_line.jobs",
        "robots": "control.command_line.robots",
        "probe": "control.command_line.probe",
    },
    "Compare": {"bench": "cli.bench", "paper": "cli.paper"},
    "Formats": {"convert": "cli.formats", "schema": "cli.formats"},
    "Help": {"help": "cli.manual", "completion": "cli.manual"},
}
"""The commands with their modules in the package, by purpose, in the order of help."""

MODULES = {name: module for group in GROUPS.values() for name, module in group.items()}


def load_command(name: str) -> click.Command:
    """Import the module of a command, and return the command."""
    return cast("click.Command", getattr(_load_module(MODULES[name]), name))


def load_page_server() -> Any:
    """Import the server of the page on which people watch robots: `Watched`, `serve_watch`."""
    return _load_module("studio.serve")


def _load_module(module: str) -> Any:
    return import_module(f"rightofway.{module}")
