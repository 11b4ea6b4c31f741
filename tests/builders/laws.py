"""Laws: claims on random cases, each with a budget of time instead of a number of cases.

``@law(strategies)`` draws cases until the law's share of its file's seconds is over (option
``--law-seconds``, seconds of the processor, so that a busy machine thins no law). All sessions draw
from one seed, so that a commit always passes or always fails: a faster machine only draws further
in the same sequence. ``--law-seed random`` draws new cases, which `just nightly` does; a case that
it finds is kept by `@once`. A law that fails prints the option that draws the same cases again. A
case that a law cannot judge is left out with `leave`, and counted: a law that leaves out
significantly more than half of its cases fails.

The module is a plugin of pytest; ``tests/conftest.py`` names it.
"""

from __future__ import annotations

import inspect
import json
import math
import zlib
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import count
from pathlib import Path
from random import SystemRandom
from time import process_time
from typing import Any, NoReturn

import pytest
from hypothesis import HealthCheck, Phase, given, note, seed, settings
from hypothesis.errors import UnsatisfiedAssumption
from hypothesis.internal.conjecture.providers import (
    AVAILABLE_PROVIDERS,
    GLOBAL_CONSTANTS,
    HypothesisProvider,
)
from hypothesis.strategies import SearchStrategy

from rightofway.io import format_scenario
from rightofway.model import Scenario

__all__ = ["law", "leave", "once"]

FEWEST = 3
"""Cases that a law judges, however short its budget."""

MOST_LEFT = 60
"""A law that leaves out all of its first cases, as many as this, fails."""

ROUNDS = (3, 12, 48, 100)
"""Cases of the first rounds and of each further one; each round draws with a seed of its own.

Hypothesis chooses cases by the number that it is asked for, so this depends on no clock.
"""

SEED = "1"
"""The seed of all sessions but those with ``--law-seed``."""


class Provider(HypothesisProvider):
    """Draws without the constants of our modules: those that are imported so far would decide."""

    _local_constants = GLOBAL_CONSTANTS


AVAILABLE_PROVIDERS["hypothesis"] = Provider


class Over(BaseException):
    """The budget is over amid a round; Hypothesis takes no such exception for a case that fails."""


class Left(Exception):
    """A case that the law does not judge."""


def leave(reason: str) -> NoReturn:
    """End a case that the law does not judge; the reason is counted.

    Parameters
    ----------
    reason
        A few words without values, so that equal reasons are one.
    """
    raise Left(reason)


def law(
    *strategies: SearchStrategy[Any], **named: SearchStrategy[Any]
) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """Make a test a law on cases drawn from strategies.

    Parameters
    ----------
    strategies
        For the last parameters of the test, in their order.
    named
        For parameters by name. All others are fixtures or parameters of pytest.

    """

    def decorate(test: Callable[..., None]) -> Callable[..., None]:
        parameters = list(inspect.signature(test).parameters.values())
        last = [parameter.name for parameter in parameters if parameter.name not in named]
        drawn = {**dict(zip(last[len(last) - len(strategies) :], strategies, strict=True)), **named}

        def run(law_run: LawRun, **given_by_pytest: Any) -> None:
            def case(**drawn: Any) -> None:
                test(**given_by_pytest, **drawn)

            for found in getattr(test, "found_once", ()):
                case(**found)
            law_run.hold(case, drawn)

        run.__name__, run.__doc__, run.__module__ = test.__name__, test.__doc__, test.__module__
        kind = inspect.Parameter.POSITIONAL_OR_KEYWORD
        rest = [parameter for parameter in parameters if parameter.name not in drawn]
        run.__signature__ = inspect.Signature([inspect.Parameter("law_run", kind), *rest])  # type: ignore[attr-defined]
        run.__dict__.update(test.__dict__)
        return run

    return decorate


def once(**found: Any) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """Have a law judge a case that was found once, each time and first; stands below ``@law``."""

    def decorate(test: Callable[..., None]) -> Callable[..., None]:
        test.__dict__.setdefault("found_once", []).append(found)
        return test

    return decorate


