"""The search for tracks of a fleet, one robot at a time, bound to a request."""

from __future__ import annotations

import numpy as np

from rightofway.model import Tick
from rightofway.repair.impossible import refuse_stranded
from rightofway.repair.plan_request import PlanRequest
from rightofway.search import FleetSearch


def make_fleet_search(request: PlanRequest, horizon: Tick | None = None) -> FleetSearch:
    """Return the search for a fleet; `NoPlanExists` if a robot cannot do its trip alone.

    Tracks may conflict after the horizon.
    """
    scenario = request.scenario
    search = FleetSearch(
        scenario.problem,
        seed=request.seed,
        alone=request.alone,
        objective=request.objective,
        horizon=horizon,
    )
    refuse_stranded(scenario, np.flatnonzero(search.compute_alone() < 0).tolist())
    return search
