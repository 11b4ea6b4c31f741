"""The problem: a roadmap, robots, rules."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from copy import copy
from dataclasses import dataclass, field, replace
from typing import Any

from rightofway.errors import InputError, InputFault, Steps, Where
from rightofway.kinds.table import VERTEX, allow_none, coerce_fields, list_of, make_class
from rightofway.model.actions import PLACE_ACTIONS, PlaceActions
from rightofway.model.bind_work import bind_tours, bind_work
from rightofway.model.closures import Closure, find_closure_faults
from rightofway.model.figures import get_figures
from rightofway.model.problem import HEAVIEST, Problem, bind_problem, scale_weights
from rightofway.model.resources import find_too_short_edges
from rightofway.model.robot import Robot, Rules, Turn
from rightofway.model.units import Clock
from rightofway.model.work import BATTERIES, Battery, Job, Tour
from rightofway.model.work_faults import find_heading_faults, find_work_faults
from rightofway.site import Roadmap, VertexId
from rightofway.site.walls import clear_of_walls, reaches_walls
from rightofway.units import Units, write_decimal

MAX_STAGES = 1_000_000
"""Stops and ways home of a whole fleet, laps unrolled, at most."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Scenario:
    """A fleet with its map and rules; valid by construction.

    Attributes
    ----------
    roadmap
        The graph that robots drive on.
    robots
        At least one; each has a unique name and home.
    rules
        The rules of the whole fleet.
    clock
        The clock to keep, if this is the remaining part of another scenario; else one is chosen.
    closures
        Vertices and edges that no robot may book for a time.
    units
        The units of lengths and times; only for people, no plan depends on it.
    jobs
        The work of the fleet; None for robots with trips of their own.
    batteries
        Batteries of robots by their names; a mapping, kept as pairs. Only with jobs.
    charging
        Vertices to charge at, added to the charging places of the map. Only with jobs.
    tours
        Which robot does which jobs in which order, one tour for each robot, where that is decided:
        itineraries are made from it. Files do not keep it.
    actions
        The actions of robots at stops without actions of their own, by places.
    problem
        The same in ticks; derived.

    Raises
    ------
    InputError
        With every independent fault, its place, value and remedy.
    """

    roadmap: Roadmap
    robots: tuple[Robot, ...]
    rules: Rules = field(default_factory=Rules)
    clock: Clock | None = None
    units: Units = field(default_factory=Units)
    closures: tuple[Closure, ...] = ()
    jobs: tuple[Job, ...] | None = None
    batteries: tuple[tuple[str, Battery], ...] = ()
    charging: tuple[VertexId, ...] = ()
    tours: tuple[Tour, ...] | None = field(default=None, repr=False)
    actions: tuple[PlaceActions, ...] = ()
    problem: Problem = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        coerce_fields(
            self,
            "",
            roadmap=make_class(Roadmap),
            robots=list_of(make_class(Robot), admits=list | tuple),
            rules=make_class(Rules),
            clock=allow_none(make_class(Clock)),
            units=make_class(Units),
            closures=list_of(make_class(Closure), admits=list | tuple),
            jobs=allow_none(list_of(make_class(Job))),
            batteries=BATTERIES,
            charging=list_of(VERTEX),
            actions=PLACE_ACTIONS,
        )
        object.__setattr__(self, "rules", _resolve_rules(self))
        if self.rules.walls == "strict" and self.roadmap.grid is not None:
            radii = [robot.radius for robot in self.robots]
            object.__setattr__(self, "roadmap", clear_of_walls(self.roadmap, radii))
        faults = [
            *_find_turn_faults(self.rules.turn, ("rules", "turn"), self.roadmap),
            *_find_fleet_faults(self),
            *_find_space_faults(self),
            *find_work_faults(self),
            *_find_action_faults(self),
        ]
        for index, closure in enumerate(self.closures):
            of_closure = find_closure_faults(closure, self.roadmap)
            faults += [fault.nest(("closures", index)) for fault in of_closure]
        if faults:
            raise InputError(faults)
        object.__setattr__(self, "problem", _bind(self))

    def __repr__(self) -> str:
        count = len(self.robots)
        fleet = "1 robot" if count == 1 else f"{count} robots"
        return f"Scenario({fleet} on {self.roadmap!r}, tick {self.problem.clock.tick})"

    def _repr_html_(self) -> str:
        """Return the map and the robots, for notebooks."""
        return get_figures().draw_scenario_html(self)


