"""A plan of least cost of a few robots, or the proof that no plan exists, by their joint states.

For robots among closures or barred edges that find no plan one after another. The search goes over
the moves of all robots at each instant (``cpp/cbs/joint_search.hpp``), and it ends also where there
is no plan.

References
----------
Standley, *Finding optimal solutions to cooperative pathfinding problems*, AAAI 2010.

Notes
-----
Complete where it ends: no robot has to work as soon as it comes to its stop. A state counts how
long each robot has stayed at its vertex. The drive that ends the stay decides how many stages the
stay has served: all for which it was long enough, or fewer. So a robot may wait at its stop before
it works, or leave the stop and come back, as others or closures need it.

The search ends undecided after `MOST_STATES` states. The number of states grows with the power of
the number of robots.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from rightofway.errors import GaveUp
from rightofway.facts import Fact
from rightofway.model import Status
from rightofway.repair.impossible import refuse_without_room
from rightofway.repair.plan_request import Draft, PlanRequest

if TYPE_CHECKING:
    from rightofway.search import JointPlan

MOST_STATES, FEW_ROBOTS = 100_000, 4
"""States of a search at most, and the largest fleet that is searched."""

SHARE = 0.3
"""The part of the time for it."""


def plan_by_joint_states(request: PlanRequest) -> Draft | None:
    """Plan a few robots by a search over their joint states; None where it ends undecided.

    Raises
    ------
    NoPlanExists
        With a small set of robots that have no plan.
    """
    # Most fleets never come here: importing the planner must not import the search.
    from rightofway.search import ConflictBasedSearch

    scenario, deadline = request.scenario, request.deadline.shorten(SHARE)
    everybody = range(len(scenario.robots))
    if len(everybody) > FEW_ROBOTS:
        return None

    def search(robots: Sequence[int]) -> JointPlan:
        return ConflictBasedSearch(scenario.problem).search_together(
            robots, states=MOST_STATES, time_limit=deadline.measure_seconds_left()
        )

    def is_blocked(robots: Sequence[int]) -> bool:
        plan = search(robots)
        if not plan.has_ended:
            raise GaveUp(Fact("too many joint states", states=MOST_STATES))
        return plan.tracks is None

    plan = search(everybody)
    if plan.has_ended and plan.tracks is None:
        refuse_without_room(scenario, is_blocked)
    if plan.tracks is None:
        return None
    request.has_plan()
    return Draft(tracks=plan.tracks, status=Status("joint states"))
