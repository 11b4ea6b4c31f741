"""Plans: made, improved, repeated in laps, executed with delays; with progress while they are."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np

from rightofway.check import check
from rightofway.cli.laps_report import laps_data, laps_report
from rightofway.cli.simulate import report as simulation_report
from rightofway.cli.terminal import measures
from rightofway.errors import GaveUp, InputError
from rightofway.io import FOREIGN_FORMATS, plan_of, plan_text
from rightofway.io.text import parse_json
from rightofway.model import Plan
from rightofway.solve import improve as improved
from rightofway.solve import solve
from rightofway.studio.messages import Blobs, Emit
from rightofway.studio.tasks.documents import figures, loaded_of
from rightofway.viz.page.document import compact_json
from rightofway.viz.page.payload import payload_of

if TYPE_CHECKING:
    from rightofway.execution import Outcome

Result = tuple[Any, ...]

CLASSES = 24
"""In which the flowtimes of runs are counted."""

SHARE_OF_SENDING = 0.1
"""The part of the time that may go into sending plans to the server."""


class Progress:
    """Sends what a planner reaches, and keeps its best plan.

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

    def report(self, message: str) -> None:
        """Send a sentence."""
        self._emit({"message": message, "seconds": self._seconds()})

    def on_plan(self, plan: Plan) -> None:
        """Send what a plan costs, and the plan too where that does not take too much time."""
        if not check(plan).ok:
            return  # only plans that the judge has passed are shown
        self.best, seconds = plan, self._seconds()
        event = {
            "seconds": seconds,
            "flowtime": plan.flowtime,
            "lower_bound": plan.lower_bound,
        }
        if seconds < self._next:
            self._emit(event)
            return
        self._emit({**event, "figures": figures(plan)}, plan_text(plan).encode())
        ended = self._seconds()
        self._next = ended + (ended - seconds) * (1 / SHARE_OF_SENDING - 1)

    def _seconds(self) -> float:
        return round(time.monotonic() - self._began, 3)


def plan(emit: Emit, _blobs: Blobs, *, document: Any, folder: str, **settings: Any) -> Result:
    """Plan a document."""
    scenario = loaded_of(document, folder).scenario
    return _searched(emit, lambda progress: solve(scenario, **settings, **progress))


def improve(emit: Emit, blobs: Blobs, **settings: Any) -> Result:
    """Make a plan better."""
    given = plan_of(parse_json(blobs[0].decode()))
    return _searched(emit, lambda progress: improved(given, **settings, **progress))


def _searched(emit: Emit, search: Callable[[dict[str, Any]], Plan]) -> Result:
    """Return the plan of a search; a stop returns the best plan of any planner."""
    progress = Progress(emit)
    keep = {"report": progress.report, "on_plan": progress.on_plan, "keep_best": True}
    try:
        found = search(keep)
    except KeyboardInterrupt:
        if progress.best is None:
            raise
        found = progress.best
    status = {"status": found.run.status, "seconds": found.run.seconds}
    return ({"figures": figures(found), **status}, plan_text(found).encode())


def laps(
    emit: Emit,
    _blobs: Blobs,
    *,
    document: Any,
    folder: str,
    rule: str = "first-come",
    routes: str | None = None,
    least_fairness: str = "0",
    time_limit: float | None = None,
    seed: int = 0,
) -> Result:
    """Let robots repeat their trips.

    The report is that of `rightofway laps --json`, with the one for people as ``text``.
    """
    from rightofway.cyclic import TIMETABLE, best_timetable, excerpt, run_laps
    from rightofway.cyclic import plan_of as whole_laps
    from rightofway.model.steady_state import within

    scenario, report = loaded_of(document, folder).scenario, Progress(emit).report
    if rule == TIMETABLE:
        run = best_timetable(
            scenario,
            least_fairness=Fraction(least_fairness),
            time_limit=time_limit,
            seed=seed,
            report=report,
        )
    else:
        ways = routes or "clear"
        run = run_laps(scenario, rule, routes=ways, time_limit=time_limit, report=report)
    shown, steady = excerpt(run)
    payload = compact_json(payload_of(shown, steady=steady)).encode()
    text = laps_report(run, scenario.quantities)
    result: dict[str, Any] = {"report": {**laps_data(run), "text": text}, "has_payload": True}
    try:
        whole = whole_laps(run)
    except GaveUp as reason:  # a robot that is home for ever blocks others: only laps are shown
        return ({**result, "status": str(reason)}, payload)
    whole = replace(whole, steady=within(steady, list(map(len, whole.tracks))))
    return ({**result, "figures": figures(whole)}, payload, plan_text(whole).encode())


def simulate(
    emit: Emit,
    blobs: Blobs,
    *,
    delays: Sequence[str] = (),
    runs: int = 1000,
    run: int | str = "typical",
    **settings: Any,
) -> Result:
    """Execute a plan with delays.

    The report is that of `rightofway simulate --json`. Beside it are the one for people as
    ``text``, the flowtime of each run in classes of equal width as ``spread``, and the number of
    the run with the largest flowtime as ``worst``.
    """
    from rightofway.execution import DEFAULT
    from rightofway.execution import simulate as execute

    given, report = plan_of(parse_json(blobs[0].decode())), Progress(emit).report
    outcome = execute(given, list(delays) or [DEFAULT], runs, report=report, **settings)
    named = {"typical": outcome.typical, "worst": outcome.worst}
    played = named[run]() if isinstance(run, str) else run
    if not played < outcome.runs:
        message = f"{played} is not among the {outcome.runs} runs (0 is the first)"
        raise InputError.at("run", message)
    payload = compact_json(payload_of(outcome.plan, actual=outcome.trace(played))).encode()
    data = {
        **measures(given.scenario),
        **outcome.as_dict(),
        "played": played,
        "text": simulation_report(outcome, given.scenario.quantities),
        "worst": outcome.worst(),
        "spread": spread_of(outcome),
    }
    result = {"report": data, "has_payload": True, "figures": figures(outcome.plan)}
    return (result, payload, plan_text(outcome.plan).encode())


def spread_of(outcome: Outcome) -> dict[str, Any] | None:
    """Return how often the flowtime of a run is in each of some classes; None if none completes.

    Parameters
    ----------
    outcome
        Runs with delays. Those in which a robot never completes are left out.
    """
    whole = outcome.completion[(outcome.completion >= 0).all(axis=1)]
    if not len(whole):
        return None
    counts, edges = np.histogram(whole.sum(axis=1), bins=CLASSES)
    duration = outcome.plan.scenario.quantities.duration
    return {
        "counts": counts.tolist(),
        "planned": outcome.plan.flowtime,
        "from": float(edges[0]),
        "to": float(edges[-1]),
        "text": {
            "planned": duration(outcome.plan.flowtime),
            "from": duration(round(edges[0])),
            "to": duration(round(edges[-1])),
        },
    }


def choices(_emit: Emit, _blobs: Blobs) -> Result:
    """Return rules of laps, notations of delays, formats of other programs, and what they mean."""
    from rightofway.cyclic import RULES, TIMETABLE
    from rightofway.execution import CAUSES, DEFAULT

    rules = {**RULES, TIMETABLE: "all rights of way are chosen in advance"}
    delays = [example for cause in CAUSES.values() for example in cause.examples]
    formats = {name: form.summary for name, form in FOREIGN_FORMATS.items()}
    found = {"rules": rules, "delays": {"default": DEFAULT, "examples": dict(delays)}}
    return ({**found, "formats": formats},)
