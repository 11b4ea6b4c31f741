"""Every tick of a completion time is explained once; each wait has the cause that ticks show."""

from __future__ import annotations

from collections import Counter
from fractions import Fraction
from itertools import pairwise
from typing import get_args

from hypothesis import assume, given, settings
from hypothesis import strategies as st

import rightofway
from rightofway.errors import RightOfWayError
from rightofway.metrics import alone_completions, lost_time, waits
from rightofway.model import (
    Edge,
    Plan,
    Robot,
    Rules,
    Scenario,
    Stop,
    TripEnd,
    VertexId,
    roadmap_of_edges,
)
from tests.builders.fleets import random_fleet
from tests.oracles import lost_time as oracle


@st.composite
def rules(draw: st.DrawFn) -> Rules:
    ends = draw(st.sampled_from(get_args(TripEnd)))
    return Rules(
        occupancy=draw(st.sampled_from(["one", "both"])),
        headway=Fraction(draw(st.integers(0, 1))),
        ends=ends,
        laps=draw(st.integers(1, 2)) if ends == "home" else 1,
    )


@st.composite
def on_grids(draw: st.DrawFn) -> Scenario:
    seed = draw(st.integers(0, 10_000))
    return random_fleet(seed, size=6, robots=6, walls=0.2, rules=draw(rules()))


@st.composite
def on_roadmaps(draw: st.DrawFn) -> Scenario:
    """Return a fleet with several stops on a ring with chords, of edges of several lengths."""
    number = draw(st.integers(6, 10))
    ring = {(u, (u + 1) % number) for u in range(number)}
    vertices = st.integers(0, number - 1)
    chords = draw(st.sets(st.tuples(vertices, vertices), max_size=4))
    pairs = sorted({tuple(sorted(pair)) for pair in ring | chords if pair[0] != pair[1]})
    lengths = [Fraction(draw(st.integers(1, 3))) for _ in pairs]
    edges = [
        Edge(tail=f"v{u}", head=f"v{w}", length=length)
        for pair, length in zip(pairs, lengths, strict=True)
        for u, w in (pair, pair[::-1])
    ]
    homes, lasts = (draw(st.permutations(range(number)))[:3] for _ in range(2))
    robots = tuple(
        Robot(
            name=f"R{index}",
            home=VertexId(home),
            stops=tuple(
                Stop(at=VertexId(at), work=Fraction(draw(st.integers(0, 2))))
                for at in [*draw(st.lists(vertices, max_size=2)), last]
            ),
            speed=draw(st.sampled_from([Fraction(1), Fraction(1, 2)])),
            turn=Fraction(draw(st.integers(0, 1))),
        )
        for index, (home, last) in enumerate(zip(homes, lasts, strict=True))
    )
    roadmap = roadmap_of_edges({f"v{k}": (k, 0) for k in range(number)}, edges)
    return Scenario(roadmap=roadmap, robots=robots, rules=draw(rules()))


planners = st.sampled_from(["two-level", "prioritized", "lacam", "lns", "random-priority"])


def planned(scenario: Scenario, planner: str) -> Plan:
    options = {"iterations": 20} if planner == "lns" else {}
    try:
        return rightofway.solve(scenario, planner, time_limit=0.3, options=options)
    except RightOfWayError:
        assume(False)
        raise


@settings(max_examples=40, deadline=None, derandomize=True)
@given(on_grids() | on_roadmaps(), planners)
def test_alone_detours_making_room_and_waiting_sum_up_to_the_completion(
    scenario: Scenario, planner: str
) -> None:
    plan = planned(scenario, planner)
    alone = alone_completions(scenario)
    for lost, activity in zip(lost_time(plan), oracle.ticks_by_activity(plan), strict=True):
        assert lost.completion == plan.completions[lost.robot]
        assert lost.alone == alone[lost.robot]
        assert min(lost.detours, lost.making_room, lost.waiting) >= 0
        assert lost.waiting == activity["waits"]
        # Only a robot that leaves its last vertex again turns there before.
        turning = lost.making_room - activity["makes room"]
        assert 0 <= turning <= (activity["works"] if activity["makes room"] else 0)
        by_kind = Counter[str]()
        for loss in lost.losses:
            by_kind[loss.kind] += loss.ticks
        assert by_kind["makes room"] == lost.making_room
        assert by_kind["waits"] + by_kind["follows"] == lost.waiting


@settings(max_examples=40, deadline=None, derandomize=True)
@given(on_grids() | on_roadmaps(), planners)
def test_joined_waits_are_for_the_robots_that_hold_the_places(
    scenario: Scenario, planner: str
) -> None:
    plan = planned(scenario, planner)
    found: Counter[tuple[int, int | None]] = Counter()
    joined = 0
    for lost in lost_time(plan):
        for loss in lost.losses:
            if loss.kind != "makes room":
                found[loss.robot, loss.for_robot] += loss.ticks
                joined += loss.count
            if loss.kind == "follows":
                assert loss.for_robot is not None
                own, leader = (
                    set(pairwise(plan.tracks[robot].vertices.tolist()))
                    for robot in (loss.robot, loss.for_robot)
                )
                assert any(head == loss.freed for _, head in own & leader)
    assert found == oracle.causes(plan)
    assert joined == len(waits(plan))
