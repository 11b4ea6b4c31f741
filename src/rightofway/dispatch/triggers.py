"""Triggers of rounds: changes since the last round that a new one should plan for.

Both drivers, the simulated shift and the control of robots, describe their fleet by a `Situation`.
`list_triggers` compares the present one with that of the last round; a round begins if there is a
trigger. So a simulation plans when a control would.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from rightofway.execution.monitor import has_fallen_behind
from rightofway.facts import Fact

__all__ = ["RETRY", "Outlook", "Situation", "list_triggers"]

RETRY = 16
"""Looks after which jobs without a tour are tried again, where nothing else has happened."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Outlook:
    """The forecast of the plan that robots follow.

    Attributes
    ----------
    planned
        The sum over all robots of the time from the takeover to the end of the route, as planned
        [ticks].
    expected
        The same as it is expected now [ticks].
    too_late
        Jobs that would miss `latest`.
    short
        Robots whose batteries would fall below `reserve`.
    shut_out
        Robots that can drive, but are expected never to come to the end of their routes.
    """

    planned: int = 0
    expected: int = 0
    too_late: frozenset[str] = frozenset()
    short: frozenset[int] = frozenset()
    shut_out: frozenset[int] = frozenset()


@dataclass(frozen=True, slots=True, kw_only=True)
class Situation:
    """The state of a fleet, as far as it may begin a round.

    Attributes
    ----------
    counts
        How often jobs became known, changed or were withdrawn: `Pool.counts`.
    waiting
        Names of jobs that are known, not begun, and in no tour.
    free
        Robots that can drive and are at the end of their tours, or will be at a takeover.
    ending
        Robots that have more to do than their routes, and come near the end of these.
    unable
        Robots that cannot drive.
    closed
        The closures that hold now: any values that name them.
    outlook
        The forecast of the plan. Right after a takeover: as the new plan has it.
    """

    counts: Mapping[str, int] = field(default_factory=Counter)
    waiting: frozenset[str] = frozenset()
    free: frozenset[int] = frozenset()
    ending: frozenset[int] = frozenset()
    unable: frozenset[int] = frozenset()
    closed: frozenset[object] = frozenset()
    outlook: Outlook = field(default_factory=Outlook)


COUNTED = {
    "job known": "jobs became known",
    "job changed": "jobs changed",
    "job withdrawn": "jobs were withdrawn",
}
"""The triggers of counted events."""


def list_triggers(before: Situation | None, now: Situation) -> Iterator[Fact]:
    """Yield the reasons to begin a round now.

    Parameters
    ----------
    before
        The situation when the last round began, with the outlook right after it; None before the
        first round.
    now
        The present situation.
    """
    if before is None:
        yield Fact("dispatch begins")
        return
    counted = {
        kind: now.counts.get(event, 0) - before.counts.get(event, 0)
        for event, kind in COUNTED.items()
    }
    yield from (Fact(kind, jobs=more) for kind, more in counted.items() if more > 0)
    are_new = (now.waiting, now.free) != (before.waiting, before.free)
    if now.waiting and now.free and are_new and not any(counted.values()):
        yield Fact("robots are free", robots=tuple(sorted(now.free)))
    if now.ending:
        yield Fact("routes end", robots=tuple(sorted(now.ending)))
    if lost := now.unable - before.unable:
        yield Fact("robots stop", robots=tuple(sorted(lost)))
    if back := before.unable - now.unable:
        yield Fact("robots are back", robots=tuple(sorted(back)))
    if changed := now.closed ^ before.closed:
        yield Fact("closures change", closures=len(changed))
    yield from _look_ahead(before.outlook, now.outlook)


def _look_ahead(before: Outlook, now: Outlook) -> Iterator[Fact]:
    """Yield the reasons that lie in the forecast."""
    if late := now.too_late - before.too_late:
        yield Fact("too late ahead", jobs=tuple(sorted(late)))
    if short := now.short - before.short:
        yield Fact("below reserve ahead", robots=tuple(sorted(short)))
    if shut_out := now.shut_out - before.shut_out:
        yield Fact("shut out ahead", robots=tuple(sorted(shut_out)))
    if has_fallen_behind(now.expected, before.expected, now.planned):
        yield Fact("fallen behind", expected=now.expected, planned=now.planned)
