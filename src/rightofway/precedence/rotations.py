"""Rotations in a plan: three or more robots that move round a circle at one instant.

Each of them enters the vertex that the next one leaves. The order of visits decides it: an order
that has a rotation has one at all times that keep it. Searches that plan one robot among all others
close no rotation (`find_earliest_track`); rights of way are given to pairs of robots, so they are
looked at as a whole here. The judge has its own look.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rightofway.model import Problem, Track

FEWEST = 3
"""Robots of a rotation; two exchange their places."""


def find_rotation(problem: Problem, tracks: Sequence[Track]) -> tuple[int, ...]:
    """Return the robots of a rotation that the rules forbid, in its order; empty if there is none.

    Parameters
    ----------
    problem
        The problem; its rules may allow rotations, or bookings forbid them anyway.
    tracks
        Of all robots, without conflicts other than rotations and swaps.
    """
    rules = problem.booking_rules
    if rules.rotations or not rules.may_follow or len(tracks) < FEWEST:
        return ()
    robot = np.repeat(np.arange(len(tracks)), [len(track) - 1 for track in tracks])
    tick = np.concatenate([track.enter[1:] for track in tracks]).astype(np.int64)
    tail, head = (
        np.concatenate([track.vertices[part] for track in tracks]).astype(np.int64)
        for part in (slice(None, -1), slice(1, None))
    )
    keys = tick * problem.roadmap.n_vertices  # of a vertex at an instant
    order = np.argsort(keys + tail, kind="stable")
    left, entered = (keys + tail)[order], (keys + head)[order]
    at = np.minimum(np.searchsorted(left, entered), len(left) - 1)
    following = np.where(left[at] == entered, at, -1)  # the move out of the vertex that it enters
    while (ends := (following >= 0) & (following[following] < 0)).any():
        following[ends] = -1  # a queue has an end, a circle none
    robots, seen = robot[order], set[int]()
    for begin in np.flatnonzero(following >= 0).tolist():
        circle, move = list[int](), begin
        while move not in seen:
            seen.add(move)
            circle.append(move)
            move = int(following[move])
        if move in circle and len(circle) - circle.index(move) >= FEWEST:
            return tuple(int(robots[part]) for part in circle[circle.index(move) :])
    return ()
