"""Fleets that are driven: their pages, what happens to them, orders of people."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import APIRouter, Body, Request
from fastapi.responses import HTMLResponse, StreamingResponse

from rightofway.studio.errors import Refused
from rightofway.studio.watching import Watched

router = APIRouter(include_in_schema=False)


def _watched(request: Request, number: int) -> Watched:
    drives: dict[int, Watched] = request.app.state.drives
    if number not in drives:
        raise Refused(f"no fleet {number} is driven here (open the page of one that is)", 404)
    return drives[number]


@router.get("/drives/{number}/")
async def get_page(request: Request, number: int) -> HTMLResponse:
    """Return the page of a fleet."""
    page = _watched(request, number).make_page()
    policy = page.partition('http-equiv="Content-Security-Policy" content="')[2].partition('"')[0]
    return HTMLResponse(page, headers={"content-security-policy": policy})


@router.get("/drives/{number}/stream")
async def get_stream(request: Request, number: int) -> StreamingResponse:
    """Send what happens as server-sent events, from the last one on that the page has."""
    known = request.headers.get("last-event-id", request.query_params.get("known", ""))
    frames = _watched(request, number).stream_frames(known)
    return StreamingResponse(frames, media_type="text/event-stream")


@router.post("/drives/{number}/orders")
def give_order(
    request: Request, number: int, order: Annotated[dict[str, Any], Body()]
) -> dict[str, Any]:
    """Ask the control of a fleet for something."""
    return dict(_watched(request, number).give_order(order))
