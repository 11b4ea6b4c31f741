"""The period as a function of one parameter: lines of circuits, and where one takes over."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from rightofway.model import BookingRules, Lap, Tick
from rightofway.precedence import Growth, PeriodPiece, TimedEventGraph, compute_period_curve
from rightofway.site import VertexId
from tests.builders.periodic import timetable_of


def lap(*vertices: int, dwell: int = 0, drive: int = 1) -> Lap:
    """Return a lap that dwells at its second vertex."""
    count = len(vertices)
    return Lap(
        vertices=tuple(map(VertexId, vertices)),
        dwell=tuple(Tick(dwell if k == 1 else 0) for k in range(count)),
        drive=(Tick(drive),) * count,
    )


def circle() -> TimedEventGraph:
    """Return four robots that go round four vertices at one instant, for ever."""
    ring = (0, 1, 2, 3)
    laps = [lap(*ring[k:], *ring[:k]) for k in ring]
    return TimedEventGraph(timetable_of(laps, [[0, 1, 2, 3]] * 4, period=4), rules=BookingRules())


def told(piece: PeriodPiece) -> list[Fraction]:
    return [piece.start, piece.until, piece.fixed, piece.slope]


def growing(graph: TimedEventGraph, mask: NDArray[np.bool_]) -> Growth:
    """Return arcs of which some are longer by the parameter."""
    return Growth(of=np.arange(len(mask)), fixed=graph.arcs.length, slope=mask.astype(np.int64))


def test_a_work_time_costs_nothing_until_its_circuit_is_critical() -> None:
    """Two robots that meet at vertex 1; the lap of the second one takes longer by 3."""
    laps = [lap(0, 1), lap(2, 1, drive=1, dwell=3)]
    timetable = timetable_of(laps, [[1, 5], [0, 1]], period=10)
    graph = TimedEventGraph(timetable, rules=BookingRules())
    # Laps alone: 2 and 5. Around vertex 1: both stay for their drive away and the work there,
    # 1 + (1 + 3) = 5 in one period. So each tick of work of the first robot at vertex 1 costs one.
    at_one = (graph.arcs.first < 0) & (graph.robot[graph.arcs.tail] == 0)
    at_one &= graph.index[graph.arcs.tail] == 1
    [piece] = compute_period_curve(graph, growing(graph, at_one), Fraction(0), Fraction(8))
    assert told(piece) == [0, 8, 5, 1]
    # At home nobody waits for the first robot: its lap of 2 decides from 3 ticks on.
    at_home = (graph.arcs.first < 0) & (graph.robot[graph.arcs.tail] == 0)
    at_home &= graph.index[graph.arcs.tail] == 0
    flat, steep = compute_period_curve(graph, growing(graph, at_home), Fraction(0), Fraction(8))
    assert told(flat) == [0, 3, 5, 0]
    assert told(steep) == [3, 8, 2, 1]
    assert set(graph.robot[graph.arcs.tail[steep.arcs]].tolist()) == {0}
    assert steep.compute_period(Fraction(7, 2)) == Fraction(11, 2)


def test_a_circle_of_robots_leaves_no_room_for_a_headway() -> None:
    graph = circle()
    rights = growing(graph, graph.arcs.first >= 0)
    [piece] = compute_period_curve(graph, rights, Fraction(0), Fraction(8))
    assert told(piece) == [0, 0, 4, 0]


def test_a_parameter_of_no_arc_changes_nothing() -> None:
    graph = circle()
    nothing = growing(graph, np.zeros(len(graph.arcs), np.bool_))
    [piece] = compute_period_curve(graph, nothing, Fraction(0), Fraction(8))
    assert told(piece) == [0, 8, 4, 0]
