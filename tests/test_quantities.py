"""Times, lengths and speeds as people read them."""

import json
from fractions import Fraction
from pathlib import Path

import pytest

from rightofway import InputError
from rightofway.quantities import Quantities, TimeUnit, Units, decimal

CASES = json.loads((Path(__file__).parent / "data" / "quantities.json").read_text())
"""Values and their texts; the page is tested with the same ones."""


@pytest.mark.parametrize(("value", "text"), CASES["decimal"])
def test_a_number_has_at_most_two_decimals_and_looks_rounded_where_it_is(
    value: str, text: str
) -> None:
    assert decimal(Fraction(value)) == text


@pytest.mark.parametrize(("unit", "time", "text"), CASES["duration"])
def test_a_duration_is_written_in_the_parts_that_a_person_would_say(
    unit: TimeUnit | None, time: str, text: str
) -> None:
    quantities = Quantities(units=Units(time=unit), tick=Fraction(1))
    assert quantities.duration(Fraction(time)) == text


def test_lengths_and_speeds_have_the_units_of_the_scenario_or_none() -> None:
    metres = Quantities(units=Units(length="m", time="s"), tick=Fraction(1, 4))
    assert metres.length(Fraction(9, 20)) == "0.45 m"
    assert metres.speed(Fraction(6, 5)) == "1.2 m/s"
    assert metres.heading("completes") == "completes [s]"
    assert metres.cell(5) == "1.25"
    assert metres.ticks_per_hour() == 14400
    plain = Quantities(units=Units(), tick=Fraction(1))
    assert plain.length(Fraction(9, 20)) == "0.45 length units"
    assert plain.speed(Fraction(6, 5)) == "1.2"
    assert plain.heading("completes") == "completes"
    assert plain.moment(3) == "time 3"
    assert plain.ticks_per_hour() is None


def test_ticks_are_written_on_request() -> None:
    quantities = Quantities(units=Units(time="s"), tick=Fraction(1, 4), in_ticks=True)
    assert quantities.duration(1) == "1 tick"
    assert quantities.moment(7) == "tick 7"
    assert quantities.cell(7) == "7"
    assert quantities.heading("waits") == "waits [ticks]"


def test_an_unknown_unit_is_refused_with_those_that_are_known() -> None:
    with pytest.raises(InputError, match=r"length: 'km' is no unit \(give mm, cm or m\)"):
        Units(length="km")  # type: ignore[arg-type]
