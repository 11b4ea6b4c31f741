"""Views of a plan: a page that plays it, a picture, a film, tables.

Page and pictures share `palette` (colours), `placement` (where vertices are drawn) and `motion`
(the activity of each robot at an instant). Page and pictures are imported when they are first used.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from rightofway.provision import import_later

if TYPE_CHECKING:
    from rightofway.viz.notebook import make_scenario_html
    from rightofway.viz.page.background import Background
    from rightofway.viz.page.document import make_frame, make_page, write_page
    from rightofway.viz.page.inspection import (
        make_inspection_page,
        make_site_data,
        write_inspection,
    )
    from rightofway.viz.page.payload import make_payload
    from rightofway.viz.page.shift_data import make_shift_page, write_shift_page
    from rightofway.viz.page.widget import bundle_of
    from rightofway.viz.raster.picture import Film, make_png, write_gif, write_png
    from rightofway.viz.raster.preview import make_preview

_MODULES = {
    "page.background": ("Background",),
    "page.document": ("make_frame", "make_page", "write_page"),
    "page.inspection": ("make_inspection_page", "make_site_data", "write_inspection"),
    "page.payload": ("make_payload",),
    "page.shift_data": ("make_shift_page", "write_shift_page"),
    "page.widget": ("bundle_of",),
    "raster.picture": ("Film", "make_png", "write_gif", "write_png"),
    "raster.preview": ("make_preview",),
    "notebook": ("make_scenario_html",),
}

__all__ = [
    "Background",
    "Film",
    "bundle_of",
    "make_frame",
    "make_inspection_page",
    "make_page",
    "make_payload",
    "make_png",
    "make_preview",
    "make_scenario_html",
    "make_shift_page",
    "make_site_data",
    "write_gif",
    "write_inspection",
    "write_page",
    "write_png",
    "write_shift_page",
]

if not TYPE_CHECKING:  # a checker would take any misspelt name for an object
    __getattr__ = import_later(__name__, _MODULES)
