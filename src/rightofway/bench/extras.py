"""Libraries that only some uses need, imported where they are used."""

from __future__ import annotations

from importlib import import_module
from importlib.util import find_spec
from typing import Any

from rightofway.errors import InputError

__all__ = ["need", "needed"]

EXTRAS = {"matplotlib": "bench", "pyarrow": "bench", "distributed": "dask"}


def need(library: str, purpose: str) -> None:
    """Make sure, before any work, that a library is installed.

    Raises
    ------
    InputError
        If it is not; says which extra has it.
    """
    if find_spec(library) is None:
        remedy = f"pip install 'rightofway[{EXTRAS[library]}]'"
        raise InputError.at("", f"{purpose} needs {library} ({remedy})")


def needed(module: str, purpose: str) -> Any:
    """Return a module of such a library.

    Raises
    ------
    InputError
        As `need`.
    """
    need(module.partition(".")[0], purpose)
    return import_module(module)
