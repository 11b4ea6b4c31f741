"""Plans of tiny fleets with jobs, compared with the optimum by exhaustive search.

``python -m tests.campaigns.optimum_of_jobs FROM TO`` draws fleets with the seeds FROM to TO - 1,
prints those with a worse plan, and counts. Half of the fleets begin anywhere.
"""

from __future__ import annotations

import sys
from collections import Counter
from fractions import Fraction

from rightofway import check, solve
from rightofway.errors import GaveUp, NoPlanExists
from rightofway.io import parse_scenario
from rightofway.metrics import list_job_times
from rightofway.model import Plan
from tests.builders.work_scenarios import draw_work_document
from tests.oracles.work_search import TooLarge, find_best

LIMIT = 5.0
"""For one plan [s]; tiny fleets are ready before."""


def measure_plan(plan: Plan) -> tuple[Fraction, Fraction]:
    """Return the unserved weight and the service cost of a plan [time unit]."""
    jobs, work = plan.scenario.jobs or (), plan.scenario.problem.work
    assert work is not None, "the scenario has jobs"
    cost = sum(
        (jobs[done.job].weight * (done.service_time + work.late * done.late))
        for done in list_job_times(plan)
    )
    unserved = sum((jobs[job].weight for job, _ in plan.unserved), Fraction(0))
    return unserved, cost * plan.scenario.problem.clock.tick


def compare(seed: int) -> str:
    """Return how the plan of a fleet compares with its optimum."""
    document = draw_work_document(
        seed, n_jobs=2, states=bool(seed % 2), windows=bool(seed // 2 % 2)
    )
    scenario = parse_scenario(document)
    try:
        best = find_best(scenario)
    except TooLarge:
        return "not decided"
    try:
        plan = solve(scenario, time_limit=LIMIT)
    except (GaveUp, NoPlanExists) as error:
        return "no plan exists" if best is None else f"missed: {error}"
    assert check(plan).ok, seed
    assert best is not None, f"{seed}: the search has missed a plan"
    own, least = measure_plan(plan), (best.weight, best.cost)
    assert own >= least, f"{seed}: better than the optimum"
    if own == least:
        return "at the optimum"
    print(seed, *map(float, (*own, *least)), flush=True)  # noqa: T201
    return "worse"


def main() -> None:
    """Compare fleets, and count."""
    first, end = map(int, sys.argv[1:])
    counts = Counter(map(compare, range(first, end)))
    for kind, number in counts.most_common():
        print(f"{number} {kind}")  # noqa: T201


if __name__ == "__main__":
    main()
