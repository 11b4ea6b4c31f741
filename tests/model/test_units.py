"""The tick: exact where it can be, rounded up and said so where not."""

from fractions import Fraction

import pytest

from rightofway import _core
from rightofway.model import NEVER, Clock, choose_clock


@pytest.mark.parametrize(
    ("durations", "tick"),
    [
        (["1"], "1"),
        (["2", "3"], "1"),
        (["2", "4"], "2"),
        (["1/2", "1/3"], "1/6"),  # speeds 2 and 3 on unit cells
        (["1", "100/101"], "1/101"),  # speeds 1 and 1.01
        (["0", "3"], "3"),  # no work does not count
        ([], "1"),
    ],
)
def test_the_tick_is_the_largest_that_makes_every_duration_exact(
    durations: list[str], tick: str
) -> None:
    assert choose_clock(map(Fraction, durations)) == Clock(tick=Fraction(tick), exact=True)


def test_the_shortest_duration_has_at_most_1000_ticks_and_the_rest_is_rounded_up() -> None:
    # 1 and 1.0001 share only ticks of 1/10000; 1000 ticks for the shortest duration are the limit.
    clock = choose_clock([Fraction(1), Fraction(10001, 10000)])
    assert clock == Clock(tick=Fraction(1, 1000), exact=False)
    assert clock.count_ticks(Fraction(10001, 10000)) == 1001
    assert clock.convert_to_time(1001) == Fraction(1001, 1000)


def test_exactly_1000_ticks_for_the_shortest_duration_are_still_exact() -> None:
    assert choose_clock([Fraction(1), Fraction(1001, 1000)]).exact


def test_never_is_one_tick_in_both_languages() -> None:
    assert NEVER == _core.NEVER == 2**62
