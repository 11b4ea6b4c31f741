"""The trip of one robot in ticks: its stages, and how fast it crosses edges and turns."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import NamedTuple

from rightofway.model.turning import Turning
from rightofway.model.units import Tick
from rightofway.site import VertexId

LARGEST_SURCHARGE = 2**27
"""Routes are chosen as if no edge had a larger surcharge [ticks]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Stage:
    """One step of a trip: be at a vertex, work there, turn.

    Attributes
    ----------
    vertex
        Where.
    work
        The work time of the robot there [ticks].
    turn
        How long it then turns, if an edge is to be driven afterwards [ticks]; 0 where the next
        stage is at the same vertex. In a scenario with jobs a visit turns once, after the last of
        the stages that it serves; the turn is 0 for none of them.
    earliest
        The work begins then or later [ticks].
    latest
        The work ends then or before [ticks]; None for no limit.
    weight
        The cost of a tick of the end of the work; 0 for nothing.
    due
        From when on a tick of the end costs `Work.late` times the weight more [ticks]; None for
        never.
    """

    vertex: VertexId
    work: Tick
    turn: Tick
    earliest: Tick = field(default=Tick(0))
    latest: Tick | None = None
    weight: int = 0
    due: Tick | None = None


class Arc(NamedTuple):
    """A stage of one robot ends before a stage of another robot begins.

    Attributes
    ----------
    before, after
        Each the index of a robot and of one of its stages.
    """

    before: tuple[int, int]
    after: tuple[int, int]


@dataclass(frozen=True, slots=True, kw_only=True)
class Itinerary:
    """The trip of one robot, laps unrolled.

    Attributes
    ----------
    home
        The vertex it is at from tick 0: the home, or the start of a robot with a state.
    stages
        Its stages, in order. It stays at the vertex of the last one permanently.
    edge_ticks
        Ticks it needs for an edge, by edge class of the roadmap; -1 where it is barred.
    surcharges
        Ticks by which an edge of each class is less liked; empty where all are 0.
    turning
        The times of turns on the spot between two edges, or None if they take no time.
    weight
        The weight of a tick of it, compared with a tick of the other robots; whole numbers for a
        fleet, all 1 where robots count alike.
    ready
        Until then the robot stays where it begins [ticks].
    heading
        Angle from the x axis of the map's plane to its y axis, which points down, at the first
        drive [degrees]; None where the first drive needs no turn.
    first_turns
        How long the robot turns from its `heading` before it drives along each edge out of `home`
        [ticks]; empty where the first drive needs no turn.
    ends_anywhere
        Whether the robot, of a scenario with jobs, completes with its last work and may then drive
        to any vertex, where it stays permanently. A last stage without work and weight is such a
        vertex, as far as it is known.
    """

    home: VertexId
    stages: tuple[Stage, ...]
    edge_ticks: tuple[Tick, ...]
    surcharges: tuple[Tick, ...] = ()
    turning: Turning | None = None
    weight: int = 1
    ready: Tick = field(default=Tick(0))
    heading: Fraction | None = None
    first_turns: tuple[Tick, ...] = ()
    ends_anywhere: bool = False

    @property
    def edge_costs(self) -> tuple[Tick, ...]:
        """Ticks and surcharge of an edge of each class; -1 where the robot is barred.

        A surcharge counts up to `LARGEST_SURCHARGE`, so that costs of paths fit 32 bits.
        """
        if not self.surcharges:
            return self.edge_ticks
        return tuple(
            Tick(ticks + min(more, LARGEST_SURCHARGE)) if ticks > 0 else ticks
            for ticks, more in zip(self.edge_ticks, self.surcharges, strict=True)
        )

    @property
    def quickest_edge(self) -> Tick:
        """Ticks of the quickest edge; 1 without an edge."""
        return min((ticks for ticks in self.edge_ticks if ticks > 0), default=Tick(1))

    @property
    def stages_to_serve(self) -> tuple[Stage, ...]:
        """The stages, without the vertex where a robot rests that ends anywhere."""
        last = self.stages[-1]
        rests = self.ends_anywhere and last.work == 0 and last.weight == 0
        return self.stages[:-1] if rests else self.stages

    @property
    def last(self) -> VertexId:
        """The vertex where the robot stays permanently."""
        return self.stages[-1].vertex

    def as_steps(self) -> Itinerary:
        """Return the trip with a tick for each edge, without work and turning."""
        return Itinerary(
            home=self.home,
            stages=tuple(
                Stage(vertex=stage.vertex, work=Tick(0), turn=Tick(0)) for stage in self.stages
            ),
            edge_ticks=tuple(Tick(1) if ticks > 0 else ticks for ticks in self.edge_ticks),
        )


def compute_least_dwell(stages: Sequence[Stage], *, leaves: bool) -> Tick:
    """Return the least duration of a visit that serves these stages, without the edge after it.

    The last visit of a robot (``leaves`` is false) needs no turning.

    Parameters
    ----------
    stages
        The stages that the visit serves, in order.
    leaves
        Whether the robot drives on afterwards.
    """
    return Tick(sum(stage.work + (stage.turn if leaves else 0) for stage in stages))
