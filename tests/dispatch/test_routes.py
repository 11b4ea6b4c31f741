"""Routes of a round: robots for which there is no time keep their old tours."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import pytest

from rightofway.dispatch import FleetView, PlannedStep, PooledJob, RobotView, RoundPlanner, routes
from rightofway.dispatch.horizon import cut_tours
from rightofway.dispatch.view import StopsLater
from rightofway.model import Assignment, Job, JobStop, Tick, TourItem, Track
from rightofway.site import VertexId
from tests.builders.shifts import make_scenario

HOMES = {"R1": "N0", "R2": "N4"}
SCENARIO = make_scenario(["....."], HOMES, jobs=[], rules={"return": "none", "rotations": False})


def make_job(name: str, at: int, robot: str | None = None, work: int = 0) -> PooledJob:
    """Return a job of one stop."""
    stop = JobStop(at=VertexId(at), work=Fraction(work))
    return PooledJob(job=Job(name=name, stops=(stop,), robot=robot), known=Tick(0))


def look(vertices: list[int], job: str | None = None, later: StopsLater = ()) -> RobotView:
    """Return a robot that drives on, a vertex each tick, and does a job at the end."""
    times = list(range(len(vertices)))
    end = Tick(times[-1])
    step = PlannedStep(
        visit=times[-1], vertex=VertexId(vertices[-1]), begin=end, end=end, job=job, stop=0
    )
    return RobotView(
        kept_track=Track.of(vertices[:1], [0]),
        track=Track.of(vertices, times),
        steps=() if job is None else (step,),
        later=later,
    )


JOBS_OF_CROWD = {"J1": make_job("J1", 2, "R1"), "J2": make_job("J2", 1, "R2")}
CROWD = FleetView(now=Tick(0), takeover=Tick(0), robots=(look([0, 1, 2], "J1"), look([4])))


@pytest.fixture
def no_repair(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let no robot lose its track to another one."""
    monkeypatch.setattr(routes, "SEARCHES", 0)


@pytest.mark.usefixtures("no_repair")
def test_a_robot_that_finds_no_route_waits_and_others_go_on_with_the_old_plan() -> None:
    # R1 drives to N2 and stays there, so R2 does not come to N1 unless R1 makes room.
    closed = [{"at": "N0", "from": 1000, "until": 1001}]
    scenario = make_scenario(
        ["....."], HOMES, jobs=[], rules={"return": "none", "rotations": False}, closures=closed
    )
    planned = RoundPlanner(scenario).plan(CROWD, JOBS_OF_CROWD, over={}, time_limit=None)
    assert not planned.stands
    assert [[step.job for step in steps] for steps in planned.steps] == [["J1"], []]
    assert planned.tracks[0].vertices.tolist() == [0, 1, 2]
    assert planned.later == ((), (("J2", 0),))
    assert planned.is_hurried
    assert str(planned.facts[0]) == "old tours are kept (1 robot): no route was found in time"


@pytest.mark.usefixtures("no_repair")
def test_where_robots_may_end_anywhere_a_robot_without_a_route_drives_as_far_as_it_can() -> None:
    # R2 waits for R1 at N3, next to its stop, and its job stays in its tour.
    planned = RoundPlanner(SCENARIO).plan(CROWD, JOBS_OF_CROWD, over={}, time_limit=None)
    assert [[step.job for step in steps] for steps in planned.steps] == [["J1"], []]
    assert planned.tracks[0].vertices.tolist() == [0, 1, 2]
    assert planned.tracks[1].vertices.tolist() == [4, 3]
    assert planned.later == ((), (("J2", 0),))
    assert not planned.is_hurried
    assert planned.facts == ()


@pytest.mark.usefixtures("no_repair")
def test_robots_with_new_routes_have_them_while_others_keep_their_old_ones() -> None:
    # J2 waits as above. R3 gets its new job.
    scenario = make_scenario(
        [".....", "@@@@@", "....."],
        {"R1": "N0", "R2": "N4", "R3": "N10"},
        jobs=[],
        rules={"return": "none", "rotations": False},
    )
    jobs = {
        "J1": make_job("J1", 2, "R1"),
        "J2": make_job("J2", 1, "R2"),
        "J3": make_job("J3", 8, "R3"),
    }
    robots = (look([0, 1, 2], "J1"), look([4]), look([5]))
    view = FleetView(now=Tick(0), takeover=Tick(0), robots=robots)
    planned = RoundPlanner(scenario).plan(view, jobs, over={}, time_limit=None)
    assert [[step.job for step in steps] for steps in planned.steps] == [["J1"], [], ["J3"]]
    assert planned.tracks[2].vertices.tolist() == [5, 6, 7, 8]


@pytest.mark.usefixtures("no_repair")
def test_a_job_that_another_robot_takes_leaves_the_old_tour() -> None:
    # J1 is R2's now, which has a route; R1 has no route to its new job behind R2.
    jobs = {"J1": make_job("J1", 3, "R2"), "J2": make_job("J2", 4, "R1")}
    view = FleetView(now=Tick(0), takeover=Tick(0), robots=(look([0, 1], "J1"), look([4])))
    planned = RoundPlanner(SCENARIO).plan(view, jobs, over={}, time_limit=None)
    assert [[step.job for step in steps] for steps in planned.steps] == [[], ["J1"]]
    assert planned.later == ((("J2", 0),), ())


