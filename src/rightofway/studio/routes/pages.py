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
    """Return a file of the page; the modules of the viewer stand in a folder of their own."""
    suffix = PurePosixPath(path).suffix
    name = path.removeprefix("viewer/")
    parts = name.split("/")
    package = "rightofway.studio" if name == path else "rightofway.viz.page"
    found = files(package).joinpath("assets", *parts)
    if path == "viewer.css":
        content = style_sheet()
    elif suffix in MEDIA and not {"", ".", ".."} & {*parts} and found.is_file():
        content = found.read_text("utf-8")
    else:
        raise Refused(f"there is no asset {path[:100]!r} (open the studio at /)", 404)
    return Response(content, media_type=MEDIA[suffix], headers={"cache-control": "no-cache"})


@about.get("", tags=["studio"])
@about.get("/", include_in_schema=False)
def describe(studio: InStudio) -> dict[str, Any]:
    """Return what this studio is: its version, its folder, the file to open first, its limits."""
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
