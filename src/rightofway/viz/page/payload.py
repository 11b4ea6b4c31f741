"""What the page is told about a plan, small enough for a thousand robots.

Long lists of integers are written as first differences (``[3, 4, 6]`` as ``[3, 1, 2]``): along a
route these are small and repeat, so the file is a fraction of the size. ``plan.js`` reads all this.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

import numpy as np

from rightofway.metrics import Metrics, measure, waits
from rightofway.model import (
    Decision,
    ExecutionTrace,
    Itinerary,
    Plan,
    Reroute,
    Roadmap,
    SteadyState,
)
from rightofway.viz.motion import Trip, end_of, trips_of
from rightofway.viz.ordering import vertices_in_line
from rightofway.viz.page.figures import differences, wait_row
from rightofway.viz.page.on_floor import floor_of
from rightofway.viz.page.repeats import laps_of, last_tick_of_all, steady_of
from rightofway.viz.palette import robot_colours
from rightofway.viz.plane import plane_of

__all__ = ["payload_of"]

DECIMALS = 3
"""Places kept of a position; a thousandth of a cell cannot be seen."""


def payload_of(
    plan: Plan, *, steady: Sequence[SteadyState] = (), actual: ExecutionTrace | None = None
) -> dict[str, Any]:
    """Return what the page needs, as plain data for JSON.

    Parameters
    ----------
    plan
        The plan; times in the result are ticks.
    steady
        Where it repeats itself, if the plan does not say it.
    actual
        What became of it on the floor.

    Raises
    ------
    InputError
        If ``steady`` or ``actual`` are not of this plan.
    """
    trips = trips_of(plan)
    payload, steady = _plan(plan, trips), steady or plan.steady
    if steady:
        payload["steady"] = steady_of(plan, steady)
        payload["laps"] = laps_of(plan)
    if steady and actual is None:
        payload["end"] = last_tick_of_all(trips, payload["steady"])
    if actual is not None:
        payload["floor"] = floor_of(plan, actual, trips)
    return payload


def _plan(plan: Plan, trips: Sequence[Trip]) -> dict[str, Any]:
    scenario, run, metrics = plan.scenario, plan.run, measure(plan)
    return {
        "tick": _pair(scenario.problem.clock.tick),
        "end": max(end_of(trips), 1),
        "headway": scenario.problem.headway,
        "booksAhead": scenario.rules.books_ahead,
        "map": _map(scenario.roadmap),
        "line": vertices_in_line([trip.vertices for trip in trips]),
        "robots": _robots(plan, trips, metrics),
        "waits": [wait_row(wait) for wait in waits(plan)],
        "planner": {"name": run.name, "status": run.status},
        "decisions": [_decision(decision) for decision in run.decisions],
        "reroutes": [_reroute(reroute) for reroute in run.reroutes],
        "metrics": _figures(metrics),
    }


def _figures(metrics: Metrics) -> dict[str, int]:
    return {
        "flowtime": metrics.flowtime,
        "makespan": metrics.makespan,
        "lowerBound": metrics.lower_bound,
    }


def _map(roadmap: Roadmap) -> dict[str, Any]:
    plane = plane_of(roadmap)
    size = {"width": round(plane.width, DECIMALS), "height": round(plane.height, DECIMALS)}
    if roadmap.grid is not None:
        return {**size, "rows": roadmap.grid.lines()}
    tails = np.repeat(np.arange(roadmap.n_vertices), np.diff(roadmap.indptr))
    return {
        **size,
        "names": [roadmap.name(vertex) for vertex in range(roadmap.n_vertices)],
        "points": np.round(plane.points, DECIMALS).ravel().tolist(),
        "tails": differences(tails.tolist()),
        "heads": differences(roadmap.heads.tolist()),
    }


def _robots(plan: Plan, trips: Sequence[Trip], metrics: Metrics) -> list[dict[str, Any]]:
    itineraries = plan.scenario.problem.itineraries
    colours = robot_colours(len(trips))
    return [
        {
            "name": robot.name,
            "colour": colours[index],
            "speed": str(robot.speed),
            "completion": metrics.completions[index],
            "alone": metrics.alone[index],
            **_trip(trips[index], itineraries[index]),
            **({} if min(trips[index].served) >= 0 else {"stands": True}),
        }
        for index, robot in enumerate(plan.scenario.robots)
    ]


def _trip(trip: Trip, itinerary: Itinerary) -> dict[str, Any]:
    return {
        "vertices": differences(trip.vertices),
        "enter": differences(trip.enter),
        "drive": _drive(trip, itinerary),
        "stages": _stages(trip),
    }


def _drive(trip: Trip, itinerary: Itinerary) -> int | list[int]:
    """Return the ticks into each visit, or one number where all edges are of one length."""
    return itinerary.edge_ticks[0] if len(itinerary.edge_ticks) == 1 else list(trip.drive)


def _stages(trip: Trip) -> list[list[int]]:
    return [
        [stage.vertex, stage.work, stage.turn, visit]
        for stage, visit in zip(trip.stages, trip.served, strict=True)
    ]


def _decision(decision: Decision) -> dict[str, Any]:
    return {
        "tick": decision.tick,
        "kind": decision.kind,
        "vertices": list(decision.vertices),
        "robots": list(decision.robots),
        "waits": decision.waits,
        "waitsAt": decision.waits_at,
        "ticks": decision.ticks,
        "level": decision.level,
        "conflictsLeft": list(decision.conflicts_left),
        "completionSums": decision.completion_sums and list(decision.completion_sums),
    }


def _reroute(reroute: Reroute) -> dict[str, Any]:
    return {"robot": reroute.robot, "because": reroute.because}


def _pair(fraction: Fraction) -> list[int]:
    return [fraction.numerator, fraction.denominator]
