"""The map as orders to one robot have it: metres, in the frame of the robot, with y upwards."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from math import degrees, radians, remainder, tau
from typing import Any

from rightofway.control.identities import Identity
from rightofway.errors import InputError
from rightofway.model import Scenario, StopAction
from rightofway.site import Point, Roadmap, VertexId

__all__ = ["OrderLane", "OrderMap", "Place", "make_order_maps"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Place:
    """The position of a vertex.

    Attributes
    ----------
    point
        x and y in the frame of the robot [m].
    map_id
        The map of the robot.
    deviation
        How near the robot has to come [m]; None for its usual value.
    theta
        Heading of the robot when it works there, from -pi to pi [rad]; None for any.
    """

    point: tuple[float, float]
    map_id: str
    deviation: float | None = None
    theta: float | None = None


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
    orientation
        Angle of the robot against the direction of driving, from -pi to pi [rad]; None for any.
    edge_id
        Its id, which the layout or the scenario gives; None without one.
    turning
        Whether the robot may turn along it; None where that is unknown.
    """

    length: float
    max_speed: float
    points: tuple[tuple[float, float], ...] = ()
    is_bezier: bool = False
    orientation: float | None = None
    edge_id: str | None = None
    turning: bool | None = None


Shapes = Mapping[tuple[int, int], tuple[tuple[Point, ...], bool]]
"""Points between the ends of edges, and whether they control a Bézier curve."""


@dataclass(slots=True)
class _LookedUp:
    """The places looked up in a map, for all robots that see it alike."""

    shapes: Shapes
    headings: Mapping[int, Fraction]
    orientations: Mapping[tuple[int, int], Fraction]
    edge_ids: Mapping[tuple[int, int], str]
    turning: Mapping[tuple[int, int], bool]
    places: dict[str, Place | None] = field(default_factory=dict)
    lanes: dict[tuple[str, str], OrderLane | None] = field(default_factory=dict)

    @classmethod
    def of(cls, roadmap: Roadmap, shapes: Shapes) -> _LookedUp:
        """Return an empty lookup in a roadmap."""
        drawing = roadmap.drawing
        return cls(
            shapes=shapes,
            headings={int(vertex): heading for vertex, heading in drawing.headings},
            orientations={
                (int(tail), int(head)): orientation
                for tail, head, orientation in drawing.orientations
            },
            edge_ids={(int(tail), int(head)): own for tail, head, own in drawing.edge_ids},
            turning={(int(tail), int(head)): own for tail, head, own in drawing.turning},
        )


