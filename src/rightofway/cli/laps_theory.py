"""What would help a fleet that repeats its work, and how a chosen timetable compares."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from typing import Any

from rightofway.cli.words import wrapped
from rightofway.cyclic import (
    Comparison,
    CyclicResult,
    GroupResult,
    ParameterEffect,
    parameter_effects,
)
from rightofway.model import Scenario

__all__ = ["HOUR", "comparison_data", "comparison_lines", "sensitivity_data", "sensitivity_lines"]

HOUR = 3600
"""Time units of a scenario in an hour, if they are seconds."""

MOST_LEVERS = 3
"""How many things that would help a person is told; --json has more."""


MOST_VISITS = 200_000
"""In periods of more visits nobody looks for what would help: each search takes long."""


def sensitivity_data(run: CyclicResult, group: GroupResult) -> list[dict[str, Any]]:
    """Return what would help, for programs; times are exact fractions of the unit."""
    graph = group.graph()
    if graph is None or len(graph.vertex) > MOST_VISITS:
        return []
    return [_lever_data(run.scenario, lever) for lever in parameter_effects(run.scenario, graph)]


def _lever_data(scenario: Scenario, lever: ParameterEffect) -> dict[str, Any]:
    time, effect = scenario.problem.clock.tick, lever.effect
    return {
        "kind": lever.kind,
        "robot": None if lever.robot is None else scenario.robots[lever.robot].name,
        "stop": lever.stop,
        "gain": str(effect.gain * time),
        "loss": str(effect.loss * time),
        "until": str(effect.until),
        "at_best": str(effect.at_best * time),
        "ten_per_cent": str(lever.ten_per_cent * time),
    }


def sensitivity_lines(run: CyclicResult, group: GroupResult) -> Iterator[str]:
    """Say what would make a period shorter."""
    graph = group.graph()
    if graph is None:
        return
    if len(graph.vertex) > MOST_VISITS:
        yield "  what would help is not looked for in a period as long as this"
        return
    effects = parameter_effects(run.scenario, graph, most=MOST_LEVERS)
    helps = [lever for lever in effects if lever.ten_per_cent < lever.effect.cycle_time]
    for lever in helps:
        yield f"  {_said(run.scenario, lever)}"
    if not helps:
        yield "  nothing helps alone: other circuits are as long"


def _said(scenario: Scenario, lever: ParameterEffect) -> str:
    saved = 1 - lever.ten_per_cent / lever.effect.cycle_time
    return f"{_what(scenario, lever)}: the period gets {float(saved):.2%} shorter"


def _what(scenario: Scenario, lever: ParameterEffect) -> str:
    if lever.robot is None:
        return "10% less headway"
    robot = scenario.robots[lever.robot]
    if lever.kind == "speed":
        return f"{robot.name} 10% faster"
    if lever.stop is None:
        return f"{robot.name} 10% less turning"
    return f"{robot.name} 10% less work at {scenario.roadmap.name(robot.stops[lever.stop].at)}"


def comparison_data(scenario: Scenario, chosen: Comparison | None) -> dict[str, Any]:
    """Return how a chosen timetable compares with first come first served, for programs."""
    if chosen is None:
        return {}
    hour = HOUR / scenario.problem.clock.tick
    return {
        "throughput_per_hour": str(chosen.throughput * hour),
        "fairness": str(chosen.fairness),
        "first_come": {
            "ends": chosen.baseline_ends,
            "throughput_per_hour": str(chosen.baseline * hour),
        },
    }


def comparison_lines(chosen: Comparison) -> Iterator[str]:
    """Say how a chosen timetable compares with first come first served."""
    baseline = {
        "repeats": "first come first served",
        "open": "first come first served as far as it was seen",
        "starves": "first come first served, where a robot stands still for ever",
        "deadlock": "",
    }[chosen.baseline_ends]
    if chosen.baseline:
        more = chosen.throughput / chosen.baseline - 1
        if more < 0:
            below = f"{float(-more):.2%} below {baseline} (give more time)"
            yield from wrapped(f"throughput: not reached: {below}")
        else:
            yield from wrapped(f"throughput: {_signed(more)} against {baseline}")
    else:
        yield "throughput: first come first served comes to a standstill"
    yield f"fairness: every robot makes at least {float(chosen.fairness):.0%} of its laps alone"


def _signed(part: Fraction) -> str:
    return f"{float(part):+.1%}"
