"""Precedence graphs keep clear of closures, as times raised again and again do."""

from __future__ import annotations

import random

from hypothesis import strategies as st

from rightofway.model import Scenario, make_route
from rightofway.precedence import build_graph
from rightofway.search import Bookings, Distances, find_earliest_track
from tests.builders.closures import closed_fleet
from tests.builders.laws import law, leave
from tests.oracles.closures import earliest_times


# Of any fleet, half have a robot that no way leads home among the closures: points on grids then,
# which is what the oracle knows.
@law(st.integers(0, 10**6).map(lambda seed: closed_fleet(3 * seed)), st.integers(0, 2**32 - 1))
def test_precedence_graphs_have_the_earliest_times_that_keep_clear_of_closures(
    scenario: Scenario, seed: int
) -> None:
    """Rights of way are given and taken back at random, on the routes of robots alone."""
    draw = random.Random(seed)  # noqa: S311 (no secret depends on it)
    bookings, distances = Bookings(scenario.problem), Distances(scenario.roadmap)
    tracks = []
    for robot in range(len(scenario.robots)):
        track = find_earliest_track(robot, bookings, distances)
        if track is None:
            leave("a robot has no way")
        tracks.append(track)
    itineraries = scenario.problem.itineraries
    routes = [
        make_route(scenario.roadmap, one, track)
        for one, track in zip(itineraries, tracks, strict=True)
    ]
    graph = build_graph(scenario.problem, routes)
    given: list[tuple[int, int]] = []
    for _ in range(30):
        meeting = graph.find_next_meeting()
        if given and (meeting is None or draw.random() < 0.3):
            right = given.pop(draw.randrange(len(given)))
            assert graph.take_back(*right)
        elif meeting is not None:
            visits = sorted(meeting.visits, key=lambda _: draw.random())
            right = (visits[0], visits[1])
            mark = graph.checkpoint()
            if graph.give_way(*right) and right not in given:
                given.append(right)
                if draw.random() < 0.2:
                    graph.rollback(mark)
                    given.pop()
        expected = earliest_times(scenario, routes, given, scenario.problem.booking_rules.headway)
        times = [tick for track in graph.build_tracks() for tick in track.enter.tolist()]
        assert times == expected
