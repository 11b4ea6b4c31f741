"""Sentences on robots for people: news, and each trouble of a robot when it begins and ends."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import islice

from rightofway.control.journal import Entry
from rightofway.control.messages import AUTOMATIC, Condition
from rightofway.errors import escape_text
from rightofway.phrases import Phrase, to_parts
from rightofway.report.driving import describe_robot

__all__ = ["EVERY_KIND", "Notices", "make_notice"]

BURST = 100
"""Sentences on the trouble of a robot that are reported without a pause."""

REFILL = 6.0
"""Seconds after which one more sentence may be reported."""

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
        The sentence on the begin of each trouble that lasts, and on its end, by its kind.
    reported
        The sentence on the end of each trouble whose begin was reported and whose end was not.
    left
        Sentences that may still be reported.
    since
        When `left` was computed [s].
    condition
        The last condition.
    listed
        The kinds of trouble of that condition.
    """

    present: dict[str, tuple[str, str]] = field(default_factory=dict)
    reported: dict[str, str] = field(default_factory=dict)
    left: float = BURST
    since: float = 0.0
    condition: Condition = field(default_factory=Condition)
    listed: frozenset[str] = frozenset()


class Notices:
    """Sentences on robots.

    The begin of each trouble is reported once, and its end. Trouble that comes and goes more often
    than every few seconds is reported in part: `BURST` sentences, then one in `REFILL` seconds.
    The last report on each kind is always that of its present state, after `settle` at the latest.

    Parameters
    ----------
    names
        Of the robots.
    report
        Receives each sentence.
    clock
        Returns seconds; no release depends on them.
    keep
        Receives an entry for the journal with each sentence.
    """

    def __init__(
        self,
        names: Sequence[str],
        report: Callable[[str], None],
        clock: Callable[[], float] = time.monotonic,
        keep: Callable[[Entry], None] = lambda _: None,
    ) -> None:
        self._names, self._report, self._clock, self._keep = names, report, clock, keep
        self._told = [_Told(since=clock()) for _ in names]

    def report(self, text: str, kind: str = "", *, is_over: bool = False) -> None:
        """Report a sentence that is about no robot.

        Parameters
        ----------
        text
            The sentence; empty where trouble ends without a word.
        kind
            The kind of trouble that begins or ends; empty for news.
        is_over
            Whether it ends.
        """
        if text:
            self._report(text)
        self._keep(make_notice(to_parts(text), kind=kind, is_over=is_over))

    def report_on(
        self, robot: int, sentence: str, kind: str = "", *, is_over: bool = False
    ) -> None:
        """Report a sentence on a robot.

        Parameters
        ----------
        robot
            The robot.
        sentence
            What it does or is, without its name; empty where trouble ends without a word.
        kind
            The kind of trouble that begins or ends; empty for news.
        is_over
            Whether it ends.
        """
        text = ""
        if sentence:
            plain = sentence if isinstance(sentence, Phrase) else escape_text(sentence)
            text = describe_robot(escape_text(self._names[robot]), plain)
            self._report(text)
        self._keep(make_notice(to_parts(text), robot, kind, is_over=is_over))

    def begin(self, robot: int, kind: str, sentence: str, end: str) -> None:
        """Report that trouble begins, unless trouble of its kind lasts already.

        Parameters
        ----------
        robot
            The robot.
        kind
            The kind of trouble.
        sentence
            What the robot does or is, without its name.
        end
            The sentence on its end.
        """
        self._told[robot].present.setdefault(kind, (sentence, end))
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
            begin = Phrase("reports further kinds of trouble, which are left out here")
            listed[MORE] = (begin, Phrase("reports no further kinds of trouble"))
        for kind in told.listed - listed.keys():
            del told.present[kind]
        for kind, sentences in listed.items():
            told.present.setdefault(kind, sentences)
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
            sentence, told.reported[kind] = told.present[kind]
            self.report_on(robot, sentence, kind)
        is_whole = told.reported.keys() - {FLOOD} == told.present.keys()
        if not is_whole and FLOOD not in told.reported:
            begin = Phrase("has trouble that begins and ends too often: it is reported in part")
            told.reported[FLOOD] = Phrase("has trouble less often: all of it is reported again")
            self.report_on(robot, begin, FLOOD)
        elif is_whole and FLOOD in told.reported and told.left >= BURST / 2:
            self.report_on(robot, told.reported.pop(FLOOD), FLOOD, is_over=True)


def make_notice(text: object, robot: int = -1, kind: str = "", *, is_over: bool = False) -> Entry:
    """Return the entry of a sentence for people.

    Parameters
    ----------
    text
        The sentence, as `to_parts` returns it.
    robot
        The robot that it is about; -1 for none.
    kind
        The kind of trouble; empty for news.
    is_over
        Whether the trouble has ended.
    """
    return {"kind": "notice", "robot": robot, "about": kind, "over": is_over, "text": text}


def _list_troubles(condition: Condition) -> Iterator[tuple[str, tuple[str, str]]]:
    """Yield kinds of trouble, each with a sentence on its begin, and on its end."""
    if condition.mode not in AUTOMATIC:
        begin = Phrase(
            "is in mode {mode}: it gets nothing more until it is in AUTOMATIC again",
            mode=escape_text(condition.mode[:40]),
        )
        yield "mode", (begin, Phrase("is in an automatic mode again"))
    if condition.is_paused:
        begin = Phrase("is paused: it gets nothing more until it goes on")
        yield "pause", (begin, Phrase("is paused no longer"))
    if condition.emergency_stop not in {"NONE", ""}:
        begin = Phrase(
            "is in emergency stop ({stop}): a person has to look",
            stop=escape_text(condition.emergency_stop[:40]),
        )
        yield "emergency stop", (begin, Phrase("is out of its emergency stop"))
    for error in condition.errors:
        level, kind = escape_text(error.level[:40]), escape_text(error.kind[:60])
        sentence = Phrase("reports {level} {error}", level=level, error=kind)
        if error.description:
            words = escape_text(error.description[:200])
            sentence = Phrase("{report}: {words}", report=sentence, words=words)
        end = Phrase("no longer reports {level} {error}", level=level, error=kind)
        yield f"error {error.level[:40]} {error.kind[:60]}", (sentence, end)
