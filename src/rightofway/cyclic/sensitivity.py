"""What would help: which speed, work time, turning time or headway the period hangs on.

All of a lever's time is scaled at once: a robot twice as fast needs half the time on every edge, a
work time ten per cent shorter is so in every lap. Derivatives alone would not say how far they
hold, and single what-ifs not what comes next; so a lever tells both, exactly: what each part
saved is worth, and up to which part, before another circuit takes over.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from rightofway.model import Itinerary, Lap, Scenario, Stage
from rightofway.precedence import Sensitivity, TimedEventGraph, cycle_time_without, sensitivity
from rightofway.precedence import tight_arcs as tight_arcs_of

__all__ = ["TEN_PER_CENT_FASTER", "ParameterEffect", "parameter_effects", "stages_at"]

TEN_PER_CENT_FASTER = Fraction(1, 11)
"""The part of its driving time that a robot saves which is ten per cent faster."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ParameterEffect:
    """Something that takes time on a critical circuit.

    Attributes
    ----------
    kind
        ``speed`` (all driving of a robot), ``work`` (one work time), ``turn`` (all turning of a
        robot) or ``headway`` (everybody's).
    robot
        Whose, by its number; None for the headway.
    stop
        Which stop's work; None for others.
    effect
        How the cycle time follows it.
    ten_per_cent
        The cycle time if it were ten per cent better: a robot so much faster, a time so much
        shorter [ticks].
    """

    kind: Literal["speed", "work", "turn", "headway"]
    robot: int | None
    stop: int | None
    effect: Sensitivity
    ten_per_cent: Fraction


_Key = tuple[Literal["speed", "work", "turn", "headway"], int | None, int | None]


def parameter_effects(
    scenario: Scenario, graph: TimedEventGraph, *, most: int = 5, time_limit: float | None = None
) -> tuple[ParameterEffect, ...]:
    """Return what the cycle time hangs on most, the most helpful first.

    Parameters
    ----------
    scenario
        What the robots have to do.
    graph
        Their laps and orders.
    most
        How many levers to look at: those that take most of a critical circuit.
    time_limit
        For each search [s].

    Returns
    -------
    tuple of Lever
        Whatever is not on a critical circuit cannot help at all, and is not here.

    Raises
    ------
    GaveUp
        If time ran out.
    """
    circuit = graph.critical_circuit(time_limit=time_limit).arcs
    tight = tight_arcs_of(graph, time_limit=time_limit)
    shares = dict(_shares(scenario, graph, circuit))
    weights = {key: int(share[circuit].sum()) for key, share in shares.items()}
    chosen = sorted((k for k in shares if weights[k]), key=lambda k: -weights[k])[:most]
    effects = [_lever(graph, key, shares[key], tight, time_limit) for key in chosen]
    return tuple(sorted(effects, key=lambda lever: lever.ten_per_cent))


def _lever(
    graph: TimedEventGraph,
    key: _Key,
    share: NDArray[np.int64],
    tight: NDArray[np.bool_],
    time_limit: float | None,
) -> ParameterEffect:
    kind, robot, stop = key
    effect = sensitivity(graph, share, tight=tight, time_limit=time_limit)
    part = TEN_PER_CENT_FASTER if kind == "speed" else Fraction(1, 10)
    if part <= effect.until:
        then = effect.cycle_time - effect.gain * part
    else:
        then = cycle_time_without(graph, share, part, time_limit=time_limit)
    return ParameterEffect(kind=kind, robot=robot, stop=stop, effect=effect, ten_per_cent=then)


def _shares(
    scenario: Scenario, graph: TimedEventGraph, circuit: NDArray[np.int32]
) -> Iterator[tuple[_Key, NDArray[np.int64]]]:
    """Yield how much of each arc belongs to each lever of the robots on the circuit."""
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
    """Return which stages of a lap each of its visits serves, with their numbers.

    Parameters
    ----------
    lap
        What a robot repeats.
    itinerary
        What it has to do, in one lap or several.

    Notes
    -----
    Where a lap passes a place again before it goes on, stages without work and turning count for
    the first visit that fits.
    """
    stages = _one_lap(itinerary)
    at: list[list[tuple[int, Stage]]] = [[] for _ in range(len(lap))]
    number = 0
    for visit in [*range(1, len(lap)), 0]:
        spare = lap.dwell[visit]
        while number < len(stages) and _fits(stages[number], lap, visit, spare):
            spare -= stages[number].work + stages[number].turn
            at[visit].append((number, stages[number]))
            number += 1
    return at


def _fits(stage: Stage, lap: Lap, visit: int, spare: int) -> bool:
    return stage.vertex == lap.vertices[visit] and stage.work + stage.turn <= spare


def _one_lap(itinerary: Itinerary) -> Sequence[Stage]:
    """Return the stages to home: the first lap."""
    stages = itinerary.stages
    n = len(stages)
    shortest = next(k for k in range(1, n + 1) if n % k == 0 and stages[:k] * (n // k) == stages)
    return stages[:shortest]
