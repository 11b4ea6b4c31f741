"""The native precedence graph is, after every step, what its slow twin says.

The kernel keeps everything up to date from what has changed; the twin starts afresh each time.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import accumulate
from typing import Literal, NamedTuple

import numpy as np
from hypothesis import strategies as st

from rightofway._core import PrecedenceGraph
from tests.builders.laws import law
from tests.oracles import precedence as oracle
from tests.oracles.precedence import Right, System

Kind = Literal["give", "take back", "flip", "go back"]


class Step(NamedTuple):
    """What to do next, and whether to look at the results before the step after."""

    kind: Kind
    right: Right | None  # to give
    pick: int  # which mark to go back to, or which right of way to take back or flip
    look: bool


class Twin:
    """The rights of way as they should be, and all that they were before."""

    def __init__(self, system: System) -> None:
        self.system = system
        self.rights: list[Right] = []
        self.before: list[list[Right]] = []

    def do(self, step: Step) -> bool:
        """Do a step; return whether it is possible."""
        if step.kind == "go back":
            mark = step.pick % (len(self.before) + 1)
            self.rights = [*self.before, self.rights][mark]
            del self.before[mark:]
            return True
        right = self.right_of(step)
        if right is None:
            return False
        if step.kind == "give":
            return right in self.rights or self.change(*self.rights, right)
        others = [one for one in self.rights if one != right]
        if step.kind == "take back":
            return self.change(*others)
        flipped = Right(right.second, right.first)
        if not oracle.is_possible(self.system, others, flipped):
            return False
        return self.change(*others) and (flipped in others or self.change(*others, flipped))

    def change(self, *rights: Right) -> bool:
        """Have other rights of way, if that is possible."""
        if len(rights) > len(self.rights) and not oracle.is_possible(
            self.system, self.rights, rights[-1]
        ):
            return False
        self.before.append(self.rights)
        self.rights = list(rights)
        return True

    def right_of(self, step: Step) -> Right | None:
        """Return what a step gives, takes back or flips."""
        if step.kind == "give":
            return step.right
        return self.rights[step.pick % len(self.rights)] if self.rights else None


@st.composite
def routes(draw: st.DrawFn) -> tuple[tuple[int, ...], ...]:
    """Few vertices, so that robots meet all the time; each step is to a different one."""
    n_vertices = draw(st.integers(2, 6))
    start = st.integers(0, n_vertices - 1)
    step = st.integers(1, n_vertices - 1)
    lengths = draw(st.lists(st.sampled_from([5, 8, 1, 2]), min_size=2, max_size=4))
    return tuple(
        tuple(
            v % n_vertices
            for v in accumulate((draw(step) for _ in range(n - 1)), initial=draw(start))
        )
        for n in lengths
    )


@st.composite
def systems(draw: st.DrawFn) -> System:
    """One or both vertices booked while moving, with headway and without, some robots inactive."""
    paths = draw(routes())
    n_visits = sum(map(len, paths))
    ticks = st.integers(1, draw(st.sampled_from([1, 4])))
    approach = st.integers(0, draw(st.sampled_from([0, 0, 1, 6])))
    return System(
        routes=paths,
        least=tuple(draw(st.lists(ticks, min_size=n_visits, max_size=n_visits))),
        approach=tuple(draw(approach) if k > 0 else 0 for path in paths for k in range(len(path))),
        headway=draw(st.sampled_from([0, 0, 2])),
        swaps_conflict=draw(st.booleans()),
        active=tuple(draw(st.sampled_from([True] * 5 + [False])) for _ in paths),
    )


def meetings(system: System) -> list[Right]:
    """Every right of way that can be asked for."""
    visits = range(len(system.vertex))
    return [
        Right(a, b)
        for a in visits
        for b in visits
        if system.vertex[a] == system.vertex[b]
        and system.robot[a] != system.robot[b]
        and system.active[system.robot[a]]
        and system.active[system.robot[b]]
    ]


@st.composite
def runs(draw: st.DrawFn) -> tuple[System, list[Step]]:
    """A system, and what to do with it: mostly rights of way, now and then less or others.

    Most rights of way ask for what a planner would: the visit goes first whose turn it is. Some
    come in pairs that make two robots exchange their vertices.
    """
    system = draw(systems())
    pairs = meetings(system)
    sensible = [right for right in pairs if is_sensible(system, right)]
    exchanges = [right for right in sensible if opposite(right) in pairs]
    asked: list[Right | None] = []
    for _ in range(draw(st.sampled_from([12, 4, 20]))):
        kind = draw(st.sampled_from([*[sensible] * 6, exchanges, pairs, []]))
        right = draw(st.sampled_from(kind)) if kind else None
        asked.append(right)
        if right is not None and kind is exchanges:
            asked.append(opposite(right))
    less: list[Kind] = ["go back", "take back", "flip"]
    return system, [
        Step(
            "give" if right is not None else draw(st.sampled_from(less)),
            right,
            draw(st.integers(0, 20)),
            draw(st.booleans()),
        )
        for right in asked
    ]


def is_sensible(system: System, right: Right) -> bool:
    """Return whether the visit that goes first is about as early on its route as the other."""
    place = [x - system.first_visit[r] for x, r in enumerate(system.robot)]
    late = place[right.first] - place[right.second]
    return late <= 1 and not system.is_last(right.first) and not system.is_first(right.second)


def opposite(right: Right) -> Right:
    """Return the right of way that makes a swap of this one, if the vertices fit."""
    return Right(right.second - 1, right.first + 1)


def check(system: System, rights: list[Right], kernel: PrecedenceGraph) -> None:
    """Everything that the kernel can be asked has the answer of its twin."""
    enter = oracle.enters(system, rights)
    assert enter is not None
    found = oracle.conflicts(system, enter)
    n_robots = len(system.routes)

    assert kernel.rights_of_way().tolist() == [list(right) for right in rights]
    assert kernel.enter().tolist() == enter
    assert kernel.conflicts() == sum(c.weight for c in found)
    assert kernel.next_conflict() == (found[0].as_tuple() if found else None)
    for r in range(n_robots):
        assert kernel.completion(r) == enter[system.first_visit[r + 1] - 1]
        for other in range(n_robots):
            check_pair(kernel, n_robots, r, other, found)


def check_pair(
    kernel: PrecedenceGraph, n_robots: int, r: int, other: int, found: list[oracle.Conflict]
) -> None:
    theirs = [c for c in found if {c.robot_a, c.robot_b} == {r, other}]
    others = (np.arange(n_robots) == other).astype(np.uint8)
    assert kernel.conflicts_of(r, others) == sum(c.weight for c in theirs)
    if r != other:
        earliest = theirs[0].as_tuple() if theirs else None
        assert kernel.next_conflict_between(r, other) == earliest


def flip(kernel: PrecedenceGraph, first: int, second: int) -> bool:
    """Take a right of way back and give the opposite one; nothing changes if that is impossible."""
    mark = kernel.checkpoint()
    if not kernel.take_back(first, second):
        return False
    if not kernel.precede(second, first):
        kernel.rollback(mark)
        return False
    return True


def take(step: Step, twin: Twin, kernel: PrecedenceGraph) -> tuple[bool, bool]:
    """Do the step to both; return whether the kernel and the twin found it possible."""
    right = twin.right_of(step)
    if step.kind == "go back":
        kernel.rollback(step.pick % (len(twin.before) + 1))
        possible = True
    elif right is None:
        possible = False
    elif step.kind == "give":
        possible = kernel.precede(*right)
    else:
        possible = kernel.take_back(*right) if step.kind == "take back" else flip(kernel, *right)
    return possible, twin.do(step)


@law(runs())
def test_kernel_and_twin_agree_after_every_step(run: tuple[System, list[Step]]) -> None:
    system, todo = run
    kernel, twin = system.kernel(), Twin(system)
    check(system, twin.rights, kernel)

    for step in todo:
        possible, expected = take(step, twin, kernel)
        assert possible == expected
        assert kernel.checkpoint() == len(twin.before)
        if step.look:
            check(system, twin.rights, kernel)
    check(system, twin.rights, kernel)


@law(runs())
def test_times_never_decrease_when_a_right_of_way_is_given(run: tuple[System, list[Step]]) -> None:
    system, todo = run
    kernel = system.kernel()

    for step in todo:
        before = kernel.enter()
        if step.right is not None and kernel.precede(*step.right):
            assert (kernel.enter() >= before).all()


@law(runs())
def test_times_never_increase_when_a_right_of_way_is_taken_back(
    run: tuple[System, list[Step]],
) -> None:
    system, todo = run
    kernel, twin = system.kernel(), Twin(system)
    for step in todo:
        take(step, twin, kernel)

    for right in list(twin.rights):
        before = kernel.enter()
        assert kernel.take_back(*right)
        assert (kernel.enter() <= before).all()
    check(system, [], kernel)


@law(runs())
def test_a_refusal_changes_nothing_and_its_cycle_is_a_real_one(
    run: tuple[System, list[Step]],
) -> None:
    """A deadlock is a cycle of positive length; a swap has two visits and length zero."""
    system, todo = run
    kernel, twin = system.kernel(), Twin(system)

    for step in todo:
        possible, _ = take(step, twin, kernel)
        if possible or step.kind != "give" or step.right is None:
            continue
        check(system, twin.rights, kernel)
        cycle = kernel.cycle().tolist()
        a, b = step.right
        if system.is_last(a) or system.is_first(b):
            assert cycle == []
            continue
        assert (cycle[0], cycle[-1]) == (b, a + 1)
        assert len(set(cycle)) == len(cycle)
        length = oracle.length_of_cycle(system, [*twin.rights, step.right], cycle)
        assert length is not None
        assert length > 0 or (length == 0 and len(cycle) == 2 and system.swaps_conflict)


@law(runs())
def test_going_back_to_the_start_restores_the_start(run: tuple[System, list[Step]]) -> None:
    system, todo = run
    kernel, twin = system.kernel(), Twin(system)
    mark = kernel.checkpoint()

    for step in todo:
        if step.kind != "go back":
            take(step, twin, kernel)
    kernel.rollback(mark)

    check(system, [], kernel)


@law(runs())
def test_marks_nest_and_can_be_gone_back_to_more_than_once(
    run: tuple[System, list[Step]],
) -> None:
    """Try every step and take it back, as a planner does that compares choices."""
    system, todo = run
    kernel, twin = system.kernel(), Twin(system)

    for step in todo:
        mark = kernel.checkpoint()
        for right in meetings(system)[:3]:
            kernel.precede(*right)
            flip(kernel, *right)
            kernel.rollback(mark)
        check(system, twin.rights, kernel)
        take(step, twin, kernel)


@law(runs(), st.integers(0, 3))
def test_who_is_withdrawn_is_as_if_never_there_and_the_others_keep_their_rights(
    run: tuple[System, list[Step]], who: int
) -> None:
    system, steps = run
    kernel, twin = system.kernel(), Twin(system)
    for step in steps:
        take(step, twin, kernel)
    robot = who % len(system.routes)
    kernel.withdraw(robot)
    active = tuple(on and r != robot for r, on in enumerate(system.active))
    kept = [right for right in twin.rights if robot not in {system.robot[x] for x in right}]
    check(replace(system, active=active), kept, kernel)
