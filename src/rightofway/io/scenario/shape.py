"""The shape of a scenario document: its keys, and the values that each may hold."""

from __future__ import annotations

from fractions import Fraction
from typing import Annotated, Any, ClassVar, Literal, get_args

from rightofway.deadline import READING, check_work
from rightofway.errors import quote
from rightofway.io.fields import (
    Actions,
    Amount,
    Angle,
    CellSize,
    Count,
    Document,
    End,
    Lines,
    Moment,
    Name,
    NotNegative,
    Pairs,
    Place,
    Position,
    Positive,
    Rectangle,
    RobotSize,
    Share,
    Size,
    Spacing,
    Words,
    add_attributes,
    choose_exactly_one,
    make_field,
    make_optional,
)
from rightofway.io.scenario.work_shape import (
    ACTIONS,
    BatteryDocument,
    JobDocument,
    JobTableDocument,
    StateDocument,
)
from rightofway.kinds.table import POSITION, Schema, make_words
from rightofway.model import Robot, Rules, WorkObjective
from rightofway.model.resources import circumscribe
from rightofway.site.places import list_kinds_of_places
from rightofway.units import LengthUnit, TimeUnit

PLACES = list_kinds_of_places(None)
BARRED = "a list of types of robots that may not use it"
WORK = "work time there [time unit], 0 by default"

YAxis = Literal["down", "up"]
Objective = Annotated[str, make_words(*get_args(WorkObjective))]

MAX_CELLS_ALLOWED = 10_000_000
"""The limit on cells of a floor can be raised to this."""


class ObstacleDocument(Document):
    """A rectangle of a floor that robots cannot enter."""

    name: Words = make_field("the name, for messages and the map", default="")
    rect: Rectangle = make_field(
        "[x, y, width, height]; x and y are the least that it covers [length unit]"
    )


class FloorDocument(Document):
    """A floor by size, to be cut into cells."""

    size: Size = make_field("[width, height] [length unit]")
    obstacles: list[ObstacleDocument] = make_field("a list of rectangles", default=[])
    max_cells: Count = make_optional(
        f"the most cells to make, from 1 to {MAX_CELLS_ALLOWED}", le=MAX_CELLS_ALLOWED
    )


class EdgeDocument(Document):
    """A way between two vertices; ``[A, B]`` and ``[A, B, length]`` are short for one."""

    tail: Name = make_field(alias="from", description="the name of the vertex it begins at")
    head: Name = make_field(alias="to", description="the name of the vertex it leads to")
    length: Positive = make_optional(
        "its length [length unit]; by default the straight distance, or that along its curve,"
        " rounded up to 1/1000"
    )
    curve: list[Position] = make_optional(
        "control points of a Bézier curve from one end to the other: one or two [x, y]"
        " [length unit]; straight by default",
        min_length=1,
        max_length=2,
    )
    both_ways: bool = make_field("true or false: can it be driven back?", default=True)
    max_speed: Positive = make_optional(
        "its speed limit [length unit per time unit]; none by default"
    )
    max_speed_by_type: dict[Name, Positive] = make_field(
        "types of robots with a speed limit of their own, like {tugger: 0.5}"
        " [length unit per time unit]; max_speed is for all others",
        default={},
    )
    barred: list[Name] = make_field(default=[], description=BARRED)
    surcharge: NotNegative = make_optional(
        "the cost added to it, without making it slower [time unit]; 0 by default"
    )
    orientation: Angle = make_optional(
        "the orientation of robots relative to the direction of driving, for orders, like 180"
        " for backwards [degrees]; the same in both directions"
    )
    edge_id: Name = make_optional(
        "its id in orders to robots; by default that of its ends with a hyphen between", alias="id"
    )
    turning: bool | None = make_optional(
        "true or false: may robots turn on the spot along it? Then they may enter it from a vertex"
        " without turning; unknown by default"
    )

    @staticmethod
    def read_short(data: Any) -> Any:
        """Return the mapping of an edge that is written as a list."""
        check_work(READING)
        if not isinstance(data, list | tuple):
            return data
        if len(data) not in {2, 3}:
            raise ValueError(f"{quote(data)} does not fit (give [A, B] or [A, B, length])")
        return dict(zip(("from", "to", "length"), data, strict=False))

    @staticmethod
    def extend_schema(mapping: Schema) -> Schema:
        """Return the JSON Schema with the list that is short for a mapping."""
        ends = [mapping["properties"]["from"], mapping["properties"]["to"]]
        array = {
            "type": "array",
            "prefixItems": [*ends, mapping["properties"]["length"]],
            "minItems": 2,
            "maxItems": 3,
        }
        return {"anyOf": [array, dict(mapping)]}


