"""Times, lengths and speeds as people read them."""

import json
from fractions import Fraction
from pathlib import Path

import pytest

from rightofway import InputError
from rightofway.report.quantities import Quantities, format_decimal
from rightofway.units import TimeUnit, Units

CASES = json.loads((Path(__file__).parents[1] / "data" / "quantities.json").read_text())
"""Values and their texts; the page is tested with the same ones."""


@pytest.mark.parametrize(("value", "text"), CASES["decimal"])
def test_a_number_has_at_most_two_decimals_and_looks_rounded_where_it_is(
    value: str, text: str
) -> None:
    assert format_decimal(Fraction(value)) == text


@pytest.mark.parametrize(("unit", "time", "text"), CASES["duration"])
def test_a_duration_is_written_in_the_parts_that_a_person_would_say(
    unit: TimeUnit | None, time: str, text: str
) -> None:
    quantities = Quantities(units=Units(time=unit), tick=Fraction(1))
    assert quantities.format_duration(Fraction(time)) == text


@pytest.mark.parametrize(("unit", "start", "time", "text"), CASES["clock"])
def test_a_moment_is_a_time_of_day_where_the_scenario_has_a_start(
    unit: TimeUnit, start: str, time: str, text: str
) -> None:
    units = Units(time=unit, start=start)  # type: ignore[arg-type]
    quantities = Quantities(units=units, tick=Fraction(1))
    assert quantities.format_moment(Fraction(time)) == text
    assert quantities.format_point(Fraction(time)) == text


def test_lengths_and_speeds_have_the_units_of_the_scenario_or_none() -> None:
    metres = Quantities(units=Units(length="m", time="s"), tick=Fraction(1, 4))
    assert metres.format_length(Fraction(9, 20)) == "0.45 m"
    assert metres.format_speed(Fraction(6, 5)) == "1.2 m/s"
    assert metres.format_heading("completes") == "completes [s]"
    assert metres.format_cell(5) == "1.25"
    assert metres.compute_ticks_per_hour() == 14400
    plain = Quantities(units=Units(), tick=Fraction(1))
    assert plain.format_length(Fraction(9, 20)) == "0.45 length units"
    assert plain.format_speed(Fraction(6, 5)) == "1.2"
    assert plain.format_heading("completes") == "completes"
    assert plain.format_moment(3) == "time 3"
    assert plain.compute_ticks_per_hour() is None


def test_ticks_are_written_on_request() -> None:
    quantities = Quantities(units=Units(time="s"), tick=Fraction(1, 4), in_ticks=True)
    assert quantities.format_duration(1) == "1 tick"
    assert quantities.format_moment(7) == "tick 7"
    assert quantities.format_cell(7) == "7"
    assert quantities.format_heading("waits") == "waits [ticks]"


def test_an_unknown_unit_is_refused_with_those_that_are_known() -> None:
    with pytest.raises(InputError, match=r"length: 'km' is no unit \(give mm, cm or m\)"):
        Units(length="km")  # type: ignore[arg-type]
