"""Shifts in simulation: takeovers, rotations, charges, robots that break down, standstills."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from rightofway.check import check
from rightofway.dispatch.figures import measure_shift
from rightofway.facts import Fact
from rightofway.model import Tick
from tests.builders.shifts import hold_shift, make_scenario


def transport(name: str, pickup: str, dropoff: str, **others: Any) -> dict[str, Any]:
    """Return the document of a job."""
    return {"name": name, "pickup": pickup, "dropoff": dropoff, **others}


def test_a_robot_turns_to_a_job_that_becomes_known_on_its_way_home() -> None:
    jobs = [{"name": "J1", "at": "N4"}, {"name": "J2", "at": "N3", "earliest": 6}]
    record = hold_shift(make_scenario(["....."], {"R1": "N0"}, jobs=jobs))
    # R1 is at N4 at tick 4 and at N2 at tick 6, turns round there, and is at N3 at tick 7.
    assert record.jobs["J1"].ended == 4
    assert record.jobs["J2"].ended == 7
    assert record.robots[0].vertices.tolist() == [0, 1, 2, 3, 4, 3, 2, 3, 2, 1, 0]


def test_a_plan_takes_over_after_its_lead_and_robots_keep_what_they_have_begun() -> None:
    jobs = [{"name": "J1", "at": "N4"}, {"name": "J2", "at": "N3", "earliest": 6}]
    record = hold_shift(make_scenario(["....."], {"R1": "N0"}, jobs=jobs), lead=2)
    # The first round takes over at tick 2, so R1 is at N4 at tick 6. The round that J2 begins at
    # tick 6 takes over at tick 8; until then R1 goes on home, to N2.
    assert record.jobs["J1"].ended == 6
    assert record.robots[0].vertices.tolist() == [0, 1, 2, 3, 4, 3, 2, 3, 2, 1, 0]
    assert record.jobs["J2"].ended == 9


def test_robots_go_on_with_the_old_plan_for_as_long_as_a_round_takes() -> None:
    jobs = [{"name": "J1", "at": "N190"}, {"name": "J2", "at": "N0", "earliest": 101}]
    record = hold_shift(make_scenario(["." * 191], {"R1": "N0"}, jobs=jobs), lead=100)
    # The first plan takes over at tick 100. The second round begins at tick 200, and R1 ends J1
    # before it takes over.
    assert record.jobs["J1"].ended == 290


def test_four_robots_rotate_in_one_instant() -> None:
    homes = {"R1": "N0", "R2": "N1", "R3": "N3", "R4": "N2"}
    jobs = [
        {"name": f"J{k}", "at": at, "robot": f"R{k}"}
        for k, at in enumerate(("N1", "N3", "N2", "N0"), start=1)
    ]
    rules = {"occupancy": "one", "return": "none"}
    record = hold_shift(make_scenario(["..", ".."], homes, jobs=jobs, rules=rules))
    assert [own.ended for own in record.jobs.values()] == [1, 1, 1, 1]


BATTERY = {"tank": {"drive": "1/10", "charge": "1/5", "reserve": "1/10"}}


def test_a_robot_charges_at_home_while_it_has_nothing_to_do() -> None:
    jobs = [{"name": "J1", "at": "N4"}, {"name": "J2", "at": "N4", "earliest": 20}]
    robots = {"R1": {"home": "N0", "battery": "tank"}}
    record = hold_shift(
        make_scenario(["....."], robots, jobs=jobs, batteries=BATTERY, charging=["N0"])
    )
    # 8 drives take 8/10; home at tick 8 with 2/10, which 4 ticks of a charge make full.
    assert record.jobs["J2"].ended == 24
    assert (8, Fraction(1, 5)) in record.robots[0].soc
    assert (20, Fraction(1)) in record.robots[0].soc


def test_a_robot_whose_next_job_goes_to_another_one_charges_for_its_rest() -> None:
    """R1 has 5 of 20 cells left at N7, when it has driven 15; at home it needs 2 + 7 of them.

    A round begins at tick 25, in which it has nothing to do and 10 cells. It charges 8 more, to
    have a tenth of a battery more than it needs at home.
    """
    stops = [{"at": "N5"}, {"at": "N1"}, {"at": "N5"}]
    jobs = [
        {"name": "J1", "stops": stops, "robot": "R1"},
        {"name": "J2", "at": "N9", "robot": "R2", "earliest": 25},
    ]
    robots = {"R1": {"home": "N0", "battery": "tank"}, "R2": "N8"}
    tank = {"drive": "1/20", "charge": "1/40", "reserve": "1/10"}
    scenario = make_scenario(
        ["........", "........"], robots, jobs=jobs, batteries={"tank": tank}, charging=["N7"]
    )
    record = hold_shift(scenario, until=Tick(100))
    (charge,) = [step for step in record.robots[0].steps if not step.job]
    assert charge.begin == 15
    assert charge.end >= 25 + 8 * 2
    assert record.robots[0].vertices[-1] == 0
    assert check(record.make_plan()).ok


def test_a_charge_at_the_end_of_a_shift_counts_as_one() -> None:
    robots = {"R1": {"home": "N0", "battery": "tank"}}
    jobs = [{"name": "J1", "at": "N4"}]
    record = hold_shift(
        make_scenario(["....."], robots, jobs=jobs, batteries=BATTERY, charging=["N0"]),
        until=Tick(10),
    )
    # Home at tick 8 with 2/10, as above; two ticks of a charge add 2/5.
    (use,) = measure_shift(record).robots
    assert (use.driving, use.charging, use.idle) == (8, 2, 0)
    assert use.last_soc == Fraction(3, 5)
    assert check(record.make_plan()).ok


def test_a_robot_that_breaks_down_is_a_closure_and_others_do_the_rest() -> None:
    grid = ["....", "...."]
    jobs = [transport("J1", "N3", "N0"), transport("J2", "N7", "N4")]
    record = hold_shift(
        make_scenario(grid, {"R1": "N0", "R2": "N4"}, jobs=jobs), delays="stop:R1@1", until=Tick(60)
    )
    assert record.robots[0].lost == 1  # between N1 and N2
    assert {name for name, own in record.jobs.items() if own.ended is not None} == {"J1", "J2"}
    assert all(own.robot == 1 for own in record.jobs.values())


def test_others_go_on_while_a_loaded_robot_waits_behind_one_that_is_lost() -> None:
    """R1 breaks down in N10, the only way between both halves, and R2 has J2 on board."""
    jobs = [
        {"name": "J1", "at": "N10", "robot": "R1"},
        transport("J2", "N1", "N5", robot="R2"),
        {"name": "J3", "at": "N12", "robot": "R3", "earliest": 20},
    ]
    robots = {"R1": "N8", "R2": "N0", "R3": "N6"}
    record = hold_shift(
        make_scenario(["...@...", "......."], robots, jobs=jobs),
        delays="stop:R1@2",
        until=Tick(60),
    )
    assert record.jobs["J2"].begun is not None
    assert record.jobs["J2"].ended is None
    assert record.jobs["J3"].ended is not None
    assert not any(planned.stands for planned in record.rounds)


def test_a_shift_in_which_nothing_moves_says_why() -> None:
    jobs = [{"name": "J1", "at": "N1"}, transport("J2", "N1", "N0", load=2)]
    record = hold_shift(make_scenario([".."], {"R1": "N0"}, jobs=jobs), until=Tick(20))
    assert record.jobs["J2"].reason == "robot"
    ((tick, fact),) = record.facts
    assert (tick, fact.kind, fact.values["jobs"]) == (2, "nothing moves", 1)
    assert fact.values["reasons"] == (Fact("unserved robot"),)
    assert str(fact) == "nothing moves, and a job is known: no robot may do it and can carry it"


def test_a_job_of_a_robot_that_is_lost_is_no_job_without_a_place() -> None:
    """R1 has picked J1 up at N1 when it breaks down; J2 is done by R2."""
    jobs = [transport("J1", "N1", "N3"), {"name": "J2", "at": "N6", "robot": "R2"}]
    scenario = make_scenario(["....", "...."], {"R1": "N0", "R2": "N7"}, jobs=jobs)
    record = hold_shift(scenario, delays="stop:R1@2", until=Tick(40))
    (fact,) = {fact for _, fact in record.facts}
    assert str(fact) == "nothing moves, and a job is known: R1 does not go on"


def test_a_robot_enters_a_headway_after_another_one_has_left() -> None:
    jobs = [
        {"name": "J1", "at": "N4", "robot": "R1"},
        {"name": "J2", "at": "N3", "robot": "R2", "earliest": 1},
    ]
    rules = {"headway": 3, "return": "none"}
    record = hold_shift(make_scenario(["....."], {"R1": "N1", "R2": "N0"}, jobs=jobs, rules=rules))
    # R1 leaves N1 at tick 1, so R2 enters it at tick 4, and N3 at tick 6.
    assert record.jobs["J1"].ended == 3
    assert record.jobs["J2"].ended == 6
    assert check(record.make_plan()).ok


def test_a_late_robot_waits_before_a_closure_until_it_ends() -> None:
    jobs = [{"name": "J1", "at": "N4"}]
    scenario = make_scenario(
        ["....."], {"R1": "N0"}, jobs=jobs, closures=[{"at": "N3", "from": 5, "until": 20}],
        rules={"return": "none"},
    )  # fmt: skip
    # In time it leaves N3 at tick 4; five ticks late it would be there at tick 8.
    assert hold_shift(scenario).jobs["J1"].ended == 4
    late = hold_shift(scenario, delays="stop:R1@1+5")
    assert late.jobs["J1"].ended == 22
    assert check(late.make_plan()).ok


def test_a_job_that_ends_at_the_end_of_the_shift_is_done() -> None:
    """R1 is at N4 after 4 ticks."""
    scenario = make_scenario(["....."], {"R1": "N0"}, jobs=[{"name": "J1", "at": "N4"}])
    assert hold_shift(scenario, until=Tick(4)).jobs["J1"].ended == 4
    assert hold_shift(scenario, until=Tick(3)).jobs["J1"].ended is None
