"""A rule that forbids rotations forbids them and nothing else."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from hypothesis import strategies as st

import rightofway
from rightofway.check import check
from rightofway.cyclic import find_best_timetable, run_laps
from rightofway.cyclic.to_plan import unroll_laps
from rightofway.errors import GaveUp, InputError, NoPlanExists, RightOfWayError
from rightofway.io import parse_scenario
from rightofway.model import Plan, PlannerRun, Scenario
from rightofway.search import ConflictBasedSearch, JointPlan
from tests.builders.any_fleet import LAPS_REFUSE, any_fleet
from tests.builders.laws import law, leave

PLANNERS = ["lacam", "lns", "prioritized", "two-level", "priority-search", "local-search", "cbs"]

WITHOUT_ROOM = any_fleet(without={"no rotations"}, always={"both"}) | any_fleet(
    without={"no rotations"}, always={"headway"}
)
"""A robot never enters a vertex at the instant at which another one leaves it."""


def forbid_rotations(fleet: Scenario) -> Scenario:
    return replace(fleet, rules=replace(fleet.rules, rotations=False))


def list_enters(fleet: Scenario, planner: str) -> list[list[int]] | str:
    """Return the enters of each robot, or why there is no plan."""
    effort: dict[str, Any] = {"iterations": 50} if planner == "lns" else {}
    try:
        plan = rightofway.solve(fleet, planner, time_limit=20, **effort)
    except InputError:
        leave("the planner refuses the fleet")
    except RightOfWayError as refused:
        return str(refused)
    return [track.enter.tolist() for track in plan.tracks]


@law(WITHOUT_ROOM, st.sampled_from(PLANNERS))
def test_plans_are_equal_where_no_robot_can_follow_at_once(fleet: Scenario, planner: str) -> None:
    assert list_enters(forbid_rotations(fleet), planner) == list_enters(fleet, planner)


@law(
    any_fleet(
        robots=(2, 4),
        without={*LAPS_REFUSE, "no rotations"},
        always={"both"},
        apart=True,
        joined=True,
    )
)
def test_laps_are_equal_where_no_robot_can_follow_at_once(fleet: Scenario) -> None:
    try:
        run = run_laps(fleet, "first-come", time_limit=5)
    except RightOfWayError:
        leave("no laps exist")
    strict = run_laps(forbid_rotations(fleet), "first-come", time_limit=5)
    for group, other in zip(run.groups, strict.groups, strict=True):
        assert [*map(list, other.history)] == [*map(list, group.history)]


@st.composite
def crowds(draw: st.DrawFn) -> Scenario:
    """Return points on small grids, full enough to rotate, that may follow each other at once."""
    rows, columns = draw(st.sampled_from([(2, 2), (2, 2), (2, 3), (2, 3), (3, 3)]))
    cells, are_alike = range(rows * columns), draw(st.booleans())
    count = draw(st.integers(3, min(len(cells), 5)))
    homes, targets = (draw(st.permutations(cells))[:count] for _ in range(2))
    if are_alike:  # each to the next place on a ring, where all could go at once
        ring = [*range(columns), *range(2 * columns - 1, columns - 1, -1)]
        homes = [ring[place] for place in sorted(draw(st.permutations(range(len(ring))))[:count])]
        targets = [ring[(ring.index(home) + 1) % len(ring)] for home in homes]
    robots = [
        {
            "name": f"R{number}",
            "home": f"N{home}",
            "target": f"N{target}",
            "speed": 1 if are_alike else draw(st.sampled_from([1, "1/2"])),
            "work": 0 if are_alike else draw(st.sampled_from([0, 1])),
        }
        for number, (home, target) in enumerate(zip(homes, targets, strict=True))
    ]
    closures = [
        {"at": f"N{draw(st.sampled_from(cells))}", "from": begin, "until": begin + lasts}
        for begin, lasts in draw(
            st.lists(st.tuples(st.integers(1, 5), st.integers(1, 4)), max_size=1)
        )
    ]
    ends = draw(st.sampled_from(["home", "none"]))
    return parse_scenario(
        {
            "format": "rightofway-scenario/1",
            "map": {"grid": ["." * columns] * rows},
            "robots": robots,
            "rules": {"rotations": False, "return": ends, "turn": 0},
            "closures": closures,
        }
    )


def search_joint_states(fleet: Scenario) -> JointPlan:
    """Return the plan of least flowtime, by a search over joint states that knows rotations."""
    search = ConflictBasedSearch(fleet.problem)
    joint = search.search_together(range(len(fleet.robots)), states=200_000, time_limit=5)
    if not joint.has_ended:
        leave("too many joint states")
    return joint


@law(crowds(), st.sampled_from([*PLANNERS, "auto", "random-priority"]))
def test_plans_have_no_rotation_and_what_is_proven_is_true(fleet: Scenario, planner: str) -> None:
    options: dict[str, Any] = {"iterations": 50} if planner in {"lns", "auto"} else {}
    if planner == "auto":
        options["nodes"] = 50
    joint = search_joint_states(fleet)
    try:
        plan = rightofway.solve(fleet, planner, time_limit=20, **options)
    except InputError:
        leave("the planner refuses the fleet")
    except NoPlanExists:
        assert joint.tracks is None
        return
    except GaveUp:
        assert joint.tracks is None or fleet.closures
        return
    assert check(plan).ok  # the judge, once more
    assert joint.tracks is not None
    least = Plan(scenario=fleet, tracks=tuple(joint.tracks), run=PlannerRun())
    assert check(least).ok
    assert plan.lower_bound <= least.flowtime <= plan.flowtime
    if plan.run.outcome is not None and plan.run.outcome.kind == "optimal":
        assert plan.flowtime == least.flowtime


def works_away_from_home(fleet: Scenario) -> bool:
    return all(robot.home != robot.stops[0].at for robot in fleet.robots)


@law(crowds().filter(works_away_from_home), st.booleans())
def test_laps_have_no_rotation(fleet: Scenario, is_chosen: bool) -> None:
    fleet = replace(fleet, closures=(), rules=replace(fleet.rules, ends="home"))
    try:
        if is_chosen:
            run = find_best_timetable(fleet, time_limit=None, rounds=2)
        else:
            run = run_laps(fleet, time_limit=5)
        plan = unroll_laps(run, 4)
    except RightOfWayError as reason:
        leave(type(reason).__name__)
    ends = min(int(track.enter[-1]) for track in plan.tracks)
    assert not [fault for fault in check(plan).faults if fault.tick < ends]
    for group in run.groups:  # only who would rotate keeps a headway
        kept = group.context.booking_rules != fleet.problem.booking_rules
        assert kept == group.context.is_apart