@pytest.mark.usefixtures("no_repair")
def test_the_fleet_is_planned_from_nothing_where_nobody_would_move() -> None:
    # R2 stands in the way of R1 and has nothing to do: it makes room.
    jobs = {"J1": make_job("J1", 2, "R1")}
    view = FleetView(now=Tick(0), takeover=Tick(0), robots=(look([0]), look([2])))
    planned = RoundPlanner(SCENARIO).plan(view, jobs, over={}, time_limit=None)
    assert [[step.job for step in steps] for steps in planned.steps] == [["J1"], []]
    assert planned.facts == ()


def test_a_robot_whose_battery_would_not_last_waits_and_others_work() -> None:
    # R2 works for 90 ticks more at the stop of R1, whose battery lasts for 90 ticks.
    battery = {"tank": {"drive": "1/1000", "on": "1/100", "charge": "1/5", "reserve": "1/10"}}
    scenario = make_scenario(
        ["....."],
        {"R1": {"home": "N0", "battery": "tank"}, "R2": {"home": "N2"}},
        jobs=[],
        rules={"return": "none", "rotations": False},
        batteries=battery,
        charging=["N0"],
    )
    jobs = {"J1": make_job("J1", 2, "R1"), "J2": make_job("J2", 4, "R2")}
    works = replace(look([2]), free=Tick(90))
    view = FleetView(now=Tick(0), takeover=Tick(0), robots=(look([0]), works))
    planned = RoundPlanner(scenario).plan(view, jobs, over={}, time_limit=None)
    assert not planned.stands
    assert [[step.job for step in steps] for steps in planned.steps] == [[], ["J2"]]
    assert planned.later == ((("J1", 0),), ())
    assert "batteries" in str(planned.facts[0])


def test_an_old_tour_that_is_kept_takes_as_long_at_its_stops_as_before() -> None:
    # R1 works for 5 ticks at N2. Its battery does not last for J3, where R2 works until tick 90.
    battery = {"tank": {"drive": "1/1000", "on": "1/100", "charge": "1/5", "reserve": "1/10"}}
    scenario = make_scenario(
        ["......"],
        {"R1": {"home": "N0", "battery": "tank"}, "R2": {"home": "N5"}},
        jobs=[],
        rules={"turn": 0},
        batteries=battery,
        charging=["N0"],
    )
    jobs = {"J1": make_job("J1", 2, "R1", work=5), "J3": make_job("J3", 4, "R1")}
    step = PlannedStep(visit=2, vertex=VertexId(2), begin=Tick(2), end=Tick(7), job="J1", stop=0)
    works = RobotView(
        kept_track=Track.of([0], [0]),
        track=Track.of([0, 1, 2, 1, 0], [0, 1, 2, 8, 9]),
        steps=(step,),
    )
    view = FleetView(
        now=Tick(0), takeover=Tick(0), robots=(works, replace(look([4]), free=Tick(90)))
    )
    planned = RoundPlanner(scenario).plan(view, jobs, over={}, time_limit=None)
    assert not planned.stands
    assert [(step.job, step.end - step.begin) for step in planned.steps[0]] == [("J1", 5)]
    assert planned.later[0] == (("J3", 0),)


def test_no_tour_is_cut_before_a_charge() -> None:
    jobs = [{"name": name, "at": place} for name, place in (("J1", "N1"), ("J2", "N2"))]
    scenario = make_scenario(
        ["....."],
        {"R1": {"home": "N0", "battery": "tank"}},
        jobs=jobs,
        batteries={"tank": {"drive": "1/10", "charge": "1/5", "reserve": "1/10"}},
        charging=["N3"],
    )
    stops = [TourItem(job=k, stop=0, vertex=VertexId(k + 1), duration=Tick(0)) for k in (0, 1)]
    charge = TourItem(job=None, stop=None, vertex=VertexId(3), duration=Tick(2))
    ends = [(Tick(1), Tick(3), Tick(4))]
    for tour, n_before in (((stops[0], charge, stops[1]), 2), ((*stops, charge), 1)):
        cut = cut_tours(scenario, Assignment(tours=(tour,)), ends, 1, Tick(0))
        assert cut.toured.tours is not None
        assert len(cut.toured.tours[0]) == n_before


@pytest.mark.parametrize(("is_idle", "taker"), [(True, 1), (False, 0)])
def test_a_job_changes_robots_on_the_way_only_while_a_robot_has_nothing_to_do(
    is_idle: bool, taker: int
) -> None:
    # R1 drives from N0 to J1 at N3; R2 is at N4, and may have a job there.
    jobs = {"J1": make_job("J1", 3), "J2": make_job("J2", 4, "R2")}
    if is_idle:
        del jobs["J2"]
    robots = (look([0, 1, 2, 3], "J1"), look([4], None if is_idle else "J2"))
    view = FleetView(now=Tick(0), takeover=Tick(0), robots=robots)
    planned = RoundPlanner(SCENARIO).plan(view, jobs, over={}, time_limit=None)
    assert "J1" in [step.job for step in planned.steps[taker]]
