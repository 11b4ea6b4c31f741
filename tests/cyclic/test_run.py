"""Repeated work by hand: the paper's cases, who meets whom, dead ends, whole laps as a plan."""

import time
from dataclasses import replace
from fractions import Fraction
from typing import cast

import pytest

from rightofway import GaveUp, InputError, check, plan_of_laps, run_laps
from rightofway.cyclic import make_cyclic_routes
from rightofway.cyclic.pattern import find_pattern
from rightofway.cyclic.result import GroupResult
from rightofway.cyclic.route import GroupContext, split_groups
from rightofway.cyclic.run import share_time
from rightofway.cyclic.simulator import CyclicSimulator
from rightofway.model import Robot, Rules, Scenario, Stop
from rightofway.planners import Deadline
from rightofway.site import make_grid_roadmap
from tests.builders.fleets import PAPER, grid_fleet, paper_scenario

CASES = {case["name"]: paper_scenario(case) for case in PAPER}


def only_group(name: str, rule: str) -> GroupResult:
    [group] = run_laps(CASES[name], rule, routes="shortest").groups
    return group


def told(name: str, rule: str) -> tuple[set[tuple[str, int]], set[tuple[str, int]]]:
    """Return (place, who waits) in the first laps, and in each period."""
    scenario = CASES[name]
    run = run_laps(scenario, rule, routes="shortest")
    first, steady = (
        {(scenario.roadmap.name(one.vertex), one.waits) for one in found}
        for found in (run.groups[0].list_first_waits(), run.groups[0].waits())
    )
    return first, steady


def test_at_the_door_nobody_waits_from_the_second_lap_on() -> None:
    """Four cells out, a turn, four back, a turn: 10 ticks. R2 waits one tick, once and for all."""
    group = only_group("door-1", "first-come")
    assert group.pattern is not None
    assert (group.pattern.period, group.pattern.counts) == (10, (1, 1))
    assert told("door-1", "first-come") == ({("N1", 1)}, set())


def test_a_faster_robot_waits_for_the_slower_one_elsewhere_than_at_first() -> None:
    """R1 alone takes 20 ticks, R2 30. In the first laps each waits once, later only R1 does."""
    group = only_group("door-2", "first-come")
    assert group.pattern is not None
    assert (group.pattern.period, group.pattern.counts) == (30, (1, 1))
    assert group.compute_waiting_shares() == (Fraction(1, 3), Fraction(0))
    assert told("door-2", "first-come") == (
        {("N1", 1), ("N7", 0)},
        {("N1", 0), ("N7", 0)},
    )


def test_in_a_fixed_order_the_second_robot_may_wait_for_ever() -> None:
    """R1 is back at the door before R2 could be through it, lap after lap."""
    group = only_group("door-2", "fixed-order")
    assert group.pattern is not None
    assert group.pattern.counts == (1, 0)
    assert group.compute_mean_laps() == (Fraction(20), None)
    assert group.timetable is None


def test_laps_of_16_and_14_ticks_meet_in_the_rhythm_of_both() -> None:
    """8 laps of R1 take 128 ticks; in these R2 makes 9 laps of 14 and waits for 2."""
    group = only_group("cross-1", "first-come")
    assert group.pattern is not None
    assert (group.pattern.period, group.pattern.counts) == (128, (8, 9))
    assert group.compute_mean_laps() == (Fraction(16), Fraction(128, 9))


@pytest.mark.parametrize("rule", ["first-come", "fixed-order", "two-level"])
@pytest.mark.parametrize("name", CASES)
def test_every_case_of_the_paper_repeats(name: str, rule: str) -> None:
    assert only_group(name, rule).ends == "repeats"


def test_robots_that_share_no_place_have_no_common_period() -> None:
    """Two corridors: laps of 3 + 3 and 4 + 4 cells, and two turns each."""
    scenario = grid_fleet(["....@", "@@@@@", "....."], [("N0", "N3"), ("N10", "N14")])
    run = run_laps(scenario)
    assert [group.robots for group in run.groups] == [(0,), (1,)]
    assert [group.pattern.period for group in run.groups if group.pattern] == [8, 10]


def test_a_robot_between_two_others_joins_them_in_one_group() -> None:
    scenario = grid_fleet(["...."], [("N0", "N1"), ("N3", "N2"), ("N1", "N2")])
    groups = split_groups(scenario, make_cyclic_routes(scenario, "shortest"))
    assert [[endless.robot for endless in group] for group in groups] == [[0, 1, 2]]


class Restless:
    """A robot that does not come back to a state for as long as it is watched."""

    def __init__(self, context: GroupContext) -> None:
        self.context = context
        self.history = [[0]]
        self.watched: list[float] = []

    def advance(self, deadline: Deadline) -> tuple[int, int]:
        self.watched.append(deadline.measure_seconds_left() or 0.0)
        time.sleep(self.watched[-1])
        raise GaveUp("time ran out")

    def reset_states(self) -> None:
        """Nothing to forget."""


