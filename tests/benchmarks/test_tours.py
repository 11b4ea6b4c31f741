"""PyVRP as a second opinion on tours: two searches for one optimum, without a map."""

from __future__ import annotations

from dataclasses import replace

import pytest

from benchmarks.tours import draw_instance, run_pyvrp, search
from rightofway.model.work import Work

pytest.importorskip("pyvrp", reason="PyVRP is a yardstick only")


def take_jobs(work: Work, n_jobs: int) -> Work:
    """Return the first jobs alone."""
    return replace(work, jobs=work.jobs[:n_jobs])


@pytest.mark.parametrize("seed", range(3))
def test_small_instances_have_the_least_flowtime_that_pyvrp_finds(seed: int) -> None:
    work, travel = draw_instance(seed)
    work = take_jobs(work, 12)

    *_, (_, cost) = search(work, travel, 1)
    unserved, flowtime = run_pyvrp(work, travel, 1)

    assert (cost.unserved, cost.value) <= (unserved, flowtime)


@pytest.mark.parametrize("seed", range(3))
def test_jobs_of_one_stop_have_the_flowtime_that_pyvrp_finds(seed: int) -> None:
    work, travel = draw_instance(seed)
    jobs = tuple(
        replace(job, stops=(replace(job.stops[-1], load=0),), earliest=job.stops[-1].earliest)
        for job in work.jobs[:14]
    )
    work = replace(work, jobs=jobs)

    *_, (_, cost) = search(work, travel, 1)

    assert (cost.unserved, cost.value) == run_pyvrp(work, travel, 1)