class VertexDocument(Document):
    """A vertex with more than a position; ``[x, y]`` is short for one."""

    at: Position = make_field("[x, y] [length unit]")
    barred: list[Name] = make_field(default=[], description=BARRED)
    surcharge: NotNegative = make_optional(
        "the cost added to each edge into it, without making it slower [time unit]; 0 by default"
    )
    is_passed: bool = make_field(
        alias="pass",
        default=False,
        description="true or false: do robots only drive through, without a stop?",
    )
    heading: Angle = make_optional(
        "heading of robots that work there: from x to y [degrees]; any by default"
    )
    turning: bool = make_field("true or false: may robots turn on the spot there?", default=True)

    @staticmethod
    def read_short(data: Any) -> Any:
        """Return the mapping of a vertex that is written as a position."""
        check_work(READING)
        return data if isinstance(data, dict) else {"at": POSITION.read(data)}

    @staticmethod
    def extend_schema(mapping: Schema) -> Schema:
        """Return the JSON Schema with the position that is short for a mapping."""
        return {"anyOf": [mapping["properties"]["at"], dict(mapping)]}


class ZoneDocument(Document):
    """Vertices and edges that hold one robot at a time."""

    name: Name = make_field("a name of its own")
    vertices: list[Name] = make_field("names of vertices", default=[])
    edges: Pairs = make_field("a list of [A, B], one direction each", default=[])


class PictureDocument(Document):
    """A picture that the map is drawn over; no plan depends on it."""

    file: Name = make_field("a PNG, JPEG or PGM file, relative to the scenario's own")
    scale: Positive = make_optional(
        "length of a pixel [length unit]; by default as wide as the map"
    )
    origin: Position = make_optional(
        "[x, y] of its lower left corner on the site [length unit]; by default that of the map"
    )
    yaw: Angle = make_optional("angle by which it is turned about that corner, from x to y [rad]")
    opacity: Share = make_optional("the opacity, from 0 to 1; 0.6 by default")


class RoadmapDocument(Document):
    """Named vertices and the ways between them."""

    vertices: dict[Name, VertexDocument] = make_field(
        "for each vertex its name and [x, y], or {at: [x, y], …} [length unit]"
    )
    edges: list[EdgeDocument] = make_field(
        "a list of [A, B], [A, B, length] or {from, to, length, both_ways}"
    )
    zones: list[ZoneDocument] = make_field(
        "a list of {name, vertices, edges} that hold one robot each", default=[]
    )
    stations: dict[Name, Name] = make_field(
        "for each place to work at its name and its vertex", default={}
    )
    parking: list[Name] = make_field("names of vertices to park at", default=[])
    charging: list[Name] = make_field("names of vertices to charge at", default=[])
    sides: list[Positive] = make_optional(
        "side of the square cell round each vertex, in their order [length unit]"
    )

    def check(self) -> None:
        """Refuse sides of cells that are not one for each vertex."""
        if self.sides is not None and len(self.sides) != len(self.vertices):
            counts = f"{len(self.sides)} for {len(self.vertices)} vertices"
            raise ValueError(f"sides: {counts} (give one for each, or take them out)")


OF_ADAPTIVE = ("smallest", "largest")
"""Keys for adaptive cells only."""

OF_LAYOUTS = ("level", "vehicle_type", "unknown")
"""Keys for layouts only."""

BY_LAYOUTS = ("y", "origin", "yaw")
"""Keys that a layout has in its own file."""

MAPS = ("grid", "file", "floor", "roadmap", "layout")


