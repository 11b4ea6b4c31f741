"""What makes robots late: how it is written (`CAUSES`), and what it is in ticks."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import chain
from typing import Any

from rightofway.errors import InputError
from rightofway.io.numbers import exact
from rightofway.model import NEVER, Clock, Scenario
from rightofway.precedence import DelayModel, Stoppage

__all__ = ["CAUSES", "DEFAULT", "Cause", "Delay", "delay_model_of", "read_delays"]

DEFAULT = "exponential:0.2"
"""What makes robots late where nothing is said."""


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


@dataclass(frozen=True, slots=True, kw_only=True)
class Cause:
    """How one kind of delay is written.

    Attributes
    ----------
    form
        What stands after the colon, as a regular expression: robot, first and second number.
    examples
        One for each way to write it, and what it means.
    """

    form: str
    examples: tuple[tuple[str, str], ...]


_NUMBER = r"([^~@+]+?)"

CAUSES = {
    "exponential": Cause(
        form=rf"(){_NUMBER}()",
        examples=(("exponential:0.2", "everything takes longer, on average by 0.2 of its time"),),
    ),
    "uniform": Cause(
        form=rf"(){_NUMBER}\.\.{_NUMBER}",
        examples=(("uniform:0..0.5", "longer by 0 to 0.5 of its time"),),
    ),
    "normal": Cause(
        form=rf"(){_NUMBER}~{_NUMBER}",
        examples=(
            ("normal:0.1~0.05", "longer by 0.1 of its time, with a standard deviation of 0.05"),
        ),
    ),
    "chance": Cause(
        form=rf"(){_NUMBER}x{_NUMBER}",
        examples=(("chance:0.01x20", "a stop of 20 time units with chance 0.01 in each visit"),),
    ),
    "breaks": Cause(
        form=rf"(){_NUMBER}()",
        examples=(
            (
                "breaks:0.05",
                "each robot breaks down for ever with chance 0.05, at any time of the plan",
            ),
        ),
    ),
    "stop": Cause(
        form=rf"(.+)@{_NUMBER}(?:\+{_NUMBER})?",
        examples=(
            ("stop:R3@12", "R3 breaks down for ever at time 12"),
            ("stop:R3@12+30", "R3 stands still for 30 time units from time 12"),
        ),
    ),
    "slow": Cause(
        form=rf"(.+)x{_NUMBER}()",
        examples=(("slow:R2x1.5", "everything takes R2 1.5 times as long"),),
    ),
    "early": Cause(
        form=rf"(.+)x{_NUMBER}()",
        examples=(("early:R1x0.8", "everything takes R1 0.8 of its time"),),
    ),
}
"""All kinds, by what stands before the colon; the help of the command and the documentation show
their examples."""

_BETWEEN = re.compile(rf"\s*,\s*(?=(?:{'|'.join(CAUSES)})\s*:)")


def read_delays(given: str | Iterable[str], scenario: Scenario) -> tuple[Delay, ...]:
    """Read what makes robots late.

    Parameters
    ----------
    given
        One cause or several with commas between, or several of these.
    scenario
        Whose robots they befall.

    Raises
    ------
    InputError
        Naming the cause and what to write instead.
    """
    several = [given] if isinstance(given, str) else given
    texts = chain.from_iterable(map(_BETWEEN.split, several))
    return tuple(_delay(text.strip(), scenario) for text in texts)


def _delay(text: str, scenario: Scenario) -> Delay:
    kind, _, rest = text.partition(":")
    kind = kind.strip()
    if kind not in CAUSES:
        known = ", ".join(CAUSES)
        raise _wrong(text, f"{kind!r} is no kind of delay (one of {known})")
    match = re.fullmatch(CAUSES[kind].form, rest.strip())
    if not match:
        example, _ = CAUSES[kind].examples[-1]
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


def delay_model_of(delays: Sequence[Delay], scenario: Scenario) -> DelayModel:
    """Return what the delays are in the ticks of a scenario."""
    clock = scenario.problem.clock
    names = [robot.name for robot in scenario.robots]
    pace = dict.fromkeys(names, 1.0)
    stoppages: dict[str, list[Stoppage]] = {name: [] for name in names}
    random = []
    for delay in delays:
        if delay.kind in {"slow", "early"}:
            pace[delay.robot] *= float(delay.first)
        elif delay.kind == "stop":
            stoppages[delay.robot].append(_stoppage(delay, clock))
        else:
            random.append((delay.kind, float(delay.first), _second(delay, clock)))
    return DelayModel(
        random=tuple(random),
        pace=tuple(pace[name] for name in names),
        stoppages=tuple(tuple(sorted(stoppages[name])) for name in names),
    )


def _stoppage(delay: Delay, clock: Clock) -> Stoppage:
    lasts = NEVER if delay.second is None else clock.ticks(delay.second)
    return Stoppage(clock.ticks(delay.first), lasts)


def _second(delay: Delay, clock: Clock) -> float:
    second: Any = delay.second or 0
    return float(clock.ticks(second) if delay.kind == "chance" else second)
