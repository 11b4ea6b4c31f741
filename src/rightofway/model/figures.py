"""Answers of plans and scenarios that rooms above the model compute or draw.

The model imports no room above. The package, which may import all of them, provides one object with
these answers when it is imported: see `rightofway.figures`.
"""

from __future__ import annotations

from typing import Any, Protocol, cast

from rightofway.model.lost_time import LostTime, Wait
from rightofway.model.units import Tick
from rightofway.provision import provided as _provided


class Figures(Protocol):
    """Figures of plans, and how plans and scenarios look in a notebook.

    ``plan`` and ``scenario`` are objects of `Plan` and `Scenario`, which import this module.
    """

    def compute_alone_completions(self, scenario: Any) -> tuple[Tick, ...]:
        """Return the least completion of each robot without the others [ticks]."""

    def list_waits(self, plan: Any) -> tuple[Wait, ...]:
        """Return all waits of a plan."""

    def compute_lost_time(self, plan: Any) -> tuple[LostTime, ...]:
        """Return the losses of each robot of a plan to others."""

    def make_event_columns(self, plan: Any) -> dict[str, list[Any]]:
        """Return the columns of the table of all visits of a plan."""

    def draw_plan_html(self, plan: Any) -> str:
        """Return the page of a plan in a frame."""

    def bundle_plan(self, plan: Any) -> dict[str, Any]:
        """Return the page of a plan as a live part of a notebook."""

    def draw_scenario_html(self, scenario: Any) -> str:
        """Return the map and the robots of a scenario."""


def get_figures() -> Figures:
    """Return the answers that the package provides."""
    return cast("Figures", _provided["figures"])
