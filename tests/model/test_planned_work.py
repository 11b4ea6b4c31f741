"""Tours of a plan: refused where they name nothing, timed where only the tracks are known."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from typing import Any

import pytest

from rightofway import InputError
from rightofway.model import (
    Job,
    JobStop,
    Plan,
    PlannedItem,
    PlannerRun,
    Robot,
    Rules,
    Scenario,
    Stop,
    Tick,
    TourItem,
    Track,
    assign_tours,
)
from rightofway.site import VertexId, make_grid_roadmap

V, T = VertexId, Tick
WORK = PlannedItem(visit=1, begin=T(1), end=T(3), job=0, stop=0)


def make_scenario(**changes: Any) -> Scenario:
    """Return two robots at the ends of a corridor and two jobs in it, the second after the first.

    Robots drive an edge in a tick and turn at stops in another.
    """
    jobs = (
        Job(name="J1", stops=(JobStop(at=V(1), work=Fraction(2)),)),
        Job(name="J2", stops=(JobStop(at=V(3), earliest=Fraction(2)),), after=("J1",)),
    )
    known = {
        "roadmap": make_grid_roadmap(["....."]),
        "robots": (Robot(name="R1", home=V(0)), Robot(name="R2", home=V(4))),
        "jobs": jobs,
    }
    return Scenario(**{**known, **changes})


def make_plan(scenario: Scenario, **changes: Any) -> Plan:
    """Return R1 at N1 from 1 to 5 and R2 at N3 from 1 to 9, by default with these tours."""
    tracks = Track.of([0, 1, 0], [0, 1, 5]), Track.of([4, 3, 4], [0, 1, 9])
    tours = (WORK,), (PlannedItem(visit=1, begin=T(4), end=T(4), job=1, stop=0),)
    known = {"tracks": tracks, "run": PlannerRun(), "tours": tours}
    return Plan(scenario=scenario, **{**known, **changes})


def work_at(job: int, vertex: int, duration: int) -> TourItem:
    """Return the only stop of a job as an item of a tour."""
    return TourItem(job=job, stop=0, vertex=V(vertex), duration=T(duration))


def test_itineraries_of_a_plan_follow_its_tours() -> None:
    plan = make_plan(make_scenario())
    assert [
        [stage.vertex for stage in itinerary.stages]
        for itinerary in plan.scenario.problem.itineraries
    ] == [[1, 0], [3, 4]]
    assert plan.completions == (5, 9)


def test_items_of_tours_are_timed_as_early_as_can_be() -> None:
    tours = (work_at(0, 1, 2),), (work_at(1, 3, 0),)
    plan = make_plan(assign_tours(make_scenario(), tours), tours=None)
    # J2 may begin at 2, but follows J1, which ends at 3.
    assert plan.tours == ((WORK,), (PlannedItem(visit=1, begin=T(3), end=T(3), job=1, stop=0),))


def test_charges_last_until_the_robot_turns_to_drive_on() -> None:
    charge = TourItem(job=None, stop=None, vertex=V(3), duration=T(1))
    tours = (work_at(0, 1, 2),), (charge, work_at(1, 3, 0))
    plan = make_plan(assign_tours(make_scenario(), tours), tours=None)
    assert plan.tours is not None
    assert plan.tours[1] == (
        PlannedItem(visit=1, begin=T(1), end=T(3)),
        PlannedItem(visit=1, begin=T(3), end=T(3), job=1, stop=0),
    )
    swapped = assign_tours(make_scenario(), (tours[0], tours[1][::-1]))
    plan = make_plan(swapped, tours=None)
    assert plan.tours is not None
    # It leaves at 9, after a turn and a drive of a tick each.
    assert plan.tours[1][-1] == PlannedItem(visit=1, begin=T(3), end=T(7))


def test_a_tour_ends_before_an_item_that_no_visit_is_long_enough_for() -> None:
    tours = (work_at(0, 1, 3), work_at(1, 1, 0)), ()
    plan = make_plan(assign_tours(make_scenario(), tours), tours=None)
    assert plan.tours == ((), ())


def test_a_robot_that_does_not_return_completes_with_its_last_work() -> None:
    scenario = make_scenario(rules=Rules(ends="none"))
    # R1 makes room after its work, R2 without any.
    plan = make_plan(scenario, tours=((WORK,), ()), unserved=((1, "not found"),))
    assert plan.completions == (3, 9)
    assert [itinerary.last for itinerary in plan.scenario.problem.itineraries] == [0, 4]


FAULTS: list[tuple[dict[str, Any], str]] = [
    ({"tours": None}, "tours: no tours for 2 robots (give one for each, that may be empty)"),
    ({"tours": ((),)}, "tours: 1 tours for 2 robots (give one for each, that may be empty)"),
    (
        {"tours": ((replace(WORK, visit=3),), ())},
        "tours[0][0].visit: 3 is none of 3 visits (give 0 to 2)",
    ),
    (
        {"tours": ((replace(WORK, job=2),), ())},
        "tours[0][0].job: 2 is none of 2 jobs (give 0 to 1)",
    ),
    (
        {"tours": ((replace(WORK, stop=1),), ())},
        "tours[0][0].stop: 1 is none of 1 stops (give 0 to 0)",
    ),
    (
        {"tours": ((replace(WORK, stop=None),), ())},
        "tours[0][0]: has not both a job and a stop (give both for work, none for a charge)",
    ),
    ({"unserved": [[-1, "way"]]}, "unserved[0].job: -1 is none of 2 jobs (give 0 to 1)"),
    (
        {"unserved": [[1, "lazy"]]},
        (
            "unserved[0].reason: 'lazy' is unknown (give robot, way, battery, latest, after or not"
            " found)"
        ),
    ),
    (
        {"unserved": [1]},
        "unserved[0]: 1 does not fit (give [index of the job, reason])",
    ),
]


@pytest.mark.parametrize(("changes", "message"), FAULTS, ids=[message for _, message in FAULTS])
def test_tours_that_are_not_of_the_plan_are_refused(changes: dict[str, Any], message: str) -> None:
    with pytest.raises(InputError) as refused:
        make_plan(make_scenario(), **changes)
    assert str(refused.value) == message


def test_tours_without_jobs_are_refused() -> None:
    robots = tuple(
        Robot(name=name, home=V(at), stops=(Stop(at=V(at)),)) for name, at in (("R1", 0), ("R2", 4))
    )
    with pytest.raises(InputError, match="tours: are for a scenario with jobs"):
        make_plan(make_scenario(jobs=None, robots=robots))
