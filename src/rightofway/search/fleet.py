"""The tracks of a whole fleet: finding first ones, and better ones."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import accumulate, pairwise

import numpy as np
from numpy.typing import NDArray

from rightofway import _core
from rightofway.errors import InputError, quote
from rightofway.kinds.table import SEED, allow_none, make_whole, require_index
from rightofway.model import Objective, Problem, Scenario, Tick, Track
from rightofway.native import bind_native, make_tracks
from rightofway.processes import count_cores


def compute_least_completions(
    scenario: Scenario, *, time_limit: float | None = None
) -> NDArray[np.int64] | None:
    """Return each robot's least completion without the others.

    Parameters
    ----------
    scenario
        The problem.
    time_limit
        When to stop [s].

    Returns
    -------
    ndarray of int64, shape (R,), or None
        Ticks, -1 where no way leads to a place; None if the time limit came first.
    """
    search = _core.FleetSearch(bind_native(scenario.problem), seed=0, n_threads=1)
    return search.alone(time_limit)


_NATIVE = {
    Objective.FLOWTIME: _core.Objective.flowtime,
    Objective.COST: _core.Objective.flowtime,
    Objective.WEIGHTED: _core.Objective.flowtime,
    Objective.MAKESPAN: _core.Objective.makespan,
    Objective.BOTH: _core.Objective.both,
}
"""The problem knows weights and surcharges."""


class FleetSearch:
    """A fleet and its tracks in the native core, while they are improved.

    Parameters
    ----------
    problem
        The trips of the fleet.
    seed
        For all that is drawn.
    threads
        How many threads improve the plan; the plan does not depend on it. None or 0: all cores.
    alone
        The result of `compute_least_completions` for the same trips [ticks], where that is known.
    objective
        The objective of `improve`. Of plans with equal makespan it prefers those of less flowtime.
    horizon
        Tracks may conflict after this tick; each one cut there ends where its robot can stay. None:
        tracks never conflict.
    """

    def __init__(
        self,
        problem: Problem,
        *,
        seed: int = 0,
        threads: int | None = None,
        alone: NDArray[np.int64] | None = None,
        objective: Objective = Objective.FLOWTIME,
        horizon: Tick | None = None,
    ) -> None:
        n_threads = allow_none(make_whole(0, 1024)).read_at("threads", threads)
        self._core = _core.FleetSearch(
            bind_native(problem),
            SEED.read_at("seed", seed),
            n_threads or count_cores(),
            alone,
            _NATIVE[objective],
            horizon,
        )
        self._n_robots = len(problem.itineraries)

    @property
    def native(self) -> _core.FleetSearch:
        """The search in the native core, for other kernels."""
        return self._core

    def compute_alone(self) -> NDArray[np.int64]:
        """Return each robot's least completion without the others [ticks], -1 for no way."""
        alone = self._core.alone()
        assert alone is not None, "there is no time limit"
        return alone

    @property
    def cost(self) -> Tick:
        """The sum of completions and surcharges of all robots with a track [ticks]."""
        return Tick(self._core.cost)

    @property
    def value(self) -> Tick:
        """The value of the objective [ticks]."""
        return Tick(self._core.value)

    @property
    def idle(self) -> int:
        """The number of consecutive calls of `improve` without a gain."""
        return self._core.n_idle

    def prioritize(
        self,
        order: Sequence[int],
        *,
        searches: int,
        time_limit: float | None,
        with_fallback: float | None = None,
    ) -> bool:
        """Give the robots tracks one after another; tell whether all have one.

        Parameters
        ----------
        order
            Every robot once.
        searches
            The most searches before it gives up.
        time_limit
            When to stop [s].
        with_fallback
            When to stop [s] once the greedy attempt has a plan, if that is later.
        """
        with_fallback = time_limit if with_fallback is None else with_fallback
        return self._core.prioritize(self._make_order(order), searches, time_limit, with_fallback)

    def _make_order(self, order: Sequence[int]) -> NDArray[np.int32]:
        for k, robot in enumerate(order):
            require_index(("order", k), robot, self._n_robots)
        return np.array(order, np.int32)

    def resume(self, *, searches: int, time_limit: float | None) -> bool:
        """Continue `prioritize` where it ended; the searches count from its beginning."""
        return self._core.resume(searches, time_limit)

    def compete(self, order: Sequence[int], *, searches: int, time_limit: float | None) -> bool:
        """Plan robots one after another beside the present tracks; take over a better plan.

        Return whether the attempt has ended; another call continues one that has not.

        Parameters
        ----------
        order
            Every robot once.
        searches
            The most searches since the attempt began.
        time_limit
            When to stop [s].
        """
        return self._core.compete(self._make_order(order), searches, time_limit)

    def hurry(self, order: Sequence[int], *, searches: int, time_limit: float | None) -> None:
        """Plan robots greedily, one after another, and take over a better plan.

        Parameters
        ----------
        order, searches
            As for `compete`.
        time_limit
            When to stop without a plan [s].
        """
        self._core.hurry(self._make_order(order), searches, time_limit)

    def move_one_at_a_time(self, *, time_limit: float | None) -> bool:
        """Give robots tracks on which one of them moves at a time; tell whether all have one.

        A robot serves stages until one waits for a stage of another robot, and drives home before
        the next robot moves. Only for a problem with times.

        Parameters
        ----------
        time_limit
            When to stop [s].
        """
        return self._core.move_one_at_a_time(time_limit)

    def start(self, tracks: Sequence[Track | None]) -> None:
        """Take over tracks; robots without one are left to `repair`.

        A ``ValueError`` refuses tracks that break the rules.
        """
        self._core.start(*list_visits(tracks))

    def take_over(
        self, tracks: Sequence[Track | None], order: Sequence[int], *, time_limit: float | None
    ) -> tuple[int, ...]:
        """Start from tracks of an earlier plan; return the robots that have no track now.

        A robot whose track serves its stages keeps it. A track that a robot cannot drive, or that
        overlaps one before it, is left out.

        Parameters
        ----------
        tracks
            One for each robot; None for none. They may miss stages.
        order
            The robots that get new tracks, one after another around all others. Until a robot has
            one, its earlier track stays booked.
        time_limit
            When to stop [s].
        """
        left = self._core.take_over(*list_visits(tracks), self._make_order(order), time_limit)
        return tuple(left.tolist())

    def restore(self, tracks: Sequence[Track]) -> int:
        """Give robots these tracks where that costs nothing; return how many have theirs.

        Large neighbourhood search accepts tracks of equal cost. This restores earlier ones.
        """
        return self._core.restore(*list_visits(tracks))

    def repair(self, order: Sequence[int], *, searches: int, time_limit: float | None) -> bool:
        """Give tracks to the robots without one; tell whether all robots have one.

        A robot in the way of another one loses its track and is planned again, at a rising price.

        Parameters
        ----------
        order
            The robots without a track.
        searches
            The most searches before it gives up.
        time_limit
            When to stop [s].
        """
        return self._core.repair(self._make_order(order), searches, time_limit)

    def improve(
        self,
        tasks: int,
        *,
        patience: int,
        time_limit: float | None = None,
        pause: float | None = None,
    ) -> int:
        """Replan neighbourhoods of a few robots, keep better plans; return the number of gains.

        If this brings no gain for long, the plan becomes one of a population, whose plans are
        crossed with each other.

        Parameters
        ----------
        tasks
            The number of neighbourhoods to replan.
        patience
            The most neighbourhoods in a row without a gain.
        time_limit
            When to stop at once [s].
        pause
            When to stop at the next point that depends on no clock [s].
        """
        return self._core.improve(tasks, patience, time_limit, pause)

    def retime(self) -> None:
        """Shift every visit to the earliest time that keeps the order at each vertex."""
        self._core.retime()

    def list_tracks(self) -> tuple[Track, ...]:
        """Return the tracks; every robot has one."""
        return tuple(make_tracks(*self._core.tracks()))

    def list_known_tracks(self) -> tuple[Track | None, ...]:
        """Return the tracks, and None for robots without one."""
        first, vertices, enter = self._core.tracks()
        return tuple(
            Track(vertices=vertices[a:b], enter=enter[a:b]) if a < b else None
            for a, b in pairwise(first.tolist())
        )


def list_visits(
    tracks: Sequence[Track | None],
) -> tuple[NDArray[np.int32], NDArray[np.int32], NDArray[np.int64]]:
    """Return where each robot's visits begin, their vertices, and when they begin."""
    for k, track in enumerate(tracks):
        if track is not None and not isinstance(track, Track):
            raise InputError.at(("tracks", k), f"{quote(track)} is no track")
    known = [track for track in tracks if track is not None]
    lengths = [0 if track is None else len(track) for track in tracks]
    return (
        np.array([0, *accumulate(lengths)], np.int32),
        np.concatenate([np.zeros(0, np.int32), *(track.vertices for track in known)]),
        np.concatenate([np.zeros(0, np.int64), *(track.enter for track in known)]),
    )
