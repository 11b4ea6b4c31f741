"""Views of a plan: a page that plays it, a picture, a film, tables.

Page and pictures share `palette` (colours), `placement` (where vertices are drawn) and `motion`
(what each robot does at an instant). Page and pictures are imported when they are first used.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rightofway.viz.notebook import scenario_html
    from rightofway.viz.page.background import Background
    from rightofway.viz.page.document import frame_of, page_of, write_page
    from rightofway.viz.page.inspection import inspection_page, site_data, write_inspection
    from rightofway.viz.page.payload import payload_of
    from rightofway.viz.page.widget import bundle_of
    from rightofway.viz.raster.picture import Film, png_of, write_gif, write_png
    from rightofway.viz.raster.preview import preview_of

_MODULES = {
    "page.background": ("Background",),
    "page.document": ("frame_of", "page_of", "write_page"),
    "page.inspection": ("inspection_page", "site_data", "write_inspection"),
    "page.payload": ("payload_of",),
    "page.widget": ("bundle_of",),
    "raster.picture": ("Film", "png_of", "write_gif", "write_png"),
    "raster.preview": ("preview_of",),
    "notebook": ("scenario_html",),
}

__all__ = [
    "Background",
    "Film",
    "bundle_of",
    "frame_of",
    "inspection_page",
    "page_of",
    "payload_of",
    "png_of",
    "preview_of",
    "scenario_html",
    "site_data",
    "write_gif",
    "write_inspection",
    "write_page",
    "write_png",
]


def __getattr__(name: str) -> Any:
    for module, names in _MODULES.items():
        if name in names:
            return getattr(import_module(f"{__name__}.{module}"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
