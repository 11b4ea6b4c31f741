"""The paper's planner against the paper's tables, and where it goes beyond them."""

from dataclasses import replace
from fractions import Fraction
from typing import Any

import pytest

import rightofway
from rightofway.errors import GaveUp, InputError, NoPlanExists
from rightofway.model import Plan, Rules, Scenario, Status
from rightofway.model.kept_facts import RerouteReason
from rightofway.planners.two_level import replay_movement_groups
from rightofway.repair.plan_request import PlanRequest
from rightofway.repair.routing import choose_routes
from tests.builders.fleets import PAPER, grid_fleet, paper_scenario, random_fleet

CASES = {case["name"]: case for case in PAPER}
DOOR = ["...", "@.@", "..."]


def solve(scenario: Scenario, **options: str) -> Plan:
    return rightofway.solve(scenario, "two-level", options=options)


def rows(plan: Plan) -> dict[str, list[int]]:
    """Return the node that each robot holds at each tick until it is home, as in the paper."""
    grid = plan.scenario.roadmap.grid
    assert grid is not None
    found = {}
    for robot, track in zip(plan.scenario.robots, plan.tracks, strict=True):
        leave = [*track.enter[1:].tolist(), int(track.enter[-1]) + 1]
        found[robot.name] = [
            int(grid.cells[vertex])
            for vertex, begin, end in zip(track.vertices, track.enter, leave, strict=True)
            for _ in range(int(begin), end)
        ]
    return found


def published(name: str) -> Plan:
    return rightofway.solve(paper_scenario(CASES[name]), "paper")


@pytest.mark.parametrize("case", PAPER, ids=list(CASES))
def test_the_published_rows_come_out(case: dict[str, Any]) -> None:
    """All eight tables; some are printed in part, so the printed ticks are compared."""
    final, first = rows(published(case["name"])), case["first_tick"]
    for name, row in case["final"].items():
        assert final[name][first : first + len(row)] == row


@pytest.mark.parametrize("planner", ["two-level", "auto"])
def test_leaving_swaps_is_planning_as_published(planner: str) -> None:
    plan = rightofway.solve(paper_scenario(CASES["door-5"]), planner, options={"swaps": "leave"})
    assert rows(plan) == rows(published("door-5"))


def test_node_level_decides_by_the_conflicts_left_in_the_whole_system() -> None:
    # door-2, tick 3 in node 1: if R1 waits three are left, if R2 waits one.
    first = published("door-2").run.decisions[0]
    assert (first.tick, first.level, first.conflicts_left) == (3, "node", (3, 1))
    assert first.waits == 1


def test_robot_level_decides_by_the_work_achieved_sooner() -> None:
    # door-2, node 7: none is left either way; R1 waiting gives 19 + 28, R2 waiting 18 + 32.
    second = published("door-2").run.decisions[1]
    assert (second.tick, second.level, second.conflicts_left) == (12, "robot", (0, 0))
    assert second.completion_sums == (47, 50)
    assert second.waits == 0


def test_both_movement_groups_of_a_decision_can_be_followed_again() -> None:
    """door-2, node 7: R1 waiting gives 19 + 28, R2 waiting 18 + 32; group one is the plan."""
    plan = published("door-2")
    one, two = replay_movement_groups(plan, plan.run.decisions[1])
    assert one is not None
    assert two is not None
    assert (one.completions, two.completions) == ((19, 28), (18, 32))
    assert one.tracks == plan.tracks
    assert one.tracks != two.tracks


def test_a_plan_of_another_planner_has_no_movement_groups() -> None:
    plan = rightofway.solve(paper_scenario(CASES["door-2"]), "fixed-priority")
    with pytest.raises(InputError, match="fixed-priority has no movement groups"):
        replay_movement_groups(plan, plan.run.decisions[0])


def test_the_published_method_leaves_the_swap_of_door_5_and_the_judge_sees_it() -> None:
    faults = rightofway.check(published("door-5")).faults
    assert [(fault.kind, fault.tick) for fault in faults] == [("swap conflict", 7)]


def test_door_5_without_a_swap_has_flowtime_32() -> None:
    """R1 waits two ticks in N6 until R2 has passed the door: 11 + 21."""
    plan = solve(paper_scenario(CASES["door-5"]))
    assert rows(plan)["R1"] == [0, 1, 4, 7, 6, 6, 6, 6, 7, 4, 1, 0]
    assert [int(track.enter[-1]) for track in plan.tracks] == [11, 21]
    decision = plan.run.decisions[0]
    names = [plan.scenario.roadmap.name(vertex) for vertex in decision.vertices]
    assert (decision.kind, names) == ("head-on", ["N1", "N4", "N7"])  # in R2's order
    assert (decision.waits, decision.ticks) == (0, 2)
    assert plan.scenario.roadmap.name(decision.waits_at) == "N6"


@pytest.mark.parametrize("case", PAPER, ids=list(CASES))
@pytest.mark.parametrize("occupancy", ["one", "both"])
def test_by_default_no_plan_has_a_fault(case: dict[str, Any], occupancy: Any) -> None:
    scenario = paper_scenario(case)
    rules = Rules(occupancy=occupancy)
    plan = solve(rightofway.Scenario(roadmap=scenario.roadmap, robots=scenario.robots, rules=rules))
    assert rightofway.check(plan).ok


