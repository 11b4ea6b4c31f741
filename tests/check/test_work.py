"""The judge of jobs: a right plan passes, and each planted fault is found as its kind."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from typing import Any, get_args

import pytest

from rightofway.check import FaultKind, check
from rightofway.model import (
    Battery,
    Job,
    JobStop,
    Plan,
    PlannedItem,
    PlannerRun,
    Robot,
    RobotState,
    Rules,
    Scenario,
    Track,
)
from rightofway.report.judgement import describe_fault
from rightofway.site import VertexId, make_grid_roadmap
from tests.builders.planned_jobs import (
    BATTERY,
    FIRST,
    GRID,
    JOBS,
    ROBOTS,
    SECOND,
    STATE,
    TRACKS,
    item,
    make_plan,
)

F, V = Fraction, VertexId


def with_job(index: int, **changes: Any) -> tuple[Job, ...]:
    """Return the jobs, one of them changed."""
    return tuple(replace(job, **changes) if k == index else job for k, job in enumerate(JOBS))


def with_robots(first: dict[str, Any], second: dict[str, Any] | None = None) -> tuple[Robot, ...]:
    """Return the robots, changed."""
    return replace(ROBOTS[0], **first), replace(ROBOTS[1], **second or {})


def with_battery(**changes: Any) -> dict[str, Battery]:
    """Return the battery, changed."""
    return {"large": replace(BATTERY, **changes)}


def test_a_plan_with_jobs_charges_and_states_passes() -> None:
    report = check(make_plan())
    assert report.ok, str(report)


# J4 at N3, which R1 leaves at 11: it drives and turns for a tick each.
AT_N3 = with_job(3, stops=(JobStop(at=V(3)),))
J4 = item(3, 9, 9, 3)
SHARED = with_job(3, stops=(JobStop(at=V(3)), JobStop(at=V(7))), after=())
ONE_WAY = Rules(ends="none")
# Without the way home and the charge: R1 rests at N3 with 1 - 3/10 - 9/100 - 6/100 = 55/100.
RESTS: dict[str, Any] = {
    "rules": ONE_WAY,
    "first": FIRST[:2],
    "tracks": ((TRACKS[0][0][:4], TRACKS[0][1][:4]), TRACKS[1]),
}

FAULTS: list[tuple[dict[str, Any], dict[FaultKind, int]]] = [
    # Where robots begin and rest.
    ({"robots": with_robots({}, {"start": replace(STATE, at=V(8))})}, {"wrong start": 1}),
    ({"tracks": (TRACKS[0], (TRACKS[1][0], [1, *TRACKS[1][1][1:]]))}, {"wrong start": 1}),
    ({"tracks": (TRACKS[0], (TRACKS[1][0][:-1], TRACKS[1][1][:-1]))}, {"wrong end": 1}),
    # Before a robot is ready it neither drives nor works: R2 drives from 2 to 3, and works at 4.
    ({"robots": with_robots({}, {"start": replace(STATE, ready=F(3))})}, {"before ready": 1}),
    ({"robots": with_robots({}, {"start": replace(STATE, ready=F(5))})}, {"before ready": 2}),
    # Items and visits: R1 is at N1 from 1 to 7, of which it drives and turns for a tick each.
    ({"first": [item(1, 4, 6, 0), *FIRST[1:]]}, {"outside visit": 1}),
    ({"first": [item(1, 0, 2, 0), *FIRST[1:]]}, {"outside visit": 1, "too early": 1}),
    ({"first": [item(2, 3, 5, 0), *FIRST[1:]]}, {"outside visit": 1, "wrong stop": 1}),
    ({"first": [item(1, 3, 4, 0), *FIRST[1:]]}, {"wrong duration": 1}),
    ({"first": [*FIRST[:2], item(6, 15, 14)]}, {"wrong duration": 1}),
    ({"first": [*FIRST[1::-1], FIRST[2]]}, {"items overlap": 1, "stop order": 1, "wrong load": 1}),
    ({"first": [*FIRST[:2], item(6, 13, 15), item(6, 14, 15)]}, {"items overlap": 1}),
    # Times of jobs.
    ({"first": [item(1, 2, 4, 0), *FIRST[1:]]}, {"too early": 1}),
    (
        {"jobs": with_job(0, stops=(JOBS[0].stops[0], replace(JOBS[0].stops[1], latest=F(8))))},
        {"too late": 1},
    ),
    ({"second": [SECOND[0], item(3, 8, 11, 1)]}, {"wrong order": 1}),
    # Loads.
    ({"robots": with_robots({"capacity": 0})}, {"wrong load": 1}),
    # All of a job by one robot that may, or nothing.
    ({"first": [FIRST[0], FIRST[2]]}, {"stop not done": 1}),
    ({"first": FIRST[2:]}, {"stop not done": 2}),
    ({"unserved": ()}, {"stop not done": 1}),
    ({"jobs": AT_N3, "first": [*FIRST[:2], J4, FIRST[2]], "unserved": ()}, {}),
    (
        {"jobs": AT_N3, "first": [*FIRST[:2], J4, J4, FIRST[2]], "unserved": ()},
        {"stop done again": 1},
    ),
    (
        {"second": [item(2, 4, 4, 2), *SECOND]},
        {"stop done again": 1, "wrong stop": 1, "wrong load": 1},
    ),
    (
        {
            "jobs": SHARED,
            "first": [*FIRST[:2], J4, FIRST[2]],
            "second": [SECOND[0], item(2, 4, 4, 3, 1), SECOND[1]],
            "unserved": (),
        },
        {"job divided": 1},
    ),
    ({"jobs": with_job(0, robot="R2")}, {"wrong robot": 1}),
    ({"jobs": with_job(0, types=("fork",))}, {"wrong robot": 1}),
    ({"jobs": with_job(1, types=("tug",))}, {"wrong robot": 1}),
    ({"jobs": AT_N3, "first": [*FIRST[:2], J4, FIRST[2]]}, {"also unserved": 1}),
    ({"unserved": (2, 3), "second": SECOND[1:]}, {"begun unserved": 1}),
    ({"unserved": (0, 3), "first": FIRST[2:]}, {"after unserved": 1}),
    # Charges and batteries.
    ({"robots": with_robots({"charging": (V(1),)})}, {"wrong charger": 1}),
    ({"batteries": with_battery(reserve=F(22, 100))}, {"low battery": 1}),
    ({"batteries": with_battery(charge=F(0), reserve=F(21, 100))}, {}),
    ({"robots": with_robots({"start": RobotState(at=V(0), soc=F(98, 100))})}, {"low battery": 1}),
    ({"robots": with_robots({"start": RobotState(at=V(0), soc=F(19, 100))})}, {"low battery": 1}),
    # The next charging place is N1: two drives of a tick, which take 22/100.
    ({**RESTS, "batteries": with_battery(reserve=F(33, 100))}, {}),
    ({**RESTS, "batteries": with_battery(reserve=F(34, 100))}, {"stranded": 1}),
    ({**RESTS, "robots": with_robots({"charging": ()})}, {"stranded": 1}),
]


@pytest.mark.parametrize(("changes", "counts"), FAULTS)
def test_each_planted_fault_of_work_is_found(
    changes: dict[str, Any], counts: dict[FaultKind, int]
) -> None:
    report = check(make_plan(**changes))
    assert report.counts == counts, str(report)
    for fault in report.faults:
        assert all(str(part) for part in describe_fault(fault))


def test_every_fault_of_work_is_planted() -> None:
    planted = {kind for _, counts in FAULTS for kind in counts}
    kinds = get_args(FaultKind)
    assert set(kinds[kinds.index("wrong start") :]) - planted == set()


def find_sentence(**changes: Any) -> str:
    """Return the only fault of a plan."""
    (fault,) = check(make_plan(**changes)).faults
    return str(fault)


def test_a_fault_of_work_names_the_stop_of_the_job() -> None:
    assert find_sentence(first=[item(1, 4, 6, 0), *FIRST[1:]]) == (
        "time 4: outside its visit: R1 does stop 1 of J1 at N1 from time 4 to 6, its visit has time"
        " from time 1 to 5 (make the visit longer, or choose another one)"
    )
    assert find_sentence(unserved=()) == (
        "time 0: stop not done: no robot does stop 1 of J4 (add it to a tour, or name the whole job"
        " as unserved)"
    )


def test_a_fault_of_a_battery_has_the_exact_state_of_charge() -> None:
    assert find_sentence(batteries=with_battery(reserve=F(22, 100))) == (
        "time 13: low battery: R1 has a state of charge of 21 % at N0 at time 13, 22 % is the least"
        " (charge before, or do less)"
    )
    assert find_sentence(**RESTS, batteries=with_battery(reserve=F(34, 100))) == (
        "time 9: low battery at rest: R1 rests at N3 with a state of charge of 55 %, with the way"
        " to a charging place it needs 56 % (charge before, or rest nearer to a charging place)"
    )


@pytest.mark.parametrize(
    ("soc", "charge", "kinds"),
    [
        # From 1/10 at tick 3 a charge of 2/10 a tick for 4 ticks reaches 9/10.
        (F(1, 10), item(0, 3, 7), []),
        # 8 ticks and the drive after the charge take 18/100.
        (F(18, 100), item(0, 3, 4), []),
        (F(17, 100), item(0, 3, 4), ["low battery"]),
        (F(1, 10), item(0, 3, 3), ["low battery"]),
        # Until the charge begins, the robot needs 1/100 in a tick.
        (F(2, 100), item(0, 5, 7), []),
        (F(1, 100), item(0, 6, 7), ["low battery"]),
        # A full battery is not more than full: 1 at tick 7, 5/100 and 1/10 less at 12.
        (F(9, 10), item(0, 3, 7), []),
    ],
)
def test_a_robot_below_its_reserve_charges_first(
    soc: Fraction, charge: PlannedItem, kinds: list[str]
) -> None:
    start = RobotState(at=V(0), ready=F(3), soc=soc)
    robot = replace(ROBOTS[0], start=start)
    job = Job(name="J1", stops=(JobStop(at=V(1)),))
    scenario = Scenario(
        roadmap=make_grid_roadmap(GRID),
        robots=(robot,),
        jobs=(job,),
        batteries=(("large", BATTERY),),
        rules=ONE_WAY,
    )
    plan = Plan(
        scenario=scenario,
        tracks=(Track.of([0, 1], [0, 12]),),
        run=PlannerRun(),
        tours=((charge, item(1, 12, 12, 0)),),
    )
    assert [fault.kind for fault in check(plan).faults] == kinds


def test_a_robot_without_work_may_be_below_its_reserve_but_not_empty() -> None:
    def judge(soc: Fraction) -> list[str]:
        robots = with_robots({"start": RobotState(at=V(0), soc=soc)})
        # Two drives to make room and back, of a tick each: 22/100.
        track = [0, 1, 0], [0, 1, 2]
        plan = make_plan(
            (),
            SECOND[:1],
            robots=robots,
            batteries=with_battery(reserve=F(1, 4)),
            tracks=(track, TRACKS[1]),
            unserved=(0, 1, 3),
        )
        return [fault.kind for fault in check(plan).faults]

    assert judge(F(22, 100)) == judge(F(1)) == []
    assert judge(F(21, 100)) == ["low battery"]


def test_a_first_drive_turns_from_the_heading() -> None:
    # From the x axis to the y axis, which points down on this map: a quarter turn takes 3 ticks.
    def judge(heading: int | None, leave: int) -> list[str]:
        state = RobotState(at=V(0), ready=F(2), heading=None if heading is None else F(heading))
        robot = Robot(name="R1", home=V(1), turn_rate=F(30), start=state)
        scenario = Scenario(roadmap=make_grid_roadmap(GRID), robots=(robot,), jobs=())
        tracks = (Track.of([0, 1], [0, leave]),)
        plan = Plan(scenario=scenario, tracks=tracks, run=PlannerRun(), tours=((),))
        return [fault.kind for fault in check(plan).faults]

    assert judge(None, 3) == judge(0, 3) == judge(360, 3) == judge(90, 6) == judge(-90, 6) == []
    assert judge(180, 9) == judge(450, 6) == judge(1, 4) == []
    assert judge(90, 5) == judge(180, 8) == judge(1, 3) == ["before ready"]
    assert judge(90, 3) == ["before ready", "turn cut short"]
