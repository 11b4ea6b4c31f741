"""A fleet built in Python: the map, the robots and the rules, without a file."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import fields, replace
from fractions import Fraction
from functools import partial
from pathlib import Path
from typing import Any, Literal, Self

from rightofway.errors import InputError, nearest, shown
from rightofway.model import (
    Edge,
    Point,
    Roadmap,
    Robot,
    Rules,
    Scenario,
    Stop,
    TripEnd,
    Units,
    VertexId,
    roadmap_of_edges,
    roadmap_of_grid,
    rounding_step,
    squared_distance,
    straight_length,
)
from rightofway.model.closures import Closure, closure_faults
from rightofway.model.layout import Layout, LevelRoadmap, roadmap_of_level
from rightofway.model.places import as_place, is_cell, vertex_at
from rightofway.model.resources import circle_around
from rightofway.model.spacing import SplitLanes, split_lanes
from rightofway.model.values import Number, coordinate, names, number
from rightofway.model.values import length as exact_length
from rightofway.model.zones import NamedZone

__all__ = ["FleetBuilder"]


class FleetBuilder:
    """Builds a scenario step by step: a map, robots by the names of places, rules.

    The map is a grid, a map file, a `networkx` graph, a layout, or, where none of these is given,
    the vertices and edges that are added. Methods return the builder, so that calls can be chained.

    Parameters
    ----------
    grid
        The rows of a grid; ``.`` is free, ``@`` is blocked.
    map_file
        The path of a MovingAI ``.map`` file.
    graph
        A `networkx` graph, directed or not; see Notes.
    layout
        A layout of lanes, or its file, as `read_layout` takes it. Lengths are metres and times
        seconds, unless ``units`` says otherwise; places are names of vertices or stations.
    level, vehicle_type
        Which level of a layout, and whose lanes, where it has several.
    cell_size
        Side of a cell of a grid or a map file [length unit].
    y
        Which way y grows: ``down`` or ``up``.
    origin
        (x, y) of the lower left corner of a grid or a map file on the site [length unit]; (0, 0) is
        the corner that has the least x and y by default.
    units
        What lengths and times are measured in, for reports: ``{"length": "m", "time": "s"}``.
    spacing
        Edges that are longer are split into pieces of at most that length [length unit].
    rules
        Rules of the fleet by name, as `Rules` takes them: ``occupancy``, ``headway``, ``turn``,
        ``ends``, ``laps``, ``rotations``, ``clearance``, ``turn_rate``.

    Raises
    ------
    InputError
        For a map that cannot be read, more than one map, or a rule or unit that is not known.

    Notes
    -----
    Numbers are exact: an int, a ``Fraction``, a ``Decimal``, text like ``"1/3"``; a float counts as
    the decimal that it prints as, so 0.1 is one tenth.

    The nodes of a graph are named by their text, ``str(node)``, and a robot's place may be the node
    itself. A node's position is its ``pos`` attribute, or ``x`` and ``y``, or the node, if it is a
    pair of numbers. An edge's length is its ``length``, else its ``weight``, else the straight
    distance between the positions of its ends, rounded up to 1/1000, else 1. Its ``max_speed`` is a
    speed limit.

    Examples
    --------
    >>> fleet = FleetBuilder(grid=["...", "@.@", "..."])
    >>> _ = fleet.add_robot("R1", home="N0", target="N6").add_robot("R2", home=(0, 2), target="N8")
    >>> fleet.scenario()
    Scenario(2 robots on Roadmap(7 vertices, 12 edges, grid of 3 x 3 cells), tick 1)
    """

    def __init__(
        self,
        *,
        grid: Sequence[str] | None = None,
        map_file: Path | str | None = None,
        graph: Any = None,
        layout: Layout | Path | str | None = None,
        level: str | None = None,
        vehicle_type: str | None = None,
        cell_size: Number = 1,
        y: Literal["down", "up"] = "down",
        origin: tuple[Number, Number] | None = None,
        units: Units | Mapping[str, Any] | None = None,
        spacing: Number | None = None,
        **rules: Any,
    ) -> None:
        given = {"grid": grid, "map_file": map_file, "graph": graph, "layout": layout}
        maps = [name for name, value in given.items() if value is not None]
        if len(maps) > 1:
            raise InputError.at("", f"{' and '.join(maps)} are given (give one map)")
        if y not in {"down", "up"}:
            raise InputError.at("y", f"{shown(y)} is unknown (give down or up)")
        if origin is not None and not (grid or map_file):
            raise InputError.at("origin", "is for a grid or a map file (take it out)")
        if spacing is not None and (grid or map_file):
            raise InputError.at("spacing", "is for vertices and edges (take it out)")
        if layout is None and (level or vehicle_type):
            raise InputError.at(
                "level" if level else "vehicle_type", "is for a layout (take it out)"
            )
        self._spacing = None if spacing is None else exact_length(spacing, "spacing")
        self._positions: dict[str, Point] = {}
        self._edges: list[tuple[str, str, Fraction | None, dict[str, Any]]] = []
        self._barred: dict[str, frozenset[str]] = {}
        self._surcharges: dict[str, Fraction] = {}
        self._closures: list[Closure] = []
        self._zones: list[NamedZone] = []
        self._robots: list[Robot] = []
        self._roadmap: Roadmap | None = None
        self._lanes: Callable[..., LevelRoadmap] | None = None
        self._stations: dict[str, VertexId] = {}
        self._is_drawn = True
        self._rules = _rules(rules)
        self._units = _units(units)
        self._y_up = y == "up"
        corner = None if origin is None else _point("origin", *_pair("origin", origin))
        frame: dict[str, Any] = {"cell_size": cell_size, "y_up": self._y_up, "origin": corner}
        if grid is not None:
            rows = grid.strip("\n").split("\n") if isinstance(grid, str) else grid
            self._roadmap = _within("grid", roadmap_of_grid, rows, **frame)
        elif map_file is not None:
            from rightofway.io import load_map

            self._roadmap = roadmap_of_grid(load_map(Path(map_file)), **frame)
        elif graph is not None:
            self._add_graph(graph)
        elif layout is not None:
            self._take_layout(layout, level, vehicle_type)

    def add_vertex(
        self,
        name: str,
        x: Number,
        y: Number,
        *,
        barred: Iterable[str] = (),
        surcharge: Number = 0,
    ) -> Self:
        """Add a vertex to the roadmap.

        Parameters
        ----------
        name
            A name of its own.
        x, y
            Where it lies on the site [length unit].
        barred
            Types of robots that may not be there.
        surcharge
            What makes each edge into it less liked, not slower [time unit].

        Raises
        ------
        InputError
            For a name that is none or taken, a position that is no number, or where the map is a
            grid or robots were added already.
        """
        place = f"vertex {shown(name)}"
        self._refuse_fixed_map(place)
        if not isinstance(name, str) or not name:
            raise InputError.at(place, "is no name (give text)")
        if name in self._positions:
            raise InputError.at(place, "is there already (give each vertex a name of its own)")
        self._positions[name] = _point(place, x, y)
        self._barred[name] = _types(f"{place}: barred", barred)
        self._surcharges[name] = _surcharge(f"{place}: surcharge", surcharge)
        return self

    def add_edge(
        self,
        tail: str,
        head: str,
        length: Number | None = None,
        *,
        both_ways: bool = True,
        max_speed: Number | None = None,
        barred: Iterable[str] = (),
        surcharge: Number = 0,
    ) -> Self:
        """Add an edge between two vertices.

        Parameters
        ----------
        tail, head
            Names of the vertices that it leaves and enters.
        length
            Its length [length unit]; by default the straight distance of the two vertices. Where
            that is no fraction, it is rounded up to 1/1000, on a map with distances below 1 to
            1/1000000.
        both_ways
            Whether it is driven from head to tail, too.
        max_speed
            Its speed limit [length unit per time unit]; none by default.
        barred
            Types of robots that may not use it.
        surcharge
            What makes it less liked, not slower [time unit].

        Raises
        ------
        InputError
            For a vertex that is not there, a length that is not positive, or no length where both
            vertices are at one position.
        """
        place = f"edge {shown(tail)} to {shown(head)}"
        self._refuse_fixed_map(place)
        for name in (tail, head):
            if name not in self._positions:
                near = nearest(name, self._positions)
                hint = f"did you mean {near!r}?" if near else "add it first"
                raise InputError.at(place, f"no vertex is named {shown(name)} ({hint})")
        given = None if length is None else exact_length(length, f"{place}: length")
        if given is None:
            _within(place, straight_length, self._square(tail, head))
        limit = None if max_speed is None else exact_length(max_speed, f"{place}: max_speed")
        more = {
            "max_speed": limit,
            "barred": _types(f"{place}: barred", barred),
            "surcharge": _surcharge(f"{place}: surcharge", surcharge),
        }
        self._edges.append((tail, head, given, more))
        if both_ways:
            self._edges.append((head, tail, given, more))
        return self

    def add_zone(
        self,
        name: str,
        *,
        vertices: Iterable[str] = (),
        edges: Iterable[tuple[str, str]] = (),
    ) -> Self:
        """Add a zone: vertices and edges that hold one robot at a time.

        Parameters
        ----------
        name
            A name of its own.
        vertices
            Names of vertices.
        edges
            Names of tail and head of each edge, one direction each.

        Raises
        ------
        InputError
            Where the map is a grid or robots were added already.
        """
        self._refuse_fixed_map(f"zone {shown(name)}")
        pairs = tuple((tail, head) for tail, head in edges)
        self._zones.append(NamedZone(name=name, vertices=tuple(vertices), edges=pairs))
        return self

    def add_robot(
        self,
        name: str,
        *,
        home: Any = None,
        target: Any = None,
        work: Number = 0,
        stops: Iterable[Any] | None = None,
        speed: Number = 1,
        turn: Number | None = None,
        ends: TripEnd | None = None,
        laps: int | None = None,
        radius: Number | None = None,
        size: tuple[Number, Number] | None = None,
        type: str | None = None,  # noqa: A002 (the key of scenario files)
        turn_rate: Number | None = None,
    ) -> Self:
        """Add a robot; the map must be complete.

        Parameters
        ----------
        name
            A name of its own.
        home
            The place that it starts from: ``"N8"`` or (row, column) on a grid, the name of a
            vertex, or ``{"x": 1.2, "y": 0.8}``, a point of the site [length unit]. Without one it
            gets a parking or charging place of the layout, near to its first stop.
        target, work
            The place to work at, and how long [time unit]; short for one stop.
        stops
            Places to work at, in order, instead of ``target``: a place, or (place, work time).
        speed
            Length units per time unit.
        turn, ends, laps
            As for `Robot`, if they differ from the rules.
        radius
            Radius of the circle that it needs [length unit]; a point by default.
        size
            Its length and width [length unit] instead of ``radius``: the circle around it.
        type
            The name of its type, for edges and vertices that are barred for types.
        turn_rate
            How fast it turns on the spot [degrees per time unit], if that differs from the rules.

        Raises
        ------
        InputError
            For a place that is not on the map, with what is there, and for a value of a wrong kind.
        """
        source = f"robot {shown(name)}"
        if radius is not None and size is not None:
            raise InputError.at("", "has both radius and size (give one of them)", source)
        if (target is None) == (stops is None):
            what = "has nowhere to go" if target is None else "has both target and stops"
            raise InputError.at("", f"{what} (give either target or stops)", source)
        if stops is None:
            trip = [("target", target, work)]
        else:
            trip = [(f"stops[{k}]", *_place_and_work(stop)) for k, stop in enumerate(stops)]
        from rightofway.io.scenario.homes import HOMELESS

        try:
            robot = Robot(
                name=name,
                home=HOMELESS if home is None else self._vertex("home", home),
                stops=tuple(
                    Stop(at=self._vertex(place, at), work=time)  # type: ignore[arg-type]
                    for place, at, time in trip
                ),
                speed=speed,  # type: ignore[arg-type]
                turn=turn,  # type: ignore[arg-type]
                ends=ends,
                laps=laps,
                radius=_radius(radius, size),
                type=type,
                turn_rate=turn_rate,  # type: ignore[arg-type]
            )
        except InputError as error:
            raise InputError(error.faults, source) from None
        self._robots.append(robot)
        return self

    def add_closure(
        self,
        *,
        at: Any = None,
        edge: tuple[Any, Any] | None = None,
        from_: Number = 0,
        until: Number | None = None,
        radius: Number | None = None,
    ) -> Self:
        """Close a place, or an edge in both directions, for a while; the map must be complete.

        Parameters
        ----------
        at
            The place that is closed, as for `add_robot`.
        edge
            The places at both ends of the edge that is closed, instead of ``at``.
        from_
            When the closure begins [time unit].
        until
            When it ends [time unit]; never by default.
        radius
            What is nearer than this, a robot's radius and the clearance is closed for that robot,
            too [length unit]; nothing more by default.

        Raises
        ------
        InputError
            For a place that is not on the map, no edge between two places, and a value of a wrong
            kind.
        """
        source = f"closure {len(self._closures)}"
        try:
            closure = Closure(
                at=None if at is None else self._vertex("at", at),
                edge=None
                if edge is None
                else (self._vertex("edge", edge[0]), self._vertex("edge", edge[1])),
                from_=from_,  # type: ignore[arg-type]
                until=until,  # type: ignore[arg-type]
                radius=radius,  # type: ignore[arg-type]
            )
        except InputError as error:
            raise InputError(error.faults, source) from None
        if faults := list(closure_faults(closure, self.roadmap())):
            raise InputError(faults, source)
        self._closures.append(closure)
        return self

    def scenario(self) -> Scenario:
        """Return the scenario.

        Raises
        ------
        InputError
            With every fault, as `Scenario`; where there is no map; or for a turn rate on a graph
            without positions.
        """
        from rightofway.io.scenario.homes import housed

        rates = [self._rules.turn_rate, *(robot.turn_rate for robot in self._robots)]
        if not self._is_drawn and any(rates):
            remedy = "give each node a pos, or x and y; or leave it out"
            raise InputError.at("turn_rate", f"needs positions, and the graph has none ({remedy})")
        roadmap, rules = self.roadmap(), self._rules
        if self._lanes and any(robot.radius for robot in self._robots):
            cut = self._lanes(cuts_curves=True)
            roadmap = cut.roadmap
            rules = replace(rules, clearance=rules.clearance + 2 * cut.chord_error)
        robots, _ = housed(self._robots, roadmap, rules)
        return Scenario(
            roadmap=roadmap,
            robots=tuple(robots),
            rules=rules,
            units=self._units,
            closures=tuple(self._closures),
        )

    def roadmap(self) -> Roadmap:
        """Return the map; vertices and edges can no longer be added.

        Raises
        ------
        InputError
            Where there is none, or an edge is given twice.
        """
        if self._roadmap is None:
            if not self._positions:
                remedy = "give grid, map_file, graph or layout, or add vertices and edges"
                raise InputError.at("", f"the fleet has no map ({remedy})")
            squares = [
                self._square(tail, head) for tail, head, given, _ in self._edges if given is None
            ]
            step = rounding_step(squares)
            edges = [
                Edge(
                    tail=tail,
                    head=head,
                    length=given or straight_length(self._square(tail, head), step),
                    **more,
                )
                for tail, head, given, more in self._edges
            ]
            split = SplitLanes(self._positions, edges, {})
            if self._spacing is not None:
                split = split_lanes(self._positions, edges, self._spacing)
            drawn = {name: (float(x), float(y)) for name, (x, y) in split.positions.items()}
            self._roadmap = roadmap_of_edges(
                drawn,
                split.edges,
                y_up=self._y_up,
                zones=self._zones,
                pieces=split.pieces,
                barred={name: types for name, types in self._barred.items() if types},
                surcharges={name: more for name, more in self._surcharges.items() if more},
            )
        return self._roadmap

    def _square(self, tail: str, head: str) -> Fraction:
        return squared_distance(self._positions[tail], self._positions[head])

    def _vertex(self, key: str, place: Any) -> VertexId:
        """Return the vertex of a place as users write it."""
        roadmap = self.roadmap()
        if not isinstance(place, str) and str(place) in (roadmap.labels or ()):
            place = str(place)
        if (
            isinstance(place, str)
            and place in self._stations
            and place not in (roadmap.labels or ())
        ):
            return self._stations[place]
        found = _within(key, as_place, place, roadmap)
        vertex: VertexId = _within(key, vertex_at, roadmap, found, units=self._units)
        return vertex

    def _refuse_fixed_map(self, place: str) -> None:
        if self._roadmap is not None:
            remedy = "add vertices and edges first, and to no grid"
            raise InputError.at(place, f"the map is complete already ({remedy})")

    def _take_layout(
        self, layout: Layout | Path | str, level: str | None, vehicle_type: str | None
    ) -> None:
        """Make the roadmap of a layout; that of robots with a size has cut curves besides."""
        if not isinstance(layout, Layout):
            from rightofway.io import read_layout

            found = read_layout(layout)
            if not isinstance(found, Layout):
                remedy = "write a scenario with map: {layout: …} and load it"
                raise InputError.at("layout", f"is a map in pixels or cells ({remedy})")
            layout = found
        self._units = Units(length=self._units.length or "m", time=self._units.time or "s")
        metres, seconds = self._units.metres, self._units.seconds
        assert metres, "a unit of length has a length"
        assert seconds, "a unit of time has a length"
        self._lanes = partial(
            roadmap_of_level,
            layout.level(level),
            vehicle_type=vehicle_type,
            metre=1 / metres,
            second=1 / seconds,
            spacing=self._spacing,
        )
        self._roadmap = self._lanes().roadmap
        self._stations = dict(self._roadmap.drawing.stations)

    def _add_graph(self, graph: Any) -> None:
        """Add the nodes and edges of a networkx graph."""
        if not all(hasattr(graph, name) for name in ("nodes", "edges", "is_directed")):
            raise InputError.at("graph", f"{shown(graph)} is no graph (give a networkx graph)")
        nodes = dict(graph.nodes(data=True))
        at = {node: _position(node, data) for node, data in nodes.items()}
        self._is_drawn = is_drawn = all(at.values())
        for index, (node, position) in enumerate(at.items()):
            self.add_vertex(str(node), *(position if position and is_drawn else (index, 0)))
        for tail, head, data in graph.edges(data=True):
            length = data.get("length", data.get("weight", None if is_drawn else 1))
            self.add_edge(
                str(tail),
                str(head),
                length,
                both_ways=not graph.is_directed(),
                max_speed=data.get("max_speed"),
            )
        self.roadmap()


def _types(place: str, given: Iterable[str]) -> frozenset[str]:
    """Return types of robots; a text alone is no list of them."""
    try:
        return names(given if isinstance(given, str) else list(given))
    except (TypeError, ValueError):
        message = f"{shown(given)} are no types of robots (give a list of texts)"
        raise InputError.at(place, message) from None


def _surcharge(place: str, given: Number) -> Fraction:
    try:
        found = number(given)
    except ValueError as error:
        raise InputError.at(place, str(error)) from None
    if found < 0:
        raise InputError.at(place, f"{shown(given)} is negative (give 0 or more)")
    return found


def _rules(given: dict[str, Any]) -> Rules:
    known = [field.name for field in fields(Rules)]
    for name in given:
        if name not in known:
            raise InputError.at(name, f"is unknown to FleetBuilder (rules are {', '.join(known)})")
    return Rules(**given)


def _units(given: Units | Mapping[str, Any] | None) -> Units:
    if given is None or isinstance(given, Units):
        return given or Units()
    if not (isinstance(given, Mapping) and given.keys() <= {"length", "time"}):
        remedy = 'give {"length": "m", "time": "s"}'
        raise InputError.at("units", f"{shown(given)} are no units ({remedy})")
    return Units(**given)


def _pair(place: str, given: Any) -> tuple[Any, Any]:
    if not isinstance(given, list | tuple) or len(given) != 2:  # noqa: PLR2004 (x and y)
        raise InputError.at(place, f"{shown(given)} is no point (give (x, y))")
    return given[0], given[1]


def _point(place: str, x: Number, y: Number) -> Point:
    try:
        return coordinate(x), coordinate(y)
    except ValueError as error:
        raise InputError.at(place, str(error)) from None


def _radius(radius: Number | None, size: tuple[Number, Number] | None) -> Fraction:
    """Return the radius of a robot, or of the circle around its sides."""
    if size is None:
        return Fraction(0) if radius is None else radius  # type: ignore[return-value]
    length, width = (exact_length(side, f"size[{k}]") for k, side in enumerate(size))
    return circle_around(length, width)


def _place_and_work(stop: Any) -> tuple[Any, Number]:
    """Return the place of a stop and the work there: of (place, work), or of a place alone.

    A pair of whole numbers is (row, column).
    """
    is_pair = isinstance(stop, list | tuple) and len(stop) == 2  # noqa: PLR2004 (place and work)
    return (stop[0], stop[1]) if is_pair and not is_cell(stop) else (stop, 0)


def _position(node: Any, data: dict[str, Any]) -> tuple[Any, Any] | None:
    """Return where a node of a graph lies, if it says so."""
    found = data.get("pos", (data["x"], data["y"]) if {"x", "y"} <= data.keys() else node)
    if isinstance(found, str) or not hasattr(found, "__len__") or len(found) != 2:  # noqa: PLR2004 (x and y)
        return None
    return found[0], found[1]


def _within(place: str, make: Any, *arguments: Any, **named: Any) -> Any:
    """Call a function; its faults are faults of the place."""
    try:
        return make(*arguments, **named)
    except InputError as error:
        raise InputError(fault.within(place) for fault in error.faults) from None
