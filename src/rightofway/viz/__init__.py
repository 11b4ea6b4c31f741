"""Views of a plan: a page that plays it, a picture, a film, tables.

Page and pictures share `palette` (colours), `placement` (where vertices are drawn) and `motion`
(what each robot does at an instant). Page and pictures are imported when they are first used.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rightofway.viz.page import frame_of, page_of, payload_of, write_page
    from rightofway.viz.raster import Film, write_gif, write_png

_LATER = dict.fromkeys(("Film", "write_gif", "write_png"), "raster") | dict.fromkeys(
    ("frame_of", "page_of", "payload_of", "write_page"), "page"
)

__all__ = [
    "Film",
    "frame_of",
    "page_of",
    "payload_of",
    "write_gif",
    "write_page",
    "write_png",
]


def __getattr__(name: str) -> Any:
    if name not in _LATER:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_LATER[name]}"), name)
