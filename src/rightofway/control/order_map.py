"""The map as orders to one robot have it: metres, in the frame of the robot, with y upwards."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

from rightofway.control.identities import Identity, Work
from rightofway.errors import InputError
from rightofway.model import Scenario
from rightofway.site import Point, VertexId

__all__ = ["OrderLane", "OrderMap", "Place", "Work"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Place:
    """Where a vertex is.

    Attributes
    ----------
    point
        x and y in the frame of the robot [m].
    map_id
        The map of the robot.
    deviation
        How near the robot has to come [m]; None for what is usual for it.
    """

    point: tuple[float, float]
    map_id: str
    deviation: float | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class OrderLane:
    """How an edge is driven.

    Attributes
    ----------
    length
        Its length [m].
    max_speed
        The planned speed, and at most the speed limit [m/s].
    points
        The control points of its shape, both ends included [m]; none for a straight line.
    is_bezier
        Whether the points are those of one Bézier curve; else straight lines join them.
    """

    length: float
    max_speed: float
    points: tuple[tuple[float, float], ...] = ()
    is_bezier: bool = False


@dataclass(slots=True)
class OrderMap:
    """Where places and lanes lie for a robot of a scenario.

    A site whose y grows downwards is mirrored, because frames of robots are right-handed. A place
    that the scenario does not have has no position.

    Parameters
    ----------
    scenario
        The scenario of the plan; lengths without a unit are metres, times seconds.
    robot
        The number of the robot.
    identity
        Has the frame of the robot, its map and how near it has to come.
    """

    scenario: Scenario
    robot: int
    identity: Identity
    _places: dict[str, Place | None] = field(init=False, default_factory=dict)
    _lanes: dict[tuple[str, str], OrderLane | None] = field(init=False, default_factory=dict)
    _shapes: Mapping[tuple[int, int], tuple[tuple[Point, ...], bool]] = field(init=False)

    def __post_init__(self) -> None:
        roadmap = self.scenario.roadmap
        shapes = {
            (int(tail), int(head)): (points, is_bezier)
            for curves, is_bezier in (
                (roadmap.drawing.curves, False),
                (roadmap.drawing.controls, True),
            )
            for tail, head, points in curves
        }
        for lane in roadmap.lanes:  # a robot keeps to the way of the lane, however short its pieces
            for tail, head in lane.pieces:
                shapes.setdefault((int(tail), int(head)), ((), False))
        self._shapes = shapes

    @property
    def work(self) -> Work:
        """What the robot does at a stop."""
        return self.identity.work

    @property
    def _metre(self) -> Fraction:
        return self.scenario.units.metres or Fraction(1)

    @property
    def deviation(self) -> float | None:
        """How far from a vertex the robot may call itself arrived [m]; None for its own measure.

        Half the clearance, unless its identity says: two robots that are both off by this much
        towards each other do not touch.
        """
        if self.identity.deviation is not None:
            return self.identity.deviation
        half = self.scenario.rules.clearance * self._metre / 2
        return float(half) if half else None

    def get_place(self, name: str) -> Place | None:
        """Return where a vertex is.

        Parameters
        ----------
        name
            Its name.
        """
        if name not in self._places:
            vertex = self._vertex(name)
            self._places[name] = (
                None
                if vertex is None
                else Place(
                    point=self._point(self.scenario.roadmap.get_point(vertex)),
                    map_id=self.identity.map_id,
                    deviation=self.deviation,
                )
            )
        return self._places[name]

    def find_lane(self, tail: str, head: str) -> OrderLane | None:
        """Return how the edge between two vertices is driven; None where there is none.

        Parameters
        ----------
        tail, head
            The names of its ends.
        """
        if (tail, head) not in self._lanes:
            self._lanes[tail, head] = self._made_lane(tail, head)
        return self._lanes[tail, head]

    def _made_lane(self, tail: str, head: str) -> OrderLane | None:
        scenario, roadmap = self.scenario, self.scenario.roadmap
        start, end = self._vertex(tail), self._vertex(head)
        edge = None if start is None or end is None else roadmap.find_edge(start, end)
        if start is None or end is None or edge is None:
            return None
        kind = roadmap.get_edge_class(edge)
        speed = scenario.robots[self.robot].speed
        speed = speed if kind.max_speed is None else min(speed, kind.max_speed)
        shape = self._shapes.get((start, end))
        points = tuple[tuple[float, float], ...]()
        if shape is not None:
            course = (roadmap.get_point(start), *shape[0], roadmap.get_point(end))
            points = tuple(map(self._point, course))
        return OrderLane(
            length=float(kind.length * self._metre),
            max_speed=float(speed * self._metre / (scenario.units.seconds or 1)),
            points=points,
            is_bezier=shape is not None and shape[1],
        )

    def _vertex(self, name: str) -> VertexId | None:
        try:
            return self.scenario.roadmap.get_vertex(name)
        except InputError:
            return None

    def _point(self, point: Point) -> tuple[float, float]:
        """Return a point of the site in the frame of the robot [m]."""
        x, y = point
        up = y if self.scenario.roadmap.frame.y_up else -y
        x, y = self.identity.frame.to_plane((x * self._metre, up * self._metre))
        return float(x), float(y)

    def to_document(self) -> dict[str, Any]:
        """Return all that messages to the robot depend on beside its orders."""
        identity = self.identity
        return {
            "identity": [identity.manufacturer, identity.serial_number, identity.version],
            "frame": [str(identity.frame.x), str(identity.frame.y), str(identity.frame.yaw)],
            "map": identity.map_id,
            "deviation": self.deviation,
            "work": [identity.work.action, identity.work.parameters, identity.repeats_work],
        }
