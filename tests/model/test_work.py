"""Jobs, batteries and states: their faults, their ticks, and itineraries made from tours."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from typing import Any

import pytest

from rightofway import FleetBuilder, InputError, solve
from rightofway.cyclic import make_cyclic_routes
from rightofway.model import (
    Arc,
    Battery,
    Job,
    JobStop,
    Robot,
    RobotState,
    Rules,
    Scenario,
    Stage,
    Stop,
    Tick,
    TourItem,
    assign_tours,
)
from rightofway.site import VertexId

V, T = VertexId, Tick


def item(job: int, stop: int, vertex: int, duration: int = 0) -> TourItem:
    """Return the work of a stop."""
    return TourItem(job=job, stop=stop, vertex=V(vertex), duration=T(duration))


def make_work(**changes: Any) -> Scenario:
    """Return two robots on a grid of 3 rows and 4 columns with two jobs, changed."""
    roadmap = FleetBuilder(grid=["....", "....", "...."]).build_roadmap()
    carried = JobStop(at=V(5), work=Fraction(2), load=1, earliest=Fraction(13, 4))
    jobs = (
        Job(name="J1", stops=(carried, JobStop(at=V(9), load=-1, latest=Fraction(203, 4)))),
        Job(name="J2", stops=(JobStop(at=V(6), work=Fraction(1, 2)),), after=("J1",)),
    )
    known = {
        "roadmap": roadmap,
        "robots": (Robot(name="R1", home=V(0)), Robot(name="R2", home=V(3))),
        "jobs": jobs,
        "batteries": {"large": Battery(drive=Fraction(1, 100), reserve=Fraction(1, 5))},
    }
    return Scenario(**{**known, **changes})


def make_robots(first: dict[str, Any], second: dict[str, Any] | None = None) -> tuple[Robot, ...]:
    """Return the two robots with other fields."""
    one, two = make_work().robots
    return replace(one, **first), replace(two, **second or {})


def make_jobs(first: dict[str, Any], stop: dict[str, Any] | None = None) -> tuple[Job, ...]:
    """Return the two jobs; the first one and its first stop have other fields."""
    one, two = make_work().jobs or ()
    stops = (replace(one.stops[0], **stop or {}), *one.stops[1:])
    return replace(one, **{"stops": stops, **first}), two


def test_times_of_jobs_are_rounded_and_do_not_choose_the_tick() -> None:
    # Drives take 1, the works 2 and 1/2: a tick is 1/2. 13/4 is 6.5 ticks, 203/4 is 101.5.
    scenario = make_work(jobs=make_jobs({"due": Fraction(15, 8)}))
    assert scenario.problem.clock.tick == Fraction(1, 2)
    assert scenario.problem.work is not None
    first, second = scenario.problem.work.jobs
    assert [stop.earliest for stop in first.stops] == [7, 0]
    assert [stop.latest for stop in first.stops] == [None, 101]
    assert [stop.work for stop in (*first.stops, *second.stops)] == [4, 0, 1]
    assert (first.due, first.earliest, second.after) == (3, 7, (0,))


def test_a_robot_that_is_ready_later_stays_where_it_begins() -> None:
    state = RobotState(at=V(7), ready=Fraction(13, 4), heading=Fraction(90))
    scenario = make_work(robots=make_robots({"start": state, "turn_rate": Fraction(90)}))
    itinerary = scenario.problem.itineraries[0]
    assert (itinerary.home, itinerary.ready, itinerary.last) == (7, 7, 0)
    assert itinerary.heading == 90
    without_rate = make_work(robots=make_robots({"start": state})).problem.itineraries[0]
    assert without_rate.heading is None


def test_a_heading_is_bound_in_the_plane_of_a_map_that_is_turned() -> None:
    # A quarter turn to the left on the site, whose y grows upwards, on a map that is turned by
    # 1 rad = 57.295780 degrees: 32.704220 degrees to the left in the map, whose y points down.
    roadmap = FleetBuilder(grid=["..", ".."], y="up").build_roadmap()
    turned = replace(roadmap, frame=replace(roadmap.frame, yaw=Fraction(1)))
    robots = (Robot(name="R1", home=V(0), start=RobotState(at=V(1), heading=Fraction(90))),)
    work = Scenario(roadmap=turned, robots=robots, jobs=()).problem.work
    assert work is not None
    assert work.robots[0].heading == 360 - (90 - Fraction(57295780, 10**6))


def test_of_a_begun_job_only_the_rest_is_bound() -> None:
    begun = make_robots({}, {"start": RobotState(at=V(3), begun=(("J1", 1),)), "capacity": 2})
    work = make_work(robots=begun).problem.work
    assert work is not None
    job = work.jobs[0]
    assert (job.first, job.begun_by, job.robots, job.earliest) == (1, 1, (1,), 0)
    assert [(stop.vertex, stop.latest) for stop in job.stops] == [(9, None)]
    assert [robot.load for robot in work.robots] == [0, 1]


def test_a_begun_job_follows_no_other_job() -> None:
    jobs = (make_jobs({"after": ("J2",)})[0], Job(name="J2", stops=(JobStop(at=V(6)),)))
    begun = make_robots({"start": RobotState(at=V(0), begun=(("J1", 1),))})
    free, bound = make_work(jobs=jobs).problem.work, make_work(jobs=jobs, robots=begun).problem.work
    assert free is not None
    assert bound is not None
    assert [work.jobs[0].after for work in (free, bound)] == [(1,), ()]


@pytest.mark.parametrize(
    ("of_job", "of_robot", "able"),
    [
        ({}, {}, (0, 1)),
        ({"robot": "R2"}, {}, (1,)),
        ({"types": ("fork",)}, {"type": "fork"}, (1,)),
        ({"types": ("fork",)}, {}, ()),
        ({}, {"capacity": 0}, (0,)),
    ],
)
def test_robots_that_may_do_a_job_and_can(
    of_job: dict[str, Any], of_robot: dict[str, Any], able: tuple[int, ...]
) -> None:
    scenario = make_work(jobs=make_jobs(of_job), robots=make_robots({}, of_robot))
    assert scenario.problem.work is not None
    assert scenario.problem.work.jobs[0].robots == able


def test_shares_of_a_battery_are_whole_numbers_of_one_denominator() -> None:
    battery = Battery(
        drive=Fraction(1, 100),
        on=Fraction(1, 30),
        work=Fraction(3),
        charge=Fraction(1, 10),
        reserve=Fraction(1, 5),
    )
    robots = make_robots({"battery": "large", "start": RobotState(at=V(0), soc=Fraction(1, 2))})
    work = make_work(batteries={"large": battery}, robots=robots, charging=(V(4),)).problem.work
    assert work is not None
    bound = work.robots[0].battery
    assert bound is not None
    # A tick is 1/2: denominators 100, 60, 2, 20, 5 and 2 have the least common multiple 300. The
    # work of a tick takes 3/2 of a full battery, so it is 301.
    assert (bound.full, bound.drive, bound.on, bound.work) == (300, (3,), 5, 301)
    assert (bound.charge, bound.reserve, bound.soc) == (15, 60, 150)
    assert (work.robots[0].charging, work.robots[1].battery) == ((4,), None)


def test_itineraries_follow_the_tours_and_robots_wait_for_jobs_before() -> None:
    jobs = make_jobs({"due": Fraction(9), "weight": Fraction(3, 2)})
    scenario = make_work(jobs=jobs)
    charge = TourItem(job=None, stop=None, vertex=V(6), duration=T(8))
    tours = (item(0, 0, 5, 4), item(0, 1, 9)), (item(1, 0, 6, 1), charge)
    assigned = assign_tours(scenario, tours)
    first, second = assigned.problem.itineraries
    # A visit turns once, for the time of a cell, 2 ticks, after the last of its stages.
    assert first.stages == (
        Stage(vertex=V(5), work=T(4), turn=T(2), earliest=T(7)),
        Stage(vertex=V(9), work=T(0), turn=T(2), latest=T(101), weight=3, due=T(18)),
        Stage(vertex=V(0), work=T(0), turn=T(0)),
    )
    assert second.stages == (
        Stage(vertex=V(6), work=T(1), turn=T(2), weight=2),
        Stage(vertex=V(6), work=T(8), turn=T(2)),
        Stage(vertex=V(3), work=T(0), turn=T(0)),
    )
    assert assigned.problem.after == (Arc(before=(0, 1), after=(1, 0)),)
    assert replace(scenario, tours=tours).problem.after == assigned.problem.after
    assert scenario.tours is None


def test_a_robot_that_does_not_return_rests_at_its_last_stop_or_where_it_began() -> None:
    scenario = make_work(rules=Rules(ends="none"))
    assigned = assign_tours(scenario, ((item(0, 0, 5), item(0, 1, 9)), ()))
    assert [itinerary.last for itinerary in assigned.problem.itineraries] == [9, 3]
    rest = TourItem(job=None, stop=None, vertex=V(2), duration=T(0))
    assigned = assign_tours(scenario, ((item(0, 0, 5), item(0, 1, 9), rest), ()))
    assert assigned.problem.itineraries[0].last == 2


def test_planners_and_laps_refuse_jobs() -> None:
    with pytest.raises(InputError, match="planner cbs does not know jobs"):
        solve(make_work(), planner="cbs")
    with pytest.raises(InputError, match="repeated work does not know jobs"):
        make_cyclic_routes(make_work())


def make_begun(**begun: int) -> dict[str, Any]:
    """Return robots of which the first one has begun jobs."""
    return {"robots": make_robots({"start": RobotState(at=V(0), begun=tuple(begun.items()))})}


ONE_STOP = Job(name="J1", stops=(JobStop(at=V(1)),))

OUT_OF_RANGE: list[tuple[Callable[[], object], str]] = [
    (lambda: replace(ONE_STOP, weight=Fraction(0)), "job 'J1': weight: 0 is not positive"),
    (lambda: replace(ONE_STOP, due=Fraction(-1)), "job 'J1': due: -1 is negative"),
    (lambda: JobStop(at=V(1), work=Fraction(-1)), "stop: work: -1 is negative"),
    (lambda: JobStop(at=V(1), earliest=Fraction(-1)), "stop: earliest: -1 is negative"),
    (lambda: make_robots({"capacity": -1}), "robot 'R1': capacity: -1 does not fit"),
    (lambda: Battery(on=Fraction(-1)), "battery: on: -1 is negative"),
    (lambda: Battery(reserve=Fraction(2)), "battery: reserve: 2 is above 1"),
    (lambda: RobotState(at=V(0), ready=Fraction(-1)), "start: ready: -1 is negative"),
    (lambda: RobotState(at=V(0), soc=Fraction(2)), "start: soc: 2 is above 1"),
]


@pytest.mark.parametrize(("make", "message"), OUT_OF_RANGE)
def test_a_number_out_of_range_is_refused_when_it_is_given(
    make: Callable[[], object], message: str
) -> None:
    with pytest.raises(InputError, match=message):
        make()


FAULTS: list[tuple[dict[str, Any], str]] = [
    ({"jobs": 5}, "jobs: 5 is no list (give a list, each a Job)"),
    ({"jobs": [5]}, "jobs[0]: 5 is no Job (give Job(name=text, stops=list))"),
    ({"batteries": 7}, "batteries: 7 is no mapping (give a mapping of names, each to a Battery)"),
    ({"charging": [99]}, "charging[0]: vertex 99 is not on the roadmap (give 0 to 11)"),
    ({"jobs": (replace(ONE_STOP, name=""),)}, "jobs[0].name: is empty (give the job a name)"),
    (
        {"jobs": (ONE_STOP, ONE_STOP)},
        "jobs[1].name: J1 is the name of jobs[0] already (give each its own)",
    ),
    (
        {"jobs": (replace(ONE_STOP, robot="R3"),)},
        "jobs[0].robot: no robot is named 'R3' (give the name of a robot)",
    ),
    ({"jobs": (replace(ONE_STOP, stops=()),)}, "jobs[0].stops: there is none (give at least one)"),
    (
        {"jobs": make_jobs({}, {"latest": Fraction(5)})},
        (
            "jobs[0].stops[0].latest: 5 is before earliest and work, 13/4 + 2 (give 21/4 or"
            " more, or leave it out)"
        ),
    ),
    (
        {"jobs": make_jobs({}, {"at": V(12)})},
        "jobs[0].stops[0].at: vertex 12 is not on the roadmap (give 0 to 11)",
    ),
    (
        {"jobs": make_jobs({}, {"load": 0})},
        (
            "jobs[0].stops[1].load: -1 unloads more than the stops before have loaded (load"
            " it at a stop before)"
        ),
    ),
    (
        {"jobs": make_jobs({}, {"load": 3})},
        "jobs[0].stops: the loads sum to 2 (unload as much as is loaded)",
    ),
    (
        {"jobs": make_jobs({"after": ("J3",)})},
        "jobs[0].after[0]: no job is named 'J3' (give the name of a job)",
    ),
    (
        {"jobs": make_jobs({"after": ("J2",)})},
        "jobs[0].after: J1 after J2 after J1 is a cycle (take one of them out)",
    ),
    (
        {"jobs": make_jobs({"weight": Fraction(2 * 10**6)})},
        (
            "jobs[0].weight: 2000000 makes weights too far apart or too fine: in whole"
            " numbers it is 2000000, above 1000000 (round weights)"
        ),
    ),
    (
        {"jobs": make_jobs({"due": Fraction(10**17)})},
        (
            "jobs[0].due: it takes 200000000000000000 ticks of 1/2, more than 1099511627776"
            " (bring speeds, lengths and times closer together)"
        ),
    ),
    (
        {"robots": make_robots({"stops": (Stop(at=V(5)),)})},
        (
            "robots[0].stops: are given beside jobs (take it out; a fixed trip is a job with"
            " robot: R1)"
        ),
    ),
    (
        {"robots": make_robots({"laps": 2})},
        (
            "robots[0].laps: 2 laps do not go with jobs (take it out; a fixed trip is a job"
            " with robot: R1)"
        ),
    ),
    ({"rules": Rules(laps=2)}, "rules.laps: 2 laps do not go with jobs (take it out)"),
    (
        {"robots": make_robots({"battery": "larger"})},
        "robots[0].battery: no battery is named 'larger' (did you mean 'large'?)",
    ),
    (
        {"robots": make_robots({"charging": [V(4), V(-1)]})},
        "robots[0].charging[1]: vertex -1 is not on the roadmap (give 0 to 11)",
    ),
    (
        {
            "batteries": {"large": Battery(drive=Fraction(1, 10**15), on=Fraction(1, 3))},
            "robots": make_robots({"battery": "large"}),
        },
        (
            "batteries.large: 3000000000000000 is the common denominator of its shares, with"
            " lengths of edges, the tick and soc 1 of R1: above 10^15 (give rounder fractions)"
        ),
    ),
    (
        {"robots": make_robots({"start": RobotState(at=V(12))})},
        "robots[0].start.at: vertex 12 is not on the roadmap (give 0 to 11)",
    ),
    (
        {"robots": make_robots({"start": RobotState(at=V(3))})},
        (
            "robots[1].start.at: N3 is the start of R1 already (a vertex holds one robot;"
            " move one of them)"
        ),
    ),
    (
        {"robots": make_robots({"radius": Fraction(2)}, {"start": RobotState(at=V(1))})},
        "robots[1].start.at: N1 is nearer than 2 to the start of R1 (move one of them)",
    ),
    (make_begun(J3=1), "robots[0].start.begun.J3: no job is named 'J3' (give the name of a job)"),
    (make_begun(J1=2), "robots[0].start.begun.J1: 2 of 2 stops are no begun job (give 1)"),
    (make_begun(J1=0), "robots[0].start.begun.J1: 0 of 2 stops are no begun job (give 1)"),
    (make_begun(J2=1), "robots[0].start.begun.J2: 1 of 1 stops are no begun job (take it out)"),
    (
        {**make_begun(J1=1), "jobs": make_jobs({"robot": "R2"})},
        (
            "robots[0].start.begun.J1: the job is for R2 (only the robot that has begun it"
            " may finish it)"
        ),
    ),
    (
        {**make_begun(J1=1), "jobs": make_jobs({"types": ("fork",)})},
        (
            "robots[0].start.begun.J1: the job is for type fork, not none (only the robot"
            " that has begun it may finish it)"
        ),
    ),
    (
        {
            "robots": make_robots(
                {"start": RobotState(at=V(0), begun=(("J1", 1),))},
                {"start": RobotState(at=V(3), begun=(("J1", 1),))},
            )
        },
        "robots[1].start.begun.J1: R1 has begun it already (only one robot may)",
    ),
]


@pytest.mark.parametrize(("changes", "message"), FAULTS, ids=[message for _, message in FAULTS])
def test_a_fault_of_work_is_refused_with_place_value_and_remedy(
    changes: dict[str, Any], message: str
) -> None:
    with pytest.raises(InputError) as refused:
        make_work(**changes)
    assert str(refused.value) == message


def test_without_jobs_the_keys_of_jobs_are_refused() -> None:
    robots = make_robots(
        {"start": RobotState(at=V(1)), "capacity": 2, "stops": (Stop(at=V(5)),)},
        {"battery": "large", "charging": (), "stops": (Stop(at=V(6)),)},
    )
    rules = Rules(objective="service", late=Fraction(10), patience=Fraction(9))
    with pytest.raises(InputError) as refused:
        make_work(jobs=None, robots=robots, rules=rules, charging=(V(0),))
    places = [
        "batteries",
        "charging",
        "rules.objective",
        "rules.late",
        "rules.patience",
        "robots[0].start",
        "robots[0].capacity",
        "robots[1].battery",
        "robots[1].charging",
    ]
    remedy = "is for a scenario with jobs (give jobs, or take it out)"
    assert str(refused.value).splitlines() == [f"{place}: {remedy}" for place in places]


def test_an_empty_list_of_jobs_is_work() -> None:
    scenario = make_work(jobs=[])
    assert scenario.problem.work is not None
    assert [itinerary.last for itinerary in scenario.problem.itineraries] == [0, 3]
