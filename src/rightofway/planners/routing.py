"""Where each robot goes, chosen one robot at a time."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial
from itertools import accumulate, pairwise

from rightofway.deadline import limit_loop
from rightofway.errors import GaveUp
from rightofway.model import Itinerary, Route, Scenario, Track, join_route, make_route
from rightofway.planners.impossible import refuse_stranded, refuse_the_impossible
from rightofway.planners.task import Task
from rightofway.search import Bookings, Congestion, Distances, find_earliest_track
from rightofway.search.missing_ways import reaches_its_places
from rightofway.site import Roadmap, VertexId

ROUTING = "choosing routes"
"""What takes the time, for messages."""


def choose_routes(task: Task) -> tuple[Distances, list[Route]]:
    """Return the tables of a roadmap, and the routes of the fleet as the option ``routes`` asks."""
    checkpoint = partial(task.deadline.check, ROUTING)
    distances = Distances(task.scenario.roadmap, checkpoint=checkpoint)
    if task.scenario.problem.closures is not None:
        return distances, choose_routes_among_closures(task, distances)
    choose = clear_routes if task.options["routes"] == "clear" else find_shortest_routes
    return distances, choose(task.scenario, distances)


def choose_routes_among_closures(task: Task, distances: Distances) -> list[Route]:
    """Return the best route of each robot as if it were alone, but for closures.

    A route that closures cut off for a while may have no times at all; these have some. Raises
    `GaveUp` where a robot finds none with the headway of planning.
    """
    refuse_the_impossible(task.scenario, distances)
    bookings, routes = Bookings(task.scenario.problem), list[Route]()
    for robot, itinerary in enumerate(task.scenario.problem.itineraries):
        left = task.deadline.measure_seconds_left()
        track = find_earliest_track(robot, bookings, distances, time_limit=left)
        if track is None:
            name = task.scenario.robots[robot].name
            message = f"{name} finds no way among closures with the headway of planning"
            raise GaveUp(f"{message} (allow rotations, or choose prioritized)")
        routes.append(make_route(task.scenario.roadmap, itinerary, track))
    return routes


def find_shortest_routes(scenario: Scenario, distances: Distances) -> list[Route]:
    """Return a shortest route for each robot, as if it were alone.

    Raises `NoPlanExists` as `refuse_the_impossible`.
    """
    routes, stranded = list[Route](), list[int]()
    for robot, itinerary in enumerate(limit_loop(scenario.problem.itineraries, ROUTING)):
        if reaches_its_places(itinerary, distances):  # by the tables that its route needs
            routes.append(find_shortest_route(scenario.roadmap, itinerary, distances))
        else:
            stranded.append(robot)
    refuse_stranded(scenario, stranded)
    return routes


def free_running_tracks(scenario: Scenario) -> tuple[Track, ...]:
    """Return the tracks of robots that drive their shortest routes and never wait.

    Raises
    ------
    NoPlanExists
        As `refuse_the_impossible`.
    """
    routes = find_shortest_routes(scenario, Distances(scenario.roadmap))
    return tuple(
        Track.of(
            route.vertices,
            list(accumulate(map(route.compute_least, range(len(route) - 1)), initial=0)),
        )
        for route in routes
    )


def find_shortest_route(roadmap: Roadmap, itinerary: Itinerary, distances: Distances) -> Route:
    """Return the route of the paper: shortest paths to the stops, and home as it would come.

    Distances may be those of a part of the roadmap; how the robot turns is known on the roadmap.
    The way home from the last stop of a lap is the path that leads there from home, reversed,
    wherever that is a shortest path too.
    """
    ticks, legs = itinerary.edge_costs, []
    for place, stage in _trips(itinerary):
        leg = distances.find_path(place, stage, ticks)
        if stage == itinerary.home:
            back = distances.find_path(stage, place, ticks)[::-1]
            if distances.compute_cost(back, ticks) == distances.compute_cost(leg, ticks):
                leg = back
        legs.append(leg)
    return join_route(roadmap, itinerary, legs)


def clear_routes(scenario: Scenario, distances: Distances) -> list[Route]:
    """Return a route for each robot that keeps clear of others where that is not a long way round.

    Robots are routed one after another. Each keeps clear of all homes and stops, and of the robots
    routed before it that come the other way. Raises `NoPlanExists` as `refuse_the_impossible`.
    """
    refuse_the_impossible(scenario, distances)
    traffic = Congestion.of_trips(scenario.problem, distances)
    robots = range(len(scenario.robots))
    return [_clear(scenario, traffic, robot) for robot in limit_loop(robots, ROUTING)]


def find_direct_routes(
    scenario: Scenario, distances: Distances, routes: Sequence[Route]
) -> list[Route]:
    """Return shorter routes for robots that make their trips again and again.

    A route that keeps clear of all others is longer in every lap. Each robot whose route is not a
    shortest one gets another one, which keeps clear of others by how often they are there.
    """
    new_routes, detours = list(routes), []
    traffic = Congestion.of_laps(scenario.problem, distances)
    for robot, (itinerary, route) in limit_loop(
        enumerate(zip(scenario.problem.itineraries, routes, strict=True)), ROUTING
    ):
        trips = _trips(itinerary)
        least = sum(int(distances.to(end, itinerary.edge_ticks)[start]) for start, end in trips)
        if sum(route.drive) > least:
            detours.append(robot)
        else:
            traffic.add(robot, route.vertices)
    for robot in limit_loop(detours, ROUTING):
        new_routes[robot] = _clear(scenario, traffic, robot)
    return new_routes


def _clear(scenario: Scenario, traffic: Congestion, robot: int) -> Route:
    """Return a robot's route through the traffic, and add the route to the traffic."""
    itinerary = scenario.problem.itineraries[robot]
    trips = _trips(itinerary)
    legs = [traffic.find_path(robot, place, stage) for place, stage in trips]
    for leg in legs:
        traffic.add(robot, leg)
    return join_route(scenario.roadmap, itinerary, legs)


def _trips(itinerary: Itinerary) -> Iterator[tuple[VertexId, VertexId]]:
    """Yield the place before each stage and the place of the stage."""
    return pairwise([itinerary.home, *(stage.vertex for stage in itinerary.stages)])
