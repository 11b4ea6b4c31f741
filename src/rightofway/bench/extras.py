"""Libraries of optional extras, imported where they are used."""

from __future__ import annotations

from importlib import import_module
from importlib.util import find_spec
from typing import Any

from rightofway.errors import InputError

__all__ = ["need", "needed"]

EXTRAS = {"matplotlib": "bench", "pyarrow": "bench", "distributed": "dask"}


def need(library: str, purpose: str) -> None:
    """Refuse with `InputError`, before any work, if a library is not installed."""
    if find_spec(library) is None:
        remedy = f"pip install 'rightofway[{EXTRAS[library]}]'"
        raise InputError.at("", f"{purpose} needs {library} ({remedy})")


def needed(module: str, purpose: str) -> Any:
    """Return a module of an optional library, or refuse as `need`."""
    need(module.partition(".")[0], purpose)
    return import_module(module)
