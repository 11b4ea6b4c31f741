"""What makes robots late: how it is written, and what it is in ticks.

============================  ======================================================================
``exponential:0.2``           everything takes longer, on average by 0.2 of its time
``uniform:0..0.5``            longer by 0 to 0.5 of its time
``normal:0.1~0.05``           longer by 0.1 of its time, with a standard deviation of 0.05
``chance:0.01x20``            a stop of 20 time units with chance 0.01 in each visit
``breaks:0.05``               each robot breaks down for ever with chance 0.05, at any time
``stop:R3@12``                R3 breaks down for ever at time 12
``stop:R3@12+30``             R3 stands still for 30 time units from time 12
``slow:R2x1.5``               everything takes R2 1.5 times as long
``early:R1x0.8``              everything takes R1 0.8 of its time
============================  ======================================================================
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import chain
from pathlib import Path
from typing import Any

from rightofway.errors import InputError
from rightofway.io.text.documents import read_document
from rightofway.io.text.exact import exact
from rightofway.model import Clock, Scenario, Tick
from rightofway.precedence import NEVER, Hazards

__all__ = ["DEFAULT", "Delay", "hazards_of", "read_delays"]

DEFAULT = "exponential:0.2"
"""What makes robots late where nothing is said."""

FILES = (".yaml", ".yml", ".json")


@dataclass(frozen=True, slots=True, kw_only=True)
class Delay:
    """One cause of lateness.

    Attributes
    ----------
    kind
        As it is written, before the colon.
    robot
        Whom it befalls; empty for everybody.
    first, second
        The numbers, in the order in which they are written; times in time units. ``second`` is None
        where there is none.
    text
        All of it as it was written.
    """

    kind: str
    robot: str
    first: Fraction
    second: Fraction | None
    text: str


_NUMBER = r"([^~@+]+?)"
_FORMS = {
    "exponential": (rf"(){_NUMBER}()", "exponential:0.2"),
    "uniform": (rf"(){_NUMBER}\.\.{_NUMBER}", "uniform:0..0.5"),
    "normal": (rf"(){_NUMBER}~{_NUMBER}", "normal:0.1~0.05"),
    "chance": (rf"(){_NUMBER}x{_NUMBER}", "chance:0.01x20"),
    "breaks": (rf"(){_NUMBER}()", "breaks:0.05"),
    "stop": (rf"(.+)@{_NUMBER}(?:\+{_NUMBER})?", "stop:R3@12+30"),
    "slow": (rf"(.+)x{_NUMBER}()", "slow:R2x1.5"),
    "early": (rf"(.+)x{_NUMBER}()", "early:R1x0.8"),
}
_BETWEEN = re.compile(rf"\s*,\s*(?=(?:{'|'.join(_FORMS)})\s*:)")


def read_delays(given: str | Path | Iterable[str | Path], scenario: Scenario) -> tuple[Delay, ...]:
    """Read what makes robots late.

    Parameters
    ----------
    given
        One cause or several with commas between, a YAML or JSON file with a list of them, or
        several of all these.
    scenario
        Whose robots they befall.

    Raises
    ------
    InputError
        Naming the cause and what to write instead.
    """
    several = [given] if isinstance(given, str | Path) else given
    texts = chain.from_iterable(_texts(one) for one in several)
    return tuple(_delay(text.strip(), scenario) for text in texts)


def _texts(given: str | Path) -> list[str]:
    text = str(given)
    if not text.lower().endswith(FILES):
        return _BETWEEN.split(text)
    try:
        found = read_document(Path(text))
    except InputError as error:
        raise InputError(error.problems, text) from None
    if isinstance(found, dict) and list(found) == ["delays"]:
        found = found["delays"]
    if not (isinstance(found, list) and all(isinstance(one, str) for one in found)):
        raise InputError.at("", f"is no list of delays (write lines like - {DEFAULT})", text)
    return [part for one in found for part in _BETWEEN.split(one)]


def _delay(text: str, scenario: Scenario) -> Delay:
    kind, _, rest = text.partition(":")
    kind = kind.strip()
    if kind not in _FORMS:
        known = ", ".join(_FORMS)
        raise _wrong(text, f"{kind!r} is no kind of delay (one of {known})")
    form, example = _FORMS[kind]
    match = re.fullmatch(form, rest.strip())
    if not match:
        raise _wrong(text, f"{rest.strip()!r} cannot be read (write it like {example})")
    robot, first, second = match.groups()
    delay = Delay(
        kind=kind,
        robot=robot,
        first=_number(text, first),
        second=_number(text, second) if second else None,
        text=text,
    )
    _refuse_odd(delay, scenario)
    return delay


def _number(text: str, written: str) -> Fraction:
    try:
        return exact(written.strip())
    except ValueError as error:
        raise _wrong(text, str(error)) from None


def _refuse_odd(delay: Delay, scenario: Scenario) -> None:
    names = [robot.name for robot in scenario.robots]
    if delay.robot and delay.robot not in names:
        few = ", ".join(names[:5]) + (", …" if len(names) > 5 else "")  # noqa: PLR2004
        raise _wrong(delay.text, f"there is no robot {delay.robot!r} (there are {few})")
    for complaint, is_odd in _complaints(delay):
        if is_odd:
            raise _wrong(delay.text, complaint)


def _complaints(delay: Delay) -> list[tuple[str, bool]]:
    first, second, kind = delay.first, delay.second, delay.kind
    other = second if second is not None else Fraction(0)
    return [
        (f"{first} is not positive (give a factor above 0)",
         kind in {"slow", "early"} and first <= 0),
        (f"{first} is below 1 (say early for that)", kind == "slow" and first < 1),
        (f"{first} is above 1 (say slow for that)", kind == "early" and first > 1),
        (f"{first} is no chance (give 0 to 1)",
         kind in {"chance", "breaks"} and not 0 <= first <= 1),
        (f"{first} is negative (give 0 or more)", kind in {"exponential", "stop"} and first < 0),
        (f"{other} is negative (give 0 or more)",
         kind in {"normal", "chance", "stop"} and other < 0),
        (f"{first} is not above -1 (nothing takes no time)",
         kind in {"uniform", "normal"} and first <= -1),
        (f"{first} is above {other} (give the smaller bound first)",
         kind == "uniform" and first > other),
    ]  # fmt: skip


def _wrong(text: str, message: str) -> InputError:
    return InputError.at("delays", f"{text}: {message}")


def hazards_of(delays: Sequence[Delay], scenario: Scenario) -> Hazards:
    """Return what the delays are in the ticks of a scenario."""
    clock = scenario.timing.clock
    names = [robot.name for robot in scenario.robots]
    pace = dict.fromkeys(names, 1.0)
    standstills: dict[str, list[tuple[Tick, Tick]]] = {name: [] for name in names}
    random = []
    for delay in delays:
        if delay.kind in {"slow", "early"}:
            pace[delay.robot] *= float(delay.first)
        elif delay.kind == "stop":
            standstills[delay.robot].append(_standstill(delay, clock))
        else:
            random.append((delay.kind, float(delay.first), _second(delay, clock)))
    return Hazards(
        random=tuple(random),
        pace=tuple(pace[name] for name in names),
        standstills=tuple(tuple(sorted(standstills[name])) for name in names),
    )


def _standstill(delay: Delay, clock: Clock) -> tuple[Tick, Tick]:
    lasts = NEVER if delay.second is None else clock.ticks(delay.second)
    return clock.ticks(delay.first), lasts


def _second(delay: Delay, clock: Clock) -> float:
    second: Any = delay.second or 0
    return float(clock.ticks(second) if delay.kind == "chance" else second)
