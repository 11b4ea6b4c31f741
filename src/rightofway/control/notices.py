"""What people are told of robots: each kind of trouble once, until it has ended."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence

from rightofway.control.journal import Entry
from rightofway.control.messages import AUTOMATIC, Condition
from rightofway.errors import escape_text
from rightofway.phrases import Phrase, to_parts
from rightofway.report.driving import describe_robot

__all__ = ["Notices", "make_notice"]

QUIET = 600.0
"""Seconds after which a kind of trouble that comes and goes is reported again."""

MAX_KINDS = 50
"""Kinds of trouble of a robot that are reported: a robot may make up as many as it likes."""


class Notices:
    """Sentences on robots.

    Parameters
    ----------
    names
        Of the robots.
    report
        Receives each sentence.
    clock
        Returns seconds; no release depends on them.
    keep
        Receives an entry for the journal with each sentence, and when a kind of trouble has ended.
    """

    def __init__(
        self,
        names: Sequence[str],
        report: Callable[[str], None],
        clock: Callable[[], float] = time.monotonic,
        keep: Callable[[Entry], None] = lambda _: None,
    ) -> None:
        self._names, self._report, self._clock, self._keep = names, report, clock, keep
        self._last: list[dict[str, float]] = [{} for _ in names]
        self._present: list[dict[str, str]] = [{} for _ in names]
        self._conditions = [Condition()] * len(names)

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

    def report_once(self, robot: int, kind: str, sentence: str) -> bool:
        """Report a sentence unless one of its kind was reported lately; return whether it was.

        Parameters
        ----------
        robot
            The robot.
        kind
            What counts as the same.
        sentence
            What it does or is, without its name.
        """
        last, now = self._last[robot], self._clock()
        if kind in last and now - last[kind] < QUIET:
            return False
        if kind not in last and len(last) >= MAX_KINDS:
            if len(last) == MAX_KINDS:
                last["more"] = now
                self.report_on(
                    robot, Phrase("reports further kinds of trouble, which are left out here")
                )
            return False
        last[kind] = now
        self.report_on(robot, sentence, kind)
        return True

    def take(self, robot: int, condition: Condition) -> None:
        """Report what is new in the condition of a robot, and what has ended.

        Parameters
        ----------
        robot
            The robot.
        condition
            By its last state.
        """
        if condition == self._conditions[robot]:
            return
        self._conditions[robot] = condition
        present, before = dict(_troubles(condition)), self._present[robot]
        reported = {
            kind: end
            for kind, (sentence, end) in present.items()
            if kind in before or self.report_once(robot, kind, sentence)
        }
        for kind, end in before.items():
            if kind not in present:
                self.report_on(robot, end, kind, is_over=True)
        self._present[robot] = reported


def make_notice(text: object, robot: int = -1, kind: str = "", *, is_over: bool = False) -> Entry:
    """Return the entry of what people were told.

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


def _troubles(condition: Condition) -> Iterator[tuple[str, tuple[str, str]]]:
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
        yield f"error {error.level[:40]} {error.kind[:60]}", (sentence, "")
