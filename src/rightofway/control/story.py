"""A log that reads as a story: who sets out, waits for whom, goes on, and has done its work."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from rightofway.control.ledger import Ledger, RobotLedger
from rightofway.precedence import Part

__all__ = ["Story"]


@dataclass(slots=True)
class _Chapter:
    """What was written of a robot."""

    finished: int = 0
    waits_for: int | None = None  # the part
    has_set_out: bool = False
    has_ended: bool = False


class Story:
    """What has happened, in sentences, each once.

    Parameters
    ----------
    ledger
        What is known of the robots.
    names
        Of the robots.

    Attributes
    ----------
    waits
        How often each robot waited for others at the end of what was released to it.
    """

    def __init__(self, ledger: Ledger, names: Sequence[str]) -> None:
        self._ledger, self._names = ledger, names
        self._chapters = [_Chapter() for _ in names]
        self.waits = [0] * len(names)

    def go_on(self) -> Iterator[str]:
        """Yield a sentence for all that is new.

        Call it at the end of an instant: within one, a robot may wait for a state that has come.
        """
        for robot, own in enumerate(self._ledger.robots):
            yield from self._of_robot(robot, own, self._chapters[robot])

    def _of_robot(self, robot: int, own: RobotLedger, chapter: _Chapter) -> Iterator[str]:
        name, place = self._names[robot], own.route.place(own.arrived)
        if own.jobs_done > chapter.finished:
            chapter.finished = own.jobs_done
            jobs = own.jobs_done + len(own.route.all_jobs() - own.finished)
            yield f"{name} has done its work at {place} ({chapter.finished} of {jobs})"
        waited = chapter.waits_for is not None and own.released >= chapter.waits_for
        if waited or (own.released > own.arrived and not chapter.has_set_out):
            verb = "goes on" if chapter.has_set_out else "sets out"
            chapter.waits_for, chapter.has_set_out = None, True
            yield f"{name} {verb} from {place} to {own.route.place(own.released)}"
        next_part = own.released + 1
        if next_part == own.route.end:
            if own.is_done and not chapter.has_ended:
                chapter.has_ended = True
                yield f"{name} is at the end of its way, {place}"
            return
        is_at_end = own.arrived == own.released and own.finished.issuperset(
            own.route.jobs_at(own.arrived)
        )
        missing = self._ledger.graph.missing(Part(robot, next_part), self._ledger.arrived)
        if is_at_end and missing and chapter.waits_for is None:
            chapter.waits_for = next_part
            self.waits[robot] += 1
            others = " and ".join(
                f"{self._names[arrival.robot]} is at {self._place(arrival.robot, arrival.visit)}"
                for arrival in missing
            )
            yield f"{name} waits at {place} until {others}"

    def _place(self, robot: int, visit: int) -> str:
        return self._ledger.robots[robot].route.place(visit)
