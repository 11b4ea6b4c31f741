"""The bottleneck: the critical circuit of a period as work, drives and rights of way.

The circuit follows the visits of one robot to a vertex for which a second robot waits, continues
with the second robot, and returns to the first visit some periods later.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import pairwise
from typing import Literal

from rightofway.model import Plan, SteadyState, Tick, find_stays
from rightofway.precedence import TimedEventGraph
from rightofway.site import VertexId


@dataclass(frozen=True, slots=True, kw_only=True)
class Piece:
    """One activity of a critical circuit; the next activity waits for its end.

    Attributes
    ----------
    kind
        ``work`` (with turning) at a vertex, a ``way`` that ends at home at the latest, or the
        ``right of way`` at a vertex.
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


def find_bottleneck(graph: TimedEventGraph, *, time_limit: float | None = None) -> Bottleneck:
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
    return trace_bottleneck(graph, graph.find_critical_circuit(time_limit=time_limit).arcs.tolist())


def trace_bottleneck(graph: TimedEventGraph, circuit: Sequence[int]) -> Bottleneck:
    """Return a circuit in pieces; its cycle time is less than that of the graph if not critical.

    Parameters
    ----------
    graph
        Laps and orders.
    circuit
        The numbers of its arcs, in order.
    """
    arcs = begin_with_longest_run(graph, list(circuit))
    periods = int(graph.arcs.height[arcs].sum())
    homes = {
        robot: VertexId(int(graph.vertex[first]))
        for robot, first in zip(graph.timetable.robots, graph.first[:-1], strict=True)
    }
    return Bottleneck(
        cycle_time=Fraction(int(graph.arcs.length[arcs].sum()), periods),
        periods=periods,
        pieces=tuple(_join_pieces(_list_pieces(graph, arcs), homes)),
    )


def begin_with_longest_run(graph: TimedEventGraph, circuit: list[int]) -> list[int]:
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


def _list_pieces(graph: TimedEventGraph, circuit: Sequence[int]) -> Iterator[Piece]:
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


def _join_pieces(pieces: Iterable[Piece], homes: Mapping[int, VertexId]) -> Iterator[Piece]:
    """Join consecutive ways of a robot, each up to where it is home."""
    places: list[VertexId] = []
    ticks = 0
    for piece, following in pairwise((*pieces, None)):
        if piece is None or piece.kind != "way":
            if piece:
                yield piece
            continue
        places.extend(piece.places[1:] if places else piece.places)
        ticks += piece.ticks
        is_last = following is None or (following.kind, following.robot) != ("way", piece.robot)
        if is_last or piece.places[1] == homes[piece.robot]:
            yield replace(piece, places=tuple(places), ticks=Tick(ticks))
            places, ticks = [], 0


def list_pieces_of_plan(plan: Plan, steady: SteadyState) -> tuple[Piece, ...]:
    """Return the critical circuit of a steady state in pieces; empty if it is unknown.

    Parameters
    ----------
    plan
        The plan, of whole laps.
    steady
        The steady state of some of its robots.
    """
    tracks, stays = plan.tracks, find_stays(plan.scenario, plan.tracks)
    pieces = list[Piece]()
    for (robot, visit), (following, visit_after) in pairwise(
        (*steady.critical, *steady.critical[:1])
    ):
        start, goal = (
            VertexId(int(tracks[robot_of_visit].vertices[at]))
            for robot_of_visit, at in ((robot, visit), (following, visit_after))
        )
        if robot != following:
            # The begin of a visit ends the one before, of the first visit the last one at home.
            left = VertexId(int(tracks[robot].vertices[visit - 1 if visit else -2]))
            wait = tracks[following].enter[visit_after] - tracks[robot].enter[visit]
            pieces.append(
                Piece(
                    kind="right of way",
                    robot=following,
                    places=(goal,) if left == goal else (goal, left),
                    ticks=Tick(int(wait) % steady.period),
                )
            )
            continue
        dwell, drive = (Tick(int(part[visit])) for part in (stays[robot].dwell, stays[robot].drive))
        if dwell:
            pieces.append(Piece(kind="work", robot=robot, places=(start,), ticks=dwell))
        pieces.append(Piece(kind="way", robot=robot, places=(start, goal), ticks=drive))
    homes = {robot: plan.scenario.robots[robot].home for robot in steady.robots}
    return tuple(_join_pieces(pieces, homes))
