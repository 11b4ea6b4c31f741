"""Collisions and swaps of free-running robots are those of all pairs of visits."""

from __future__ import annotations

from itertools import combinations, product

from rightofway.errors import NoPlanExists
from rightofway.metrics import find_collisions, find_swaps, name_collisions
from rightofway.model import NEVER, Scenario, Track, find_stays
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
