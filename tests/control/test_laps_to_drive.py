"""Laps without end: the next period comes before the last one is driven, and the past goes."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

import rightofway
from rightofway.control import FleetControl, RobotLedger, SqliteJournal
from rightofway.control.dispatcher import Dispatcher
from rightofway.control.laps import LapsToDrive, build_graph_behind_released
from rightofway.control.routes import make_routes_to_drive
from rightofway.cyclic import find_best_timetable
from rightofway.errors import InputError
from rightofway.io import parse_scenario
from rightofway.model import Plan
from rightofway.precedence import ReleaseGraph
from tests.builders.chaos import MemoryJournal, laps_plan
from tests.builders.floors import Floor
from tests.builders.plans import door


def chosen_timetable() -> Plan:
    """Return whole laps of the door with the period of a chosen timetable, 10 ticks."""
    return laps_plan(door().scenario, find_best_timetable)


def begun(plan: Plan, journal: MemoryJournal | SqliteJournal) -> Dispatcher:
    """Return a dispatcher of laps, begun."""
    control = FleetControl(journal, snapshot_every=300)
    dispatcher = Dispatcher(control, plan, LapsToDrive(plan))
    dispatcher.begin("run")
    return dispatcher


@pytest.mark.parametrize("plan", [door(), chosen_timetable()], ids=["whole", "timetable"])
def test_laps_go_on_for_ever_and_all_jobs_are_done(plan: Plan) -> None:
    dispatcher = begun(plan, MemoryJournal())
    Floor(dispatcher).drive(600)
    for own in dispatcher.ledger.robots:
        assert own.laps_done > 20
        assert own.jobs_done - own.laps_done in {0, 1}  # one job a lap


def laps_that_begin_with_work_at_home(*, is_steady: bool) -> Plan:
    """Return laps of two robots round a ring; R1 loads at home N0, then unloads at N2."""
    document = {
        "format": "rightofway-scenario/1",
        "map": {"grid": ["...", ".@.", "..."]},
        "rules": {"rotations": False, "laps": 1 if is_steady else 2},
        "robots": [
            {
                "name": "R1",
                "home": "N0",
                "stops": [{"at": "N0", "work": 2}, {"at": "N2", "work": 1}],
            },
            {"name": "R2", "home": "N8", "target": "N6"},
        ],
    }
    scenario = parse_scenario(document)
    return laps_plan(scenario) if is_steady else rightofway.solve(scenario, "prioritized")


@pytest.mark.parametrize("is_steady", [False, True], ids=["whole", "steady"])
def test_work_at_home_that_begins_a_lap_is_done_in_each_lap(is_steady: bool) -> None:
    dispatcher = begun(laps_that_begin_with_work_at_home(is_steady=is_steady), MemoryJournal())
    floor = Floor(dispatcher)
    floor.drive(200)
    own = dispatcher.ledger.robots[0]
    assert own.laps_done > 5
    assert own.jobs_done - 2 * own.laps_done in {0, 1, 2}  # two jobs a lap, and those of this one
    floor.send(dispatcher.replan())  # what follows begins with the first lap of the plan
    floor.drive(200)
    assert own.laps_done > 10
    assert own.jobs_done - 2 * own.laps_done in {0, 1, 2}


def test_a_robot_that_waits_at_home_drives_out_and_back_before_it_works_there() -> None:
    """R2 is off the floor, and R1 comes to the end of its laps; then R2 is placed again.

    What R1 holds, an order that was sent, gets no more work.
    """
    dispatcher = begun(laps_that_begin_with_work_at_home(is_steady=False), MemoryJournal())
    floor = Floor(dispatcher)
    floor.drive(5)
    own = dispatcher.ledger.robots[0]
    floor.send(floor.operator.operate("remove", "R2"))
    floor.drive(100)
    jobs, laps = own.jobs_done, own.laps_done
    assert own.held == ("N0",)
    assert own.route.end - 1 == own.arrived
    floor.robots[1].forget()
    floor.robots[1].place = "N8"
    floor.send(floor.operator.place_robot("R2", "N8"))
    floor.drive(200)
    assert own.laps_done > laps + 5
    assert own.jobs_done - jobs - 2 * (own.laps_done - laps) in {0, 1, 2}


def laps_on_a_ring() -> Floor:
    """Return R1 of the ring alone, which is to bring something to N2 in each of three laps."""
    document = {
        "format": "rightofway-scenario/1",
        "map": {"grid": ["...", ".@.", "..."]},
        "rules": {"rotations": False, "laps": 3},
        "robots": [{"name": "R1", "home": "N0", "target": "N2", "work": 1}],
    }
    return Floor(begun(rightofway.solve(parse_scenario(document), "prioritized"), MemoryJournal()))


def test_a_lap_whose_work_is_withdrawn_ends_with_the_lap_before() -> None:
    """Of the first three laps R1 has work in the first and in the third: it comes home twice."""
    floor = laps_on_a_ring()
    own = floor.dispatcher.ledger.robots[0]
    job = own.route.jobs[6][0]
    floor.send(floor.operator.withdraw_job(f"R1/{job}"))
    while own.arrived != 8:
        floor.drive(1)
    assert (own.laps_done, own.jobs_done) == (3, 2)
    again = FleetControl(floor.dispatcher.control._journal)
    assert again.ledger.robots[0].laps_done == 3


def test_a_lap_whose_work_is_withdrawn_while_its_robot_is_at_home_is_over() -> None:
    """R1 has made one lap and is held when the work of its second one is withdrawn."""
    floor = laps_on_a_ring()
    own = floor.dispatcher.ledger.robots[0]
    while own.released < 4:
        floor.drive(1)
    floor.send(floor.operator.operate("hold", "R1"))
    floor.drive(20)
    assert (own.arrived, own.released, own.laps_done) == (4, 4, 1)
    job = own.route.jobs[6 - own.route.first][0]
    floor.send(floor.operator.withdraw_job(f"R1/{job}"))
    assert own.laps_done == 2
    again = FleetControl(floor.dispatcher.control._journal)
    assert again.ledger.robots[0].laps_done == 2


def test_a_lap_is_counted_once_where_a_robot_is_placed_before_it_has_worked_at_its_end() -> None:
    """R1 comes home, which ends a lap, and is taken off the floor before it loads for the next."""
    dispatcher = begun(laps_that_begin_with_work_at_home(is_steady=True), MemoryJournal())
    floor = Floor(dispatcher)
    own = dispatcher.ledger.robots[0]
    while own.laps_done < 1:
        floor.drive(1)
    assert own.route.get_jobs(own.arrived)
    assert not own.finished.issuperset(own.route.get_jobs(own.arrived))
    floor.send(floor.operator.operate("remove", "R1"))
    floor.robots[0].forget()
    floor.send(floor.operator.place_robot("R1", "N0"))
    floor.drive(100)
    assert own.laps_done > 5
    assert own.jobs_done - 2 * own.laps_done in {0, 1, 2}


def test_what_a_control_knows_and_keeps_does_not_grow(tmp_path: Path) -> None:
    """After 40 and after 400 laps the ledger is as large; the journal has some snapshots' worth."""
    journal = SqliteJournal(tmp_path / "run.journal")
    journal._database.execute("PRAGMA synchronous = OFF")  # nobody takes the current away here
    dispatcher = begun(chosen_timetable(), journal)
    floor, sizes, laps = Floor(dispatcher), [], []
    for steps in (1000, 9000):
        floor.drive(steps)
        sizes.append(len(str(dispatcher.ledger.make_snapshot())))
        laps.append(dispatcher.ledger.robots[0].laps_done)
    assert laps[1] > 8 * laps[0]
    assert sizes[1] < 1.2 * sizes[0]
    assert len(list(journal.read_history())) < 1200
    journal.close()


