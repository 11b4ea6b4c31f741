"""All visits of a plan side by side in flat arrays, with the edges driven between them."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import chain
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rightofway.check.turning import compute_turns
from rightofway.model import Plan, Scenario
from rightofway.site import Roadmap

SAFE = 2**60
"""Sums of a few numbers below this stay within 64 bits; plans beyond it are judged in exact
Python integers, which is slower."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Visits:
    """The visits of all robots, in the order of the robots and of their tracks.

    All arrays have shape (n,). Times are int64, or Python integers where the plan has times too
    large for that.
    """

    plan: Plan
    robot: NDArray[np.int64]
    vertex: NDArray[np.int64]  # as it is drawn
    place: NDArray[np.int64]  # the vertex, or the lower one of both directions of a lane
    enter: NDArray[Any]  # [ticks]
    leave: NDArray[Any]  # [ticks]; a last visit leaves later than anything happens
    last: NDArray[np.bool_]  # whether it is its robot's last visit
    known: NDArray[np.bool_]  # whether the roadmap has the vertex
    edge: NDArray[np.int64]  # to the robot's next visit, -1 without one
    drive: NDArray[Any]  # of that edge for that robot, 0 without one or if barred [ticks]
    barred: NDArray[np.bool_]  # whether that edge is barred for that robot
    angle: NDArray[np.int64]  # that the robot turns before that drive [1e-6 degrees]
    turn: NDArray[Any]  # how long that turn takes [ticks]
    passed: NDArray[np.bool_]  # whether robots only drive through the vertex
    vertex_start: NDArray[Any]  # when the booking of the vertex begins [ticks]
    vertex_end: NDArray[Any]  # when it ends, without headway [ticks]
    edge_start: NDArray[Any]  # when the booking of the edge begins [ticks]
    edge_end: NDArray[Any]  # when it ends, without headway [ticks]

    @property
    def scenario(self) -> Scenario:
        """The scenario of the plan."""
        return self.plan.scenario


def lay_out_visits(plan: Plan) -> Visits:
    """Lay out the visits of a plan, however wrong it is."""
    lengths = np.array([len(track) for track in plan.tracks])
    vertex = np.concatenate([track.vertices for track in plan.tracks]).astype(np.int64)
    enter = np.concatenate([track.enter for track in plan.tracks])
    enter = enter.astype(_choose_integers(plan, enter))
    last = np.zeros(len(vertex), bool)
    last[np.cumsum(lengths) - 1] = True
    robot = np.repeat(np.arange(len(lengths)), lengths)
    roadmap = plan.scenario.roadmap
    edge = _find_edges(roadmap, vertex, np.where(last, -1, np.roll(vertex, -1)))
    drive = _measure_drives(plan, robot, edge, enter.dtype)
    known = (vertex >= 0) & (vertex < roadmap.n_vertices)
    passed = np.zeros(len(vertex), bool)
    if roadmap.passing is not None:
        vertex[known] = roadmap.passing.drawn[vertex[known]]
        passed = np.isin(vertex, list(roadmap.passing.vertices))
    place = vertex.copy()
    if roadmap.has_shared_places:
        place[known] = [min(roadmap.list_place(at)) for at in vertex[known].tolist()]
    leave = np.where(last, enter.max() + 1, np.roll(enter, -1))
    drive, barred = np.maximum(drive, 0), np.array(drive < 0, bool)
    bookings = _book(plan, enter=enter, leave=leave, drive=drive, last=last, passed=passed)
    angle, turn = compute_turns(plan, robot, vertex, edge)
    return Visits(
        plan=plan,
        robot=robot,
        vertex=vertex,
        place=place,
        enter=enter,
        leave=leave,
        last=last,
        known=known,
        edge=edge,
        drive=drive,
        barred=barred,
        angle=angle,
        turn=turn.astype(enter.dtype),
        passed=passed,
        vertex_start=bookings[0],
        vertex_end=bookings[1],
        edge_start=bookings[2],
        edge_end=bookings[3],
    )


def _book(
    plan: Plan,
    *,
    enter: NDArray[Any],
    leave: NDArray[Any],
    drive: NDArray[Any],
    last: NDArray[np.bool_],
    passed: NDArray[np.bool_],
) -> list[NDArray[Any]]:
    """Return when bookings of vertices begin and end, and those of the edges driven out of them.

    A drive through passed vertices is one drive: all that it touches is booked from its begin, at
    the visit before the first passed vertex, to its end, at the visit after the last one.
    """
    departure = leave - drive
    # The last visit before a first has no drive.
    starts = enter - np.roll(drive, 1) if plan.scenario.rules.occupancy == "both" else enter.copy()
    ends, edge_starts, edge_ends = leave.copy(), departure.copy(), leave.copy()
    is_first = np.roll(last, 1)
    for visit in np.flatnonzero(passed & (is_first | ~np.roll(passed, 1))).tolist():
        begin, end = visit if is_first[visit] else visit - 1, visit
        while passed[end] and not last[end]:
            end += 1
        arrival = leave[end] if passed[end] else enter[end]
        starts[begin + 1 : end + 1] = np.minimum(starts[begin + 1 : end + 1], departure[begin])
        ends[begin:end] = np.maximum(ends[begin:end], arrival)
        edge_starts[begin:end] = departure[begin]
        edge_ends[begin:end] = arrival
    return [starts, ends, edge_starts, edge_ends]


def _choose_integers(plan: Plan, enter: NDArray[np.int64]) -> np.dtype[Any]:
    problem = plan.scenario.problem
    edge_ticks: Iterable[int] = chain.from_iterable(
        {itinerary.edge_ticks for itinerary in problem.itineraries}
    )
    largest = max(int(enter.max()), -int(enter.min()), problem.booking_rules.headway, *edge_ticks)
    return np.dtype(np.int64 if largest < SAFE else object)


def _find_edges(
    roadmap: Roadmap, tails: NDArray[np.int64], heads: NDArray[np.int64]
) -> NDArray[np.int64]:
    """Return the edge from each tail to its head, -1 where there is none."""
    edges = np.full(len(tails), -1)
    pending = np.flatnonzero((tails >= 0) & (tails < roadmap.n_vertices))
    edge = roadmap.indptr[tails[pending]].astype(np.int64)
    while len(pending):
        inside = edge < roadmap.indptr[tails[pending] + 1]
        pending, edge = pending[inside], edge[inside]
        hit = roadmap.heads[edge] == heads[pending]
        edges[pending[hit]] = edge[hit]
        pending, edge = pending[~hit], edge[~hit] + 1
    return edges


def _measure_drives(
    plan: Plan, robot: NDArray[np.int64], edge: NDArray[np.int64], integers: np.dtype[Any]
) -> NDArray[Any]:
    """Return the ticks of each edge for its robot, 0 where there is none, -1 where it is barred."""
    paces: dict[tuple[int, ...], int] = {}
    pace_of = [
        paces.setdefault(itinerary.edge_ticks, len(paces))
        for itinerary in plan.scenario.problem.itineraries
    ]
    ticks = np.array(list(paces), integers)
    drive = np.zeros(len(edge), integers)
    driven = edge >= 0
    classes = plan.scenario.roadmap.class_of_edge[edge[driven]]
    drive[driven] = ticks[np.array(pace_of)[robot[driven]], classes]
    return drive