def test_robots_with_one_target_go_through_the_dead_end_one_after_the_other() -> None:
    """N0 and N2 both work at N7, behind the door: the second waits until the first is out."""
    plan = solve(grid_fleet(["...", "@.@", "@.@"], [("N0", "N7"), ("N2", "N7")]))
    # Alone: 0 1 4 7 7 4 1 0, seven ticks. R2 leaves N1 at tick 7, then R1 may enter it.
    assert sorted(int(track.enter[-1]) for track in plan.tracks) == [7, 13]
    assert plan.run.status == Status("waits only")


def test_a_deadlock_that_waiting_cannot_open_is_opened_by_another_way() -> None:
    """R1 works where R2 lives, in a corridor; R2 lets it pass twice from the bay next to it."""
    corridor = [".....", "@@@.@"]
    plan = solve(grid_fleet(corridor, [("N0", "N4"), ("N4", "N2")]))
    assert rightofway.check(plan).ok
    assert plan.run.status == Status("re-routed", robots=["R2"])
    assert plan.scenario.roadmap.get_vertex("N8") in plan.tracks[1].vertices
    assert "waiting cannot keep R1 and R2 apart" in str(plan.run.reroutes[0].because)


def test_a_robot_planned_again_on_its_own_route_is_not_called_rerouted() -> None:
    """R3 and R5 make way for R7, are planned again, and find that their own routes serve."""
    scenario = random_fleet(29, size=6, robots=8)
    plan = solve(scenario)
    assert plan.run.status == Status("re-routed", robots=["R7"])
    _, routes = choose_routes(PlanRequest(scenario=scenario, options={"routes": "clear"}))
    driven = [tuple(track.vertices.tolist()) for track in plan.tracks]
    other = [robot for robot, route in enumerate(routes) if driven[robot] != route.vertices]
    assert other == [reroute.robot for reroute in plan.run.reroutes] == [6]


def test_a_rerouted_robot_names_the_robot_that_it_makes_way_for() -> None:
    plan = solve(random_fleet(21, size=6, robots=8))
    assert [str(reroute.because) for reroute in plan.run.reroutes] == [
        "it makes way for R6",
        "it makes way for R6",
        "waiting cannot keep R4 and R6 apart at N28",
    ]


def test_where_one_robot_at_a_time_finds_no_way_all_are_planned_together() -> None:
    """Each works where the other lives, in a corridor with one bay: both have to use the bay."""
    plan = solve(grid_fleet([".....", "@@.@@"], [("N0", "N4"), ("N4", "N0")]))
    assert rightofway.check(plan).ok
    assert plan.run.status == Status("re-routed together")


def test_where_time_is_short_all_are_planned_together(monkeypatch: pytest.MonkeyPatch) -> None:
    def too_slow(*_: object) -> None:
        raise GaveUp("time ran out")

    monkeypatch.setattr("rightofway.planners.rights_of_way.reroute", too_slow)
    plan = solve(paper_scenario(CASES["door-5"]))
    assert plan.run.status == Status("re-routed together")
    assert plan.run.reroutes[0].because == RerouteReason("short time")


@pytest.mark.parametrize("occupancy", ["one", "both"])
def test_where_there_is_no_plan_that_is_proven(occupancy: Any) -> None:
    """A corridor without a bay: nobody can pass."""
    rules = Rules(occupancy=occupancy)
    with pytest.raises(NoPlanExists, match="R1 and R2 block each other"):
        solve(grid_fleet(["...."], [("N0", "N3"), ("N3", "N0")], rules=rules))


def test_a_full_ring_turns_only_where_rotations_are_allowed() -> None:
    ring, trips = ["..", ".."], [("N0", "N1"), ("N1", "N3"), ("N3", "N2"), ("N2", "N0")]
    allowed = Rules(ends="none", turn=Fraction(0))
    plan = solve(grid_fleet(ring, trips, rules=allowed))
    assert [track.enter.tolist() for track in plan.tracks] == [[0, 1]] * 4
    with pytest.raises(NoPlanExists):
        solve(grid_fleet(ring, trips, rules=replace(allowed, rotations=False)))


def test_the_published_method_says_where_it_is_stuck() -> None:
    """R2 stays at N2 permanently, where R1 has to pass on its way; the paper knows no other way."""
    scenario = grid_fleet(["...."], [("N0", "N3"), ("N1", "N2")], rules=Rules(ends="none"))
    with pytest.raises(GaveUp, match="waiting cannot keep R1 and R2 apart at N2"):
        solve(scenario, swaps="leave")


def test_a_place_without_a_way_is_proven_impossible() -> None:
    with pytest.raises(NoPlanExists, match="R1 has no way from N0 to N2"):
        solve(grid_fleet([".@."], [("N0", "N2")]))


def test_two_robots_cannot_end_at_one_place() -> None:
    scenario = grid_fleet(["..."], [("N0", "N1"), ("N2", "N1")], rules=Rules(ends="none"))
    with pytest.raises(NoPlanExists, match="R1 and R2 would both have to stay at N1 permanently"):
        solve(scenario)


def test_without_rotations_three_robots_in_a_ring_still_get_through() -> None:
    ring = ["..", ".."]
    scenario = grid_fleet(
        ring, [("N0", "N1"), ("N1", "N3"), ("N3", "N2")], rules=Rules(ends="none", rotations=False)
    )
    assert rightofway.check(solve(scenario)).ok
