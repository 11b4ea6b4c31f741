"""What people are told of robots: each kind of trouble once, until it has ended."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence

from rightofway.control.messages import AUTOMATIC, Condition
from rightofway.errors import printable

__all__ = ["Notices"]

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
    """

    def __init__(
        self,
        names: Sequence[str],
        report: Callable[[str], None],
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._names, self._report, self._clock = names, report, clock
        self._last: list[dict[str, float]] = [{} for _ in names]
        self._present: list[dict[str, str]] = [{} for _ in names]
        self._conditions = [Condition()] * len(names)

    def about(self, robot: int, sentence: str) -> None:
        """Report a sentence on a robot.

        Parameters
        ----------
        robot
            The robot.
        sentence
            What it does or is, without its name.
        """
        self._report(printable(f"{self._names[robot]} {sentence}"))

    def once(self, robot: int, kind: str, sentence: str) -> bool:
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
                self.about(robot, "reports further kinds of trouble, which are left out here")
            return False
        last[kind] = now
        self.about(robot, sentence)
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
            if kind in before or self.once(robot, kind, sentence)
        }
        for kind, end in before.items():
            if kind not in present and end:
                self.about(robot, end)
        self._present[robot] = reported


def _troubles(condition: Condition) -> Iterator[tuple[str, tuple[str, str]]]:
    """Yield kinds of trouble, each with a sentence on its begin, and on its end."""
    if condition.mode not in AUTOMATIC:
        mode = condition.mode[:40]
        begin = f"is in mode {mode}: it gets nothing more until it is in AUTOMATIC again"
        yield "mode", (begin, "is in an automatic mode again")
    if condition.is_paused:
        yield "pause", ("is paused: it gets nothing more until it goes on", "is paused no longer")
    if condition.emergency_stop not in {"NONE", ""}:
        begin = f"is in emergency stop ({condition.emergency_stop[:40]}): a person has to look"
        yield "emergency stop", (begin, "is out of its emergency stop")
    for error in condition.errors:
        words = f": {error.description[:200]}" if error.description else ""
        sentence = f"reports {error.level[:40]} {error.kind[:60]}{words}"
        yield f"error {error.level[:40]} {error.kind[:60]}", (sentence, "")
