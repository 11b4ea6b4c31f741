"""How the native core was built."""

from __future__ import annotations

from rightofway import _core

__all__ = ["compiler"]


def compiler() -> str:
    """Return the name and version of what compiled the native core, like ``GCC 12.2.0``."""
    return _core.compiler()
