"""Frames of maps, and lengths of edges that are not given."""

from fractions import Fraction

import pytest

from rightofway import InputError
from rightofway.site import (
    Frame,
    Point,
    choose_rounding_step,
    make_grid_roadmap,
    make_roadmap,
    measure_squared_distance,
    measure_straight_length,
)
from rightofway.site.geometry import COARSE, FINE

HALF = Fraction(1, 2)
ZERO = (Fraction(0), Fraction(0))


def at(x: Fraction | int, y: Fraction | int) -> Point:
    return Fraction(x), Fraction(y)


def test_a_frame_leads_to_the_site_and_back() -> None:
    down, up = Frame(x=Fraction(2), y=Fraction(3)), Frame(x=Fraction(2), y=Fraction(3), y_up=True)
    assert down.to_site(at(1, 1)) == at(3, 4)
    assert up.to_site(at(1, 1)) == at(3, 2)
    assert down.to_plane(at(3, 4)) == up.to_plane(at(3, 2)) == at(1, 1)


@pytest.mark.parametrize(
    ("y_up", "origin", "first", "last"),
    [
        (False, None, (HALF, HALF), (5 * HALF, 3 * HALF)),  # the upper left corner is (0, 0)
        (True, None, (HALF, 3 * HALF), (5 * HALF, HALF)),  # the lower left corner is (0, 0)
        (False, at(10, 20), (21 * HALF, 37 * HALF), (25 * HALF, 39 * HALF)),
        (True, at(10, 20), (21 * HALF, 43 * HALF), (25 * HALF, 41 * HALF)),
    ],
)
def test_the_origin_is_the_lower_left_corner_of_a_grid(
    y_up: bool, origin: Point | None, first: Point, last: Point
) -> None:
    """Two rows of three cells of length 1: a cell's point is its centre."""
    roadmap = make_grid_roadmap(["...", "..."], y_up=y_up, origin=origin)
    assert (roadmap.get_point(0), roadmap.get_point(5)) == (first, last)


def test_a_vertex_keeps_its_point_where_y_grows_upwards() -> None:
    roadmap = make_roadmap({"a": (0.1, -19.65), "b": (0.1, 4.0)}, [], y_up=True)
    assert roadmap.get_point(0) == (Fraction("0.1"), Fraction("-19.65"))
    assert roadmap.positions[0, 1] > roadmap.positions[1, 1], "a is drawn below b"
    assert roadmap != make_roadmap({"a": (0.1, 19.65), "b": (0.1, -4.0)}, [])


def test_a_distance_that_is_a_fraction_is_exact() -> None:
    assert (
        measure_straight_length(
            measure_squared_distance(ZERO, at(Fraction(3, 10), Fraction(4, 10)))
        )
        == HALF
    )


def test_other_distances_are_rounded_up_to_the_step() -> None:
    # the root of 2 is 1.41421356..., and its least multiple of 1/1000 above is 1.415
    assert measure_straight_length(Fraction(2)) == Fraction("1.415")
    assert measure_straight_length(Fraction(2), FINE) == Fraction("1.414214")


def test_the_step_is_finer_where_a_distance_is_below_1() -> None:
    assert choose_rounding_step([Fraction(2)]) == COARSE
    assert choose_rounding_step([Fraction(2), Fraction(1, 2)]) == FINE


def test_a_rounded_length_is_never_short_and_less_than_a_step_too_long() -> None:
    for x in range(1, 40):
        square = measure_squared_distance(ZERO, at(x, Fraction(1, 7)))
        length = measure_straight_length(square)
        assert (length - COARSE) ** 2 < square <= length**2


@pytest.mark.parametrize(
    ("head", "message"),
    [(ZERO, "has no length"), (at(10**17, 1), "about 1e.17, has too many digits")],
)
def test_a_distance_that_cannot_be_kept_is_refused(head: Point, message: str) -> None:
    with pytest.raises(InputError, match=message):
        measure_straight_length(measure_squared_distance(ZERO, head))
