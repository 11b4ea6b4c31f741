"""Layouts of sites, as other programs write them: vertices, lanes, stations; maps as pictures."""

from rightofway.io.layouts.formats import (
    LayoutFormat,
    describe_layout,
    is_layout,
    layout_formats,
    read_layout,
    refuse_layout,
)
from rightofway.io.layouts.graph import layout_of_graph
from rightofway.io.layouts.writing import LAYOUT_WRITERS, layout_text

__all__ = [
    "LAYOUT_WRITERS",
    "LayoutFormat",
    "describe_layout",
    "is_layout",
    "layout_formats",
    "layout_of_graph",
    "layout_text",
    "read_layout",
    "refuse_layout",
]
