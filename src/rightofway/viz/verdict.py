"""What the judge finds in a plan that is shown: a page or a picture of a faulty plan says so."""

from __future__ import annotations

from typing import Any

from rightofway.check import Report, check
from rightofway.metrics.comparison import Comparison
from rightofway.model import Plan

LISTED_FAULTS = 1000
"""The most faults that a page lists; all are counted."""


def give_verdict(plan: Plan) -> Report:
    """Return the faults of a plan; none of an excerpt of laps, which no floor is to carry out.

    In an excerpt, robots may stand still for ever, and others stay at home in their way at its end.
    """
    if plan.run.name == "laps" and plan.run.status == plan.run.options.get("rule"):
        return Report(faults=(), counts={})
    return plan.compute_once("verdict", lambda: check(plan, limit=LISTED_FAULTS))


def make_comparison_data(comparison: Comparison) -> dict[str, Any]:
    """Return a comparison as plain data, with how many ``faults`` the judge finds in each plan."""
    data = comparison.as_dict()
    for figures, plan in zip(data["plans"], comparison.plans, strict=True):
        figures["faults"] = give_verdict(plan).total
    return data
