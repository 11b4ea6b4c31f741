"""The visits of a plan with their purposes."""

from __future__ import annotations

from fractions import Fraction

import rightofway
from rightofway.io import parse_scenario
from rightofway.metrics import compute_lost_time, list_events, make_event_columns
from rightofway.model import Plan, PlannerRun, Rules, Stop, Tick, Track
from rightofway.model.robot import Robot
from rightofway.model.scenario import Scenario, assign_tours
from rightofway.model.work import TourItem
from rightofway.site import VertexId
from tests.builders.fleets import PAPER, paper_scenario

DOOR_1 = paper_scenario(PAPER[0])


def corridor(*stops: Stop, laps: int = 1, speed: Fraction = Fraction(1)) -> Scenario:
    """Return one robot in a corridor of three cells, with home at the left end."""
    grid = (
        rightofway.FleetBuilder(grid=["..."])
        .add_robot("x", home="N0", target="N1")
        .build_scenario()
    )
    robot = Robot(name="R", home=VertexId(0), stops=stops, laps=laps, speed=speed)
    return Scenario(roadmap=grid.roadmap, robots=(robot,), rules=Rules())


def make_plan(scenario: Scenario, vertices: list[int], enter: list[int]) -> Plan:
    tracks = (Track.of(vertices, enter),)
    return Plan(scenario=scenario, tracks=tracks, run=PlannerRun(name="by hand"))


def test_a_visit_says_what_it_is_for() -> None:
    """Works 2 at the middle and turns 1, then stops at the end, turns, and comes home."""
    stops = (Stop(at=VertexId(1), work=Fraction(2)), Stop(at=VertexId(2)))
    plan = make_plan(corridor(*stops), [0, 1, 2, 1, 0], [0, 1, 5, 7, 9])
    assert [(event.purpose, event.enter, event.leave) for event in list_events(plan)] == [
        ("home", 0, 1),
        ("work at stop 1, turn", 1, 5),
        ("stop 2, turn", 5, 7),
        ("wait", 7, 9),  # a tick more than the drive
        ("home", 9, None),
    ]


def test_laps_are_counted_and_home_between_them_is_named_once() -> None:
    plan = make_plan(corridor(Stop(at=VertexId(1)), laps=2), [0, 1, 0, 1, 0], [0, 1, 3, 5, 7])
    assert [event.purpose for event in list_events(plan)] == [
        "home", "stop 1 of lap 1, turn", "home, turn", "stop 1 of lap 2, turn", "home",
    ]  # fmt: skip


def test_a_wait_names_the_robot_and_the_place_that_it_has_to_leave() -> None:
    """Table 4: R1 waits at home for one tick, until R2 has left N1."""
    plan = rightofway.solve(DOOR_1, "two-level", swaps="leave")
    name = DOOR_1.roadmap.name
    waits = [event for event in list_events(plan) if event.waits]
    assert [(each.robot, name(each.vertex), each.waits) for each in waits] == [(0, "N0", 1)]
    assert waits[0].waits_for == 1
    assert waits[0].to_leave is not None
    assert name(waits[0].to_leave) == "N1"


def test_columns_have_times_in_the_scenario_unit_and_exact_ticks() -> None:
    """At speed 2 a cell takes half a time unit, which is the tick."""
    plan = make_plan(
        corridor(Stop(at=VertexId(1), work=Fraction(1)), speed=Fraction(2)), [0, 1, 0], [0, 1, 5]
    )
    columns = make_event_columns(plan)
    assert columns["enter"] == [0.0, 0.5, 2.5]
    assert columns["leave"] == [0.5, 2.5, None]
    assert (columns["enter_tick"], columns["leave_tick"]) == ([0, 1, 5], [1, 5, None])


def test_a_visit_says_that_a_robot_turns_on_the_spot() -> None:
    """East, then south: 2 for the corner, which is waited for, too; 4 to come back."""
    fleet = rightofway.FleetBuilder(grid=["..", "@."], turn_rate=45)
    scenario = fleet.add_robot("R", home="N0", target="N3", work=1).build_scenario()
    plan = make_plan(scenario, [0, 1, 2, 1, 0], [0, 1, 4, 10, 14])
    assert [(event.purpose, event.enter, event.waits) for event in list_events(plan)] == [
        ("home", 0, 0),
        ("turn", 1, 0),
        ("work at stop 1, turn", 4, 0),
        ("wait, turn", 10, 1),
        ("home", 14, 0),
    ]
    (lost,) = compute_lost_time(plan)
    assert (lost.alone, lost.detours, lost.making_room, lost.waiting) == (13, 0, 0, 1)


def test_work_and_charges_of_jobs_are_named_by_job() -> None:
    """R1 begins at N1, carries J1 to N3, and has to charge at home before it counts at N2."""
    scenario = parse_scenario(
        {
            "format": "rightofway-scenario/1",
            "map": {"grid": ["...."]},
            "robots": [{"name": "R1", "home": "N0", "battery": "small", "start": {"at": "N1"}}],
            "batteries": {"small": {"drive": "1/8", "charge": "1/4"}},
            "charging": ["N0"],
            "jobs": [
                {"name": "J1", "pickup": "N1", "dropoff": "N3", "pickup_work": 2},
                {"name": "J2", "at": "N2", "work": 1, "after": ["J1"], "earliest": 9},
            ],
            "rules": {"turn": 0},
        }
    )
    tour = [
        TourItem(job=0, stop=0, vertex=VertexId(1), duration=Tick(2)),
        TourItem(job=0, stop=1, vertex=VertexId(3), duration=Tick(0)),
        TourItem(job=None, stop=None, vertex=VertexId(0), duration=Tick(2)),
        TourItem(job=1, stop=0, vertex=VertexId(2), duration=Tick(1)),
    ]
    # Work from 0 to 2 at N1, a charge from 7 to 9 at N0, work from 11 to 12 at N2.
    track = Track.of([1, 2, 3, 2, 1, 0, 1, 2, 1, 0], [0, 3, 4, 5, 6, 7, 10, 11, 13, 14])
    plan = Plan(
        scenario=assign_tours(scenario, [tuple(tour)]),
        tracks=(track,),
        run=PlannerRun(name="by hand"),
    )
    assert rightofway.check(plan).ok
    through = "drive through"
    assert [event.purpose for event in list_events(plan)] == [
        "start, work at stop 1 of J1", through, "stop 2 of J1", through, through, "charge",
        through, "work at stop 1 of J2", through, "home",
    ]  # fmt: skip
