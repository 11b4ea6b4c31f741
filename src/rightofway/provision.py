"""Objects that the package provides to rooms below it, and lazy imports.

It lies at the bottom and imports no room, so that ``import rightofway`` and the command's
``--version`` import no room.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping, Sequence
from importlib import import_module

provided: dict[str, object] = {}
"""An object for each protocol that a room declares, by the name of its module."""


def import_later(package: str, modules: Mapping[str, Sequence[str]]) -> Callable[[str], object]:
    """Return a package's ``__getattr__``: a module is imported when a name of it is first used.

    Type checkers read the same imports under ``TYPE_CHECKING``. No name may be that of a module.
    """
    homes = {name: module for module, names in modules.items() for name in names}

    def get_later(name: str) -> object:
        if name not in homes:
            raise AttributeError(f"module {package!r} has no attribute {name!r}")
        value: object = getattr(import_module(f"{package}.{homes[name]}"), name)
        setattr(sys.modules[package], name, value)
        return value

    return get_later
