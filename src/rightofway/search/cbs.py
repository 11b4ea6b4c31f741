"""Conflict-based search: a plan of least cost for a whole fleet, or a lower bound of that cost."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import NamedTuple

import numpy as np

from rightofway import _core
from rightofway.errors import InputError
from rightofway.model import NEVER, Problem, Scenario, Tick, Track
from rightofway.model.stays import find_stays
from rightofway.native import bind_native, make_tracks
from rightofway.search.fleet import list_visits

FOUND, PROVEN = 0, 1

MOST_BYTES = 2 * 2**30
"""Memory for nodes and tracks [bytes]."""

UNLIMITED = 2**62

MILLION, MOST_FACTOR = 10**6, 10**6
"""Factors are rounded down to millionths, so that no plan above the factor is enough."""


class JointPlan(NamedTuple):
    """A plan of least cost of some robots without the others, or its proven bound.

    Attributes
    ----------
    has_ended
        Whether the search has found a plan, or has proven that none exists.
    bound
        No plan costs less, by the weights of the robots [ticks]; None where no plan exists in which
        all of them complete within ``latest``.
    tracks
        A plan at that cost, in the order of the robots; None where the search found none.
    """

    has_ended: bool
    bound: Tick | None
    tracks: tuple[Track, ...] | None = None


class ConflictBasedSearch:
    """A search for a plan of least flowtime and surcharges, in the native core.

    Parameters
    ----------
    problem
        The trips of the fleet; every robot can reach its places.
    cardinal
        Whether conflicts that cost both robots something are resolved first.
    bypass
        Whether tracks of equal cost with fewer conflicts replace others without a split.
    clear
        Whether tracks with the fewest conflicts are looked for.
    targets
        Whether conflicts with robots that have reached their ends are resolved as such.
    disjoint
        Whether one child of a conflict requires a robot at its place, and the other excludes it;
        for points without headway.
    pairs
        Whether nodes are split by the completion times of pairs that lose to each other.
    pair_nodes
        Nodes at most to solve each pair of robots, whose losses raise the bounds of nodes; 0: none.
    joint_states
        Joint states at most, and again for each fifty nodes, for all pairs that need more nodes;
        and for each fifty nodes for a whole fleet of at most four robots. 0: no such search.
    factor
        A plan that costs at most this factor times the bound is enough; 1 or more.
    latest
        No robot completes later [ticks]; None for no limit. Only without surcharges.

    Attributes
    ----------
    bound
        No plan costs less [ticks]; None where it is proven that there is no plan.
    tracks
        A plan of least cost, or within the factor of the bound; None until there is one.
    is_proven
        Whether it is proven that `tracks` is within the factor or, without them, that no plan costs
        less than the plan that was known.

    Notes
    -----
    Deterministic where nodes, not time or memory, end the search.
    """

    def __init__(
        self,
        problem: Problem,
        *,
        cardinal: bool = True,
        bypass: bool = True,
        clear: bool = True,
        targets: bool = True,
        disjoint: bool = True,
        pairs: bool = False,
        pair_nodes: int = 20,
        joint_states: int = 10_000,
        factor: Fraction | int = 1,
        latest: int | None = None,
    ) -> None:
        self._core = _core.ConflictBasedSearch(
            bind_native(problem), cardinal, bypass, clear, targets, disjoint, pairs,
            pair_nodes, joint_states, int(min(factor, MOST_FACTOR) * MILLION),
            NEVER if latest is None else latest,
        )  # fmt: skip
        self.bound: Tick | None = Tick(0)
        self.tracks: tuple[Track, ...] | None = None
        self.is_proven = False

    def run(
        self,
        *,
        upper: int | None = None,
        enough: int | None = None,
        nodes: int | None = None,
        time_limit: float | None = None,
    ) -> None:
        """Search until a plan of least cost is found or known to be so, or a limit is reached.

        A search that has proven its bound has ended: another call does nothing.

        Parameters
        ----------
        upper
            The cost of a plan that is known [ticks], no more than in a call before; None for none.
        enough
            Stop as soon as the bound is this or more [ticks].
        nodes
            Stop after this number of nodes.
        time_limit
            When to stop [s].
        """
        if self.is_proven:
            return
        end, least = self._core.run(
            NEVER if upper is None else upper,
            NEVER if enough is None else enough,
            nodes or UNLIMITED,
            MOST_BYTES,
            time_limit,
        )
        self.bound = None if least == NEVER else Tick(least)
        self.is_proven = end in {FOUND, PROVEN}
        if end == FOUND:
            self.tracks = tuple(make_tracks(*self._core.tracks()))

    def search_together(
        self, robots: Sequence[int], *, states: int, time_limit: float | None = None
    ) -> JointPlan:
        """Search the joint states of some robots, alone on the roads.

        Parameters
        ----------
        robots
            Different robots.
        states
            The number of states at most.
        time_limit
            When to stop [s].
        """
        end, least, first_visit, vertices, enter = self._core.search_together(
            np.array(robots, np.int32), states, time_limit
        )
        return JointPlan(
            has_ended=end in {FOUND, PROVEN},
            bound=None if least == NEVER else Tick(least),
            tracks=tuple(make_tracks(first_visit, vertices, enter)) if end == FOUND else None,
        )

    @property
    def n_nodes(self) -> int:
        """The number of nodes expanded."""
        return self._core.n_nodes

    @property
    def n_searches(self) -> int:
        """The number of searches for the track of one robot."""
        return self._core.n_searches


def find_fewest_actions(
    scenario: Scenario,
    tracks: Sequence[Track],
    *,
    latest: int | None = None,
    states: int = 10_000,
    time_limit: float | None = None,
) -> tuple[bool, tuple[Track, ...]]:
    """Return tracks of no higher cost with which robots wait and drive less often.

    A wait is a visit that lasts longer than the work, turns and drive that it is for. Waits and
    drives count alike, so that no robot drives to and fro instead of waiting.

    Parameters
    ----------
    scenario
        The problem.
    tracks
        One for each robot; they keep the rules.
    latest
        No robot completes later [ticks]; None for no limit.
    states
        The number of states of each search at most.
    time_limit
        When to stop [s].

    Returns
    -------
    tuple of (bool, tuple of Track)
        Whether it is proven that no plan of no higher cost has fewer drives and waits, and
        the tracks.

    Notes
    -----
    The joint states of at most four robots are searched. Of more robots, or where that search does
    not end, one robot after the other that waits takes a track with fewer of them among the
    bookings of all others, until none has one. Deterministic without a time limit.
    """
    visits, count = list_visits(tracks), len(scenario.robots)
    if len(tracks) != count:
        raise InputError.at("tracks", f"{len(tracks)} tracks, but {count} robots (give one each)")
    waits = [int((stay.waits > 0).sum()) for stay in find_stays(scenario, tracks)]
    is_proven, first_visit, vertices, enter = _core.fewest_actions(
        bind_native(scenario.problem), *visits, np.array(waits, np.int64),
        NEVER if latest is None else latest, states, time_limit,
    )  # fmt: skip
    return is_proven, tuple(make_tracks(first_visit, vertices, enter))
