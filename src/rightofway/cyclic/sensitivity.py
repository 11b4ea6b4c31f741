"""Sensitivity of the period: which speed, work time, turning time or headway it depends on.

A parameter scales all its time at once: a robot twice as fast needs half the time on every edge.
Each effect is exact: how much the period falls for each part of the time saved, and up to which
part, before another circuit becomes critical.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from rightofway.model import Itinerary, Lap, Scenario, Stage, serving_visits
from rightofway.precedence import (
    Sensitivity,
    TimedEventGraph,
    critical_circuit_without,
    sensitivity,
    tight_arcs,
)

TEN_PER_CENT = {"speed": Fraction(1, 11)}
"""The part of its time that ten per cent of a parameter save; one tenth where it is not listed."""

Kind = Literal["speed", "work", "turn", "headway"]

_Key = tuple[Kind, int | None, int | None]


@dataclass(frozen=True, slots=True, kw_only=True)
class ParameterEffect:
    """The effect of a parameter that takes time on a critical circuit.

    Attributes
    ----------
    kind
        ``speed`` (all driving of a robot), ``work`` (at one stop), ``turn`` (all turning of a
        robot) or ``headway`` (of all robots).
    robot
        The number of the robot; None for the headway.
    stop
        The number of the stop; None if it is not work at a stop.
    effect
        How the cycle time depends on it.
    ten_per_cent
        The cycle time with a robot ten per cent faster, or a time ten per cent shorter [ticks].
    """

    kind: Kind
    robot: int | None
    stop: int | None
    effect: Sensitivity
    ten_per_cent: Fraction


def parameter_effects(
    scenario: Scenario, graph: TimedEventGraph, *, most: int = 5, time_limit: float | None = None
) -> tuple[ParameterEffect, ...]:
    """Return the parameters on which the cycle time depends, the most effective first.

    Parameters
    ----------
    scenario
        The problem.
    graph
        The laps and orders of a group.
    most
        How many parameters to examine: those that take most of a critical circuit.
    time_limit
        For each search [s].

    Returns
    -------
    tuple of ParameterEffect
        A parameter that is on no critical circuit has no effect, and is not in it.

    Raises
    ------
    GaveUp
        If time ran out.
    """
    circuit = graph.critical_circuit(time_limit=time_limit).arcs
    tight = tight_arcs(graph, time_limit=time_limit)
    shares = dict(_shares(scenario, graph, circuit))
    weights = {key: int(share[circuit].sum()) for key, share in shares.items()}
    chosen = sorted((key for key in shares if weights[key]), key=lambda key: -weights[key])[:most]
    found = []
    for key in chosen:
        effect = sensitivity(graph, shares[key], tight=tight, time_limit=time_limit)
        part = TEN_PER_CENT.get(key[0], Fraction(1, 10))
        if part <= effect.until:
            then = effect.cycle_time - effect.gain * part
        else:
            saved = critical_circuit_without(graph, shares[key], part, time_limit=time_limit)
            then = saved.cycle_time
        kind, robot, stop = key
        one = ParameterEffect(kind=kind, robot=robot, stop=stop, effect=effect, ten_per_cent=then)
        found.append(one)
    return tuple(sorted(found, key=lambda one: one.ten_per_cent))


def _shares(
    scenario: Scenario, graph: TimedEventGraph, circuit: NDArray[np.int32]
) -> Iterator[tuple[_Key, NDArray[np.int64]]]:
    """Yield the ticks of each arc that each parameter of the robots on the circuit takes."""
    arcs = graph.arcs
    is_right = arcs.first >= 0
    drive = graph.drive[arcs.head]
    robot_of = graph.robot[arcs.head]
    for place in np.unique(robot_of[circuit]).tolist():
        robot, own = graph.timetable.robots[place], robot_of == place
        driving = own & (~is_right | graph.books_ahead)
        yield ("speed", robot, None), np.where(driving, drive, 0)
        at = stages_at(graph.timetable.laps[place], scenario.problem.itineraries[robot])
        dwelling = own & ~is_right
        turn = np.array([sum(stage.turn for _, stage in stages) for stages in at], np.int64)
        here = graph.index[arcs.tail]
        yield ("turn", robot, None), np.where(dwelling, turn[np.where(dwelling, here, 0)], 0)
        for visit, stages in enumerate(at):
            for stop, stage in stages:
                mine = dwelling & (here == visit)
                yield ("work", robot, stop), np.where(mine, np.int64(stage.work), np.int64(0))
    yield ("headway", None, None), np.where(is_right, np.int64(graph.headway), np.int64(0))


def stages_at(lap: Lap, itinerary: Itinerary) -> list[list[tuple[int, Stage]]]:
    """Return for each visit of a lap the stages that it serves, with their numbers.

    Parameters
    ----------
    lap
        One lap of a robot.
    itinerary
        The stages of one lap or of several laps.

    Notes
    -----
    Where a lap visits a vertex twice, stages without work and turning belong to the first visit
    that fits.
    """
    stages = itinerary.stages
    n = len(stages)  # the stages of one lap come first, and may be repeated
    n = next(k for k in range(1, n + 1) if n % k == 0 and stages[:k] * (n // k) == stages)
    order = [*range(1, len(lap)), 0]
    vertices = np.array(lap.vertices, np.int32)[order]
    spare = np.array(lap.dwell, np.int64)[order]
    at: list[list[tuple[int, Stage]]] = [[] for _ in order]
    for number, place in enumerate(serving_visits(stages[:n], vertices, spare)):
        at[order[place]].append((number, stages[number]))
    return at
