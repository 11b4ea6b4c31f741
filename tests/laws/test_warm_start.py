"""A plan that starts from the plan of another scenario keeps all rules, and never loses for it."""

from __future__ import annotations

import random
from dataclasses import replace

from hypothesis import strategies as st

import rightofway
from rightofway.errors import InputError
from rightofway.io import parse_scenario
from rightofway.model import Plan, Scenario, compute_cost
from rightofway.planners import Feature, find_all
from tests.builders.any_fleet import any_fleet
from tests.builders.any_plan import STRICT, broken, by_both_judges, planned
from tests.builders.changes import CHANGES
from tests.builders.fleets import random_fleet
from tests.builders.laws import law, leave, once

STARTERS = sorted(name for name, spec in find_all().items() if Feature.IMPROVES in spec.features)
"""Planners that can start from a plan."""

planners, starters = st.sampled_from(STRICT), st.sampled_from(STARTERS)
changes, seeds = st.sampled_from(sorted(CHANGES)), st.integers(0, 2**32 - 1)


def changed(old: Plan, change: str, chance: int) -> Scenario:
    """Return the scenario of a plan after a change."""
    try:
        return CHANGES[change](old.scenario, random.Random(chance))  # noqa: S311
    except (InputError, IndexError):  # homes too near to each other, or no free place
        leave("the change does not fit to the fleet")


CLOSED_SOON = parse_scenario(
    {
        "format": "rightofway-scenario/1",
        "map": {
            "roadmap": {
                "vertices": {"A": [1, 1], "B": [0, 0], "C": [6, 1], "D": [2, 0]},
                "edges": [["A", "B", 1.5], ["A", "C", 5], ["A", "D", 1.5]],
            }
        },
        "robots": [{"name": "R1", "home": "C", "stops": [{"at": "D"}, {"at": "A"}]}],
        "rules": {"rotations": False},
    }
)
"""Its robot leaves as a closure begins: the headway of planning without rotations has no tick."""


@law(any_fleet(), planners, changes, starters, seeds)
@once(fleet=CLOSED_SOON, planner="auto", change="something closed", starter="auto", chance=0)
def test_plans_of_changed_scenarios_keep_all_rules(
    fleet: Scenario, planner: str, change: str, starter: str, chance: int
) -> None:
    old = planned(fleet, planner)
    plan = planned(changed(old, change, chance), starter, start=old)
    assert by_both_judges(plan) == (set(), set())
    assert plan.run.start is not None
    assert plan.run.start.tracks <= plan.run.start.routes <= len(plan.tracks)


WITHOUT_ROTATIONS = parse_scenario(
    {
        "format": "rightofway-scenario/1",
        "map": {"grid": ["........", "@...@.@@", "........", ".....@.@", ".@@.....", "......@."]},
        "robots": [
            {"name": "R1", "home": "N0", "target": "N1", "work": 0},
            {"name": "R2", "home": "N1", "target": "N0", "work": 0},
        ],
        "rules": {"occupancy": "both", "rotations": False},
    }
)
"""Local search needs no headway here; retimed with a headway of one tick, its plan is worse."""


@law(any_fleet(), planners, starters)
@once(fleet=WITHOUT_ROTATIONS, planner="local-search", starter="auto")
def test_a_plan_of_the_same_scenario_is_at_least_as_good(
    fleet: Scenario, planner: str, starter: str
) -> None:
    old = planned(fleet, planner)
    new = planned(replace(fleet), starter, start=old)
    assert compute_cost(new.scenario, new.tracks) <= compute_cost(old.scenario, old.tracks)


# On grids, where robots turn for as long as they drive a cell. On lanes a robot that has made room
# at its home may not keep that route, and no text promises that it does.
@law(st.integers(0, 10**6).map(lambda seed: random_fleet(seed, robots=6)), planners)
def test_the_unit_of_speed_and_work_does_not_matter(fleet: Scenario, planner: str) -> None:
    """Half as fast with twice the work is the same plan in ticks of twice the length."""
    old = planned(fleet, planner)
    slow = tuple(
        replace(
            robot,
            speed=robot.speed / 2,
            stops=tuple(replace(stop, work=2 * stop.work) for stop in robot.stops),
        )
        for robot in fleet.robots
    )
    new = planned(replace(fleet, robots=slow), "lns", start=old)
    tick, old_tick = (one.scenario.problem.clock.tick for one in (new, old))
    assert new.flowtime * tick <= 2 * old.flowtime * old_tick


@law(any_fleet(), planners, changes, seeds)
def test_the_same_seed_gives_the_same_plan_from_the_same_start(
    fleet: Scenario, planner: str, change: str, chance: int
) -> None:
    old = planned(fleet, planner)
    new = changed(old, change, chance)
    one, other = (planned(new, "auto", chance, start=old) for _ in range(2))
    assert one.tracks == other.tracks


@law(any_fleet(), planners, seeds)
def test_an_old_plan_with_faults_does_no_harm(fleet: Scenario, planner: str, chance: int) -> None:
    """Other vertices, other times: whatever the old plan is, the new one keeps all rules."""
    old, draw = planned(fleet, planner), random.Random(chance)  # noqa: S311
    for _ in range(4):
        start = replace(broken(old, draw), scenario=fleet)
        plan = rightofway.solve(fleet, "lns", None, iterations=3, start=start)
        assert by_both_judges(plan) == (set(), set())
