"""The page of the studio: its markup, its modules, and the modules of the viewer."""

from __future__ import annotations

from importlib.resources import files
from pathlib import PurePosixPath
from typing import Any

from fastapi import APIRouter, Response

from rightofway import __version__
from rightofway.io import schema
from rightofway.studio.errors import Refused
from rightofway.studio.guard import MAX_BODY
from rightofway.studio.routes.models import MAX_SECONDS, InStudio
from rightofway.viz.page.document import style_sheet
from rightofway.viz.page.module import viewer_module

MEDIA = {
    ".css": "text/css; charset=utf-8",
    ".html": "text/html; charset=utf-8",
    ".js": "text/javascript; charset=utf-8",
    ".svg": "image/svg+xml",
}
"""Media types of assets, by ending."""

router = APIRouter(include_in_schema=False)
about = APIRouter()


@router.get("/")
def index() -> Response:
    """Return the page."""
    return asset("index.html")


@router.get("/assets/{path:path}")
def asset(path: str) -> Response:
    """Return a file of the page."""
    suffix = PurePosixPath(path).suffix
    if path == "viewer.js":
        content = viewer_module()
    elif path == "viewer.css":
        content = style_sheet()
    else:
        found = files("rightofway.studio").joinpath("assets", *PurePosixPath(path).parts)
        if suffix not in MEDIA or not found.is_file():
            raise Refused(f"there is no asset {path[:100]!r} (open the studio at /)", 404)
        content = found.read_text("utf-8")
    return Response(content, media_type=MEDIA[suffix], headers={"cache-control": "no-cache"})


@about.get("/", tags=["studio"])
def describe(studio: InStudio) -> dict[str, Any]:
    """Tell what this studio is: its version, its folder, the file to open first, its limits."""
    return {
        "version": __version__,
        "folder": studio.workspace.folder.name,
        "file": studio.file,
        "keeps": studio.store.is_kept,
        "limits": {
            "body": MAX_BODY,
            "seconds": MAX_SECONDS,
            "runs_at_once": studio.planners.size,
        },
    }


@about.get("/schema", tags=["studio"])
def scenario_schema() -> dict[str, Any]:
    """Return the JSON Schema of scenarios, as `rightofway schema scenario` prints it."""
    return schema("scenario")
