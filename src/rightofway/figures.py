"""Answers that rooms above the model give to objects of the rooms below.

Rooms are imported at the first answer, so that ``import rightofway`` stays fast.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rightofway.check import Fault, Report
    from rightofway.facts import Fact
    from rightofway.metrics import Change
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
        """Return the losses of each robot of a plan to others."""
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


class PackageTeller:
    """`rightofway.facts.Teller` by `rightofway.report`, in English."""

    def tell_fact(self, fact: Fact | Fault | Report | Change) -> str:
        """Return a fact, a fault, a report of the judge or a change as sentences."""
        from rightofway.facts import Fact
        from rightofway.report.facts import FactWriter

        if isinstance(fact, Fact):
            return str(FactWriter(fact.about).write(fact))
        from rightofway.check import Fault, Report
        from rightofway.report.comparison import describe_change
        from rightofway.report.judgement import list_report_sentences, write_fault

        if isinstance(fact, Fault):
            return str(write_fault(fact))
        if isinstance(fact, Report):
            return "\n".join(list_report_sentences(fact))
        return str(describe_change(fact)["text"])

    def name_values(self, fact: Fact, since: int) -> Fact:
        """Return a fact about no scenario, with names and quantities as text."""
        from rightofway.report.facts import FactWriter

        return FactWriter(fact.about).name_values(fact, since)

    def summarize_report(self, report: Report) -> str:
        """Return the number of faults of each kind."""
        from rightofway.report.judgement import summarize_report

        return str(summarize_report(report))

    def write_message(self, fault: Fault) -> str:
        """Return the reason of a fault and its remedy."""
        from rightofway.report.judgement import write_fault_message

        return str(write_fault_message(fault))