def test_time_that_others_leave_over_goes_to_a_group_that_is_open() -> None:
    """One robot of three may take a third of the time at first; the other two are soon done."""
    scenario = CASES["door-1"]
    routes = make_cyclic_routes(scenario, "shortest")
    two, one = (
        GroupContext(scenario=scenario, routes=tuple(group)) for group in (routes, routes[:1])
    )
    restless = Restless(one)
    simulations = [cast(CyclicSimulator, restless), CyclicSimulator(two, "first-come")]
    runs = share_time(simulations, Deadline.after(0.6), lambda _: None)
    assert [run.ends for run in runs] == ["open", "repeats"]
    assert restless.watched[0] < 0.21
    assert sum(restless.watched) > 0.5


def test_robots_that_live_in_each_others_corridor_come_to_a_standstill() -> None:
    """Neither can be where the other works, as the other never leaves the corridor."""
    run = run_laps(grid_fleet(["...."], [("N0", "N3"), ("N3", "N0")]))
    [group] = run.groups
    assert group.ends == "deadlock"
    assert group.why is not None
    assert group.why.kind == "deadlock"
    assert (group.why.values["one"], group.why.values["other"]) == (0, 1)
    assert str(group.why).startswith("waiting cannot keep R1 and R2 apart at ")
    assert group.pattern is None


def test_neighbours_that_set_out_through_each_others_homes_are_sent_round() -> None:
    """R1 and R2 live next to each other, each on the other one's shortest way."""
    trips = [("N5", "N7"), ("N6", "N4")]
    scenario = grid_fleet(["....", "....", "...."], trips)
    assert [group.ends for group in run_laps(scenario, routes="shortest").groups] == ["deadlock"]
    assert {group.ends for group in run_laps(scenario).groups} == {"repeats"}


def test_work_and_turn_at_home_are_part_of_a_lap() -> None:
    """Out and back 2 + 2 cells, a turn at the stop, at home work 3 and one turn: 9 ticks."""
    roadmap = make_grid_roadmap(["..."])
    stops = (Stop(at=roadmap.get_vertex("N2")), Stop(at=roadmap.get_vertex("N0"), work=Fraction(3)))
    scenario = Scenario(
        roadmap=roadmap, robots=(Robot(name="R1", home=roadmap.get_vertex("N0"), stops=stops),)
    )
    [endless] = make_cyclic_routes(scenario)
    assert endless.lap.duration == 9
    assert endless.lap.dwell == (4, 0, 1, 0)
    assert check(plan_of_laps(run_laps(scenario), laps=4)).ok


def test_the_period_is_the_least_one_and_the_transient_too() -> None:
    """Known to repeat from 10 to 22; in fact every 4 ticks, from the visit at 3 on."""
    history = [[0, 3, 5, 7, 9, 11, 13, 15, 17, 19, 21]]
    pattern = find_pattern(history, [2], (10, 22))
    assert (pattern.period, pattern.counts) == (4, (1,))
    assert (pattern.transient, pattern.begins) == (1, 5)
    assert pattern.enter(0, 12) == 25


def test_whole_laps_are_a_plan_that_the_judge_accepts() -> None:
    plan = plan_of_laps(run_laps(CASES["door-2"]), laps=5)
    assert [robot.laps for robot in plan.scenario.robots] == [5, 5]
    assert check(plan).ok


def test_a_robot_that_is_home_for_good_in_the_way_of_others_makes_no_plan() -> None:
    """R2 lives on R1's way: with one lap each it is home, permanently, before R1 is back."""
    scenario = grid_fleet(["....", "@.@@"], [("N0", "N3"), ("N2", "N5")], work=(9, 0))
    with pytest.raises(GaveUp, match="whole laps make no plan here"):
        plan_of_laps(run_laps(scenario, routes="shortest"), laps=1)


def test_no_plan_is_made_of_a_robot_that_waits_for_ever() -> None:
    with pytest.raises(GaveUp, match="R2 waits permanently"):
        plan_of_laps(run_laps(CASES["door-2"], "fixed-order", routes="shortest"))


def test_trips_without_a_way_back_and_rules_unknown_are_refused() -> None:
    trips = [("N0", "N3")]
    scenario = grid_fleet(["...."], trips, rules=Rules(ends="none"))
    with pytest.raises(InputError, match=r"rules.return: 'none' leaves nothing to repeat"):
        run_laps(scenario)
    alone = replace(scenario, rules=Rules(), robots=(replace(scenario.robots[0], ends="none"),))
    with pytest.raises(InputError, match=r"robots\[0\].return: 'none' leaves nothing to repeat"):
        run_laps(alone)
    with pytest.raises(InputError, match=r"robots\[0\].stops: all are at its home N0"):
        run_laps(grid_fleet(["...."], [("N0", "N0")]))
    with pytest.raises(InputError, match=r"rule: 'last-come' is unknown \(give first-come, fixed"):
        run_laps(grid_fleet(["...."], trips), "last-come")
