"""A fleet built in Python: the map, the robots and the rules, without a file."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import fields
from fractions import Fraction
from pathlib import Path
from typing import Any, Self

from rightofway.errors import InputError, nearest, shown
from rightofway.model import (
    Edge,
    Roadmap,
    Robot,
    Rules,
    Scenario,
    Stop,
    TripEnd,
    VertexId,
    roadmap_of_edges,
    roadmap_of_grid,
    straight_length,
)
from rightofway.model.places import Place, as_place, vertex_at
from rightofway.model.values import COORDINATE_DIGITS, Number, exact
from rightofway.model.values import length as exact_length

__all__ = ["FleetBuilder"]


class FleetBuilder:
    """Builds a scenario step by step: a map, robots by the names of places, rules.

    The map is a grid, a map file, a `networkx` graph, or, where none of these is given, the
    vertices and edges that are added. Methods return the builder, so that calls can be chained.

    Parameters
    ----------
    grid
        The rows of a grid; ``.`` is free, ``@`` is blocked.
    map_file
        The path of a MovingAI ``.map`` file.
    graph
        A `networkx` graph, directed or not; see Notes.
    cell_size
        Side of a cell of a grid or a map file [length unit].
    rules
        Rules of the fleet by name, as `Rules` takes them: ``occupancy``, ``headway``, ``turn``,
        ``ends``, ``laps``, ``rotations``.

    Raises
    ------
    InputError
        For a map that cannot be read, more than one map, or a rule that is not known.

    Notes
    -----
    Numbers are exact: an int, a ``Fraction``, a ``Decimal``, text like ``"1/3"``; a float counts as
    the decimal that it prints as, so 0.1 is one tenth.

    The nodes of a graph are named by their text, ``str(node)``, and a robot's place may be the node
    itself. A node's position is its ``pos`` attribute, or ``x`` and ``y``, or the node, if it is a
    pair of numbers. An edge's length is its ``length``, else its ``weight``, else the straight
    distance between the positions of its ends, else 1.

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
        cell_size: Number = 1,
        **rules: Any,
    ) -> None:
        given = {"grid": grid, "map_file": map_file, "graph": graph}
        maps = [name for name, value in given.items() if value is not None]
        if len(maps) > 1:
            raise InputError.at("", f"{' and '.join(maps)} are given (give one map)")
        self._positions: dict[str, tuple[Fraction, Fraction]] = {}
        self._edges: list[Edge] = []
        self._robots: list[Robot] = []
        self._roadmap: Roadmap | None = None
        self._rules = _rules(rules)
        if grid is not None:
            rows = grid.strip("\n").split("\n") if isinstance(grid, str) else grid
            self._roadmap = _within("grid", roadmap_of_grid, rows, cell_size=cell_size)
        elif map_file is not None:
            from rightofway.io import load_map

            self._roadmap = roadmap_of_grid(load_map(Path(map_file)), cell_size=cell_size)
        elif graph is not None:
            self._add_graph(graph)

    def add_vertex(self, name: str, x: Number, y: Number) -> Self:
        """Add a vertex to the roadmap.

        Parameters
        ----------
        name
            A name of its own.
        x, y
            Where it lies, x to the right and y down [length unit].

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
        try:
            at = tuple(exact(value, digits=COORDINATE_DIGITS) for value in (x, y))
        except ValueError as error:
            raise InputError.at(place, str(error)) from None
        self._positions[name] = (at[0], at[1])
        return self

    def add_edge(
        self, tail: str, head: str, length: Number | None = None, *, both_ways: bool = True
    ) -> Self:
        """Add an edge between two vertices.

        Parameters
        ----------
        tail, head
            Names of the vertices that it leaves and enters.
        length
            Its length [length unit]; the straight distance of the two vertices where that is a
            fraction.
        both_ways
            Whether it is driven from head to tail, too.

        Raises
        ------
        InputError
            For a vertex that is not there, a length that is not positive, or no length where the
            straight distance is no fraction.
        """
        place = f"edge {shown(tail)} to {shown(head)}"
        self._refuse_fixed_map(place)
        for name in (tail, head):
            if name not in self._positions:
                near = nearest(name, self._positions)
                hint = f"did you mean {near!r}?" if near else "add it first"
                raise InputError.at(place, f"no vertex is named {shown(name)} ({hint})")
        ends = (self._positions[tail], self._positions[head])
        if length is None:
            exactly = _within(place, straight_length, *ends)
        else:
            exactly = exact_length(length, f"{place}: length")
        self._edges.append(Edge(tail=tail, head=head, length=exactly))
        if both_ways:
            self._edges.append(Edge(tail=head, head=tail, length=exactly))
        return self

    def add_robot(
        self,
        name: str,
        *,
        home: Any,
        target: Any = None,
        work: Number = 0,
        stops: Iterable[Any] | None = None,
        speed: Number = 1,
        turn: Number | None = None,
        ends: TripEnd | None = None,
        laps: int | None = None,
    ) -> Self:
        """Add a robot; the map must be complete.

        Parameters
        ----------
        name
            A name of its own.
        home
            The place that it starts from: ``"N8"`` or (row, column) on a grid, else the name of a
            vertex.
        target, work
            The place to work at, and how long [time unit]; short for one stop.
        stops
            Places to work at, in order, instead of ``target``: a place, or (place, work time).
        speed
            Length units per time unit.
        turn, ends, laps
            As for `Robot`, if they differ from the rules.

        Raises
        ------
        InputError
            For a place that is not on the map, with what is there, and for a value of a wrong kind.
        """
        source = f"robot {shown(name)}"
        if (target is None) == (stops is None):
            what = "has nowhere to go" if target is None else "has both target and stops"
            raise InputError.at("", f"{what} (give either target or stops)", source)
        if stops is None:
            trip = [("target", target, work)]
        else:
            trip = [(f"stops[{k}]", *_place_and_work(stop)) for k, stop in enumerate(stops)]
        try:
            robot = Robot(
                name=name,
                home=self._vertex("home", home),
                stops=tuple(
                    Stop(at=self._vertex(place, at), work=time)  # type: ignore[arg-type]
                    for place, at, time in trip
                ),
                speed=speed,  # type: ignore[arg-type]
                turn=turn,  # type: ignore[arg-type]
                ends=ends,
                laps=laps,
            )
        except InputError as error:
            raise InputError(error.faults, source) from None
        self._robots.append(robot)
        return self

    def scenario(self) -> Scenario:
        """Return the scenario.

        Raises
        ------
        InputError
            With every fault, as `Scenario`; or where there is no map.
        """
        return Scenario(roadmap=self.roadmap(), robots=tuple(self._robots), rules=self._rules)

    def roadmap(self) -> Roadmap:
        """Return the map; vertices and edges can no longer be added.

        Raises
        ------
        InputError
            Where there is none, or an edge is given twice.
        """
        if self._roadmap is None:
            if not self._positions:
                remedy = "give grid, map_file or graph, or add vertices and edges"
                raise InputError.at("", f"the fleet has no map ({remedy})")
            positions = {name: (float(x), float(y)) for name, (x, y) in self._positions.items()}
            self._roadmap = roadmap_of_edges(positions, self._edges)
        return self._roadmap

    def _vertex(self, key: str, place: Any) -> VertexId:
        """Return the vertex of a place as users write it."""
        roadmap = self.roadmap()
        if roadmap.grid is None and not isinstance(place, str) and str(place) in self._positions:
            place = str(place)
        found: Place | None = as_place(place)
        if found is None:
            kinds = "N<k> or (row, column)" if roadmap.grid else "the name of a vertex"
            raise InputError.at(key, f"{shown(place)} is no place (give {kinds})")
        vertex: VertexId = _within(key, vertex_at, roadmap, found)
        return vertex

    def _refuse_fixed_map(self, place: str) -> None:
        if self._roadmap is not None:
            remedy = "add vertices and edges first, and to no grid"
            raise InputError.at(place, f"the map is complete already ({remedy})")

    def _add_graph(self, graph: Any) -> None:
        """Add the nodes and edges of a networkx graph."""
        if not all(hasattr(graph, name) for name in ("nodes", "edges", "is_directed")):
            raise InputError.at("graph", f"{shown(graph)} is no graph (give a networkx graph)")
        nodes = dict(graph.nodes(data=True))
        at = {node: _position(node, data) for node, data in nodes.items()}
        is_drawn = all(at.values())
        for index, (node, position) in enumerate(at.items()):
            self.add_vertex(str(node), *(position if position and is_drawn else (index, 0)))
        for tail, head, data in graph.edges(data=True):
            length = data.get("length", data.get("weight", None if is_drawn else 1))
            self.add_edge(str(tail), str(head), length, both_ways=not graph.is_directed())
        self.roadmap()


def _rules(given: dict[str, Any]) -> Rules:
    known = [field.name for field in fields(Rules)]
    for name in given:
        if name not in known:
            raise InputError.at(name, f"is unknown to FleetBuilder (rules are {', '.join(known)})")
    return Rules(**given)


def _place_and_work(stop: Any) -> tuple[Any, Number]:
    """Return the place of a stop and the work there: of (place, work), or of a place alone.

    A pair of whole numbers is (row, column).
    """
    is_pair = isinstance(stop, list | tuple) and len(stop) == 2  # noqa: PLR2004 (place and work)
    return (stop[0], stop[1]) if is_pair and as_place(stop) is None else (stop, 0)


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
