"""What the package provides to rooms below it when it is imported, and names that have changed.

It lies at the bottom and imports nothing, so that ``import rightofway`` and the command's
``--version`` import no room.
"""

provided: dict[str, object] = {}
"""An object for each protocol that a room declares, by the name of its module."""


def warn_of_rename(module: str, earlier: str, name: str) -> None:
    """Warn the caller of a module's ``__getattr__`` that a name has become another one."""
    from warnings import warn

    message = f"{module}.{earlier} is now {name} (use that name)"
    warn(message, DeprecationWarning, stacklevel=3)
