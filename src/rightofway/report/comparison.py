"""Compared plans as people read them: figures, and differences of their scenarios."""

from __future__ import annotations

from typing import Any

from rightofway.facts import Fact
from rightofway.metrics.changes import Change
from rightofway.metrics.comparison import Comparison
from rightofway.model import Plan
from rightofway.report.facts import FactWriter
from rightofway.report.phrases import join_items, mark_figure, to_parts
from rightofway.report.quantities import Quantities
from rightofway.units import write_decimal

COSTS = ("flowtime", "makespan", "lower_bound", "alone")
"""Figures in ticks."""

NAMED = 2
"""Robots or jobs with the same change that are named; more are counted."""


def export_comparison(comparison: Comparison) -> dict[str, Any]:
    """Return a comparison as plain data, with figures and changes in English."""
    data = comparison.as_dict()
    rows = zip(data["plans"], comparison.plans, comparison.scales, comparison.changes, strict=True)
    for figures, plan, scale, changes in rows:
        figures["text"] = _write_figures(figures, plan, scale)
        figures["changes"] = list(map(describe_change, changes))
    return data


def _write_figures(figures: dict[str, Any], plan: Plan, scale: int) -> dict[str, Any]:
    duration, seconds = Quantities.of(plan.scenario).format_duration, plan.run.seconds
    gap = figures["gap"]
    return {
        **{key: to_parts(duration(figures[key] // scale)) for key in COSTS},
        "gap": "" if gap is None else to_parts(mark_figure(f"{gap:.1%}")),
        "seconds": "" if seconds is None else to_parts(mark_figure(f"{write_decimal(seconds)} s")),
    }


def describe_change(change: Change) -> dict[str, Any]:
    """Return a difference as plain data, with its text: ``R2: speed 1 → 2``."""
    subject = _name_subject(change)
    before, after = map(_write_value, (change.before, change.after))
    values = " → ".join(filter(None, (before, after)))
    return {
        "subject": to_parts(subject),
        "key": change.key,
        "before": to_parts(before),
        "after": to_parts(after),
        "robots": list(change.robots),
        "jobs": list(change.jobs),
        "text": f"{subject}: {' '.join(filter(None, (change.key, values)))}",
    }


def _write_value(value: Fact | None) -> str:
    return "" if value is None else FactWriter(value.about).write(value)


def _name_subject(change: Change) -> str:
    if change.place is not None:
        return _write_value(change.place)
    names = change.robots or change.jobs
    if not names:
        return change.subject
    if len(names) > NAMED:
        kind = "n_robots" if change.robots else "n_jobs"
        return FactWriter(None).write(Fact(kind, number=len(names)))
    return join_items(names)
