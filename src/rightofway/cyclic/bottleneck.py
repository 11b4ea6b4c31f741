"""The bottleneck: the critical circuit of a period as work, drives and rights of way.

The circuit follows the visits of one robot to a vertex for which a second robot waits, continues
with the second robot, and returns to the first visit some periods later.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import groupby
from typing import Literal

from rightofway.arguments import checks_arguments
from rightofway.model import Scenario, Tick
from rightofway.model.place_names import PlaceNames
from rightofway.precedence import TimedEventGraph
from rightofway.site import VertexId


@dataclass(frozen=True, slots=True, kw_only=True)
class Piece:
    """One activity of a critical circuit; the next activity waits for its end.

    Attributes
    ----------
    kind
        ``work`` (with turning) at a vertex, a ``way``, or the ``right of way`` at a vertex.
    robot
        The robot that works, drives, or waits for the right of way.
    places
        The vertex; of a way: all vertices in order; of a right of way where robots have a size:
        also the vertex that the other robot leaves, if it is another one.
    ticks
        Its duration; of a right of way: headway and approach [ticks].
    """

    kind: Literal["work", "way", "right of way"]
    robot: int
    places: tuple[VertexId, ...]
    ticks: Tick


@dataclass(frozen=True, slots=True, kw_only=True)
class Bottleneck:
    """A critical circuit.

    Attributes
    ----------
    cycle_time
        Length of the circuit divided by ``periods`` [ticks].
    periods
        Number of periods of one round of the circuit.
    pieces
        Activities in cyclic order.
    """

    cycle_time: Fraction
    periods: int
    pieces: tuple[Piece, ...]

    @property
    def robots(self) -> tuple[int, ...]:
        """The robots on the circuit, in order."""
        return tuple(dict.fromkeys(piece.robot for piece in self.pieces))


@checks_arguments
def bottleneck_of(graph: TimedEventGraph, *, time_limit: float | None = None) -> Bottleneck:
    """Return a critical circuit of a timed event graph, in pieces.

    Parameters
    ----------
    graph
        Laps and orders.
    time_limit
        When to stop [s].

    Raises
    ------
    GaveUp
        If time ran out.
    """
    return bottleneck_along(graph, graph.critical_circuit(time_limit=time_limit).arcs.tolist())


@checks_arguments
def bottleneck_along(graph: TimedEventGraph, circuit: Sequence[int]) -> Bottleneck:
    """Return a circuit in pieces; its cycle time is less than that of the graph if not critical.

    Parameters
    ----------
    graph
        Laps and orders.
    circuit
        The numbers of its arcs, in order.
    """
    arcs = _from_the_longest_run(graph, list(circuit))
    periods = int(graph.arcs.height[arcs].sum())
    return Bottleneck(
        cycle_time=Fraction(int(graph.arcs.length[arcs].sum()), periods),
        periods=periods,
        pieces=tuple(_joined(_pieces(graph, arcs))),
    )


def _from_the_longest_run(graph: TimedEventGraph, circuit: list[int]) -> list[int]:
    """Rotate the circuit to begin with the longest run of visits of one robot."""
    starts = [k for k, arc in enumerate(circuit) if graph.arcs.first[arc] >= 0]
    if not starts:
        home = next(k for k, arc in enumerate(circuit) if graph.index[graph.arcs.tail[arc]] == 0)
        return circuit[home:] + circuit[:home]
    ends = [*starts[1:], starts[0] + len(circuit)]
    runs = [
        (sum(int(graph.arcs.length[circuit[k % len(circuit)]]) for k in range(a + 1, b)), a)
        for a, b in zip(starts, ends, strict=True)
    ]
    longest = max(runs, key=lambda run: (run[0], -run[1]))[1] + 1
    return circuit[longest:] + circuit[:longest]


def _pieces(graph: TimedEventGraph, circuit: Sequence[int]) -> Iterator[Piece]:
    robots, arcs = graph.timetable.robots, graph.arcs
    for arc in circuit:
        tail, head = int(arcs.tail[arc]), int(arcs.head[arc])
        start, goal = (VertexId(int(graph.vertex[visit])) for visit in (tail, head))
        robot = robots[graph.robot[head]]
        if arcs.first[arc] >= 0:
            ticks = Tick(int(arcs.length[arc]))
            left = VertexId(int(graph.vertex[arcs.first[arc]]))
            places = (goal,) if left == goal else (goal, left)
            yield Piece(kind="right of way", robot=robot, places=places, ticks=ticks)
            continue
        if graph.dwell[tail]:
            ticks = Tick(int(graph.dwell[tail]))
            yield Piece(kind="work", robot=robot, places=(start,), ticks=ticks)
        ticks = Tick(int(graph.drive[head]))
        yield Piece(kind="way", robot=robot, places=(start, goal), ticks=ticks)


def _joined(pieces: Iterator[Piece]) -> Iterator[Piece]:
    """Join consecutive ways of a robot."""
    for (kind, robot), group in groupby(pieces, lambda piece: (piece.kind, piece.robot)):
        run = list(group)
        if kind != "way":
            yield from run
            continue
        places = (run[0].places[0], *(piece.places[1] for piece in run))
        ticks = Tick(sum(piece.ticks for piece in run))
        yield Piece(kind="way", robot=robot, places=places, ticks=ticks)


@checks_arguments
def in_words(bottleneck: Bottleneck, scenario: Scenario, *, most: int = 12) -> str:
    """Describe a bottleneck: ``R2 enters N4, drives to N8, works, drives home; R1 enters N4``.

    Parameters
    ----------
    bottleneck
        The bottleneck to describe.
    scenario
        The scenario, for names of robots and places.
    most
        Number of steps to name; further steps are counted.
    """
    if len(bottleneck.robots) == 1:
        name = scenario.robots[bottleneck.robots[0]].name
        return f"{name}'s own lap: it waits for no robot"
    pieces = list(bottleneck.pieces)
    while pieces[-1].kind == "right of way":  # how the first robot comes to its first piece
        pieces.insert(0, pieces.pop())
    parts, left = [], most
    for robot, run in groupby(pieces, lambda piece: piece.robot):
        steps = list(_steps(list(run), scenario))
        if left > 0:
            parts.append(f"{scenario.robots[robot].name} {', '.join(steps[:left])}")
        left -= len(steps)
    if left < 0:
        parts.append(f"and {-left} more step{'s' * (left < -1)}")
    return "; ".join(parts)


def _steps(run: Sequence[Piece], scenario: Scenario) -> Iterator[str]:
    """Yield what one robot does without waiting for others; whole laps in between are counted."""
    robot, place = scenario.robots[run[0].robot], PlaceNames(scenario)
    home, works_at = robot.home, {stop.at for stop in robot.stops} - {robot.home}
    steps: list[str] = []
    arrivals: list[int] = []  # how many steps have been made when the robot is home
    for piece in run:
        if piece.kind == "right of way":
            steps.append(f"enters {' beside '.join(map(place, piece.places))}")
        elif piece.kind == "work":
            (vertex,) = piece.places
            steps.append("works" if vertex in works_at else f"turns at {place(vertex)}")
        else:
            for last in _split_at(piece.places[1:], home):
                steps.append("drives home" if last == home else f"drives to {place(last)}")
                if last == home:
                    arrivals.append(len(steps))
    laps = len(arrivals) - 1
    if laps < 1:
        yield from steps
        return
    yield from steps[: arrivals[0]]
    yield f"makes {laps} lap{'s' * (laps > 1)} of its own"
    yield from steps[arrivals[-1] :]


def _split_at(places: Sequence[VertexId], home: VertexId) -> Iterator[VertexId]:
    """Yield where each part of a way ends: at home, and at the last vertex."""
    for place in places[:-1]:
        if place == home:
            yield place
    yield places[-1]
