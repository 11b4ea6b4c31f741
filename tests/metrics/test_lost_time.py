"""Where each completion time goes, and which waits are one."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

import rightofway
from rightofway.metrics import compute_lost_time
from rightofway.model import Loss, Plan, PlannerRun, Robot, Rules, Scenario, Stop, Track
from rightofway.site import Edge, VertexId, make_roadmap
from tests.builders.fleets import grid_fleet
from tests.builders.plans import counter, door

Trip = tuple[Sequence[int], Sequence[int]]

ONE_WAY = {"ends": "none"}


def make_plan(grid: Sequence[str], *trips: Trip, **rules: Any) -> Plan:
    """Return robots that go one way, from the first to the last vertex of their trips."""
    ends = [(f"N{vertices[0]}", f"N{vertices[-1]}") for vertices, _ in trips]
    scenario = grid_fleet(grid, ends, rules=Rules(**ONE_WAY | rules))
    tracks = tuple(Track.of(vertices, enter) for vertices, enter in trips)
    return Plan(scenario=scenario, tracks=tracks, run=PlannerRun(name="by hand"))


def parts(plan: Plan) -> list[tuple[int, int, int, int]]:
    return [
        (lost.alone, lost.detours, lost.making_room, lost.waiting)
        for lost in compute_lost_time(plan)
    ]


def only_loss(plan: Plan) -> Loss:
    (loss,) = (loss for lost in compute_lost_time(plan) for loss in lost.losses)
    return loss


def test_a_robot_that_waits_loses_its_wait() -> None:
    plan = door()
    assert parts(plan) == [(9, 0, 0, 1), (9, 0, 0, 0)]
    loss = only_loss(plan)
    assert (loss.kind, loss.robot, loss.for_robot, loss.ticks) == ("waits", 0, 1, 1)
    assert (loss.vertex, loss.until_vertex, loss.towards, loss.freed) == (0, 0, 1, 1)
    assert (loss.tick, loss.end, loss.count) == (0, 1, 1)


def test_a_longer_way_is_a_detour() -> None:
    plan = make_plan(["...", "..."], ([0, 3, 4, 5, 2], [0, 1, 2, 3, 4]))
    assert parts(plan) == [(2, 2, 0, 0)]
    assert compute_lost_time(plan)[0].losses == ()


def test_a_robot_that_steps_aside_makes_room_for_the_one_that_comes_then() -> None:
    """R1 leaves N1 for N4 while R2 passes, waits there for 1 tick, and goes on to N2."""
    aside = ([0, 1, 4, 1, 2], [0, 1, 2, 4, 5])
    passing = ([3, 0, 1], [0, 2, 3])
    plan = make_plan(["...", "..."], aside, passing)
    (first, second) = compute_lost_time(plan)[0].losses
    assert parts(plan)[0] == (2, 0, 2, 1)
    assert (first.kind, first.vertex, first.towards) == ("makes room", 1, 4)
    assert (first.tick, first.end, first.ticks, first.for_robot) == (2, 4, 2, 1)
    assert (second.kind, second.vertex, second.tick, second.ticks) == ("waits", 4, 2, 1)


def test_a_robot_that_leaves_its_last_place_again_makes_room() -> None:
    """R1 works at its home for 2 ticks, and then has to leave: 1 + 1 ticks are lost."""
    scenario = grid_fleet(["..."], [("N0", "N0"), ("N2", "N1")], work=[2, 0])
    tracks = (Track.of([0, 1, 0], [0, 3, 4]), Track.of([2, 1, 2], [0, 8, 10]))
    plan = Plan(scenario=scenario, tracks=tracks, run=PlannerRun(name="by hand"))
    assert parts(plan)[0] == (2, 0, 2, 0)
    assert compute_lost_time(plan)[0].losses[0].for_robot is None


def test_waits_behind_one_robot_along_one_way_are_one() -> None:
    """R1 takes 2 ticks for an edge; R2, which takes 1, waits in N0, N1, N2 and N3."""
    scenario = grid_fleet(
        ["......"],
        [("N1", "N5"), ("N0", "N4")],
        rules=Rules(ends="none"),
        speeds=[Fraction(1, 2), Fraction(1)],
    )
    tracks = (
        Track.of([1, 2, 3, 4, 5], [0, 2, 4, 6, 8]),
        Track.of([0, 1, 2, 3, 4], [0, 2, 4, 6, 8]),
    )
    loss = only_loss(Plan(scenario=scenario, tracks=tracks, run=PlannerRun(name="by hand")))
    assert (loss.kind, loss.for_robot, loss.ticks, loss.count) == ("follows", 0, 4, 4)
    assert (loss.vertex, loss.until_vertex, loss.freed) == (0, 3, 4)
    assert (loss.tick, loss.end) == (0, 7)


def test_waits_for_one_robot_that_goes_another_way_stay_two() -> None:
    """R1 goes from N1 round by N4 and N5 to N2; R2 waits in N0 until 2 and in N1 until 6."""
    plan = make_plan(
        ["...", "..."],
        ([1, 4, 5, 2, 5], [0, 2, 3, 4, 6]),
        ([0, 1, 2], [0, 2, 6]),
    )
    losses = compute_lost_time(plan)[1].losses
    assert [(loss.kind, loss.for_robot, loss.ticks, loss.count) for loss in losses] == [
        ("waits", 0, 1, 1),
        ("waits", 0, 3, 1),
    ]


def test_a_wait_whose_reason_lies_further_on_names_that_place() -> None:
    """R2 waits in N0, and so comes to N3 as R1 leaves; N1 and N2 are free all the time."""
    plan = make_plan(["....", "...."], ([7, 3, 7], [0, 1, 6]), ([0, 1, 2, 3], [0, 4, 5, 6]))
    loss = compute_lost_time(plan)[1].losses[0]
    assert (loss.kind, loss.vertex, loss.towards) == ("waits", 0, 1)
    assert (loss.freed, loss.for_robot, loss.ticks) == (3, 0, 3)


def test_two_waits_for_one_leaving_are_one() -> None:
    """R2 waits in N0 and in N2 until R1 leaves N3."""
    plan = make_plan(["....", "...."], ([7, 3, 7], [0, 1, 6]), ([0, 1, 2, 3], [0, 3, 4, 6]))
    (loss,) = compute_lost_time(plan)[1].losses
    assert (loss.kind, loss.ticks, loss.count) == ("waits", 3, 2)
    assert (loss.vertex, loss.until_vertex, loss.freed) == (0, 2, 3)


def test_a_wait_that_nothing_compels_has_no_cause() -> None:
    loss = only_loss(make_plan(["..."], ([0, 1, 2], [0, 1, 4])))
    assert (loss.for_robot, loss.freed, loss.ticks) == (None, None, 2)


def test_a_tick_that_keeps_robots_from_rotating_is_lost_to_the_one_before() -> None:
    """R1 leaves N4 at tick 2; laps that keep robots apart let R2 enter it at tick 3."""
    trips = (([3, 4, 5], [0, 1, 2]), ([1, 4, 7], [0, 3, 4]))
    loss = only_loss(make_plan(["..."] * 3, *trips, rotations=False))
    assert (loss.for_robot, loss.freed, loss.ticks) == (0, 4, 2)


def test_a_robot_with_a_size_waits_for_one_that_is_too_near() -> None:
    """R2 may not drive to b before R1, one length unit from b in c, has come to d."""
    places = {"a": (0, 0), "b": (2, 0), "e": (4, 0), "c": (2, 1), "d": (2, 5)}
    roadmap = make_roadmap(
        places,
        [
            Edge(tail=tail, head=head, length=Fraction(length))
            for tail, head, length in (("a", "b", 2), ("b", "e", 2), ("c", "d", 4))
        ],
    )
    robots = tuple(
        Robot(
            name=name,
            home=roadmap.get_vertex(home),
            stops=(Stop(at=roadmap.get_vertex(stop)),),
            speed=Fraction(2),
            radius=Fraction(3, 5),
        )
        for name, home, stop in (("R1", "c", "d"), ("R2", "a", "e"))
    )
    scenario = Scenario(roadmap=roadmap, robots=robots, rules=Rules(ends="none", occupancy="both"))
    plan = rightofway.solve(scenario)
    loss = only_loss(plan)
    assert [roadmap.name(vertex) for vertex in (loss.vertex, loss.towards)] == ["a", "b"]
    assert loss.freed is not None
    assert (loss.for_robot, roadmap.name(loss.freed)) == (0, "c")


def test_work_at_the_end_is_no_loss() -> None:
    scenario = grid_fleet(["..."], [("N0", "N2")], rules=Rules(ends="none"), work=[5])
    track = Track.of([0, 1, 2], [0, 1, 2])
    plan = Plan(scenario=scenario, tracks=(track,), run=PlannerRun(name="by hand"))
    assert parts(plan) == [(7, 0, 0, 0)]
    assert compute_lost_time(plan)[0].completion == 7


def test_of_a_plan_that_jumps_the_parts_still_sum_up() -> None:
    """From N0 to N2 at once: 1 tick of 2, so the way is 1 tick shorter than the shortest."""
    (lost,) = compute_lost_time(make_plan(["..."], ([0, 2], [0, 1])))
    assert lost.completion == 1
    assert (lost.alone, lost.lost) == (2, -1)


def test_a_plan_answers_for_itself_in_plain_data() -> None:
    plan = door()
    names = [robot.name for robot in plan.scenario.robots]
    data = plan.lost_time[0].as_dict(names.__getitem__, plan.scenario.roadmap.name)
    loss = data.pop("losses")[0]
    assert data == {
        "completion": 10,
        "alone": 9,
        "detours": 0,
        "making_room": 0,
        "waiting": 1,
    }
    assert loss == {
        "kind": "waits",
        "robot": "R1",
        "for_robot": "R2",
        "vertex": "N0",
        "until_vertex": "N0",
        "towards": "N1",
        "freed": "N1",
        "tick": 0,
        "end": 1,
        "ticks": 1,
        "count": 1,
    }
    assert plan.lost_time[0].as_dict()["losses"][0]["vertex"] == VertexId(0)


def test_waits_of_several_laps_stay_apart() -> None:
    """R1 alone: 4 times 6 ticks and 3 turns at home. It waits for the counter from lap 2 on."""
    (lost, _) = compute_lost_time(counter())
    assert (lost.completion, lost.alone, lost.waiting) == (36, 27, 9)
    assert [(loss.kind, loss.for_robot, loss.ticks) for loss in lost.losses] == [
        ("waits", 1, 3)
    ] * 3
