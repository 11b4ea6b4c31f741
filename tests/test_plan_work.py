"""Jobs become plans: every assignment is planned and judged, and the best judged plan is kept."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Any

import pytest

from benchmarks.deliveries_with_batteries import make_scenario, measure_cost
from rightofway import check, improve, solve
from rightofway.check import Report
from rightofway.deadline import NO_DEADLINE, Deadline
from rightofway.errors import GaveUp, InputError, NoPlanExists
from rightofway.facts import Fact
from rightofway.io import format_plan, parse_plan, parse_scenario
from rightofway.metrics import (
    compute_lost_time,
    derive_outcome,
    list_job_times,
    measure,
    waits,
)
from rightofway.model import Objective, OutcomeKind, Plan, PlannerRun
from rightofway.model.scenario import assign_tours
from rightofway.model.work import Assignment
from rightofway.plan_work import measure_work, plan_work
from rightofway.planners import PlanRequest, find
from tests.builders.planned_jobs import make_plan
from tests.builders.work_scenarios import draw_work_document


def make_document(jobs: Sequence[dict[str, Any]]) -> dict[str, Any]:
    """Return a scenario of two robots on an open floor."""
    return {
        "format": "rightofway-scenario/1",
        "map": {"grid": ["......"] * 3},
        "robots": [{"name": "R1", "home": "N0"}, {"name": "R2", "home": "N17"}],
        "jobs": list(jobs),
        "rules": {"turn": 0},
    }


def carry(name: str, pickup: int, dropoff: int, **more: Any) -> dict[str, Any]:
    """Return a job from one vertex to another."""
    return {"name": name, "pickup": f"N{pickup}", "dropoff": f"N{dropoff}", **more}


def refuse_above(most: int, scenario: Any) -> Any:
    """Return a planner of tours that finds no plan for more than some jobs."""

    def plan_tours(
        assignment: Assignment, _: Deadline, seed: int, __: object
    ) -> tuple[Plan, Report]:
        if len({item.job for tour in assignment.tours for item in tour}) > most:
            raise GaveUp(Fact("time over without a plan"))
        toured, spec = assign_tours(scenario, assignment.tours), find("prioritized")
        draft = spec.load()(PlanRequest(scenario=toured, options=spec.settle({}), seed=seed))
        run = PlannerRun(name="prioritized", options={}, seed=seed)
        plan = Plan(scenario=toured, tracks=draft.tracks, run=run, unserved=assignment.unserved)
        return plan, check(plan)

    return plan_tours


def test_jobs_are_divided_among_robots_that_are_near() -> None:
    """Each robot does the job at its side of the floor."""
    plan = solve(parse_scenario(make_document([carry("J1", 1, 3), carry("J2", 16, 14)])))
    assert check(plan).ok
    assert [job.robot for job in list_job_times(plan)] == [0, 1]
    assert plan.unserved == ()


def test_times_and_orders_of_jobs_are_kept() -> None:
    """A job waits for `earliest` and for those before it; one that is too late is not served."""
    jobs = [
        carry("J1", 1, 3, earliest=9),
        carry("J2", 16, 14, after=["J1"]),
        carry("J3", 5, 0, latest=1),
    ]
    plan = solve(parse_scenario(make_document(jobs)))
    first, second = list_job_times(plan)
    assert first.begin >= 9
    assert second.begin >= first.end
    assert plan.unserved == ((2, "latest"),)


@pytest.mark.parametrize(
    ("job", "reason"),
    [
        ({"pickup": "N1", "dropoff": "N3", "load": 2}, "robot"),  # capacities are 1
        ({"at": "N1", "robot": "R2", "types": ["fork"]}, "robot"),  # R2 has no type
        ({"at": "N5"}, "way"),  # a wall is before the last column
        ({"at": "N3", "robot": "R1"}, "battery"),  # 2 x 3 edges need more than 5 of them
        ({"at": "N3", "robot": "R2", "latest": 1}, "latest"),  # 4 edges away
        ({"at": "N1", "after": ["J0"]}, "after"),
    ],
)
def test_unserved_jobs_have_their_reason(job: dict[str, Any], reason: str) -> None:
    """R1 is at N0, and R2 two rows below; J0 is for nobody."""
    nobody = {"name": "J0", "at": "N2", "types": ["crane"]}
    document = make_document([nobody, {"name": "J1", **job}])
    document["map"] = {"grid": ["....@.", "....@.", "....@."]}
    document["batteries"] = {"tank": {"drive": "1/5"}}
    document["robots"] = [
        {"name": "R1", "home": "N0", "battery": "tank"},
        {"name": "R2", "home": "N13"},
    ]
    plan = solve(parse_scenario(document))
    assert plan.unserved == ((0, "robot"), (1, reason))


def test_time_until_a_job_may_begin_is_not_lost() -> None:
    """A robot that waits for `earliest` waits for nobody: its job ends as soon as it can."""
    plan = solve(parse_scenario(make_document([carry("J1", 1, 3, earliest=30)])))
    assert [lost.lost for lost in compute_lost_time(plan)] == [0, 0]
    assert derive_outcome(plan).kind is OutcomeKind.OPTIMAL


def test_a_job_that_no_robot_can_end_in_time_does_not_prevent_the_proof() -> None:
    """J2 ends at tick 5 at the earliest; without it, J1 ends at tick 3 on R1: 1 + 2 drives."""
    plan = solve(parse_scenario(make_document([carry("J1", 1, 3), carry("J2", 5, 0, latest=4)])))
    outcome = derive_outcome(plan)
    assert plan.unserved == ((1, "latest"),)
    assert (outcome.kind, outcome.objective, outcome.bound) == (
        OutcomeKind.OPTIMAL,
        Objective.SERVICE,
        3,
    )


@pytest.mark.parametrize(
    ("objective", "kind"), [("flowtime", Objective.FLOWTIME), ("makespan", Objective.MAKESPAN)]
)
def test_bounds_are_of_the_objective_of_the_rules(objective: str, kind: Objective) -> None:
    """R1 drives 3 edges to the drop-off and 3 home; the flowtime of R2, which stays, is 0."""
    document = make_document([carry("J1", 1, 3)])
    document["rules"]["objective"] = objective
    outcome = derive_outcome(solve(parse_scenario(document)))
    assert (outcome.kind, outcome.objective, outcome.bound) == (OutcomeKind.OPTIMAL, kind, 6)


def test_a_plan_with_jobs_keeps_its_proof_in_a_file() -> None:
    """The bound and the objective are those of the run."""
    plan = solve(parse_scenario(make_document([carry("J1", 1, 3)])))
    assert derive_outcome(parse_plan(json.loads(format_plan(plan)))) == plan.run.outcome


def test_a_robot_that_waits_for_the_job_of_another_names_that_robot() -> None:
    """R1 stands at N1 until R2 has ended J1; it makes no detour."""
    jobs = [carry("J1", 2, 10) | {"robot": "R2"}, {"name": "J2", "at": "N1", "after": ["J1"]}]
    document = make_document(jobs) | {"map": {"grid": ["....", ".@.@", "...."]}}
    document["robots"] = [{"name": "R1", "home": "N0"}, {"name": "R2", "home": "N3"}]
    plan = solve(parse_scenario(document))
    first = compute_lost_time(plan)[0]
    (loss,) = first.losses
    assert (loss.kind, loss.for_robot, loss.vertex) == ("waits for job", 1, 1)
    assert loss.ticks == first.waiting == first.lost == measure(plan).waiting
    assert [(wait.tick, wait.ticks, wait.for_robot) for wait in waits(plan)] == [
        (loss.tick, loss.ticks, 1)
    ]
    assert loss.end == list_job_times(plan)[0].end


def test_fewer_jobs_are_planned_where_all_of_them_have_no_plan() -> None:
    """The heaviest jobs are kept at first; the others move into that plan, if routes allow it."""
    jobs = [carry("J1", 1, 3), carry("J2", 4, 5, weight=5), carry("J3", 16, 14, after=["J1"])]
    scenario, plans = parse_scenario(make_document(jobs)), list[Plan]()
    plan = plan_work(scenario, refuse_above(1, scenario), deadline=NO_DEADLINE, better=plans.append)
    assert [job.job for job in list_job_times(plans[0])] == [1]
    assert dict(plans[0].unserved)[2] in {"after", "not found"}
    assert check(plan).ok
    assert plan.unserved == ()


def test_robots_make_room_for_a_job_that_needs_it() -> None:
    """R1 is at home where R2 has to unload; it has to leave first, and to come back."""
    document = make_document([carry("J1", 3, 2)]) | {"map": {"grid": ["...."]}}
    document["robots"] = [{"name": "R1", "home": "N2"}, {"name": "R2", "home": "N3"}]
    document["jobs"][0]["robot"] = "R2"
    plan = solve(parse_scenario(document))
    assert plan.unserved == ()
    assert check(plan).ok


def test_a_fleet_without_any_plan_has_the_error_of_its_planner() -> None:
    """Not even robots that stay at home: the planner gave up for another reason."""
    scenario = parse_scenario(make_document([carry("J1", 1, 3)]))
    with pytest.raises(GaveUp):
        plan_work(scenario, refuse_above(-1, scenario), deadline=NO_DEADLINE)


def test_begun_jobs_are_never_left_out() -> None:
    """A battery that does not last for the rest of a begun job leaves no plan."""
    document = make_document([carry("J1", 1, 5)])
    document["batteries"] = {"tank": {"drive": "1/10"}}
    start = {"at": "N1", "soc": "1/5", "begun": {"J1": 1}}
    document["robots"][0] |= {"battery": "tank", "start": start}
    with pytest.raises(GaveUp, match="begun jobs"):
        solve(parse_scenario(document))


@pytest.mark.parametrize("planner", ["lns", "prioritized"])
def test_a_search_that_ends_early_does_not_speak_of_time(planner: str) -> None:
    """R1 stands where R2 has to go with its load, and cannot let it pass."""
    document = make_document([carry("J1", 1, 3)]) | {"map": {"grid": ["...."]}}
    document["robots"] = [
        {"name": "R1", "home": "N3"},
        {"name": "R2", "home": "N0", "start": {"at": "N1", "begun": {"J1": 1}}},
    ]
    with pytest.raises(GaveUp, match="though time was left"):
        solve(parse_scenario(document), planner)


def test_robots_that_stand_in_each_others_ways_make_room() -> None:
    """Whoever does J2 has to pass the other robot twice, at the only place where the lane forks."""
    places = [("N0", 1), ("N0", 0), ("N6", -1), ("N5", 0)]
    stops = [{"at": place, "load": load} for place, load in places]
    jobs: list[dict[str, Any]] = [
        {"name": "J1", "at": "N5"},
        {"name": "J2", "stops": stops, "after": ["J1"]},
    ]
    document = make_document(jobs) | {"map": {"grid": [".@", ".@", "..", ".@"]}}
    document["robots"] = [{"name": "R1", "home": "N4"}, {"name": "R2", "home": "N2"}]
    document["rules"] = {"occupancy": "both", "headway": 1, "turn": 0}
    plan = solve(parse_scenario(document))
    assert check(plan).ok
    assert not plan.unserved
    assert "in waves" in str(plan.run.status)


def test_robots_that_cannot_pass_each_other_have_no_plan_whatever_they_do() -> None:
    """Both have to go to the other end of a lane. Jobs could be left out, the way home cannot."""
    document = make_document([{"name": "J1", "at": "N2"}]) | {"map": {"grid": ["....."]}}
    document["robots"] = [
        {"name": "R1", "home": "N0", "start": {"at": "N4"}},
        {"name": "R2", "home": "N4", "start": {"at": "N0"}},
    ]
    with pytest.raises(NoPlanExists, match="R1 and R2 block each other"):
        solve(parse_scenario(document))


def test_each_better_plan_is_handed_over() -> None:
    """Costs of the plans fall, and the last one is the result."""
    plans: list[Plan] = []
    scenario = parse_scenario(draw_work_document(7, n_robots=3, n_jobs=6))
    best = solve(scenario, on_plan=plans.append)
    costs = [measure_work(plan) for plan in plans]
    assert costs == sorted(costs, reverse=True)
    assert costs[-1] == measure_work(best)


@pytest.mark.parametrize("planner", ["auto", "lns", "prioritized"])
@pytest.mark.parametrize("seed", range(4))
def test_small_fleets_are_planned_and_judged(seed: int, planner: str) -> None:
    """Windows, loads, batteries, orders: each plan keeps all rules."""
    plan = solve(parse_scenario(draw_work_document(seed)), planner)
    assert check(plan).ok


@pytest.mark.slow
@pytest.mark.parametrize("states", [False, True])
def test_many_small_fleets_are_planned_and_judged(states: bool) -> None:
    """Also from states in the middle of a shift."""
    for seed in range(100, 200):
        plan = solve(parse_scenario(draw_work_document(seed, states=states)))
        assert check(plan).ok, seed


def test_tours_learn_the_charge_that_detours_take() -> None:
    """R1 drives around R2, so the charge of its tour has to last longer; all jobs are done."""
    plan = solve(make_scenario(), time_limit=5)
    assert measure_cost(plan) <= 80_058  # [s]: the least that is possible in sequence


def test_an_improved_plan_keeps_its_tours_and_its_unserved_jobs() -> None:
    plan = make_plan()
    better = improve(plan, options={"iterations": 100})
    assert check(better).ok
    assert better.unserved == plan.unserved
    assert [[(item.job, item.stop) for item in tour] for tour in better.tours or ()] == [
        [(item.job, item.stop) for item in tour] for tour in plan.tours or ()
    ]
    assert measure_work(better) <= measure_work(plan)


def test_a_start_is_refused_for_a_scenario_with_jobs() -> None:
    plan = make_plan()
    with pytest.raises(InputError, match="start: is not for a scenario with jobs"):
        solve(plan.scenario, start=plan)
