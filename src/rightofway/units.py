"""Units of the numbers of a scenario, the instant of time 0, and numbers as English text."""

from __future__ import annotations

import re
from dataclasses import dataclass
from datetime import datetime, timedelta, timezone
from decimal import Decimal
from fractions import Fraction
from typing import Literal, get_args

from rightofway.errors import InputError, InputFault, quote

__all__ = [
    "LengthUnit",
    "TimeUnit",
    "Units",
    "Value",
    "is_clock_time",
    "read_start",
    "round_half_up",
    "write_decimal",
]

LengthUnit = Literal["mm", "cm", "m"]
TimeUnit = Literal["ms", "s", "min", "h"]

SECONDS: dict[str, Fraction] = {
    "ms": Fraction(1, 1000),
    "s": Fraction(1),
    "min": Fraction(60),
    "h": Fraction(3600),
}
"""The length of each unit of time [s]."""

METRES: dict[str, Fraction] = {"mm": Fraction(1, 1000), "cm": Fraction(1, 100), "m": Fraction(1)}
"""The length of each unit of length [m]."""

DAY = 86400
"""Seconds of a day."""

CLOCK = r"([0-9]{1,2}):([0-5][0-9])(?::([0-5][0-9](?:\.[0-9]{1,6})?))?"
"""A time of day."""

CLOCK_TIME = re.compile(
    rf"(?:([0-9]{{4}}-[0-9]{{2}}-[0-9]{{2}})[T ])?{CLOCK}(Z|[+-][0-9]{{2}}:[0-9]{{2}})?"
)
"""A time of day, perhaps with a date, and with an offset from UTC."""

