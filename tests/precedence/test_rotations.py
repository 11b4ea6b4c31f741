"""Which robots rotate in a plan."""

from fractions import Fraction

import pytest

from rightofway.model import Rules, Scenario, Track
from rightofway.precedence import find_rotation
from tests.builders.fleets import grid_fleet

RING = [("N0", "N1"), ("N1", "N4"), ("N4", "N3"), ("N3", "N0")]
"""Round four cells of a grid of three columns."""


def ring(rules: Rules) -> Scenario:
    return grid_fleet(["...", "..."], RING, rules=rules)


def move(*moves: tuple[int, int, int]) -> list[Track]:
    """Return tracks of one move each: from where, to where, and when."""
    return [Track.of([tail, head], [0, tick]) for tail, head, tick in moves]


def test_robots_of_a_circle_are_named_in_its_order() -> None:
    problem = ring(Rules(rotations=False)).problem
    assert find_rotation(problem, move((0, 1, 2), (1, 4, 2), (4, 3, 2), (3, 0, 2))) == (0, 1, 2, 3)


@pytest.mark.parametrize(
    "last",
    [(3, 0, 3), (3, 3, 2), (3, 2, 2)],
    ids=["later", "stays", "elsewhere"],
)
def test_a_queue_is_no_circle(last: tuple[int, int, int]) -> None:
    problem = ring(Rules(rotations=False)).problem
    assert find_rotation(problem, move((0, 1, 2), (1, 4, 2), (4, 3, 2), last)) == ()


def test_two_robots_exchange_their_places() -> None:
    problem = ring(Rules(rotations=False)).problem
    swap = move((0, 1, 2), (1, 0, 2), (4, 3, 2), (3, 4, 2))
    assert find_rotation(problem, swap) == ()


@pytest.mark.parametrize(
    "rules",
    [
        Rules(),
        Rules(rotations=False, occupancy="both"),
        Rules(rotations=False, headway=Fraction(1)),
    ],
    ids=["allowed", "booked ahead", "apart"],
)
def test_only_rules_that_leave_rotations_to_be_forbidden_have_any(rules: Rules) -> None:
    problem = ring(rules).problem
    assert find_rotation(problem, move((0, 1, 2), (1, 4, 2), (4, 3, 2), (3, 0, 2))) == ()
