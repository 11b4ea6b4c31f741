"""All visits of a plan side by side in flat arrays, with the edges driven between them."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import chain
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rightofway.check.turning import compute_turns
from rightofway.model import Plan
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

    robot: NDArray[np.int64]
    vertex: NDArray[np.int64]
    enter: NDArray[Any]  # [ticks]
    leave: NDArray[Any]  # [ticks]; a last visit leaves later than anything happens
    last: NDArray[np.bool_]  # whether it is its robot's last visit
    known: NDArray[np.bool_]  # whether the roadmap has the vertex
    edge: NDArray[np.int64]  # to the robot's next visit, -1 without one
    drive: NDArray[Any]  # of that edge for that robot, 0 without one or if barred [ticks]
    barred: NDArray[np.bool_]  # whether that edge is barred for that robot
    angle: NDArray[np.int64]  # that the robot turns before that drive [1e-6 degrees]
    turn: NDArray[Any]  # how long that turn takes [ticks]


def lay_out_visits(plan: Plan) -> Visits:
    """Lay out the visits of a plan, however wrong it is."""
    lengths = np.array([len(track) for track in plan.tracks])
    vertex = np.concatenate([track.vertices for track in plan.tracks]).astype(np.int64)
    enter = np.concatenate([track.enter for track in plan.tracks])
    enter = enter.astype(_integers(plan, enter))
    last = np.zeros(len(vertex), bool)
    last[np.cumsum(lengths) - 1] = True
    robot = np.repeat(np.arange(len(lengths)), lengths)
    roadmap = plan.scenario.roadmap
    edge = _edges(roadmap, vertex, np.where(last, -1, np.roll(vertex, -1)))
    drive = _drives(plan, robot, edge, enter.dtype)
    angle, turn = compute_turns(plan, robot, vertex, edge)
    return Visits(
        robot=robot,
        vertex=vertex,
        enter=enter,
        leave=np.where(last, enter.max() + 1, np.roll(enter, -1)),
        last=last,
        known=(vertex >= 0) & (vertex < roadmap.n_vertices),
        edge=edge,
        drive=np.maximum(drive, 0),
        barred=np.array(drive < 0, bool),
        angle=angle,
        turn=turn.astype(enter.dtype),
    )


def _integers(plan: Plan, enter: NDArray[np.int64]) -> np.dtype[Any]:
    problem = plan.scenario.problem
    edge_ticks: Iterable[int] = chain.from_iterable(
        {itinerary.edge_ticks for itinerary in problem.itineraries}
    )
    largest = max(int(enter.max()), -int(enter.min()), problem.booking_rules.headway, *edge_ticks)
    return np.dtype(np.int64 if largest < SAFE else object)


def _edges(
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


def _drives(
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
