"""Plans released part by part, on any fleet: no robots hold the same, and all come to their end."""

from __future__ import annotations

import random
from dataclasses import replace

from hypothesis import strategies as st

from rightofway.check import check
from rightofway.io import parse_scenario
from rightofway.model import Scenario, Track
from rightofway.precedence import Arrival, Part, ReleaseGraph
from tests.builders.any_fleet import any_fleet
from tests.builders.any_plan import STRICT, planned
from tests.builders.laws import law, leave, once
from tests.oracles.release import Floor

THROUGH_ZONES = any_fleet(robots=(2, 4), always={"passed", "zones"})
"""Robots that drive through passed vertices, and through zones, half of all cases."""

planners, seeds = st.sampled_from(STRICT), st.integers(0, 2**32 - 1)


def _star() -> Scenario:
    """Two robots that exchange places by a passed vertex, with a zone on one of its lanes."""
    ends = {f"v{k}": [0, k] for k in range(1, 4)}
    lanes = [{"from": "v0", "to": name, "length": at[1]} for name, at in ends.items()]
    trips = [("v1", "v2"), ("v2", "v1")]
    return parse_scenario(
        {
            "format": "rightofway-scenario/1",
            "map": {
                "roadmap": {
                    "vertices": {"v0": {"at": [0, 0], "pass": True}, **ends},
                    "edges": lanes,
                    "zones": [{"name": "Z", "edges": [["v0", "v1"]]}],
                }
            },
            "robots": [
                {"name": f"R{k}", "home": home, "target": target}
                for k, (home, target) in enumerate(trips, 1)
            ],
        }
    )


@law(any_fleet(without={"no rotations"}), planners)
def test_a_plan_has_a_cycle_just_where_it_has_a_rotation(fleet: Scenario, planner: str) -> None:
    """Those who wait for each other round a circle are those who move round at one instant."""
    plan = planned(fleet, planner)
    cycle = ReleaseGraph.of(fleet, plan.tracks).find_rotation()
    strict = replace(fleet, rules=replace(fleet.rules, rotations=False))
    faults = check(replace(plan, scenario=strict)).faults
    rotating = [set(fault.robots) for fault in faults if fault.kind == "rotation"]
    assert bool(cycle) == bool(rotating)
    assert not cycle or {part.robot for part in cycle} in rotating


@law(any_fleet() | THROUGH_ZONES, planners, seeds, st.sampled_from([1, 2, 1000]))
@once(fleet=_star(), planner="auto", chance=0, ahead=1)
def test_robots_released_part_by_part_hold_nothing_together_and_come_to_their_end(
    fleet: Scenario, planner: str, chance: int, ahead: int
) -> None:
    """They are released and arrive in any order; at each step the graph equals its oracle."""
    plan, draw = planned(fleet, planner), random.Random(chance)  # noqa: S311
    tracks, robots = plan.tracks, range(len(plan.tracks))
    graph, floor = ReleaseGraph.of(fleet, tracks), Floor(fleet, tracks)
    if graph.find_rotation():
        leave("a rotation is released by no order")
    ends = [len(track) - 1 for track in tracks]
    arrived, released = [0 for _ in robots], [0 for _ in robots]
    while arrived != ends:
        moves = list[tuple[str, int]]()
        for robot in robots:
            if arrived[robot] < released[robot]:
                moves.append(("arrives", robot))
            if released[robot] == ends[robot]:
                continue
            part = Part(robot, released[robot] + 1)
            may_go = graph.may_go(part, arrived)
            assert may_go == floor.may_go(*part, arrived)
            if may_go and released[robot] - arrived[robot] < ahead:
                moves.append(("is released", robot))
        assert moves, f"stuck at {arrived} of {ends}"
        move, robot = draw.choice(moves)
        if move == "arrives":
            arrived[robot] += 1
            for part in graph.list_waiting_for(Arrival(robot, arrived[robot])):
                assert Arrival(robot, arrived[robot]) in graph.waits(part)
        else:
            released[robot] += 1
            assert floor.held_together(arrived, released) == []


@law(any_fleet(), planners)
def test_only_the_order_of_arrivals_counts(fleet: Scenario, planner: str) -> None:
    """Numbers of arrivals in the place of times give the same graph, however long drives take."""
    tracks = planned(fleet, planner).tracks
    graph = ReleaseGraph.of(fleet, tracks)
    instants = sorted({tick for track in tracks for tick in track.enter.tolist()})
    number = {tick: 2 * k for k, tick in enumerate(instants)}
    numbered = [
        Track.of(track.vertices.tolist(), [number[tick] for tick in track.enter.tolist()])
        for track in tracks
    ]
    by_order = ReleaseGraph.of(fleet, numbered)
    parts = {*graph.list_waiting_parts(), *by_order.list_waiting_parts()}
    assert {part: graph.waits(part) for part in parts} == {
        part: by_order.waits(part) for part in parts
    }
