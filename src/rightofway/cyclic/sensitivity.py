"""Sensitivity of the cycle time to speeds, work times, turning times and the headway.

A parameter scales all its time at once: a robot twice as fast needs half the time on every edge
without a speed limit, and for turning in a cell's crossing time. Each effect is exact: the
decrease of the cycle time per part of the time saved, and the part at which another circuit becomes
critical.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from rightofway.model import Itinerary, Lap, Robot, Scenario, Stage, find_serving_visits
from rightofway.model.lap import compute_dwell_between_laps, compute_turns_of_lap
from rightofway.model.problem import compute_turning_time
from rightofway.precedence import (
    Growth,
    Sensitivity,
    TimedEventGraph,
    compute_sensitivity,
    find_critical_circuit_without,
    find_tight_arcs,
)
from rightofway.site import Roadmap

TEN_PER_CENT = {"speed": Fraction(1, 11)}
"""The part of the time saved by ten per cent of a parameter; one tenth by default."""

Kind = Literal["speed", "work", "turn", "headway"]

_Key = tuple[Kind, int | None, int | None]


@dataclass(frozen=True, slots=True, kw_only=True)
class ParameterEffect:
    """The effect of a parameter that takes time on a critical circuit.

    Attributes
    ----------
    kind
        ``speed`` (driving, and turning in a cell's crossing time), ``work`` (at one stop), ``turn``
        (all turning of a robot) or ``headway`` (of all robots).
    robot
        The number of the robot; None for the headway.
    stop
        The number of the stop; None except for work at a stop.
    effect
        The dependence of the cycle time on the parameter.
    ten_per_cent
        The cycle time with a robot ten per cent faster, or a time ten per cent shorter [ticks].
    """

    kind: Kind
    robot: int | None
    stop: int | None
    effect: Sensitivity
    ten_per_cent: Fraction


def compute_parameter_effects(
    scenario: Scenario, graph: TimedEventGraph, *, most: int = 5, time_limit: float | None = None
) -> tuple[ParameterEffect, ...]:
    """Return the parameters on which the cycle time depends, most effective first.

    Parameters
    ----------
    scenario
        The problem.
    graph
        The laps and orders of a group.
    most
        Number of parameters to examine, by their time on a critical circuit.
    time_limit
        Time limit of each search [s].

    Returns
    -------
    tuple of ParameterEffect
        The effects; a parameter on no critical circuit has no effect and is left out.

    Raises
    ------
    GaveUp
        If time ran out.
    """
    circuit = graph.find_critical_circuit(time_limit=time_limit).arcs
    tight = find_tight_arcs(graph, time_limit=time_limit)
    growths = dict(_list_growths(scenario, graph, circuit))
    # The first entries of each growth are those of the arcs, in their order.
    weights = {
        key: Fraction(int(growth.slope[circuit].sum()), growth.parts)
        for key, growth in growths.items()
    }
    chosen = sorted((key for key in growths if weights[key]), key=lambda key: -weights[key])[:most]
    effects = []
    for key in chosen:
        growth = growths[key]
        effect = compute_sensitivity(graph, growth, tight=tight, time_limit=time_limit)
        part = TEN_PER_CENT.get(key[0], Fraction(1, 10))
        if part <= effect.until:
            then = effect.cycle_time - effect.gain * part
        else:
            saved = find_critical_circuit_without(graph, growth, part, time_limit=time_limit)
            then = saved.cycle_time
        kind, robot, stop = key
        parameter_effect = ParameterEffect(
            kind=kind, robot=robot, stop=stop, effect=effect, ten_per_cent=then
        )
        effects.append(parameter_effect)
    return tuple(sorted(effects, key=lambda effect: effect.ten_per_cent))


def _list_growths(
    scenario: Scenario, graph: TimedEventGraph, circuit: NDArray[np.int32]
) -> Iterator[tuple[_Key, Growth]]:
    """Yield the arcs as functions of each parameter of the robots on the circuit."""
    arcs = graph.arcs

    def grow(share: NDArray[np.int64]) -> Growth:
        return Growth(of=np.arange(len(arcs)), fixed=arcs.length - share, slope=share)

    robot_of = graph.robot[arcs.head]
    for place in np.unique(robot_of[circuit]).tolist():
        robot, dwelling = graph.timetable.robots[place], (arcs.first < 0) & (robot_of == place)
        yield ("speed", robot, None), compute_growth_by_speed(scenario, graph, place)
        lap, itinerary = graph.timetable.laps[place], scenario.problem.itineraries[robot]
        at = find_stages_at(scenario.roadmap, itinerary, lap)
        turn = np.array([sum(stage.turn for _, stage in stages) for stages in at], np.int64)
        turn += compute_turns_of_lap(scenario.roadmap, itinerary, lap.vertices)
        at_visit = graph.index[arcs.tail]
        yield (
            ("turn", robot, None),
            grow(np.where(dwelling, turn[np.where(dwelling, at_visit, 0)], 0)),
        )
        for visit, stages in enumerate(at):
            for stop, stage in stages:
                mine = dwelling & (at_visit == visit)
                share = np.where(mine, np.int64(stage.work), np.int64(0))
                yield ("work", robot, stop), grow(share)
    yield ("headway", None, None), grow(graph.headways)


def compute_growth_by_speed(scenario: Scenario, graph: TimedEventGraph, place: int) -> Growth:
    """Return the arcs as functions of ``speed now / speed`` of a robot.

    Notes
    -----
    Driving takes less time, and so does turning in a cell's crossing time. A drive along an edge
    with a speed limit has two entries: at its own speed, and at the limit.
    """
    arcs, robot = graph.arcs, scenario.robots[graph.timetable.robots[place]]
    drive = np.where(graph.robot[arcs.head] == place, graph.drives, 0)
    turns = _measure_turns_by_speed(scenario, graph, place, robot)
    of, fixed = np.arange(len(arcs)), arcs.length - drive - turns
    limits = [kind.get_speed_limit(robot.type) for kind in scenario.roadmap.edge_classes]
    if not any(limits):
        return Growth(of=of, fixed=fixed, slope=drive + turns)
    # Of what a drive takes now: at the robot's own speed, and at the limit.
    shares = [
        (min(limit / robot.speed, Fraction(1)), min(robot.speed / limit, Fraction(1)))
        if limit
        else (Fraction(1), Fraction(0))
        for limit in limits
    ]
    parts = math.lcm(*(share.denominator for pair in shares for share in pair))
    at_own, at_limit = np.array([[int(share * parts) for share in pair] for pair in shares]).T
    before = np.empty(len(graph), np.int64)
    before[graph.after] = np.arange(len(graph))
    edges = scenario.roadmap.find_edges(graph.vertex[before[arcs.head]], graph.vertex[arcs.head])
    classes = scenario.roadmap.class_of_edge[edges]
    limited = np.flatnonzero((drive > 0) & (at_limit[classes] > 0))
    slow = drive[limited] * at_limit[classes[limited]]
    return Growth(
        of=np.concatenate((of, limited)),
        fixed=np.concatenate((fixed * parts, fixed[limited] * parts + slow)),
        slope=np.concatenate((drive * at_own[classes] + turns * parts, turns[limited] * parts)),
        parts=parts,
    )


def _measure_turns_by_speed(
    scenario: Scenario, graph: TimedEventGraph, place: int, robot: Robot
) -> NDArray[np.int64]:
    """Return the turning in each arc that a faster robot makes faster: by the cell [ticks]."""
    arcs, rules = graph.arcs, (scenario.roadmap, scenario.rules)
    faster = replace(robot, speed=2 * robot.speed)
    if compute_turning_time(rules[0], robot, rules[1]) == compute_turning_time(
        rules[0], faster, rules[1]
    ):
        return np.zeros(len(arcs), np.int64)
    itinerary = scenario.problem.itineraries[graph.timetable.robots[place]]
    at = find_stages_at(scenario.roadmap, itinerary, graph.timetable.laps[place])
    turn = np.array([sum(stage.turn for _, stage in stages) for stages in at], np.int64)
    dwells = (arcs.first < 0) & (graph.robot[arcs.tail] == place)
    return np.where(dwells, turn[np.where(dwells, graph.index[arcs.tail], 0)], 0)


def find_stages_at(
    roadmap: Roadmap, itinerary: Itinerary, lap: Lap
) -> list[list[tuple[int, Stage]]]:
    """Return for each visit of a lap the stages served, with their numbers.

    Notes
    -----
    If a lap visits a vertex twice, stages without work and turning belong to the first visit that
    fits.
    """
    stages = itinerary.stages
    n = len(stages)  # the stages of one lap; further laps repeat them
    n = next(k for k in range(1, n + 1) if n % k == 0 and stages[:k] * (n // k) == stages)
    turns = compute_turns_of_lap(roadmap, itinerary, lap.vertices)
    # The visit at home ends a lap and begins the next one: each end serves stages of its own.
    ends = compute_dwell_between_laps(roadmap, itinerary, lap.vertices) - turns[0]
    spare = np.append(np.array(lap.dwell, np.int64) - turns, ends)
    spare[0] -= ends
    vertices = np.array((*lap.vertices, lap.vertices[0]), np.int32)
    at: list[list[tuple[int, Stage]]] = [[] for _ in lap.vertices]
    for number, visit in enumerate(find_serving_visits(stages[:n], vertices, spare)):
        at[visit % len(lap)].append((number, stages[number]))
    return at
