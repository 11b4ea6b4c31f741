"""Times, lengths and speeds as people read them: ``6 min 23 s``, ``0.45 m``, ``1.2 m/s``.

Inside the program times are ticks, and lengths and speeds are exact fractions. `Quantities` is the
only place where these become text for people; files and JSON keep the exact values.
"""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime, timedelta
from fractions import Fraction

from rightofway.errors import InputError, quote
from rightofway.kinds.arguments import checks_arguments
from rightofway.model import Scenario
from rightofway.report.phrases import Phrase, mark_figure
from rightofway.units import DIGITS, Units, Value, round_half_up, write_decimal

__all__ = ["Quantities", "format_decimal"]


def format_decimal(value: Value, digits: int = DIGITS) -> str:
    """Return a number as a person writes it; pages write it with the point of their language.

    Parameters
    ----------
    value
        The number.
    digits
        The most decimals of the result, as in `rightofway.units.write_decimal`.
    """
    return mark_figure(write_decimal(value, digits))


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

    @classmethod
    @checks_arguments
    def of(cls, scenario: Scenario) -> Quantities:
        """Return how the times, lengths and speeds of a scenario are written.

        Raises
        ------
        InputError
            If the value is not a scenario.
        """
        return cls(units=scenario.units, tick=scenario.problem.clock.tick)

    @checks_arguments
    def format_duration(self, ticks: Value) -> str:
        """Return the duration of a number of ticks as text: ``6 min 23 s``, ``2 time units``."""
        if self.in_ticks:
            return Phrase("n_ticks", number=format_decimal(ticks))
        time = self._time(ticks)
        seconds = self.units.seconds
        if seconds is None:
            return Phrase("n_time_units", number=format_decimal(time))
        return mark_figure(self._clock(time * seconds))

    @checks_arguments
    def format_moment(self, ticks: Value) -> str:
        """Return a point in time: ``6 min 23 s`` after time 0, ``10:32``, ``time 2``, ``tick 4``.

        It is a time of day where the scenario has a start, on later days with the date.
        """
        if self.in_ticks:
            return Phrase("moment in ticks", tick=format_decimal(ticks))
        if self.units.start is not None:
            return mark_figure(self._write_clock_time(self.units.start, self._time(ticks)))
        if self.units.time:
            return self.format_duration(ticks)
        return Phrase("moment", time=self.format_cell(ticks))

    @checks_arguments
    def format_cell(self, ticks: Value) -> str:
        """Return a time as the bare number of a table's cell; `time_unit` is for its heading."""
        return format_decimal(ticks if self.in_ticks else self._time(ticks))

    @checks_arguments
    def format_point(self, ticks: Value) -> str:
        """Return a point in time in a table's cell: a time of day, or a bare number."""
        has_start = self.units.start is not None and not self.in_ticks
        return self.format_moment(ticks) if has_start else self.format_cell(ticks)

    @property
    def time_unit(self) -> str:
        """The unit of `cell`: ``s``, ``ticks``; empty where the scenario names none."""
        return "ticks" if self.in_ticks else self.units.time or ""

    @checks_arguments
    def format_heading(self, words: str) -> str:
        """Return the heading of a column of times: ``completes [s]``."""
        if self.in_ticks:
            return Phrase("heading in ticks", heading=words)
        unit = self.time_unit
        return Phrase("heading with unit", heading=words, unit=unit) if unit else words

    @checks_arguments
    def format_length(self, value: Value) -> str:
        """Return a length: ``0.45 m``, ``0.45 length units``."""
        if self.units.length:
            return mark_figure(self.units.write_length(value))
        return Phrase("n_length_units", number=mark_figure(format_decimal(value)))

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
        """Return the number of ticks in an hour, or None if the time unit is not known."""
        seconds = self.units.seconds
        return None if seconds is None else 3600 / (self.tick * seconds)

    def _time(self, ticks: Value) -> Fraction:
        exact = Fraction(repr(ticks)) if isinstance(ticks, float) else Fraction(ticks)
        return exact * self.tick

    def _write_clock_time(self, start: datetime, time: Fraction) -> str:
        """Return a time of day, rounded to hundredths of a second."""
        hundredths = round_half_up(time * (self.units.seconds or 1) * 100)
        try:
            moment = start + timedelta(milliseconds=10 * hundredths)
        except OverflowError:  # after the year 9999
            return self._clock(Fraction(hundredths, 100))
        day = "" if moment.date() == start.date() else f"{moment.date()} "
        seconds = f":{moment:%S}" if moment.second or moment.microsecond else ""
        part = f".{moment.microsecond // 10_000:02}".rstrip("0") if moment.microsecond else ""
        return f"{day}{moment:%H:%M}{seconds}{part}"

    def _clock(self, seconds: Fraction) -> str:
        """Return a duration [s] in the parts that a person would say."""
        if seconds < 0:
            return f"-{self._clock(-seconds)}"
        if self.units.time == "ms" and seconds < 1:
            return f"{format_decimal(seconds * 1000)} ms"
        if round_half_up(seconds * 100) < 60 * 100:
            return f"{format_decimal(seconds)} s"
        if round_half_up(seconds * 10) < 3600 * 10:
            tenths = Fraction(round_half_up(seconds * 10), 10)
            minutes, rest = divmod(tenths, 60)
            return f"{minutes} min" + (f" {format_decimal(rest, 1)} s" if rest else "")
        minutes, rest_seconds = divmod(round_half_up(seconds), 60)
        hours, minutes = divmod(minutes, 60)
        parts = ((hours, "h"), (minutes, "min"), (rest_seconds, "s"))
        return " ".join(f"{number} {unit}" for number, unit in parts if number)
