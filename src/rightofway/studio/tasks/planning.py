"""Plans: made and improved, with progress while they are."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import replace
from typing import Any

from rightofway.facts import Fact
from rightofway.io import FOREIGN_FORMATS, format_plan, parse_plan
from rightofway.io.json_text import parse_json
from rightofway.model import Plan, Status
from rightofway.report.facts import pack_note
from rightofway.solve import improve as improved
from rightofway.solve import solve
from rightofway.studio.messages import Blobs, Emit
from rightofway.studio.tasks.documents import compute_figures, load_document
from rightofway.viz.verdict import give_verdict

Result = tuple[Any, ...]

SHARE_OF_SENDING = 0.1
"""The part of the time that may go into sending plans to the server."""


class PlanningProgress:
    """Sends the progress of a planner, and keeps its best plan.

    Attributes
    ----------
    best
        The best plan so far.
    """

    def __init__(self, emit: Emit) -> None:
        self.best: Plan | None = None
        self._emit = emit
        self._began = time.monotonic()
        self._next = 0.0

    def report(self, message: Fact | str) -> None:
        """Send a fact, for people."""
        self._emit({"progress": pack_note(message), "seconds": self._measure_seconds()})

    def take_plan(self, plan: Plan) -> None:
        """Send the costs of a plan, and the plan too where that does not take too much time."""
        if not give_verdict(plan).ok:
            return  # only plans that the judge has passed are shown
        self.best, seconds = plan, self._measure_seconds()
        event = {
            "seconds": seconds,
            "flowtime": plan.flowtime,
            "lower_bound": plan.lower_bound,
        }
        if seconds < self._next:
            self._emit(event)
            return
        self._emit({**event, "figures": compute_figures(plan)}, format_plan(plan).encode())
        ended = self._measure_seconds()
        self._next = ended + (ended - seconds) * (1 / SHARE_OF_SENDING - 1)

    def _measure_seconds(self) -> float:
        return round(time.monotonic() - self._began, 3)


def plan(
    emit: Emit,
    blobs: Blobs,
    *,
    document: Any,
    folder: str,
    start: int | None = None,
    **settings: Any,
) -> Result:
    """Plan a document; ``start`` is the run whose plan, a blob, it starts from."""
    scenario = load_document(document, folder).scenario
    old = None if start is None else parse_plan(parse_json(blobs[0].decode()))
    return _run_search(emit, lambda progress: solve(scenario, start=old, **settings, **progress))


def improve(emit: Emit, blobs: Blobs, **settings: Any) -> Result:
    """Make a plan better."""
    given = parse_plan(parse_json(blobs[0].decode()))
    return _run_search(emit, lambda progress: improved(given, **settings, **progress))


def _run_search(emit: Emit, search: Callable[[dict[str, Any]], Plan]) -> Result:
    """Return the plan of a search; a stop returns the best plan of any planner."""
    progress = PlanningProgress(emit)
    keep = {"report": progress.report, "on_plan": progress.take_plan, "keep_best": True}
    try:
        best = search(keep)
    except KeyboardInterrupt:
        if progress.best is None:
            raise
        run = replace(progress.best.run, status=Status("stopped"))
        best = replace(progress.best, run=run)
    result = {"figures": compute_figures(best), "seconds": best.run.seconds}
    status = None if best.run.status is None else pack_note(best.run.status)
    return ({**result, "status": status}, format_plan(best).encode())


def list_choices(_emit: Emit, _blobs: Blobs) -> Result:
    """Return rules of laps, notations of delays, formats of other programs, and their meanings."""
    from rightofway.cyclic import RULES, TIMETABLE
    from rightofway.execution import CAUSES, DEFAULT_DELAYS

    rules = {rule: pack_note(Fact(f"rule {rule}")) for rule in (*RULES, TIMETABLE)}
    delays = [example for cause in CAUSES.values() for example in cause.examples]
    formats = {name: pack_note(Fact(f"format {name}")) for name in FOREIGN_FORMATS}
    choices = {"rules": rules, "delays": {"default": DEFAULT_DELAYS, "examples": dict(delays)}}
    return ({**choices, "formats": formats},)
