"""Names on the map of a page, and where they stand."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from tests.builders.browsers import Viewer


def labels(viewer: Viewer) -> list[dict[str, Any]]:
    """Return the names on the map, each with its box [pixels]."""
    viewer.wait_for("!frames.asked")
    found: list[dict[str, Any]] = viewer.ask("mapView.names.written")
    return found


def overlap(one: list[float], other: list[float]) -> bool:
    """Return whether two boxes (left, top, right, bottom) share more than an edge."""
    return (
        min(one[2], other[2]) - max(one[0], other[0]) > 0.01
        and min(one[3], other[3]) - max(one[1], other[1]) > 0.01
    )
