"""Numbers are read exactly as they are written, or refused."""

import sys
from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest

from rightofway.io.plain_data import read_decimal, read_whole
from rightofway.kinds.numbers import COORDINATE_DIGITS, format_number, read_exact


@pytest.mark.parametrize(
    ("value", "number"),
    [
        (3, Fraction(3)),
        ("3", Fraction(3)),
        ("1/3", Fraction(1, 3)),
        ("-4/6", Fraction(-2, 3)),
        ("0.1", Fraction(1, 10)),
        (".5", Fraction(1, 2)),
        ("2.", Fraction(2)),
        ("2e-3", Fraction(1, 500)),
        (Decimal("0.1"), Fraction(1, 10)),
        (Decimal("1E+2"), Fraction(100)),
        (0.1, Fraction(1, 10)),  # the shortest decimal that stands for the float
        (Fraction(1, 7), Fraction(1, 7)),
        (np.int64(7), Fraction(7)),
        ("0.10000000000000000000000000000", Fraction(1, 10)),
        (10**18, Fraction(10**18)),
    ],
)
def test_a_number_is_what_was_written(value: object, number: Fraction) -> None:
    assert read_exact(value) == number


@pytest.mark.parametrize(
    ("value", "reason"),
    [
        ("fast", "'fast' is not a number (write it like 3, 0.5 or 1/3)"),
        ("", "'' is not a number"),
        ("1 / 3", "is not a number"),
        ("1_000", "is not a number"),
        ("0x10", "is not a number"),
        ("٣", "is not a number"),
        ("nan", "is not a number"),
        (float("nan"), "nan is not a number"),
        (float("-inf"), "-inf is not a number"),
        (Decimal("NaN"), "NaN is not a number"),
        (True, "true is not a number"),
        (None, "nothing is not a number"),
        ([1], "[1] is not a number"),
        ("1/0", "'1/0' divides by zero"),
        (10**18 + 1, "is out of range (give at most 18 digits before and after the point)"),
        ("1e-19", "'1e-19' is out of range"),
        ("1e999999999", "'1e999999999' is out of range"),
        ("1e+0000000000999999999", "is out of range"),
        (Decimal("1e-999999999"), "is out of range"),
        pytest.param("9" * 100_000, "is out of range", id="long text"),
        pytest.param(10**100_000, "a number of 332193 bits is out of range", id="large int"),
    ],
)
def test_anything_else_is_refused_with_the_reason(value: object, reason: str) -> None:
    with pytest.raises(ValueError) as caught:  # noqa: PT011 - its text is looked at
        read_exact(value)
    assert reason in str(caught.value)
    assert len(str(caught.value)) < 200


def test_a_coordinate_may_have_the_digits_of_any_float() -> None:
    assert (
        float(read_exact("1.2246467991473532e-16", digits=COORDINATE_DIGITS))
        == 1.2246467991473532e-16
    )


def test_fractions_are_written_as_they_are_read() -> None:
    assert [format_number(Fraction(number)) for number in ("2", "1/3", "-0.5")] == [
        2,
        "1/3",
        "-1/2",
    ]


def test_numbers_too_large_to_hold_stay_text() -> None:
    assert read_whole("12") == 12
    assert read_decimal("0.10") == Decimal("0.10")
    digits = "9" * 41
    for token in ("1e309", "1e-401", f"0.{digits}"):
        assert read_decimal(token) == token
    assert read_whole(digits) == digits


def test_every_float_is_a_decimal_that_is_kept() -> None:
    for number in (sys.float_info.max, sys.float_info.min, 5e-324):
        kept = read_decimal(repr(number))
        assert isinstance(kept, Decimal)
        assert float(kept) == number