class MapDocument(Document):
    """The map of the fleet: exactly one of grid, file, floor, roadmap, layout."""

    schema_extra: ClassVar = {
        "oneOf": [{"required": [kind]} for kind in MAPS],
        "dependentSchemas": {
            "cell_size": {"not": {"required": ["roadmap"]}},
            **{key: {"required": ["cell_size"]} for key in OF_ADAPTIVE},
            "spacing": {"anyOf": [{"required": ["roadmap"]}, {"required": ["layout"]}]},
            **{key: {"required": ["layout"]} for key in OF_LAYOUTS},
            "layout": {"not": {"anyOf": [{"required": [key]} for key in BY_LAYOUTS]}},
            "obstacles": {"anyOf": [{"required": ["grid"]}, {"required": ["file"]}]},
        },
    }

    grid: Lines = make_optional("rows of . (free) and @ (blocked), as a list or one text")
    file: Name = make_optional("a .map file, relative to the scenario's own")
    floor: FloorDocument = make_optional("{size, obstacles}")
    roadmap: RoadmapDocument = make_optional("{vertices, edges}")
    layout: Name = make_optional("a layout of another program, relative to the scenario's own file")
    level: Name = make_optional("the level of a layout; required if it has several")
    vehicle_type: Name = make_optional(
        "the vehicle type whose lanes of a layout are used; required if they differ"
    )
    unknown: Literal["blocked", "free"] = make_field(
        "blocked, or free: pixels of a picture that are not known", default="blocked"
    )
    cell_size: CellSize = make_optional(
        "side of a cell [length unit]: 1 by default, 0.5 m on a ROS map, on a floor clustered;"
        " adaptive: squares of a quadtree"
    )
    smallest: Positive = make_optional("side of the smallest adaptive cells [length unit]")
    largest: Positive = make_optional(
        "limit on the side of adaptive cells [length unit]; 4 smallest ones by default"
    )
    y: YAxis = make_field("down, or up: which way y grows", default="down")
    origin: Position = make_optional(
        "[x, y] of the map's lower left corner on the site [length unit]"
    )
    yaw: Angle = make_optional(
        "angle by which the map is turned about its origin, from x to y [rad]"
    )
    obstacles: list[ObstacleDocument] = make_field(
        "names of blocked cells of a grid or file: a list of rectangles", default=[]
    )
    spacing: Spacing = make_field(
        "edges of a roadmap that are split into pieces: those longer than a length "
        "[length unit]; auto: long ones, for robots with a size; whole: none",
        default="auto",
    )
    picture: PictureDocument = make_optional(
        "{file, scale, origin, opacity}: a picture below the map"
    )

    def check(self) -> None:
        """Refuse no map or several, and keys that do not belong to the map."""
        self._check_one_map()
        self._check_cells()

    def _check_one_map(self) -> None:
        kind = choose_exactly_one(self, MAPS)
        if kind == "roadmap" and self.cell_size is not None:
            raise ValueError("cell_size is given with a roadmap, which has no cells (take it out)")
        if kind == "roadmap" and self.roadmap.sides is None:
            if self.origin is not None:
                raise ValueError(
                    "origin is given with a roadmap, whose vertices have coordinates of the site"
                    " (take it out)"
                )
            if self.yaw is not None:
                raise ValueError("yaw is given with a roadmap, which needs none (take it out)")
        for key in BY_LAYOUTS if kind == "layout" else OF_LAYOUTS:
            if key in self.given:
                reason = "which has its own" if kind == "layout" else "and is for a layout"
                raise ValueError(f"{key} is given with a {kind}, {reason} (take it out)")
        if kind not in {"roadmap", "layout"} and "spacing" in self.given:
            raise ValueError(
                f"spacing is given with a {kind}, which has no long edges (take it out)"
            )
        if kind not in {"grid", "file"} and "obstacles" in self.given:
            remedy = "give them in the floor" if kind == "floor" else "take them out"
            raise ValueError(f"obstacles are given beside a {kind} ({remedy})")

    def _check_cells(self) -> None:
        kind, word = choose_exactly_one(self, MAPS), self.cell_size
        if (word == "clustered" and kind != "floor") or (
            word == "adaptive" and kind not in {"floor", "layout"}
        ):
            raise ValueError(f"a {kind} has cells already (give cell_size as a length)")
        for key in OF_ADAPTIVE:
            if key in self.given and word != "adaptive":
                raise ValueError(f"{key} is for cell_size: adaptive (give that, or take it out)")

    @property
    def y_up(self) -> bool:
        """Whether y grows upwards."""
        return self.y == "up"

    @property
    def longest_piece(self) -> Fraction | None:
        """The length that longer edges are split at [length unit]; None for none."""
        return self.spacing if isinstance(self.spacing, Fraction) else None

    def choose_distance(self, distance: Fraction) -> Fraction:
        """Return the least distance of robots for which long lanes are split; 0 for none."""
        return distance if self.spacing == "auto" else Fraction(0)


