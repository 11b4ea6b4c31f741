"""Causes of delay: their notation (`CAUSES`), and the delay model in ticks."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from fractions import Fraction
from itertools import chain
from typing import NamedTuple

from rightofway.errors import InputError
from rightofway.kinds.numbers import read_exact
from rightofway.kinds.table import TEXT, list_of
from rightofway.model import NEVER, Plan, Scenario
from rightofway.precedence import ActionDependencyGraph, DelayModel, Stoppage

DEFAULT_DELAYS = "exponential:0.2"
"""The default delays."""


class Delay(NamedTuple):
    """One cause of delay, with its notation (``text``).

    ``robot`` is a name, or empty for all robots. Times are in time units. ``second`` is None for a
    notation with one number.
    """

    kind: str
    robot: str
    first: Fraction
    second: Fraction | None
    text: str


class Cause(NamedTuple):
    """The notation of one kind of delay.

    ``form`` is a regular expression of the text after the colon: robot, first and second number.
    ``examples`` has one example of each notation, with its meaning.
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
                "each robot breaks down permanently with chance 0.05, at any time of the plan",
            ),
        ),
    ),
    "stop": Cause(
        form=rf"(.+)@{_NUMBER}(?:\+{_NUMBER})?",
        examples=(
            ("stop:R3@12", "R3 breaks down permanently at time 12"),
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
"""All kinds of delay by name, for parser, help and documentation."""

_BETWEEN = re.compile(rf"\s*,\s*(?=(?:{'|'.join(CAUSES)})\s*:)")


def read_delays(given: str | Iterable[str], scenario: Scenario) -> tuple[Delay, ...]:
    """Read causes of delay.

    Parameters
    ----------
    given
        One cause, several causes separated by commas, or a sequence of these.
    scenario
        The problem, with the names of the robots.

    Raises
    ------
    InputError
        If a cause cannot be read; names the cause and the remedy.
    """
    several = [given] if isinstance(given, str) else list_of(TEXT).read_at("delays", given)
    causes = chain.from_iterable(map(_BETWEEN.split, several))
    return tuple(_read_delay(cause.strip(), scenario) for cause in causes)


def _read_delay(text: str, scenario: Scenario) -> Delay:
    def wrong(message: str) -> InputError:
        return InputError.at("delays", f"{text}: {message}")

    kind, _, rest = (part.strip() for part in text.partition(":"))
    if kind not in CAUSES:
        raise wrong(f"{kind!r} is no kind of delay (one of {', '.join(CAUSES)})")
    match = re.fullmatch(CAUSES[kind].form, rest)
    if not match:
        example, _ = CAUSES[kind].examples[-1]
        raise wrong(f"{rest!r} cannot be read (write it like {example})")
    robot, *written = match.groups()
    try:
        first, second = (read_exact(number.strip()) if number else None for number in written)
    except ValueError as error:
        raise wrong(str(error)) from None
    assert first is not None  # every form has a first number
    delay = Delay(kind=kind, robot=robot, first=first, second=second, text=text)
    names = [robot.name for robot in scenario.robots]
    if robot and robot not in names:
        few = ", ".join(names[:5]) + (", …" if len(names) > 5 else "")  # noqa: PLR2004
        raise wrong(f"there is no robot {robot!r} (there are {few})")
    for complaint, is_wrong in _list_complaints(delay):
        if is_wrong:
            raise wrong(complaint)
    return delay


def _list_complaints(delay: Delay) -> list[tuple[str, bool]]:
    first, second, kind = delay.first, delay.second or 0, delay.kind
    return [
        (f"{first} is not positive (give a factor above 0)",
         kind in {"slow", "early"} and first <= 0),
        (f"{first} is below 1 (say early for that)", kind == "slow" and first < 1),
        (f"{first} is above 1 (say slow for that)", kind == "early" and first > 1),
        (f"{first} is no chance (give 0 to 1)",
         kind in {"chance", "breaks"} and not 0 <= first <= 1),
        (f"{first} is negative (give 0 or more)", kind in {"exponential", "stop"} and first < 0),
        (f"{second} is negative (give 0 or more)",
         kind in {"normal", "chance", "stop"} and second < 0),
        (f"{first} is not above -1 (nothing takes no time)",
         kind in {"uniform", "normal"} and first <= -1),
        (f"{first} is above {second} (give the smaller bound first)",
         kind == "uniform" and first > second),
    ]  # fmt: skip


def delay_model_of(delays: Sequence[Delay], scenario: Scenario) -> DelayModel:
    """Return the delay model of causes, in the ticks of a scenario.

    Parameters
    ----------
    delays
        Causes of delays, as `read_delays` returns them.
    scenario
        The problem; it gives robots by name and the tick.
    """
    ticks = scenario.problem.clock.count_ticks
    pace = {robot.name: 1.0 for robot in scenario.robots}
    stoppages: dict[str, list[Stoppage]] = {name: [] for name in pace}
    random = []
    for delay in delays:
        second = delay.second or Fraction(0)
        if delay.kind in {"slow", "early"}:
            pace[delay.robot] *= float(delay.first)
        elif delay.kind == "stop":
            lasts = NEVER if delay.second is None else ticks(second)
            stoppages[delay.robot].append(Stoppage(ticks(delay.first), lasts))
        else:
            number = ticks(second) if delay.kind == "chance" else second
            random.append((delay.kind, float(delay.first), float(number)))
    return DelayModel(
        random=tuple(random),
        pace=tuple(pace.values()),
        stoppages=tuple(tuple(sorted(own)) for own in stoppages.values()),
    )


def delay_plan(
    plan: Plan, delays: str | Iterable[str]
) -> tuple[tuple[Delay, ...], ActionDependencyGraph]:
    """Return the causes of delay, and the plan as it is executed with them."""
    causes = read_delays(delays, plan.scenario)
    return causes, make_delayed_graph(plan, causes)


def make_delayed_graph(plan: Plan, delays: Sequence[Delay]) -> ActionDependencyGraph:
    """Return a plan as it is executed with delays that `read_delays` returned."""
    model = delay_model_of(delays, plan.scenario)
    return ActionDependencyGraph(plan.scenario, plan.tracks, model, tours=plan.tours)