def test_a_start_from_a_snapshot_knows_all_that_was_known(tmp_path: Path) -> None:
    journal = SqliteJournal(tmp_path / "run.journal")
    journal._database.execute("PRAGMA synchronous = OFF")  # nobody takes the current away here
    dispatcher = begun(chosen_timetable(), journal)
    Floor(dispatcher).drive(1000)
    again = FleetControl(journal)
    assert again.ledger.make_snapshot() == dispatcher.ledger.make_snapshot()
    assert len(list(journal.read_entries())) < len(list(journal.read_history()))
    journal.close()


def test_the_next_period_has_the_rights_of_way_of_the_plan() -> None:
    """The door's plan twice is the plan of two laps, by the definition of the graph."""
    plan = door()
    laps = LapsToDrive(plan)
    robots = [RobotLedger(route) for route in make_routes_to_drive(plan)]
    for own in robots:
        own.take_route(own.route)
    more = laps.extend(robots, ahead=100)
    assert more is not None
    graph = build_graph_behind_released(plan.scenario, more.routes, [0, 0])
    once = ReleaseGraph.of(plan.scenario, plan.tracks)
    for part in once.list_waiting_parts():
        if part.number:
            shift = [route.end - 1 for route in make_routes_to_drive(plan)]
            later = part._replace(number=part.number + shift[part.robot])
            arrivals = {(a.robot, a.visit + shift[a.robot]) for a in once.waits(part)}
            assert arrivals <= set(graph.waits(later))
    assert not graph.find_rotation()


@pytest.mark.parametrize("plan", [door(), chosen_timetable()], ids=["whole", "timetable"])
def test_laps_that_are_counted_end_at_home_with_nothing_released_beyond(plan: Plan) -> None:
    """The timetable has one lap more of R1 than of R2."""
    dispatcher = Dispatcher(FleetControl(MemoryJournal()), plan, LapsToDrive(plan, 6))
    dispatcher.begin("run")
    floor = Floor(dispatcher)
    floor.drive(300)
    assert dispatcher.control.is_done
    assert min(own.laps_done for own in dispatcher.ledger.robots) == 6
    for own, robot in zip(dispatcher.ledger.robots, floor.robots, strict=True):
        assert own.jobs_done == own.laps_done
        assert robot.place == own.route.places[-1]
        assert not robot.ahead


def test_a_robot_that_does_not_return_makes_no_laps() -> None:
    scenario = door().scenario
    rules = replace(scenario.rules, ends="none")
    plan = rightofway.solve(replace(scenario, rules=rules), "prioritized")
    with pytest.raises(InputError, match=r"ends at N., not at N. \(laps need robots that return"):
        LapsToDrive(plan)
