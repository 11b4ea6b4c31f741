"""Layouts of sites, as other programs write them: vertices, lanes, stations; maps as pictures.

Each part is imported when it is first used: `scenario` documents need the curves alone.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from rightofway.provision import import_later

if TYPE_CHECKING:
    from rightofway.io.layouts.formats import (
        LayoutFormat,
        describe_layout,
        is_layout,
        list_layout_formats,
        read_layout,
        refuse_layout,
    )
    from rightofway.io.layouts.graph import make_layout_of_graph
    from rightofway.io.layouts.writing import LAYOUT_WRITERS, format_layout

_MODULES = {
    "formats": (
        "LayoutFormat",
        "describe_layout",
        "is_layout",
        "list_layout_formats",
        "read_layout",
        "refuse_layout",
    ),
    "graph": ("make_layout_of_graph",),
    "writing": ("LAYOUT_WRITERS", "format_layout"),
}

__all__ = [
    "LAYOUT_WRITERS",
    "LayoutFormat",
    "describe_layout",
    "format_layout",
    "is_layout",
    "list_layout_formats",
    "make_layout_of_graph",
    "read_layout",
    "refuse_layout",
]

if not TYPE_CHECKING:  # a checker would take any misspelt name for an object
    __getattr__ = import_later(__name__, _MODULES)
