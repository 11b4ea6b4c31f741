"""The answers of plans and scenarios that rooms above the model give; provided by the package.

Rooms are imported at the first answer, so that ``import rightofway`` stays fast.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rightofway.model import LostTime, Plan, Scenario, Tick, Wait


class PackageFigures:
    """`rightofway.model.figures.Figures` by the rooms of this package."""

    def compute_alone_completions(self, scenario: Scenario) -> tuple[Tick, ...]:
        """Return the least completion of each robot without the others [ticks]."""
        from rightofway.metrics import compute_alone_completions

        return compute_alone_completions(scenario)

    def list_waits(self, plan: Plan) -> tuple[Wait, ...]:
        """Return all waits of a plan."""
        from rightofway.metrics import waits

        return waits(plan)

    def compute_lost_time(self, plan: Plan) -> tuple[LostTime, ...]:
        """Return what each robot of a plan loses to others."""
        from rightofway.metrics import compute_lost_time

        return compute_lost_time(plan)

    def make_event_columns(self, plan: Plan) -> dict[str, list[Any]]:
        """Return the columns of the table of all visits of a plan."""
        from rightofway.metrics import make_event_columns

        return make_event_columns(plan)

    def draw_plan_html(self, plan: Plan) -> str:
        """Return the page of a plan in a frame."""
        from rightofway.viz import make_frame

        return make_frame(plan)

    def bundle_plan(self, plan: Plan) -> dict[str, Any]:
        """Return the page of a plan as a live part of a notebook."""
        from rightofway.viz import bundle_of

        return bundle_of(plan)

    def draw_scenario_html(self, scenario: Scenario) -> str:
        """Return the map and the robots of a scenario."""
        from rightofway.viz import make_scenario_html

        return make_scenario_html(scenario)
