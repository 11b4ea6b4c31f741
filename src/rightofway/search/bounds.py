"""A lower bound of all plans by prices of places, raised step by step."""

from __future__ import annotations

from rightofway import _core
from rightofway.model import Problem, Tick
from rightofway.native import bind_native

UNLIMITED = 2**62


class PriceAscent:
    """A lower bound of the objective, in the native core while it is raised.

    A vertex has a price at a tick where several robots want it. Each robot takes its cheapest
    track, prices included. The sum of their payments, less the sum of all prices, is a bound of
    plans, because no two robots of a plan pay one price.

    Parameters
    ----------
    problem
        The trips of the fleet; every robot can reach its places.

    Notes
    -----
    Deterministic where steps, not time, end it. Closures, zones, turns on the spot, headway, and
    sizes beyond the place of a robot are not looked at: the bound holds, but is lower.
    """

    def __init__(self, problem: Problem) -> None:
        self._core = _core.PriceAscent(bind_native(problem))

    def run(self, *, steps: int | None = None, time_limit: float | None = None) -> None:
        """Take more steps, until a limit is reached or no step helps.

        Parameters
        ----------
        steps
            The number of steps at most.
        time_limit
            When to stop [s].
        """
        self._core.run(steps or UNLIMITED, time_limit)

    @property
    def bound(self) -> Tick:
        """No plan costs less [ticks]; 0 before the first step."""
        return Tick(self._core.bound)

    @property
    def n_steps(self) -> int:
        """The number of steps taken."""
        return self._core.n_steps
