"""Units of the numbers of a scenario, and numbers as English text for messages."""

from __future__ import annotations

from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from typing import Literal, get_args

from rightofway.errors import InputError, InputFault, quote

__all__ = ["LengthUnit", "TimeUnit", "Units", "Value", "round_half_up", "write_decimal"]

LengthUnit = Literal["mm", "cm", "m"]
TimeUnit = Literal["ms", "s", "min", "h"]

SECONDS: dict[str, Fraction] = {
    "ms": Fraction(1, 1000),
    "s": Fraction(1),
    "min": Fraction(60),
    "h": Fraction(3600),
}
"""How long each unit of time is [s]."""

METRES: dict[str, Fraction] = {"mm": Fraction(1, 1000), "cm": Fraction(1, 100), "m": Fraction(1)}
"""How long each unit of length is [m]."""

DIGITS = 2
"""Decimals of a number that is not exact in fewer."""

Value = Fraction | int | float


@dataclass(frozen=True, slots=True, kw_only=True)
class Units:
    """The units of a scenario's numbers; None if the scenario has none.

    Attributes
    ----------
    length
        Unit of lengths and coordinates: ``mm``, ``cm`` or ``m``.
    time
        Unit of times: ``ms``, ``s``, ``min`` or ``h``. Speeds are lengths per time.

    Raises
    ------
    InputError
        If a unit is unknown.
    """

    length: LengthUnit | None = None
    time: TimeUnit | None = None

    def __post_init__(self) -> None:
        faults = []
        for key, kind in (("length", LengthUnit), ("time", TimeUnit)):
            value, known = getattr(self, key), get_args(kind)
            if value is not None and value not in known:
                known_words = f"{', '.join(known[:-1])} or {known[-1]}"
                faults.append(InputFault(key, f"{quote(value)} is no unit (give {known_words})"))
        if faults:
            raise InputError(faults, "units")

    @property
    def seconds(self) -> Fraction | None:
        """Length of the time unit [s], or None where it is not known."""
        return None if self.time is None else SECONDS[self.time]

    @property
    def metres(self) -> Fraction | None:
        """Length of the length unit [m], or None where it is not known."""
        return None if self.length is None else METRES[self.length]

    def write_length(self, value: Value) -> str:
        """Return a length in English: ``0.45 m``, ``0.45 length units``."""
        number = write_decimal(value)
        unit = self.length or ("length unit" if number == "1" else "length units")
        return f"{number} {unit}"


def write_decimal(value: Value, digits: int = DIGITS) -> str:
    """Return a number as English decimal text.

    Parameters
    ----------
    value
        The number.
    digits
        The most decimals of the result.

    Returns
    -------
    str
        All decimals if ``digits`` are enough; else exactly ``digits`` decimals, so that a rounded
        number looks rounded; else, for numbers that would be 0.00, two significant digits.

    Examples
    --------
    >>> write_decimal(Fraction(1, 2)), write_decimal(Fraction(30313, 700))
    ('0.5', '43.30')
    >>> write_decimal(5), write_decimal(4.999)
    ('5', '5.00')
    >>> write_decimal(Fraction(1, 3000))
    '0.00033'
    """
    exact = Fraction(repr(value)) if isinstance(value, float) else Fraction(value)
    scaled = exact * 10**digits
    if scaled.denominator == 1:
        text = f"{Decimal(scaled.numerator).scaleb(-digits):f}"
        return text.rstrip("0").rstrip(".") if digits else text
    rounded = round_half_up(scaled)
    if rounded:
        return f"{Decimal(rounded).scaleb(-digits):f}"
    return f"{Decimal(f'{float(exact):.1e}'):f}"


def round_half_up(number: Fraction) -> int:
    """Return the nearest whole number; a half is rounded away from zero."""
    magnitude = (2 * abs(number.numerator) + number.denominator) // (2 * number.denominator)
    return magnitude if number >= 0 else -magnitude
