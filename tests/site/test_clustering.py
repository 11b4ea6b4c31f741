"""The paper's way in: node clustering, and floors cut into cells."""

from fractions import Fraction

import pytest

from rightofway.errors import InputError
from rightofway.site import Floor, Obstacle, cluster, compute_node_length, compute_steps_per_unit


def test_node_clustering_gives_the_numbers_of_the_paper() -> None:
    """Speeds 1 and 2: nodes of half a unit, two and four of them in a unit of time."""
    speeds = [Fraction(1), Fraction(2)]
    length = compute_node_length(speeds)
    assert length == Fraction(1, 2)
    assert [compute_steps_per_unit(speed, length) for speed in speeds] == [2, 4]


def obstacle(x: str, y: str, width: str, height: str) -> Obstacle:
    return Obstacle(
        name="table", x=Fraction(x), y=Fraction(y), width=Fraction(width), height=Fraction(height)
    )


def test_a_cell_is_blocked_if_an_obstacle_covers_any_part_of_it() -> None:
    # From 1.5 to 2.25 across and 0.5 to 1 down: columns 1 and 2 of row 0; row 1 begins at 1.
    floor = Floor(
        width=Fraction(4), height=Fraction(2), obstacles=(obstacle("3/2", "1/2", "3/4", "1/2"),)
    )
    assert cluster(floor, Fraction(1)) == (".@@.", "....")


def test_an_obstacle_may_stick_out_of_the_floor() -> None:
    floor = Floor(
        width=Fraction(3), height=Fraction(1), obstacles=(obstacle("-1", "-1", "3/2", "5"),)
    )
    assert cluster(floor, Fraction(1)) == ("@..",)


def test_what_is_left_of_the_floor_beyond_the_last_whole_cell_is_not_used() -> None:
    assert cluster(Floor(width=Fraction(5, 2), height=Fraction(1)), Fraction(1)) == ("..",)


def test_too_many_cells_are_refused_with_their_number_and_advice() -> None:
    floor = Floor(width=Fraction(100), height=Fraction(50))
    with pytest.raises(InputError, match=r"cell_size: cells of 1/10 make 1000 x 500 = 500000"):
        cluster(floor, Fraction(1, 10), max_cells=499_999)
    assert len(cluster(floor, Fraction(1, 10), max_cells=500_000)) == 500


def test_an_obstacle_outside_the_floor_is_named() -> None:
    with pytest.raises(InputError, match=r"obstacles\[0\].rect: lies outside the floor"):
        Floor(width=Fraction(2), height=Fraction(2), obstacles=(obstacle("2", "0", "1", "1"),))
