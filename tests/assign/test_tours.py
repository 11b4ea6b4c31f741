"""Tours: least costs of small work, times, charges and the order of jobs that follow each other."""

from __future__ import annotations

from dataclasses import replace
from statistics import mean
from typing import Any

import numpy as np
import pytest

from rightofway.assign import AssignmentSearch, Travel
from rightofway.model.units import Tick
from rightofway.model.work import Assignment, Work
from tests.builders.any_work import OBJECTIVES, draw_work
from tests.oracles.tours import find_least_cost, judge_tours

KINDS: dict[str, dict[str, Any]] = {
    "plain": {},
    "windows": {"windows": True},
    "begun": {"windows": True, "begun": True},
    "batteries": {"batteries": True, "size": 4},
}


def find(work: Work, travel: Travel, weights: list[int], steps: int = 200) -> AssignmentSearch:
    search = AssignmentSearch(work, travel, weights=weights, seed=1)
    assert search.construct()
    assert search.improve(steps) == steps
    return search


@pytest.mark.parametrize("objective", OBJECTIVES)
@pytest.mark.parametrize("kind", KINDS)
def test_small_work_gets_the_least_cost_of_all_assignments(kind: str, objective: Any) -> None:
    ratios = []
    for seed in range(3 if kind == "batteries" else 25):
        n_jobs = 2 if kind == "batteries" else 1 + seed % 4
        work, travel = draw_work(
            seed, n_jobs=n_jobs, n_robots=2, objective=objective, **KINDS[kind]
        )
        weights = [1 + seed % 3, 2]
        search = find(work, travel, weights)
        least = find_least_cost(work, travel, weights)
        if search.cost.missing:
            assert least is None
            continue

        cost = judge_tours(work, travel, weights, search.assignment)

        assert least is not None
        assert cost == search.cost[1:]
        assert cost[0] == least[0]
        ratios.append((cost[1] + 1) / (least[1] + 1))
    assert mean(ratios) < 1.001


def test_the_same_seed_and_steps_give_the_same_assignment() -> None:
    work, travel = draw_work(3, n_jobs=20, n_robots=3, windows=True)

    first, second = find(work, travel, []), AssignmentSearch(work, travel, seed=1)
    second.construct()
    for _ in range(20):
        second.improve(10)

    assert first.assignment == second.assignment


def test_steps_never_make_the_best_assignment_worse() -> None:
    work, travel = draw_work(4, n_jobs=30, n_robots=3)
    search = AssignmentSearch(work, travel, seed=1)
    search.construct()
    costs = [search.cost]
    for _ in range(30):
        search.improve(10)
        costs.append(search.cost)

    assert costs == sorted(costs, reverse=True)
    assert costs[-1] < costs[0]


def test_an_assignment_is_taken_over_as_a_start() -> None:
    work, travel = draw_work(5, n_jobs=15, n_robots=3, windows=True, after=True)
    old = find(work, travel, [])

    search = AssignmentSearch(work, travel, seed=2)
    search.start(old.assignment)

    assert search.cost == old.cost
    assert search.assignment.tours == old.assignment.tours


def test_delays_of_legs_change_the_assignment() -> None:
    work, travel = draw_work(6, n_jobs=2, n_robots=2)
    work = replace(work, jobs=tuple(replace(job, robots=(0, 1)) for job in work.jobs))
    robots = tuple(replace(robot, capacity=3, ready=Tick(0)) for robot in work.robots)
    work = replace(work, robots=robots)
    travel = replace(travel, kind_of=(0, 1))

    for slow in (0, 1):
        delays = np.zeros_like(travel.ticks)
        delays[slow] = 99
        late = find(work, travel.delay(delays, []), [1, 1])
        assert not late.assignment.tours[slow]


def test_reasons_of_unserved_jobs() -> None:
    work, travel = draw_work(7, n_jobs=5, n_robots=1)
    anywhere, robot = travel.ticks.copy(), work.robots[0]
    jobs = [
        replace(job, robots=(0,), stops=tuple(replace(s, load=0) for s in job.stops[:1]))
        for job in work.jobs
    ]
    jobs[0] = replace(jobs[0], robots=())
    anywhere[:, :, jobs[1].stops[0].vertex] = -1
    ticks = int(travel.ticks[travel.kind_of[0], travel.get_start(0), jobs[2].stops[0].vertex])
    due = Tick(robot.ready + ticks + jobs[2].stops[0].work - 1)
    jobs[2] = replace(jobs[2], stops=(replace(jobs[2].stops[0], latest=due),))
    jobs[3] = replace(jobs[3], after=(0,))
    vertices = [job.stops[0].vertex for job in jobs]
    assert vertices[1] not in {vertices[0], *vertices[2:]}

    search = find(replace(work, jobs=tuple(jobs)), replace(travel, ticks=anywhere), [1])

    assert search.assignment.unserved == ((0, "robot"), (1, "way"), (2, "latest"), (3, "after"))


def test_a_robot_below_its_reserve_charges_first_and_only_as_long_as_needed() -> None:
    for seed in range(200):
        work, travel = draw_work(seed, n_jobs=1, n_robots=1, batteries=True)
        battery = work.robots[0].battery
        assert battery is not None
        search = find(work, travel, [1], steps=20)
        tour = search.assignment.tours[0]
        if battery.soc < battery.reserve and tour:
            assert tour[0].job is None
            shorter = (replace(tour[0], duration=Tick(tour[0].duration - 1)), *tour[1:])
            with pytest.raises(AssertionError):
                judge_tours(work, travel, [1], Assignment(tours=(shorter,)))
            return
    pytest.fail("no robot is below its reserve")
