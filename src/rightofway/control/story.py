"""The story of a run: which robot sets out, waits for which, goes on, and has done its work."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Literal, NamedTuple

from rightofway.control.ledger import Ledger
from rightofway.control.names import describe_place
from rightofway.control.releases import find_closed, list_strayed_to
from rightofway.control.robot_ledger import RobotLedger
from rightofway.control.work_items import describe_item
from rightofway.facts import Fact
from rightofway.precedence import Part

__all__ = ["Happening", "Story"]


class Happening(NamedTuple):
    """Something new that a robot does.

    Attributes
    ----------
    robot
        Its number.
    kind
        Whether it has done work, drives, waits for others, or is at the end of its route.
    fact
        Robot, places and conditions of it.
    others
        The robots that it waits for.
    """

    robot: int
    kind: Literal["work", "drive", "wait", "end"]
    fact: Fact
    others: tuple[int, ...] = ()


@dataclass(slots=True)
class _Chapter:
    """The entries of a robot."""

    finished: int = 0
    waits_for: int | None = None  # the part
    conditions: frozenset[Fact] = frozenset()  # of going on, when this was written
    has_set_out: bool = False
    has_ended: bool = False


class Story:
    """The events of a run, each once. Waits are counted in the ledger, for its snapshots.

    Parameters
    ----------
    ledger
        The records of the robots.
    names
        Of the robots.
    """

    def __init__(self, ledger: Ledger, names: Sequence[str]) -> None:
        self._ledger, self._names = ledger, names
        self._chapters = [  # of a journal of before, the story goes on
            _Chapter(finished=own.jobs_done, has_set_out=own.arrived > 0, has_ended=own.is_done)
            for own in ledger.robots
        ]

    def go_on(self) -> Iterator[Happening]:
        """Yield all that is new, of the robots that have changed.

        Call it at the end of an instant: within one, a robot may wait for a state that has come.
        """
        robots = sorted(self._ledger.changed)
        self._ledger.changed.clear()
        for robot in robots:
            yield from self._list_of_robot(robot, self._ledger.robots[robot], self._chapters[robot])

    def _list_of_robot(
        self, robot: int, own: RobotLedger, chapter: _Chapter
    ) -> Iterator[Happening]:
        name, place = self._names[robot], own.route.get_place(own.arrived)
        if own.jobs_done > chapter.finished:
            chapter.finished = own.jobs_done
            jobs = own.jobs_done + len(own.route.all_jobs - own.finished)
            done = Fact("work done", robot=name, place=place, done=chapter.finished, jobs=jobs)
            if (item := _find_last_item(own)) is not None:
                done = Fact("item done", robot=name, place=place, item=item)
            yield Happening(robot, "work", done)
        next_part = own.released + 1
        if chapter.has_ended and next_part < own.route.end:  # it was given more to do
            chapter.has_ended = chapter.has_set_out = False
        waited = chapter.waits_for is not None and own.released >= chapter.waits_for
        if waited or (own.released > own.arrived and not chapter.has_set_out):
            kind = "goes on" if chapter.has_set_out else "sets out"
            chapter.waits_for, chapter.has_set_out = None, True
            target = own.route.get_place(own.released)
            drive = Fact(kind, robot=name, place=place, target=target)
            yield Happening(robot, "drive", drive)
        if next_part == own.route.end:
            if own.is_done and not chapter.has_ended:
                chapter.has_ended = True
                yield Happening(robot, "end", Fact("end of way", robot=name, place=place))
            return
        is_at_end = own.arrived == own.released and own.finished.issuperset(
            own.route.get_jobs(own.arrived)
        )
        if not is_at_end:
            return
        conditions, awaited = self._list_conditions(robot, own, next_part)
        is_new = chapter.waits_for is None
        if conditions and (is_new or not chapter.conditions.issuperset(conditions)):
            chapter.waits_for, chapter.conditions = next_part, frozenset(conditions)
            own.waits += is_new
            wait = Fact("waits", robot=name, place=place, arrivals=tuple(conditions))
            yield Happening(robot, "wait", wait, awaited)

    def _list_conditions(
        self, robot: int, own: RobotLedger, part: int
    ) -> tuple[list[Fact], tuple[int, ...]]:
        """Return the conditions under which a part may be released, and the robots in them."""
        ledger, names = self._ledger, self._names
        tail, head = own.route.get_place(part - 1), own.route.get_place(part)
        missing = ledger.graph.list_missing(Part(robot, part), ledger.arrived)
        conditions = [
            Fact(
                "robot at place",
                robot=names[arrival.robot],
                place=self._place(arrival.robot, arrival.visit),
            )
            for arrival in missing
        ]
        closed, strayed = find_closed(ledger, tail, head), list_strayed_to(ledger, head)
        if closed is not None:
            conditions.append(describe_place("open", closed))
        conditions += [
            Fact("robot has left", robot=names[other], place=head)
            for other in strayed
            if other != robot
        ]
        return conditions, (*(arrival.robot for arrival in missing), *strayed)

    def _place(self, robot: int, visit: int) -> str:
        return self._ledger.robots[robot].route.get_place(visit)


def _find_last_item(own: RobotLedger) -> Fact | None:
    """Return the last work of a tour that a robot has done where it stands; None for others."""
    done = [item for item in own.route.get_jobs(own.arrived) if item in own.finished]
    item = describe_item(done[-1]) if done else ""
    return item if isinstance(item, Fact) else None
