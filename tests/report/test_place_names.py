"""What people call places: by name, by robot, or by where a cell is."""

from dataclasses import replace

from rightofway.model import Scenario
from rightofway.report.place_names import PlaceNames
from rightofway.units import Units
from tests.builders.fleets import grid_fleet

METRES = Units(length="m")


def scenario(*trips: tuple[str, str], units: Units = METRES) -> Scenario:
    """Return a fleet on eight cells of one length unit."""
    return replace(grid_fleet(["....", "...."], trips), units=units)


def test_a_cell_without_a_unit_of_length_keeps_its_number() -> None:
    place = PlaceNames(scenario(("N0", "N3"), units=Units()))
    assert (place(0), place(5), place.describe_place(0)) == ("N0", "N5", "N0")


def test_a_cell_of_a_measured_grid_goes_by_its_middle() -> None:
    assert PlaceNames(scenario(("N0", "N3")))(5) == "(1.5, 1.5)"


def test_homes_and_only_stops_go_by_their_robot() -> None:
    place = PlaceNames(scenario(("N0", "N3"), ("N4", "N7")))
    assert [place(vertex) for vertex in (0, 3, 4, 7)] == [
        "the home of R1", "the stop of R1", "the home of R2", "the stop of R2",
    ]  # fmt: skip
    assert place.describe_place(0) == "(0.5, 0.5)"


def test_numbered_names_have_the_number_that_tables_have() -> None:
    place = PlaceNames(scenario(("N0", "N3")), numbered=True)
    assert [place(vertex) for vertex in (0, 3, 5)] == [
        "the home of R1 (N0)", "the stop of R1 (N3)", "N5 (1.5, 1.5)",
    ]  # fmt: skip
    assert place.describe_place(0) == "N0 (0.5, 0.5)"
    assert PlaceNames(scenario(("N0", "N3"), units=Units()), numbered=True)(5) == "N5"


def test_a_stop_of_two_robots_goes_by_its_middle() -> None:
    place = PlaceNames(scenario(("N0", "N3"), ("N4", "N3")))
    assert place(3) == "(3.5, 0.5)"


def test_a_stop_at_the_home_of_another_robot_is_that_home() -> None:
    place = PlaceNames(scenario(("N0", "N4"), ("N4", "N7")))
    assert place(4) == "the home of R2"
