"""Libraries that are not installed with the package: each comes with an extra of it.

They are imported where they are used, so that commands that do without them start fast.
"""

from __future__ import annotations

from importlib import import_module
from importlib.util import find_spec
from typing import Any

from rightofway.arguments import checks_arguments, get_value
from rightofway.errors import InputError

__all__ = ["EXTRAS", "load_library", "need"]

EXTRAS = {
    "distributed": "dask",
    "matplotlib": "bench",
    "openpyxl": "xlsx",
    "pyarrow": "bench",
}
"""Optional libraries, and the extra that installs each."""


@checks_arguments
def need(library: str, purpose: str) -> None:
    """Refuse with `InputError`, before any work, if an optional library is not installed.

    Parameters
    ----------
    library
        The name of the library.
    purpose
        What needs it, for the message.
    """
    extra = get_value(EXTRAS, library, "library")
    if find_spec(library) is None:
        remedy = f"pip install 'rightofway[{extra}]'"
        raise InputError.at("", f"{purpose} needs {library} ({remedy})")


def load_library(module: str, purpose: str) -> Any:
    """Return a module of an optional library, or refuse as `need`."""
    need(module.partition(".")[0], purpose)
    return import_module(module)
