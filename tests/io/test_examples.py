"""The examples load, are what their comments say, and need nothing that is not beside them."""

from fractions import Fraction
from pathlib import Path

from rightofway import check, solve, waits
from rightofway.io import load, load_with_notes
from tests.builders.fleets import PAPER, paper_scenario
from tests.builders.sentences import tell_notes

EXAMPLES = Path(__file__).parents[2] / "examples"


def test_door_and_crossroad_are_cases_of_the_paper() -> None:
    cases = {case["name"]: case for case in PAPER}
    assert load(EXAMPLES / "door.yaml") == paper_scenario(cases["door-1"])
    assert load(EXAMPLES / "crossroad.yaml") == paper_scenario(cases["cross-3"])


def test_the_floor_is_cut_for_its_fastest_robot() -> None:
    loaded = load_with_notes(EXAMPLES / "floor.yaml")
    assert tell_notes(loaded) == ("floor cut into 24 x 16 = 384 cells of 0.5 m",)
    assert [robot.name for robot in loaded.scenario.robots] == [
        "porter",
        "runner",
        "cleaner",
        "feeder",
    ]


def test_the_warehouse_deals_out_three_speeds_and_work_up_to_twenty() -> None:
    robots = load(EXAMPLES / "warehouse.yaml").robots
    assert len(robots) == 50
    assert {robot.speed for robot in robots} == {Fraction(1), Fraction(1, 2), Fraction(1, 3)}
    works = {robot.stops[0].work for robot in robots}
    assert (min(works), max(works)) == (Fraction(0), Fraction(20))
    # Three speeds and eleven work times: every pair occurs within 33 robots.
    assert len({(robot.speed, robot.stops[0].work) for robot in robots}) == 33


def test_all_jobs_are_done_and_robots_charge_and_meet() -> None:
    plan = solve(load(EXAMPLES / "jobs.yaml"))
    assert (len(plan.scenario.robots), len(plan.scenario.jobs or ())) == (3, 9)
    assert check(plan).ok
    assert plan.unserved == ()
    assert plan.tours is not None
    assert any(item.job is None for tour in plan.tours for item in tour)
    assert waits(plan)
