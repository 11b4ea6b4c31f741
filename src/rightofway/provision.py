"""What the package provides to rooms below it when it is imported.

It lies at the bottom and imports nothing, so that ``import rightofway`` and the command's
``--version`` import no room.
"""

provided: dict[str, object] = {}
"""An object for each protocol that a room declares, by the name of its module."""
