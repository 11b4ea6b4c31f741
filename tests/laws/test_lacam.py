"""The native LaCAM finds the plan that a plain one finds."""

from __future__ import annotations

from fractions import Fraction

from hypothesis import strategies as st

from rightofway.model import Rules, Scenario, Track
from rightofway.precedence import build_graph_of_plan
from rightofway.search import plan_by_lacam
from tests.builders.fleets import grid_fleet
from tests.builders.laws import law
from tests.oracles.lacam import Fleet, tracks_by_lacam

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
MOST_EXPANDED = 100


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


@law(fleets(), st.integers(0, 2**32 - 1))
def test_the_kernel_finds_the_plan_of_the_oracle(scenario: Scenario, seed: int) -> None:
    """Both tell one robot more where to go where robots that choose alone get stuck."""
    problem = scenario.problem
    may_rotate = problem.booking_rules.may_rotate
    oracle = Fleet(
        scenario, headway=problem.booking_rules.headway, may_rotate=may_rotate, seed=seed
    )
    expected = tracks_by_lacam(oracle, MOST_EXPANDED)
    if expected is None:
        return
    tracks = [Track.of(vertices, enter) for vertices, enter in expected]
    earliest = build_graph_of_plan(problem, tracks).build_tracks()
    found = plan_by_lacam(problem, seed=seed, most_effort=10**6, spreads=False)
    assert found == list(earliest)
