"""Notices for people: news, and each trouble of a robot when it begins and ends."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import islice

from rightofway.control.journal import Entry
from rightofway.control.messages import AUTOMATIC, Condition
from rightofway.errors import escape_text
from rightofway.facts import Fact

__all__ = ["EVERY_KIND", "Notices", "make_notice"]

BURST = 100
"""Notices of the trouble of a robot that are reported without a pause."""

REFILL = 6.0
"""Seconds after which one more notice may be reported."""

MAX_KINDS = 50
"""Kinds of trouble in one state of a robot that are reported: a robot may list any number."""

EVERY_KIND = "*"
"""In a notice that trouble is over: all trouble that was noticed until then."""

MORE, FLOOD = "more", "flood"
"""Kinds of trouble with the reports themselves."""


@dataclass(slots=True)
class _Told:
    """The trouble of a robot, and the part of it that was reported.

    Attributes
    ----------
    present
        The facts of begin and end of each trouble that lasts, by its kind.
    reported
        The fact of the end of each trouble whose begin was reported and whose end was not.
    left
        Notices that may still be reported.
    since
        When `left` was computed [s].
    condition
        The last condition.
    listed
        The kinds of trouble of that condition.
    """

    present: dict[str, tuple[Fact, Fact | None]] = field(default_factory=dict)
    reported: dict[str, Fact | None] = field(default_factory=dict)
    left: float = BURST
    since: float = 0.0
    condition: Condition = field(default_factory=Condition)
    listed: frozenset[str] = frozenset()


PAUSE = "pause"
"""The kind of trouble of a robot that is paused."""


class Notices:
    """Notices of robots and of the control.

    The begin of each trouble is reported once, and its end. Trouble that comes and goes more often
    than every few seconds is reported in part: `BURST` notices, then one in `REFILL` seconds.
    The last report on each kind is always that of its present state, after `settle` at the latest.

    Parameters
    ----------
    names
        Of the robots.
    report
        Receives each fact.
    clock
        Returns seconds; no release depends on them.
    keep
        Receives an entry for the journal with each fact.
    alarm
        Receives the fact of each trouble that begins, in place of `report`.
    """

    def __init__(
        self,
        names: Sequence[str],
        report: Callable[[Fact], None],
        clock: Callable[[], float] = time.monotonic,
        keep: Callable[[Entry], None] = lambda _: None,
        alarm: Callable[[Fact], None] | None = None,
    ) -> None:
        self._names, self._report, self._clock, self._keep = names, report, clock, keep
        self._alarm = report if alarm is None else alarm
        self._told = [_Told(since=clock()) for _ in names]

    def report(self, fact: Fact | None, kind: str = "", *, is_over: bool = False) -> None:
        """Report a fact that is about no robot.

        Parameters
        ----------
        fact
            The fact; None where trouble ends without a notice.
        kind
            The kind of trouble that begins or ends; empty for news.
        is_over
            Whether it ends.
        """
        if fact is not None:
            self._tell(fact, kind, is_over=is_over)
        self._keep(make_notice(fact, kind=kind, is_over=is_over))

    def report_on(
        self, robot: int, predicate: Fact | None, kind: str = "", *, is_over: bool = False
    ) -> None:
        """Report a fact about a robot.

        Parameters
        ----------
        robot
            The robot.
        predicate
            The fact, without the robot; None where trouble ends without a notice.
        kind
            The kind of trouble that begins or ends; empty for news.
        is_over
            Whether it ends.
        """
        fact = None
        if predicate is not None:
            name = escape_text(self._names[robot])
            fact = Fact("about robot", predicate.about, robot=name, predicate=predicate)
            self._tell(fact, kind, is_over=is_over)
        self._keep(make_notice(fact, robot, kind, is_over=is_over))

    def _tell(self, fact: Fact, kind: str, *, is_over: bool) -> None:
        (self._alarm if kind and not is_over else self._report)(fact)

    def begin(self, robot: int, kind: str, begin: Fact, end: Fact | None) -> None:
        """Report that trouble begins, unless trouble of its kind lasts already.

        Parameters
        ----------
        robot
            The robot.
        kind
            The kind of trouble.
        begin
            The fact, without the robot.
        end
            The fact of its end; None for trouble that does not end.
        """
        self._told[robot].present.setdefault(kind, (begin, end))
        self._settle(robot)

    def end(self, robot: int, kind: str) -> None:
        """Report that trouble of a kind has ended, if there was any.

        Parameters
        ----------
        robot
            The robot.
        kind
            The kind of trouble.
        """
        if self._told[robot].present.pop(kind, None) is not None:
            self._settle(robot)

    def take(self, robot: int, condition: Condition) -> None:
        """Report the trouble that begins or ends with a condition of a robot.

        Parameters
        ----------
        robot
            The robot.
        condition
            By its last state.
        """
        told = self._told[robot]
        if condition == told.condition:
            return
        listed = dict(islice(_list_troubles(condition), MAX_KINDS + 1))
        if len(listed) > MAX_KINDS:
            listed.popitem()
            listed[MORE] = (Fact("more trouble"), Fact("no more trouble"))
        for kind in told.listed - listed.keys():
            del told.present[kind]
        for kind, facts in listed.items():
            told.present.setdefault(kind, facts)
        told.condition, told.listed = condition, frozenset(listed)
        self._settle(robot)

    def settle(self) -> None:
        """Report the present state of trouble that was left out; call it every second."""
        for robot, told in enumerate(self._told):
            if told.reported.keys() != told.present.keys():
                self._settle(robot)

    def _settle(self, robot: int) -> None:
        """Report ends and begins of trouble, as many as may be reported now."""
        told, now = self._told[robot], self._clock()
        told.left = min(told.left + (now - told.since) / REFILL, BURST)
        told.since = now
        ended = [kind for kind in told.reported if kind not in {*told.present, FLOOD}]
        begun = [kind for kind in told.present if kind not in told.reported]
        for kind in ended[: int(told.left)]:
            told.left -= 1
            self.report_on(robot, told.reported.pop(kind), kind, is_over=True)
        for kind in begun[: int(told.left)]:
            told.left -= 1
            begin, told.reported[kind] = told.present[kind]
            self.report_on(robot, begin, kind)
        is_whole = told.reported.keys() - {FLOOD} == told.present.keys()
        if not is_whole and FLOOD not in told.reported:
            told.reported[FLOOD] = Fact("rare trouble")
            self.report_on(robot, Fact("frequent trouble"), FLOOD)
        elif is_whole and FLOOD in told.reported and told.left >= BURST / 2:
            self.report_on(robot, told.reported.pop(FLOOD), FLOOD, is_over=True)


def make_notice(
    fact: Fact | None, robot: int = -1, kind: str = "", *, is_over: bool = False
) -> Entry:
    """Return the entry of a notice for people.

    Parameters
    ----------
    fact
        The fact; None where trouble ends without a notice.
    robot
        The robot that it is about; -1 for none.
    kind
        The kind of trouble; empty for news.
    is_over
        Whether the trouble has ended.
    """
    notice = {"kind": "notice", "robot": robot, "about": kind, "over": is_over}
    return {**notice, "fact": None if fact is None else fact.as_dict()}


def _list_troubles(condition: Condition) -> Iterator[tuple[str, tuple[Fact, Fact]]]:
    """Yield kinds of trouble, each with the facts of its begin and its end."""
    if condition.mode not in AUTOMATIC:
        begin = Fact("other mode", mode=escape_text(condition.mode[:40]))
        yield "mode", (begin, Fact("automatic mode"))
    if condition.is_paused:
        yield PAUSE, (Fact("paused"), Fact("not paused"))
    if condition.emergency_stop not in {"NONE", ""}:
        begin = Fact("emergency stop", stop=escape_text(condition.emergency_stop[:40]))
        yield "emergency stop", (begin, Fact("no emergency stop"))
    for error in condition.errors:
        level, kind = escape_text(error.level[:40]), escape_text(error.kind[:60])
        begin = Fact("error", level=level, error=kind)
        if error.description:
            words = escape_text(error.description[:200])
            begin = Fact("described error", report=begin, words=words)
        end = Fact("no error", level=level, error=kind)
        yield f"error {error.level[:40]} {error.kind[:60]}", (begin, end)
