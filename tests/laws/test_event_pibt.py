"""At every instant the kernel decides what the plain oracle decides."""

from __future__ import annotations

from fractions import Fraction
from itertools import accumulate, chain

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rightofway._core import Instants
from rightofway.model import Rules, Scenario
from rightofway.planners import planning_headway
from tests.builders.fleets import grid_fleet
from tests.oracles.event_pibt import Fleet

GRIDS = (
    ["...", "@.@"],
    ["..", ".."],
    [".....", "@@.@@"],
    ["...", ".@.", "..."],
    ["...."],
    ["@.@@.", "....."],
    ["@@@.@@@", "......."],
    ["..@@@..", "......."],
)
SPEEDS = [Fraction(1), Fraction(1, 2), Fraction(1, 3), Fraction(2, 5)]
INSTANTS = 12


@st.composite
def fleets(draw: st.DrawFn) -> Scenario:
    """Draw a fleet on a grid that may be full."""
    grid = draw(st.sampled_from(GRIDS))
    free = [f"N{k}" for k, cell in enumerate("".join(grid)) if cell == "."]
    homes = draw(st.lists(st.sampled_from(free), min_size=1, max_size=9, unique=True))
    targets = draw(st.permutations(free))[: len(homes)]
    rules = Rules(
        ends=draw(st.sampled_from(["home", "none"])),
        occupancy=draw(st.sampled_from(["one", "both"])),
        headway=draw(st.sampled_from([Fraction(0), Fraction(1, 2)])),
        rotations=draw(st.booleans()),
    )
    return grid_fleet(
        grid,
        list(zip(homes, targets, strict=True)),
        rules=rules,
        speeds=draw(st.lists(st.sampled_from(SPEEDS), min_size=1, max_size=6)),
        work=draw(st.lists(st.integers(0, 3), min_size=1, max_size=6)),
    )


def both(scenario: Scenario, seed: int) -> tuple[Instants, Fleet]:
    rules, trips = scenario.rules, scenario.problem.itineraries
    headway = planning_headway(scenario)
    may_rotate = rules.rotations and not rules.books_ahead and headway == 0
    stages = [trip.stages for trip in trips]
    kernel = Instants(
        scenario.roadmap.indptr,
        scenario.roadmap.heads,
        scenario.roadmap.length_class,
        np.array([trip.home for trip in trips], np.int32),
        np.array([0, *accumulate(map(len, stages))], np.int32),
        np.array([stage.vertex for stage in chain.from_iterable(stages)], np.int32),
        np.array([s.work + s.turn for s in chain.from_iterable(stages)], np.int64),
        np.array([ticks for trip in trips for ticks in trip.edge_ticks], np.int32),
        headway,
        rules.books_ahead,
        may_rotate,
        seed,
    )
    return kernel, Fleet(scenario, headway=headway, may_rotate=may_rotate, seed=seed)


@settings(max_examples=400, derandomize=True, deadline=None)
@given(fleets(), st.integers(0, 2**64 - 1), st.data())
def test_the_kernel_decides_what_the_oracle_decides(
    scenario: Scenario, seed: int, data: st.DataObject
) -> None:
    """Orders are drawn anew at every instant, and so is who is told where to go."""
    kernel, oracle = both(scenario, seed)
    for _ in range(INSTANTS):
        assert kernel.now == oracle.now
        undecided = oracle.undecided()
        assert set(kernel.undecided().tolist()) == undecided
        order = data.draw(st.permutations(sorted(undecided)))
        free = [robot for robot in range(len(oracle.robots)) if not oracle.busy(robot)]
        told = data.draw(
            st.lists(st.sampled_from(free), unique=True, max_size=3) if free else st.just([])
        )
        fixed = [
            (
                r,
                data.draw(
                    st.sampled_from([oracle.robots[r].at, *oracle.heads[oracle.robots[r].at]])
                ),
            )
            for r in told
        ]
        pairs = np.array(fixed, np.int32).reshape(-1, 2)
        moves = kernel.choose(np.array(order, np.int32), pairs)
        expected = oracle.choose(order, fixed)
        assert (moves is None) == (expected is None)
        if moves is None or expected is None:
            return
        assert sorted(map(tuple, moves.tolist())) == sorted(expected)
        if not kernel.go_on():
            assert not oracle.go_on(expected)
            return
        assert oracle.go_on(expected)


def test_a_ring_turns_at_the_pace_of_its_slowest() -> None:
    """Four robots of their own speeds on four places, each told to go where the next one is."""
    ring = grid_fleet(
        ["..", ".."],
        [("N0", "N1"), ("N1", "N3"), ("N3", "N2"), ("N2", "N0")],
        rules=Rules(ends="none"),
        speeds=SPEEDS,
    )
    kernel, oracle = both(ring, seed=0)
    trips = ring.problem.itineraries
    fixed = [(robot, int(trip.last)) for robot, trip in enumerate(trips)]
    moves = kernel.choose(np.arange(4, dtype=np.int32), np.array(fixed, np.int32))
    assert moves is not None
    slowest = max(trip.edge_ticks[0] for trip in trips)
    assert sorted(moves.tolist()) == [[robot, vertex, slowest] for robot, vertex in fixed]
    assert sorted(oracle.choose([0, 1, 2, 3], fixed) or []) == sorted(map(tuple, moves.tolist()))


def test_who_wants_where_another_drives_to_waits_and_makes_no_room_behind() -> None:
    """R1 wants to go into N12, which R3 drives to for three ticks; R2 wants to go past both."""
    third, one = Fraction(1, 3), Fraction(1)
    corridor = grid_fleet(
        ["@@@.@@@", "......."],
        [("N11", "N12"), ("N10", "N13"), ("N13", "N9"), ("N7", "N8")],
        rules=Rules(ends="none"),
        speeds=[one, one, third, one],
    )
    kernel, oracle = both(corridor, seed=0)
    vertex = corridor.roadmap.vertex
    stay = [(0, int(vertex("N11"))), (1, int(vertex("N10")))]
    moves = kernel.choose(np.array([2, 3], np.int32), np.array(stay, np.int32))
    under_way = [(2, int(vertex("N12")), 3), (3, int(vertex("N8")), 1)]
    assert moves is not None
    assert sorted(map(tuple, moves.tolist())) == under_way
    assert oracle.choose([2, 3], stay) == under_way
    assert kernel.go_on()
    assert oracle.go_on(under_way)
    moves = kernel.choose(np.array([0, 1], np.int32), np.zeros((0, 2), np.int32))
    assert moves is not None
    assert (moves.tolist(), oracle.choose([0, 1], [])) == ([], [])


def test_who_is_busy_or_told_to_jump_is_refused() -> None:
    """The first robot drives from N0 to N1, which takes it two ticks; then the second chooses."""
    speeds = [Fraction(1, 2), Fraction(1)]
    rules = Rules(ends="none")
    pair = grid_fleet(["......"], [("N0", "N5"), ("N3", "N4")], rules=rules, speeds=speeds)
    kernel, _ = both(pair, seed=0)
    nobody = np.zeros((0, 2), np.int32)
    with pytest.raises(ValueError, match=r"fixed\[1\]: 5 is not next to the robot"):
        kernel.choose(np.array([0], np.int32), np.array([[0, 1], [1, 5]], np.int32))
    assert kernel.choose(np.array([0, 1], np.int32), nobody) is not None
    assert kernel.go_on()
    with pytest.raises(ValueError, match=r"order\[0\]: 0 is busy"):
        kernel.choose(np.array([0], np.int32), nobody)
