"""What is measured where no state came again, and when visits began."""

from fractions import Fraction

import numpy as np

from rightofway.cyclic import CyclicResult, GroupContext, GroupResult, make_cyclic_routes
from rightofway.cyclic.pattern import VisitTimes
from rightofway.cyclic.warmup import find_warm_up, measure
from tests.builders.fleets import grid_fleet

# Four cells there and back and two turns: laps of 8 visits and 10 ticks, the first one of 9.
[ALONE] = make_cyclic_routes(grid_fleet(["....."], [("N0", "N4")]))


def visits(*homes: int) -> list[int]:
    """Return a history of laps that end at these ticks; what is in between does not matter."""
    return [0, *(tick for home in homes for tick in [home - 1] * (len(ALONE.lap) - 1) + [home])]


def test_laps_of_the_warm_up_are_left_out() -> None:
    """One lap of 30 ticks and then ten of 10: the slots of 10 ticks count 0, 0, 0, 1, 1, 1, …"""
    history = [visits(*range(30, 140, 10))]
    measured = measure([ALONE], history)
    assert measured.warm_up == 30
    assert (measured.laps, measured.means) == ((10,), (Fraction(10),))


def test_where_all_is_even_nothing_is_left_out() -> None:
    assert find_warm_up([np.array([0, *range(5, 195, 10)])], 10, 190) == 0


def test_never_more_than_half_is_warm_up() -> None:
    """Laps get shorter and shorter; the latest are the most even ones."""
    homes = np.cumsum([0, 60, 50, 40, 30, 20, 10, 10])
    assert find_warm_up([homes], 10, 220) <= 110


def test_a_robot_that_stands_is_told_by_how_long_it_has_stood() -> None:
    """The other one sets the warm-up at 30; this one is home at 12 and 17, and then never."""
    measured = measure([ALONE, ALONE], [visits(*range(30, 140, 10)), visits(12, 17)])
    assert measured.warm_up == 30
    assert (measured.laps[1], measured.means[1]) == (1, Fraction(130 - 12, 2))


def test_a_lap_that_is_not_over_counts_only_if_it_is_long_already() -> None:
    measured = measure([ALONE, ALONE], [visits(*range(10, 140, 10)), visits(*range(10, 130, 10))])
    assert measured.means == (Fraction(10), Fraction(10))


def test_a_robot_that_was_never_home_again_has_no_mean() -> None:
    measured = measure([ALONE], [[0, 1, 2]])
    assert (measured.laps, measured.means) == ((0,), (None,))


def test_the_past_is_told_by_the_visits_that_were_late() -> None:
    """Alone it enters every tick, and turns for one more at visits 4 and 8; it waits 5 and 2."""
    past = VisitTimes(ALONE, 12, np.array([3, 10], np.int32), np.array([5, 7], np.int64))
    expected = [0, 1, 2, 8, 9, 11, 12, 13, 14, 16, 19, 20]
    assert list(past) == expected
    assert [past[visit] for visit in range(12)] == expected
    assert past[-1] == 20
    assert past[::8] == (0, 14)
    assert np.array(past).tolist() == expected


def test_laps_of_many_robots_in_an_hour_are_told_in_few_digits() -> None:
    """Means of 101 to 400 ticks: an exact sum of their inverses has over a hundred digits."""
    scenario = grid_fleet(["....."], [("N0", "N4")])
    context = GroupContext(scenario=scenario, routes=(ALONE,))
    groups = tuple(
        GroupResult(context=context, ends="open", history=(visits(ticks),))
        for ticks in range(101, 401)
    )
    found = CyclicResult(scenario=scenario, rule="first-come", routes="clear", groups=groups)
    assert (
        abs(found.compute_throughput() - Fraction(sum(1 / ticks for ticks in range(101, 401))))
        < 1e-6
    )
    assert found.compute_throughput().denominator <= 10**14
