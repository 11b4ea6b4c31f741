"""What plans and scenarios answer although rooms above the model compute or draw it.

The model imports no room above. The package, which may import all of them, provides one object with
these answers when it is imported: see `rightofway.figures`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol, cast

from rightofway.provision import provided as _provided

if TYPE_CHECKING:
    from rightofway.model.lost_time import LostTime
    from rightofway.model.plan import Plan, Wait
    from rightofway.model.scenario import Scenario
    from rightofway.model.units import Tick


class Figures(Protocol):
    """Figures of plans, and how plans and scenarios look in a notebook."""

    def compute_alone_completions(self, scenario: Scenario) -> tuple[Tick, ...]:
        """Return the least completion of each robot without the others [ticks]."""

    def list_waits(self, plan: Plan) -> tuple[Wait, ...]:
        """Return all waits of a plan."""

    def compute_lost_time(self, plan: Plan) -> tuple[LostTime, ...]:
        """Return what each robot of a plan loses to others."""

    def make_event_columns(self, plan: Plan) -> dict[str, list[Any]]:
        """Return the columns of the table of all visits of a plan."""

    def draw_plan_html(self, plan: Plan) -> str:
        """Return the page of a plan in a frame."""

    def bundle_plan(self, plan: Plan) -> dict[str, Any]:
        """Return the page of a plan as a live part of a notebook."""

    def draw_scenario_html(self, scenario: Scenario) -> str:
        """Return the map and the robots of a scenario."""


def get_figures() -> Figures:
    """Return what the package provides."""
    return cast("Figures", _provided["figures"])
