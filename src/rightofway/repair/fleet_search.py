"""The search for tracks of a fleet, one robot at a time, bound to a task."""

from __future__ import annotations

import numpy as np

from rightofway.repair.impossible import refuse_stranded
from rightofway.repair.task import Task
from rightofway.search import FleetSearch


def make_fleet_search(task: Task) -> FleetSearch:
    """Return the search for a fleet; `NoPlanExists` if a robot cannot do its trip alone."""
    scenario = task.scenario
    search = FleetSearch(
        scenario.problem,
        seed=task.seed,
        alone=task.alone,
        objective=task.objective,
    )
    refuse_stranded(scenario, np.flatnonzero(search.compute_alone() < 0).tolist())
    return search
