"""Routes of robots, chosen one robot at a time."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial
from itertools import pairwise

from rightofway.deadline import limit_loop
from rightofway.errors import GaveUp, InputError
from rightofway.facts import Fact
from rightofway.model import Itinerary, Route, Scenario, Track, join_route, join_track, make_route
from rightofway.repair.impossible import refuse_stranded, refuse_the_impossible
from rightofway.repair.plan_request import PlanRequest
from rightofway.search import Bookings, Congestion, Distances, find_earliest_track
from rightofway.search.distances import Path
from rightofway.site import Roadmap, VertexId

ROUTING = Fact("choosing routes")


def choose_routes(request: PlanRequest) -> tuple[Distances, list[Route]]:
    """Return the tables of a roadmap, and the routes of the fleet as the option ``routes`` asks."""
    checkpoint = partial(request.deadline.check, ROUTING)
    distances = Distances(request.scenario.roadmap, checkpoint=checkpoint)
    if request.scenario.problem.closures is not None:
        return distances, choose_routes_among_closures(request, distances)
    choose = clear_routes if request.options["routes"] == "clear" else find_shortest_routes
    return distances, choose(request.scenario, distances)


def choose_routes_among_closures(request: PlanRequest, distances: Distances) -> list[Route]:
    """Return the best route of each robot as if it were alone, but for closures.

    A route that closures cut off for a while may have no times at all; these have some. Raises
    `GaveUp` where a robot finds none with the headway of planning.
    """
    refuse_the_impossible(request.scenario, distances)
    bookings, routes = Bookings(request.scenario.problem), list[Route]()
    for robot, itinerary in enumerate(request.scenario.problem.itineraries):
        left = request.deadline.measure_seconds_left()
        track = find_earliest_track(robot, bookings, distances, time_limit=left)
        if track is None:
            raise GaveUp(Fact("no way with headway of planning", request.scenario, robot=robot))
        routes.append(make_route(request.scenario.roadmap, itinerary, track))
    return routes


def find_shortest_routes(scenario: Scenario, distances: Distances) -> list[Route]:
    """Return a shortest route for each robot, as if it were alone.

    Raises `NoPlanExists` as `refuse_the_impossible`.
    """
    itineraries = scenario.problem.itineraries
    return [
        join_route(scenario.roadmap, itinerary, legs)
        for itinerary, legs in zip(itineraries, _find_all_legs(scenario, distances), strict=True)
    ]


def free_running_tracks(scenario: Scenario) -> tuple[Track, ...]:
    """Return the tracks of robots that drive their shortest routes and never wait.

    Raises
    ------
    NoPlanExists
        As `refuse_the_impossible`.
    """
    itineraries, distances = scenario.problem.itineraries, Distances(scenario.roadmap)
    return tuple(
        join_track(scenario.roadmap, itinerary, legs)
        for itinerary, legs in zip(itineraries, _find_all_legs(scenario, distances), strict=True)
    )


def find_shortest_route(roadmap: Roadmap, itinerary: Itinerary, distances: Distances) -> Route:
    """Return the route of the paper: shortest paths to the stops, and home as it would come.

    Distances may be those of a part of the roadmap; how the robot turns is known on the roadmap.
    The way home from the last stop of a lap is the path that leads there from home, reversed,
    wherever that is a shortest path too.
    """
    return join_route(roadmap, itinerary, _find_legs(itinerary, distances))


def find_shortest_track(roadmap: Roadmap, itinerary: Itinerary, distances: Distances) -> Track:
    """Return the track of a robot that drives its shortest route and never waits."""
    return join_track(roadmap, itinerary, _find_legs(itinerary, distances))


def _find_all_legs(scenario: Scenario, distances: Distances) -> Iterator[list[Path]]:
    """Yield the legs of each robot; at the end, refuse robots that have no way."""
    stranded = list[int]()
    for robot, itinerary in enumerate(limit_loop(scenario.problem.itineraries, ROUTING, 8)):
        try:
            yield _find_legs(itinerary, distances)
        except InputError:
            stranded.append(robot)
            yield []
    refuse_stranded(scenario, stranded)


def _find_legs(itinerary: Itinerary, distances: Distances) -> list[Path]:
    """Return a shortest path to each stage. Raise `InputError` where one cannot be reached."""
    ticks, legs = itinerary.edge_costs, list[Path]()
    paths: dict[tuple[VertexId, VertexId], Path] = {}
    for place, stage in _list_trips(itinerary):
        if stage == itinerary.home:
            out = paths.get((stage, place)) or distances.find_path(stage, place, ticks)
            leg = _find_way_back(out, itinerary, distances)
        else:
            leg = distances.find_path(place, stage, ticks)
        paths[place, stage] = leg
        legs.append(leg)
    return legs


def _find_way_back(out: Path, itinerary: Itinerary, distances: Distances) -> Path:
    """Return a shortest path reversed if that is a shortest path too, else another path back."""
    ticks, reverse = itinerary.edge_costs, out[::-1]
    if distances.is_symmetric(ticks):
        return reverse
    other = distances.find_path(out[-1], out[0], ticks)
    is_shortest = distances.compute_cost(reverse, ticks) == distances.compute_cost(other, ticks)
    return reverse if is_shortest else other


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
        trips = _list_trips(itinerary)
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
    trips = _list_trips(itinerary)
    legs = [traffic.find_path(robot, place, stage) for place, stage in trips]
    for leg in legs:
        traffic.add(robot, leg)
    return join_route(scenario.roadmap, itinerary, legs)


def _list_trips(itinerary: Itinerary) -> Iterator[tuple[VertexId, VertexId]]:
    """Yield the place before each stage and the place of the stage."""
    return pairwise([itinerary.home, *(stage.vertex for stage in itinerary.stages)])
