"""Code of other packages: optional libraries, and plugins that add planners and layout formats.

It is imported where it is used, so that commands that do without it start fast.
"""

from __future__ import annotations

import warnings
from importlib import import_module
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any, TypeVar

from rightofway.errors import InputError, describe_error, quote
from rightofway.kinds.table import make_words

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint

__all__ = ["EXTRAS", "PluginWarning", "list_plugins", "load_library", "load_plugins", "need"]

T = TypeVar("T")

EXTRAS = {
    "distributed": "dask",
    "matplotlib": "bench",
    "openpyxl": "xlsx",
}
"""Optional libraries, and the extra that installs each."""

GROUPS = ("rightofway.planners", "rightofway.layouts")
"""Groups of entry points by which other packages add to this one."""


class PluginWarning(UserWarning):
    """A plugin of another package is left out because it failed."""


def need(library: str, purpose: str) -> None:
    """Refuse with `InputError`, before any work, if an optional library is not installed.

    Parameters
    ----------
    library
        The name of the library.
    purpose
        The feature that needs it, for the message.
    """
    extra = EXTRAS[make_words(*sorted(EXTRAS)).read_at("library", library)]
    if find_spec(library) is None:
        remedy = f"pip install 'rightofway[{extra}]'"
        raise InputError.at("", f"{purpose} needs {library} ({remedy})")


def load_library(module: str, purpose: str) -> Any:
    """Return a module of an optional library, or refuse as `need`."""
    need(module.partition(".")[0], purpose)
    return import_module(module)


def load_plugins(group: str, kind: type[T]) -> dict[str, T]:
    """Return the objects that other packages add by entry points of a group, by name.

    A plugin that fails is left out, with a `PluginWarning` that names it and its package.
    """
    from importlib.metadata import entry_points  # here, because it imports much

    plugins: dict[str, T] = {}
    for point in entry_points(group=group):
        try:
            plugin = point.load()
            if not isinstance(plugin, kind):
                raise TypeError(f"{quote(plugin)} is no {kind.__name__}")  # noqa: TRY301
        except (Exception, SystemExit) as error:  # noqa: BLE001 - code of others
            warnings.warn(_describe_failure(point, error), PluginWarning, stacklevel=2)
        else:
            plugins.setdefault(point.name, plugin)
    return plugins


def list_plugins() -> list[dict[str, str]]:
    """Return the entry points of other packages: name, group, package and its version."""
    from importlib.metadata import entry_points

    return [
        {
            "name": point.name,
            "group": point.group,
            "package": point.dist.name if point.dist else "",
            "version": point.dist.version if point.dist else "",
        }
        for group in GROUPS
        for point in entry_points(group=group)
    ]


def _describe_failure(point: EntryPoint, error: BaseException) -> str:
    package = point.dist.name if point.dist else point.module.partition(".")[0]
    return (
        f"{point.group}: the plugin {point.name} of the package {package} is left out:"
        f" {describe_error(error)} (update or uninstall {package})"
    )
