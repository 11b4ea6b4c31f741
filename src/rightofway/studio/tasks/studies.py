"""Studies of a fleet: how it repeats in laps, and how a plan fares with delays."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np

from rightofway.errors import GaveUp, InputError
from rightofway.facts import read_fact
from rightofway.io import format_plan, parse_plan
from rightofway.io.json_text import parse_json
from rightofway.kinds.numbers import read_exact
from rightofway.model import Scenario
from rightofway.report.facts import pack_note, write_note
from rightofway.report.laps_data import make_laps_data, write_reason
from rightofway.report.phrases import to_parts
from rightofway.report.plan_data import describe_measures
from rightofway.studio.messages import Blobs, Emit
from rightofway.studio.tasks.documents import compute_digest, compute_figures, load_document
from rightofway.studio.tasks.planning import PlanningProgress
from rightofway.viz.page.document import as_compact_json
from rightofway.viz.page.payload import make_payload

if TYPE_CHECKING:
    from rightofway.cyclic import CyclicResult
    from rightofway.execution import SimulationResult

Result = tuple[Any, ...]

CLASSES = 24
"""In which the flowtimes of runs are counted."""

RANKS = 1000
"""Runs that the report lists from the best to the worst; of more, evenly spaced ones."""


def _run_laps(
    scenario: Scenario,
    emit: Emit,
    *,
    rule: str = "first-come",
    routes: str | None = None,
    least_fairness: str = "0",
    time_limit: float | None = None,
    seed: int = 0,
) -> CyclicResult:
    """Let robots repeat their trips, under a rule or by a timetable."""
    from rightofway.cyclic import TIMETABLE, find_best_timetable, run_laps

    report = PlanningProgress(emit).report
    if rule == TIMETABLE:
        return find_best_timetable(
            scenario,
            least_fairness=Fraction(least_fairness),
            time_limit=time_limit,
            seed=seed,
            report=report,
        )
    ways = routes or "clear"
    return run_laps(scenario, rule, routes=ways, time_limit=time_limit, report=report)


def make_laps(emit: Emit, _blobs: Blobs, *, document: Any, folder: str, **settings: Any) -> Result:
    """Let robots repeat their trips.

    The report is that of `rightofway laps --json`, with reasons for people as ``reason``.
    """
    from rightofway.cyclic import make_excerpt, plan_of_laps
    from rightofway.model.steady_state import keep_within

    scenario = load_document(document, folder).scenario
    run = _run_laps(scenario, emit, **settings)
    shown, steady = make_excerpt(run)
    payload = as_compact_json(make_payload(shown, steady=steady)).encode()
    result: dict[str, Any] = {"report": _describe_laps(run), "has_payload": True}
    try:
        whole = plan_of_laps(run)
    except GaveUp as reason:  # a robot that is home for ever blocks others: only laps are shown
        return ({**result, "status": pack_note(reason.reason)}, payload)
    whole = replace(whole, steady=keep_within(steady, list(map(len, whole.tracks))))
    digest = compute_digest(scenario)  # that of `whole` says how many laps are shown
    costs = {**compute_figures(whole), "scenario": digest}
    return ({**result, "figures": costs}, payload, format_plan(whole).encode())


def _describe_laps(run: CyclicResult, *, by_visit: bool = True) -> Any:
    """Return the data of laps, with each reason as a sentence, too."""
    data = make_laps_data(run, by_visit=by_visit, with_text=True)
    for group, row in zip(run.groups, data["groups"], strict=True):
        row["reason"] = write_reason(group)
        if curves := row["curves"]:
            curves["reason"] = curves["why"] and write_note(read_fact(curves["why"]))
    return to_parts(data)


def make_laps_if(
    emit: Emit,
    _blobs: Blobs,
    *,
    document: Any,
    folder: str,
    kind: str,
    robot: str | None,
    stop: int | None,
    value: str,
    **settings: Any,
) -> Result:
    """Let robots repeat their trips with another speed, work time or headway, in a new order.

    The answer has the groups of `rightofway laps --json`, without the values of single visits.
    The map stays as it is, also where the cells of a floor depend on the speeds.
    """
    scenario = load_document(document, folder).scenario
    try:
        wanted = read_exact(value)
    except ValueError as error:
        raise InputError.at("value", str(error)) from None
    run = _run_laps(_change_value(scenario, kind, robot, stop, wanted), emit, **settings)
    answer = _describe_laps(run, by_visit=False)
    return ({key: answer[key] for key in ("groups", "throughput_per_hour")},)


def _change_value(
    scenario: Scenario, kind: str, robot: str | None, stop: int | None, value: Fraction
) -> Scenario:
    """Return a scenario with one value of a robot or the headway changed."""
    if kind == "headway":
        return replace(scenario, rules=replace(scenario.rules, headway=value))
    robots = list(scenario.robots)
    index = next((k for k, candidate in enumerate(robots) if candidate.name == robot), None)
    if index is None:
        raise InputError.at("robot", f"{robot!r} is no robot of this scenario")
    stops = list(robots[index].stops)
    if kind == "speed":
        robots[index] = replace(robots[index], speed=value)
    elif stop is not None and stop < len(stops):
        stops[stop] = replace(stops[stop], work=value)
        robots[index] = replace(robots[index], stops=tuple(stops))
    else:
        raise InputError.at("stop", f"{robot} has no stop {stop} (0 is the first)")
    return replace(scenario, robots=tuple(robots))


def simulate(
    emit: Emit,
    blobs: Blobs,
    *,
    delays: Sequence[str] = (),
    runs: int = 1000,
    run: int | str = "typical",
    **settings: Any,
) -> Result:
    """Execute a plan with delays; a stop keeps the runs that were made.

    The report is that of `rightofway simulate --json`, with the flowtime of each run in classes of
    equal width as ``spread``, runs from the best to the worst as ``ranks``, and the number of the
    run with the largest flowtime as ``worst``.
    """
    from rightofway.execution import DEFAULT_DELAYS
    from rightofway.execution import simulate as execute

    given, report = parse_plan(parse_json(blobs[0].decode())), PlanningProgress(emit).report
    causes = list(delays) or [DEFAULT_DELAYS]
    outcome = execute(given, causes, runs, keep_runs=True, report=report, **settings)
    named = {"typical": outcome.find_typical_run, "worst": outcome.find_worst_run}
    played = named[run]() if isinstance(run, str) else run
    if not played < outcome.runs:
        message = f"{played} is not among the {outcome.runs} runs (0 is the first)"
        raise InputError.at("run", message)
    payload = as_compact_json(make_payload(outcome.plan, actual=outcome.trace(played))).encode()
    data = {
        **describe_measures(given.scenario),
        **outcome.as_dict(),
        "played": played,
        "worst": outcome.find_worst_run(),
        "spread": compute_spread(outcome),
        "ranks": compute_ranks(outcome),
    }
    result = {"report": data, "has_payload": True, "figures": compute_figures(outcome.plan)}
    return (result, payload, format_plan(outcome.plan).encode())


def replay_run(
    _emit: Emit, blobs: Blobs, *, run: int, delays: Sequence[str] = (), seed: int = 0, **policy: Any
) -> Result:
    """Return the playback of one run of a simulation."""
    from rightofway.execution import DEFAULT_DELAYS, replay

    plan = parse_plan(parse_json(blobs[0].decode()))
    trace = replay(plan, list(delays) or [DEFAULT_DELAYS], run, seed, **policy)
    return (None, as_compact_json(make_payload(plan, actual=trace)).encode())


def compute_spread(outcome: SimulationResult) -> dict[str, Any] | None:
    """Return how often the flowtime of a run is in each of some classes; None if none completes."""
    whole = outcome.completion[(outcome.completion >= 0).all(axis=1)]
    if not len(whole):
        return None
    counts, edges = np.histogram(whole.sum(axis=1), bins=CLASSES)
    return {
        "counts": counts.tolist(),
        "planned": outcome.plan.flowtime,
        "from": float(edges[0]),
        "to": float(edges[-1]),
    }


def compute_ranks(outcome: SimulationResult) -> dict[str, Any]:
    """Return runs from the best to the worst: the rank, number and flowtime of each [ticks]."""
    order = outcome.rank_runs()
    ranks = np.unique(np.linspace(0, len(order) - 1, min(len(order), RANKS)).round().astype(int))
    completion = outcome.completion[order[ranks]]
    sums = completion.sum(axis=1).tolist()
    is_whole = (completion >= 0).all(axis=1).tolist()
    return {
        "rank": ranks.tolist(),
        "run": order[ranks].tolist(),
        "flowtime": [
            ticks if is_done else None for ticks, is_done in zip(sums, is_whole, strict=True)
        ],
    }
