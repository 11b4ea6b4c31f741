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
    routes = laps.extend(robots, ahead=100)
    assert routes is not None
    graph = build_graph_behind_released(plan.scenario, routes, [0, 0])
    once = ReleaseGraph.of(plan.scenario, plan.tracks)
    for part in once.list_waiting_parts():
        if part.number:
            shift = [route.end - 1 for route in make_routes_to_drive(plan)]
            later = part._replace(number=part.number + shift[part.robot])
            arrivals = {(a.robot, a.visit + shift[a.robot]) for a in once.waits(part)}
            assert arrivals <= set(graph.waits(later))
    assert not graph.find_rotation()


def test_a_robot_that_does_not_return_makes_no_laps() -> None:
    scenario = door().scenario
    rules = replace(scenario.rules, ends="none")
    plan = rightofway.solve(replace(scenario, rules=rules), "prioritized")
    with pytest.raises(InputError, match=r"ends at N., not at N. \(laps need robots that return"):
        LapsToDrive(plan)
