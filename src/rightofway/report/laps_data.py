"""Reports on work that repeats for programs: exact times [time unit], sensitivity, curves."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from rightofway.cyclic import (
    Bottleneck,
    CyclicResult,
    GroupResult,
    LapWait,
    compute_parameter_curves,
    compute_parameter_effects,
    list_visits_along,
    trace_bottleneck,
)
from rightofway.errors import GaveUp
from rightofway.kinds.numbers import format_number
from rightofway.model import Scenario
from rightofway.report.circuits import list_circuit_steps
from rightofway.report.facts import FactWriter
from rightofway.report.phrases import Phrase
from rightofway.report.plan_data import describe_measures
from rightofway.report.quantities import Quantities

HOUR = 3600
"""Seconds in an hour; where the time unit is not known, laps are counted in as many time units."""

MAX_VISITS = 1_000_000
"""Visits of a period in which waits and bottleneck are computed."""

MAX_VISITS_OF_SENSITIVITY = 200_000
"""Visits of a period whose sensitivity is computed; each parameter takes a search."""

MAX_STEPS = 2_000
"""Visits of a circuit that --json lists for curves; a longer one has no pieces there."""

BY_VISIT = ("conflicts", "first_lap", "bottleneck", "sensitivity", "curves")
"""Keys of --json that are computed visit by visit."""


def make_laps_data(
    run: CyclicResult, *, by_visit: bool = True, with_text: bool = False
) -> dict[str, Any]:
    """Return a result for programs: plain data, exact times [time unit].

    For pages, steps of critical circuits also have a ``text``.
    """
    return {
        "rule": run.rule,
        "routes": run.routes,
        **describe_measures(run.scenario),
        "throughput_per_hour": format_number(compute_hour(run.scenario) * run.compute_throughput()),
        "groups": [
            _group_data(run.scenario, group, by_visit=by_visit, with_text=with_text)
            for group in run.groups
        ],
    }


def compute_hour(scenario: Scenario) -> Fraction:
    """Return the time units of an hour, or 3600 where they are not known."""
    return HOUR / (scenario.units.seconds or Fraction(1))


def list_names(scenario: Scenario, group: GroupResult) -> list[str]:
    """Return the names of the robots of a group."""
    return [scenario.robots[robot].name for robot in group.robots]


def write_reason(group: GroupResult, quantities: Quantities | None = None) -> str:
    """Return in words why a group ended; empty where its pattern repeats."""
    if group.why is None:
        return ""
    return FactWriter(group.context.scenario, quantities).write(group.why)


def is_long(group: GroupResult) -> bool:
    """Return whether a period is too long to be computed visit by visit."""
    return group.pattern is not None and group.pattern.n_visits > MAX_VISITS


def _group_data(
    scenario: Scenario, group: GroupResult, *, by_visit: bool, with_text: bool
) -> dict[str, Any]:
    robots, place, clock = scenario.robots, scenario.roadmap.name, scenario.problem.clock
    names, pattern, measured, time = (
        list_names(scenario, group),
        group.pattern,
        None,
        clock.convert_to_time,
    )
    means = [
        None if mean is None else format_number(mean * clock.tick)
        for mean in group.compute_mean_laps()
    ]
    shares = [
        None if share is None else format_number(share) for share in group.compute_waiting_shares()
    ]
    if pattern is None:
        measurement = group.measure_laps()
        laps = dict(zip(names, measurement.laps, strict=True))
        measured = {"from": format_number(time(measurement.warm_up)), "laps": laps}

    def waits_data(waits: Sequence[LapWait], when: str) -> list[dict[str, Any]]:
        return [
            {
                "vertex": place(wait.vertex),
                **({} if wait.beside is None else {"beside": place(wait.beside)}),
                "robots": [robots[robot].name for robot in wait.pair],
                "waits": robots[wait.waits].name,
                when: format_number(time(wait.tick)),
                "for": format_number(time(wait.ticks)),
            }
            for wait in waits
        ]

    data: dict[str, Any] = {
        "robots": names,
        "ends": group.ends,
        "why": None if group.why is None else FactWriter(scenario).export(group.why),
        "transient": format_number(time(pattern.transient)) if pattern else None,
        "begins": format_number(time(pattern.begins)) if pattern else None,
        "period": format_number(time(pattern.period)) if pattern else None,
        "laps_per_period": dict(zip(names, pattern.counts, strict=True)) if pattern else None,
        "laps_made": dict(zip(names, group.count_laps(), strict=True)),
        "mean_lap": dict(zip(names, means, strict=True)),
        "measured": measured,
        "waiting_share": dict(zip(names, shares, strict=True)),
    }
    if is_long(group) or not by_visit:
        data |= dict.fromkeys(BY_VISIT)
    else:
        bottleneck = group.find_bottleneck()
        data |= {
            "conflicts": waits_data(group.waits(), "offset"),
            "first_lap": waits_data(group.list_first_waits(), "time"),
            "bottleneck": _make_steps(scenario, bottleneck, with_text=with_text),
            "sensitivity": _make_sensitivity(scenario, group),
            "curves": _make_curves(scenario, group, with_text=with_text),
        }
    if group.comparison is not None:
        hour = compute_hour(scenario) / clock.tick
        data |= {
            "throughput_per_hour": format_number(group.comparison.throughput * hour),
            "fairness": format_number(group.comparison.fairness),
            "first_come": {
                "ends": group.comparison.baseline_ends,
                "throughput_per_hour": format_number(group.comparison.baseline * hour),
            },
        }
    return data


def _make_sensitivity(scenario: Scenario, group: GroupResult) -> list[dict[str, Any]]:
    graph, tick = group.build_graph(), scenario.problem.clock.tick
    if graph is None or len(graph.vertex) > MAX_VISITS_OF_SENSITIVITY:
        return []
    return [
        {
            "kind": parameter.kind,
            "robot": None if parameter.robot is None else scenario.robots[parameter.robot].name,
            "stop": parameter.stop,
            "gain": format_number(parameter.effect.gain * tick),
            "loss": format_number(parameter.effect.loss * tick),
            "until": format_number(parameter.effect.until),
            "at_best": format_number(parameter.effect.at_best * tick),
            "ten_per_cent": format_number(parameter.ten_per_cent * tick),
        }
        for parameter in compute_parameter_effects(scenario, graph)
    ]


def _make_steps(
    scenario: Scenario, bottleneck: Bottleneck | None, *, with_text: bool
) -> list[dict[str, Any]]:
    place, clock = scenario.roadmap.name, scenario.problem.clock
    names, steps = [robot.name for robot in scenario.robots], list[dict[str, Any]]()
    for step in list_circuit_steps(bottleneck.pieces if bottleneck else (), scenario):
        name = names[step.robot]
        data = {
            "kind": step.kind,
            "robot": name,
            "after": None if step.after is None else names[step.after],
            "vertices": [place(vertex) for vertex in step.places],
            "for": format_number(clock.convert_to_time(step.ticks)),
        }
        if with_text:
            data["text"] = Phrase("steps of robot", robot=name, steps=step.text)
        steps.append(data)
    return steps


def _make_curves(
    scenario: Scenario, group: GroupResult, *, with_text: bool
) -> dict[str, Any] | None:
    """Return the period as a function of each parameter, and the circuits that decide it.

    The period is ``fixed + slope * value``; of a speed ``fixed + slope / value``.
    """
    graph, pattern = group.build_graph(), group.pattern
    if graph is None or pattern is None or len(graph) > MAX_VISITS_OF_SENSITIVITY:
        return None
    data: dict[str, Any] = {"exact": scenario.problem.clock.exact, "why": None}
    try:
        found_curves = compute_parameter_curves(scenario, graph)
    except GaveUp as error:
        why = FactWriter(scenario).export(error.reason)
        return data | {"why": why, "curves": [], "circuits": []}
    circuits: dict[tuple[int, ...], int] = {}
    curves = [
        {
            "kind": curve.kind,
            "robot": None if curve.robot is None else scenario.robots[curve.robot].name,
            "stop": curve.stop,
            "value": format_number(curve.value),
            "pieces": [
                {
                    "from": format_number(piece.start),
                    "to": format_number(piece.until),
                    "fixed": format_number(piece.fixed),
                    "slope": format_number(piece.slope),
                    "circuit": circuits.setdefault(tuple(piece.arcs.tolist()), len(circuits)),
                }
                for piece in curve.pieces
            ],
        }
        for curve in found_curves
    ]
    listed = []
    for arcs in circuits:
        if len(arcs) > MAX_STEPS:
            listed.append(
                {"periods": int(graph.arcs.height[list(arcs)].sum()), "pieces": [], "visits": []}
            )
            continue
        bottleneck = trace_bottleneck(graph, arcs)
        visits = [list(visit) for visit in list_visits_along(group, pattern, graph, arcs)]
        pieces = _make_steps(scenario, bottleneck, with_text=with_text)
        listed.append({"periods": bottleneck.periods, "pieces": pieces, "visits": visits})
    return data | {"curves": curves, "circuits": listed}
