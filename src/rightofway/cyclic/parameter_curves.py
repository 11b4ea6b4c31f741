"""The period as a function of each speed, each work time and the headway, in the same order.

`sensitivity` has the effect of a small change; here is the whole function, exact, in pieces, each
with the circuit that is critical there. In the same order, a work time and the headway add to arcs.
A speed divides: driving and, where a robot turns in a cell's crossing time, turning take the time
that they take now times ``speed now / speed``; an edge with a speed limit takes its length divided
by the limit at least. So the period is ``fixed + slope * value``, or ``fixed + slope / speed``.

Where the clock is not exact (`Clock.exact`), drives are rounded up to ticks as they are now.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from rightofway.cyclic.sensitivity import compute_growth_by_speed, find_stages_at
from rightofway.model import Scenario
from rightofway.precedence import Growth, TimedEventGraph, compute_period_curve

MOST_VISITS = 100_000
"""Visits of a period times parameters that are examined; each takes a few searches of the graph."""

RANGE = 4
"""A speed is examined from a quarter to four times its value."""

Kind = Literal["speed", "work", "headway"]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class CurvePiece:
    """The period for some values of a parameter: one circuit is critical for all of them.

    Attributes
    ----------
    start, until
        The least and the largest value.
    fixed, slope
        Of ``fixed + slope * value``, and for a speed of ``fixed + slope / value``; ``fixed`` in
        time units.
    arcs
        The critical circuit: arcs of the graph in order.
    """

    start: Fraction
    until: Fraction
    fixed: Fraction
    slope: Fraction
    arcs: NDArray[np.int64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ParameterCurve:
    """The period as a function of one parameter, with all others and the order unchanged.

    Attributes
    ----------
    kind
        ``speed`` of a robot, ``work`` at one stop, or ``headway`` of all robots.
    robot, stop
        Their numbers in the scenario; None where there is none.
    value
        The value of the scenario [time unit; of a speed: length unit per time unit].
    pieces
        Each begins where the one before ends. A time is examined from 0 (a headway that keeps
        robots from rotating: from one tick) up to the period or four times its value, whichever is
        longer. The curve of a headway is a single point if any longer headway is a deadlock.
    """

    kind: Kind
    robot: int | None
    stop: int | None
    value: Fraction
    pieces: tuple[CurvePiece, ...]

    def compute_period(self, value: Fraction) -> Fraction:
        """Return the period for a value [time unit]."""
        piece = next(later for later in self.pieces if value <= later.until)
        return piece.fixed + piece.slope * (1 / value if self.kind == "speed" else value)


def compute_parameter_curves(
    scenario: Scenario,
    graph: TimedEventGraph,
    *,
    most_visits: int = MOST_VISITS,
    time_limit: float | None = None,
) -> tuple[ParameterCurve, ...]:
    """Return the curves of the parameters of a group.

    Parameters
    ----------
    scenario
        The problem.
    graph
        The laps and orders of the group.
    most_visits
        Parameters are examined as long as their number times the visits of the graph is at most
        this: first the robots on the critical circuit, then the headway, then the other robots.
    time_limit
        For each search [s].

    Raises
    ------
    GaveUp
        If time ran out, or numbers become too large for the native core.
    """
    curves: list[ParameterCurve] = []
    for curve in _trace_curves(scenario, graph, time_limit):
        curves.append(curve)
        if (len(curves) + 1) * len(graph) > most_visits:
            break
    return tuple(curves)


def _trace_curves(
    scenario: Scenario, graph: TimedEventGraph, time_limit: float | None
) -> Iterator[ParameterCurve]:
    circuit = graph.find_critical_circuit(time_limit=time_limit).arcs
    critical = dict.fromkeys(graph.robot[graph.arcs.head[circuit]].tolist())
    for place in critical:
        yield from _trace_robot(scenario, graph, place, time_limit)
    if len(graph.timetable.robots) > 1:
        is_kept = graph.rules == scenario.problem.booking_rules
        least = 0 if is_kept else graph.rules.end(0)  # without it robots would rotate
        is_right = graph.arcs.first >= 0
        pieces = _trace_time(
            scenario, graph, is_right, graph.rules.headway, time_limit, least=least
        )
        value = scenario.rules.headway
        yield ParameterCurve(kind="headway", robot=None, stop=None, value=value, pieces=pieces)
    for place in range(len(graph.timetable.robots)):
        if place not in critical:
            yield from _trace_robot(scenario, graph, place, time_limit)


def _trace_robot(
    scenario: Scenario, graph: TimedEventGraph, place: int, time_limit: float | None
) -> Iterator[ParameterCurve]:
    """Yield the curves of the speed of a robot and of its work at each stop."""
    number = graph.timetable.robots[place]
    robot, arcs = scenario.robots[number], graph.arcs
    itinerary = scenario.problem.itineraries[number]
    at = find_stages_at(scenario.roadmap, itinerary, graph.timetable.laps[place])
    growth, tick = compute_growth_by_speed(scenario, graph, place), scenario.problem.clock.tick
    ends = Fraction(1, RANGE), Fraction(RANGE)
    yield ParameterCurve(
        kind="speed",
        robot=number,
        stop=None,
        value=robot.speed,
        pieces=tuple(
            CurvePiece(
                start=robot.speed / piece.until,
                until=robot.speed / piece.start,
                fixed=piece.fixed * tick,
                slope=piece.slope * tick * robot.speed,
                arcs=piece.arcs,
            )
            for piece in reversed(compute_period_curve(graph, growth, *ends, time_limit=time_limit))
        ),
    )
    dwells = (arcs.first < 0) & (graph.robot[arcs.tail] == place)
    for visit, stages in enumerate(at):
        for stop, stage in stages:
            if stop < len(robot.stops):
                works = dwells & (graph.index[arcs.tail] == visit)
                yield ParameterCurve(
                    kind="work",
                    robot=number,
                    stop=stop,
                    value=robot.stops[stop].work,
                    pieces=_trace_time(scenario, graph, works, stage.work, time_limit),
                )


def _trace_time(
    scenario: Scenario,
    graph: TimedEventGraph,
    mask: NDArray[np.bool_],
    ticks: int,
    time_limit: float | None,
    *,
    least: int = 0,
) -> tuple[CurvePiece, ...]:
    """Return the pieces of a time that is once in each arc of a mask."""
    once = mask.astype(np.int64)
    growth = Growth(of=np.arange(len(mask)), fixed=graph.arcs.length - once * ticks, slope=once)
    tick = scenario.problem.clock.tick
    most = Fraction(max(int(graph.timetable.period), RANGE * ticks))
    return tuple(
        CurvePiece(
            start=piece.start * tick,
            until=piece.until * tick,
            fixed=piece.fixed * tick,
            slope=piece.slope,
            arcs=piece.arcs,
        )
        for piece in compute_period_curve(
            graph, growth, Fraction(least), most, time_limit=time_limit
        )
    )
