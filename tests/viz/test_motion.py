"""Who is where, and what each visit is for."""

import pytest

from rightofway.fleet_builder import FleetBuilder
from rightofway.model import Plan, PlannerRun, Track
from rightofway.viz.motion import Moment, Phase, Trip, end_of, make_trips
from tests.builders.plans import door, loop


@pytest.fixture
def cart() -> Trip:
    return make_trips(loop())[0]


def test_a_visit_is_work_then_turning_then_waiting_then_the_drive(cart: Trip) -> None:
    # c is held from 4 to 14: 4 of work, 2 of turning, 3 of driving; 1 is left to wait
    assert list(cart.trace_phases(2)) == [
        (4, 8, Phase.WORK),
        (8, 10, Phase.TURN),
        (10, 11, Phase.WAIT),
        (11, 14, Phase.DRIVE),
    ]


def test_a_turn_between_two_edges_comes_before_the_wait() -> None:
    """At the corner from 1 to 5: 2 of turning, 1 of waiting, 1 of driving."""
    fleet = FleetBuilder(grid=["..", "@."], turn_rate=45, ends="none")
    scenario = fleet.add_robot("R", home="N0", target="N3").build_scenario()
    tracks = (Track.of([0, 1, 2], [0, 1, 5]),)
    (trip,) = make_trips(Plan(scenario=scenario, tracks=tracks, run=PlannerRun(name="by hand")))
    assert list(trip.trace_phases(1)) == [
        (1, 3, Phase.TURN),
        (3, 4, Phase.WAIT),
        (4, 5, Phase.DRIVE),
    ]


def test_the_drive_takes_the_ticks_of_its_edge(cart: Trip) -> None:
    assert cart.drive == (0, 2, 2, 3, 2)


def test_the_last_visit_needs_no_turning(cart: Trip) -> None:
    assert list(cart.trace_phases(4)) == []


def test_each_stage_is_served_by_the_visit_that_is_long_enough(cart: Trip) -> None:
    assert cart.served == (2, 4)


def test_a_stage_that_is_left_out_is_served_nowhere() -> None:
    plan = loop()
    track = type(plan.tracks[0]).of([0, 1, 0], [0, 2, 4])
    trip = make_trips(type(plan)(scenario=plan.scenario, tracks=(track,), run=plan.run))[0]
    assert trip.served == (-1, -1)


@pytest.mark.parametrize(
    ("tick", "moment"),
    [
        (0, Moment(tail=0, head=1, activity=Phase.DRIVE, share=0.0)),
        (1, Moment(tail=0, head=1, activity=Phase.DRIVE, share=0.5)),
        (2, Moment(tail=1, head=2, activity=Phase.DRIVE, share=0.0)),
        (5, Moment(tail=2, head=2, activity=Phase.WORK, share=0.25)),
        (9, Moment(tail=2, head=2, activity=Phase.TURN, share=0.5)),
        (10, Moment(tail=2, head=2, activity=Phase.WAIT, share=0.0)),
        (12.5, Moment(tail=2, head=3, activity=Phase.DRIVE, share=0.5)),
        (16, Moment(tail=0, head=0, activity=Phase.DONE, share=1.0)),
        (99, Moment(tail=0, head=0, activity=Phase.DONE, share=1.0)),
    ],
)
def test_a_robot_is_where_the_plan_has_it(cart: Trip, tick: float, moment: Moment) -> None:
    assert cart.locate(tick) == moment


def test_the_robot_that_gives_way_waits_first() -> None:
    # R1 could leave N0 at once; it drives for one tick before it enters N1 at 2
    assert list(make_trips(door())[0].trace_phases(0)) == [(0, 1, Phase.WAIT), (1, 2, Phase.DRIVE)]


def test_the_end_is_when_the_last_robot_is_done() -> None:
    assert end_of(make_trips(door())) == 10
