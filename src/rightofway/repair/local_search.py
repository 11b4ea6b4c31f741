"""Local search on fixed routes: flips of rights of way that make robots late.

A plan is routes and rights of way. A robot loses time only on its critical path: the rights of
way that its completion time depends on. The search flips one of these, for the whole segment that
both robots share, resolves the conflicts that follow by the choice that costs least, and keeps the
result if the plan is better by the objective. Where no flip helps any more, a few robots get the
right of way, or lose it, wherever they have a conflict, and the search goes on from there, round
after round.

References
----------
Mascis & Pacciarelli, *Job-shop scheduling with blocking and no-wait constraints*, European Journal
of Operational Research 143, 2002 (rights of way are its alternative arcs).
Lourenço, Martin & Stützle, *Iterated local search*, Handbook of Metaheuristics, 2003.

Notes
-----
Never worse than the plan that it starts from. Anytime; deterministic for a seed where the rounds
end in time. Not optimal.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator, Sequence
from itertools import chain
from typing import NamedTuple

from rightofway.errors import GaveUp
from rightofway.facts import Fact
from rightofway.model import Objective
from rightofway.precedence import Meeting, PrecedenceGraph, find_rotation
from rightofway.repair.conflict_resolution import list_rights_if_waits
from rightofway.repair.plan_request import PlanRequest

REVERSING = Fact("reversing rights of way")

MOST_FAVOURS = 3
"""The largest number of robots that are favoured or disfavoured in a round."""

MOST_MEETINGS = 100
"""The number of conflicts of one change, per robot of the fleet, above which it is undone."""


Value = tuple[int, int]
"""The value of the objective, and the cost, which decides between plans of equal value [ticks]."""


class _Preference(NamedTuple):
    """A robot that is to go first, or last, wherever it has a conflict."""

    robot: int
    goes_first: bool


class LocalSearch:
    """A graph without conflicts, and flips that keep it so.

    ``may_wait``: whether a visit may be delayed; a visit that has begun may not.
    """

    def __init__(
        self,
        request: PlanRequest,
        graph: PrecedenceGraph,
        may_wait: Callable[[int], bool] = lambda _: True,
    ) -> None:
        self.request = request
        self.graph = graph
        self.may_wait = may_wait
        self.draw = random.Random(request.seed)  # noqa: S311 (no secret depends on it)
        self.alone = [sum(map(route.compute_least, range(len(route)))) for route in graph.routes]
        self._objective, self._weights = request.objective, request.scenario.problem.weights

    def measure(self) -> Value:
        """Return how good the plan is: less is better. More rights of way never make it less."""
        if self._objective is Objective.FLOWTIME:
            flowtime = self.graph.compute_flowtime()
            return flowtime, flowtime
        ends = [self.graph.get_completion(robot) for robot in range(len(self.alone))]
        return self._objective.compute_values(self._weights, ends)

    def run(self, rounds: int) -> None:
        """Descend, then change some robots' luck and descend again, until no robot is late."""
        try:
            # Iterated local search (Lourenço, Martin & Stützle 2003): descend to a local optimum,
            # then perturb and descend again; what is not better is taken back.
            self.descend()
            self.request.better(self.graph.build_tracks)
            for _ in range(rounds):
                if self.graph.compute_flowtime() == sum(self.alone):  # nobody is late
                    return
                mark, before = self.graph.checkpoint(), self.measure()
                try:
                    for _ in range(self.draw.randint(1, MOST_FAVOURS)):
                        self.perturb()
                    self.descend()
                finally:
                    if self.measure() > before:
                        self.graph.rollback(mark)
                if self.measure() < before:
                    self.request.better(self.graph.build_tracks)
        except GaveUp:
            return

    def perturb(self) -> None:
        """Take two robots of which one delays the other; favour or disfavour one everywhere."""
        graph, critical = self.graph, list(self.list_critical_rights())
        if not critical:
            return
        # Ruin: one robot of a critical right of way gives back all its rights, and then is
        # preferred, or prefers others, at every meeting.
        first, second = (graph.place(visit)[0] for visit in self.draw.choice(critical))
        robot = self.draw.choice((first, second))
        mark = graph.checkpoint()
        for a, b in graph.list_rights_of(robot):
            graph.take_back(a, b)
        if not self.resolve(preference=_Preference(robot, goes_first=robot == second)):
            graph.rollback(mark)

    def descend(self) -> None:
        """Flip whatever makes the plan better, until nothing does."""
        improved = True
        while improved:
            improved = False
            # Only critical rights can pay: a plan gets shorter only if its critical path does (as
            # in the neighbourhood of van Laarhoven, Aarts & Lenstra 1992 for job shops).
            critical = list(self.list_critical_rights())
            self.draw.shuffle(critical)
            for first, second in critical:
                self.request.deadline.check(REVERSING)
                improved |= self.flip(first, second)

    def list_critical_rights(self) -> Iterator[tuple[int, int]]:
        """Yield each right of way that makes a robot late, once."""
        late = (r for r, alone in enumerate(self.alone) if self.graph.get_completion(r) > alone)
        rights = chain.from_iterable(self.graph.list_critical_rights(robot) for robot in late)
        yield from dict.fromkeys(rights)

    def flip(self, first: int, second: int) -> bool:
        """Flip a right of way in its whole segment, and resolve the conflicts that follow.

        False, with nothing changed, if that is impossible or the plan does not get better.
        """
        mark, before = self.graph.checkpoint(), self.measure()
        if self.reverse(first, second) and self.resolve(below=before):
            return True
        self.graph.rollback(mark)
        return False

    def reverse(self, first: int, second: int) -> bool:
        """Flip a right of way and all others between the two robots in the segment around it."""
        graph = self.graph
        (i, _), (j, _) = graph.place(first), graph.place(second)
        segment = graph.find_segment_of_right(first, second)
        if not graph.take_back(first, second):
            return False  # a flip before has taken it back already
        # The segment is one resource: all its rights turn round together, or two robots would meet
        # head-on in the middle.
        for a, b in segment.list_meetings():
            graph.take_back(graph.get_visit(i, a), graph.get_visit(j, b))
        rights = [
            (graph.get_visit(j, b), graph.get_visit(i, a)) for a, b in segment.list_rights_of_j()
        ]
        return self.give_all(rights)

    def give_all(self, rights: Sequence[tuple[int, int]]) -> bool:
        """Give several rights of way; false, without a change, if that is impossible."""
        return all(self.may_wait(second) for _, second in rights) and self.graph.give_all(rights)

    def resolve(self, *, below: Value | None = None, preference: _Preference | None = None) -> bool:
        """Resolve all conflicts; false if that is impossible or the plan not better."""
        for _ in range(MOST_MEETINGS * len(self.alone)):
            # Rights of way only ever delay robots, so a plan that is not better now never will be.
            if below is not None and self.measure() >= below:
                return False
            meeting = self.graph.find_next_meeting()
            if meeting is None:
                # Without meetings the plan is whole; where rotations are forbidden, the result
                # decides.
                return not find_rotation(self.request.scenario.problem, self.graph.build_tracks())
            if not self.resolve_one(meeting, preference):
                return False
        return False

    def resolve_one(self, meeting: Meeting, preference: _Preference | None) -> bool:
        """Let one of two robots wait, by preference or by its cost; false if neither can."""
        graph, mark = self.graph, self.graph.checkpoint()
        segment = graph.find_segment(*meeting.visits)
        choices = []
        for waits in (0, 1):
            against = preference is not None and preference.robot in meeting.robots
            if preference is not None and against:
                is_waiting = meeting.robots[waits] == preference.robot
                against = is_waiting == preference.goes_first
            rights = list_rights_if_waits(graph, meeting, segment, waits)
            if self.give_all(rights):
                cost = (against, self.measure(), graph.count_conflicts(), waits)
                choices.append((cost, rights))
            graph.rollback(mark)
        return bool(choices) and self.give_all(min(choices)[1])