class StopDocument(Document):
    """A place to work at."""

    at: Place = make_field(f"a place: {PLACES}")
    work: NotNegative = make_optional(WORK)
    actions: Actions = make_optional(ACTIONS)


@add_attributes(Robot)
class RobotAttributes(Document):
    """Attributes of a robot other than its name and its trip."""


OF_TRIPS = ("target", "work", "actions", "stops")
"""Keys of a robot for its trip."""

OF_JOBS = ("start", "capacity", "battery", "charging")
"""Keys of a robot in a scenario with jobs."""


@add_attributes(Robot)
class RobotDocument(Document):
    """A robot and its trip: target and work, or stops; in a scenario with jobs without a trip."""

    schema_extra: ClassVar = {
        "oneOf": [
            {"required": ["target"]},
            {
                "required": ["stops"],
                "not": {"anyOf": [{"required": ["work"]}, {"required": ["actions"]}]},
            },
            {"not": {"anyOf": [{"required": [key]} for key in OF_TRIPS]}},
        ]
    }

    name: Name = make_field("a name of its own")
    home: Place = make_optional(f"the place it starts from: {PLACES}; left out with homes: parking")
    target: Place = make_optional(f"the place to work at: {PLACES}")
    work: NotNegative = make_optional(WORK)
    actions: Actions = make_optional(f"of target: {ACTIONS}")
    stops: list[StopDocument] = make_optional(
        "one or more {at, work, actions}, in order", min_length=1
    )
    size: RobotSize = make_optional(
        "[length, width] instead of a radius: the circle around it [length unit]"
    )
    start: StateDocument = make_optional(
        "{at, ready, heading, soc, begun} where it begins, for jobs; at home by default"
    )
    capacity: Amount = make_optional(
        "its largest load, a whole number of 0 or more, for jobs; 1 by default"
    )
    battery: Name = make_optional("the name of its battery, for jobs; no limit by default")
    charging: list[Place] = make_optional(
        "a list of places where it may charge, for jobs; all charging places by default"
    )

    def check(self) -> None:
        """Refuse parts of several trips, and two sizes."""
        of_target = next((key for key in ("work", "actions") if getattr(self, key) is not None), "")
        if of_target and self.target is None and self.stops is None:
            raise ValueError("has nowhere to go (give target, or stops)")
        if self.target is not None and self.stops is not None:
            raise ValueError("has both target and stops (give one of them)")
        if self.stops is not None and of_target:
            raise ValueError(f"has {of_target} beside stops (write it at each stop)")
        if "radius" in self.given and self.size is not None:
            raise ValueError("has both radius and size (give one of them)")
        if self.size is not None and min(self.size) <= 0:
            raise ValueError("size: length and width are not both positive (give two above 0)")

    def get_own_attributes(self, owner: type) -> dict[str, Any]:
        """Return the attributes that were written; a size as the radius of the circle around it."""
        size = {} if self.size is None else {"radius": circumscribe(*self.size)}
        return super().get_own_attributes(owner) | size


class PlaceActionsDocument(Document):
    """Actions of robots at a place, for stops without actions of their own."""

    work: Actions = make_optional("at stops where the load stays as it is, as for stops")
    pick: Actions = make_optional("at stops where the load grows, as for stops")
    drop: Actions = make_optional("at stops where the load shrinks, as for stops")


FLEETS = "a list of robots, {scen: file} or {table: file}"
"""How robots are given."""


@add_attributes(Robot, but="speed")
class FleetDocument(Document):
    """Robots R1, R2, ... from the rows of a MovingAI .scen file."""

    scen: Name = make_field("a .scen file, relative to the scenario's own")
    count: Count = make_optional("the number of rows to use, 1 or more; all by default")
    speeds: list[Positive] = make_optional(
        "speeds to deal out in turn: first, second, ...", min_length=1
    )
    work: list[NotNegative] = make_optional("work times to deal out in turn", min_length=1)


