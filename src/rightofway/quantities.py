"""Times, lengths and speeds as people read them: ``6 min 23 s``, ``0.45 m``, ``1.2 m/s``.

Inside the program times are ticks, and lengths and speeds are exact fractions. `Quantities` is the
only place where these become text for people; files and JSON keep the exact values.
"""

from __future__ import annotations

from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from typing import Literal, get_args

from rightofway.arguments import checks_arguments
from rightofway.errors import InputError, InputFault, quote
from rightofway.phrases import Phrase, mark_figure, say_count

__all__ = ["Quantities", "Units", "format_decimal"]

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
    """What a scenario's numbers are measured in; None where the scenario does not say.

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

    def format_length(self, value: Value) -> str:
        """Return a length: ``0.45 m``, ``0.45 length units``."""
        number = format_decimal(value)
        return (
            mark_figure(f"{number} {self.length}")
            if self.length
            else say_count(number, "length unit", "length units")
        )


def format_decimal(value: Value, digits: int = DIGITS) -> str:
    """Return a number as a person writes it; pages write it with the point of their language.

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
    >>> format_decimal(Fraction(1, 2)), format_decimal(Fraction(30313, 700))
    ('0.5', '43.30')
    >>> format_decimal(5), format_decimal(4.999)
    ('5', '5.00')
    >>> format_decimal(Fraction(1, 3000))
    '0.00033'
    """
    return mark_figure(_write_decimal(value, digits))


def _write_decimal(value: Value, digits: int) -> str:
    exact = Fraction(repr(value)) if isinstance(value, float) else Fraction(value)
    scaled = exact * 10**digits
    if scaled.denominator == 1:
        text = f"{Decimal(scaled.numerator).scaleb(-digits):f}"
        return text.rstrip("0").rstrip(".") if digits else text
    rounded = _half_up(scaled)
    if rounded:
        return f"{Decimal(rounded).scaleb(-digits):f}"
    return f"{Decimal(f'{float(exact):.1e}'):f}"


def _half_up(number: Fraction) -> int:
    """Return the nearest whole number; a half is rounded away from zero."""
    magnitude = (2 * abs(number.numerator) + number.denominator) // (2 * number.denominator)
    return magnitude if number >= 0 else -magnitude


@dataclass(frozen=True, slots=True, kw_only=True)
class Quantities:
    """How the quantities of one scenario are written for people.

    Attributes
    ----------
    units
        Units of the scenario.
    tick
        Length of a tick [time unit].
    in_ticks
        Whether times are written in ticks, as files have them, because a user asked for that.

    Examples
    --------
    >>> q = Quantities(units=Units(length="m", time="s"), tick=Fraction(1, 2))
    >>> q.format_duration(767), q.format_duration(3)
    ('6 min 23.5 s', '1.5 s')
    >>> q.format_length(Fraction(9, 20)), q.format_speed(Fraction(6, 5))
    ('0.45 m', '1.2 m/s')
    >>> plain = Quantities(units=Units(), tick=Fraction(1, 2))
    >>> plain.format_duration(2), plain.format_duration(3), plain.format_moment(3)
    ('1 time unit', '1.5 time units', 'time 1.5')
    """

    units: Units
    tick: Fraction
    in_ticks: bool = False

    def __post_init__(self) -> None:
        if not isinstance(self.units, Units):
            raise InputError.at("units", f"{quote(self.units)} are no units (give Units)")
        if not isinstance(self.tick, Fraction) or self.tick <= 0:
            message = f"{quote(self.tick)} is no length of a tick (give a Fraction above 0)"
            raise InputError.at("tick", message)
        if not isinstance(self.in_ticks, bool):
            message = f"{quote(self.in_ticks)} is neither true nor false (give True or False)"
            raise InputError.at("in_ticks", message)

    @checks_arguments
    def format_duration(self, ticks: Value) -> str:
        """Return how long a number of ticks lasts: ``6 min 23 s``, ``2 time units``."""
        if self.in_ticks:
            return say_count(format_decimal(ticks), "tick", "ticks")
        time = self._time(ticks)
        seconds = self.units.seconds
        if seconds is None:
            return say_count(format_decimal(time), "time unit", "time units")
        return mark_figure(self._clock(time * seconds))

    @checks_arguments
    def format_moment(self, ticks: Value) -> str:
        """Return a point in time: ``6 min 23 s`` after the start, ``time 2``, ``tick 4``."""
        if self.in_ticks:
            return Phrase("tick {tick}", tick=format_decimal(ticks))
        if self.units.time:
            return self.format_duration(ticks)
        return Phrase("time {time}", time=self.format_cell(ticks))

    @checks_arguments
    def format_cell(self, ticks: Value) -> str:
        """Return a time as the bare number of a table's cell; `time_unit` is for its heading."""
        return format_decimal(ticks if self.in_ticks else self._time(ticks))

    @property
    def time_unit(self) -> str:
        """The unit of `cell`: ``s``, ``ticks``; empty where the scenario names none."""
        return "ticks" if self.in_ticks else self.units.time or ""

    @checks_arguments
    def format_heading(self, words: str) -> str:
        """Return the heading of a column of times: ``completes [s]``."""
        if self.in_ticks:
            return Phrase("{heading} [ticks]", heading=words)
        unit = self.time_unit
        return Phrase("{heading} [{unit}]", heading=words, unit=unit) if unit else words

    @checks_arguments
    def format_length(self, value: Value) -> str:
        """Return a length: ``0.45 m``, ``0.45 length units``."""
        return self.units.format_length(value)

    @checks_arguments
    def format_speed(self, value: Value) -> str:
        """Return a speed: ``1.2 m/s``; a bare number where the scenario names no units."""
        length, time = self.units.length, self.units.time
        return (
            mark_figure(f"{format_decimal(value)} {length}/{time}")
            if length and time
            else format_decimal(value)
        )

    def compute_ticks_per_hour(self) -> Fraction | None:
        """Return how many ticks an hour has, or None where the time unit is not known."""
        seconds = self.units.seconds
        return None if seconds is None else 3600 / (self.tick * seconds)

    def _time(self, ticks: Value) -> Fraction:
        exact = Fraction(repr(ticks)) if isinstance(ticks, float) else Fraction(ticks)
        return exact * self.tick

    def _clock(self, seconds: Fraction) -> str:
        """Return a duration [s] in the parts that a person would say."""
        if seconds < 0:
            return f"-{self._clock(-seconds)}"
        if self.units.time == "ms" and seconds < 1:
            return f"{format_decimal(seconds * 1000)} ms"
        if _half_up(seconds * 100) < 60 * 100:
            return f"{format_decimal(seconds)} s"
        if _half_up(seconds * 10) < 3600 * 10:
            tenths = Fraction(_half_up(seconds * 10), 10)
            minutes, rest = divmod(tenths, 60)
            return f"{minutes} min" + (f" {format_decimal(rest, 1)} s" if rest else "")
        minutes, rest_seconds = divmod(_half_up(seconds), 60)
        hours, minutes = divmod(minutes, 60)
        parts = ((hours, "h"), (minutes, "min"), (rest_seconds, "s"))
        return " ".join(f"{number} {unit}" for number, unit in parts if number)
