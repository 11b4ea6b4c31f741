"""Lower bounds of all plans of a fleet; the longer it takes, the higher.

Two methods, in turn. Conflict-based search adds what pairs of robots lose to each other, and goes
on to the optimum where it can: strong for small fleets and in one-wide aisles. Prices of places
take all robots together: strong on full floors.

References
----------
Held, Wolfe & Crowder, *Validation of subgradient optimization*, Mathematical Programming 6, 1974.

Lam, Le Bodic, Harabor & Stuckey, *Branch-and-cut-and-price for multi-agent path finding*, Computers
& Operations Research 144, 2022.
"""

from __future__ import annotations

from rightofway.deadline import Deadline
from rightofway.errors import NoPlanExists
from rightofway.model import Proof, Scenario, Tick
from rightofway.model.outcome import minimized
from rightofway.search import ConflictBasedSearch, PriceAscent

SHARE = 0.3
"""The part of the time for conflict-based search."""


def prove_bound(
    scenario: Scenario, *, time_limit: float | None = None, nodes: int = 0, steps: int = 0
) -> tuple[Proof, bool]:
    """Prove a lower bound of what planners minimize; the longer, the higher.

    Returns
    -------
    tuple of (Proof, bool)
        The bound, and whether there is a plan that reaches it.

    Raises
    ------
    NoPlanExists
        If that is proven.
    """
    deadline = Deadline.after(time_limit)
    search = ConflictBasedSearch(scenario.problem)
    search.run(nodes=nodes or None, time_limit=deadline.shorten(SHARE).measure_seconds_left())
    if search.bound is None:
        raise NoPlanExists("the tree of constraints ends without a plan")
    least, is_reached = search.bound, search.tracks is not None
    if not is_reached:
        least = max(least, compute_price_bound(scenario, deadline, steps))
    return Proof(bound=least, objective=minimized(scenario)), is_reached


def compute_price_bound(scenario: Scenario, deadline: Deadline, steps: int) -> Tick:
    """Return a lower bound by prices of places."""
    prices = PriceAscent(scenario.problem)
    prices.run(steps=steps or None, time_limit=deadline.measure_seconds_left())
    return prices.bound