@dataclass(slots=True)
class OrderMap:
    """Positions of places and lanes for a robot of a scenario.

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
    looked_up
        The lookups of other robots that have the same frame and speed.
    """

    scenario: Scenario
    robot: int
    identity: Identity
    looked_up: _LookedUp | None = None
    _places: dict[str, Place | None] = field(init=False)
    _lanes: dict[tuple[str, str], OrderLane | None] = field(init=False)
    _known: _LookedUp = field(init=False)

    def __post_init__(self) -> None:
        roadmap = self.scenario.roadmap
        self._known = self.looked_up or _LookedUp.of(roadmap, _list_shapes(roadmap))
        self._places, self._lanes = self._known.places, self._known.lanes

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
            vertex = self._find_vertex(name)
            self._places[name] = (
                None
                if vertex is None
                else Place(
                    point=self._point(self.scenario.roadmap.get_point(vertex)),
                    map_id=self.identity.map_id,
                    deviation=self.deviation,
                    theta=self._find_theta(vertex),
                )
            )
        return self._places[name]

    def name_node(self, place: str) -> str:
        """Return the name of a vertex as robots have it.

        Where they may not turn, one node is a vertex for each direction (`site.directions`).

        Parameters
        ----------
        place
            The name of a vertex.
        """
        vertex, roadmap = self._find_vertex(place), self.scenario.roadmap
        return place if vertex is None else roadmap.name(roadmap.get_original(vertex))

    def list_vertices(self, node: str) -> list[str]:
        """Return the names of the vertices that a node of the robot stands for.

        Parameters
        ----------
        node
            Its name.
        """
        vertex, roadmap = self._find_vertex(node), self.scenario.roadmap
        return [node] if vertex is None else list(map(roadmap.name, roadmap.list_copies(vertex)))

    def find_lane(self, tail: str, head: str) -> OrderLane | None:
        """Return how the edge between two vertices is driven; None where there is none.

        Parameters
        ----------
        tail, head
            The names of its ends.
        """
        if (tail, head) not in self._lanes:
            self._lanes[tail, head] = self._make_lane(tail, head)
        return self._lanes[tail, head]

    def _make_lane(self, tail: str, head: str) -> OrderLane | None:
        scenario, roadmap = self.scenario, self.scenario.roadmap
        start, end = self._find_vertex(tail), self._find_vertex(head)
        edges = [] if start is None or end is None else roadmap.list_edges(start, end)
        if start is None or end is None or not edges:
            return None
        kind = roadmap.get_edge_class(edges[0])
        robot = scenario.robots[self.robot]
        speed = kind.limit_speed(robot.speed, robot.type)
        shape = self._known.shapes.get((start, end))
        points = tuple[tuple[float, float], ...]()
        if shape is not None:
            course = (roadmap.get_point(start), *shape[0], roadmap.get_point(end))
            points = tuple(map(self._point, course))
        return OrderLane(
            length=float(kind.length * self._metre),
            max_speed=float(speed * self._metre / (scenario.units.seconds or 1)),
            points=points,
            is_bezier=shape is not None and shape[1],
            orientation=self._find_orientation(start, end),
            edge_id=self._known.edge_ids.get((int(start), int(end))),
            turning=self._known.turning.get((int(start), int(end))),
        )

    def _find_vertex(self, name: str) -> VertexId | None:
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

    def _find_theta(self, vertex: VertexId) -> float | None:
        """Return the heading at a vertex in the frame of the robot; `find_heading` inverts it."""
        heading = self._known.headings.get(int(vertex))
        return None if heading is None else self._turn(heading, self.identity.frame.yaw)

    def _find_orientation(self, tail: VertexId, head: VertexId) -> float | None:
        orientation = self._known.orientations.get((int(tail), int(head)))
        return None if orientation is None else self._turn(orientation)

    def _turn(self, angle: Fraction, yaw: Fraction = Fraction(0)) -> float:
        """Return an angle of the site, from x to y, as the robot has it, from -pi to pi [rad]."""
        up = angle if self.scenario.roadmap.frame.y_up else -angle
        return remainder(radians(up) - yaw, tau)

    def find_heading(self, theta: float) -> Fraction:
        """Return a heading of the robot on the site, as `RobotState.heading` [degrees].

        Parameters
        ----------
        theta
            From x to y in the frame of the robot [rad].
        """
        heading = round(degrees(theta + self.identity.frame.yaw), 6)
        return Fraction(str(heading if self.scenario.roadmap.frame.y_up else -heading)) % 360

    def to_document(self) -> dict[str, Any]:
        """Return all that messages to the robot depend on beside its orders."""
        identity = self.identity
        return {
            "identity": [identity.manufacturer, identity.serial_number, identity.version],
            "frame": [str(identity.frame.x), str(identity.frame.y), str(identity.frame.yaw)],
            "map": identity.map_id,
            "deviation": self.deviation,
            "work": [*_write_action(identity.work).values(), identity.repeats_work],
            "charging": list(map(_write_action, (identity.start_charging, identity.stop_charging))),
            **{
                key: own.to_document()
                for key, own in (("pick", identity.pick), ("drop", identity.drop))
                if own is not None
            },
        }


def _write_action(action: StopAction) -> dict[str, Any]:
    """Return an action with its parameters, also where it has none, and all that is unusual."""
    own = action.to_document()
    return {"action": own.pop("action"), "parameters": own.pop("parameters", {}), **own}


def make_order_maps(scenario: Scenario, identities: Sequence[Identity]) -> list[OrderMap]:
    """Return the map of each robot; robots that see the site alike look up a place once.

    Parameters
    ----------
    scenario
        The scenario of the plan.
    identities
        The robots, in its order.
    """
    shapes, looked_up = _list_shapes(scenario.roadmap), dict[Any, _LookedUp]()
    maps = []
    for robot, (own, identity) in enumerate(zip(scenario.robots, identities, strict=True)):
        view = (identity.frame, identity.map_id, identity.deviation, own.speed, own.type)
        known = looked_up.setdefault(view, _LookedUp.of(scenario.roadmap, shapes))
        maps.append(OrderMap(scenario, robot, identity, known))
    return maps


def _list_shapes(roadmap: Roadmap) -> Shapes:
    """Return the shapes of all edges that have one, or are pieces of a lane."""
    shapes = {
        (int(tail), int(head)): (points, is_bezier)
        for curves, is_bezier in ((roadmap.drawing.curves, False), (roadmap.drawing.controls, True))
        for tail, head, points in curves
    }
    for lane in roadmap.lanes:  # a robot keeps to the way of the lane, however short its pieces
        for tail, head in lane.pieces:
            shapes.setdefault((int(tail), int(head)), ((), False))
    return shapes