LIKE = "2026-11-28T06:00"

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
        Unit of times: ``ms``, ``s``, ``min`` or ``h``. Speeds are lengths per time. With a start it
        is ``s`` by default.
    start
        The instant of time 0, with or without an offset from UTC: a `datetime`, or text like
        ``2026-11-28T06:00``. None where times are no times of day.

    Raises
    ------
    InputError
        If a unit is unknown, or the start is no instant.
    """

    length: LengthUnit | None = None
    time: TimeUnit | None = None
    start: datetime | None = None

    def __post_init__(self) -> None:
        if self.start is not None:
            try:
                object.__setattr__(self, "start", read_start(self.start))
            except ValueError as error:
                raise InputError.at("start", str(error)) from None
            object.__setattr__(self, "time", self.time or "s")
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
        """Length of the time unit [s], or None if it is unknown."""
        return None if self.time is None else SECONDS[self.time]

    @property
    def metres(self) -> Fraction | None:
        """Length of the length unit [m], or None if it is unknown."""
        return None if self.length is None else METRES[self.length]

    def to_document(self) -> dict[str, str | None]:
        """Return the units as JSON has them; the start only where there is one."""
        start = {} if self.start is None else {"start": write_start(self.start)}
        return {"length": self.length, "time": self.time, **start}

    def read_clock_time(self, text: str, not_before: Fraction | None = None) -> Fraction:
        """Return the time of a time of day, or of one with a date [time unit].

        Parameters
        ----------
        text
            As documents have it: ``10:00``, ``2026-11-29T10:00``; with an offset from UTC only
            where the start has one.
        not_before
            A time of day is the first one from then on [time unit]; None: that on the day of the
            start.

        Raises
        ------
        ValueError
            If there is no start, the text is no time of day, or it is before the start.
        """
        if self.start is None:
            remedy = f"give start: {LIKE}, or a number"
            raise ValueError(f"{quote(text)} needs the start of the scenario ({remedy})")
        date, seconds, offset = _split_clock_time(text)
        first = self.start.replace(hour=0, minute=0, second=0, microsecond=0)
        if offset is not None and self.start.tzinfo is None:
            message = f"{quote(text)} has an offset from UTC, and the start has none"
            raise ValueError(f"{message} (leave it out)")
        day = (
            first if date is None else first.replace(year=date.year, month=date.month, day=date.day)
        )
        since = (
            Fraction((day - first) // timedelta(days=1) * DAY) + seconds - _count_of_day(self.start)
        )
        if offset is not None:
            since += Fraction(
                (self.start.utcoffset() or timedelta()) // timedelta(seconds=1) - offset
            )
        time = since / (self.seconds or 1)
        if not_before is not None and date is None and time < not_before:
            day_long = DAY / (self.seconds or Fraction(1))
            time += -((time - not_before) // day_long) * day_long
        if time < 0:
            later = (self.start + timedelta(days=1)).date()
            remedy = "give the day" if date is None else "give a later one"
            remedy += f", like {later}T{text}" if date is None else ""
            raise ValueError(
                f"{quote(text)} is before the start, {write_start(self.start)} ({remedy})"
            )
        return time

    def write_clock_time(self, time: Fraction) -> str | None:
        """Return a time [time unit] as documents have it: ``10:00``, with a date on later days.

        Returns
        -------
        str or None
            None without a start, and for a time with parts of a microsecond.
        """
        if self.start is None:
            return None
        micro = time * (self.seconds or 1) * 10**6
        if micro.denominator != 1 or micro > 10**17:
            return None
        try:
            moment = self.start + timedelta(microseconds=int(micro))
        except OverflowError:
            return None
        text = write_start(moment)
        if moment.date() != self.start.date():
            return text
        clock = moment.time().isoformat(
            "auto" if moment.microsecond or moment.second else "minutes"
        )
        return clock.rstrip("0") if "." in clock else clock

    def write_length(self, value: Value) -> str:
        """Return a length in English: ``0.45 m``, ``0.45 length units``."""
        number = write_decimal(value)
        unit = self.length or ("length unit" if number == "1" else "length units")
        return f"{number} {unit}"


def is_clock_time(value: object) -> bool:
    """Return whether a value is text with a colon, as a time of day has it."""
    return isinstance(value, str) and ":" in value


def read_start(value: object) -> datetime:
    """Return the instant of a text like ``2026-11-28T06:00``, or of a `datetime`.

    Raises
    ------
    ValueError
        If it is none.
    """
    if isinstance(value, datetime):  # of a zone, its offset at the start counts
        own = value.utcoffset()
        return value if own is None else value.astimezone(timezone(own))
    remedy = f"give an instant like {LIKE}, perhaps with an offset like +01:00"
    if not isinstance(value, str) or CLOCK_TIME.fullmatch(value) is None:
        raise ValueError(f"{quote(value)} is no instant ({remedy})")
    date, seconds, offset = _split_clock_time(value)
    if date is None:
        raise ValueError(f"{quote(value)} has no day ({remedy})")
    moment = date + timedelta(microseconds=int(seconds * 10**6))
    return moment if offset is None else moment.replace(tzinfo=timezone(timedelta(seconds=offset)))


def write_start(start: datetime) -> str:
    """Return an instant as documents have it."""
    is_whole = not start.second and not start.microsecond
    text = start.isoformat(timespec="minutes" if is_whole else "auto")
    return text.replace("+00:00", "Z")


def _split_clock_time(text: str) -> tuple[datetime | None, Fraction, int | None]:
    """Return the day of a time of day, its seconds since midnight, and its offset [s]."""
    match = CLOCK_TIME.fullmatch(text)
    if match is None:
        remedy = f"give one like 10:30, 10:30:05 or {LIKE}"
        raise ValueError(f"{quote(text)} is no time of day ({remedy})")
    date, hours, minutes, seconds, offset = match.groups()
    hour, minute, second = int(hours), int(minutes), Fraction(seconds or 0)
    if 3600 * hour >= DAY:
        remedy = "give 00:00 to 23:59:59, on later days with the date"
        raise ValueError(f"{quote(text)} is no time of day ({remedy})")
    try:
        day = datetime.fromisoformat(date) if date else None
    except ValueError:
        raise ValueError(f"{quote(text)} has no day of the calendar (correct it)") from None
    shift = None
    if offset == "Z":
        shift = 0
    elif offset:
        sign = -1 if offset.startswith("-") else 1
        shift = sign * (3600 * int(offset[1:3]) + 60 * int(offset[4:]))
        if abs(shift) >= DAY:
            raise ValueError(f"{quote(text)} has no offset from UTC (give one like +01:00)")
    return day, 3600 * hour + 60 * minute + second, shift


def _count_of_day(moment: datetime) -> Fraction:
    """Return the seconds since midnight."""
    whole = 3600 * moment.hour + 60 * moment.minute + moment.second
    return whole + Fraction(moment.microsecond, 10**6)


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
