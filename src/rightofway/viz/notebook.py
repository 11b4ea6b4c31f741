"""A plan inside a notebook: the page in a frame of its own."""

from __future__ import annotations

import html
from collections.abc import Sequence

from rightofway.model import ExecutionTrace, Plan, SteadyState
from rightofway.viz.page import page_of

__all__ = ["frame_of"]

HEIGHT = 680
"""Enough for map and diagram [pixels]."""


def frame_of(
    plan: Plan,
    *,
    height: int = HEIGHT,
    steady: Sequence[SteadyState] = (),
    actual: ExecutionTrace | None = None,
) -> str:
    """Return HTML that shows a plan in a notebook; what ``_repr_html_`` is to return.

    Parameters
    ----------
    plan
        The plan.
    height
        Height of the frame [pixels].
    steady
        Where it repeats itself, if the plan does not say it.
    actual
        What became of it on the floor.

    Notes
    -----
    The frame is sandboxed: whatever the names in a plan are, they cannot reach the notebook.
    """
    document = html.escape(page_of(plan, steady=steady, actual=actual))
    style = f"width:100%;height:{height}px;border:0;border-radius:8px"
    return f'<iframe sandbox="allow-scripts" srcdoc="{document}" style="{style}"></iframe>'