class RobotTableDocument(Document):
    """Robots from the rows of a CSV file, with the keys of a robot as headings."""

    table: Name = make_field("a .csv file, relative to the scenario's own")


@add_attributes(Rules)
class RuleAttributes(Document):
    """Rules of a fleet, with or without jobs."""


class RulesDocument(RuleAttributes):
    """Rules of the whole fleet."""

    objective: Objective = make_optional(
        "the objective of plans of jobs: service, flowtime, makespan or both; service by default"
    )
    late: NotNegative = make_optional("the cost of a time unit after due, for jobs; 10 by default")
    patience: NotNegative = make_optional(
        "the time after earliest from which a job without due is overdue in a shift [time "
        "unit]; 1800 by default"
    )


class ClosureDocument(Document):
    """A vertex or an edge that nobody may use for a while."""

    schema_extra: ClassVar = {"oneOf": [{"required": ["at"]}, {"required": ["edge"]}]}

    at: Place = make_optional(f"the place that is closed: {PLACES}")
    edge: list[Place] = make_optional(
        "[A, B] instead of at: both ends of an edge that is closed in both directions",
        min_length=2,
        max_length=2,
    )
    from_: Moment = make_optional(
        "the begin [time unit], or a time of day; 0 by default", alias="from"
    )
    until: End = make_optional("the end [time unit], or a time of day; by default it never ends")
    radius: NotNegative = make_optional(
        "vertices and edges nearer than this radius plus the robot's radius and the "
        "clearance are closed for that robot, too [length unit]"
    )

    def check(self) -> None:
        """Refuse no place, and two."""
        if (self.at is None) == (self.edge is None):
            reason = "closes nothing" if self.at is None else "has both at and edge"
            raise ValueError(f"{reason} (give at, or edge)")


class UnitsDocument(Document):
    """Units of the numbers in reports; none by default."""

    length: LengthUnit = make_optional("mm, cm or m")
    time: TimeUnit = make_optional("ms, s, min or h")


class ScenarioFrame(Document):
    """The keys of a scenario; their values are read one by one, so that faults add up."""

    format: Literal["rightofway-scenario/1"] = make_field("rightofway-scenario/1")
    map: Any = make_field(f"one of {', '.join(MAPS)}")
    units: Any = make_optional("{length, time}: the units of the numbers, for reports")
    start: Any = make_optional("the instant of time 0, like 2026-11-28T06:00, for times of day")
    homes: Literal["parking"] = make_optional(
        "parking: robots without a home start from the parking and charging places of a layout"
    )
    robots: Any = make_field(FLEETS)
    rules: Any = make_optional("classic, or rules for the whole fleet")
    closures: Any = make_optional("a list of {at or edge, from, until, radius}")
    actions: Any = make_optional(
        "for places {work, pick, drop}: what robots do at stops without actions of their own"
    )
    batteries: Any = make_optional(
        "for each battery its name and {drive, on, work, charge, reserve}, for jobs"
    )
    charging: Any = make_optional(
        "a list of places to charge at in addition to those of the map, for jobs"
    )
    jobs: Any = make_optional(
        "a list of {name, at or pickup and dropoff or stops, …}, or {table: file}"
    )


class ScenarioDocument(ScenarioFrame):
    """A scenario: the map on which the fleet drives, its robots, its rules."""

    map: MapDocument = make_field("the map on which the fleet drives")
    units: UnitsDocument = make_optional("the units of the numbers, for reports")
    start: Name = make_optional(
        "the instant of time 0, like 2026-11-28T06:00, perhaps with an offset like +01:00: other"
        " times may be times of day"
    )
    robots: list[RobotDocument] | FleetDocument | RobotTableDocument = make_field("the fleet")
    rules: Literal["classic"] | RulesDocument = make_optional(
        "classic (no turning, no way back), or rules for the whole fleet"
    )
    closures: list[ClosureDocument] = make_optional("places and edges that are closed for a time")
    actions: dict[Name, PlaceActionsDocument] = make_optional(
        "actions at places, by name, for stops without actions of their own"
    )
    batteries: dict[Name, BatteryDocument] = make_optional(
        "for each battery its name and its shares"
    )
    charging: list[Place] = make_optional("a list of places to charge at, with those of the map")
    jobs: list[JobDocument] | JobTableDocument = make_optional(
        "a list of jobs, instead of trips of robots"
    )
