"""The least makespan by conflict-based search, and the least sum of makespan and flowtime.

A tree whose tracks may not complete after some tick has the plan of least flowtime among those
within that tick, or the proof that there is none.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction

from rightofway.model import Objective, Tick, Track, compute_completions
from rightofway.repair.plan_request import PlanRequest
from rightofway.search import ConflictBasedSearch, compute_least_completions

SHARE_OF_TREE = 0.5
"""The part of the time left for one tree."""

Trees = Callable[[int | None], ConflictBasedSearch]
"""Makes a tree whose tracks may not complete after a tick; None for any tick."""


def measure_alone(request: PlanRequest) -> list[int]:
    """Return the least completion of each robot without the others [ticks]."""
    alone = request.alone
    if alone is None:
        alone = compute_least_completions(request.scenario)
    assert alone is not None, "there is no time limit"
    return [int(ticks) for ticks in alone]


@dataclass
class MakespanSearch:
    """A plan, the best so far, and its proof.

    Attributes
    ----------
    tracks
        The plan.
    bound
        No plan has a smaller value of the objective [ticks].
    n_nodes
        The nodes of all trees.
    """

    request: PlanRequest
    trees: Trees
    tracks: tuple[Track, ...]
    nodes: int
    factor: Fraction = Fraction(1)
    n_nodes: int = 0

    def __post_init__(self) -> None:
        alone = measure_alone(self.request)
        self._objective = self.request.objective
        self._weights = self.request.scenario.problem.weights
        self._longest = max(alone)
        self.bound = self._objective.compute_values(self._weights, alone)[0]
        self._left = self.nodes or None

    @property
    def value(self) -> Tick:
        """The value of the plan [ticks]."""
        return self.request.measure_worth(self.tracks)[0]

    def run(self) -> None:
        """Search until the plan is proven, or time or nodes are used up."""
        try:
            if self._objective is Objective.MAKESPAN:
                self._search_by_halves()
            else:
                self._search_downwards()
        except KeyboardInterrupt:
            if not self.request.keep_best:
                raise

    def _search_by_halves(self) -> None:
        """Halve the ticks between the last robot alone and the best plan.

        Where a tree ends undecided, only later ticks are tried.
        """
        best = self.value
        # Bisection between the proven bound and the best plan. A tree that ends without a plan
        # proves that none completes by `latest`; a tree that ran out of nodes proves nothing, and
        # only moves `tried`.
        tried = latest = self.bound  # no tick is tried again
        while tried < best and best > self.factor * self.bound:
            tree = self._make_grown_tree(latest, None)
            if tree is None:
                return
            if tree.tracks is not None:
                self._take(tree.tracks)
                best = self.value
            else:
                if tree.is_proven:
                    self.bound = latest + 1
                tried = latest + 1
            latest = (tried + best - 1) // 2

    def _search_downwards(self) -> None:
        """Take the plan of least flowtime, then that among the plans of less makespan, and so on.

        Plans within a tick have at least the flowtime of those within a later one. So the bound of
        a tree, with the makespan of the last robot alone, holds for all plans that are left.
        """
        latest: int | None = None
        # Each plan of less makespan may have more flowtime. So plans are visited by makespan, from
        # the largest down, and a tree is only asked for plans that are better in the sum.
        share = sum(self._weights) * self._longest
        while self.value > self.factor * self.bound:
            tree = self._make_grown_tree(latest, self.value - share)
            if tree is None:
                return
            if tree.is_proven and tree.tracks is None:
                self.bound = self.value
                return
            # The makespan is at least that of the robot that is last alone, whatever the tree
            # found.
            self.bound = min(self.value, max(self.bound, share + (tree.bound or 0)))
            if tree.tracks is None:
                return
            self._take(tree.tracks)
            latest = max(compute_completions(self.request.scenario, tree.tracks)) - 1
            if latest < self._longest:
                self.bound = self.value
                return

    def _make_grown_tree(self, latest: int | None, upper: int | None) -> ConflictBasedSearch | None:
        """Return a tree that is grown; None where no time or no node is left."""
        seconds = self.request.deadline.shorten(SHARE_OF_TREE).measure_seconds_left()
        if seconds == 0 or (self._left is not None and self._left <= 1):
            return None
        tree = self.trees(latest)
        tree.run(upper=upper, nodes=self._left and -(-self._left // 2), time_limit=seconds)
        self.n_nodes += tree.n_nodes
        self._left = self._left and self._left - tree.n_nodes
        return tree

    def _take(self, tracks: tuple[Track, ...]) -> None:
        """Keep a plan where it is better."""
        if self.request.measure_worth(tracks) < self.request.measure_worth(self.tracks):
            self.tracks = tracks
            self.request.better(lambda: tracks)