@dataclass
class LawRun:
    """One law in one session: its budget, and what became of its cases.

    Attributes
    ----------
    law
        The test's identifier.
    seed
        Of the session, with the round where one is drawn again.
    seconds
        The law's budget.
    properties
        Of the test, for pytest's report: the law adds what became of it.
    """

    law: str
    seed: str
    seconds: float
    properties: list[tuple[str, object]]
    judged: int = 0
    left: Counter[str] = field(default_factory=Counter)
    spent: float = 0.0

    def hold(self, test: Callable[..., None], strategies: dict[str, SearchStrategy[Any]]) -> None:
        """Judge cases, round after round, until the budget is over."""
        start = process_time()
        session, *again = self.seed.split(":")
        try:
            if again:
                self._round(test, strategies, session, int(again[0]))
                return
            for number in count():
                self._round(test, strategies, session, number, end=start + self.seconds)
                if self._has_enough and process_time() - start > self.seconds:
                    break
        finally:
            self.spent = process_time() - start
            self.properties.append(("law", self.row()))
        self._refuse_emptiness()

    @property
    def _has_enough(self) -> bool:
        return self.judged >= FEWEST or self.left.total() >= MOST_LEFT

    def _round(
        self,
        test: Callable[..., None],
        strategies: dict[str, SearchStrategy[Any]],
        session: str,
        number: int,
        *,
        end: float = math.inf,
    ) -> None:
        fails = is_over = False

        def case(**drawn: Any) -> None:
            nonlocal fails, is_over
            if process_time() > end and not fails and self._has_enough:
                is_over = True
                raise Over
            for name, value in drawn.items():
                if isinstance(value, Scenario):
                    note(Described(name, value))
            try:
                test(**drawn)
            except (Left, UnsatisfiedAssumption, pytest.skip.Exception) as reason:
                self.left[str(reason) or "assumed"] += 1
            except BaseException:
                fails = True  # and Hypothesis goes on to the least case that does
                raise
            else:
                self.judged += 1

        drawing = settings(
            max_examples=ROUNDS[min(number, len(ROUNDS) - 1)],
            deadline=None,
            database=None,
            derandomize=False,
            phases=(Phase.generate, Phase.shrink),
            suppress_health_check=list(HealthCheck),
        )
        own = zlib.crc32(f"{self.law} {session} {number}".encode())
        try:
            seed(own)(drawing(given(**strategies)(case)))()
        except BaseException as error:
            if is_over:  # Hypothesis may complain of a case that draws nothing, in place of Over
                return
            again = f"pytest '{self.law}' -m '' --law-seed {session}:{number}"
            error.add_note(f"the same cases again: {again}")
            raise

    def _refuse_emptiness(self) -> None:
        """Fail where the law hardly judges: beyond half by three standard deviations."""
        tried, left = self.judged + self.left.total(), self.left.total()
        if self.judged == 0 or left > tried / 2 + 3 * math.sqrt(tried) / 2:
            reasons = ", ".join(f"{count} {reason}" for reason, count in self.left.most_common(5))
            pytest.fail(f"{left} of {tried} cases are left out, more than half: {reasons}")

    def row(self) -> dict[str, Any]:
        """Return what the summary and the report file have of the law."""
        return {
            "law": self.law,
            "seed": self.seed,
            "judged": self.judged,
            "left out": dict(self.left.most_common()),
            "seconds": round(self.spent, 3),
        }


@dataclass(frozen=True)
class Described:
    """A scenario by the file that describes it, for a case that fails."""

    name: str
    scenario: Scenario

    def _repr_pretty_(self, printer: Any, cycle: bool) -> None:  # noqa: ARG002
        printer.text(f"{self.name}:\n{format_scenario(self.scenario)}")


# --- the plugin ---------------------------------------------------------------------------------


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the options of laws."""
    group = parser.getgroup("laws")
    group.addoption(
        "--law-seconds",
        type=float,
        default=0.5,
        help="seconds of the processor for the laws of each file, 0 for no laws (default: 0.5)",
    )
    group.addoption(
        "--law-seed",
        default=SEED,
        help=f"seed of random cases, as a failure prints it, or random (default: {SEED})",
    )
    group.addoption("--law-report", type=Path, help="write cases by law to this JSON file")


def pytest_configure(config: pytest.Config) -> None:
    """Choose the session's seed: that of the controller where there is one."""
    if hasattr(config, "workerinput"):
        config.option.law_seed = config.workerinput["law_seed"]
    elif config.option.law_seed == "random":
        config.option.law_seed = str(SystemRandom().randrange(10**9))


@pytest.hookimpl(optionalhook=True)
def pytest_configure_node(node: Any) -> None:
    """Give the seed to a worker of xdist."""
    node.workerinput["law_seed"] = node.config.option.law_seed


def pytest_report_header(config: pytest.Config) -> str:
    """Name the seed, so that the session can be repeated."""
    return f"laws: --law-seed {config.option.law_seed}"


def is_law(item: pytest.Item) -> bool:
    """Return whether a test is a law."""
    return "law_run" in getattr(item, "fixturenames", ())


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Mark the laws, or leave them out where they have no time."""
    laws = [item for item in items if is_law(item)]
    for item in laws:
        item.add_marker(pytest.mark.law)
    if not config.option.law_seconds:
        config.hook.pytest_deselected(items=laws)
        items[:] = [item for item in items if not is_law(item)]


@pytest.fixture
def law_seed(request: pytest.FixtureRequest) -> int:
    """Return the session's seed, for tests that draw by themselves."""
    return int(request.config.option.law_seed.partition(":")[0])


@pytest.fixture
def law_run(request: pytest.FixtureRequest) -> LawRun:
    """Return the run of the requesting law, with its share of the seconds of its file."""
    item = request.node
    laws = sum(is_law(other) and other.path == item.path for other in request.session.items)
    option = request.config.option
    seconds = option.law_seconds / laws
    return LawRun(item.nodeid, option.law_seed, seconds, item.user_properties)


def pytest_terminal_summary(terminalreporter: Any, config: pytest.Config) -> None:
    """Say how many cases were judged, and which laws left many out."""
    reports = [
        report
        for outcome in ("passed", "failed")
        for report in terminalreporter.stats.get(outcome, ())
    ]
    rows = [
        value
        for report in reports
        for name, value in getattr(report, "user_properties", ())
        if name == "law"
    ]
    if not rows:
        return
    judged = sum(row["judged"] for row in rows)
    left = sum(sum(row["left out"].values()) for row in rows)
    seconds = sum(row["seconds"] for row in rows)
    terminalreporter.section("laws")
    terminalreporter.line(
        f"{len(rows)} laws judged {judged} cases and left {left} out, in {seconds:.0f} s"
        f" (--law-seed {config.option.law_seed})"
    )
    for row in sorted(rows, key=lambda row: row["law"]):
        out = sum(row["left out"].values())
        if out > (row["judged"] + out) / 4:
            terminalreporter.line(f"  {out} of {row['judged'] + out} left out: {row['law']}")
    if config.option.law_report:
        report = {"seed": config.option.law_seed, "laws": rows}
        config.option.law_report.write_text(json.dumps(report, indent=1), encoding="utf-8")