def assign_tours(scenario: Scenario, tours: Sequence[Tour]) -> Scenario:
    """Return a scenario with jobs in which itineraries follow tours.

    Parameters
    ----------
    scenario
        A scenario with jobs.
    tours
        One for each robot; items name jobs and stops that exist.
    """
    assigned = copy(scenario)  # valid already, and the roadmap is bound
    object.__setattr__(assigned, "tours", tuple(tours))
    object.__setattr__(assigned, "problem", bind_tours(scenario.problem, tours))
    return assigned


def _bind(scenario: Scenario) -> Problem:
    """Return a valid scenario in ticks."""
    durations = [stop.work for job in scenario.jobs or () for stop in job.stops]
    problem = bind_problem(
        scenario.roadmap,
        scenario.robots,
        scenario.rules,
        clock=scenario.clock,
        closures=scenario.closures,
        durations=durations,
    )
    if scenario.jobs is None:
        return problem
    problem = bind_work(problem, scenario)
    return problem if scenario.tours is None else bind_tours(problem, scenario.tours)


def _resolve_rules(scenario: Scenario) -> Rules:
    """Return the rules with the occupancy that the fleet has by default."""
    if scenario.rules.occupancy is not None:
        return scenario.rules
    has_sizes = any(robot.radius > 0 for robot in scenario.robots)
    roadmap = scenario.roadmap
    ahead = has_sizes or roadmap.zones or roadmap.passing or roadmap.has_shared_places
    return replace(scenario.rules, occupancy="both" if ahead else "one")


def _find_turn_faults(turn: Turn | None, place: Where, roadmap: Roadmap) -> Iterator[InputFault]:
    if turn == "cell" and roadmap.grid is None:
        yield InputFault(place, "'cell' needs a grid (give a time, like 0 or 1/2)")


def _find_space_faults(scenario: Scenario) -> Iterator[InputFault]:
    """Yield faults of rules that do not fit robots with a size, or to a fleet in which none has."""
    rules = scenario.rules
    if rules.walls == "strict" and scenario.roadmap.grid is None:
        message = "'strict' needs a grid or a floor in cells of one size (take it out)"
        yield InputFault(("rules", "walls"), message)
    if scenario.roadmap.zones and rules.occupancy == "one":
        message = "'one' does not go with zones (give both, so that robots book ahead)"
        yield InputFault(("rules", "occupancy"), message)
    if scenario.roadmap.passing is not None and rules.occupancy == "one":
        message = "'one' does not go with vertices that have pass (give both: robots book ahead)"
        yield InputFault(("rules", "occupancy"), message)
    if scenario.roadmap.has_shared_places and rules.occupancy == "one":
        message = "'one' does not go with places that have a vertex for each direction"
        yield InputFault(("rules", "occupancy"), f"{message} (give both: robots book ahead)")
    if all(robot.radius <= 0 for robot in scenario.robots):
        if rules.clearance > 0:
            remedy = "give a robot a radius"
            message = f"{write_decimal(rules.clearance)} is for robots with a size ({remedy})"
            yield InputFault(("rules", "clearance"), message)
        return
    if rules.occupancy == "one":
        remedy = "give both, or leave it out"
        message = f"'one' is for robots without a size, and a robot has a radius ({remedy})"
        yield InputFault(("rules", "occupancy"), message)
    for tail, head, length, about in find_too_short_edges(scenario.roadmap):
        name = scenario.roadmap.name
        yield InputFault(
            "roadmap",
            f"the edge from {name(tail)} to {name(head)} is {write_decimal(length)} long, but its"
            f" ends are {write_decimal(about, 6)} apart (robots with a size drive straight: give"
            " its length or move an end)",
        )


def _find_fleet_faults(scenario: Scenario) -> Iterator[InputFault]:
    if not scenario.robots:
        yield InputFault("robots", "there is none (give at least one)")
    for index, robot in enumerate(scenario.robots):
        yield from (fault.nest(("robots", index)) for fault in _find_robot_faults(robot, scenario))
    yield from _find_weight_faults(scenario.robots)
    name = scenario.roadmap.name
    names = [robot.name for robot in scenario.robots]
    yield from _find_twice("name", names, ["{other}"] * len(names), "give each its own")
    homes = [robot.home for robot in scenario.robots]
    if all(0 <= home < scenario.roadmap.n_vertices for home in homes):
        remedy = "a vertex holds one robot; move one of them"
        yield from _find_twice("home", [name(home) for home in homes], names, remedy)
    laps = scenario.rules.laps
    stages = sum((len(robot.stops) + 1) * (robot.laps or laps) for robot in scenario.robots)
    if stages > MAX_STAGES:
        message = f"{stages} stops and ways home in all laps, more than {MAX_STAGES}"
        yield InputFault("robots", f"{message} (give fewer laps)")


