"""Faults of a plan that is shown: a page or a picture of a faulty plan says so."""

from __future__ import annotations

from collections import Counter
from functools import partial
from typing import Any

from rightofway.check import Report, check
from rightofway.metrics.comparison import Comparison
from rightofway.model import NEVER, Plan
from rightofway.report.comparison import export_comparison

LISTED_FAULTS = 1000
"""The most faults that a page lists; all are counted."""

UNDONE = ("stop missed", "wrong end")
"""Faults in the track of a robot that is permanently stuck in an excerpt of laps."""


def give_verdict(plan: Plan) -> Report:
    """Return the faults of a plan; of an excerpt of laps, those that are faults of the laps.

    In an excerpt, robots stay at home after their last lap, in the way of others, and a robot that
    stands still for ever leaves stops undone. Neither is a fault of laps without end.
    """
    is_excerpt = plan.run.status is not None and plan.run.status.kind == "excerpt of laps"
    judge = _check_excerpt if is_excerpt else partial(check, limit=LISTED_FAULTS)
    return plan.compute_once("verdict", lambda: judge(plan))


def _check_excerpt(plan: Plan) -> Report:
    listed = check(plan, limit=LISTED_FAULTS).faults
    still = {robot for fault in listed if fault.kind in UNDONE for robot in fault.robots}
    ends = [int(track.enter[-1]) for robot, track in enumerate(plan.tracks) if robot not in still]
    until = min(ends, default=NEVER)
    faults = tuple(fault for fault in listed if fault.kind not in UNDONE and fault.tick < until)
    return Report(faults=faults, counts=dict(Counter(fault.kind for fault in faults)))


def make_comparison_data(comparison: Comparison) -> dict[str, Any]:
    """Return a comparison as plain data, with how many ``faults`` the judge finds in each plan."""
    data = export_comparison(comparison)
    for figures, plan in zip(data["plans"], comparison.plans, strict=True):
        figures["faults"] = give_verdict(plan).total
    return data
