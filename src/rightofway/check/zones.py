"""Zones: each holds one robot at a time."""

from __future__ import annotations

from collections.abc import Iterator
from heapq import heappop, heappush
from typing import NamedTuple

from rightofway.check.faults import Fault
from rightofway.check.visits import Visits
from rightofway.model import Scenario, Tick
from rightofway.site import VertexId
from rightofway.site.zones import Zone


class _Stay(NamedTuple):
    """A booking of a zone by a robot [ticks], and where the robot is then."""

    start: int
    end: int
    robot: int
    vertex: int


def judge_zones(visits: Visits) -> Iterator[Fault]:
    """Find zones that two robots book at the same time.

    A booking of a vertex or an edge of the zone books the zone, approach and headway included.
    """
    for zone in visits.scenario.roadmap.zones:
        inside: list[tuple[int, int, _Stay]] = []  # a heap by end, without what is over
        known: set[tuple[int, int, int]] = set()
        for stay in sorted(_list_stays(visits, zone)):
            while inside and inside[0][0] <= stay.start:
                heappop(inside)
            for _, _, other in inside:
                pair = (min(stay.robot, other.robot), max(stay.robot, other.robot), other.end)
                if other.robot != stay.robot and pair not in known:
                    known.add(pair)
                    yield _make_fault(zone, stay, other, visits.scenario)
            heappush(inside, (stay.end, len(inside), stay))


def _list_stays(visits: Visits, zone: Zone) -> Iterator[_Stay]:
    headway = visits.scenario.problem.booking_rules.headway
    vertices, edges = set(zone.vertices), set(zone.edges)
    vertex, robot, last = visits.vertex.tolist(), visits.robot.tolist(), visits.last.tolist()
    start, end = visits.vertex_start.tolist(), (visits.vertex_end + headway).tolist()
    edge_start, edge_end = visits.edge_start.tolist(), (visits.edge_end + headway).tolist()
    for k, at in enumerate(vertex):
        if at in vertices:
            yield _Stay(start[k], end[k], robot[k], at)
        if not last[k] and (at, vertex[k + 1]) in edges:
            yield _Stay(edge_start[k], edge_end[k], robot[k], at)


def _make_fault(zone: Zone, stay: _Stay, other: _Stay, scenario: Scenario) -> Fault:
    first, second = sorted((stay, other), key=lambda booking: booking.robot)
    return Fault(
        kind="zone conflict",
        robots=(first.robot, second.robot),
        vertices=(VertexId(first.vertex), VertexId(second.vertex)),
        tick=Tick(stay.start),
        numbers={"zone": zone.name},
        scenario=scenario,
    )
