"""Where free-running robots meet is found by all pairs of their bookings, too."""

from __future__ import annotations

from itertools import combinations, product

from rightofway.errors import NoPlanExists
from rightofway.metrics import find_collisions, find_near_misses, find_swaps, name_collisions
from rightofway.model import NEVER, Scenario, Track, find_stays
from rightofway.native import list_excluded
from rightofway.repair.routing import free_running_tracks
from tests.builders.any_fleet import any_fleet
from tests.builders.laws import law, leave

Visit = tuple[int, int, int]  # vertex, start, end


def _list_visits(scenario: Scenario, tracks: tuple[Track, ...]) -> list[list[Visit]]:
    rules, visits = scenario.problem.booking_rules, []
    for track, stay in zip(tracks, find_stays(scenario, tracks), strict=True):
        enter, drive = track.enter.tolist(), [0, *stay.drive.tolist()]
        starts = [int(rules.start(at, ticks)) for at, ticks in zip(enter, drive, strict=False)]
        ends = [*(int(rules.end(at)) for at in enter[1:]), NEVER]
        visits.append(list(zip(track.vertices.tolist(), starts, ends, strict=True)))
    return visits


@law(any_fleet(robots=(2, 4)))
def test_collisions_and_swaps_are_those_of_all_pairs_of_visits(scenario: Scenario) -> None:
    try:
        tracks = free_running_tracks(scenario)
    except NoPlanExists:
        leave("a robot has no way")
    visits = _list_visits(scenario, tracks)
    collisions, swaps = [], []
    for i, j in combinations(range(len(tracks)), 2):
        for one, other in product(visits[i], visits[j]):
            start, end = max(one[1], other[1]), min(one[2], other[2])
            if one[0] == other[0] and start < end:
                collisions.append((start, (i, j), one[0], None if end == NEVER else end))
        moves = [
            list(zip(track.vertices[:-1].tolist(), track.vertices[1:].tolist(),
                     track.enter[1:].tolist(), strict=True))
            for track in (tracks[i], tracks[j])
        ]  # fmt: skip
        for (tail, head, tick), (start, end, when) in product(*moves):
            if (tail, head, tick) == (end, start, when) and tail != head:
                swaps.append((tick, (i, j), (tail, head)))
    found = find_collisions(scenario, tracks)
    assert [(hit.start, hit.robots, hit.vertex, hit.end) for hit in found] == sorted(
        collisions, key=lambda hit: hit[:3]
    )
    assert [(swap.tick, swap.robots, swap.vertices) for swap in find_swaps(tracks)] == sorted(swaps)
    named = name_collisions(scenario, tracks)
    kinds = [row.kind for row in named]
    assert named.count_kinds() == {kind: kinds.count(kind) for kind in named.count_kinds()}
    assert [row.start for row in named] == sorted(row.start for row in named)
    assert [named[k] for k in range(len(named))] == list(named) == list(named[:])


Booking = tuple[int, int, int, tuple[int, ...]]  # row, start, end, place


def _list_bookings(scenario: Scenario, tracks: tuple[Track, ...]) -> list[list[Booking]]:
    rules, resources = scenario.problem.booking_rules, scenario.problem.resources
    bookings = list[list[Booking]]()
    for robot, (track, stay) in enumerate(zip(tracks, find_stays(scenario, tracks), strict=True)):
        vertices, enter = track.vertices.tolist(), track.enter.tolist()
        starts = [at - drive for at, drive in zip(enter, [0, *stay.drive[:-1]], strict=True)]
        ends = [*(int(rules.end(at)) for at in enter[1:]), NEVER]
        own: list[Booking] = [
            (resources.get_vertex_row(robot, vertex), start, end, (vertex,))
            for vertex, start, end in zip(vertices, starts, ends, strict=True)
        ]
        edges = scenario.roadmap.find_edges(track.vertices[:-1], track.vertices[1:]).tolist()
        own += [
            (
                resources.get_edge_row(robot, edge),
                starts[k + 1],
                ends[k],
                (vertices[k], vertices[k + 1]),
            )
            for k, edge in enumerate(edges)
            if edge >= 0
        ]
        bookings.append(own)
    return bookings


@law(any_fleet(robots=(2, 4), always={"sizes"}))
def test_near_misses_are_overlaps_of_places_that_exclude_each_other(scenario: Scenario) -> None:
    try:
        tracks = free_running_tracks(scenario)
    except NoPlanExists:
        leave("a robot has no way")
    resources, bookings, expected = scenario.problem.resources, _list_bookings(scenario, tracks), []
    for i, j in combinations(range(len(tracks)), 2):
        overlaps = sorted(
            (start, end, (place, other_place))
            for (row, begin, until, place), (
                other,
                other_begin,
                other_until,
                other_place,
            ) in product(bookings[i], bookings[j])
            if place != other_place and other in list_excluded(resources, row)
            if (start := max(begin, other_begin)) < (end := min(until, other_until))
        )
        joined: list[list[object]] = []
        reached = -1
        for start, end, places in overlaps:
            if not joined or start > reached:
                joined.append([start, (i, j), places, end])
            reached = max(reached, end)
            joined[-1][3] = reached
        expected += joined
    found = find_near_misses(scenario, tracks)
    assert sorted(
        [miss.start, miss.robots, miss.places, NEVER if miss.end is None else miss.end]
        for miss in found
    ) == sorted(expected)
    assert [(miss.start, miss.robots) for miss in found] == sorted(
        (miss.start, miss.robots) for miss in found
    )
