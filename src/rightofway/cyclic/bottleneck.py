"""What a period is made of: the critical circuit, read as work, ways and places that change hands.

The circuit leads along a robot's visits until that robot leaves a place that another one waits
for, goes on with the other robot, and comes back to where it began some periods later.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import groupby
from typing import Literal

from rightofway.model import Scenario, Tick, VertexId
from rightofway.precedence import TimedEventGraph

__all__ = ["Bottleneck", "Piece", "bottleneck_of", "in_words"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Piece:
    """One thing that has to be over before the next can begin.

    Attributes
    ----------
    kind
        ``work`` (with turning) at a place, a ``way``, or the ``right of way`` at a place.
    robot
        Whose; of a right of way: who waits for it.
    places
        Where; of a way: from the first to the last one.
    ticks
        How long it takes; of a right of way: headway and approach [ticks].
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
        Its length by its periods [ticks].
    periods
        How many periods it takes to come round.
    pieces
        What it is made of, in order; after the last one the first comes again.
    """

    cycle_time: Fraction
    periods: int
    pieces: tuple[Piece, ...]

    @property
    def robots(self) -> tuple[int, ...]:
        """The robots on it, in order."""
        return tuple(dict.fromkeys(piece.robot for piece in self.pieces))


def bottleneck_of(graph: TimedEventGraph, *, time_limit: float | None = None) -> Bottleneck:
    """Return a critical circuit of the event graph, in pieces.

    Raises
    ------
    GaveUp
        If time ran out.
    """
    found = graph.critical_circuit(time_limit=time_limit)
    arcs = _from_the_longest_run(graph, found.arcs.tolist())
    return Bottleneck(
        cycle_time=found.cycle_time,
        periods=int(graph.arcs.height[found.arcs].sum()),
        pieces=tuple(_joined(list(_pieces(graph, arcs)))),
    )


def _from_the_longest_run(graph: TimedEventGraph, circuit: list[int]) -> list[int]:
    """Begin the circuit with the robot whose visits take most of it, after it got its way."""
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
        here, there = (VertexId(int(graph.vertex[visit])) for visit in (tail, head))
        robot = robots[graph.robot[head]]
        if arcs.first[arc] >= 0:
            ticks = Tick(int(arcs.length[arc]))
            yield Piece(kind="right of way", robot=robot, places=(there,), ticks=ticks)
            continue
        if graph.dwell[tail]:
            ticks = Tick(int(graph.dwell[tail]))
            yield Piece(kind="work", robot=robot, places=(here,), ticks=ticks)
        ticks = Tick(int(graph.drive[head]))
        yield Piece(kind="way", robot=robot, places=(here, there), ticks=ticks)


def _joined(pieces: list[Piece]) -> Iterator[Piece]:
    """Join the ways that a robot drives without a stop in between."""
    for (kind, robot), group in groupby(pieces, lambda piece: (piece.kind, piece.robot)):
        run = list(group)
        if kind != "way":
            yield from run
            continue
        places = (run[0].places[0], *(piece.places[1] for piece in run))
        ticks = Tick(sum(piece.ticks for piece in run))
        yield Piece(kind="way", robot=robot, places=places, ticks=ticks)


def in_words(bottleneck: Bottleneck, scenario: Scenario, *, most: int = 12) -> str:
    """Say what a bottleneck is: ``R2's work at N8, then N4, then R1's way home``.

    Parameters
    ----------
    bottleneck
        What to put into words.
    scenario
        Names of robots and places.
    most
        How many pieces to name; the rest is counted.
    """
    if len(bottleneck.robots) == 1:
        name = scenario.robots[bottleneck.robots[0]].name
        return f"{name}'s own lap: it waits for nobody"
    said = [_said(piece, scenario) for piece in bottleneck.pieces]
    if len(said) > most:
        said = [*said[:most], f"{len(said) - most} more"]
    return ", then ".join(said)


def _said(piece: Piece, scenario: Scenario) -> str:
    robot, name = scenario.robots[piece.robot], scenario.roadmap.name
    if piece.kind == "right of way":
        return name(piece.places[0])
    if piece.kind == "work":
        doing = "turn" if piece.places[0] == robot.home else "work"
        return f"{robot.name}'s {doing} at {name(piece.places[0])}"
    if piece.places[-1] == robot.home:
        return f"{robot.name}'s way home"
    return f"{robot.name}'s way to {name(piece.places[-1])}"
