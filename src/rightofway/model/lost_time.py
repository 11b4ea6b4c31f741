"""Losses of robots to others, and where: the parts of a completion time, and their causes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict, dataclass
from typing import Any, Literal

from rightofway.kinds.arguments import checks_arguments
from rightofway.model.units import Tick
from rightofway.site import VertexId


@dataclass(frozen=True, slots=True, kw_only=True)
class Loss:
    """One cause of lost time: waits of one robot for one other, or a drive to make room.

    Attributes
    ----------
    kind
        ``waits``: the robot waits at a vertex, without work or turning. ``follows``: it waits
        several times behind the same robot, along a run of vertices that both drive in the same
        direction. ``waits for job``: it waits at a stop until a job of another robot has ended.
        ``makes room``: it leaves a vertex and comes back to it without a stop in between.
    robot
        The robot that loses time, by index.
    for_robot
        The robot that goes first, by index. None where no robot is the cause.
    vertex
        Where it waits first; or the vertex that it leaves and comes back to.
    until_vertex
        Where it waits last; for a single wait, and for a robot that makes room, equal to
        ``vertex``.
    towards
        The vertex where it goes after the last wait; or the first one that it makes room in; or
        the stop where it waits for a job.
    freed
        The vertex that ``for_robot`` leaves, for the last wait, at the very tick from which the
        robot may book its way on: ``towards``, a vertex further on the route, or one too near to
        these for robots with a size. None where no robot is the cause, or its job is.
    tick, end
        When the first wait begins and the last one ends; or when the robot leaves the vertex and
        when it is back [ticks].
    ticks
        The time that is lost: all waits; or the drives of making room, without waits [ticks].
    count
        The number of joined waits; 1 for a robot that makes room.
    """

    kind: Literal["waits", "follows", "makes room", "waits for job"]
    robot: int
    for_robot: int | None
    vertex: VertexId
    until_vertex: VertexId
    towards: VertexId
    freed: VertexId | None
    tick: Tick
    end: Tick
    ticks: Tick
    count: int


@dataclass(frozen=True, slots=True, kw_only=True)
class LostTime:
    """The parts of one robot's completion time: their sum is that time exactly.

    Attributes
    ----------
    robot
        The robot, by index.
    alone
        Its shortest completion time without the others [ticks].
    detours
        The excess of its drives over its shortest trip, without the drives that make room [ticks].
        Below 0 only in a plan that breaks the rules.
    making_room
        The time of its drives away from vertices and back to them [ticks].
    waiting
        The time of its waits [ticks].
    losses
        The causes, by tick, then the longest first: those that make room sum up to
        ``making_room``, the others to ``waiting``.
    """

    robot: int
    alone: Tick
    detours: Tick
    making_room: Tick
    waiting: Tick
    losses: tuple[Loss, ...]

    @property
    def completion(self) -> Tick:
        """When the robot has done its work and is at its last vertex [ticks]."""
        return Tick(self.alone + self.lost)

    @property
    def lost(self) -> Tick:
        """The excess over the time without the others [ticks]."""
        return Tick(self.detours + self.making_room + self.waiting)

    @checks_arguments
    def as_dict(
        self, robot: Callable[[int], Any] = int, place: Callable[[int], Any] = int
    ) -> dict[str, Any]:
        """Return all but the robot by name, as plain data.

        Parameters
        ----------
        robot
            The form of a robot: its index, or for example its name.
        place
            The form of a vertex.
        """
        marks = dict.fromkeys(("robot", "for_robot"), robot)
        marks |= dict.fromkeys(("vertex", "until_vertex", "towards", "freed"), place)
        return {
            "completion": self.completion,
            "alone": self.alone,
            "detours": self.detours,
            "making_room": self.making_room,
            "waiting": self.waiting,
            "losses": [
                {
                    key: marks[key](value) if key in marks and value is not None else value
                    for key, value in asdict(loss).items()
                }
                for loss in self.losses
            ],
        }


@dataclass(frozen=True, slots=True, kw_only=True)
class Wait:
    """A robot waits at a vertex, without work or turning.

    Attributes
    ----------
    robot
        The robot that waits, by index.
    vertex
        Where it waits.
    tick
        When it begins: the robot has worked and turned, and might drive on [ticks].
    ticks
        Its duration [ticks].
    towards
        The vertex where the robot goes next; where it waits, if it waits for the end of a job.
    for_robot
        The robot whose right of way binds the visit of that vertex: the waiting robot books it as
        soon as that robot is out of the way; or the robot that ends a job first. None if no right
        of way does: then the reason lies further on the route.
    """

    robot: int
    vertex: VertexId
    tick: Tick
    ticks: Tick
    towards: VertexId
    for_robot: int | None
