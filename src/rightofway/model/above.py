"""Answers of plans and scenarios that are made in rooms above the model."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from typing import Any

ROOMS_ABOVE = {
    "alone_completions": "rightofway.metrics",
    "bundle_of": "rightofway.viz",
    "event_columns": "rightofway.metrics",
    "frame_of": "rightofway.viz",
    "lost_time": "rightofway.metrics",
    "scenario_html": "rightofway.viz",
    "waits": "rightofway.metrics",
}
"""Room of each function, by name: the model imports no room above, and works without."""


def from_above(function: str) -> Callable[..., Any]:
    """Return a function of a room above, imported when a plan or a scenario needs it.

    Parameters
    ----------
    function
        One of `ROOMS_ABOVE`.
    """
    found: Callable[..., Any] = getattr(import_module(ROOMS_ABOVE[function]), function)
    return found
