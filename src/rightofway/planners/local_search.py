"""Local search on fixed routes: take the right of way from those who delay others.

A plan is routes and rights of way. Whatever a robot loses, it loses on its critical path: the
rights of way that its completion time is due to. One of these is flipped, for the whole segment
that both robots share; whoever meets then is kept apart by the choice that costs least; and the
result is kept if the flowtime is less. Where no flip helps any more, a few robots go first, or
last, wherever they meet anybody, and the search goes on from there, for so many rounds.

References
----------
Mascis & Pacciarelli, *Job-shop scheduling with blocking and no-wait constraints*, European Journal
of Operational Research 143, 2002 (rights of way are its alternative arcs).
Lourenço, Martin & Stützle, *Iterated local search*, Handbook of Metaheuristics, 2003.

Notes
-----
Never worse than the plan it starts from. Anytime; deterministic for a seed where the rounds come to
an end in time. Not optimal.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator, Sequence
from itertools import chain
from typing import NamedTuple

from rightofway.errors import GaveUp
from rightofway.model import Tick
from rightofway.planners.conflict_resolution import rights_if_waits
from rightofway.planners.task import Draft, Task, planning_headway
from rightofway.planners.two_level import two_level
from rightofway.precedence import Meeting, PrecedenceGraph, graph_of, shared_segment

__all__ = ["Search", "local_search"]

MOST_FAVOURS = 3
"""How many robots at most are to go first or last in a round."""

MOST_MEETINGS = 100
"""How many meetings one change may lead to, per robot of the fleet, before it is given up."""


class _Favour(NamedTuple):
    """A robot that is to go first, or last, wherever it meets another."""

    robot: int
    goes_first: bool

    def is_against(self, meeting: Meeting, waits: int) -> bool:
        """Tell whether one of two robots (0: i, 1: j) had better not wait."""
        concerned = self.robot in meeting.robots
        return concerned and (meeting.robots[waits] == self.robot) == self.goes_first


def local_search(task: Task) -> Draft:
    """Improve a plan without changing its routes.

    Parameters
    ----------
    task
        Options: ``rounds`` after the first descent; ``routes`` for `two_level`, which makes the
        plan to start from where none is given.

    Raises
    ------
    NoPlanExists, GaveUp
        As `two_level`, where no plan to start from is given.
    """
    first = Draft(tracks=task.start, status="") if task.start else two_level(task)
    task.has_plan()
    before = graph_of(task.scenario, first.tracks)
    graph = graph_of(task.scenario, first.tracks, headway=planning_headway(task.scenario))
    Search(task, graph).run(rounds=int(task.options["rounds"]))
    if graph.flowtime() > before.flowtime():  # the headway of planning may cost more than it won
        graph = before
    said = f"flips took the flowtime from {before.flowtime()} to {graph.flowtime()} ticks"
    return Draft(
        tracks=tuple(graph.tracks()),
        status=f"{first.status}; {said}" if first.status else said,
        reroutes=first.reroutes,
    )


class Search:
    """A graph without meetings, and flips that keep it so.

    Parameters
    ----------
    task
        The problem.
    graph
        Without meetings.
    may_wait
        Tells of a visit whether another may be let go before it; it may not if it has begun.
    """

    def __init__(
        self,
        task: Task,
        graph: PrecedenceGraph,
        may_wait: Callable[[int], bool] = lambda _: True,
    ) -> None:
        self.task = task
        self.graph = graph
        self.may_wait = may_wait
        self.draw = random.Random(task.seed)  # noqa: S311 (no secret depends on it)
        self.alone = [_alone(graph, robot) for robot in range(len(graph.routes))]

    def run(self, rounds: int) -> None:
        """Descend, then favour robots and descend again; stop early where no robot is late."""
        try:
            self.descend()
            for _ in range(rounds):
                if self.graph.flowtime() == sum(self.alone):
                    return
                self.round()
        except GaveUp:
            return

    def round(self) -> None:
        """Favour some robots, descend, and go back if that made it worse."""
        mark, before = self.graph.checkpoint(), self.graph.flowtime()
        try:
            for _ in range(self.draw.randint(1, MOST_FAVOURS)):
                self.favour()
            self.descend()
        finally:
            if self.graph.flowtime() > before:
                self.graph.rollback(mark)

    def favour(self) -> None:
        """Take two robots of which one delays the other; turn one's luck wherever it meets."""
        graph, critical = self.graph, list(self.critical_rights())
        if not critical:
            return
        first, second = (graph.place(visit)[0] for visit in self.draw.choice(critical))
        robot = self.draw.choice((first, second))
        mark = graph.checkpoint()
        for a, b in graph.rights_of(robot):
            graph.take_back(a, b)
        if not self.settle(favour=_Favour(robot, goes_first=robot == second)):
            graph.rollback(mark)

    def descend(self) -> None:
        """Flip whatever makes the flowtime less, until nothing does."""
        improved = True
        while improved:
            improved = False
            critical = list(self.critical_rights())
            self.draw.shuffle(critical)
            for first, second in critical:
                self.task.deadline.check("flipping rights of way")
                improved |= self.flip(first, second)

    def critical_rights(self) -> Iterator[tuple[int, int]]:
        """Yield each right of way that makes a robot late, once."""
        late = (r for r, alone in enumerate(self.alone) if self.graph.completion(r) > alone)
        rights = chain.from_iterable(self.graph.critical_rights(robot) for robot in late)
        yield from dict.fromkeys(rights)

    def flip(self, first: int, second: int) -> bool:
        """Give the other robot the right of way in a whole segment, and settle who meets then.

        False, with nothing changed, if that is impossible or the flowtime does not get less.
        """
        mark, before = self.graph.checkpoint(), self.graph.flowtime()
        if self.reverse(first, second) and self.settle(below=before):
            return True
        self.graph.rollback(mark)
        return False

    def reverse(self, first: int, second: int) -> bool:
        """Flip a right of way and all others between the two robots in the segment around it."""
        graph = self.graph
        (i, visit_i), (j, visit_j) = graph.place(first), graph.place(second)
        segment = shared_segment(graph.routes[i], visit_i, graph.routes[j], visit_j)
        if not graph.take_back(first, second):
            return False  # a flip before has taken it back already
        for a, b in segment.meetings():
            graph.take_back(graph.visit(i, a), graph.visit(j, b))
        return self.give_all(
            [(graph.visit(j, b), graph.visit(i, a)) for a, b in segment.if_i_waits()]
        )

    def give_all(self, rights: Sequence[tuple[int, int]]) -> bool:
        """Give several rights of way; false, with nothing changed, if that is impossible."""
        return all(self.may_wait(second) for _, second in rights) and self.graph.give_all(rights)

    def settle(self, *, below: Tick | None = None, favour: _Favour | None = None) -> bool:
        """Keep apart whoever meets; false if that is impossible or the flowtime not below."""
        for _ in range(MOST_MEETINGS * len(self.alone)):
            if below is not None and self.graph.flowtime() >= below:
                return False  # more rights of way never make it less
            meeting = self.graph.next_meeting()
            if meeting is None:
                return True
            if not self.keep_apart(meeting, favour):
                return False
        return False

    def keep_apart(self, meeting: Meeting, favour: _Favour | None) -> bool:
        """Let one of two robots wait, by favour or by what it costs; false if neither can."""
        graph, mark = self.graph, self.graph.checkpoint()
        (i, visit_i), (j, visit_j) = (graph.place(visit) for visit in meeting.visits)
        segment = shared_segment(graph.routes[i], visit_i, graph.routes[j], visit_j)
        choices = []
        for waits in (0, 1):
            against = favour is not None and favour.is_against(meeting, waits)
            rights = rights_if_waits(graph, meeting, segment, waits)
            if self.give_all(rights):
                cost = (against, graph.flowtime(), graph.conflicts_left(), waits)
                choices.append((cost, rights))
            graph.rollback(mark)
        return bool(choices) and self.give_all(min(choices)[1])


def _alone(graph: PrecedenceGraph, robot: int) -> Tick:
    """Return when a robot would complete its route if it never waited."""
    route = graph.routes[robot]
    return Tick(sum(route.least(visit) for visit in range(len(route))))
