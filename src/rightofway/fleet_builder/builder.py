"""The builder of a fleet: each call adds a part, and reports its faults at once."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from datetime import datetime
from fractions import Fraction
from functools import partial
from pathlib import Path
from typing import Any, Literal, Self

from rightofway.assign import HOMELESS, deal_homes
from rightofway.errors import InputError, Where, locate_faults, name_file, quote
from rightofway.files import as_path
from rightofway.fleet_builder.lanes import DrawnLanes, read_graph
from rightofway.fleet_builder.values import (
    read_radius,
    read_rules,
    read_units,
    split_stop,
)
from rightofway.fleet_builder.work import read_job_stops, read_state
from rightofway.kinds.numbers import Number
from rightofway.kinds.table import (
    ANYTHING,
    POSITION,
    POSITIVE,
    TEXT,
    TRUTH,
    allow_none,
    list_of,
    make_words,
    tuple_of,
)
from rightofway.model import (
    Battery,
    Job,
    PlaceActions,
    Robot,
    RobotState,
    Scenario,
    Stop,
    StopAction,
    TripEnd,
)
from rightofway.model.actions import merge_actions, read_drawn_actions
from rightofway.model.closures import Closure, find_closure_faults
from rightofway.site import Roadmap, VertexId, make_grid_roadmap
from rightofway.site.layout import Layout, LevelRoadmap, build_roadmap_of_level
from rightofway.site.places import as_place, find_vertex_at
from rightofway.site.zones import NamedZone
from rightofway.units import Units, is_clock_time

Actions = str | StopAction | Mapping[str, Any] | Iterable[str | StopAction | Mapping[str, Any]]
"""One or several actions, as users write them."""


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
        The level of a layout, and the vehicle type of its lanes, if it has several.
    cell_size
        Side of a cell of a grid or a map file [length unit].
    y
        Which way y grows: ``down`` or ``up``.
    origin
        (x, y) of the lower left corner of a grid or a map file on the site [length unit]; (0, 0) is
        the corner that has the least x and y by default.
    units
        The units of lengths and times, for reports: ``{"length": "m", "time": "s"}``.
    start
        The instant of time 0, like ``"2026-11-28T06:00"``: points in time may then be times of day,
        like ``"10:00"``. Times are seconds by default.
    spacing
        Edges that are longer are split into pieces of at most that length [length unit]. By
        default, ``"auto"``, edges are split that are longer than three times the least distance
        of two robots, where robots have a size; ``"whole"`` splits none.
    rules
        Rules of the fleet by name, as `Rules` takes them: ``occupancy``, ``headway``, ``turn``,
        ``ends`` (``return`` in files), ``laps``, ``rotations``, ``clearance``, ``turn_rate``; or
        ``rules="classic"`` for classic MAPF: no turning and no way back, unless given as well.

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
    >>> fleet.build_scenario()
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
        start: datetime | str | None = None,
        spacing: Number | Literal["auto", "whole"] | None = None,
        **rules: Any,
    ) -> None:
        given = {"grid": grid, "map_file": map_file, "graph": graph, "layout": layout}
        maps = [name for name, value in given.items() if value is not None]
        if len(maps) > 1:
            raise InputError.at("", f"{' and '.join(maps)} are given (give one map)")
        make_words("down", "up").read_at("y", y)
        allow_none(TEXT).read_at("level", level)
        allow_none(TEXT).read_at("vehicle_type", vehicle_type)
        if origin is not None and not (grid or map_file):
            raise InputError.at("origin", "is for a grid or a map file (take it out)")
        if spacing is not None and (grid or map_file):
            raise InputError.at("spacing", "is for vertices and edges (take it out)")
        if layout is None and (level or vehicle_type):
            raise InputError.at(
                "level" if level else "vehicle_type", "is for a layout (take it out)"
            )
        word = spacing if isinstance(spacing, str) else None
        self._chooses_spacing = spacing is None or word == "auto"
        is_length = not self._chooses_spacing and word != "whole"
        self._spacing = POSITIVE.read_at("spacing", spacing) if is_length else None
        self._drawn = DrawnLanes()
        self._closures: list[Closure] = []
        self._jobs: list[Job] = []
        self._batteries: list[tuple[str, Battery]] = []
        self._charging: list[VertexId] = []
        self._drawn_actions: tuple[PlaceActions, ...] = ()  # of a layout
        self._actions: list[PlaceActions] = []
        self._robots: list[Robot] = []
        self._roadmap: Roadmap | None = None
        self._level: Callable[..., LevelRoadmap] | None = None
        self._stations: dict[str, VertexId] = {}
        self._rules = read_rules(rules)
        self._units = read_units(units)
        if start is not None:
            self._units = replace(self._units, start=start)  # type: ignore[arg-type]
        self._y_up = y == "up"
        corner = allow_none(POSITION).read_at("origin", origin)
        frame: dict[str, Any] = {"cell_size": cell_size, "y_up": self._y_up, "origin": corner}
        if grid is not None:
            rows = grid.strip("\n").split("\n") if isinstance(grid, str) else grid
            with locate_faults("grid"):
                self._roadmap = make_grid_roadmap(rows, **frame)
        elif map_file is not None:
            from rightofway.io import load_map

            self._roadmap = make_grid_roadmap(load_map(as_path(map_file, "map_file")), **frame)
        elif graph is not None:
            self._drawn = read_graph(graph)
            self.build_roadmap()
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
        is_passed: bool = False,
        heading: Number | None = None,
        turning: bool = True,
    ) -> Self:
        """Add a vertex to the roadmap.

        Parameters
        ----------
        name
            A name of its own.
        x, y
            Its position on the site [length unit].
        barred
            Types of robots that may not be there.
        surcharge
            A cost that makes each edge into it less liked, not slower [time unit].
        is_passed
            Whether robots only drive through, without a stop.
        heading
            Heading of robots that work there: from x to y [degrees]; None for any.
        turning
            Whether robots may turn on the spot there.

        Raises
        ------
        InputError
            For a name that is none or taken, a position that is not a number, or where the map is a
            grid or robots were added already.
        """
        self._refuse_fixed_map(f"vertex {quote(name)}")
        self._drawn.add_vertex(
            name,
            x,
            y,
            barred=barred,
            surcharge=surcharge,
            is_passed=is_passed,
            heading=heading,
            turning=turning,
        )
        return self

    def add_edge(
        self,
        tail: str,
        head: str,
        length: Number | None = None,
        *,
        both_ways: bool = True,
        max_speed: Number | None = None,
        max_speed_by_type: Mapping[str, Number] | None = None,
        barred: Iterable[str] = (),
        surcharge: Number = 0,
        orientation: Number | None = None,
        edge_id: str | None = None,
        turning: bool | None = None,
    ) -> Self:
        """Add an edge between two vertices.

        Parameters
        ----------
        tail, head
            Names of the vertices that it leaves and enters.
        length
            Its length [length unit]; by default the straight distance of the two vertices. Where
            that is not a fraction, it is rounded up to 1/1000, on a map with distances below 1 to
            1/1000000.
        both_ways
            Whether it is driven from head to tail, too.
        max_speed
            Its speed limit [length unit per time unit]; none by default.
        max_speed_by_type
            Types of robots that have another speed limit, with this limit.
        barred
            Types of robots that may not use it.
        surcharge
            A cost that makes it less liked, not slower [time unit].
        orientation
            How robots are turned against the direction of driving, for orders, like 180 for
            backwards [degrees]; None for any. Both directions have the same.
        edge_id
            Its id in orders to robots; None for the names of its ends with a hyphen between.
        turning
            Whether robots may turn on the spot along it, and so may enter it from a vertex where
            they may not turn; None where that is unknown.

        Raises
        ------
        InputError
            For a vertex that is not there, a length that is not positive, no length where both
            vertices are at one position, or ``both_ways`` that is neither true nor false.
        """
        self._refuse_fixed_map(f"edge {quote(tail)} to {quote(head)}")
        TRUTH.read_at("both_ways", both_ways)
        self._drawn.add_edge(
            tail,
            head,
            length,
            both_ways=both_ways,
            max_speed=max_speed,
            max_speed_by_type={} if max_speed_by_type is None else max_speed_by_type,
            barred=barred,
            surcharge=surcharge,
            orientation=orientation,
            edge_id=edge_id,
            turning=turning,
        )
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
        self._refuse_fixed_map(f"zone {quote(name)}")
        place = f"zone {quote(name)}"
        with locate_faults(place):
            TEXT.read_at("name", name)
            named = list_of(TEXT).read_at("vertices", vertices)
            pairs = list_of(tuple_of(TEXT, "tail", "head")).read_at("edges", edges)
        self._drawn.zones.append(NamedZone(name=name, vertices=named, edges=pairs))
        return self

    def add_robot(
        self,
        name: str,
        *,
        home: Any = None,
        target: Any = None,
        work: Number = 0,
        actions: Actions = (),
        stops: Iterable[Any] | None = None,
        speed: Number = 1,
        turn: Number | None = None,
        ends: TripEnd | None = None,
        laps: int | None = None,
        radius: Number | None = None,
        size: tuple[Number, Number] | None = None,
        type: str | None = None,  # noqa: A002 (the key of scenario files)
        turn_rate: Number | None = None,
        weight: Number = 1,
        start: RobotState | Mapping[str, Any] | None = None,
        capacity: int | None = None,
        battery: str | None = None,
        charging: Iterable[Any] | None = None,
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
        target, work, actions
            The place to work at, the work time [time unit], and the actions of the robot there, see
            `add_actions`; short for one stop.
        stops
            Places to work at, in order, instead of ``target``: a place, (place, work time), or
            (place, work time, actions).
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
            Its speed of turning on the spot [degrees per time unit], if that differs from the
            rules.
        weight
            The weight of its completion time, compared with those of the other robots.
        start, capacity, battery, charging
            For a fleet with jobs, as for `Robot`; the robot then has neither ``target`` nor
            ``stops``. A start may be a mapping like ``{"at": "N7", "soc": 0.5}``; without ``at`` it
            is the home.

        Raises
        ------
        InputError
            For a place that is not on the map, with the obstacle there, and for a value of a wrong
            kind.
        """
        source = f"robot {quote(name)}"
        if radius is not None and size is not None:
            raise InputError.at("", "has both radius and size (give one of them)", source)
        if target is not None and stops is not None:
            message = "has both target and stops (give either target or stops)"
            raise InputError.at("", message, source)
        trip: list[tuple[Where, Any, Number, Any]] = [("target", target, work, actions)]
        if target is None and stops is None:
            trip = []  # in a fleet with jobs
        elif stops is not None:
            with name_file(source):
                given = list_of(ANYTHING).read_at("stops", stops)
            trip = [(("stops", k), *split_stop(stop)) for k, stop in enumerate(given)]
        try:
            at_home = HOMELESS if home is None else self._find_vertex("home", home)
            robot = Robot(
                name=name,
                home=at_home,
                stops=tuple(
                    Stop(at=self._find_vertex(place, at), work=time, actions=own)  # type: ignore[arg-type]
                    for place, at, time, own in trip
                ),
                speed=speed,  # type: ignore[arg-type]
                turn=turn,  # type: ignore[arg-type]
                ends=ends,
                laps=laps,
                radius=read_radius(radius, size),
                type=type,
                turn_rate=turn_rate,  # type: ignore[arg-type]
                weight=weight,  # type: ignore[arg-type]
                start=read_state(self._find_vertex, self._read_moment, start, at_home),
                capacity=capacity,
                battery=battery,
                charging=None if charging is None else self._find_vertices("charging", charging),
            )
        except InputError as error:
            raise InputError(fault.name_file(source) for fault in error.faults) from None
        self._robots.append(robot)
        return self

    def add_job(
        self,
        name: str,
        *,
        at: Any = None,
        work: Number = 0,
        pickup: Any = None,
        dropoff: Any = None,
        pickup_work: Number = 0,
        dropoff_work: Number = 0,
        load: int = 1,
        stops: Iterable[Mapping[str, Any]] | None = None,
        earliest: Number | None = None,
        latest: Number | None = None,
        due: Number | None = None,
        weight: Number = 1,
        types: Iterable[str] = (),
        robot: str | None = None,
        after: Iterable[str] = (),
        actions: Actions = (),
        pickup_actions: Actions = (),
        dropoff_actions: Actions = (),
        load_id: str | None = None,
        load_type: str | None = None,
    ) -> Self:
        """Add a job, so that robots have no trips of their own; the map must be complete.

        Parameters
        ----------
        name
            A name of its own.
        at, work
            The place to work at, as for `add_robot`, and the work time [time unit].
        pickup, dropoff, pickup_work, dropoff_work, load
            Instead of ``at``: two places, the work at each [time unit], and the load that is
            carried between them.
        stops
            Instead of both: mappings like ``{"at": "N3", "work": 2, "load": 1, "earliest": 5,
            "latest": 9, "actions": "beep"}``, in order.
        earliest, latest
            When the work of the first stop begins at the earliest, and that of the last one ends at
            the latest [time unit]; like ``due`` and those of stops, they may be times of day.
        due, weight, types, robot, after, load_id, load_type
            As for `Job`.
        actions, pickup_actions, dropoff_actions
            The actions of the robot at each place, see `add_actions`; by default those of the
            place.

        Raises
        ------
        InputError
            For a place that is not on the map, for not exactly one of the three forms, and for a
            value of a wrong kind.
        """
        given = {"at": at, "work": work, "pickup": pickup, "dropoff": dropoff, "stops": stops}
        given |= {"pickup_work": pickup_work, "dropoff_work": dropoff_work, "load": load}
        given |= {"actions": actions}
        given |= {"pickup_actions": pickup_actions, "dropoff_actions": dropoff_actions}
        with name_file(f"job {quote(name)}"):
            given |= {
                key: self._read_moment(key, value)
                for key, value in (("earliest", earliest), ("latest", latest))
            }
            job = Job(
                name=name,
                stops=read_job_stops(self._find_vertex, self._read_moment, given),
                due=self._read_moment("due", due),
                weight=weight,  # type: ignore[arg-type]
                types=types,  # type: ignore[arg-type]
                robot=robot,
                after=after,  # type: ignore[arg-type]
                load_id=load_id,
                load_type=load_type,
            )
        self._jobs.append(job)
        return self

    def add_actions(
        self, place: Any, *, work: Actions = (), pick: Actions = (), drop: Actions = ()
    ) -> Self:
        """Set the actions of robots at stops at a place; the map must be complete.

        Stops and jobs with actions of their own do not follow it. No plan depends on actions: the
        fleet control sends them to robots.

        Parameters
        ----------
        place
            The place, as for `add_robot`.
        work, pick, drop
            The actions at stops where the load stays as it is, grows and shrinks: one or several,
            each its type, a mapping like ``{"action": "pick", "parameters": {"side": "left"},
            "blocking": "soft"}``, or a `StopAction`. By default robots do their usual action.

        Raises
        ------
        InputError
            For a place that is not on the map, and for actions of a wrong kind.
        """
        with name_file(f"actions of {quote(place)}"):
            at = self._find_vertex("place", place)
            own = PlaceActions(at=at, work=work, pick=pick, drop=drop)  # type: ignore[arg-type]
        self._actions.append(own)
        return self

    def add_battery(
        self,
        name: str,
        *,
        drive: Number = 0,
        on: Number = 0,
        work: Number = 0,
        charge: Number = 0,
        reserve: Number = 0,
    ) -> Self:
        """Add a battery for robots of a fleet with jobs.

        Parameters
        ----------
        name
            The name by which robots have it.
        drive, on, work, charge, reserve
            As for `Battery`: shares of a full one.

        Raises
        ------
        InputError
            For a value of another kind, or out of range.
        """
        TEXT.read_at("name", name)
        with name_file(f"battery {quote(name)}"):
            battery = Battery(
                drive=drive,  # type: ignore[arg-type]
                on=on,  # type: ignore[arg-type]
                work=work,  # type: ignore[arg-type]
                charge=charge,  # type: ignore[arg-type]
                reserve=reserve,  # type: ignore[arg-type]
            )
        self._batteries.append((name, battery))
        return self

    def add_charging(self, places: Iterable[Any]) -> Self:
        """Add places to charge at to those of the map, for a fleet with jobs.

        Parameters
        ----------
        places
            A list of places, each as for `add_robot`.

        Raises
        ------
        InputError
            For a place that is not on the map.
        """
        self._charging += self._find_vertices("charging", places)
        return self

    def _find_vertices(self, key: str, places: Iterable[Any]) -> tuple[VertexId, ...]:
        listed = list_of(ANYTHING).read_at(key, places)
        return tuple(self._find_vertex((key, k), place) for k, place in enumerate(listed))

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
            When the closure begins [time unit], or a time of day.
        until
            When it ends [time unit], or a time of day; never by default.
        radius
            Everything nearer than this, a robot's radius and the clearance is closed for that
            robot, too [length unit]; nothing more by default.

        Raises
        ------
        InputError
            For a place that is not on the map, no edge between two places, and a value of a wrong
            kind.
        """
        source = f"closure {len(self._closures)}"
        try:
            ends = allow_none(tuple_of(ANYTHING, "tail", "head")).read_at("edge", edge)
            closure = Closure(
                at=None if at is None else self._find_vertex("at", at),
                edge=ends
                and (self._find_vertex("edge", ends[0]), self._find_vertex("edge", ends[1])),
                from_=self._read_moment("from_", from_),
                until=self._read_moment("until", until),
                radius=radius,  # type: ignore[arg-type]
            )
        except InputError as error:
            raise InputError(fault.name_file(source) for fault in error.faults) from None
        if faults := list(find_closure_faults(closure, self.build_roadmap())):
            raise InputError(faults, source)
        self._closures.append(closure)
        return self

    def build_scenario(self) -> Scenario:
        """Return the scenario.

        Raises
        ------
        InputError
            With every fault, as `Scenario`; where there is no map; or for a turn rate on a graph
            without positions.
        """
        rates = [self._rules.turn_rate, *(robot.turn_rate for robot in self._robots)]
        if not self._drawn.is_drawn and any(rates):
            remedy = "give each node a pos, or x and y; or leave it out"
            raise InputError.at("turn_rate", f"needs positions, and the graph has none ({remedy})")
        roadmap, rules = self.build_roadmap(), self._rules
        radius = max((robot.radius for robot in self._robots), default=Fraction(0))
        distance = 2 * radius + rules.clearance if radius > 0 and self._chooses_spacing else 0
        if self._level and radius > 0:
            cut = self._level(has_sizes=True, distance=Fraction(distance))
            roadmap = cut.roadmap
            rules = replace(rules, clearance=rules.clearance + 2 * cut.chord_error)
        elif self._drawn.positions and distance:
            roadmap = self._drawn.build_roadmap(
                spacing=self._spacing, y_up=self._y_up, distance=Fraction(distance)
            )
        robots, _ = deal_homes(self._robots, roadmap, rules)
        if not self._jobs:
            self._refuse_robots_without_trip()
        return Scenario(
            roadmap=roadmap,
            robots=tuple(robots),
            rules=rules,
            units=self._units,
            closures=tuple(self._closures),
            jobs=tuple(self._jobs) or None,
            batteries=tuple(self._batteries),
            charging=tuple(self._charging),
            actions=merge_actions(self._drawn_actions, self._actions),
        )

    def _refuse_robots_without_trip(self) -> None:
        for robot in self._robots:
            if not robot.stops:
                message = "has nowhere to go (give either target or stops)"
                raise InputError.at("", message, f"robot {quote(robot.name)}")

    def build_roadmap(self) -> Roadmap:
        """Return the map; vertices and edges can no longer be added.

        Raises
        ------
        InputError
            Where there is none, or an edge is given twice.
        """
        if self._roadmap is None:
            if not self._drawn.positions:
                remedy = "give grid, map_file, graph or layout, or add vertices and edges"
                raise InputError.at("", f"the fleet has no map ({remedy})")
            self._roadmap = self._drawn.build_roadmap(spacing=self._spacing, y_up=self._y_up)
        return self._roadmap

    def _find_vertex(self, key: Where, place: Any) -> VertexId:
        """Return the vertex of a place as users write it."""
        roadmap = self.build_roadmap()
        if not isinstance(place, str) and str(place) in (roadmap.labels or ()):
            place = str(place)
        if (
            isinstance(place, str)
            and place in self._stations
            and place not in (roadmap.labels or ())
        ):
            return self._stations[place]
        with locate_faults(key):
            return find_vertex_at(roadmap, as_place(place, roadmap), units=self._units)

    def _read_moment(self, key: Where, time: Any) -> Any:
        """Return a point in time; that of a time of day [time unit]."""
        if not is_clock_time(time):
            return time
        try:
            return self._units.read_clock_time(time)
        except ValueError as error:
            raise InputError.at(key, str(error)) from None

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

            source = read_layout(as_path(layout, "layout"))
            if not isinstance(source, Layout):
                remedy = "write a scenario with map: {layout: …} and load it"
                raise InputError.at("layout", f"is a map in pixels or cells ({remedy})")
            layout = source
        own = self._units
        self._units = replace(own, length=own.length or "m", time=own.time or "s")
        metres, seconds = self._units.metres, self._units.seconds
        assert metres, "a unit of length has a length"
        assert seconds, "a unit of time has a length"
        drawn = layout.get_level(level)
        self._level = partial(
            build_roadmap_of_level,
            drawn,
            vehicle_type=vehicle_type,
            metre=1 / metres,
            second=1 / seconds,
            spacing=self._spacing,
        )
        self._roadmap = self._level().roadmap
        self._drawn_actions = read_drawn_actions(drawn, self._roadmap)
        self._stations = dict(self._roadmap.drawing.stations)