def _find_twice(
    key: str, values: list[str], owners: list[str], remedy: str
) -> Iterator[InputFault]:
    first: dict[str, int] = {}
    for index, value in enumerate(values):
        earlier = first.setdefault(value, index)
        if earlier != index:
            message = f"{value} is the {key} of {owners[earlier]} already ({remedy})"
            yield InputFault(("robots", index, key), message, ("robots", earlier))


def _find_action_faults(scenario: Scenario) -> Iterator[InputFault]:
    """Yield places of actions that are not on the map or given twice, and stops that differ."""
    name, n_vertices = scenario.roadmap.name, scenario.roadmap.n_vertices
    seen = set[int]()
    for index, own in enumerate(scenario.actions):
        where: Where = ("actions", index, "at")
        if not 0 <= own.at < n_vertices:
            message = f"vertex {own.at} is not on the roadmap (give 0 to {n_vertices - 1})"
            yield InputFault(where, message)
        elif own.at in seen:
            yield InputFault(where, f"{name(own.at)} has actions already (give them once)")
        seen.add(own.at)
    for index, robot in enumerate(scenario.robots):
        actions = dict[int, Any]()
        for number, stop in enumerate(robot.stops):
            # Orders find the actions of a stop of a trip by its place.
            if actions.setdefault(stop.at, stop.actions) != stop.actions:
                where = ("robots", index, "stops", number, "actions")
                message = f"{name(stop.at)} has other actions at an earlier stop"
                yield InputFault(where, f"{message} (give both the same, or use jobs)")


def _find_weight_faults(robots: Sequence[Robot]) -> Iterator[InputFault]:
    weights = scale_weights(robots)
    heaviest = max(weights, default=1)
    if heaviest > HEAVIEST:
        message = f"{robots[weights.index(heaviest)].weight} makes weights too far apart or too"
        message += f" fine: in whole numbers it is {heaviest}, above {HEAVIEST} (round weights)"
        yield InputFault(("robots", weights.index(heaviest), "weight"), message)


def _find_robot_faults(robot: Robot, scenario: Scenario) -> Iterator[InputFault]:
    if not robot.name:
        yield InputFault("name", "is empty (give the robot a name)")
    yield from _find_turn_faults(robot.turn, "turn", scenario.roadmap)
    yield from _place_faults(robot, scenario.roadmap)
    if not robot.stops and scenario.jobs is None:
        yield InputFault("stops", "there is none (give at least one place to work at)")
    laps = scenario.rules.laps if robot.laps is None else robot.laps
    if (robot.ends or scenario.rules.ends) == "none" and laps > 1:
        message = f"{laps} laps need a way back (set return: home, or laps: 1)"
        yield InputFault("laps", message)


def _place_faults(robot: Robot, roadmap: Roadmap) -> Iterator[InputFault]:
    n_vertices = roadmap.n_vertices
    start = [] if robot.start is None else [(("start", "at"), robot.start.at)]
    places: Iterable[tuple[Steps, int]] = [
        (("home",), robot.home),
        *start,
        *((("stops", index, "at"), stop.at) for index, stop in enumerate(robot.stops)),
    ]
    for place, vertex in places:
        if not 0 <= vertex < n_vertices:
            yield InputFault(
                place, f"vertex {vertex} is not on the roadmap (give 0 to {n_vertices - 1})"
            )
        elif robot.type in roadmap.barred_vertices.get(VertexId(vertex), frozenset()):
            message = f"{roadmap.name(vertex)} is barred for robots of type {robot.type}"
            yield InputFault(place, f"{message} (give the robot another place, or another type)")
        elif roadmap.passing is not None and vertex in roadmap.passing.vertices:
            message = f"{roadmap.name(vertex)} is driven through only"
            remedy = "give the robot another place, or take pass out of the vertex"
            yield InputFault(place, f"{message} ({remedy})")
        elif place[0] == "stops":
            yield from find_heading_faults(place, vertex, roadmap)
    has_walls = roadmap.grid is not None and any(
        edge_class.max_radius is not None for edge_class in roadmap.edge_classes
    )
    if has_walls:
        known = [(place, vertex) for place, vertex in places if 0 <= vertex < n_vertices]
        reaches = reaches_walls(roadmap, robot.radius) if known else ()
        for place, vertex in known:
            if reaches[vertex]:
                message = f"{roadmap.name(vertex)} is too near to a wall for a radius of"
                yield InputFault(place, f"{message} {write_decimal(robot.radius)} (move it)")
