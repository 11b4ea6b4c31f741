"""Which jobs a round takes, and what it leaves to later ones."""

from __future__ import annotations

import json
from fractions import Fraction
from typing import Any

from rightofway.dispatch import FleetView, PooledJob, RobotView, RoundPlanner
from rightofway.dispatch.round import JOBS_PER_ROBOT, choose_jobs
from rightofway.facts import read_fact
from rightofway.model import Job, JobStop, Tick, Track
from rightofway.site import VertexId
from tests.builders.shifts import make_scenario

SCENARIO = make_scenario(["......"], {"R1": "N0"}, jobs=[], rules={"patience": 50})


def pool(*jobs: Job) -> dict[str, PooledJob]:
    """Return jobs that are known from the start on."""
    return {job.name: PooledJob(job=job, known=Tick(0)) for job in jobs}


def job(name: str, at: int = 3, earliest: int = 0, **others: Any) -> Job:
    """Return a job of one stop."""
    latest = others.pop("latest", None)
    stop = JobStop(at=VertexId(at), earliest=Fraction(earliest), latest=latest)
    return Job(name=name, stops=(stop,), **others)


def view(takeover: int = 100, **robot: Any) -> FleetView:
    """Return the fleet, R1 at its home."""
    own = RobotView(kept_track=Track.of([0], [-takeover]), **robot)
    return FleetView(now=Tick(takeover), takeover=Tick(takeover), robots=(own,))


def test_begun_jobs_come_first_then_overdue_ones_from_the_oldest_on() -> None:
    jobs = pool(
        job("new", earliest=90),
        job("old", earliest=20),
        job("older", earliest=40, due=Fraction(60)),
        job("begun", earliest=95),
    )
    chosen = choose_jobs(SCENARIO, view(begun=(("begun", 1),)), jobs, {})
    # "older" is overdue since 60, "old" since 20 + 50.
    assert [own.job.name for own in chosen.jobs] == ["begun", "older", "old", "new"]
    assert chosen.overdue == (1, 2)


def test_a_round_does_not_grow_with_the_pool() -> None:
    jobs = pool(*(job(f"J{number:02}", earliest=90) for number in range(20)))
    chosen = choose_jobs(SCENARIO, view(), jobs, {})
    assert len(chosen.jobs) == JOBS_PER_ROBOT
    assert len(chosen.postponed) == 20 - JOBS_PER_ROBOT


def test_a_job_comes_with_those_that_it_follows_or_later() -> None:
    jobs = pool(job("second", earliest=80, after=("first",)), job("first", earliest=90))
    chosen = choose_jobs(SCENARIO, view(), jobs, {})
    assert ([own.job.name for own in chosen.jobs], chosen.postponed) == (["first"], ("second",))
    chosen = choose_jobs(SCENARIO, view(), pool(jobs["second"].job), {"first": "done"})
    assert [own.job.name for own in chosen.jobs] == ["second"]
    chosen = choose_jobs(SCENARIO, view(), pool(jobs["second"].job), {"first": "withdrawn"})
    assert chosen.unserved == (("second", "after"),)


def test_a_job_that_nobody_can_end_in_time_has_that_reason() -> None:
    chosen = choose_jobs(SCENARIO, view(), pool(job("J1", latest=Fraction(99))), {})
    assert chosen.unserved == (("J1", "latest"),)


def test_a_round_without_a_robot_that_drives_keeps_the_old_plan_and_says_why() -> None:
    planned = RoundPlanner(SCENARIO).plan(
        view(is_able=False), pool(job("J1")), over={}, time_limit=None
    )
    assert planned.stands
    assert str(planned.facts[0]) == "the old plan stands: no robot can drive"


def test_a_round_says_with_names_and_times_of_the_shift_why_no_plan_exists() -> None:
    """R1 does not go on: R2 is the only robot of the round, and its times begin at 100."""
    scenario = make_scenario(
        ["......", "......"],
        {"R1": "N11", "R2": "N0"},
        jobs=[],
        closures=[{"at": "N1", "from": 102}, {"at": "N6", "from": 101}],
        units={"time": "s"},
    )
    stuck = RobotView(kept_track=Track.of([11], [-100]), is_able=False)
    away = RobotView(kept_track=Track.of([4], [-100]))
    fleet = FleetView(now=Tick(100), takeover=Tick(100), robots=(stuck, away))
    jobs = pool(job("J1", robot="R2"))
    planned = RoundPlanner(scenario).plan(fleet, jobs, over={}, time_limit=None)
    kept = json.loads(json.dumps(planned.facts[0].as_dict()))
    reason = kept["values"]["reason"]["values"]["fact"]
    assert (reason["kind"], reason["values"]["robot"]) == ("closed in", "R2")
    assert str(read_fact(kept)) == (
        "the old plan stands: R2 cannot make its trip, even alone: N1 is closed from 1 min 42 s on "
        "and N6 is closed from 1 min 41 s on (open one of them earlier, or give the robot other "
        "places)"
    )


def test_a_round_plans_the_route_behind_the_kept_part() -> None:
    seen = RobotView(kept_track=Track.of([0, 1], [-2, 1]), last=1, free=Tick(1))
    fleet = FleetView(now=Tick(100), takeover=Tick(100), robots=(seen,))
    planned = RoundPlanner(SCENARIO).plan(fleet, pool(job("J1")), over={}, time_limit=None)
    # R1 comes to N1 one tick after the takeover, to N3 two ticks later, and drives home.
    (track,) = planned.tracks
    assert track.vertices.tolist() == [1, 2, 3, 2, 1, 0]
    assert track.enter.tolist() == [0, 2, 3, 4, 5, 6]
    ((step,),) = planned.steps
    assert (step.job, step.stop, step.visit, step.begin) == ("J1", 0, 2, 3)
