"""Layouts of sites, as other programs write them: vertices, lanes, stations; maps as pictures."""

from rightofway.io.layouts.formats import (
    LayoutFormat,
    described,
    is_layout,
    layout_formats,
    read_layout,
    refuse_layout,
)

__all__ = [
    "LayoutFormat",
    "described",
    "is_layout",
    "layout_formats",
    "read_layout",
    "refuse_layout",
]
